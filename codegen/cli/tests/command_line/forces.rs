//! Quantities of `effort`, `reaction` and `energy` statements in the output of `linkwright solve` and `linkwright
//! plan`.

use crate::folder::Folder;
use crate::printed::json;

/// A pendulum of 3 kg and 2 m, held and swung by a motor.
const PENDULUM: &str = "mechanism pendulum {
    point O = (0, 0);
    body bob at O { O, S: (0, -2) }
    revolute O(ground, bob);
    drive swing: phi(bob) = 1 + t;
    mass bob = 3kg at S;
    gravity = (0, -9.81);
    effort;
    reactions;
    energy;
}
";

/// Named numbers of the only row.
fn columns(folder: &Folder, options: &str) -> Vec<(String, f64)> {
    let ran = folder.run(&format!("solve a.mech --at 0.5 --csv - {options}"));
    let printed = ran.exits_with(0).stdout;
    let mut lines = printed.lines();
    let names = lines.next().expect("a header").split(',');
    let names = names.map(str::to_string);
    let values = lines.next().expect("a row").split(',');
    names
        .zip(values.map(|value| value.parse().expect("a number")))
        .collect()
}

fn value(columns: &[(String, f64)], name: &str) -> f64 {
    let column = columns.iter().find(|(own, _)| own == name);
    column
        .unwrap_or_else(|| panic!("no `{name}` in {columns:?}"))
        .1
}

fn assert_close(found: f64, wanted: f64) {
    assert!(
        (found - wanted).abs() <= 1e-12 * wanted.abs().max(1.0),
        "{found} {wanted}"
    );
}

#[test]
fn forces_are_columns_in_both_views() {
    let folder = Folder::new("forces", PENDULUM);
    for view in ["", "--formulation textbook"] {
        let columns_of_view = columns(&folder, view);
        let (sine, cosine) = 1.5_f64.sin_cos();
        assert_close(
            value(&columns_of_view, "effort_swing"),
            3.0 * 9.81 * 2.0 * sine,
        );
        assert_close(
            value(&columns_of_view, "power_swing"),
            3.0 * 9.81 * 2.0 * sine,
        );
        // At a steady rate of 1/s the pin pulls the bob inwards, and carries its weight.
        assert_close(value(&columns_of_view, "reaction_o_x"), -6.0 * sine);
        assert_close(
            value(&columns_of_view, "reaction_o_y"),
            6.0 * cosine + 3.0 * 9.81,
        );
        assert_close(value(&columns_of_view, "kinetic_energy"), 6.0);
        assert_close(
            value(&columns_of_view, "potential_energy"),
            -3.0 * 9.81 * 2.0 * cosine,
        );
        let still = columns(&folder, &format!("--static {view}"));
        assert_close(value(&still, "effort_swing"), 3.0 * 9.81 * 2.0 * sine);
        assert_close(value(&still, "power_swing"), 0.0);
        assert_close(value(&still, "reaction_o_x"), 0.0);
        assert_close(value(&still, "reaction_o_y"), 3.0 * 9.81);
        assert_close(value(&still, "kinetic_energy"), 0.0);
    }
    let printed = folder
        .run("solve a.mech --at 0.5 --json")
        .exits_with(0)
        .stdout;
    let object = json(&printed);
    assert_eq!(object["forces"][0][0], "effort_swing");
    assert_eq!(object["forces"][0][1], "N*m");
    let effort = object["frames"][0]["forces"][0].as_f64().expect("a number");
    assert_close(effort, 3.0 * 9.81 * 2.0 * 1.5_f64.sin());
}

#[test]
fn forces_are_printed_and_drawn() {
    let folder = Folder::new("forces_printed", PENDULUM);
    let printed = folder
        .run("solve a.mech --to 1 --out out")
        .exits_with(0)
        .stdout;
    for line in [
        "largest forces",
        "  effort_swing      ",
        "effort_swing (N*m)",
    ] {
        assert!(printed.contains(line), "{printed}");
    }
    assert!(folder.file("out/effort_swing.svg").is_file());
    // What was written is known again.
    folder
        .run("solve a.mech --to 1 --out out --units")
        .exits_with(0);
    folder.run("solve a.mech --to 1 --out out").exits_with(0);
    let plan = folder.run("plan a.mech").exits_with(0).stdout;
    assert!(
        plan.contains("Forces: what drivers exert, what joints carry, what is stored"),
        "{plan}"
    );
    assert!(plan.contains("effort_swing = "), "{plan}");
}

#[test]
fn statics_need_something_that_is_asked_for() {
    let text = PENDULUM.replace("effort;\n    reactions;\n    energy;\n", "");
    let folder = Folder::new("forces_static", &text);
    let ran = folder.run("solve a.mech --static --no-files").exits_with(2);
    assert!(
        ran.stderr.contains("needs forces to compute"),
        "{}",
        ran.stderr
    );
}

#[test]
fn a_contact_that_would_have_to_pull_is_a_warning() {
    let text = "mechanism cam {
        point O = (0, 0), G = (0, 30mm);
        body cam at O { O }
        body follower at G { G, A: (-20mm, 0), B: (20mm, 0) }
        curve rim(s) on cam = (10mm + 30mm*cos(s), 30mm*sin(s));
        revolute O(ground, cam);
        translational (ground, follower) along O -> G;
        flat contact (follower, rim) along A -> B;
        drive phi(cam) = 40*t;
        mass follower = 0.25kg;
        gravity = (0, -9.81);
        reaction contact;
    }";
    // e ω² = 16 m/s² is more than gravity holds down.
    let folder = Folder::new("forces_pull", text);
    let ran = folder
        .run("solve a.mech --to 0.2 --step 1e-3 --no-files")
        .exits_with(0);
    assert!(
        ran.stderr
            .contains("reaction_contact_pressure is negative at t = "),
        "{}",
        ran.stderr
    );
    let slow = text.replace("40*t", "20*t");
    let folder = Folder::new("forces_press", &slow);
    let ran = folder
        .run("solve a.mech --to 0.4 --step 1e-3 --no-files")
        .exits_with(0);
    assert!(!ran.stderr.contains("negative"), "{}", ran.stderr);
}

/// A pair of gears, with its pressure angle or with nothing in its place.
fn gears(angle: &str) -> String {
    format!(
        "mechanism geared {{
    param arm = 60mm;
    param ratio = 20/40;
    param slope = 20deg;
    point A = (0, 0), B = (arm, 0);
    body 1 at A {{ A }}
    body 2 at B {{ B }}
    revolute A(ground, 1);
    revolute B(ground, 2);
    external_gear mesh(1, 2) = ratio {angle};
    drive phi(1) = 3*t;
    torque on 2 = -5Nm;
    effort;
    reactions;
}}
"
    )
}

#[test]
fn bearings_carry_the_force_of_teeth_in_both_views() {
    let folder = Folder::new("teeth", gears("pressure_angle slope"));
    for view in ["", "--formulation textbook"] {
        for (options, radius, slope) in [
            ("", 0.04, 20_f64.to_radians()),
            ("--set arm=90mm", 0.06, 20_f64.to_radians()),
            ("--set ratio=2", 0.02, 20_f64.to_radians()),
            ("--set slope=0.1", 0.04, 0.1),
        ] {
            let columns_of_view = columns(&folder, &format!("{view} {options}"));
            assert_close(
                value(&columns_of_view, "reaction_b_x"),
                -5.0 / radius * slope.tan(),
            );
            assert_close(value(&columns_of_view, "reaction_b_y"), 5.0 / radius);
            assert_close(value(&columns_of_view, "reaction_mesh_moment"), 5.0);
        }
    }
    for (set, said) in [
        (
            "slope=-1deg",
            "the pressure angle, unless zero, must be positive",
        ),
        (
            "slope=2",
            "the right angle less the pressure angle must be positive",
        ),
        (
            "arm=0mm",
            "error[K24]: the wheels of `external_gear mesh(1, 2)` turn about one axis",
        ),
    ] {
        let ran = folder.run(&format!("solve a.mech --at 0.5 --set {set}"));
        assert_ne!(ran.code, Some(0), "{set}: {}", ran.stdout);
        assert!(ran.stderr.contains(said), "{set}: {}", ran.stderr);
    }
}

#[test]
fn plans_say_what_bearings_carry() {
    let with = Folder::new("teeth_planned", gears("pressure_angle slope"));
    let without = Folder::new("no_teeth_planned", gears(""));
    let belt = Folder::new("belt_planned", gears("").replace("external_gear", "belt"));
    for format in ["text", "unicode", "latex"] {
        let plan = |folder: &Folder| {
            let ran = folder.run(&format!("plan a.mech --format {format}"));
            let text = ran.exits_with(0).stdout;
            text.split_whitespace().collect::<Vec<_>>().join(" ")
        };
        let [with, without, belt] = [&with, &without, &belt].map(plan);
        assert!(with.contains("press on 2 at the pitch point"), "{with}");
        assert!(!with.contains("What bearings do not carry"), "{with}");
        assert!(without.contains("What bearings do not carry"), "{without}");
        let gear = "bearings do not carry the tooth force of external";
        assert!(without.contains(gear), "{without}");
        let pull = "bearings do not carry the pull of belt mesh";
        assert!(belt.contains(pull), "{belt}");
    }
}
