//! `linkwright solve` where a motion ends or comes close to a singular pose.

use crate::folder::{EXAM, Folder, driven_by};
use crate::printed::{json, number};
use serde_json::Value;

/// When the pose of a warning is passed, in s.
fn warned_time(warning: &str) -> f64 {
    let time = warning.split(" at t = ").nth(1);
    let time = time.and_then(|rest| rest.split(' ').next()?.parse().ok());
    time.unwrap_or_else(|| panic!("{warning}"))
}

#[test]
fn the_rod_that_folds_ends_the_motion() {
    let folder = Folder::new("fold", driven_by("t"));
    let ran = folder.run("solve a.mech --json").exits_with(1);
    let object = json(&ran.stdout);
    assert_eq!(object["frames"].as_array().map(Vec::len), Some(158));
    let error = object["error"].as_str().expect("a sentence");
    let time = error
        .strip_prefix("cannot be solved beyond t = ")
        .and_then(|rest| rest.split(' ').next())
        .and_then(|time| time.parse::<f64>().ok())
        .unwrap_or_else(|| panic!("{error}"));
    assert!((time - std::f64::consts::FRAC_PI_2).abs() < 1e-8, "{error}");
    assert!(
        error.contains("revolute P(1, 2): out of reach by "),
        "{error}"
    );
    let place =
        " m, beyond where the line from P to the origin of body 2 is parallel to the x axis";
    assert!(error.ends_with(place), "{error}");
    // All equations at once know no loop, but every joint that ends the motion.
    let ran = folder.run("solve a.mech --json --formulation textbook");
    let dense = json(&ran.exits_with(1).stdout)["error"].clone();
    let dense = dense.as_str().expect("a sentence");
    for text in [
        "cannot be solved beyond t = 1.57079632",
        "Φ_q is singular",
        "revolute P(1, 2)",
        "drive phi(1)",
        "can move: 2",
    ] {
        assert!(dense.contains(text), "{text} in {dense}");
    }
    let ran = folder.run("solve a.mech").exits_with(1);
    assert!(ran.stderr.contains(error), "{}", ran.stderr);
    assert_eq!(folder.read("two_body/motion.csv").lines().count(), 159);
}

#[test]
fn a_pose_close_to_singular_is_found_between_frames() {
    // The crank comes within 1e-7 rad of the fold at t = 1.00325, between two frames, and turns back.
    let folder = Folder::new("close", driven_by("pi/2 - 1e-7 - (t - 1.00325)^2/2"));
    let ran = folder
        .run("solve a.mech --json --to 2 --step 0.0005")
        .exits_with(0);
    let warnings = json(&ran.stdout)["warnings"].clone();
    let [Value::String(warning)] = warnings.as_array().expect("an array").as_slice() else {
        panic!("{warnings}");
    };
    assert!(warning.starts_with("block 2, phi2: only "), "{warning}");
    assert!((warned_time(warning) - 1.00325).abs() < 1e-6, "{warning}");
    let place = "the line from P to the origin of body 2 is parallel to the x axis.";
    assert!(warning.ends_with(place), "{warning}");
    let ran = folder
        .run("solve a.mech --to 2 --step 0.0005")
        .exits_with(0);
    assert_eq!(ran.stderr, format!("warning: {warning}\n"));
}

/// As before, but closer to the fold than a step of 0.01 can resolve: without sub-steps the rod would come out on the other
/// side. cos φ2 = 1 − cos φ1/√3 with φ2 positive, all along.
#[test]
fn a_step_does_not_lead_into_another_assembly_mode() {
    let folder = Folder::new("jump", driven_by("pi/2 - 1e-8 - (t - 1.003)^2/2"));
    let ran = folder.run("solve a.mech --json --to 2").exits_with(0);
    let object = json(&ran.stdout);
    let frames = object["frames"].as_array().expect("a list");
    assert_eq!(frames.len(), 201);
    for frame in frames {
        let t = number(&frame["t"]);
        // cos φ1 = sin(π/2 − φ1).
        let cosine = (1e-8 + (t - 1.003).powi(2) / 2.0).sin();
        // 1 − cos φ2 = 2 sin²(φ2/2).
        let expected = 2.0 * (cosine / (2.0 * 3.0_f64.sqrt())).sqrt().asin();
        let solved = number(&frame["q"][5]);
        assert!(
            (solved - expected).abs() < 1e-10 / expected,
            "{t}: {solved} {expected}"
        );
    }
    let warning = object["warnings"][0].as_str().expect("a sentence");
    assert!(warning.starts_with("block 2, phi2: only "), "{warning}");
    assert!((warned_time(warning) - 1.003).abs() < 1e-8, "{warning}");
}

#[test]
fn a_determinant_that_changes_its_sign_is_located() {
    let text = "mechanism parallelogram {
        body crank at (0, 0, 0.5) { O: (0, 0), A: (1, 0) }
        body coupler at (0.877, 0.479, 0) { A: (0, 0), B: (2, 0) }
        body rocker at (2, 0, 0.5) { C: (0, 0), B: (1, 0) }
        absolute_x(crank) = 0;
        absolute_y(crank) = 0;
        revolute A(crank, coupler);
        revolute B(coupler, rocker);
        absolute_x(rocker) = 2;
        absolute_y(rocker) = 0;
        drive phi(crank) = 0.5 + t;
    }";
    let folder = Folder::new("crossing", text);
    let ran = folder.run("solve a.mech --json").exits_with(0);
    let warnings = json(&ran.stdout)["warnings"].clone();
    let warning = warnings[0].as_str().expect("a sentence");
    assert!(
        warning.starts_with("block 2, phi_coupler and phi_rocker: "),
        "{warning}"
    );
    assert!(
        (warned_time(warning) - (std::f64::consts::PI - 0.5)).abs() < 1e-7,
        "{warning}"
    );
    assert!(warning.ends_with("A-B and B-C are collinear."), "{warning}");
}

/// x (t − 1.05) = (1 + t) (t − 1.05): the equation does not determine the continuation of the slider.
#[test]
fn a_coefficient_that_changes_its_sign_ends_the_motion() {
    let text = "mechanism crossing {
        body 1 at (1, 0) { P: (0, 0) }
        absolute_y(1) = 0;
        absolute_angle(1) = 0;
        equation P.x*(t - 1.05) = (t - 1.05)*(1m + t*1m);
    }";
    let folder = Folder::new("passing", text);
    let ran = folder
        .run("solve a.mech --json --to 2 --step 0.3")
        .exits_with(1);
    let error = json(&ran.stdout)["error"].clone();
    let error = error.as_str().expect("a sentence");
    let time = error.strip_prefix("cannot be solved beyond t = ");
    let time = time.and_then(|rest| rest.split(' ').next()?.parse::<f64>().ok());
    assert!((time.expect("a time") - 1.05).abs() < 1e-6, "{error}");
    assert!(
        error.contains("equation 1: nothing determines body 1"),
        "{error}"
    );
}

#[test]
fn a_drawing_that_cannot_be_assembled_is_explained() {
    let folder = Folder::new(
        "apart",
        EXAM.replace("absolute_x(2) = sqrt(3)", "absolute_x(2) = 4"),
    );
    let ran = folder.run("solve a.mech").exits_with(1);
    assert!(
        ran.stderr.contains(
            "cannot be assembled in the design modes at t = 0 s: revolute P(1, 2): out of reach by "
        ),
        "{}",
        ran.stderr
    );
    let ran = folder
        .run("solve a.mech --formulation textbook")
        .exits_with(1);
    assert!(
        ran.stderr.contains("cannot be assembled at t = 0 s"),
        "{}",
        ran.stderr
    );
    assert!(
        ran.stderr
            .contains("the design configuration violates `absolute_x(2)` most, by 2.3e+00 m"),
        "{}",
        ran.stderr
    );
    let ran = folder.run("solve a.mech --json").exits_with(1);
    let object = json(&ran.stdout);
    assert_eq!(object["frames"], Value::Array(Vec::new()));
    assert!(object["error"].is_string());
}

/// A slider that pushes crank and rod to their dead centre, where 0.1 + l = 0.48 + 0.05 t with l² = 0.4² + 0.06².
#[test]
fn the_loop_that_ends_a_motion_is_named_on_its_own_branch() {
    let folder = Folder::new(
        "dead_centre",
        "mechanism dead {
    point A = (0, 0), P = (0.08, 0.06), S = (0.48, 0);
    body crank at A facing A -> P { A, P }
    body rod at P facing P -> S { P, S }
    body slider at S { S }
    revolute A(ground, crank);
    revolute P(crank, rod);
    revolute S(rod, slider);
    absolute_y(slider) = 0;
    absolute_angle(slider) = 0;
    drive slider.x = 0.48 + 0.05*t;
}
",
    );
    let end = (0.1 + f64::hypot(0.4, 0.06) - 0.48) / 0.05;
    for branch in ["", "--branch phi_crank_phi_rod=other"] {
        let ran = folder.run(&format!("solve a.mech --json {branch}"));
        let error = json(&ran.exits_with(1).stdout)["error"].clone();
        let error = error.as_str().expect("a sentence");
        let time = error
            .strip_prefix("cannot be solved beyond t = ")
            .and_then(|rest| rest.split_once(" s: "))
            .unwrap_or_else(|| panic!("{error}"));
        let seconds: f64 = time.0.parse().expect("a time");
        assert!((seconds - end).abs() <= 1.5e-9, "{error}");
        let cause = time.1;
        assert!(cause.starts_with("loop A-P-S: out of reach by "), "{error}");
        assert!(
            cause.ends_with(" m, beyond where crank and rod are collinear"),
            "{error}"
        );
    }
}

#[test]
fn a_driver_that_ends_is_named() {
    let folder = Folder::new("driver", driven_by("ln(1 - t)"));
    let ran = folder.run("solve a.mech --json").exits_with(1);
    let error = json(&ran.stdout)["error"].clone();
    let error = error.as_str().expect("a sentence");
    assert!(error.contains("beyond t = "), "{error}");
    let folder = Folder::new("driver", driven_by("1 + t*sqrt(1 - t)/10"));
    for (view, cause) in [
        ("", "drive phi(1): a number is not finite"),
        (
            "--formulation textbook",
            "a time derivative of `drive phi(1)` is not finite",
        ),
    ] {
        let ran = folder.run(&format!("solve a.mech --json {view}"));
        let error = json(&ran.exits_with(1).stdout)["error"].clone();
        let error = error.as_str().expect("a sentence");
        let time = error
            .strip_prefix("cannot be solved beyond t = ")
            .and_then(|rest| rest.split(' ').next()?.parse::<f64>().ok())
            .unwrap_or_else(|| panic!("{error}"));
        assert!((time - 1.0).abs() <= 1.5e-9, "{error}");
        assert!(error.contains(cause), "{error}");
    }
}
