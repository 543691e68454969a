//! Energies, limits and failures of mechanisms with friction.

use linkwright::FailureKind;
use linkwright_solver::{Interpreted, Numbers};
use linkwright_tests::description;
use linkwright_tests::description::written;

use super::{followed, solved};

#[test]
fn powers_and_friction_balance_the_energies() {
    // The powers of drivers and what is added are the rate of both energies; a central difference of those, to its own error.
    let derived = description::system("rubbing_press");
    let view = Interpreted::new(&derived).expect("a motion");
    let (columns, _) = followed(&view, None, 0.01);
    let names = [
        "kinetic_energy",
        "potential_energy",
        "power_motor",
        "added_power",
        "frictionless_power",
    ];
    let mut rows = Vec::new();
    columns.each(&names, |instant, values| {
        rows.push((instant.t(), values.to_vec()))
    });
    let (mut worst, mut lost) = (0.0_f64, 0.0_f64);
    for around in rows.windows(3) {
        let energy = |it: &(f64, Vec<f64>)| it.1[0] + it.1[1];
        let rate = (energy(&around[2]) - energy(&around[0])) / (around[2].0 - around[0].0);
        let [_, _, power, added, frictionless] = around[1].1[..] else {
            panic!("five columns");
        };
        worst = worst.max((power + added - rate).abs());
        lost = lost.max(power - frictionless);
    }
    println!("{worst:e} W, beside {lost} W of friction");
    assert!(worst < 1e-5 && lost > 1.0);
}

#[test]
fn joints_without_a_coefficient_are_without_friction() {
    let source = description::source("rubbing_press");
    let plain: Vec<&str> = source
        .text
        .lines()
        .filter(|line| !line.trim_start().starts_with("friction"))
        .collect();
    let smooth = source
        .text
        .replace("mu = 0.15", "mu = 0")
        .replace("= 0.2 radius", "= 0 radius");
    let smooth = smooth.replace("guide = 0.1 over", "guide = 0 over");
    let smooth = solved(&written(&smooth), 2.0);
    let plain = plain
        .join("\n")
        .replace("param mu = 0.15;", "")
        .replace("param pin = 12mm;", "");
    let plain = solved(&written(&plain), 2.0);
    let names: Vec<&str> = plain.names.iter().map(String::as_str).collect();
    let mut rows = plain.rows.iter();
    smooth.each(&names, |_, values| {
        let (_, row) = rows.next().expect("as many");
        for ((name, value), expected) in names.iter().zip(values).zip(row) {
            let size = expected.abs().max(1.0);
            assert!(
                (value - expected).abs() < 1e-12 * size,
                "{name}: {value}, {expected}"
            );
        }
    });
}

#[test]
fn a_ladder_jams_at_the_angle_of_friction() {
    let derived = description::system("jamming_ladder");
    let view = Interpreted::new(&derived).expect("a motion");
    let parameters = Numbers(vec![0.8, 1.0]);
    let (columns, failure) = followed(&view, Some(parameters), 1.0);
    let failure = failure.expect("it jams");
    assert!(
        matches!(failure.kind, FailureKind::FrictionUnsettled { .. }),
        "{failure:?}"
    );
    // The pull T along the ladder at the angle b moves the foot by T cos b, and friction takes mu |T sin b - N| with the rest N of its load.
    let height = 0.5 + 0.35 * (2.0 * failure.time).sin();
    println!(
        "jams at t = {}, {}°",
        failure.time,
        height.asin().to_degrees()
    );
    assert!(!columns.rows.is_empty() && (height.asin().tan() - 1.25).abs() < 1e-3);
    // Less friction moves it on.
    let parameters = Numbers(vec![0.2, 1.0]);
    let (columns, failure) = followed(&view, Some(parameters), 1.0);
    assert_eq!((columns.rows.len(), failure), (101, None));
    // Parameters of impossible friction are refused.
    let (_, failure) = followed(&view, Some(Numbers(vec![-0.1, 1.0])), 1.0);
    let kind = failure.map(|it| it.kind);
    assert!(
        matches!(kind, Some(FailureKind::NotPositive { .. })),
        "{kind:?}"
    );
}

#[test]
fn nothing_rubs_at_rest() {
    let mut derived = description::system("rubbing_press");
    derived.system = derived.system.at_rest(&mut derived.pool);
    let columns = solved(&derived, 1.0);
    let names = [
        "friction_o",
        "friction_guide",
        "frictionless_power",
        "backward_power",
    ];
    columns.each(&names, |_, values| {
        assert!(values.iter().all(|it| *it == 0.0))
    });
}
