//! Verdict on a solved sample: within the bound, a typed failure, or wrong.

use super::blocks::Blocks;
use super::bounded::Margin;
use super::cause::{Cause, cause};
use super::precise::Precise;
use super::sample::{Outcomes, Sample};
use super::truth::{Exact, Given, Levels, Truth};

/// A scalar.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scalar {
    /// Double precision.
    F64,
    /// Single precision.
    F32,
}

impl Scalar {
    /// Nearest number of the type.
    pub fn round(self, value: f64) -> f64 {
        match self {
            Scalar::F64 => value,
            Scalar::F32 => f64::from(value as f32),
        }
    }

    /// Distance from 1 to the next number.
    pub fn epsilon(self) -> f64 {
        match self {
            Scalar::F64 => f64::EPSILON,
            Scalar::F32 => f64::from(f32::EPSILON),
        }
    }

    /// Smallest and largest normal number.
    pub fn range(self) -> (f64, f64) {
        match self {
            Scalar::F64 => (f64::MIN_POSITIVE, f64::MAX),
            Scalar::F32 => (f64::from(f32::MIN_POSITIVE), f64::from(f32::MAX)),
        }
    }

    /// Rounding error of a number of this magnitude: half an ε of it, and one spacing of numbers where it is
    /// subnormal.
    pub fn rounding(self, size: f64) -> Margin {
        let (smallest, _) = self.range();
        match size.abs() {
            0.0 => Margin::NONE,
            size if size < smallest => Margin::even(self.epsilon() * smallest),
            size => Margin::even(0.5 * self.epsilon() * size),
        }
    }

    /// Name of the type.
    pub fn name(self) -> &'static str {
        match self {
            Scalar::F64 => "f64",
            Scalar::F32 => "f32",
        }
    }
}

/// Bound on a zero quantity in 384 bits, relative to the other quantities.
const NOISE: f64 = 1e-60;

/// Solution procedure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Textbook formulation on a path and a branch: `assemble_from_rough_estimate` and `follow`.
    Followed,
    /// Textbook formulation with `assemble` and `advance`, which promise a pose but not which one.
    Plain,
    /// The generated mechanism.
    Solved,
}

impl Way {
    /// All procedures, in the order of a report.
    pub const ALL: [Way; 3] = [Way::Followed, Way::Plain, Way::Solved];
}

/// Numbers of an answer. Errors and bounds are those of the worst coordinate of q, in its scale.
#[derive(Clone, Copy, Debug, Default)]
pub struct Answer {
    /// Largest error of q.
    pub error: f64,
    /// Largest standard deviation of q.
    pub expected: f64,
    /// Largest bound of q.
    pub bound: f64,
    /// Largest ratio of an error to its bound, over q, q̇, q̈ and all instants.
    pub ratio: f64,
    /// Largest ratio of an error to its standard deviation, over q, q̇, q̈ and all instants.
    pub deviations: f64,
    /// True if an instant has another pose than that on the path and the procedure does not promise the path.
    pub elsewhere: bool,
}

/// Outcome of a sample.
#[derive(Clone, Debug)]
pub enum Verdict {
    /// All instants were solved.
    Solved(Answer),
    /// A typed failure.
    Failed {
        /// Kind of the failure.
        kind: String,
        /// Number of instants solved within their bounds before.
        solved: usize,
        /// Cause of the failure; `None` if the instant has no pose.
        cause: Option<Cause>,
    },
    /// An `Ok` that is off by more than its bound, or although no pose exists.
    Wrong {
        /// Description of the error.
        why: String,
    },
}

impl Verdict {
    /// True if the answer is wrong.
    pub fn is_wrong(&self) -> bool {
        matches!(self, Verdict::Wrong { .. })
    }
}

/// Exact motion at each time of a sample, with the inputs rounded to a scalar; `None` from the first time without a
/// pose.
pub fn exact(truth: &Truth, sample: &Sample, scalar: Scalar) -> Vec<(Given, Option<Exact>)> {
    let round =
        |values: &[f64]| -> Vec<f64> { values.iter().map(|it| scalar.round(*it)).collect() };
    let parameters = round(&sample.parameters);
    let inputs_at = |t: f64| Given {
        parameters: parameters.clone(),
        signals: (sample.signals)(t)
            .into_iter()
            .map(|signal| signal.map(|value| scalar.round(value)))
            .collect(),
        t,
    };
    let mut motion: Vec<(Given, Option<Exact>)> = Vec::new();
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
            start = start.and_then(|start| truth.approach(&inputs_at(at), &start));
        }
        let reached = start
            .as_ref()
            .and_then(|start| truth.solve(&inputs_at(t), start));
        start = reached.as_ref().map(|it| it.levels[0].clone());
        motion.push((inputs_at(t), reached));
    }
    motion
}

/// References for the answers of a mechanism.
pub struct Judge<'a> {
    /// Textbook formulation.
    pub truth: &'a Truth,
    /// Solved formulation.
    pub blocks: &'a Blocks,
    /// The scalar.
    pub scalar: Scalar,
}

impl Judge<'_> {
    /// Solves a sample by a procedure and compares it with the exact motion. The solver gets the sign of the
    /// determinant at the start.
    pub fn judge(
        &self,
        sample: &Sample,
        exact: &[(Given, Option<Exact>)],
        way: Way,
        solve: impl FnOnce(bool) -> Outcomes,
    ) -> Verdict {
        let negative = exact
            .iter()
            .find_map(|(_, exact)| exact.as_ref())
            .is_some_and(|exact| exact.is_negative);
        self.judge_outcomes(sample, exact, way, solve(negative))
    }

    /// Compares the outcomes of a sample with the exact motion.
    pub fn judge_outcomes(
        &self,
        sample: &Sample,
        exact: &[(Given, Option<Exact>)],
        way: Way,
        outcomes: Outcomes,
    ) -> Verdict {
        let mut answer = Answer::default();
        for (index, (outcome, (given, exact))) in outcomes.into_iter().zip(exact).enumerate() {
            let levels = match outcome {
                Ok(levels) => levels,
                Err(kind) => {
                    let cause = exact.as_ref();
                    let cause =
                        cause.map(|exact| self.cause(sample, given, exact, &kind, way, index));
                    return Verdict::Failed {
                        kind,
                        solved: index,
                        cause,
                    };
                }
            };
            let compared = match exact {
                Some(exact) => self.compare(&mut answer, sample, given, exact, way, &levels),
                None => Err("a pose where there is none".to_string()),
            };
            let compared = match (compared, way) {
                (Err(why), Way::Plain) => {
                    // Another pose than this one must still satisfy the equations.
                    let start: Vec<Precise> =
                        levels[0].iter().map(|it| Precise::from_f64(*it)).collect();
                    answer.elsewhere = true;
                    match self.truth.solve(given, &start) {
                        Some(other) => {
                            self.compare(&mut answer, sample, given, &other, way, &levels)
                        }
                        None => Err(why),
                    }
                }
                (compared, _) => compared,
            };
            if let Err(why) = compared {
                return Verdict::Wrong {
                    why: format!("{why}, instant {index}"),
                };
            }
        }
        Verdict::Solved(answer)
    }

    /// Cause of a failure at an instant that has a pose.
    fn cause(
        &self,
        sample: &Sample,
        given: &Given,
        exact: &Exact,
        kind: &str,
        way: Way,
        index: usize,
    ) -> Cause {
        let length = self.truth.length(given);
        let bounds = self.truth.bounds(given, exact, length, self.scalar);
        let scales = self.truth.scales(sample.length);
        let pose: Vec<Margin> = bounds.levels[0]
            .iter()
            .zip(&scales)
            .map(|(margin, scale)| margin.times(1.0 / scale))
            .collect();
        cause(
            kind,
            way,
            index == 0,
            self.scalar,
            sample.length,
            &pose,
            bounds.change,
        )
    }

    fn compare(
        &self,
        answer: &mut Answer,
        sample: &Sample,
        given: &Given,
        exact: &Exact,
        way: Way,
        levels: &Levels<f64>,
    ) -> Result<(), String> {
        let length = self.truth.length(given);
        let bounds = if way == Way::Solved {
            self.blocks.bounds(given, exact, length, self.scalar)?
        } else {
            self.truth.bounds(given, exact, length, self.scalar).levels
        };
        let scales = self.truth.scales(sample.length);
        let mut extremes = *answer;
        for level in 0..3 {
            let scaled = exact.levels[level].iter().zip(&scales);
            let largest = scaled
                .map(|(value, scale)| value.to_f64().abs() / scale)
                .fold(0.0, f64::max);
            for (place, value) in levels[level].iter().enumerate() {
                let off = Precise::from_f64(*value).minus(&exact.levels[level][place]);
                let off = off.to_f64().abs();
                let margin = bounds[level][place];
                let floor = NOISE * largest * scales[place];
                // Infinity times zero is not a bound.
                let limit = if margin.worst.is_nan() {
                    f64::INFINITY
                } else {
                    margin.worst.max(floor)
                };
                // A comparison with NaN is false, so that NaN is wrong too.
                let within = off <= limit;
                if !within {
                    let name = ["q", "q̇", "q̈"][level];
                    let exact = exact.levels[level][place].to_f64();
                    return Err(format!(
                        "{name}[{place}] = {value:e} instead of {exact:e}, off by {off:.1e} where {limit:.1e} is allowed"
                    ));
                }
                if off > floor {
                    extremes.ratio = extremes.ratio.max(off / limit);
                    extremes.deviations = extremes.deviations.max(off / margin.expected);
                }
                if level == 0 {
                    extremes.error = extremes.error.max(off / scales[place]);
                    extremes.expected = extremes.expected.max(margin.expected / scales[place]);
                    extremes.bound = extremes.bound.max(limit / scales[place]);
                }
            }
        }
        *answer = extremes;
        Ok(())
    }
}
