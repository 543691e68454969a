//! `linkwright tolerance` from the outside: spreads of a slider-crank, files, seeds and bad input.

use serde_json::Value;

use crate::folder::{Folder, Ran};

/// A crank that turns by two radians in a second, a rod and a ram in line.
const RAM: &str = "mechanism ram {
    units mm;
    param radius = 50mm tolerance 0.1mm;
    param rod = 200mm sigma 0.05mm;
    point O = (0, 0);
    body crank at O { O, A: (radius, 0) }
    body link at (radius, 0) { A: (0, 0), B: (rod, 0) }
    body slide at (radius + rod, 0) { B: (0, 0) }
    revolute O(ground, crank);
    revolute A(crank, link);
    revolute B(link, slide);
    absolute_y(slide) = 0;
    absolute_angle(slide) = 0;
    drive phi(crank) = 2*t;
    measure place = B.x;
    measure surge = rate(rate(place));
}
";

fn ran(name: &str, text: &str, arguments: &[&str]) -> (Folder, Ran) {
    let folder = Folder::new(name, text);
    let mut command = folder.command();
    let ran = command.args(["tolerance", "a.mech"]).args(arguments);
    let ran = Ran::from(ran.output().expect("the command starts"));
    (folder, ran)
}

fn numbers(value: &Value) -> Vec<f64> {
    let values = value.as_array().expect("a list").iter();
    values.map(|it| it.as_f64().expect("a number")).collect()
}

#[test]
fn spreads_are_those_of_the_closed_form() {
    let arguments = ["--to", "1", "--step", "0.1", "--samples", "500", "--json"];
    let (_, ran) = ran("tolerance_json", RAM, &arguments);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let object: Value = serde_json::from_str(&ran.stdout).expect("JSON");
    let place = &object["measures"][0];
    assert_eq!(
        (&place["measure"], &place["unit"]),
        (&"place".into(), &"mm".into())
    );
    assert_eq!(place["derivatives"], "exact");
    assert_eq!(object["measures"][1]["derivatives"], "differences");
    let (worst, deviation) = (numbers(&place["worst_case"]), numbers(&place["deviation"]));
    for (frame, t) in numbers(&object["t"]).into_iter().enumerate() {
        let (sine, cosine) = (2.0 * t).sin_cos();
        let root = (200.0_f64.powi(2) - (50.0 * sine).powi(2)).sqrt();
        let slopes = [cosine - 50.0 * sine * sine / root, 200.0 / root];
        let solved = numbers(&place["slopes"][frame]);
        assert!((solved[0] - slopes[0]).abs() < 1e-12 && (solved[1] - slopes[1]).abs() < 1e-12);
        let expected = slopes[0].abs() * 0.1 + slopes[1] * 0.15;
        assert!((worst[frame] - expected).abs() < 1e-12);
        let expected = ((slopes[0] * 0.1).powi(2) / 3.0 + (slopes[1] * 0.05).powi(2)).sqrt();
        assert!((deviation[frame] - expected).abs() < 1e-12);
    }
    let parts = numbers(&place["largest_worst_case"]["parts"]);
    let largest = place["largest_worst_case"]["value"]
        .as_f64()
        .expect("a number");
    assert!((parts.iter().sum::<f64>() - largest).abs() < 1e-12);
    let shares = numbers(&place["largest_deviation"]["parts"]);
    assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    assert_eq!(place["sampled"]["departures"], Value::Array(Vec::new()));
    assert_eq!(object["samples"]["unassembled"], 0);
}

#[test]
fn seeds_decide_the_samples() {
    let printed = |name, arguments: &[&str]| {
        let shared = ["--to", "0.2", "--step", "0.1"];
        let (_, ran) = ran(name, RAM, &[&shared, arguments].concat());
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        ran.stdout
    };
    let sampled =
        |name, arguments: &[&str]| printed(name, &[&["--samples", "300"], arguments].concat());
    let first = sampled("tolerance_seed", &["--seed", "7"]);
    assert_eq!(
        first,
        sampled("tolerance_seed_again", &["--seed", "7", "--threads", "3"])
    );
    let other = sampled("tolerance_other_seed", &["--seed", "8"]);
    let random = sampled("tolerance_random", &["--seed", "7", "--sampling", "random"]);
    let samples = |text: &str| {
        text.lines()
            .filter(|it| it.contains("standard deviation"))
            .map(str::to_string)
            .collect::<Vec<_>>()
    };
    assert_eq!(samples(&first).len(), 4);
    assert!(samples(&first) != samples(&other) && samples(&first) != samples(&random));
    let alone = printed("tolerance_linear", &["--samples", "0"]);
    assert!(first.starts_with(&alone) && !alone.contains("sampled"));
}

#[test]
fn pictures_are_written() {
    let arguments = [
        "--to",
        "1",
        "--step",
        "0.1",
        "--samples",
        "100",
        "--plot",
        "pictures",
    ];
    let (folder, ran) = ran("tolerance_plot", RAM, &arguments);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    for name in ["place", "surge"] {
        let picture = folder.read(&format!("pictures/{name}_spread.svg"));
        assert!(picture.contains("worst case") && picture.contains("99.73 % of samples"));
        assert!(ran.stdout.contains(&format!("{name}_spread.svg")));
    }
}

#[test]
fn motions_that_end_early() {
    let short = RAM.replace("200mm sigma", "49mm sigma");
    let (_, printed) = ran(
        "tolerance_ended",
        &short,
        &["--to", "1", "--samples", "100"],
    );
    assert_eq!(printed.code, Some(1));
    assert!(
        printed.stderr.contains("cannot be solved beyond"),
        "{}",
        printed.stderr
    );
    // Frames of the nominal motion are reported, which all samples reach.
    assert!(printed.stdout.contains("100 sampled mechanisms"));
}

#[test]
fn bad_input_is_refused() {
    let exact = RAM
        .replace(" tolerance 0.1mm", "")
        .replace(" sigma 0.05mm", "");
    let unmeasured = RAM.replace("    measure", "    // measure");
    let free = "mechanism bob {
    param l = 1m tolerance 1mm;
    point O = (0, 0);
    body bob at (0, 0, -80deg) { O, C: (l, 0) }
    revolute O(ground, bob);
    free swing: phi(bob) = -80deg;
    mass bob = 1kg at C;
    gravity = (0, -9.81);
    measure height = C.y;
}
";
    for (name, text, arguments, message) in [
        (
            "exact",
            exact.as_str(),
            &[][..],
            "no parameter has a tolerance, and no pin a clearance",
        ),
        (
            "unmeasured",
            unmeasured.as_str(),
            &[][..],
            "nothing is measured",
        ),
        ("free", free, &[][..], "forces move coordinates"),
        ("set", RAM, &["--set", "rod = 1kg"][..], "error"),
        (
            "many",
            RAM,
            &["--samples", "1000000", "--step", "1ms"][..],
            "pass fewer with `--samples`",
        ),
        ("negative", RAM, &["--samples=-1"][..], "error"),
        ("stdout", RAM, &["--plot", "-"][..], "takes a folder"),
        ("motion", RAM, &["--motion", "away"][..], "has no motions"),
    ] {
        let (_, ran) = ran(&format!("tolerance_bad_{name}"), text, arguments);
        assert_eq!(ran.code, Some(2), "{name}: {}", ran.stderr);
        assert!(ran.stderr.contains(message), "{name}: {}", ran.stderr);
        assert!(ran.stdout.is_empty(), "{name}");
    }
}
