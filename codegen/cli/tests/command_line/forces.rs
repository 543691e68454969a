//! What `effort`, `reaction` and `energy` statements ask for, as `linkwright solve` and `linkwright plan` write it.

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

/// The named numbers of the only row.
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
    let found = columns.iter().find(|(own, _)| own == name);
    found
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
    for view in ["", "--view textbook"] {
        let found = columns(&folder, view);
        let (sine, cosine) = 1.5_f64.sin_cos();
        assert_close(value(&found, "effort_swing"), 3.0 * 9.81 * 2.0 * sine);
        assert_close(value(&found, "power_swing"), 3.0 * 9.81 * 2.0 * sine);
        // At a steady rate of 1/s the pin pulls the bob inwards, and carries its weight.
        assert_close(value(&found, "reaction_o_x"), -6.0 * sine);
        assert_close(value(&found, "reaction_o_y"), 6.0 * cosine + 3.0 * 9.81);
        assert_close(value(&found, "kinetic_energy"), 6.0);
        assert_close(
            value(&found, "potential_energy"),
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
