//! Friction and motors in the results of commands.

use serde_json::Value;

use crate::folder::Folder;

/// A block that a cylinder with a motor pushes up an incline of 3 to 4, with half of its weight in friction.
const INCLINE: &str = "mechanism incline {
    units mm;
    point O = (0, 0);
    body block at (40cm, 30cm) { B: (0, 0) }
    translational rail(ground, block) along O -> B;
    drive push: length(O, B) = 500mm + 100mm*t;
    mass block = 10kg;
    gravity = (0, -10m/s^2);
    friction rail = 0.5;
    motor push gear 1/20mm efficiency 0.5;
}";

fn close(value: &Value, expected: f64) {
    let value = value.as_f64().expect("a number");
    assert!((value - expected).abs() < 1e-12, "{value} and {expected}");
}

/// The weight of 100 N takes 60 N along the incline, and friction 40 N.
#[test]
fn solve_and_check_report_efficiencies_and_worst_points() {
    let folder = Folder::new("losses", INCLINE);
    for command in [
        "solve a.mech --to 1 --step 0.5",
        "check a.mech --to 1 --step 0.5",
    ] {
        let ran = folder.run(&format!("{command} --json")).exits_with(0);
        let object: Value = serde_json::from_str(&ran.stdout).expect("JSON");
        let friction = &object["friction"];
        close(&friction["efficiency"], 0.6);
        close(&friction["work"], 10.0);
        close(&friction["frictionless_work"], 6.0);
        close(&friction["lowest"]["efficiency"], 0.6);
        assert!(friction["efficiency_of_load"].is_null());
        assert_eq!(friction["self_locking"].as_array().map(Vec::len), Some(0));
        // The shaft turns 0.1 m/s over 20 mm, and the gear loses half of the power.
        let motor = &object["motors"][0];
        assert_eq!(motor["driver"], "push");
        close(&motor["torque"]["torque"], 100.0 * 0.02 / 0.5);
        close(&motor["torque"]["speed"], 5.0);
        close(&motor["power"]["power"], 20.0);
    }
    let ran = folder.run("solve a.mech --to 1 --step 0.5").exits_with(0);
    let lines = [
        "  efficiency 0.6000 while drivers drive the load: 6.000e+00 J of 1.000e+01 J",
        "  lowest efficiency 0.6000 at t = 0 s",
        "  never self-locking",
    ];
    assert!(ran.stdout.contains(&lines.join("\n")), "{}", ran.stdout);
    // With more friction than slope the block rests, and without any the drivers lose nothing.
    let locking = INCLINE.replace("= 0.5;", "= 0.8;");
    let ran = Folder::new("locking", &locking)
        .run("check a.mech --to 1 --step 0.5")
        .exits_with(0);
    assert!(
        ran.stdout.contains("  self-locking from t = 0 s to 1 s"),
        "{}",
        ran.stdout
    );
}

#[test]
fn a_motion_ends_where_friction_does_not_settle() {
    // A ladder jams where the tangent of its angle is the reciprocal of the coefficient.
    let ladder = "mechanism ladder {
        point O = (0, 0);
        body top at (0, 0.5) { A: (0, 0) }
        body foot at (0.866, 0) { B: (0, 0) }
        translational post(ground, top) along O -> A;
        translational floor(ground, foot) along O -> B;
        relative_distance (top.A, foot.B) = 1m;
        drive hoist: length(O, A) = 0.5m + 0.2*t;
        force on foot.B = (50N, 0);
        friction floor = 0.75;
    }";
    let folder = Folder::new("ladder", ladder);
    let ran = folder.run("solve a.mech --to 2 --json").exits_with(1);
    let object: Value = serde_json::from_str(&ran.stdout).expect("JSON");
    assert_eq!(object["failure"]["kind"], "friction_unsettled");
    // The height is then 0.8 m.
    let t = object["failure"]["t"].as_f64().expect("a time");
    assert!((t - 1.5).abs() < 1e-6, "{t}");
    let ran = folder
        .run("solve a.mech --to 2 --formulation textbook --out textbook")
        .exits_with(1);
    assert!(
        ran.stderr.contains("the forces of friction do not settle"),
        "{}",
        ran.stderr
    );
}
