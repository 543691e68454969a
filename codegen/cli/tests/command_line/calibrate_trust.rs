//! `linkwright calibrate` on fits that are not to be trusted, on bounds, and on rounded tables.

use crate::calibrate::{folder, noise};
use crate::folder::Folder;
use crate::printed::{json, number};

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
            "together exceed the noise",
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
        ran.stderr
            .contains("`L` does not begin strictly within its bounds"),
        "{}",
        ran.stderr
    );
    for (bound, said) in [
        ("L=1mm", "is not a range"),
        ("gap=1..2", "is not one of `--param`"),
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
