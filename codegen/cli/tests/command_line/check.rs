//! `linkwright check` from the outside: distances of motions from singular poses, output, and exit codes.

use serde_json::Value;

use crate::folder::{EXAM, Folder};
use crate::printed::{json, number};

/// JSON object of `check` with these options.
#[track_caller]
pub fn object(folder: &Folder, options: &str, code: i32) -> Value {
    let ran = folder
        .run(&format!("check a.mech --json {options}"))
        .exits_with(code);
    json(&ran.stdout)
}

#[track_caller]
pub fn close(what: &str, found: &Value, wanted: f64, tolerance: f64) {
    let value = number(found);
    assert!(
        (value - wanted).abs() <= tolerance,
        "{what}: {value} instead of {wanted}"
    );
}

pub fn described(name: &str) -> String {
    let path = format!(
        "{}/../../mechanisms/{name}.mech",
        env!("CARGO_MANIFEST_DIR")
    );
    std::fs::read_to_string(path).expect("a description")
}

/// cos φ2 = 1 − cos φ1/√3, so that φ2 is smallest where φ1 = π/6 + sin 2t is closest to π/2: at t = π/4, π/4 + π, …
#[test]
fn the_exam_comes_closest_to_singular_where_its_drive_turns_back() {
    let folder = Folder::new("check_exam", EXAM);
    let report = object(&folder, "", 0);
    assert_eq!((&report["kdof"], &report["ndof"]), (&1.into(), &0.into()));
    let block = &report["blocks"][0];
    assert_eq!(block["unknowns"], "phi2");
    assert_eq!(block["method"], "one angle");
    assert_eq!(block["determinant"], "sqrt(3)*sin(phi2)");
    let meaning = block["singular_where"].as_str().expect("words");
    assert!(meaning.contains("parallel to the x axis"), "{meaning}");
    let phi1 = std::f64::consts::FRAC_PI_6 + 1.0;
    let cosine = 1.0 - phi1.cos() / 3_f64.sqrt();
    let closest = &block["closest"];
    close("t", &closest["t"], std::f64::consts::FRAC_PI_4, 1e-9);
    close(
        "sine",
        &closest["measure"],
        (1.0 - cosine * cosine).sqrt(),
        1e-12,
    );
    assert_eq!(
        (&closest["times"], &closest["at_end"]),
        (&2.into(), &false.into())
    );
    // Φ_q of the exam has the determinant ±√3 sin φ2, so its condition is finite there.
    assert!(number(&closest["rcond"]) > 1e-3);
    // Coarse frames are refined to the same time.
    let coarse = object(&folder, "--step 0.3 --to 1.5", 0);
    let closest = &coarse["blocks"][0]["closest"];
    close("t", &closest["t"], std::f64::consts::FRAC_PI_4, 1e-9);
}

/// The rod may point up or down from the pin: φ2 and −φ2.
#[test]
fn the_exam_has_two_assemblies() {
    let folder = Folder::new("check_exam_assemblies", EXAM);
    let report = object(&folder, "", 0);
    let all = report["assemblies"].as_array().expect("a list");
    assert_eq!((all.len(), &report["assembly_modes"]), (2, &1.into()));
    assert_eq!(
        (&all[0]["drawn"], &all[1]["drawn"]),
        (&true.into(), &false.into())
    );
    close("phi2", &all[0]["q"][5], std::f64::consts::FRAC_PI_3, 1e-12);
    close("phi2", &all[1]["q"][5], -std::f64::consts::FRAC_PI_3, 1e-12);
}

/// With another drive the crank turns to φ1 = π/2, where the rod is perpendicular to the line on which its end moves.
#[test]
fn the_exam_driven_through_its_singular_pose_ends_there() {
    let driven = EXAM.replace("pi/6 + sin(2*t)", "pi/6 + t");
    assert_ne!(driven, EXAM);
    let folder = Folder::new("check_singular", driven);
    let report = object(&folder, "", 1);
    let closest = &report["blocks"][0]["closest"];
    assert_eq!(closest["at_end"], true);
    let end = std::f64::consts::FRAC_PI_3;
    close("t", &closest["t"], end, 1e-8);
    // sin φ2 falls as the root of the time that is left.
    assert!(number(&closest["measure"]) < 1e-4, "{closest}");
    let error = report["error"].as_str().expect("why it ends");
    let time: f64 = error
        .split("beyond t = ")
        .nth(1)
        .and_then(|rest| rest.split(" s").next())
        .and_then(|text| text.parse().ok())
        .expect("a time");
    assert!((time - end).abs() <= 2e-9, "{error}");
    let warnings = report["warnings"].as_array().expect("a list");
    assert!(
        warnings.iter().any(|it| it.as_str().is_some_and(|text| text
            .contains("the line from P to the origin of body 2 is parallel to the x axis"))),
        "{warnings:?}"
    );
}

#[test]
fn text_pictures_and_exit_codes_follow_the_options() {
    let folder = Folder::new("check_options", EXAM);
    let ran = folder.run("check a.mech --plot pictures").exits_with(0);
    for text in [
        "KDOF = 6 - 5 = 1",
        "NDOF = 1 - 1 = 0",
        "singular where sqrt(3)*sin(phi2) = 0",
        "2 of 2^1 = 2",
        "as drawn",
        "t = 0.785398163 s",
    ] {
        assert!(ran.stdout.contains(text), "{text} in {}", ran.stdout);
    }
    assert_eq!(ran.stderr, "");
    let picture = folder.read("pictures/assemblies.svg");
    // The crank of length 1 and the rod of length √3 are drawn to scale, at one scale in both panels.
    let length = |id: &str| -> f64 {
        let shape = picture
            .split(&format!("id=\"{id}\""))
            .nth(1)
            .expect("a body");
        let shape = shape
            .split("<path class=\"body\" d=\"M")
            .nth(1)
            .expect("its shape");
        let edge = shape.split('A').next().expect("its first edge");
        let ends: Vec<f64> = edge
            .split([' ', 'L'])
            .map(|it| it.parse().expect("a number"))
            .collect();
        (ends[2] - ends[0]).hypot(ends[3] - ends[1])
    };
    for panel in [1, 2] {
        let crank = length(&format!("assembly-{panel}-body-1"));
        let rod = length(&format!("assembly-{panel}-body-2"));
        assert!((rod / crank - 3.0_f64.sqrt()).abs() < 1e-3, "{crank} {rod}");
        assert!((crank / length("assembly-1-body-1") - 1.0).abs() < 1e-3);
    }
    assert!(picture.contains(">+ as drawn</text>") && picture.contains(">−</text>"));
    folder.run("check a.mech --deny-warnings").exits_with(0);
    // A rod that comes within half a degree of the x axis, between two frames.
    let near = Folder::new(
        "check_near",
        EXAM.replace("pi/6 + sin(2*t)", "pi/6 + (pi/3 - 0.00001)*sin(2*t)"),
    );
    near.run("check a.mech").exits_with(0);
    let ran = near.run("check a.mech --deny-warnings").exits_with(1);
    assert!(
        ran.stderr.contains("warning: block 2, phi2: only "),
        "{}",
        ran.stderr
    );
    let closest = &object(&near, "", 0)["blocks"][0]["closest"];
    close("t", &closest["t"], std::f64::consts::FRAC_PI_4, 1e-7);
    let refused = folder.run("check a.mech --to -1").exits_with(2).stderr;
    assert_eq!(
        refused,
        "error: the end, t = -1 s, lies before the start, t = 0 s\n"
    );
    let help = folder.run("check --help").exits_with(0).stdout;
    assert!(help.contains("--deny-warnings"), "{help}");
}

/// The column of a block is |sin φ2| in the exam, and |sin(φ_rocker − φ_coupler)| in the four-bar.
#[test]
fn solve_monitors_how_close_each_block_is() {
    let folder = Folder::new("monitor_exam", EXAM);
    let ran = folder
        .run("solve a.mech --monitor --csv - --to 1 --step 0.1")
        .exits_with(0);
    let mut lines = ran
        .stdout
        .lines()
        .map(|line| line.split(',').collect::<Vec<_>>());
    let header = lines.next().expect("a header");
    let place = |name: &str| {
        let index = header.iter().position(|it| *it == name);
        index.unwrap_or_else(|| panic!("no {name} in {header:?}"))
    };
    let mut count = 0;
    for line in lines {
        let read = |name: &str| line[place(name)].parse::<f64>().expect("a number");
        let (found, wanted) = (
            read("normalized_determinant_phi2"),
            read("phi2").sin().abs(),
        );
        assert!(
            (found - wanted).abs() < 1e-14,
            "{found} instead of {wanted}"
        );
        count += 1;
    }
    assert_eq!(count, 11);
    assert!(
        ran.stderr.contains("normalized_determinant_phi2 = 0.2")
            && ran.stderr.contains("at t = 0.8 s"),
        "{}",
        ran.stderr
    );
    let plain = folder
        .run("solve a.mech --csv - --to 1 --step 0.1")
        .exits_with(0);
    assert!(!plain.stdout.contains("determinant"));
    folder.run("solve a.mech --monitor --json").exits_with(2);
}
