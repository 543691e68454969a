//! `linkwright travel` from the outside: ends with closed forms, their digits, and refusals.

use serde_json::Value;

use crate::check::described;
use crate::folder::Folder;
use crate::printed::{json, number};

/// Links of the four-bar that is not Grashof: ground, crank, coupler and rocker.
const LINKS: [f64; 4] = [100.0, 80.0, 60.0, 70.0];

/// Four-bar whose crank swings between two dead points, in a unit of length.
fn rocker(unit: &str, value: &str) -> String {
    let [ground, crank, coupler, rocker] = LINKS;
    format!(
        "mechanism swing {{
    point A = (0, 0), D = ({ground}{unit}, 0);
    body crank   at (0{unit}, 0{unit}, 40deg)        {{ A: (0, 0), B: ({crank}{unit}, 0) }}
    body coupler at (60{unit}, 50{unit}, 20deg)      {{ B: (0, 0), C: ({coupler}{unit}, 0) }}
    body rocker  at ({ground}{unit}, 0{unit}, 80deg) {{ D: (0, 0), C: ({rocker}{unit}, 0) }}
    revolute A(ground, crank);
    revolute B(crank, coupler);
    revolute C(coupler, rocker);
    revolute D(ground, rocker);
    drive phi(crank) = {value};
}}
"
    )
}

/// Angle of the crank (degrees) where coupler and rocker are in line, by the law of cosines.
fn dead_angle() -> f64 {
    let [ground, crank, coupler, rocker] = LINKS;
    let cosine =
        (ground * ground + crank * crank - (coupler + rocker).powi(2)) / (2.0 * ground * crank);
    cosine.acos().to_degrees()
}

/// JSON object of `travel` of the description in the folder.
#[track_caller]
fn travel(folder: &Folder, drive: &str, options: &str) -> Value {
    let mut command = folder.command();
    command.args(["travel", "a.mech", "--json", "--drive", drive]);
    command.args(options.split_whitespace());
    let output = command.output().expect("the command starts");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{errors}");
    json(&String::from_utf8_lossy(&output.stdout))
}

/// Checks the kind of an end, and its value: within one unit of its last decimal, of which there are at least so many.
#[track_caller]
fn ends(end: &Value, kind: &str, expected: f64, least: u64) {
    assert_eq!(end["end"], kind, "{end}");
    let decimals = end["decimals"].as_u64().expect("verified decimals");
    assert!(decimals >= least, "{end}");
    let digit = 10_f64.powi(-i32::try_from(decimals).expect("few"));
    let off = number(&end["value"]) - expected;
    // Of conversions, the closed form and the value are each rounded.
    let rounding = 4.0 * f64::EPSILON * expected.abs().max(1.0);
    assert!(off.abs() <= digit + rounding, "{end}, not {expected}");
    if end["inside"] == true {
        let beyond = if end["way"] == "up" { off } else { -off };
        assert!(beyond <= rounding, "{end} is beyond {expected}");
    }
}

#[test]
fn a_crank_swings_between_its_dead_points_at_any_scale() {
    for (name, unit) in [("mm", "mm"), ("km", "e3"), ("micro", "e-6")] {
        let folder = Folder::new(&format!("travel_{name}"), rocker(unit, "40deg + 3*t"));
        let report = travel(&folder, "phi(crank)", "");
        ends(&report["ends"][0], "reach", dead_angle(), 10);
        ends(&report["ends"][1], "reach", -dead_angle(), 10);
        let words = report["ends"][0]["words"].as_str().expect("words");
        assert!(
            words.contains("coupler and rocker are collinear"),
            "{words}"
        );
    }
}

#[test]
fn a_drive_starts_at_its_end_and_anywhere_before() {
    // cos φ = (100² + 80² − 130²)/(2·100·80) = -1/32 at the end.
    for (name, value) in [
        ("end", "acos(-1/32)"),
        ("near", "91.79deg"),
        ("far", "-91.79deg"),
    ] {
        let folder = Folder::new(&format!("travel_from_{name}"), rocker("mm", value));
        let report = travel(&folder, "phi(crank)", "");
        let [up, down] = [&report["ends"][0], &report["ends"][1]];
        ends(up, "reach", dead_angle(), 9);
        ends(down, "reach", -dead_angle(), 9);
    }
}

#[test]
fn the_path_to_a_dead_point_is_proven_in_the_printed_digits() {
    let folder = Folder::new("travel_proven", rocker("mm", "40deg"));
    let report = travel(&folder, "phi(crank)", "--prove");
    for (end, sign) in [(&report["ends"][0], 1.0), (&report["ends"][1], -1.0)] {
        ends(end, "reach", sign * dead_angle(), 9);
        assert_eq!(end["proof"]["status"], "proven");
        let off = number(&end["proof"]["to"]) - number(&end["value"]);
        assert!(off.abs() < 1e-12, "{end}");
    }
}

#[test]
fn a_slider_ends_at_the_sum_and_the_difference_of_the_links() {
    let text = "mechanism lift {
    point A = (0, 0), B = (30mm, 30mm), C = (120mm, 0);
    body crank at A facing A -> B { A, B }
    body rod at B facing B -> C { B, C }
    body piston at C { C }
    revolute A(ground, crank);
    revolute B(crank, rod);
    revolute C(rod, piston);
    absolute_y(piston) = 0;
    absolute_angle(piston) = 0;
    drive x(piston) = 120mm + 10mm*t;
}
";
    let folder = Folder::new("travel_slider", text);
    let report = travel(&folder, "x(piston)", "");
    let (crank, rod) = (1800_f64.sqrt(), 9000_f64.sqrt());
    ends(&report["ends"][0], "reach", crank + rod, 9);
    ends(&report["ends"][1], "reach", rod - crank, 9);
    assert_eq!(report["unit"], "mm");
    // In other units, the decimals are those of the unit.
    let report = travel(&folder, "x(piston)", "--units=m");
    ends(&report["ends"][0], "reach", 1e-3 * (crank + rod), 12);
    // The drive stands where its law is at the requested time.
    let later = travel(&folder, "x(piston)", "--at 1");
    assert_eq!(number(&later["start"]), 130.0);
    ends(&later["ends"][1], "reach", rod - crank, 9);
}

#[test]
fn the_other_drives_keep_their_values() {
    let text = rocker("mm", "60deg + 5deg*t")
        .replace(
            "point A = (0, 0), D = (100mm, 0);",
            "point A = (0, 0);\n    body base at (100mm, 0) { O: (0, 0) }",
        )
        .replace(
            "revolute D(ground, rocker);",
            "revolute (base.O, rocker.D);
    absolute_x(base) = 100mm;
    absolute_angle(base) = 0;
    drive lift: y(base) = 10mm*t;",
        );
    let folder = Folder::new("travel_others", text);
    let [_, crank, coupler, rocker] = LINKS;
    let ground = 100_f64.hypot(20.0);
    let cosine =
        (ground * ground + crank * crank - (coupler + rocker).powi(2)) / (2.0 * ground * crank);
    let [swing, tilt] = [cosine.acos().to_degrees(), 0.2_f64.atan().to_degrees()];
    let report = travel(&folder, "phi(crank)", "--at 2");
    ends(&report["ends"][0], "reach", tilt + swing, 10);
    ends(&report["ends"][1], "reach", tilt - swing, 10);
}

#[test]
fn a_limit_ends_the_travel_of_a_crank_that_would_turn_round() {
    let plain = described("four_bar");
    let folder = Folder::new("travel_round", &plain);
    let report = travel(&folder, "phi(crank)", "");
    assert_eq!(report["turns_round"], true);
    assert_eq!(report["ends"][0]["turns"], 1);
    let limit = "    measure height = B.y;\n    limit height from 0mm to 30mm;\n}\n";
    let closing = plain.trim_end().strip_suffix('}').expect("a mechanism");
    let folder = Folder::new("travel_limit", format!("{closing}{limit}"));
    let report = travel(&folder, "phi(crank)", "");
    let height = 0.75_f64.asin().to_degrees();
    ends(&report["ends"][0], "limit", height, 10);
    ends(&report["ends"][1], "limit", 0.0, 10);
    assert_eq!(report["ends"][0]["measure"], "height");
}

#[test]
fn a_parallelogram_ends_at_its_change_points() {
    let text = described("four_bar")
        .replace("(120mm, 0), P", "(100mm, 0), P")
        .replace("C: (80mm, 0)", "C: (40mm, 0)")
        .replace("20deg)        {", "0deg)        {")
        .replace("57deg)", "40deg)");
    let folder = Folder::new("travel_parallelogram", text);
    let report = travel(&folder, "phi(crank)", "");
    ends(&report["ends"][0], "change_point", 180.0, 4);
    ends(&report["ends"][1], "change_point", 0.0, 4);
}

#[test]
fn a_platform_without_a_closed_form_ends_at_a_dead_point() {
    let text = described("platform_3rpr");
    let folder = Folder::new("travel_platform", &text);
    let report = travel(&folder, "length(A, P)", "--prove");
    for end in [&report["ends"][0], &report["ends"][1]] {
        assert_eq!(end["end"], "dead_point");
        assert!(end["decimals"].as_u64().is_some_and(|it| it >= 9), "{end}");
        assert_eq!(end["proof"]["status"], "proven", "{end}");
        // A motion to just beyond the end cannot be solved.
        let (start, value) = (number(&report["start"]), number(&end["value"]));
        let beyond = if end["way"] == "up" { 1e-9 } else { -1e-9 };
        let law = format!("{start} + {}*t;", value + beyond - start);
        let moved = text.replace("distance(A, P) + 0.08*sin(t);", &law);
        let folder = Folder::new("travel_platform_beyond", moved);
        folder.run("solve a.mech --to 1 --no-files").exits_with(1);
    }
}

#[test]
fn a_range_of_the_input_that_drives_ends_the_travel() {
    let text = rocker("mm", "angle").replace(
        "point A",
        "input angle = 40deg from -30deg to 60deg;\n    point A",
    );
    let folder = Folder::new("travel_range", text);
    let report = travel(&folder, "phi(crank)", "");
    ends(&report["ends"][0], "refused", 60.0, 9);
    ends(&report["ends"][1], "refused", -30.0, 9);
}

#[test]
fn unknown_drives_and_open_loops_are_refused() {
    let folder = Folder::new("travel_refused", rocker("mm", "100deg"));
    let ran = folder.run("travel a.mech --drive phi(crank)").exits_with(1);
    let expected = "cannot be assembled in the design modes at t = 0 s: loop B-C-D: out of reach";
    assert!(ran.stderr.contains(expected), "{}", ran.stderr);
    let ran = folder
        .run("travel a.mech --drive phi(rocket)")
        .exits_with(2);
    assert!(
        ran.stderr.contains("no driver named `phi(rocket)`"),
        "{}",
        ran.stderr
    );
    assert!(ran.stderr.contains("`phi(crank)`"), "{}", ran.stderr);
    folder.run("travel a.mech").exits_with(2);
}

#[test]
fn the_report_names_the_block_and_what_is_verified() {
    let folder = Folder::new("travel_text", rocker("mm", "40deg"));
    let ran = folder.run("travel a.mech --drive phi(crank)").exits_with(0);
    for line in [
        "travel of phi(crank) from 40 deg, with all else as at t = 0 s",
        "end of reach, loop B-C-D cannot be closed beyond; there coupler and rocker are collinear",
        "verified: a pose exists at the value of each end, and the travel is over one digit further",
    ] {
        assert!(ran.stdout.contains(line), "{}", ran.stdout);
    }
}
