use super::coefficients::{ESTIMATE, GAMMA, INVERSE, NODES, STAGES};
use super::{Differences, Step};
use crate::rates::Rates;
use crate::tolerances::Tolerances;

const TOLERANCES: Tolerances = Tolerances {
    relative: 1e-8,
    absolute: 1e-8,
};

/// Equations y' = −λ (y − cos t) − sin t and z' = z² cos t, with y = cos t and z = 1/(2 − sin t); a third component integrates y.
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

fn step(decay: f64, from: f64, length: f64, tolerances: &Tolerances) -> Step {
    let mut curves = Curves { decay };
    let state = solution(from);
    let mut slope = [0.0; 3];
    curves.rates(from, &state, &mut slope).expect("everywhere");
    let range = [from, from + length];
    let differences = Differences::of(&mut curves, from, &state, &slope, length);
    let differences = differences.expect("everywhere");
    let step = Step::attempt(&mut curves, range, &state, &slope, &differences, tolerances);
    step.expect("everywhere")
}

fn error(step: &Step, t: f64) -> f64 {
    let state = step.at(t);
    let pairs = state.iter().zip(solution(t));
    pairs
        .map(|(one, other)| (one - other).abs())
        .fold(0.0, f64::max)
}

/// The error of a step is of order 10 in its length at least, that between its ends of order 6.
#[test]
fn the_orders_are_nine_and_five() {
    let exact = Tolerances {
        relative: 1e-12,
        absolute: 1e-12,
    };
    for (part, order) in [(1.0, 10.0), (0.37, 6.0)] {
        let [long, short] = [0.6, 0.3]
            .map(|length: f64| error(&step(2.0, 0.3, length, &exact), 0.3 + part * length));
        let falls = (long / short).log2();
        assert!(falls > order - 0.7, "{part}: {falls}");
    }
}

/// Errors stay small for any decay rate, and a state off the solution is on it after one step.
#[test]
fn fast_decays_are_gone_after_a_step() {
    for decay in [1e3, 1e6, 1e9] {
        let taken = step(decay, 0.3, 0.1, &TOLERANCES);
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
        for found in differences.fastest(2) {
            assert!((found / decay - 1.0).abs() <= 1e-8, "{found}");
        }
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

/// Rates at the stages are those of the polynomial through the start and the stages. For rates up to t⁸ the end is exact, for rates up
/// to t⁴ the error estimate is zero.
#[test]
fn conditions_of_the_order_hold() {
    for stage in 0..STAGES {
        for power in 1..=STAGES as i32 {
            let terms = INVERSE[stage].iter().zip(NODES);
            let slope: f64 = terms.map(|(factor, node)| factor * node.powi(power)).sum();
            let exact = f64::from(power) * NODES[stage].powi(power - 1);
            assert!((slope - exact).abs() <= 1e-13, "{stage} {power}: {slope}");
        }
    }
    // The weights of the rates are the last row of A, found from its product with A⁻¹.
    let inverse =
        nalgebra::SMatrix::<f64, STAGES, STAGES>::from_fn(|row, column| INVERSE[row][column]);
    let matrix = inverse.try_inverse().expect("regular");
    for power in 0..9 {
        let terms = (0..STAGES).map(|stage| matrix[(STAGES - 1, stage)] * NODES[stage].powi(power));
        let missed = terms.sum::<f64>() - 1.0 / f64::from(power + 1);
        assert!(missed.abs() <= 1e-14, "{power}: {missed}");
    }
    for power in 1..=STAGES as i32 {
        let terms = ESTIMATE.iter().zip(NODES);
        let sum: f64 = terms.map(|(factor, node)| factor * node.powi(power)).sum();
        let start = if power == 1 { 1.0 } else { 0.0 };
        assert!((sum + start).abs() <= 1e-13, "{power}: {sum}");
    }
    let shifted = inverse - nalgebra::SMatrix::identity() / GAMMA;
    assert!(shifted.determinant().abs() <= 1e-9 * inverse.determinant());
}
