//! `linkwright simulate`: output, files and refusals.

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
    let report = json(&ran.exits_with(0).stdout);
    let frames = report["frames"].as_array().expect("frames");
    assert_eq!(frames.len(), 5);
    let number = |value: &serde_json::Value| value.as_f64().expect("a number");
    // The motion begins in the described pose, with the acceleration of its weight.
    let first = &frames[0];
    let spin = -3.0 * 2.0 * 9.81 * 0.5 / 12.5;
    for (level, expected) in [("q", 30_f64.to_radians()), ("qd", 1.5), ("qdd", spin)] {
        assert!(
            (number(&first[level][2]) - expected).abs() <= 1e-14,
            "{level}"
        );
    }
    // Its energy is kept, and every frame has the acceleration of its angle.
    let simulation = &report["simulation"];
    assert!(number(&simulation["energy_drift"]).abs() <= 1e-10);
    assert!(number(&simulation["evaluations"]) >= 12.0 * number(&simulation["steps"]));
    for frame in frames {
        let spin = -3.0 * 2.0 * 9.81 * number(&frame["q"][2]).sin() / 12.5;
        assert!((number(&frame["qdd"][2]) - spin).abs() <= 1e-13);
    }
    assert!(report.get("error").is_none());
}

/// Both methods give one motion, and say how many of their steps are implicit.
#[test]
fn a_method_is_forced() {
    let folder = Folder::new("simulate_method", PENDULUM);
    let end = |options: &str| {
        let ran = folder.run(&format!(
            "simulate a.mech --to 1 --json --rtol 1e-9 {options}"
        ));
        let report = json(&ran.exits_with(0).stdout);
        let angle = report["frames"][100]["q"][2].as_f64().expect("an angle");
        let counted = |name: &str| report["simulation"][name].as_u64().expect("a count");
        (angle, counted("steps"), counted("implicit_steps"))
    };
    let (chosen, _, none) = end("");
    let (explicit, _, also_none) = end("--method dop853");
    let (implicit, steps, all) = end("--method implicit");
    assert_eq!((chosen, none, also_none), (explicit, 0, 0));
    assert!(steps > 0 && steps == all);
    assert!((implicit - explicit).abs() <= 1e-7, "{implicit} {explicit}");
}

/// Frames do not depend on the other requested frames.
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
    let report = json(&ran.exits_with(0).stdout);
    assert_eq!(report["frames"][0]["q"][2].as_f64(), Some(0.5));
    assert_eq!(report["frames"][0]["qd"][2].as_f64(), Some(-2.0));
}

/// Engine with a free piston position, which rests at both dead points.
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

/// A force that grows without bound: the motion ends there, with the frames before.
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
fn refuses_fully_driven_mechanism() {
    let folder = Folder::new(
        "simulate_driven",
        PENDULUM.replace(
            "free swing: phi(bob) = 30deg rate 1.5",
            "drive phi(bob) = t",
        ),
    );
    let ran = folder.run("simulate a.mech");
    let stderr = ran.exits_with(2).stderr;
    assert!(
        stderr.contains("no coordinate of `a.mech` is free"),
        "{stderr}"
    );
    for (options, words) in [
        ("--rtol 0", "a tolerance is between"),
        ("--rtol x", "not a number"),
        (
            "--to -1",
            "error: `--to -1` lies before the start of the motion, 0 s\n",
        ),
        ("--atol 2", "a tolerance is between"),
        ("--method rk4", "invalid value 'rk4'"),
    ] {
        let folder = Folder::new("simulate_refused", PENDULUM);
        let ran = folder.run(&format!("simulate a.mech {options}"));
        let stderr = ran.exits_with(2).stderr;
        assert!(stderr.contains(words), "{options}: {stderr}");
    }
}

/// The free coordinate turns back at both dead points, and the motion continues.
#[test]
fn a_piston_goes_over_its_dead_centers() {
    let folder = Folder::new("simulate_dead_centers", ENGINE);
    let ran = folder.run("simulate a.mech --to 2 --json");
    let report = json(&ran.exits_with(0).stdout);
    let drift = report["simulation"]["energy_drift"]
        .as_f64()
        .expect("known");
    let kinetic = report["simulation"]["kinetic_energy"]
        .as_f64()
        .expect("known");
    assert!(drift.abs() <= 1e-8 * kinetic, "{drift} {kinetic}");
    for frame in report["frames"].as_array().expect("frames") {
        let y = frame["q"][7].as_f64().expect("y of the piston");
        assert!(y.abs() <= 1e-12, "{y}");
    }
    for option in ["--change-coordinates", "--through-singular"] {
        folder
            .run(&format!("simulate a.mech {option}"))
            .exits_with(2);
    }
}

/// Free coordinates that move together without moving a mass are named, and only these.
#[test]
fn free_coordinates_that_no_mass_resists_are_named() {
    let text = "mechanism three {
    point O = (0, 0), T = (2, 0);
    body slide at O { S: (0, 0) }
    body one at O turned 90deg { S: (0, 0), P: (0.5, 0) }
    body third at T { T }
    absolute_y(slide) = 0;
    absolute_angle(slide) = 0;
    revolute S(slide, one);
    revolute T(ground, third);
    free a: x(slide.S) = 0;
    free b: phi(one) = 90deg;
    free c: phi(third) = 0;
    mass third = 1kg at T inertia 1;
    mass one = 1kg at P;
    gravity = (0, -9.81);
}
";
    // The mass at P stays where it is while S moves as P turns back about it.
    let folder = Folder::new("simulate_massless", text);
    let ran = folder.run("simulate a.mech --no-files").exits_with(1);
    let named = "no mass resists a motion of the free coordinates `free a: x(slide.S)` and `free b: phi(one)` together";
    assert!(ran.stderr.contains(named), "{}", ran.stderr);
    assert!(!ran.stderr.contains("`free c"), "{}", ran.stderr);
    let alone = text.replace("mass one = 1kg at P;", "mass slide = 1kg at S;");
    let folder = Folder::new("simulate_massless_alone", alone);
    let ran = folder.run("simulate a.mech --no-files").exits_with(1);
    let named = "no mass resists the free coordinate `free b: phi(one)`: write `mass BODY";
    assert!(ran.stderr.contains(named), "{}", ran.stderr);
}

/// An option reports a large number of evaluations: once during the run, and in the summary.
#[test]
fn many_evaluations_are_answered_by_another_method() {
    let text = "mechanism damped {
    point W = (-2, 0), P = (0, 0);
    body mass at P { P }
    absolute_y(mass) = 0;
    absolute_angle(mass) = 0;
    free slide: x(mass) = 0.1;
    mass mass = 2kg;
    spring (ground.W, mass.P) = 50 free 2;
    damper (ground.W, mass.P) = 2e6;
}
";
    let folder = Folder::new("simulate_long", text);
    let ran = folder
        .run("simulate a.mech --no-files --to 0.55 --step 0.55 --method dop853")
        .exits_with(0);
    assert_eq!(
        ran.stderr.matches("million evaluations").count(),
        1,
        "{}",
        ran.stderr
    );
    assert!(
        ran.stderr.contains("= help: `--method implicit`"),
        "{}",
        ran.stderr
    );
    let hint = ran.stdout.lines().find(|line| line.starts_with("  hint "));
    assert!(
        hint.is_some_and(|hint| hint.contains("`--method implicit`")),
        "{}",
        ran.stdout
    );
    let ran = folder
        .run("simulate a.mech --no-files --to 0.55 --step 0.55")
        .exits_with(0);
    assert!(ran.stderr.is_empty(), "{}", ran.stderr);
    assert!(!ran.stdout.contains("hint"), "{}", ran.stdout);
}

/// The message contains the missing statement, in the form of a description of this mechanism.
#[test]
fn a_missing_statement_is_written_out() {
    let driven = PENDULUM.replace(
        "free swing: phi(bob) = 30deg rate 1.5",
        "drive swing: phi(bob) = t",
    );
    let folder = Folder::new("simulate_driven", &driven);
    let ran = folder.run("simulate a.mech").exits_with(2);
    let help = "write `free swing: phi(bob) = START;` in place of `drive swing: phi(bob) = …;`, or";
    assert!(ran.stderr.contains(help), "{}", ran.stderr);
    let massless = driven.replace(
        "mass bob = 3kg at S inertia 0.5;\n    gravity = (0, -9.81);",
        "",
    );
    let folder = Folder::new("simulate_massless_driven", massless);
    let ran = folder.run("simulate a.mech").exits_with(2);
    assert!(ran.stderr.contains("`mass BODY = 2kg;`"), "{}", ran.stderr);
    let loose = PENDULUM.replace("free swing: phi(bob) = 30deg rate 1.5;", "");
    let folder = Folder::new("simulate_loose", loose);
    let ran = folder.run("simulate a.mech").exits_with(2);
    assert!(
        ran.stderr.contains("by `free turn: phi(bob) = 0;`"),
        "{}",
        ran.stderr
    );
}

/// A pendulum on a cart that a signal moves within 10 mm.
const CART: &str = "mechanism pendulum {
    input push = 0mm from -10mm to 10mm;
    point O = (0, 0);
    body cart at (0, 0) { C: (0, 0) }
    body bob at (0, 0, -80deg) { C: (0, 0), P: (500mm, 0) }
    absolute_y(cart) = 0;
    absolute_angle(cart) = 0;
    drive x(cart) = push;
    revolute C(cart, bob);
    free swing: phi(bob) = -80deg;
    mass bob = 1kg at P;
    gravity = (0, -9.81);
}
";

/// The signal passes 10 mm after 0.5 s.
#[test]
fn a_signal_that_leaves_its_range_ends_the_simulation() {
    let folder = Folder::new("simulate_range", CART);
    let run = |law: &str| {
        folder.run(&format!(
            "simulate a.mech --to 1 --step 0.2 --json --set {law}"
        ))
    };
    let report = json(&run("push=9mm*sin(t/1s)").exits_with(0).stdout);
    assert_eq!(report["frames"].as_array().expect("frames").len(), 6);
    let ran = run("push=20mm*t/1s").exits_with(1);
    assert!(
        ran.stderr.contains(
            "cannot be simulated beyond t = 0.4 s: input push: 12 mm is outside of its range from -10 mm to 10 mm"
        ),
        "{}",
        ran.stderr
    );
    let frames = json(&ran.stdout)["frames"]
        .as_array()
        .expect("frames")
        .len();
    assert_eq!(frames, 3);
}

/// A mass falls from rest, and reaches the limit of its height at t = √(2 h / g).
#[test]
fn a_limit_with_stop_ends_the_motion() {
    let folder = Folder::new(
        "simulate_stop",
        "mechanism drop {
    point O = (0, 0), top = (0, 1);
    body mass at O { O, top }
    translational (ground, mass) along O -> top;
    free fall: y(mass) = 0;
    mass mass = 3kg;
    gravity = (0, -9.81);
    measure height = O.y;
    limit height >= -0.5 stop;
}
",
    );
    let ran = folder.run("simulate a.mech --to 2 --step 0.25 --json");
    let report = json(&ran.exits_with(0).stdout);
    let frames = report["frames"].as_array().expect("frames");
    let last = frames[frames.len() - 1]["t"].as_f64().expect("a time");
    let expected = (2.0 * 0.5 / 9.81_f64).sqrt();
    assert!((last - expected).abs() < 1e-9, "{last} and {expected}");
    let warning = report["warnings"][0].as_str().expect("a sentence");
    assert!(
        warning.contains("`height` reaches its limit: at least -0.5 m"),
        "{warning}"
    );
    assert!(report.get("error").is_none());
}
