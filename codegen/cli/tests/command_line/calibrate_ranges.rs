//! `linkwright calibrate` stays in the ranges of the description.

use crate::calibrate::folder;
use crate::printed::{json, number};

/// The crank of the data has a length of 42 mm and begins at 0.15 rad.
fn limited(range: &str) -> String {
    format!(
        "mechanism crank {{
    param L = 40mm from {range}; // as drawn
    param offset = 0.1;
    param speed = 3/1s;
    point A = (0, 0);
    body arm at (0, 0, offset) {{ A: (0, 0), B: (L, 0) }}
    revolute A(ground, arm);
    drive phi(arm) = offset + speed*t;
}}
"
    )
}

#[test]
fn a_fit_stays_in_the_range_and_keeps_it() {
    let folder = folder("calibrate_ranges");
    std::fs::write(folder.file("a.mech"), limited("30mm to 50mm")).expect("written");
    let fit = "calibrate a.mech data.csv --param L,offset,speed --json";
    let report = json(
        &folder
            .run(&format!("{fit} --out new.mech"))
            .exits_with(0)
            .stdout,
    );
    let length = number(&report["parameters"][0]["value"]);
    assert!((length - 0.042).abs() < 1e-5, "{report}");
    let new = folder.read("new.mech");
    let line = new.lines().nth(1).expect("a line");
    assert!(
        line.starts_with("    param L = 42.") || line.starts_with("    param L = 41.9"),
        "{line}"
    );
    assert!(
        line.ends_with("mm from 30mm to 50mm; // as drawn"),
        "{line}"
    );

    // The end of the range is the bound at which the fit ends.
    std::fs::write(folder.file("a.mech"), limited("30mm to 41mm")).expect("written");
    let report = json(&folder.run(fit).exits_with(1).stdout);
    let parameter = &report["parameters"][0];
    assert!(
        (number(&parameter["value"]) - 0.041).abs() < 1e-6,
        "{report}"
    );
    assert!(
        (number(&parameter["bound"]) - 0.041).abs() < 1e-12,
        "{report}"
    );
}

#[test]
fn bounds_narrow_a_range_and_cannot_exceed_it() {
    let folder = folder("calibrate_bounds_in_ranges");
    std::fs::write(folder.file("a.mech"), limited("30mm to 50mm")).expect("written");
    let fit = "calibrate a.mech data.csv --param L,offset,speed --json";
    for bound in ["L=..", "L=30mm..", "L=..50mm", "L=35mm..43mm"] {
        folder.run(&format!("{fit} --bound {bound}")).exits_with(0);
    }
    let ran = folder.run(&format!("{fit} --bound L=35mm..41mm"));
    let report = json(&ran.exits_with(1).stdout);
    let bound = number(&report["parameters"][0]["bound"]);
    assert!((bound - 0.041).abs() < 1e-12, "{report}");
    for bound in ["L=29mm..45mm", "L=35mm..51mm", "L=0..0.05"] {
        let ran = folder.run(&format!("{fit} --bound {bound}")).exits_with(2);
        assert!(
            ran.stderr
                .contains("exceeds the range of `L`, which is from 30 mm to 50 mm"),
            "{bound}: {}",
            ran.stderr
        );
    }
}
