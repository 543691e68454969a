//! `linkwright solve --set` from the outside.

use crate::folder::Folder;

/// A crank of changeable length that follows a signal.
const CRANK: &str = "mechanism crank {
    param L = 0.5m;
    input angle = 30deg;
    body 1 at (0, 0) { P: (L, 0) }
    absolute_x(1) = 0;
    absolute_y(1) = 0;
    drive phi(1) = angle;
}
";

/// Last row of P in the output: its position, velocity and acceleration.
fn last_row(folder: &Folder, options: &str) -> Vec<f64> {
    let ran = folder.run(&format!(
        "solve a.mech --at 0.5 --points P --csv - {options}"
    ));
    let printed = ran.exits_with(0).stdout;
    let titles = printed.lines().next().expect("a line of titles");
    let row = printed.lines().last().expect("a row");
    let cells = titles.split(',').zip(row.split(','));
    cells
        .filter(|(title, _)| title.starts_with("P_") || title.starts_with("P."))
        .map(|(_, value)| value.parse().expect("a number"))
        .collect()
}

fn assert_near(found: &[f64], expected: [f64; 6]) {
    assert_eq!(found.len(), 6);
    for (found, expected) in found.iter().zip(expected) {
        assert!(
            (found - expected).abs() < 1e-14,
            "{found} is not {expected}"
        );
    }
}

#[test]
fn a_parameter_and_a_signal_are_set() {
    let folder = Folder::new("set", CRANK);
    let (sine, cosine) = 30.0_f64.to_radians().sin_cos();
    let still = [0.5 * cosine, 0.5 * sine, 0.0, 0.0, 0.0, 0.0];
    assert_near(&last_row(&folder, ""), still);
    let longer = [0.75 * cosine, 0.75 * sine, 0.0, 0.0, 0.0, 0.0];
    assert_near(&last_row(&folder, "--set L=750mm"), longer);
    // angle = t³ at t = 1/2, with the rates 3t² and 6t.
    let (length, angle, rate, acceleration) = (0.75, 0.125_f64, 0.75, 3.0);
    let (sine, cosine) = angle.sin_cos();
    let moving = [
        length * cosine,
        length * sine,
        -length * sine * rate,
        length * cosine * rate,
        -length * (cosine * rate * rate + sine * acceleration),
        length * (cosine * acceleration - sine * rate * rate),
    ];
    assert_near(&last_row(&folder, "--set L=0.75 --set angle=t^3"), moving);
}

#[test]
fn parameters_and_inputs_are_listed() {
    let folder = Folder::new("set_listed", CRANK);
    let ran = folder.run("solve a.mech --at 0.5 --set L=750mm --set angle=2*t");
    let printed = ran.exits_with(0).stdout;
    assert!(printed.contains("L = 0.75 m"), "{printed}");
    assert!(printed.contains("angle = 2*t rad"), "{printed}");
    let printed = folder.run("inspect a.mech").exits_with(0).stdout;
    assert!(printed.contains("\nparameter L = 0.5 m\n"), "{printed}");
    assert!(
        printed.contains("\ninput angle = 0.5235987755982988 rad\n"),
        "{printed}"
    );
    let printed = folder.run("plan a.mech").exits_with(0).stdout;
    assert!(printed.contains("phi1 = angle "), "{printed}");
}

#[test]
fn invalid_settings_are_reported_with_their_place() {
    let folder = Folder::new("set_wrong", CRANK);
    for (assignment, code, text) in [
        ("angel=1", "K11", "did you mean `angle`?"),
        ("M=1", "K11", "it has `L`, `angle`"),
        ("L=5deg", "K21", "expected a length, found an angle"),
        ("L=t", "K23", "the parameter `L` cannot depend on `t`"),
        ("L=1/0", "K22", "division by zero"),
        ("L", "K02", "expected `=`, found the end"),
        ("L=", "K02", "expected a formula, found the end"),
        ("=1", "K02", "expected the name of a parameter or an input"),
        ("L=}", "K04", "closes nothing"),
    ] {
        let ran = folder
            .run(&format!("solve a.mech --set {assignment}"))
            .exits_with(2);
        assert!(!ran.stderr.contains("constant"), "{}", ran.stderr);
        assert!(
            ran.stderr.contains(&format!("error[{code}]")),
            "{}",
            ran.stderr
        );
        assert!(ran.stderr.contains(text), "{}", ran.stderr);
        // The place is in the command line, not in the text made of it.
        let value = assignment.find('=').map_or(assignment.len(), |at| at + 1);
        let column = match code {
            "K11" => 1,
            "K22" => value + 3,
            _ if assignment.starts_with('=') => 1,
            _ => value + 1,
        };
        let place = format!(" --> --set:1:{column}\n  |\n1 | {assignment}\n");
        assert!(ran.stderr.contains(&place), "{place}{}", ran.stderr);
    }
    for several in ["L=1;revolute(P,P)", "L=1;", ";", "L=1;angle=2"] {
        let ran = folder.run(&format!("solve a.mech --set {several}"));
        let ran = ran.exits_with(2);
        let words = "takes one assignment";
        assert!(ran.stderr.contains(words), "{}", ran.stderr);
    }
}

#[test]
fn parameters_of_parts_are_proposed_as_they_are_named() {
    let text = "mechanism jaw {
    param stroke = 100mm;
    point A = (0, 0);
    body arm at A { A, B: (stroke, 0) }
    revolute A(ground, arm);
}
mechanism drawer {
    part j = jaw;
    drive phi(j.arm) = 0.2;
}
";
    let folder = Folder::new("set_part", text);
    folder
        .run("solve a.mech --at 0 --set j_stroke=80mm")
        .exits_with(0);
    let ran = folder.run("solve a.mech --at 0 --set j.stroke=80mm");
    let stderr = ran.exits_with(2).stderr;
    assert!(stderr.contains("`--set j_stroke=80mm`"), "{stderr}");
    // A name that no part has is another kind of error.
    let other = folder.run("solve a.mech --at 0 --set j.stroek=80mm");
    assert!(!other.exits_with(2).stderr.contains("joined by"));
}

/// Warnings refer to the mechanism with the values that are set, which is lowered once after that.
#[test]
fn weakly_decided_mode_is_found_with_the_values_that_are_set() {
    let folder = Folder::new(
        "set_undecided",
        "mechanism triangle {
    param rise = 40mm;
    point A = (0, 0), C = (100mm, 0), B = (50mm, rise);
    body 1 at A { A, B }
    body 2 at C { C, B }
    revolute A(ground, 1);
    revolute B(1, 2);
    revolute C(ground, 2);
}
",
    );
    for command in ["check", "draw", "solve"] {
        let ran = folder.run(&format!("{command} a.mech")).exits_with(0);
        assert!(!ran.stderr.contains("K38"), "{command}: {}", ran.stderr);
        let ran = folder.run(&format!("{command} a.mech --force --set rise=1um"));
        assert!(
            ran.stderr.contains("warning[K38]"),
            "{command}: {}",
            ran.stderr
        );
    }
}

/// A crank of changeable length with a rod of changeable length, and a driven length that is an input.
const CHANGED: &str = "mechanism changed {
    param r = 40mm;
    param rod = 90mm;
    input pull = 105mm;
    point A = (0, 0), D = (150mm, 0), W = (-80mm, 0);
    body crank at (0, 0, 60deg)      { A: (0, 0), B: (r, 0) }
    body arm   at (150mm, 0, 110deg) { D: (0, 0), C: (70mm, 0) }
    revolute A(ground, crank);
    revolute D(ground, arm);
    relative_distance (crank.B, arm.C) = rod;
    drive distance(ground.W, crank.B) = pull;
}
";

/// A zero makes numbers infinite, but the error is the length, or a loop that does not reach.
#[test]
fn values_that_cannot_be_are_refused_by_their_geometry() {
    let folder = Folder::new("set_refused", CHANGED);
    // B lies 105 mm from W and 40 mm from A, and D 150 mm from A: law of cosines.
    let (wall, crank, ground, arm) = (0.08_f64, 0.04_f64, 0.15_f64, 0.07_f64);
    let cosine = (0.105_f64.powi(2) - wall * wall - crank * crank) / (2.0 * wall * crank);
    let base = (crank * crank + ground * ground - 2.0 * crank * ground * cosine).sqrt();
    let gap = |by: f64, loop_name: &str| {
        let millimeters = 1000.0 * by;
        format!("{loop_name}: out of reach by {millimeters:.1} mm")
    };
    for (value, said) in [
        ("rod=0", "the distance must be positive".to_string()),
        ("rod=-90mm", "the distance must be positive".to_string()),
        ("pull=-105mm", "the distance must be positive".to_string()),
        ("rod=1e-320", gap(base - arm, "loop D-C-B")),
        ("r=0", gap(0.105 - wall, "loop A-B-W")),
    ] {
        for command in ["solve a.mech --to 0 --no-files", "check a.mech --to 0"] {
            let ran = folder
                .run(&format!("{command} --set {value}"))
                .exits_with(1);
            assert!(ran.stderr.contains(&said), "{said}: {}", ran.stderr);
            assert!(!ran.stderr.contains("K22"), "{}", ran.stderr);
        }
    }
}

/// Assemblies are not listed for a value that no assembly may have.
#[test]
fn assemblies_of_a_refused_value_are_not_listed() {
    let folder = Folder::new("set_no_assemblies", CHANGED);
    let listed = |options: &str, code: i32| {
        let ran = folder.run(&format!("check a.mech --to 0 {options}"));
        ran.exits_with(code).stdout
    };
    assert!(listed("", 0).contains("assemblies at t = 0 s: 4 of"));
    for value in ["rod=-90mm", "pull=-105mm"] {
        let printed = listed(&format!("--set {value}"), 1);
        assert!(!printed.contains("assemblies"), "{printed}");
        let report = crate::printed::json(&listed(&format!("--json --set {value}"), 1));
        assert_eq!(report["assemblies"].as_array().map(Vec::len), Some(0));
    }
}

/// The input is named with the time at which it is not finite: 0.011025 m² − t is negative at the next frame.
#[test]
fn an_input_that_is_not_finite_is_named() {
    let folder = Folder::new("set_infinite", CHANGED);
    let ran = folder.run("solve a.mech --to 1 --step 0.25 --no-files --set pull=sqrt(0.011025-t)");
    let stderr = ran.exits_with(1).stderr;
    assert!(
        stderr.contains("beyond t = 0.25 s: input pull is not finite"),
        "{stderr}"
    );
    assert!(!stderr.contains("revolute"), "{stderr}");
}

/// A value that makes a number infinite, whatever the pose is, is named at its declaration.
#[test]
fn a_value_that_makes_numbers_infinite_is_named() {
    let folder = Folder::new("set_too_large", CHANGED);
    let ran = folder.run("solve a.mech --to 0 --no-files --set rod=1e200");
    let stderr = ran.exits_with(2).stderr;
    assert!(
        stderr.contains("infinite or undefined with `rod` = 1e200"),
        "{stderr}"
    );
    assert!(stderr.contains(" --> a.mech:3:11\n"), "{stderr}");
}

/// A spring between coinciding ends has no direction: it is named, and not the quantities that follow from it.
#[test]
fn a_spring_without_a_length_is_named() {
    let text = "mechanism meeting {
    param gap = 100mm;
    point A = (0, 0);
    body a at A { A, P: (50mm, 0) }
    body b at (gap, 0) { Q: (0, 0), R: (30mm, 0) }
    revolute A(ground, a);
    absolute_x(b) = gap;
    absolute_y(b) = 0;
    spring (ground.A, b.Q) = 5N/mm free 20mm;
    torque on a = 1Nm;
    relative_angle (a, b) = 20deg;
    drive phi(a) = t;
    effort;
}
";
    let folder = Folder::new("set_meeting", text);
    let ran = folder.run("solve a.mech --to 0 --no-files --set gap=0");
    let stderr = ran.exits_with(1).stderr;
    assert!(
        stderr.contains("spring (ground.A, b.Q) has no length"),
        "{stderr}"
    );
}

/// A crank with ranges.
const LIMITED: &str = "mechanism crank {
    param L = 500mm from 400mm to 600mm;
    input angle = 30deg from -90deg to 90deg;
    body 1 at (0, 0) { P: (L, 0) }
    absolute_x(1) = 0;
    absolute_y(1) = 0;
    drive phi(1) = angle;
}
";

#[test]
fn a_value_outside_of_its_range_is_refused_with_both_ends() {
    let folder = Folder::new("set_ranges", LIMITED);
    for (options, expected) in [
        ("--set L=601mm", "601 mm is outside of the range of `L`"),
        ("--set L=0.39", "`L` is from 400 mm to 600 mm"),
        (
            "--set angle=-91deg",
            "-91 deg is outside of the range of `angle`",
        ),
        ("--set angle=2", "`angle` is from -90 deg to 90 deg"),
    ] {
        let ran = folder.run(&format!("solve a.mech {options}")).exits_with(2);
        assert!(ran.stderr.contains("error[K25]"), "{}", ran.stderr);
        assert!(ran.stderr.contains(expected), "{options}: {}", ran.stderr);
    }
    for end in ["L=400mm", "L=0.6", "angle=90deg", "angle=-pi/2"] {
        folder
            .run(&format!("solve a.mech --csv - --set {end}"))
            .exits_with(0);
    }
}

/// The crank is at 87.2° at 0.7 s, and would be at 96.8° a tenth later.
#[test]
fn a_law_that_leaves_its_range_ends_the_motion() {
    let folder = Folder::new("set_range_of_a_law", LIMITED);
    for options in ["", " --formulation textbook"] {
        let law = "--set angle=20deg+96deg*t/1s";
        let ran = folder.run(&format!(
            "solve a.mech --csv - {law} --to 1 --step 0.1{options}"
        ));
        let ran = ran.exits_with(1);
        assert!(
            ran.stderr
                .contains("input angle: 96.8 deg is outside of its range from -90 deg to 90 deg"),
            "{}",
            ran.stderr
        );
        let last = ran.stdout.lines().last().expect("a row");
        assert!(last.starts_with("0.7"), "{last}");
    }
}
