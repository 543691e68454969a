//! Sets of `linkwright sweep`: rows of a file, samples, units and inputs.

use std::f64::consts::PI;

use crate::folder::Folder;
use crate::sweep::{RAM, table};

#[test]
fn rows_of_a_file_are_sets_in_its_units() {
    let folder = Folder::new("sweep_rows", RAM);
    let text = "rod [mm];tilt (deg);radius\n200;90;0,05\n150,5;-45;0,03\n";
    std::fs::write(folder.file("sets.csv"), text).expect("it can be written");
    let solved = table(&folder, "--rows sets.csv --to 0 --show x_slide");
    let names = ["rod (mm)", "tilt (deg)", "radius (m)"];
    assert_eq!(solved.names[1..4], names);
    let values = names.map(|it| solved.numbers(it));
    assert_eq!(values, [[200.0, 150.5], [90.0, -45.0], [0.05, 0.03]]);
    let x = solved.numbers("x_slide_max (m)");
    for set in 0..2 {
        let [rod, tilt, radius] = [0, 1, 2].map(|it| values[it][set]);
        let (sine, cosine) = tilt.to_radians().sin_cos();
        let (rod, up) = (rod * 1e-3, radius * sine);
        let expected = radius * cosine + (rod * rod - up * up).sqrt();
        assert!((x[set] - expected).abs() < 1e-15, "{} {expected}", x[set]);
    }
    for (text, said) in [
        (
            "rood\n1\n",
            "no parameter or input is named `rood`\n --> sets.csv:1:1",
        ),
        ("rood\n1\n", "did you mean `rod`?"),
        ("rod,rod\n1,2\n", "two columns are named `rod`"),
        ("rod (deg)\n1\n", "`rod` cannot be in deg"),
        (
            "rod,radius\n1,2\n1,\n",
            "`radius` has no number here\n --> sets.csv:3:3",
        ),
        ("rod\n", "no line of this file is a row of numbers"),
    ] {
        std::fs::write(folder.file("sets.csv"), text).expect("it can be written");
        let ran = folder.run("sweep a.mech --rows sets.csv").exits_with(2);
        assert!(ran.stderr.contains(said), "{text}: {}", ran.stderr);
    }
    assert_eq!(folder.list("."), ["a.mech", "sets.csv"]);
}

#[test]
fn samples_are_points_of_the_sequence() {
    let folder = Folder::new("sweep_samples", RAM);
    let ranges = "--vary rod=100mm..300mm --vary radius=10mm..50mm --to 0 --show x_slide";
    let plain = table(&folder, &format!("{ranges} --samples 8"));
    // The first points of the sequence in two dimensions.
    let expected = [
        [0.0, 0.0],
        [0.5, 0.5],
        [0.75, 0.25],
        [0.25, 0.75],
        [0.375, 0.375],
        [0.875, 0.875],
        [0.625, 0.125],
        [0.125, 0.625],
    ];
    let [rod, radius] = ["rod (mm)", "radius (mm)"].map(|it| plain.numbers(it));
    for (set, [first, second]) in expected.into_iter().enumerate() {
        assert_eq!(
            [rod[set], radius[set]],
            [100.0 + 200.0 * first, 10.0 + 40.0 * second]
        );
    }
    let seeded = |seed| table(&folder, &format!("{ranges} --samples 64 --seed {seed}"));
    let (one, again, other) = (seeded(1), seeded(1), seeded(2));
    assert_eq!(one.rows, again.rows);
    assert_ne!(one.rows, other.rows);
    for sampled in [one, other] {
        let mut cells: Vec<usize> = sampled
            .numbers("rod (mm)")
            .iter()
            .map(|it| ((it - 100.0) / 200.0 * 64.0) as usize)
            .collect();
        cells.sort_unstable();
        assert!(cells.into_iter().eq(0..64));
    }
}

#[test]
fn units_are_those_of_the_option_and_the_report() {
    let folder = Folder::new("sweep_units", RAM);
    let options = "--vary radius=0.02..0.06:3 --vary tilt=0..90deg:4 --show x_slide --to 0";
    let si = table(&folder, options);
    assert_eq!(
        si.names[1..4],
        ["radius (m)", "tilt (deg)", "x_slide_min (m)"]
    );
    assert_eq!(si.numbers("tilt (deg)")[..4], [0.0, 30.0, 60.0, 90.0]);
    let mm = table(&folder, &format!("{options} --units=mm"));
    assert_eq!(
        mm.names[1..4],
        ["radius (mm)", "tilt (deg)", "x_slide_min (mm)"]
    );
    assert_eq!(mm.numbers("radius (mm)")[11], 60.0);
    let pairs = si
        .numbers("x_slide_min (m)")
        .into_iter()
        .zip(mm.numbers("x_slide_min (mm)"));
    for (m, mm) in pairs {
        assert_eq!(m * 1000.0, mm);
    }
    // A length without a unit is in meters at both ends.
    let ran = folder
        .run("sweep a.mech --vary rod=0.2..300mm:3")
        .exits_with(2);
    assert!(
        ran.stderr.contains("write the unit of both"),
        "{}",
        ran.stderr
    );
}

#[test]
fn a_varied_input_is_at_rest() {
    let folder = Folder::new("sweep_inputs", RAM);
    let options = "--vary tilt=0..60deg:3 --to 0 --show phi_crank,phi_crank_d,x_slide";
    let solved = table(&folder, options);
    let angles = solved.numbers("phi_crank_min (rad)");
    for (angle, degrees) in angles.into_iter().zip([0.0_f64, 30.0, 60.0]) {
        assert!((angle - degrees.to_radians()).abs() < 1e-15);
    }
    assert_eq!(solved.numbers("phi_crank_d_max (rad/s)"), [PI; 3]);
    // Without a varied input, laws of inputs hold.
    let law = table(
        &folder,
        "--vary radius=20mm..40mm:2 --set tilt=2*t --to 0 --show phi_crank_d",
    );
    assert_eq!(law.numbers("phi_crank_d_max (rad/s)"), [PI + 2.0; 2]);
    // A constant law of another input holds; one that changes with time does not go with a varied input.
    let beside = table(
        &folder,
        "--vary tilt=0..60deg:3 --set lift=30mm --to 0 --show y_slide",
    );
    assert_eq!(beside.numbers("y_slide_max (m)"), [0.03; 3]);
    let ran = folder.run("sweep a.mech --vary tilt=0..60deg:3 --set lift=0.01*t --to 1");
    let ran = ran.exits_with(2);
    assert!(
        ran.stderr.contains("the input `lift` changes with time"),
        "{}",
        ran.stderr
    );
}

/// A slide on a line, moved by an input.
const LIMITED: &str = "mechanism slide {
    param offset = 71mm from 7.1mm to 160mm;
    input stroke = 0deg from -10deg to 10deg;
    body 1 at (0, 0) { P: (offset, 0) }
    absolute_x(1) = 0;
    absolute_y(1) = 0;
    drive phi(1) = stroke;
}
";

#[test]
fn ranges_of_the_description_are_swept_and_kept() {
    let folder = Folder::new("sweep_ranges", LIMITED);
    let of = |options: &str| {
        table(
            &folder,
            &format!("{options} --units=mm,deg --to 0 --show P_x,phi1"),
        )
    };
    let swept = of("--vary offset:3 --vary stroke:3");
    assert_eq!(
        swept.numbers("offset (mm)"),
        [7.1, 7.1, 7.1, 83.55, 83.55, 83.55, 160.0, 160.0, 160.0]
    );
    assert_eq!(swept.numbers("stroke (deg)")[..3], [-10.0, 0.0, 10.0]);
    // Rounding in the unit of the column does not leave the range.
    assert!(
        swept
            .numbers("P_x_max (mm)")
            .iter()
            .all(|it| it.is_finite())
    );
    assert_eq!(of("--vary offset --vary stroke --samples 8").rows.len(), 8);
    std::fs::write(folder.file("sets.csv"), "offset (mm)\n7\n7.1\n160\n161\n").expect("written");
    let rows = of("--rows sets.csv");
    let failures = rows.column("failure");
    let outside = "a value is outside of its range";
    assert_eq!(failures, [outside, "", "", outside]);
    assert_eq!(rows.column("failure_block"), ["offset", "", "", "offset"]);
    for (options, expected) in [
        (
            "--vary offset=7mm..100mm:3",
            "`offset` is from 7.1 mm to 160 mm",
        ),
        ("--vary offset", "has no number of values"),
        ("--vary offset:1", "has two ends, but one value"),
        ("--vary offset:x", "is not a number of values"),
        ("--vary ofset:3", "is not a range"),
    ] {
        let ran = folder.run(&format!("sweep a.mech {options}")).exits_with(2);
        assert!(ran.stderr.contains(expected), "{options}: {}", ran.stderr);
    }
}
