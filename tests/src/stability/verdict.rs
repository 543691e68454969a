//! *A sample and a way to solve it* → *a verdict*: within the bound, a typed failure, or wrong.

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
    /// The number of the type that is nearest.
    pub fn round(self, value: f64) -> f64 {
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

    /// The smallest and the largest normal number.
    pub fn range(self) -> (f64, f64) {
        match self {
            Scalar::F64 => (f64::MIN_POSITIVE, f64::MAX),
            Scalar::F32 => (f64::from(f32::MIN_POSITIVE), f64::from(f32::MAX)),
        }
    }

    /// The error of rounding a number of this size: half an ε of it, and one distance between numbers where it is not normal.
    pub fn rounding(self, size: f64) -> Margin {
        let (smallest, _) = self.range();
        match size.abs() {
            0.0 => Margin::NONE,
            size if size < smallest => Margin::even(self.epsilon() * smallest),
            size => Margin::even(0.5 * self.epsilon() * size),
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

/// A way to solve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// The textbook view on a path and a branch: `assemble_from_rough_estimate` and `follow`.
    Followed,
    /// The textbook view as it is taught: `assemble` and `advance`, which promise a pose, but not which one.
    Plain,
    /// The generated mechanism.
    Solved,
}

impl Way {
    /// All of them, in the order of a report.
    pub const ALL: [Way; 3] = [Way::Followed, Way::Plain, Way::Solved];
}

/// Numbers of an answer. Errors and bounds are those of the worst coordinate of q, in its scale.
#[derive(Clone, Copy, Debug, Default)]
pub struct Answer {
    /// The largest error of q.
    pub error: f64,
    /// The largest standard deviation of q.
    pub expected: f64,
    /// The largest bound of q.
    pub bound: f64,
    /// The largest ratio of an error to its bound, over q, q̇, q̈ and all instants.
    pub ratio: f64,
    /// The largest ratio of an error to its standard deviation, over the same.
    pub deviations: f64,
    /// Whether some instant is another pose than the one on the path, where the way does not promise the path.
    pub elsewhere: bool,
}

/// What became of a sample.
#[derive(Clone, Debug)]
pub enum Verdict {
    /// All instants were solved.
    Solved(Answer),
    /// A typed failure, and how many instants had been solved within their bounds before.
    Failed {
        /// Its kind.
        kind: String,
        /// Instants before.
        solved: usize,
        /// Why there is no answer; `None` where there is no pose.
        cause: Option<Cause>,
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

/// What a mechanism's answers are compared with.
pub struct Judge<'a> {
    /// The textbook view.
    pub truth: &'a Truth,
    /// The solved view.
    pub blocks: &'a Blocks,
    /// The scalar.
    pub scalar: Scalar,
}

impl Judge<'_> {
    /// Solves a sample in a way and compares with the exact motion. Whoever solves is told whether the determinant of the pose that
    /// is meant is negative.
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

    /// Compares what has been made of a sample with the exact motion.
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
                    // A pose it must be, if not this one.
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

    /// Why there is no answer although there is a pose.
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
        let mut found = *answer;
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
                // What is infinite times nothing is no bound.
                let limit = if margin.worst.is_nan() {
                    f64::INFINITY
                } else {
                    margin.worst.max(floor)
                };
                // No comparison with NaN holds, so that is wrong too.
                let within = off <= limit;
                if !within {
                    let name = ["q", "q̇", "q̈"][level];
                    let exact = exact.levels[level][place].to_f64();
                    return Err(format!(
                        "{name}[{place}] = {value:e} instead of {exact:e}, off by {off:.1e} where {limit:.1e} is allowed"
                    ));
                }
                if off > floor {
                    found.ratio = found.ratio.max(off / limit);
                    found.deviations = found.deviations.max(off / margin.expected);
                }
                if level == 0 {
                    found.error = found.error.max(off / scales[place]);
                    found.expected = found.expected.max(margin.expected / scales[place]);
                    found.bound = found.bound.max(limit / scales[place]);
                }
            }
        }
        *answer = found;
        Ok(())
    }
}
