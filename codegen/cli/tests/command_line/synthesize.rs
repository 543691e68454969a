//! `linkwright synthesize`: what it refuses, where no solution exists, and what its files hold.

use crate::folder::{Folder, Ran};

const LIFTER: &str = "
mechanism lifter {
    units mm, deg;
    param G = 100mm;
    param crank = 30mm;
    param coupler = 100mm;
    param rocker = 80mm from 40mm to 200mm;

    point A = (0, 0), D = (G, 0);
    body 1 at (0, 0, 60deg)       { A: (0, 0), B: (crank, 0) }
    body 2 at (15mm, 26mm, 30deg) { B: (0, 0), C: (coupler, 0) }
    body 3 at (G, 0, 90deg)       { D: (0, 0), C: (rocker, 0) }
    revolute A(ground, 1);
    revolute B(1, 2);
    revolute C(2, 3);
    revolute D(ground, 3);
    drive phi(1) = t*30deg/1s;
    measure transmission = transmission_angle(B, C, D);
}
";

/// Angles of the rocker of 40 mm, 120 mm, 80 mm on a ground link of 100 mm, by the law of cosines.
fn rocker_angle(crank: f64) -> f64 {
    let (x, y) = (100.0 - 40.0 * crank.cos(), -40.0 * crank.sin());
    let diagonal = x.hypot(y);
    let cosine = (diagonal * diagonal + 80.0 * 80.0 - 120.0 * 120.0) / (2.0 * diagonal * 80.0);
    // The direction of D as seen from B, and the angle at D on the side of the estimates.
    (y.atan2(x) + std::f64::consts::PI - cosine.acos()).to_degrees()
}

fn table() -> String {
    let rows = (0..6).map(|t| {
        let angle = rocker_angle((f64::from(t) * 30.0).to_radians());
        format!("{t},{angle}\n")
    });
    format!("t (s),phi3 (deg)\n{}", rows.collect::<String>())
}

fn folder(name: &str) -> Folder {
    let folder = Folder::new(name, LIFTER);
    write(&folder, "angles.csv", &table());
    folder
}

fn write(folder: &Folder, name: &str, text: &str) {
    std::fs::write(folder.file(name), text).expect("the file can be written");
}

fn run(folder: &Folder, command: &str) -> Ran {
    let arguments = command.split_whitespace();
    Ran::from(
        folder
            .command()
            .args(arguments)
            .output()
            .expect("the command starts"),
    )
}

const SEARCH: &str =
    "synthesize a.mech angles.csv --param crank,coupler=10mm..200mm,rocker --samples 512 --fits 12";

/// Three lengths are determined by the angles of a rocker, and found in the assembly mode of the closed form.
#[test]
fn lengths_of_a_closed_form_are_found() {
    let folder = folder("synthesize_found");
    let command = format!("{SEARCH} --turn --solutions 1 --out lifts --json");
    let ran = run(&folder, &command);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let object: serde_json::Value = serde_json::from_str(&ran.stdout).expect("an object");
    let solution = &object["solutions"][0];
    let parameters = solution["parameters"].as_array().expect("parameters");
    for (parameter, expected) in parameters.iter().zip([40.0, 120.0, 80.0]) {
        let value = parameter["value"].as_f64().expect("a number");
        assert!((value - expected).abs() < 1e-6, "{parameter}");
    }
    assert_eq!(solution["modes"]["phi2_phi3"], "negative");
    assert_eq!(
        (object["to"].as_f64(), object["turn"].as_str()),
        (Some(12.0), Some("phi(1)"))
    );
    // What is written moves as the table says, and every command takes it.
    let written = run(
        &folder,
        "compare lifts/lifter_1.mech angles.csv --tolerance 1e-6deg",
    );
    assert_eq!(
        written.code,
        Some(0),
        "{}{}",
        written.stdout,
        written.stderr
    );
    let proven = run(&folder, "check lifts/lifter_1.mech --prove --to 12");
    assert_eq!(proven.code, Some(0), "{}{}", proven.stdout, proven.stderr);
    let again = run(&folder, &command);
    assert_eq!(again.code, Some(2));
    assert!(again.stderr.contains("lifter_1.mech"), "{}", again.stderr);
}

/// The rocker swings below the ground link in the other mode, which the estimates of the description do not draw.
#[test]
fn an_assembly_mode_is_written_into_the_description() {
    let folder = folder("synthesize_mode");
    let rows = (0..6).map(|t| {
        let angle = -rocker_angle((f64::from(-t) * 30.0).to_radians());
        format!("{t},{angle}\n")
    });
    write(
        &folder,
        "angles.csv",
        &format!("t (s),phi3 (deg)\n{}", rows.collect::<String>()),
    );
    let command = format!("{SEARCH} --turn --solutions 1 --tolerance 1e-6deg --out lifts");
    let ran = run(&folder, &command);
    assert_eq!(ran.code, Some(0), "{}{}", ran.stdout, ran.stderr);
    assert!(ran.stdout.contains("positive"), "{}", ran.stdout);
    let written = run(
        &folder,
        "compare lifts/lifter_1.mech angles.csv --tolerance 1e-6deg",
    );
    assert_eq!(
        written.code,
        Some(0),
        "{}{}",
        written.stdout,
        written.stderr
    );
}

#[test]
fn rows_without_times_are_passed_in_their_order() {
    let folder = folder("synthesize_order");
    let rows: Vec<String> = (0..6)
        .map(|t| rocker_angle((f64::from(t) * 30.0 + 7.0).to_radians()).to_string())
        .collect();
    let text = |rows: &[String]| format!("phi3 (deg)\n{}\n", rows.join("\n"));
    write(&folder, "order.csv", &text(&rows));
    let search = "synthesize a.mech order.csv --param crank=10mm..80mm,rocker --samples 512 --fits 12 --solutions 1 --json";
    let ran = run(&folder, search);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let object: serde_json::Value = serde_json::from_str(&ran.stdout).expect("an object");
    assert_eq!(object["timed"], false);
    let times = object["solutions"][0]["t"].as_array().expect("times");
    let times: Vec<f64> = times.iter().filter_map(serde_json::Value::as_f64).collect();
    let first = times.iter().cloned().fold(f64::INFINITY, f64::min);
    let from = times.iter().position(|it| *it == first).expect("a row");
    let in_order: Vec<f64> = (0..6).map(|row| times[(from + row) % 6]).collect();
    assert!(in_order.windows(2).all(|it| it[0] < it[1]), "{times:?}");
}

/// A limit that no four-bar keeps with its crank turning round.
#[test]
fn without_a_solution_the_reason_is_printed() {
    let folder = folder("synthesize_none");
    let limited = LIFTER.replace(
        "transmission_angle(B, C, D);",
        "transmission_angle(B, C, D); limit transmission >= 89deg;",
    );
    write(&folder, "a.mech", &limited);
    let ran = run(&folder, &format!("{SEARCH} --turn"));
    assert_eq!(ran.code, Some(1), "{}", ran.stdout);
    assert!(
        ran.stderr.contains("no solution is found for `lifter`"),
        "{}",
        ran.stderr
    );
    // Solutions that leave differences are listed, and fail the tolerance.
    write(&folder, "a.mech", LIFTER);
    write(&folder, "angles.csv", "t,phi3 (deg)\n0,90\n1,30\n2,150\n");
    let ran = run(&folder, &format!("{SEARCH} --tolerance 0.1deg"));
    assert_eq!(ran.code, Some(1), "{}", ran.stdout);
    assert!(ran.stdout.contains(", beyond"), "{}", ran.stdout);
    assert!(
        ran.stderr.contains("no solution meets all targets"),
        "{}",
        ran.stderr
    );
}

#[test]
fn bad_input_is_refused_with_its_reason() {
    let folder = folder("synthesize_refused");
    write(&folder, "effort.csv", "t,phi3_dd (rad/s²)\n0,1\n");
    write(&folder, "measure.csv", "transmission (deg)\n40\n50\n");
    write(&folder, "empty.csv", "t,phi3\n");
    let all = "crank,coupler=10mm..200mm,rocker";
    for (command, reason) in [
        (
            "angles.csv".to_string(),
            "no parameter of `lifter` is to be chosen",
        ),
        (
            "angles.csv --param cranck=1mm..2mm".to_string(),
            "did you mean `crank`?",
        ),
        (
            "angles.csv --param crank".to_string(),
            "has no bounds within which",
        ),
        ("angles.csv --param crank=2mm..1mm".to_string(), "is empty"),
        (
            "angles.csv --param crank=1mm..2kg".to_string(),
            "not a number with a unit",
        ),
        (
            "angles.csv --param crank=1mm..2mm,crank".to_string(),
            "names `crank` twice",
        ),
        (
            "angles.csv --param rocker=1mm..2mm".to_string(),
            "exceeds the range of `rocker`",
        ),
        (
            format!("angles.csv --param {all} --to 3"),
            "lies outside of the motion",
        ),
        (
            format!("angles.csv --param {all} --tolerance 0deg"),
            "is zero",
        ),
        (
            format!("effort.csv --param {all}"),
            "whose dependence on parameters is not derived",
        ),
        (
            format!("measure.csv --param {all}"),
            "is a measure, and the rows have no times",
        ),
        (format!("empty.csv --param {all}"), "is a row of numbers"),
    ] {
        let ran = run(&folder, &format!("synthesize a.mech {command}"));
        assert_eq!(ran.code, Some(2), "{command}: {}{}", ran.stdout, ran.stderr);
        assert!(ran.stderr.contains(reason), "{command}: {}", ran.stderr);
        assert!(ran.stderr.contains("help: "), "{command}: {}", ran.stderr);
    }
}
