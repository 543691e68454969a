//! The study of error against run time measures what it says.

use std::fs;

use linkwright_tests::method::{methods, studied};
use linkwright_tests::study::measurement::{Effort, Measurement, measure};
use linkwright_tests::study::{chart, table};

const ROUGHLY: Effort = Effort {
    repeats: 1,
    shortest: 0.0,
};

fn measured(name: &str) -> Vec<Measurement> {
    measure(name, ROUGHLY, |_| {})
}

fn found<'a>(measurements: &'a [Measurement], name: &str) -> &'a Measurement {
    let named = measurements.iter().find(|it| it.name == name);
    named.unwrap_or_else(|| panic!("no method `{name}`"))
}

/// The errors do not depend on how long is measured; times are not judged here.
#[test]
fn polishing_reaches_rounding_and_a_coarse_tolerance_does_not() {
    for name in studied() {
        let measurements = measured(name);
        for it in &measurements {
            assert!(it.time > 0.0 && it.range[0] <= it.time && it.time <= it.range[1]);
        }
        for family in ["textbook", "textbook without predictor"] {
            let polished = found(&measurements, &format!("{family}, 1e-12, polished"));
            let coarse = found(&measurements, &format!("{family}, 1e-6"));
            for level in 0..3 {
                let (fine, rough) = (polished.errors[level], coarse.errors[level]);
                assert!(fine <= 1e-12, "{name}, {family}: {fine:e}");
                assert!(
                    rough > fine,
                    "{name}, {family}: {rough:e} at 1e-6, {fine:e} polished"
                );
            }
        }
    }
}

#[test]
fn every_mechanism_is_compared_with_the_baseline_first() {
    for name in studied() {
        let methods = methods(name);
        assert!(methods[0].name().ends_with("(baseline)"), "{name}");
        let mut names: Vec<String> = methods
            .iter()
            .map(|method| format!("{} {}", method.name(), method.scalar()))
            .collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(
            names.len(),
            methods.len(),
            "{name}: two methods of one name"
        );
    }
}

#[test]
fn a_report_is_a_function_of_what_was_measured() {
    let measurement = |family: &str, time: f64| Measurement {
        family: family.to_string(),
        setting: String::new(),
        name: family.to_string(),
        scalar: "f64",
        // No error at all must still find a place on the logarithmic axis.
        errors: [0.0, 2.5e-15, 1e-12],
        time,
        range: [time - 1.0, time + 1.0],
    };
    let measurements = [measurement("slow", 1000.0), measurement("fast", 12.5)];
    let table = table::markdown(&measurements, 1000.0);
    let rows: Vec<Vec<&str>> = table
        .lines()
        .map(|line| line.split('|').map(str::trim).collect())
        .collect();
    assert_eq!(
        rows[3][1..9],
        [
            "fast",
            "f64",
            "0.0e0",
            "2.5e-15",
            "1.0e-12",
            "12.5",
            "11.5–13.5",
            "80.00"
        ]
    );
    let folder = std::env::temp_dir();
    let draw = |part: &str| {
        let file = folder.join(format!(
            "linkwright-chart-{}-{part}.svg",
            std::process::id()
        ));
        chart::draw(&file, "a title", &measurements).expect("a chart");
        let svg = fs::read_to_string(&file).expect("the chart");
        fs::remove_file(&file).expect("the chart can be removed");
        svg
    };
    let svg = draw("first");
    assert_eq!(svg, draw("second"));
    assert!(svg.contains("slow (f64)") && svg.contains("acceleration"));
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
}
