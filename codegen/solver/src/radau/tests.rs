use nalgebra::{DMatrix, DVector};

use super::coefficients::{CORRECTIONS, DENSE, GAMMA, NODES, PLACES, SLOPES, STAGES};
use super::{Differences, Step};
use crate::rates::Rates;
use crate::tolerances::Tolerances;

const TOLERANCES: Tolerances = Tolerances {
    relative: 1e-8,
    absolute: 1e-8,
};

/// y' = −λ (y − cos t) − sin t and z' = z² cos t, with y = cos t and z = 1/(2 − sin t); a third component integrates y.
struct Curves {
    decay: f64,
}

impl Rates for Curves {
    type Failure = ();

    fn rates(&mut self, t: f64, state: &[f64], rates: &mut [f64]) -> Result<(), ()> {
        let (sine, cosine) = t.sin_cos();
        rates[0] = -self.decay * (state[0] - cosine) - sine;
        rates[1] = state[1] * state[1] * cosine;
        rates[2] = state[0];
        Ok(())
    }

    fn judged(&self) -> usize {
        2
    }
}

fn solution(t: f64) -> [f64; 3] {
    [t.cos(), 1.0 / (2.0 - t.sin()), t.sin()]
}

fn step(decay: f64, from: f64, length: f64) -> Step {
    let mut curves = Curves { decay };
    let state = solution(from);
    let mut slope = [0.0; 3];
    curves.rates(from, &state, &mut slope).expect("everywhere");
    let range = [from, from + length];
    let differences = Differences::of(&mut curves, from, &state, &slope, length);
    let differences = differences.expect("everywhere");
    let step = Step::attempt(
        &mut curves,
        range,
        &state,
        &slope,
        &differences,
        &TOLERANCES,
    );
    step.expect("everywhere")
}

fn error(step: &Step, t: f64) -> f64 {
    let found = step.at(t);
    let pairs = found.iter().zip(solution(t));
    pairs
        .map(|(one, other)| (one - other).abs())
        .fold(0.0, f64::max)
}

/// The error of a step falls with the sixth power of its length, that between its ends with the fifth.
#[test]
fn the_orders_are_five_and_four() {
    for (part, order) in [(1.0, 6.0), (0.37, 5.0)] {
        let [long, short] =
            [0.4, 0.2].map(|length: f64| error(&step(2.0, 0.3, length), 0.3 + part * length));
        let falls = (long / short).log2();
        assert!((falls - order).abs() < 0.7, "{part}: {falls}");
    }
}

/// However fast the decay, errors stay small, and what is off the solution is on it after one step.
#[test]
fn fast_decays_are_gone_after_a_step() {
    for decay in [1e3, 1e6, 1e9] {
        let taken = step(decay, 0.3, 0.1);
        for part in [0.25, 0.5, 1.0] {
            let missed = error(&taken, 0.3 + 0.1 * part);
            assert!(missed <= 1e-6, "{decay} {part}: {missed}");
        }
        let mut curves = Curves { decay };
        let mut state = solution(0.3);
        state[0] += 1.0;
        let mut slope = [0.0; 3];
        curves.rates(0.3, &state, &mut slope).expect("everywhere");
        let differences = Differences::of(&mut curves, 0.3, &state, &slope, 0.1);
        let differences = differences.expect("everywhere");
        let radius = differences.spectral_radius(2);
        assert!((radius / decay - 1.0).abs() <= 1e-8, "{radius}");
        let taken = Step::attempt(
            &mut curves,
            [0.3, 0.4],
            &state,
            &slope,
            &differences,
            &TOLERANCES,
        );
        let end = taken.expect("everywhere").end()[0];
        assert!(
            (end - 0.4_f64.cos()).abs() <= (200.0 / decay).max(1e-6),
            "{decay}: {end}"
        );
    }
}

/// The matrices of a Rosenbrock method: α, Γ and its weights, also those of the dense output at a part of the step.
fn tableau() -> [DMatrix<f64>; 2] {
    let lower = |rows: &[&[f64]]| {
        DMatrix::from_fn(STAGES, STAGES, |row, column| {
            rows[row].get(column).copied().unwrap_or(0.0)
        })
    };
    let inverse = DMatrix::from_diagonal_element(STAGES, STAGES, 1.0 / GAMMA) - lower(&CORRECTIONS);
    let gamma = inverse.try_inverse().expect("triangular");
    [lower(&PLACES) * &gamma, gamma]
}

fn weights(part: f64, gamma: &DMatrix<f64>) -> DVector<f64> {
    let rest = 1.0 - part;
    let at = |stage: usize| {
        let end = PLACES[STAGES - 1].get(stage).copied().unwrap_or(1.0);
        let [first, second, third] = DENSE.map(|term| term[stage]);
        part * (end + rest * (first + part * (second + part * third)))
    };
    gamma.transpose() * DVector::from_fn(STAGES, |stage, _| at(stage))
}

/// The conditions of order 5 at the end, and of order 4 on the way (Hairer and Wanner 1996, section IV.7, table 7.1).
#[test]
fn conditions_of_the_order_hold() {
    let [alpha, gamma] = tableau();
    let beta = &alpha + &gamma;
    let one = DVector::repeat(STAGES, 1.0);
    let nodes = &alpha * &one;
    for stage in 0..STAGES {
        assert!((nodes[stage] - NODES[stage]).abs() <= 1e-13, "{stage}");
        let slope = (&gamma * &one)[stage];
        assert!((slope - SLOPES[stage]).abs() <= 1e-13, "{stage}");
    }
    let times = |left: &DVector<f64>, right: &DVector<f64>| left.component_mul(right);
    let power = |exponent: i32| nodes.map(|it| it.powi(exponent));
    let once = &beta * &one;
    let twice = &beta * &once;
    let bent = times(&nodes, &(&alpha * &once));
    let conditions = [
        (1, one.clone(), 1.0),
        (2, once.clone(), 2.0),
        (3, power(2), 3.0),
        (3, twice.clone(), 6.0),
        (4, power(3), 4.0),
        (4, bent.clone(), 8.0),
        (4, &beta * power(2), 12.0),
        (4, &beta * &twice, 24.0),
        (5, power(4), 5.0),
        (5, times(&power(2), &(&alpha * &once)), 10.0),
        (5, (&alpha * &once).map(|it| it * it), 20.0),
        (5, times(&nodes, &(&alpha * power(2))), 15.0),
        (5, times(&nodes, &(&alpha * &twice)), 30.0),
        (5, &beta * power(3), 20.0),
        (5, &beta * &bent, 40.0),
        (5, &beta * (&beta * power(2)), 60.0),
        (5, &beta * (&beta * &twice), 120.0),
    ];
    for (part, most) in [(1.0, 5), (0.2, 4), (0.5, 4), (0.9, 4)] {
        let weights = weights(part, &gamma);
        for (place, (order, sum, divisor)) in conditions.iter().enumerate() {
            if *order > most {
                continue;
            }
            let missed = weights.dot(sum) - f64::powi(part, *order) / divisor;
            assert!(missed.abs() <= 1e-13, "{part} {place}: {missed}");
        }
    }
    // L-stable: nothing is left of an infinitely fast decay.
    let left = 1.0 - weights(1.0, &gamma).dot(&beta.lu().solve(&one).expect("triangular"));
    assert!(left.abs() <= 1e-12, "{left}");
}
