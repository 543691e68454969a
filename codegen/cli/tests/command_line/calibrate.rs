//! `linkwright calibrate` from the outside.

use crate::folder::Folder;
use crate::printed::{json, number};

/// A crank that is pinned to the origin, and a point on it.
const CRANK: &str = "\
/// A crank.
mechanism crank {
    /// How long it is.
    param L = 40mm; // as drawn
    param offset = 0.1;
    param speed = 3/1s;
    param gap = 5mm;

    point A = (0, 0);
    body arm at (0, 0, offset) { A: (0, 0), B: (L, 0), C: (L + gap, 0) }
    revolute A(ground, arm);
    drive phi(arm) = offset + speed*t;
}
";

/// Noise of ±0.01 mm, evenly distributed and always the same.
pub fn noise() -> impl FnMut() -> f64 {
    let mut seed = 1_u64;
    move || {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((seed >> 33) as f64 / f64::from(1_u32 << 31) - 0.5) * 0.02
    }
}

/// B of a crank of 42 mm, which begins at 0.15 rad and turns at 3.2 rad/s, with a little noise.
fn table() -> String {
    let mut text = "t,B_x (mm),B_y (mm)\n".to_string();
    let mut noise = noise();
    for step in 0..60 {
        let t = f64::from(step) * 0.03;
        let angle = 0.15 + 3.2 * t;
        text += &format!(
            "{t},{},{}\n",
            42.0 * angle.cos() + noise(),
            42.0 * angle.sin() + noise()
        );
    }
    text
}

pub fn folder(name: &str) -> Folder {
    let folder = Folder::new(name, CRANK);
    std::fs::write(folder.file("data.csv"), table()).expect("it can be written");
    folder
}

#[test]
fn parameters_are_found_and_written_where_they_stood() {
    let folder = folder("calibrate");
    let ran = folder
        .run("calibrate a.mech data.csv --param L,offset,speed --out new.mech --json")
        .exits_with(0);
    let report = json(&ran.stdout);
    let truth = [
        ("L", "m", 0.042),
        ("offset", "", 0.15),
        ("speed", "s^-1", 3.2),
    ];
    for (entry, (name, unit, truth)) in report["parameters"]
        .as_array()
        .expect("a list")
        .iter()
        .zip(truth)
    {
        assert_eq!(
            (&entry["name"], &entry["unit"]),
            (&name.into(), &unit.into())
        );
        let (value, deviation) = (number(&entry["value"]), number(&entry["deviation"]));
        assert!(
            (value - truth).abs() < 4.0 * deviation && deviation < 1e-3 * truth,
            "{name}: {value} ± {deviation}"
        );
    }
    assert_eq!(
        (&report["rank"], &report["freedom"]),
        (&3.into(), &117.into())
    );
    for column in report["columns"].as_array().expect("a list") {
        // Evenly distributed noise of ±0.01 mm has a standard deviation of 0.0058 mm.
        let after = number(&column["rms_after"]);
        assert!(
            (0.004..0.008).contains(&after) && number(&column["rms_before"]) > 1.0,
            "{column}"
        );
    }
    let new = folder.read("new.mech");
    let pairs: Vec<(&str, &str)> = CRANK
        .lines()
        .zip(new.lines())
        .filter(|(a, b)| a != b)
        .collect();
    let [length, offset, speed] = pairs.as_slice() else {
        panic!("{pairs:?}");
    };
    assert!(
        length.1.starts_with("    param L = 4") && length.1.ends_with("mm; // as drawn"),
        "{length:?}"
    );
    assert!(offset.1.starts_with("    param offset = 0.1"), "{offset:?}");
    assert!(
        speed.1.starts_with("    param speed = 3.") && speed.1.ends_with("/1s;"),
        "{speed:?}"
    );
    // With the new values the mechanism moves as measured.
    folder
        .run("compare new.mech data.csv --tolerance 0.03mm")
        .exits_with(0);
    folder
        .run("compare a.mech data.csv --tolerance 0.03mm")
        .exits_with(1);
    // A description is never replaced.
    let ran = folder
        .run("calibrate a.mech data.csv --param L --out new.mech")
        .exits_with(2);
    assert!(
        ran.stderr.contains("cannot write `new.mech`"),
        "{}",
        ran.stderr
    );
    let ran = folder
        .run("calibrate a.mech data.csv --param L --out a.mech --force")
        .exits_with(2);
    assert!(ran.stderr.contains("which is an input"), "{}", ran.stderr);
    assert_eq!(
        (folder.read("a.mech").as_str(), folder.read("new.mech")),
        (CRANK, new)
    );
    folder
        .run("calibrate a.mech data.csv --param L,offset,speed --out new.mech --force")
        .exits_with(0);
}

#[test]
fn indistinguishable_parameters_are_named_and_not_written() {
    let folder = folder("calibrate_indistinct");
    let table = table().replace("B_", "C_");
    std::fs::write(folder.file("data.csv"), table).expect("written");
    let ran = folder
        .run("calibrate a.mech data.csv --param L,gap,offset,speed --out new.mech")
        .exits_with(1);
    let expected =
        "`L` and `gap` cannot be distinguished: a change by 1 : -1 affects no measured quantity";
    assert!(ran.stdout.contains(expected), "{}", ran.stdout);
    assert!(
        ran.stdout
            .contains("this motion determines 3 of 4 combinations"),
        "{}",
        ran.stdout
    );
    assert!(
        ran.stderr.contains("does not determine all parameters"),
        "{}",
        ran.stderr
    );
    assert!(!folder.file("new.mech").exists());
    let ran = folder
        .run("calibrate a.mech data.csv --param L,gap,offset,speed --json")
        .exits_with(1);
    let report = json(&ran.stdout);
    let parameters = report["parameters"].as_array().expect("a list");
    let is_null: Vec<bool> = parameters
        .iter()
        .map(|it| it["deviation"].is_null())
        .collect();
    assert_eq!(is_null, [true, false, false, true], "{report}");
    assert!(report["correlations"][0][3].is_null() && number(&report["correlations"][1][2]) < 0.0);
}

#[test]
fn known_deviations_count() {
    let folder = folder("calibrate_deviations");
    let of = |options: &str| {
        let ran = folder.run(&format!(
            "calibrate a.mech data.csv --param L,offset,speed --json {options}"
        ));
        let report = json(&ran.exits_with(0).stdout);
        number(&report["parameters"][0]["deviation"])
    };
    let (one, ten) = (of("--deviation 0.01mm"), of("--deviation 0.1mm"));
    assert!((ten / one - 10.0).abs() < 1e-6, "{one} {ten}");
    // 120 values, of which each tells 1/√2 of the length on average.
    assert!((one / (1e-5 / 60.0_f64.sqrt()) - 1.0).abs() < 1e-3, "{one}");
}

/// 3.2 rad/s are 30.557749 turns per minute.
#[test]
fn columns_that_count_turns_are_marked() {
    let folder = folder("calibrate_turns");
    for (unit, factor, counts) in [
        ("1/min", 60.0 / std::f64::consts::TAU, true),
        ("Hz", 1.0 / std::f64::consts::TAU, true),
        ("rad/s", 1.0, false),
    ] {
        let mut text = format!("t,phi_arm_d ({unit}),B_x (mm)\n");
        for step in 0..40 {
            let t = f64::from(step) * 0.04;
            let rate = 3.2 * factor;
            let reach = 40.0 * (0.1 + 3.2 * t).cos();
            text += &format!("{t},{rate:.9},{reach:.9}\n");
        }
        std::fs::write(folder.file("data.csv"), text).expect("it can be written");
        let ran = folder.run("calibrate a.mech data.csv --param speed --json");
        let report = json(&ran.exits_with(0).stdout);
        let speed = number(&report["parameters"][0]["value"]);
        assert!((speed - 3.2).abs() < 1e-6, "{unit}: {report}");
        let [rate, reach] = [0, 1].map(|it| &report["columns"][it]);
        assert_eq!(rate["counts_turns"] == true, counts, "{unit}: {report}");
        assert_eq!(reach.get("counts_turns"), None, "{unit}: {report}");
    }
}

#[test]
fn names_the_reason_of_an_impossible_fit() {
    let folder = folder("calibrate_errors");
    for (options, code, said) in [
        ("--param M", 2, "`crank` has no parameter `M`"),
        ("", 2, "no parameter of `crank` is selected for the fit"),
        ("--param L,L", 2, "`--param` names `L` twice"),
        ("--param sped", 2, "did you mean `speed`?"),
        (
            "--param L --deviation 0mm",
            2,
            "the deviation of `B_x` is zero",
        ),
        (
            "--param L --column B_x=B_ax --skip B_y --unit B_x=m/s^2",
            2,
            "has neither positions nor rates",
        ),
        ("", 2, "--param"),
    ] {
        let ran = folder
            .run(&format!("calibrate a.mech data.csv {options}"))
            .exits_with(code);
        assert!(ran.stderr.contains(said), "{options}: {}", ran.stderr);
    }
    std::fs::write(folder.file("data.csv"), "t,B_x\n0,0.04\n").expect("written");
    let ran = folder
        .run("calibrate a.mech data.csv --param L,offset")
        .exits_with(1);
    assert!(
        ran.stderr
            .contains("1 measured values are too few for 2 parameters"),
        "{}",
        ran.stderr
    );
}

#[test]
fn a_parameter_that_moves_nothing_alone_is_not_determined() {
    let folder = Folder::new(
        "calibrate_idle",
        "mechanism idle {
    param depth = 20mm;
    point O = (0, 0);
    body arm at O { O, P: (70mm, 0), E: (depth, 10mm) }
    revolute O(ground, arm);
    drive phi(arm) = 0.8*t;
}
",
    );
    let rows = (0..10).map(|step| {
        let t = 0.1 * f64::from(step);
        format!("{t},{}\n", 70.0 * (0.8 * t).cos())
    });
    let table = "t (s),P_x (mm)\n".to_string() + &rows.collect::<String>();
    std::fs::write(folder.file("data.csv"), table).expect("it can be written");
    let ran = folder
        .run("calibrate a.mech data.csv --param depth")
        .exits_with(1);
    let output = ran.stdout + &ran.stderr;
    assert!(
        output.contains("`depth` affects no measured quantity"),
        "{output}"
    );
}

#[test]
fn parameters_of_a_motion_are_written_where_they_stood() {
    let folder = Folder::new(
        "calibrate_motion",
        "mechanism arm {
    body arm at (0, 0) { P: (0.4, 0) }
    absolute_x(arm) = 0;
    absolute_y(arm) = 0;
    motion out { param pace = 3; drive phi(arm) = pace*t; }
    motion home { param pace = 0.7; drive phi(arm) = 1 - pace*t; }
}
",
    );
    let rows = (0..20).map(|step| {
        let t = 0.05 * f64::from(step);
        format!("{t},{}\n", 0.4 * (1.0 - 0.75 * t).cos())
    });
    let table = "t (s),P_x (m)\n".to_string() + &rows.collect::<String>();
    std::fs::write(folder.file("data.csv"), table).expect("it can be written");
    folder
        .run("calibrate a.mech data.csv --param pace --motion home --out new.mech")
        .exits_with(0);
    let text = folder.read("new.mech");
    assert!(text.contains("motion out { param pace = 3; "), "{text}");
    assert!(text.contains("motion home { param pace = 0.7"), "{text}");
    assert!(!text.contains("param pace = 0.7;"), "{text}");
}
