//! `linkwright calibrate` with measures: as columns of a table, and beside others in a description.

use crate::folder::Folder;
use crate::printed::{json, number};

/// A slider-crank in line whose lengths are some percent off.
const PRESS: &str = "\
mechanism press {
    units mm, deg;
    param r = 31mm;
    param l = 97mm;

    point O = (0, 0);
    body crank at (0, 0, 20deg) { O, A: (r, 0) }
    body rod at (28mm, 10mm, -6deg) { A: (0, 0), B: (l, 0) }
    body ram at (127mm, 0) { B: (0, 0) }
    revolute O(ground, crank);
    revolute A(crank, rod);
    revolute B(rod, ram);
    translational (ground, ram) along O -> B;
    drive phi(crank) = 20deg + 4*t;
    measure stroke = distance(O, B);
    measure pace = rate(stroke);
}
";

/// Place and speed of the ram for a crank of 30 mm and a rod of 100 mm, and its angle as seen from the crank, by the closed form.
fn table(columns: &str, row: impl Fn([f64; 3]) -> String) -> String {
    let rows = (0..40).map(|step| {
        let t = f64::from(step) * 0.04;
        let phi = 20.0_f64.to_radians() + 4.0 * t;
        let (sin, cos) = phi.sin_cos();
        let root = (100.0_f64.powi(2) - (30.0 * sin).powi(2)).sqrt();
        let slope = -30.0 * sin - 900.0 * sin * cos / root;
        let rod = -(30.0 * sin / 100.0).asin().to_degrees();
        format!("{t},{}\n", row([30.0 * cos + root, 4.0 * slope, rod]))
    });
    format!("{columns}\n{}", rows.collect::<String>())
}

#[test]
fn measures_of_positions_and_rates_are_fitted() {
    for (name, text) in [
        ("stroke", table("t,stroke (mm)", |it| it[0].to_string())),
        ("pace", table("t,pace (mm/s)", |it| it[1].to_string())),
        (
            "both",
            table("t,stroke (mm),pace (mm/s)", |it| {
                format!("{},{}", it[0], it[1])
            }),
        ),
        // Sensitivities of measures stand between those of the parameters.
        (
            "beside",
            table("t,phi_rod (deg),B_x (mm)", |it| {
                format!("{},{}", it[2], it[0])
            }),
        ),
    ] {
        let folder = Folder::new(&format!("calibrate_measures_{name}"), PRESS);
        std::fs::write(folder.file("data.csv"), text).expect("it can be written");
        let ran = folder.run("calibrate a.mech data.csv --param r,l --json");
        let report = json(&ran.stdout);
        let parameters = report["parameters"].as_array().expect("a list");
        for (parameter, expected) in parameters.iter().zip([30.0, 100.0]) {
            let value = number(&parameter["value"]);
            assert!((value - expected).abs() < 1e-9, "{name}: {parameter}");
        }
    }
}
