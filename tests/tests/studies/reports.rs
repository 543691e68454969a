//! Rows of committed reports that hold counts or errors are those that are computed now.
//!
//! A row that differs is written again by the study of the report; `cargo run --release -p linkwright-tests --bin reports` runs all studies.

use linkwright_tests::chains::compiled::CHAINS;
use linkwright_tests::chains::measure::{COARSE, measure as measure_chain};
use linkwright_tests::chains::report::{errors, sweeps};
use linkwright_tests::description;
use linkwright_tests::proofs;
use linkwright_tests::simulation_tables::{damped_table, sleds};
use linkwright_tests::stability::families::families;
use linkwright_tests::stability::report::judged;
use linkwright_tests::stability::verdict::Scalar;
use linkwright_tests::starts::measure::{Outcomes, measure as measure_starts};
use linkwright_tests::starts::report::table as starts_table;
use linkwright_tests::stiff::Damped;
use linkwright_tests::study::committed::{Committed, rows};
use linkwright_tests::study::measurement::{Effort, measure};
use linkwright_tests::study::table::{aligned, markdown};

/// Asserts that every row of a table is among the rows below a heading of a report. Columns whose titles are in `times` are left out.
fn assert_repeated(report: &Committed, heading: &str, table: &str, times: &[&str]) {
    let committed = report.rows_below(heading);
    let computed = rows(table);
    assert!(computed.len() > 1, "{}, {heading}: no row", report.name);
    let kept: Vec<usize> = (0..computed[0].len())
        .filter(|&column| !times.contains(&computed[0][column].as_str()))
        .collect();
    let cells = |row: &[String]| -> Option<Vec<String>> {
        kept.iter()
            .map(|&column| row.get(column).cloned())
            .collect()
    };
    for row in &computed {
        let row = cells(row);
        let is_there = committed.iter().any(|it| cells(it) == row);
        assert!(
            is_there,
            "tests/reports/{}, {heading}: {row:?} is not in the report:\n{committed:#?}",
            report.name
        );
    }
}

#[test]
fn proofs_of_motions_are_repeated() {
    let report = Committed::read("proofs.md");
    let mut rows = vec![proofs::TITLES.map(str::to_string)];
    for name in ["two_body", "four_bar"] {
        let verdict = proofs::judged(&description::system(name), [0.0, 5.0], 1000);
        rows.push(verdict.row(name));
    }
    assert_repeated(&report, "Proofs of whole motions", &aligned(&rows, 1), &[]);
}

#[test]
fn errors_and_evaluations_of_simulations_are_repeated() {
    let report = Committed::read("simulation.md");
    assert_repeated(&report, "Sled", &sleds(2.0), &[]);
    let slider = damped_table(Damped::Slider, 10.0, 2.0);
    assert_repeated(&report, "Slider, 1e1 N·s/m", &slider, &[]);
}

#[test]
fn errors_of_chains_are_repeated() {
    let report = Committed::read("chains.md");
    let chain = measure_chain(&CHAINS[0], Scalar::F64, COARSE);
    let heading = format!("f64, steps of {} s", COARSE.step);
    assert_repeated(&report, &heading, &errors([&chain].into_iter()), &[]);
    assert_repeated(&report, "All sweeps", &sweeps(&[chain]), &[]);
}

#[test]
fn counts_of_poor_estimates_are_repeated() {
    let report = Committed::read("starts.md");
    let measured = measure_starts(&description::system("two_body"), 10_000);
    let one = |outcomes: &Outcomes| starts_table(&[(&measured.name, outcomes)]);
    for (heading, outcomes) in [
        (
            "The textbook view, `assemble_from_rough_estimate`",
            Some(&measured.afar),
        ),
        ("The textbook view, `assemble`", Some(&measured.plain)),
        (
            "The generated mechanism, `assemble_from`",
            measured.generated.as_ref(),
        ),
    ] {
        let outcomes = outcomes.expect("two_body is measured in three ways");
        assert_repeated(&report, heading, &one(outcomes), &[]);
    }
}

#[test]
fn cells_of_stability_are_repeated() {
    let report = Committed::read("stability.md");
    let family = families().into_iter().next().expect("a family");
    let title = family.title;
    assert_repeated(&report, title, &judged(family, 1).table(), &[]);
}

#[test]
fn errors_of_methods_are_repeated() {
    let report = Committed::read("work-precision.md");
    let roughly = Effort {
        repeats: 1,
        shortest: 0.0,
    };
    for name in ["two_body", "four_bar"] {
        let measurements = measure(name, roughly, |_| {});
        let times = [
            "ns per frame",
            "fastest–slowest",
            "times faster than the baseline",
        ];
        assert_repeated(&report, name, &markdown(&measurements, 1.0), &times);
    }
}
