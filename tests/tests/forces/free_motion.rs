//! Free motions of the gallery from random states, against all coordinates integrated with multipliers.

use linkwright_tests::files;
use linkwright_tests::forces::{Weight, systems};
use linkwright_tests::free_motion::{LEFT_OUT, MECHANISMS, Outcome, TOLERANCES, Verdict};
use linkwright_tests::multipliers::{Motion, Multipliers, apart};
use linkwright_tests::simulated::PENDULUM;
use nalgebra::DVector;

/// Judges states of mechanisms: no motion ends with a wrong result, and at least this number is compared.
fn judge(names: &[&str], states: u64, seed: u64, least: usize) {
    let mut compared = 0;
    for name in names {
        let freed = MECHANISMS.iter().find(|it| it.file == *name);
        let freed = freed.expect("a mechanism of the list");
        for verdict in (0..states).flat_map(|state| freed.judged(seed, state, &TOLERANCES)) {
            println!("{verdict:?}");
            assert!(!verdict.is_wrong(), "{verdict:?}");
            compared += usize::from(matches!(verdict.outcome, Outcome::Went(_)));
        }
    }
    assert!(compared >= least, "{compared}");
}

#[test]
fn beside_dead_centers_motions_are_right() {
    let names = [
        "four_bar",
        "slider_crank",
        "inverted_slider_crank",
        "quick_return",
    ];
    judge(&names, 2, 1, 14);
}

#[test]
fn around_drawings_motions_are_right() {
    judge(&["stephenson", "peaucellier", "pantograph"], 1, 1, 2);
}

/// The pantograph starts at a normalized determinant of 7e-6: rounding there leaves eight digits of the motion, not ten.
#[test]
fn a_start_beside_a_change_point_ends_where_rounding_exceeds_tolerances() {
    let pantograph = MECHANISMS.iter().find(|it| it.file == "pantograph");
    let pantograph = pantograph.expect("a mechanism of the list");
    let verdicts = pantograph.judged(1, 126, &[1e-7, 1e-8, 1e-11, 1e-12]);
    for verdict in &verdicts {
        assert!(!verdict.is_wrong(), "{verdict:?}");
        match (verdict.relative < 1e-10, &verdict.outcome) {
            (false, Outcome::Went(_)) => (),
            (true, Outcome::Ended(stop)) => assert!(stop.contains("Rounded"), "{stop}"),
            _ => panic!("{verdict:?}"),
        }
    }
    assert_eq!(verdicts.len(), 4);
}

/// Each mechanism of the gallery moves freely, or is left out for a reason.
#[test]
fn all_mechanisms_are_listed() {
    let folder = files::repository().join("mechanisms");
    let files = files::with_extension(&folder, "mech");
    let files: Vec<&str> = files.iter().map(|it| files::stem(it)).collect();
    let listed = MECHANISMS.iter().map(|it| it.file);
    let mut listed: Vec<&str> = listed.chain(LEFT_OUT.map(|(file, _)| file)).collect();
    listed.sort_unstable();
    assert_eq!(listed, files);
}

/// NaN is neither right nor a reference: not in a pose, not in a rate, not in a mass, not in an error.
#[test]
fn nan_is_never_right() {
    let motion = |place: usize| {
        let numbers = |from: usize| {
            DVector::from_fn(3, |row, _| match from + row == place {
                true => f64::NAN,
                false => 1.0,
            })
        };
        Motion {
            pose: numbers(0),
            rates: numbers(3),
        }
    };
    let numbers = motion(6);
    assert_eq!(apart(&numbers, &numbers), 0.0);
    for place in 0..6 {
        assert!(apart(&numbers, &motion(place)).is_nan(), "{place}");
        assert!(apart(&motion(place), &numbers).is_nan(), "{place}");
    }
    let derived = &systems("pendulum", PENDULUM)[0];
    for (mass, is_found) in [(3.0, true), (f64::NAN, false)] {
        let weight = Weight {
            body: 0,
            mass,
            center: [0.0, -2.0],
            inertia: 0.5,
        };
        let reference = Multipliers::new(derived, &[weight], [0.0, -9.81]);
        let start = Motion {
            pose: DVector::from_vec(vec![0.0, 0.0, 1.0]),
            rates: DVector::zeros(3),
        };
        let reached = reference.after(&start, 0.1, 1e-12, &mut 1e-3);
        assert_eq!(reached.is_some(), is_found, "{mass}");
    }
    for (missed, is_wrong) in [(99.0, false), (101.0, true), (f64::NAN, true)] {
        let verdict = Verdict {
            file: "pendulum",
            state: 0,
            determinant: 1.0,
            relative: 1e-7,
            outcome: Outcome::Went(missed),
        };
        assert_eq!(verdict.is_wrong(), is_wrong, "{missed}");
    }
}
