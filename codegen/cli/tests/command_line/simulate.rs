//! `linkwright simulate`: what it prints and writes, and what it refuses.

use crate::folder::Folder;
use crate::printed::json;

const PENDULUM: &str = "mechanism pendulum {
    point O = (0, 0);
    body bob at O { O, S: (0, -2) }
    revolute O(ground, bob);
    free swing: phi(bob) = 30deg rate 1.5;
    mass bob = 3kg at S inertia 0.5;
    gravity = (0, -9.81);
}
";

#[test]
fn a_pendulum_is_simulated_as_json() {
    let folder = Folder::new("simulate_json", PENDULUM);
    let ran = folder.run("simulate a.mech --to 2 --step 0.5 --json --rtol 1e-12 --atol 1e-14");
    let found = json(&ran.exits_with(0).stdout);
    let frames = found["frames"].as_array().expect("frames");
    assert_eq!(frames.len(), 5);
    let number = |value: &serde_json::Value| value.as_f64().expect("a number");
    // It begins as it is written, with the acceleration that its weight gives it.
    let first = &frames[0];
    let spin = -3.0 * 2.0 * 9.81 * 0.5 / 12.5;
    for (level, expected) in [("q", 30_f64.to_radians()), ("qd", 1.5), ("qdd", spin)] {
        assert!(
            (number(&first[level][2]) - expected).abs() <= 1e-14,
            "{level}"
        );
    }
    // Its energy is kept, and every frame has the acceleration of its angle.
    let simulation = &found["simulation"];
    assert!(number(&simulation["energy_drift"]).abs() <= 1e-10);
    assert!(number(&simulation["evaluations"]) >= 12.0 * number(&simulation["steps"]));
    for frame in frames {
        let spin = -3.0 * 2.0 * 9.81 * number(&frame["q"][2]).sin() / 12.5;
        assert!((number(&frame["qdd"][2]) - spin).abs() <= 1e-13);
    }
    assert!(found.get("error").is_none());
}

/// Both methods give one motion, and say how many of their steps are implicit.
#[test]
fn a_method_is_forced() {
    let folder = Folder::new("simulate_method", PENDULUM);
    let end = |options: &str| {
        let ran = folder.run(&format!(
            "simulate a.mech --to 1 --json --rtol 1e-9 {options}"
        ));
        let found = json(&ran.exits_with(0).stdout);
        let angle = found["frames"][100]["q"][2].as_f64().expect("an angle");
        let counted = |name: &str| found["simulation"][name].as_u64().expect("a count");
        (angle, counted("steps"), counted("implicit_steps"))
    };
    let (chosen, _, none) = end("");
    let (explicit, _, also_none) = end("--method dop853");
    let (implicit, steps, all) = end("--method implicit");
    assert_eq!((chosen, none, also_none), (explicit, 0, 0));
    assert!(steps > 0 && steps == all);
    assert!((implicit - explicit).abs() <= 1e-7, "{implicit} {explicit}");
}

/// Frames do not depend on which others are asked for.
#[test]
fn frames_lie_on_one_motion() {
    let folder = Folder::new("simulate_frames", PENDULUM);
    let last = |step: &str| {
        let ran = folder.run(&format!("simulate a.mech --to 1 --step {step} --csv -"));
        let printed = ran.exits_with(0).stdout;
        printed.lines().last().expect("a frame").to_string()
    };
    assert_eq!(last("1"), last("0.001"));
}

#[test]
fn a_summary_says_what_it_took() {
    let folder = Folder::new("simulate_summary", PENDULUM);
    let ran = folder.run("simulate a.mech --to 1 --step 0.1 --no-files");
    let printed = ran.exits_with(0).stdout;
    for part in [
        "integration of the free coordinates",
        "evaluations",
        "drift of the energy",
        "free swing: phi(bob)",
    ] {
        assert!(printed.contains(part), "{printed}");
    }
}

#[test]
fn another_start_can_be_set() {
    let folder = Folder::new("simulate_set", PENDULUM);
    let ran = folder.run("simulate a.mech --to 0 --json --set swing=0.5-2*t");
    let found = json(&ran.exits_with(0).stdout);
    assert_eq!(found["frames"][0]["q"][2].as_f64(), Some(0.5));
    assert_eq!(found["frames"][0]["qd"][2].as_f64(), Some(-2.0));
}

/// An engine whose piston's place is free, which stands still at both dead centers.
const ENGINE: &str = "mechanism engine {
    point A = (0, 0), B = (0.1, 0.1), C = (0.4, 0);
    body crank at A facing A -> B { A, B }
    body rod at B facing B -> C { B, C }
    body piston at C { C }
    revolute A(ground, crank);
    revolute B(crank, rod);
    revolute C(rod, piston);
    absolute_y(piston) = 0;
    absolute_angle(piston) = 0;
    free stroke: x(piston) = 0.4 rate 1;
    mass crank = 2kg at B;
    mass piston = 0.5kg;
}
";

/// A force that grows beyond all bounds: the motion ends there, with what could be found before.
#[test]
fn a_motion_that_ends_says_where_and_why() {
    let endless = PENDULUM.replace("gravity", "torque on bob = 1Nm/sqrt(1 - t*t); gravity");
    let folder = Folder::new("simulate_ends", endless);
    let ran = folder.run("simulate a.mech --to 2 --no-files");
    let ran = ran.exits_with(1);
    assert!(
        ran.stderr.contains("cannot be simulated beyond t = "),
        "{}",
        ran.stderr
    );
    assert!(ran.stdout.contains("integration of the free coordinates"));
}

#[test]
fn what_is_driven_throughout_is_refused() {
    let folder = Folder::new(
        "simulate_driven",
        PENDULUM.replace(
            "free swing: phi(bob) = 30deg rate 1.5",
            "drive phi(bob) = t",
        ),
    );
    let ran = folder.run("simulate a.mech");
    let said = ran.exits_with(2).stderr;
    assert!(said.contains("no coordinate of `a.mech` is free"), "{said}");
    for options in [
        "--rtol 0",
        "--rtol x",
        "--to -1",
        "--atol 2",
        "--method rk4",
    ] {
        let folder = Folder::new("simulate_refused", PENDULUM);
        folder
            .run(&format!("simulate a.mech {options}"))
            .exits_with(2);
    }
}

/// What is free turns back at both dead centers, and the motion goes on.
#[test]
fn a_piston_goes_over_its_dead_centers() {
    let folder = Folder::new("simulate_dead_centers", ENGINE);
    let ran = folder.run("simulate a.mech --to 2 --json");
    let found = json(&ran.exits_with(0).stdout);
    let drift = found["simulation"]["energy_drift"].as_f64().expect("known");
    let kinetic = found["simulation"]["kinetic_energy"]
        .as_f64()
        .expect("known");
    assert!(drift.abs() <= 1e-8 * kinetic, "{drift} {kinetic}");
    for frame in found["frames"].as_array().expect("frames") {
        let y = frame["q"][7].as_f64().expect("y of the piston");
        assert!(y.abs() <= 1e-12, "{y}");
    }
    for option in ["--change-coordinates", "--through-singular"] {
        folder
            .run(&format!("simulate a.mech {option}"))
            .exits_with(2);
    }
}
