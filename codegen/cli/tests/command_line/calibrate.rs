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
fn noise() -> impl FnMut() -> f64 {
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

fn folder(name: &str) -> Folder {
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
    assert!(ran.stderr.contains("which is read"), "{}", ran.stderr);
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
    let expected = "`L` and `gap` cannot be told apart: changed as 1 : -1 they leave everything that is measured as it is";
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
        ("", 2, "no parameter of `crank` is to be fitted"),
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
        output.contains("`depth` changes nothing that is measured"),
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

/// A four-bar with these lengths of crank, coupler and rocker.
fn four_bar(lengths: [&str; 3]) -> String {
    let [crank, coupler, rocker] = lengths;
    format!(
        "mechanism four_bar {{
    param L2 = {crank};
    param L3 = {coupler};
    param L4 = {rocker};
    point A = (0, 0), D = (100mm, 0);
    body crank   at (0, 0, 40deg)       {{ A: (0, 0), B: (L2, 0) }}
    body coupler at (20mm, 15mm, 40deg) {{ B: (0, 0), C: (L3, 0), P: (60mm, 40mm) }}
    body rocker  at (100mm, 0, 75deg)   {{ D: (0, 0), C: (L4, 0) }}
    revolute A(ground, crank);
    revolute B(crank, coupler);
    revolute C(coupler, rocker);
    revolute D(ground, rocker);
    drive phi(crank) = 40deg + 3*t;
}}
"
    )
}

/// Table of a four-bar of 40, 120 and 80 mm with its crank turned by half a turn.
const TURNED: &str = "t (s),P_x (mm),P_y (mm),phi_rocker (deg)\n\
0.00,-19.61130,45.55089,128.305305\n\
0.15,-16.01560,35.62999,128.044404\n\
0.30,-7.07582,31.66176,123.437582\n\
0.45,7.06844,35.68997,113.219478\n\
0.60,27.69267,47.98350,95.393225\n\
0.75,54.46647,62.79786,71.500698\n\
0.90,72.98383,73.58437,56.005751\n\
1.05,72.90241,84.24024,57.461219\n\
1.20,60.59049,93.36724,67.908270\n\
1.35,42.25377,97.34849,81.361744\n\
1.50,22.31712,94.70001,95.130215\n\
1.65,4.25511,85.94545,107.677225\n\
1.80,-9.48016,73.00873,117.876654\n\
1.95,-17.55656,58.49667,124.921063\n\
";

/// Table of that four-bar in the other assembly, from its design configuration on.
const OTHER: &str = "t (s),P_x (mm),P_y (mm),phi_rocker (deg)\n\
0.00,94.7279,-7.3487,-98.0050\n\
0.15,77.7707,-1.3959,-114.8271\n\
0.30,62.3019,5.6187,-124.2619\n\
0.45,48.7969,9.3043,-128.2928\n\
0.60,38.3279,8.0660,-128.0697\n\
0.75,32.6472,2.1899,-124.0349\n\
";

#[test]
fn poor_fit_is_not_trusted_and_not_written() {
    for (name, lengths, table, parameters, said) in [
        (
            "turned",
            ["25mm", "150mm", "110mm"],
            TURNED,
            "L2,L3,L4",
            "`L2` ends at its bound 0 m",
        ),
        (
            "other",
            ["30mm", "99mm", "110mm"],
            OTHER,
            "L3,L4",
            "leave more than the noise",
        ),
    ] {
        let folder = Folder::new(&format!("calibrate_{name}"), four_bar(lengths));
        std::fs::write(folder.file("data.csv"), table).expect("it can be written");
        let options = format!("calibrate a.mech data.csv --param {parameters} --out new.mech");
        let ran = folder.run(&options).exits_with(1);
        assert!(ran.stdout.contains(said), "{}", ran.stdout);
        assert!(
            ran.stdout.contains("this fit is not to be trusted"),
            "{}",
            ran.stdout
        );
        assert!(!folder.file("new.mech").exists());
        folder
            .run(&format!(
                "calibrate a.mech data.csv --param {parameters} --plot plots"
            ))
            .exits_with(1);
        for column in ["P_x", "P_y", "phi_rocker"] {
            let picture = folder.read(&format!("plots/{column}.svg"));
            assert!(picture.contains("data - solved"), "{column}");
        }
        let report = json(
            &folder
                .run(&format!("{options} --json"))
                .exits_with(1)
                .stdout,
        );
        assert_eq!(report["trusted"], false, "{report}");
        for parameter in report["parameters"].as_array().expect("parameters") {
            assert!(number(&parameter["value"]) >= 0.0, "{report}");
        }
    }
    // `--force` writes a fit that is not trusted.
    let folder = Folder::new("calibrate_forced", four_bar(["30mm", "99mm", "110mm"]));
    std::fs::write(folder.file("data.csv"), OTHER).expect("it can be written");
    folder
        .run("calibrate a.mech data.csv --param L3,L4 --out new.mech --force")
        .exits_with(1);
    assert!(folder.file("new.mech").exists());
}

#[test]
fn bounds_hold_and_are_read_with_units() {
    let folder = folder("calibrate_bounds");
    let run = |bound: &str, code| {
        let options =
            format!("calibrate a.mech data.csv --param L,offset,speed --json --bound {bound}");
        folder.run(&options).exits_with(code)
    };
    let report = json(&run("L=39mm..43mm,offset=5deg..15deg", 0).stdout);
    assert!(
        (number(&report["parameters"][0]["value"]) - 0.042).abs() < 1e-5,
        "{report}"
    );
    let report = json(&run("L=0.03..41mm", 1).stdout);
    assert!(
        (number(&report["parameters"][0]["bound"]) - 0.041).abs() < 1e-12,
        "{report}"
    );
    assert!(
        number(&report["parameters"][0]["value"]) <= 0.041,
        "{report}"
    );
    let ran = folder
        .run("calibrate a.mech data.csv --param L --bound L=41mm..43mm --set L=50mm")
        .exits_with(1);
    assert!(
        ran.stderr.contains("`L` begins outside of its bounds"),
        "{}",
        ran.stderr
    );
    for (bound, said) in [
        ("L=1mm", "is not a range"),
        ("gap=1..2", "is about none of `--param`"),
        (
            "L=1s..2s",
            "has an end that is not a number with a unit of the parameter",
        ),
        ("L=3mm..2mm", "is empty"),
    ] {
        let ran = run(bound, 2);
        assert!(ran.stderr.contains(said), "{}", ran.stderr);
    }
}

/// Positions of P at (60, `height`) mm on the coupler of a four-bar of 100, 40, 120 and 80 mm, by the law of cosines,
/// with a little noise.
fn coupler_points(height: f64) -> String {
    let mut text = "t (s),P_x (mm),P_y (mm)\n".to_string();
    let mut noise = noise();
    for step in 0..48 {
        let t = f64::from(step) * 0.04;
        let crank = 40_f64.to_radians() + 3.0 * t;
        let joint = [40.0 * crank.cos(), 40.0 * crank.sin()];
        let diagonal = (100.0 - joint[0]).hypot(joint[1]);
        let cosine = (120_f64.powi(2) + diagonal.powi(2) - 80_f64.powi(2)) / (240.0 * diagonal);
        let coupler = (-joint[1]).atan2(100.0 - joint[0]) + cosine.acos();
        let x = joint[0] + 60.0 * coupler.cos() - height * coupler.sin() + noise();
        let y = joint[1] + 60.0 * coupler.sin() + height * coupler.cos() + noise();
        text += &format!("{t},{x:.6},{y:.6}\n");
    }
    text
}

/// A length keeps the sign that it has in the description, unless `--bound` permits the other.
#[test]
fn a_length_ends_at_the_bound_that_its_sign_is() {
    for (drawn, height) in [("5mm", -12.0), ("-5mm", 12.0)] {
        let description = four_bar(["40mm", "120mm", "80mm"])
            .replace("P: (60mm, 40mm)", "P: (60mm, height)")
            .replace(
                "param L2",
                &format!("param height = {drawn};\n    param L2"),
            );
        let folder = Folder::new("calibrate_sign", description);
        std::fs::write(folder.file("data.csv"), coupler_points(height)).expect("written");
        let options = "calibrate a.mech data.csv --param height";
        let ran = folder.run(options).exits_with(1);
        let reason = "`height` ends at its bound 0 m";
        assert!(ran.stdout.contains(reason), "{}", ran.stdout);
        let report = json(
            &folder
                .run(&format!("{options} --json"))
                .exits_with(1)
                .stdout,
        );
        let parameter = &report["parameters"][0];
        assert_eq!(number(&parameter["bound"]), 0.0, "{report}");
        assert!(number(&parameter["value"]).abs() < 1e-8, "{report}");
        assert_eq!(report["trusted"], false, "{report}");
        assert!(report["reasons"].to_string().contains(reason), "{report}");
        for bound in ["height=..", "height=-20mm..20mm"] {
            let options = format!("{options} --json --bound {bound}");
            let report = json(&folder.run(&options).exits_with(0).stdout);
            let parameter = &report["parameters"][0];
            assert!(
                (1e3 * number(&parameter["value"]) - height).abs() < 0.01,
                "{report}"
            );
            assert_eq!(parameter.get("bound"), None, "{report}");
        }
    }
}

/// Deviation of a length L from values L·cos φ that are rounded to whole millimeters: root of the mean square over all
/// positions of the zero within a millimeter.
fn deviation_by_rounding(length: f64, cosines: &[f64]) -> f64 {
    let squares: f64 = cosines.iter().map(|it| it * it).sum();
    let zeros = 2000;
    let errors = (0..zeros).map(|place| {
        let zero = (f64::from(place) + 0.5) / f64::from(zeros);
        let sum: f64 = cosines
            .iter()
            .map(|it| it * ((length * it + zero).round() - zero - length * it))
            .sum();
        (sum / squares).powi(2)
    });
    (errors.sum::<f64>() / f64::from(zeros)).sqrt()
}

/// Rounding makes few values in whole millimeters uncertain, even if they seem to fit.
#[test]
fn rounding_of_the_table_counts() {
    let folder = folder("calibrate_rounding");
    let mut text = "t,B_x (mm)\n".to_string();
    let mut cosines = Vec::new();
    for step in 0..20 {
        let t = 0.05 * f64::from(step);
        let cosine = (0.1 + 3.0 * t).cos();
        cosines.push(cosine);
        text += &format!("{t},{:.0}\n", 42.3 * cosine);
    }
    std::fs::write(folder.file("data.csv"), text).expect("it can be written");
    let report = json(
        &folder
            .run("calibrate a.mech data.csv --param L --json")
            .exits_with(0)
            .stdout,
    );
    let parameter = &report["parameters"][0];
    let expected = 1e-3 * deviation_by_rounding(1e3 * number(&parameter["value"]), &cosines);
    let deviation = number(&parameter["deviation"]);
    assert!(
        (deviation / expected - 1.0).abs() < 0.02,
        "{deviation} {expected}"
    );
    let [low, high] = [0, 1].map(|it| number(&parameter["interval"][it]));
    assert!(low < 0.0423 && 0.0423 < high, "{report}");
    assert!((number(&report["columns"][0]["noise"]) / 12.0_f64.sqrt().recip() - 1.0) > -1e-9);
}
