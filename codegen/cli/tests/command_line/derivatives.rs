//! Quantities of `transmission` and `sensitivity` statements in the output of `linkwright solve`.

use crate::folder::Folder;
use crate::printed::json;

/// A slider-crank with a crank of changeable length.
const ASKED: &str = "mechanism asked {
    param r = 100mm;
    point A = (0, 0), B = (0.05, 0.08), S = (0.35, 0);
    body crank at A facing A -> B { A, P: (r, 0) }
    body rod at B facing B -> S { P: (0, 0), S: (0.3, 0) }
    body slider at S { S }
    revolute A(ground, crank);
    revolute P(crank, rod);
    revolute S(rod, slider);
    absolute_y(slider) = 0;
    absolute_angle(slider) = 0;
    drive phi(crank) = 1 + t;
    transmission S, phi(rod);
    sensitivity r;
}
";

/// Named columns of the only row.
fn columns(folder: &Folder, options: &str) -> Vec<(String, f64)> {
    let ran = folder.run(&format!("solve a.mech --at 0.5 --csv - {options}"));
    let printed = ran.exits_with(0).stdout;
    let mut lines = printed.lines();
    let names = lines
        .next()
        .expect("a header")
        .split(',')
        .map(str::to_string);
    let values = lines.next().expect("a row").split(',');
    names
        .zip(values.map(|value| value.parse().expect("a number")))
        .collect()
}

fn value(columns: &[(String, f64)], name: &str) -> f64 {
    let column = columns.iter().find(|(own, _)| own == name);
    column
        .unwrap_or_else(|| panic!("no `{name}` in {columns:?}"))
        .1
}

#[test]
fn transmissions_and_sensitivities_are_columns() {
    let folder = Folder::new("derivatives", ASKED);
    let solved = columns(&folder, "");
    // s = r cos φ + √(0.09 − r² sin² φ) and sin ψ = −r sin φ/0.3 at φ = 1.5.
    let (r, angle) = (0.1_f64, 1.5_f64);
    let (sine, cosine) = angle.sin_cos();
    let root = (0.09 - (r * sine).powi(2)).sqrt();
    let slope = -r * sine - r * r * sine * cosine / root;
    let by_crank = cosine - r * sine * sine / root;
    for (name, wanted) in [
        ("S_x per phi(crank)", slope),
        ("S_y per phi(crank)", 0.0),
        ("phi_rod per phi(crank)", -r * cosine / root),
        ("x_slider per r", by_crank),
        ("phi_rod per r", -sine / root),
    ] {
        let solved_value = value(&solved, name);
        assert!(
            (solved_value - wanted).abs() < 1e-14,
            "{name}: {solved_value} {wanted}"
        );
    }
    // The rate of the slider by the crank's length, against differences of two runs.
    let step = 1e-4;
    let [more, less] = [r + step, r - step].map(|r| {
        let columns = columns(&folder, &format!("--set r={r}"));
        value(&columns, "x_slider_d")
    });
    let difference = (more - less) / (2.0 * step);
    let rate = value(&solved, "x_slider_d per r");
    assert!((rate - difference).abs() < 1e-6, "{rate} {difference}");
}

#[test]
fn json_has_the_same_under_one_key() {
    let folder = Folder::new("derivatives_json", ASKED);
    let ran = folder.run("solve a.mech --at 0.5 --json").exits_with(0);
    let object = json(&ran.stdout);
    let names = object["derivatives"].as_array().expect("names");
    let values = object["frames"][0]["derivatives"]
        .as_array()
        .expect("values");
    let columns = columns(&folder, "");
    assert_eq!(names.len(), values.len());
    for (name, found) in names.iter().zip(values) {
        let expected = value(&columns, name.as_str().expect("a name"));
        assert_eq!(found.as_f64(), Some(expected));
    }
    let plain = Folder::new("no_derivatives", crate::folder::EXAM);
    let ran = plain.run("solve a.mech --at 0.5 --json").exits_with(0);
    assert!(!ran.stdout.contains("derivatives"));
}
