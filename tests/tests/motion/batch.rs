//! A batch gives each set of parameters the bits of its own shell: in every description, whatever the sets beside it do.

use std::collections::BTreeMap;

use linkwright::{Blocks, Failure, Settings, Shell};
use linkwright_solver::{
    Batch, InputSignals, Interpreted, Numbers, Observable, Outcome, View, WrongLength,
};
use linkwright_tests::description;
use linkwright_tests::random::Random;

/// Number of sets: more than lanes, and no multiple of them.
const SETS: usize = 21;

/// Instants: small steps, then large ones, back, and beyond the range of most motions.
fn times() -> Vec<f64> {
    let small = (0..40).map(|step| 0.02 * f64::from(step));
    small.chain([2.5, 1.0, 1.3, 0.0, 30.0]).collect()
}

/// Parameters around the nominal ones; every third set is far from them, and one is not positive.
fn parameters(blocks: &Interpreted, random: &mut Random) -> Vec<f64> {
    let nominal = blocks.nominal_parameters().0;
    let sets = (0..SETS).flat_map(|set| {
        let spread = [0.001, 0.02, 0.6][set % 3];
        let sign = if set == 5 { -1.0 } else { 1.0 };
        let factors: Vec<f64> = nominal
            .iter()
            .map(|_| sign * (1.0 + random.between(-spread, spread)))
            .collect();
        let values = nominal.iter().zip(factors);
        values
            .map(|(value, factor)| value * factor)
            .collect::<Vec<f64>>()
    });
    sets.collect()
}

/// Solves one set by a shell of its own.
fn alone(
    batch: &Batch<'_>,
    parameters: &[f64],
    inputs: impl Fn(f64) -> InputSignals,
) -> (Vec<f64>, Outcome) {
    let blocks = batch.blocks;
    let parameters = Numbers(parameters.to_vec());
    let of_instant = batch.observables.len();
    let mut values = vec![f64::NAN; batch.times.len() * of_instant];
    let mut outcome = Outcome::default();
    let assembled = Shell::assemble(
        blocks.clone(),
        &parameters,
        &blocks.drawn_pose(&parameters),
        blocks.drawn_branches(),
        batch.times[0],
        &inputs(batch.times[0]),
        Settings::default(),
    );
    let mut shell = match assembled {
        Ok(shell) => shell,
        Err(failure) => {
            outcome.failure = Some(failure);
            return (values, outcome);
        }
    };
    for (place, &t) in batch.times.iter().enumerate() {
        let result = match (place, batch.follows_path) {
            (0, _) => Ok(shell.frame().clone()),
            (_, true) => shell.advance(t, &inputs(t)).cloned(),
            (_, false) => shell.frame_at(t, &inputs(t)),
        };
        match result {
            Ok(at) => {
                let measured = Observable::values(blocks, batch.observables, &at);
                values[place * of_instant..][..of_instant].copy_from_slice(&measured);
                outcome.solved += 1;
            }
            Err(failure) => {
                outcome.failure.get_or_insert(failure);
                if batch.follows_path {
                    break;
                }
            }
        }
    }
    (values, outcome)
}

/// True if numbers have the same bits, or are both NaN.
fn are_equal(one: &f64, other: &f64) -> bool {
    one.to_bits() == other.to_bits() || one.is_nan() && other.is_nan()
}

/// Name of the kind of a failure.
fn kind(failure: &Failure) -> String {
    let debug = format!("{:?}", failure.kind);
    debug
        .chars()
        .take_while(|it| it.is_alphanumeric())
        .collect()
}

#[test]
fn sets_have_the_bits_of_their_own_shells_in_all_descriptions() {
    let mut kinds: BTreeMap<String, usize> = BTreeMap::new();
    let (mut compared, mut ended) = (0, 0);
    let times = times();
    for name in description::names().iter().chain(&description::small()) {
        // Another description does not change the sets of this one.
        let mut random = Random::new(35);
        for derived in description::motions(name) {
            let Some(blocks) = Interpreted::new(&derived) else {
                continue;
            };
            let all = Observable::all(blocks.derived()).into_iter();
            let observables: Vec<Observable> = all.map(|(_, it)| it).collect();
            let parameters = parameters(&blocks, &mut random);
            let count = parameters.len() / SETS;
            let laws = blocks.input_laws();
            for follows_path in [true, false] {
                let mut batch = Batch::new(&blocks, &times, &observables);
                batch.follows_path = follows_path;
                batch.threads = if follows_path { 1 } else { 3 };
                let of_set = times.len() * observables.len();
                let mut values = vec![0.0; SETS * of_set];
                let outcomes = batch.solve(&parameters, &[], &mut values).expect("lengths");
                for (set, outcome) in outcomes.iter().enumerate() {
                    let own_parameters = &parameters[set * count..][..count];
                    let (expected, expected_outcome) =
                        alone(&batch, own_parameters, |t| laws.at(t));
                    assert_eq!(
                        format!("{outcome:?}"),
                        format!("{expected_outcome:?}"),
                        "{name}, set {set}, {follows_path}"
                    );
                    let row = &values[set * of_set..][..of_set];
                    let wrong = row
                        .iter()
                        .zip(&expected)
                        .position(|(it, other)| !are_equal(it, other));
                    assert_eq!(wrong, None, "{name}, set {set}, {follows_path}");
                    compared += row.len();
                    if let Some(failure) = &outcome.failure {
                        ended += 1;
                        *kinds.entry(kind(failure)).or_default() += 1;
                    }
                }
            }
        }
    }
    println!("{compared} values of equal bits; {ended} sets that fail: {kinds:?}");
    assert!(compared > 1_000_000 && ended > 500, "{compared}, {ended}");
    for kind in [
        "FrictionUnsettled",
        "NotPositive",
        "OutOfReach",
        "OutsideRange",
        "StepTooLarge",
        "Singular",
    ] {
        assert!(
            kinds.contains_key(kind),
            "no set fails as {kind}: {kinds:?}"
        );
    }
}

/// Inputs of a set stay as they are; one that is not finite ends its own set alone.
#[test]
fn sets_may_have_inputs_of_their_own() {
    let derived = description::written(
        "mechanism crane {
            input turned = 30deg;
            point O = (0, 0);
            body boom at (0, 0, 30deg) { O: (0, 0), A: (2, 0) }
            revolute O(ground, boom);
            drive phi(boom) = turned;
        }",
    );
    let blocks = Interpreted::new(&derived).expect("a plan");
    let angle = [Observable::Coordinate { place: 2, level: 0 }];
    let mut inputs: Vec<InputSignals> = vec![blocks.initial_inputs(); 10];
    for (set, inputs) in inputs.iter_mut().enumerate() {
        inputs.0[0].value = 0.1 * set as f64;
    }
    inputs[4].0[0].value = f64::NAN;
    let mut values = [0.0; 20];
    let batch = Batch::new(&blocks, &[0.0, 0.1], &angle);
    let outcomes = batch.solve(&[], &inputs, &mut values).expect("lengths");
    for (set, outcome) in outcomes.iter().enumerate() {
        let expected = 0.1 * set as f64;
        let row = &values[2 * set..][..2];
        match set {
            4 => assert!(outcome.failure.is_some() && row.iter().all(|it| it.is_nan())),
            _ => assert_eq!((row, outcome.failure), (&[expected; 2][..], None)),
        }
    }
    // Those of each set at each instant.
    let mut values = [0.0; 10];
    let outcomes = batch.solve(&[], &inputs, &mut values).expect("lengths");
    assert_eq!((values[2], values[3]), (0.2, 0.30000000000000004));
    assert_eq!(outcomes[2].solved, 0);
    assert!(outcomes[2].failure.is_some() && values[4..6].iter().all(|it| it.is_nan()));
    assert_eq!(values[8..], [0.8, 0.9]);
    let mut values = [0.0; 3];
    assert_eq!(
        batch.solve(&[], &inputs, &mut values),
        Err(WrongLength::Values {
            of_set: 2,
            found: 3
        })
    );
    let mut values = [0.0; 4];
    assert_eq!(
        batch.solve(&[], &inputs, &mut values),
        Err(WrongLength::Inputs {
            sets: 2,
            instants: 2,
            found: 10
        })
    );
    assert_eq!(
        batch.solve(&[1.0], &inputs[..2], &mut values),
        Err(WrongLength::Parameters {
            expected: 0,
            found: 1
        })
    );
}
