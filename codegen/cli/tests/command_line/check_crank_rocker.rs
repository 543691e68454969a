//! Ranges of time that `linkwright check` examines and proves, for crank-rockers and parallelograms.

use serde_json::Value;

use crate::check::{close, described, object};
use crate::folder::{EXAM, Folder};
use crate::printed::number;

/// A crank-rocker with links of 35, 100, 75 and 90 mm, whose crank is at φ(t).
fn crank_rocker(drive: &str) -> String {
    format!(
        "mechanism a {{
    point A = (0, 0), D = (90mm, 0);
    body crank   at (0, 0, 30deg)       {{ A: (0, 0), B: (35mm, 0) }}
    body coupler at (30mm, 18mm, 30deg) {{ B: (0, 0), C: (100mm, 0) }}
    body rocker  at (90mm, 0, 70deg)    {{ D: (0, 0), C: (75mm, 0) }}
    revolute A(ground, crank);
    revolute B(crank, coupler);
    revolute C(coupler, rocker);
    revolute D(ground, rocker);
    drive phi(crank) = {drive};
}}
"
    )
}

/// The sine of the smallest transmission angle, cos μ = (b² + c² − (g − a)²) / 2bc, where the crank lies along the ground link.
fn smallest_transmission() -> f64 {
    let cosine = (0.1_f64.powi(2) + 0.075_f64.powi(2) - 0.055_f64.powi(2)) / (2.0 * 0.1 * 0.075);
    (1.0 - cosine * cosine).sqrt()
}

/// The range is shorter than the step.
#[test]
fn a_range_within_one_step_is_examined() {
    let text =
        crank_rocker("-30deg + 150*t").replace("at (30mm, 18mm, 30deg)", "at (30mm, -18mm, 45deg)");
    let folder = Folder::new(
        "check_short",
        text.replace("at (0, 0, 30deg)", "at (0, 0, -30deg)"),
    );
    let report = object(&folder, "--to 0.008", 0);
    let closest = &report["blocks"][0]["closest"];
    close("t", &closest["t"], std::f64::consts::PI / 6.0 / 150.0, 1e-9);
    close("sine", &closest["measure"], smallest_transmission(), 1e-12);
    assert_eq!(closest["at_end"], false);
}

/// The crank turns ten times in a second: it is along the ground link at (k + 11/12) / 10 s.
#[test]
fn equal_minima_are_counted_and_the_first_is_named() {
    let folder = Folder::new("check_many", crank_rocker("30deg + 20*pi*t"));
    let report = object(&folder, "--to 20 --step 0.005", 0);
    let closest = &report["blocks"][0]["closest"];
    close("sine", &closest["measure"], smallest_transmission(), 1e-12);
    close("t", &closest["t"], 11.0 / 120.0, 1e-9);
    assert_eq!(closest["times"], 200);
}

#[test]
fn the_rest_of_the_last_step_is_examined() {
    let folder = Folder::new("check_rest", crank_rocker("30deg + 20*pi*t"));
    let ran = folder
        .run("check a.mech --to 0.25 --step 0.03")
        .exits_with(0);
    assert!(
        ran.stdout.contains("from t = 0 s to 0.25 s"),
        "{}",
        ran.stdout
    );
    // It is along the ground link at 0.992 s, in the last step alone.
    let report = object(&folder, "--from 0.93 --to 0.9925 --step 0.05", 0);
    close(
        "t",
        &report["blocks"][0]["closest"]["t"],
        119.0 / 120.0,
        1e-9,
    );
}

/// Requires that one range lies in another, and is not more than a tenth wider.
#[track_caller]
fn encloses(found: &Value, [low, high]: [f64; 2]) {
    let [least, most] = [number(&found[0]), number(&found[1])];
    assert!(least <= low && high <= most, "{found} around {low}, {high}");
    assert!(
        most - least <= 1.1 * (high - low),
        "{found} around {low}, {high}"
    );
}

/// The rocker turns back at poses with collinear crank and coupler: (b ∓ a)² = g² + c² + 2 g c cos ψ, with ψ from the
/// line D to A on.
#[test]
fn a_turning_crank_rocker_is_proven() {
    let folder = Folder::new("check_prove", crank_rocker("30deg + 20*pi*t"));
    let report = object(&folder, "--to 0.3 --prove", 0);
    let proof = &report["proof"];
    assert_eq!(proof["status"], "proven");
    let least = number(&proof["determinants"][0]["at_least"]);
    let exact = smallest_transmission();
    assert!(0.5 * exact <= least && least <= exact, "{least} of {exact}");
    let psi = |span: f64| {
        let cosine = (0.09_f64.powi(2) + 0.075_f64.powi(2) - span * span) / (2.0 * 0.09 * 0.075);
        std::f64::consts::PI - cosine.acos()
    };
    encloses(
        &proof["coordinates"]["phi_rocker"],
        [psi(0.135), psi(0.065)],
    );
    encloses(
        &proof["coordinates"]["phi_crank"],
        [
            std::f64::consts::PI / 6.0,
            std::f64::consts::PI * (1.0 / 6.0 + 6.0),
        ],
    );
    let text = folder
        .run("check a.mech --to 0.3 --prove")
        .exits_with(0)
        .stdout;
    assert!(
        text.contains("proven: `a` moves on one smooth path from t = 0 s to 0.3 s"),
        "{text}"
    );
}

/// The pose is singular if crank and rod of the exam are collinear.
#[test]
fn motion_to_a_singular_pose_is_not_proven() {
    let folder = Folder::new(
        "check_unproven",
        EXAM.replace("pi/6 + sin(2*t)", "pi/6 + t"),
    );
    let report = object(&folder, "--prove", 1);
    let proof = &report["proof"];
    assert_eq!(proof["status"], "sampled");
    let end = std::f64::consts::FRAC_PI_3;
    let window = &proof["unproven"];
    let [from, to] = [number(&window["from"]), number(&window["to"])];
    assert!(from <= end && end - from < 1e-2 && from <= to, "{window}");
    let ran = folder.run("check a.mech --prove").exits_with(1);
    assert!(ran.stdout.contains("*sampled*"), "{}", ran.stdout);
    // Before it the motion is one smooth path.
    let report = object(&folder, "--to 1 --prove", 0);
    assert_eq!(report["proof"]["status"], "proven");
}

/// A parallelogram moves straight through its change point, but its equations do not imply that.
#[test]
fn a_change_point_is_not_proven() {
    let text = "mechanism a {
    point A = (0, 0), D = (1, 0);
    body crank    at (0, 0, 90deg) { A: (0, 0), B: (0.3, 0) }
    body coupler  at (0, 0.3, 0)   { B: (0, 0), C: (1, 0) }
    body follower at (1, 0, 90deg) { D: (0, 0), C: (0.3, 0) }
    revolute A(ground, crank);
    revolute B(crank, coupler);
    revolute C(coupler, follower);
    revolute D(ground, follower);
    drive phi(crank) = pi/2 + 2*pi*t;
}
";
    let folder = Folder::new("check_change", text);
    let proof = object(&folder, "--to 0.2 --prove", 0);
    assert_eq!(proof["proof"]["status"], "proven");
    let report = object(&folder, "--to 0.4 --step 0.02 --prove", 1);
    let window = &report["proof"]["unproven"];
    let [from, to] = [number(&window["from"]), number(&window["to"])];
    assert!(from <= 0.25 && 0.25 <= to + 1e-3, "{window}");
}

#[test]
fn points_are_those_of_a_proof() {
    let folder = Folder::new("check_points", described("excavator"));
    let report = object(&folder, "--to 0.2 --prove --points K", 0);
    let points = report["proof"]["points"].as_object().expect("points");
    assert_eq!(points.keys().collect::<Vec<_>>(), ["K"]);
    folder.run("check a.mech --points K").exits_with(2);
    folder
        .run("check a.mech --prove --points Kay")
        .exits_with(2);
}
