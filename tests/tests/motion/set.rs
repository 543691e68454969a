//! Parameters and inputs set in an interpreter give the motion that is planned for their values.

use linkwright::{Blocks, Settings};
use linkwright_codegen::stages::model;
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::{Instant, Interpreted, View};
use linkwright_tests::description;
use linkwright_tests::values::assembled_with;

/// Instants of a motion (s).
const TIMES: [f64; 5] = [0.0, 0.05, 0.1, 0.15, 0.2];

/// Relative difference that rounding explains between two plans of one motion.
const LIMIT: f64 = 1e-11;

/// Changes by which most mechanisms still close.
const CHANGE: f64 = 0.003;

/// Returns an assignment of a slightly different value to each parameter and input.
fn assignments(derived: &Derived) -> Vec<String> {
    let mechanism = &derived.system.mechanism;
    let graph = &derived.pool.graph;
    let parameters = mechanism.parameters.iter();
    let parameters = parameters.map(|it| (&it.name, it.dimension, graph.nominal(it.symbol)));
    let inputs = mechanism.inputs.iter();
    let inputs = inputs.map(|it| (&it.name, it.dimension, graph.constant_value(it.initial)));
    let changed = parameters.chain(inputs).map(|(name, dimension, value)| {
        let value = match value.expect("a number") {
            0.0 => CHANGE,
            value => value * (1.0 + CHANGE),
        };
        let unit = match dimension.unit_if_known().as_str() {
            "" => String::new(),
            unit => format!("*1{unit}"),
        };
        format!("{name} = {value:e}{unit}")
    });
    changed.collect()
}

fn instants(blocks: &Interpreted) -> Vec<Instant> {
    let laws = blocks.input_laws();
    let settings = Settings::default();
    let Ok(mut shell) = assembled_with(blocks.clone(), &[], TIMES[0], &laws.at(TIMES[0]), settings)
    else {
        return Vec::new();
    };
    let mut instants = vec![shell.frame().clone()];
    for t in &TIMES[1..] {
        match shell.advance(*t, &laws.at(*t)) {
            Ok(instant) => instants.push(instant.clone()),
            Err(_) => break,
        }
    }
    instants
}

#[test]
fn a_set_value_gives_the_motion_that_is_planned_for_it() {
    let (mut compared, mut equal) = (0, 0);
    for name in description::names() {
        for mut derived in description::motions(&name) {
            let Some(mut set) = Interpreted::new(&derived) else {
                continue;
            };
            let nominal = instants(&set);
            let assignments = assignments(&derived);
            for assignment in &assignments {
                set.set("value", assignment)
                    .unwrap_or_else(|error| panic!("{name}: {error}"));
                let Derived { pool, system } = &mut derived;
                model::set(pool, &mut system.mechanism, "value", assignment).expect("as above");
            }
            let planned = Interpreted::new(&derived).expect("as before");
            assert_eq!(
                set.nominal_parameters(),
                planned.nominal_parameters(),
                "{name}"
            );
            let [set, planned] = [&set, &planned].map(instants);
            assert_eq!(set.len(), planned.len(), "{name}");
            for (one, other) in set.iter().zip(&planned) {
                let size = one.q().iter().fold(1.0_f64, |size, it| size.max(it.abs()));
                for (one, other) in one.q().iter().zip(other.q()) {
                    assert!(
                        (one - other).abs() < LIMIT * size,
                        "{name}: {one} and {other}"
                    );
                    equal += usize::from(one.to_bits() == other.to_bits());
                    compared += 1;
                }
            }
            let is_moved = set
                .iter()
                .zip(&nominal)
                .any(|(one, other)| one.q() != other.q());
            assert!(
                assignments.is_empty() || set.is_empty() || is_moved,
                "{name}"
            );
        }
    }
    assert!(compared > 1000, "{compared} coordinates");
    assert_eq!(equal, compared, "the set motion has other bits");
}

#[test]
fn a_rejected_assignment_changes_nothing() {
    let derived = description::system("four_bar_given");
    let mut blocks = Interpreted::new(&derived).expect("the equations determine the motion");
    let before = blocks.nominal_parameters();
    for assignment in [
        "",
        "=",
        "a",
        "a = ",
        "a = 1kg",
        "nothing = 1",
        "a = t",
        "a = 1m; b = 2m",
    ] {
        blocks.set("value", assignment).expect_err(assignment);
        assert_eq!(blocks.nominal_parameters(), before, "{assignment}");
    }
}
