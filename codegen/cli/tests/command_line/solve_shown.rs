//! Quantities that `linkwright solve` shows on request, and its first Newton-Raphson step.

use crate::folder::{EXAM, Folder};

/// φ1 = π/6 + sin 2t, and x1 is always 0.
#[test]
fn coordinates_are_shown_with_their_rates_in_the_wanted_unit() {
    let folder = Folder::new("shown", EXAM);
    let ran = folder
        .run("solve a.mech --show phi1,x1 --angles deg --to 500ms --step 250ms --out shown")
        .exits_with(0);
    assert!(!ran.stdout.contains("P: position"), "{}", ran.stdout);
    let row = |t: f64| {
        let angle = std::f64::consts::FRAC_PI_6 + (2.0 * t).sin();
        let motion = [angle, 2.0 * (2.0 * t).cos(), -4.0 * (2.0 * t).sin()];
        motion.map(|it| format!("{:.6}", it.to_degrees()))
    };
    for text in [
        "phi1: value, rate, acceleration in deg, deg/s, deg/s²",
        "x1: value, rate, acceleration in m, m/s, m/s²",
    ] {
        assert!(ran.stdout.contains(text), "{text} in {}", ran.stdout);
    }
    for value in [row(0.25), row(0.5)].concat() {
        assert!(ran.stdout.contains(&value), "{value} in {}", ran.stdout);
    }
    // Coordinates at rest have no picture.
    assert_eq!(
        folder.list("shown"),
        ["motion.csv", "motion.csv.source", "phi1.svg"]
    );
    assert!(folder.read("shown/phi1.svg").contains("phi1&apos; (deg/s)"));
    let ran = folder.run("solve a.mech --show phi3").exits_with(2);
    assert!(
        ran.stderr.contains("no coordinate or point `phi3`")
            && ran.stderr.contains("are: x1, y1, phi1,")
            && ran.stderr.contains("its points are: P, Q"),
        "{}",
        ran.stderr
    );
}

/// Spellings of the description, of the tables of frames and of the generated code.
#[test]
fn requested_quantities_may_be_spelled_in_every_form() {
    let folder = Folder::new("spelled", EXAM);
    let run = |name: &str| {
        let show = format!("solve a.mech --show {name} --at 0.5 --no-files");
        folder.run(&show).exits_with(0).stdout
    };
    let angle = run("phi2");
    assert!(angle.contains("phi2: value, rate, acceleration"), "{angle}");
    for name in ["phi(2)", "phi_2", "phi2_d", "phi2_dd", "q.phi2", "qdd.phi2"] {
        assert_eq!(run(name), angle, "{name}");
    }
    // The middle of the rod; nothing else is shown.
    let point = run("Q");
    assert!(point.contains("Q: position"), "{point}");
    assert!(
        !point.contains("P: position") && !point.contains("phi2: value"),
        "{point}"
    );
    for name in ["Q_x", "Q_vy", "Q.y", "2.Q", "2.Q_ax", "y(2.Q)", "point_q"] {
        assert_eq!(run(name), point, "{name}");
    }
    let both = run("x(2),Q,phi2,Q_y");
    assert!(
        both.contains("x2: value") && both.contains("Q: position"),
        "{both}"
    );
    // Each has one picture.
    folder
        .run("solve a.mech --show phi(2),phi2,Q_x,Q --to 1 --plot plots --no-files")
        .exits_with(0);
    assert_eq!(folder.list("plots"), ["Q.svg", "paths.svg", "phi2.svg"]);
    for name in [
        "phi(3)", "phi_", "x(2.R)", "Q_z", "3.Q", "phi(2", "phi(1.Q)",
    ] {
        let ran = folder
            .run(&format!("solve a.mech --show {name}"))
            .exits_with(2);
        assert!(ran.stderr.contains(&format!("`{name}`")), "{}", ran.stderr);
    }
}

#[test]
fn a_point_can_be_named_by_any_body_that_carries_it() {
    let folder = Folder::new("carried", EXAM);
    let printed = |points: &str| {
        let ran = folder.run(&format!("solve a.mech --points {points} --no-files"));
        ran.exits_with(0).stdout
    };
    assert_eq!(printed("2.P"), printed("P"));
    assert_eq!(printed("1.P,2.Q"), printed("P,Q"));
    for wrong in ["1.Q", "3.P", "1.", ".P"] {
        let ran = folder.run(&format!("solve a.mech --points {wrong}"));
        assert!(ran.exits_with(2).stderr.contains("no point"), "{wrong}");
    }
}

/// By hand: x2 is 1.7 instead of √3, and the rest follows from the rows of the pin.
#[test]
fn the_first_step_is_that_of_the_exam() {
    let folder = Folder::new("first_step", EXAM);
    let ran = folder
        .run("solve a.mech --first-step --no-files")
        .exits_with(0);
    let root = 3.0_f64.sqrt();
    let residuals = [
        30.0_f64.to_radians().cos() - 1.7 + root * 1.0_f64.cos(),
        0.5 - 2.0 + root * 1.0_f64.sin(),
    ];
    let turned = (-residuals[0] + root - 1.7) / (-root * 1.0_f64.sin());
    for number in [
        -residuals[0],
        -residuals[1],
        root - 1.7,
        turned,
        1.0 + turned,
    ] {
        let text = format!("{number:.6}");
        assert!(ran.stdout.contains(&text), "{text} in {}", ran.stdout);
    }
}

/// The design configuration and its derivatives are equal at each instant; the driver misses by 0.3 rad/s times the
/// time between them.
#[test]
fn the_first_step_is_that_of_the_instant_that_is_asked_for() {
    let crank = "mechanism crank {
    point A = (0, 0);
    body crank at A { A }
    revolute A(ground, crank);
    drive phi(crank) = 0.1 + 0.3*t;
}
";
    let folder = Folder::new("first_step_at", crank);
    let step = |options: &str| {
        let command = format!("solve a.mech --first-step --no-files {options}");
        folder.run(&command).exits_with(0).stdout
    };
    let both = step("--at 1,2");
    for (t, residual) in [(1, "0.400000"), (2, "0.700000")] {
        let heading = format!("from the design configuration at t = {t} s");
        let (_, from) = both.split_once(&heading).expect("a step");
        let chosen = from.split("from the drawing").next().expect("a text");
        assert!(chosen.contains(residual), "{residual} in {chosen}");
    }
    assert!(
        !both.contains("from the design configuration at t = 0 s"),
        "{both}"
    );
    assert!(step("--from 1").contains("from the design configuration at t = 1 s"));
}
