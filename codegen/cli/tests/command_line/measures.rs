//! Measures and limits of a description in the results of commands.

use serde_json::Value;

use crate::folder::Folder;

const LIFT: &str = "mechanism lift {
    units mm;
    point O = (0, 0);
    body arm at O { O, A: (100mm, 0) }
    revolute O(ground, arm);
    drive turn: phi(arm) = 2*t;
    measure height = A.y;
    measure steepness = rate(height);
    limit height <= 90mm;
}";

/// The arm is highest at φ = π/2, between frames, and reaches 90 mm at sin φ = 0.9.
#[test]
fn check_reports_extremes_and_fails_where_a_limit_is_broken() {
    let folder = Folder::new("limits", LIFT);
    let ran = folder.run("check a.mech --to 3 --step 500ms --json");
    let ran = ran.exits_with(1);
    let check: Value = serde_json::from_str(&ran.stdout).expect("JSON");
    let close = |value: &Value, expected: f64| {
        let value = value.as_f64().expect("a number");
        assert!((value - expected).abs() < 1e-6, "{value} and {expected}");
    };
    let height = &check["measures"][0];
    assert_eq!(
        (&height["measure"], &height["unit"]),
        (&"height".into(), &"mm".into())
    );
    close(&height["largest"]["value"], 100.0);
    close(&height["largest"]["t"], std::f64::consts::FRAC_PI_4);
    close(&height["smallest"]["value"], -100.0);
    let broken = &check["broken_limits"][0];
    close(&broken["beyond"], 10.0);
    let first = 0.5 * 0.9_f64.asin();
    close(&broken["intervals"][0][0], first);
    close(
        &broken["intervals"][0][1],
        std::f64::consts::FRAC_PI_2 - first,
    );
    assert_eq!(broken["intervals"].as_array().map(Vec::len), Some(1));
    // Up to there the limit holds, which is proven.
    let ran = folder.run("check a.mech --to 550ms --prove").exits_with(0);
    assert!(
        ran.stdout
            .contains("limit of height, at most 90 mm: never broken"),
        "{}",
        ran.stdout
    );
}

#[test]
fn solve_writes_measures_and_draws_one_column_against_another() {
    let folder = Folder::new("measured", LIFT);
    let ran = folder
        .run("solve a.mech --to 3 --curve height,steepness --out results")
        .exits_with(0);
    assert!(
        ran.stderr.contains("warning: height is ")
            && ran.stderr.contains("beyond its limit: at most 90 mm"),
        "{}",
        ran.stderr
    );
    assert!(
        ran.stdout.contains("\nmeasures\n  height"),
        "{}",
        ran.stdout
    );
    let table = folder.read("results/motion.csv");
    let header = table
        .lines()
        .find(|it| it.starts_with("t"))
        .expect("a header");
    assert!(
        header.contains("height (mm)") && header.contains("steepness (mm/s)"),
        "{header}"
    );
    let picture = folder.read("results/height_steepness.svg");
    assert!(
        picture.contains("steepness (mm/s)") && picture.contains("height (mm)"),
        "{picture}"
    );
    let ran = folder
        .run("solve a.mech --curve height,heigt")
        .exits_with(2);
    assert!(
        ran.stderr.contains("did you mean `height`?"),
        "{}",
        ran.stderr
    );
    let ran = folder.run("solve a.mech --curve height").exits_with(2);
    assert!(ran.stderr.contains("write two columns"), "{}", ran.stderr);
    // Frames of JSON have the measures beside their names, and the root of the mean square of a whole turn is 1/√2.
    let ran = folder.run("solve a.mech --to 3.14 --json").exits_with(0);
    let motion: Value = serde_json::from_str(&ran.stdout).expect("JSON");
    assert_eq!(
        motion["measures"][1],
        serde_json::json!(["steepness", "mm/s"])
    );
    let frame = &motion["frames"][100];
    let t = frame["t"].as_f64().expect("a time");
    let height = frame["measures"][0].as_f64().expect("a value");
    assert!((height - 100.0 * (2.0 * t).sin()).abs() < 1e-9);
    let rms = motion["extremes"][0]["rms"].as_f64().expect("a value");
    assert!((rms - 100.0 / 2_f64.sqrt()).abs() < 0.1, "{rms}");
}
