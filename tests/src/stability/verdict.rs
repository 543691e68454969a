//! *A sample and a way to solve it* → *a verdict*: within the bound, a typed failure, or wrong.

use super::precise::Precise;
use super::sample::{Runner, Sample};
use super::truth::{Exact, Given, Truth};

/// A scalar.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scalar {
    /// Double precision.
    F64,
    /// Single precision.
    F32,
}

impl Scalar {
    fn round(self, value: f64) -> f64 {
        match self {
            Scalar::F64 => value,
            Scalar::F32 => f64::from(value as f32),
        }
    }

    /// The distance from 1 to the next number.
    pub fn epsilon(self) -> f64 {
        match self {
            Scalar::F64 => f64::EPSILON,
            Scalar::F32 => f64::from(f32::EPSILON),
        }
    }

    /// The name of the type.
    pub fn name(self) -> &'static str {
        match self {
            Scalar::F64 => "f64",
            Scalar::F32 => "f32",
        }
    }
}

/// What 384 bits leave of a quantity that is zero, relative to the others, and more.
const NOISE: f64 = 1e-60;

/// What became of a sample.
#[derive(Clone, Debug)]
pub enum Verdict {
    /// All instants were solved. Errors and bounds of q are those of the worst coordinate, in its scale; the ratio is the largest
    /// of error to bound over q, q̇, q̈ and all instants.
    Solved {
        /// The largest error of q.
        error: f64,
        /// The largest bound of q.
        bound: f64,
        /// The largest ratio.
        ratio: f64,
    },
    /// A typed failure, and how many instants had been solved within their bounds before.
    Failed {
        /// Its kind.
        kind: String,
        /// Instants before.
        solved: usize,
        /// Whether there is a pose.
        exists: bool,
    },
    /// An `Ok` that is off by more than its bound, or where there is no pose.
    Wrong {
        /// What is wrong.
        why: String,
    },
}

impl Verdict {
    /// Whether this is an answer that is wrong.
    pub fn is_wrong(&self) -> bool {
        matches!(self, Verdict::Wrong { .. })
    }
}

/// The exact motion at each time of a sample, as a scalar is given it; `None` from where there is none.
pub fn exact(truth: &Truth, sample: &Sample, scalar: Scalar) -> Vec<(Given, Option<Exact>)> {
    let round =
        |values: &[f64]| -> Vec<f64> { values.iter().map(|it| scalar.round(*it)).collect() };
    let parameters = round(&sample.parameters);
    let given = |t: f64| Given {
        parameters: parameters.clone(),
        signals: (sample.signals)(t)
            .into_iter()
            .map(|signal| signal.map(|value| scalar.round(value)))
            .collect(),
        t,
    };
    let mut found: Vec<(Given, Option<Exact>)> = Vec::new();
    let mut start: Option<Vec<Precise>> = Some(
        sample
            .start
            .iter()
            .map(|it| Precise::from_f64(*it))
            .collect(),
    );
    let mut before = None;
    for t in sample.times.iter().map(|t| scalar.round(*t)) {
        let from: f64 = before.replace(t).unwrap_or(t);
        let steps = if from == t { 1 } else { sample.fine };
        for step in 1..steps {
            let at = from + (t - from) * f64::from(step) / f64::from(steps);
            start = start.and_then(|start| truth.approach(&given(at), &start));
        }
        let reached = start
            .as_ref()
            .and_then(|start| truth.solve(&given(t), start));
        start = reached.as_ref().map(|it| it.levels[0].clone());
        found.push((given(t), reached));
    }
    found
}

/// Solves a sample and compares. `length` is what residuals in m are judged against.
pub fn judge(
    truth: &Truth,
    sample: &Sample,
    exact: &[(Given, Option<Exact>)],
    scalar: Scalar,
    runner: Runner,
    length: f64,
) -> Verdict {
    let negative = exact
        .iter()
        .find_map(|(_, exact)| exact.as_ref())
        .is_some_and(|exact| exact.is_negative);
    let outcomes = runner(sample, negative);
    let scales = truth.scales(sample.length);
    let (mut error, mut bound, mut ratio) = (0.0_f64, 0.0_f64, 0.0_f64);
    for (index, (outcome, (given, exact))) in outcomes.into_iter().zip(exact).enumerate() {
        let levels = match outcome {
            Ok(levels) => levels,
            Err(kind) => {
                return Verdict::Failed {
                    kind,
                    solved: index,
                    exists: exact.is_some(),
                };
            }
        };
        let wrong = |why: String| Verdict::Wrong { why };
        let Some(exact) = exact else {
            return wrong(format!("a pose where there is none, instant {index}"));
        };
        let bounds = truth.bounds(given, exact, length, scalar.epsilon());
        for level in 0..3 {
            let floor = NOISE
                * exact.levels[level]
                    .iter()
                    .map(|value| value.to_f64().abs())
                    .fold(0.0, f64::max);
            for (place, found) in levels[level].iter().enumerate() {
                let off = Precise::from_f64(*found).minus(&exact.levels[level][place]);
                let off = off.to_f64().abs();
                let limit = bounds[level][place].max(floor);
                // No comparison with NaN holds, so that is wrong too.
                let within = off <= limit;
                if !within {
                    let name = ["q", "q̇", "q̈"][level];
                    let value = exact.levels[level][place].to_f64();
                    return wrong(format!(
                        "{name}[{place}] = {found:e} instead of {value:e}, off by {off:.1e} where {limit:.1e} is allowed, instant {index}"
                    ));
                }
                if limit > 0.0 {
                    ratio = ratio.max(off / limit);
                }
                if level == 0 {
                    error = error.max(off / scales[place]);
                    bound = bound.max(limit / scales[place]);
                }
            }
        }
    }
    Verdict::Solved {
        error,
        bound,
        ratio,
    }
}
