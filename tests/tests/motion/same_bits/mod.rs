//! The interpreter computes the values of generated code, bit by bit: every motion of every description that is
//! compiled, along its path, with other parameters and inputs, back and forth and to its limits.

mod both;
mod frame_numbers;
mod paths;
mod shown;

use std::fmt::Debug;

use linkwright::math::Real;
use linkwright::{Blocks, Mechanism, Settings};
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::{InputSignals, Interpreted, View};
use linkwright_tests::description;
use linkwright_tests::values::{assembled_from, numbers};

use both::{Both, Frame};
use shown::shown;

/// Kinds of compared values.
const KINDS: [&str; 9] = [
    "requested",
    "point",
    "force",
    "derivative",
    "number of frames",
    "failure",
    "path",
    "bound",
    "shown",
];

/// Numbers of compared and of different values, for each kind.
type Tally = [[usize; 2]; KINDS.len()];

/// Motion of a description that is compiled.
pub struct Compared {
    name: &'static str,
    motion: usize,
    compare: fn(&Derived) -> Tally,
}

/// Values of frames that `output` limits: names of coordinates or points, 0 to 2 for the levels, and values.
type Outputs = Vec<(&'static str, usize, Vec<f64>)>;

/// Compares a compiled mechanism with the interpreted program that is written out, and with what reports show.
fn compare<M>(
    derived: &Derived,
    outputs: fn(&Frame<M>) -> Outputs,
    forces: fn(&Frame<M>) -> Vec<f64>,
    derivatives: fn(&Frame<M>) -> Vec<f64>,
) -> Tally
where
    M: Mechanism<Blocks: Blocks<Scalar = f64, Frame: Debug, PathEnclosures: Debug> + Default>,
{
    let emitted = Interpreted::emitted(derived).expect("a plan");
    let mut both = Both::<M>::new(&emitted, true, outputs, forces, derivatives);
    drive(&mut both, &emitted);
    let mut tally = both.tally();
    let fuller = Interpreted::new(derived).expect("a plan");
    if derived.system.mechanism.requests.is_empty() {
        let mut both = Both::<M>::new(&fuller, false, outputs, forces, derivatives);
        drive(&mut both, &fuller);
        for (sum, own) in tally.iter_mut().zip(both.tally()) {
            *sum = [sum[0] + own[0], sum[1] + own[1]];
        }
    } else {
        tally[8] = shown::<M>(&fuller, outputs);
    }
    tally
}

/// Moves both along the path, with other parameters and inputs, back and forth and to the limits.
fn drive<M>(both: &mut Both<'_, M>, view: &Interpreted)
where
    M: Mechanism<Blocks: Blocks<Scalar = f64, Frame: Debug, PathEnclosures: Debug> + Default>,
{
    let laws = view.input_laws();
    let nominal = numbers(&view.nominal_parameters());
    // Inputs that follow laws, and inputs of a caller that follow none.
    let other = |t: f64| {
        let mut inputs = laws.at(t);
        for (place, signal) in (0..).zip(&mut inputs.0) {
            let phase = 3.0 * t + f64::from(place);
            signal.value += 0.02 * phase.sin();
            signal.rate += 0.06 * phase.cos();
            signal.acceleration -= 0.18 * phase.sin();
        }
        inputs
    };
    both.assemble(&nominal, &laws.at(0.0), 0.0);
    for frame in 1..=200 {
        let t = 0.01 * f64::from(frame);
        both.advance(&laws.at(t), t);
    }
    // Large steps, back, and beyond the range.
    for t in [2.5, 1.0, 1.3, 4.0, 0.0, -0.7, 30.0] {
        both.advance(&laws.at(t), t);
    }
    // Inputs are finite where the time is not.
    for t in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        both.advance(&laws.at(0.5), t);
    }
    both.assemble(&nominal, &other(0.0), 0.0);
    for frame in 1..=50 {
        let t = 0.01 * f64::from(frame);
        both.advance(&other(t), t);
    }
    for factor in [1.01, 0.97, 1.3, -1.0] {
        let changed: Vec<f64> = (0..)
            .zip(&nominal)
            .map(|(place, value)| match place % 2 {
                0 => factor * value,
                _ => *value,
            })
            .collect();
        both.assemble(&changed, &other(0.1), 0.1);
        both.assemble(&nominal, &laws.at(0.0), 0.0);
        both.change(&changed);
        for frame in 1..=20 {
            let t = 0.02 * f64::from(frame);
            both.advance(&laws.at(t), t);
        }
    }
}

#[test]
fn interpreted_and_generated_numbers_are_the_same() {
    let mut all = [0; KINDS.len()];
    let mut differing = Vec::new();
    for Compared {
        name,
        motion,
        compare,
    } in ALL
    {
        let tally = compare(&description::motions(name)[*motion]);
        for (kind, (sum, [count, different])) in KINDS.iter().zip(all.iter_mut().zip(tally)) {
            *sum += count;
            if different > 0 {
                differing.push(format!("{name} {motion}, {kind}: {different} of {count}"));
            }
        }
        let [_, _, _, _, frames, ..] = tally;
        assert!(frames[0] > 100, "{name}: hardly any frame");
    }
    assert!(differing.is_empty(), "{}", differing.join("\n"));
    for (kind, count) in KINDS.iter().zip(all) {
        println!("{kind}: {count} compared");
        assert!(count > 200, "{kind}: hardly any");
    }
}

/// Powers, roots and logarithms of generated code, which no description above has.
#[test]
fn interpreted_powers_and_logarithms_are_those_of_generated_code() {
    type Written = fn(f64) -> f64;
    let laws: [(&str, Written); 7] = [
        ("(1 + t^2)^(1/3)", |t| {
            Real::powf(1.0 + t * t, 0.3333333333333333)
        }),
        ("(1 + t^2)^(-1/3)", |t| {
            1.0 / Real::powf(1.0 + t * t, 0.3333333333333333)
        }),
        ("(1 + t^2)^(5/2)", |t| {
            (1.0 + t * t) * (1.0 + t * t) * Real::sqrt(1.0 + t * t)
        }),
        ("2*t/(1 + t^2)^(5/2)", |t| {
            2.0 * t / ((1.0 + t * t) * (1.0 + t * t) * Real::sqrt(1.0 + t * t))
        }),
        ("ln(2 + t)", |t| Real::ln(2.0 + t)),
        ("exp(t)", Real::exp),
        ("-0.3*t^3", |t| -0.3 * t * t * t),
    ];
    for (law, written) in laws {
        let derived = description::written(&format!(
            "mechanism lone {{ point A = (0, 0); body crank at A {{ A, B: (1, 0) }} revolute A(ground, crank); drive phi(crank) = {law}; }}"
        ));
        let view = Interpreted::new(&derived).expect("a plan");
        let mut shell = assembled_from(view, &[], 0.1, Settings::default()).expect("as drawn");
        for step in 1..=200 {
            let t = 0.1 + 0.013 * f64::from(step);
            let frame = shell
                .advance(t, &InputSignals::default())
                .expect("explicit");
            let (found, expected) = (frame.q()[2], written(t));
            assert_eq!(
                found.to_bits(),
                expected.to_bits(),
                "{law} at {t}: {found} {expected}"
            );
        }
    }
}

include!(concat!(env!("OUT_DIR"), "/comparing.rs"));
