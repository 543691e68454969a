//! Selects the method of the next step: explicit, or implicit while a motion is stiff.
//!
//! A motion is stiff if explicit steps come near the limit of their stability, where the estimate of their error is unreliable. Over
//! several steps [`dormand_prince::Step::stiffness`] detects that (Hairer and Wanner 1996, section IV.2), and eigenvalues of the rates
//! confirm it. The motion stops being stiff when an explicit step of twice the implicit length would be stable.

use crate::dormand_prince::{self, STABILITY_LIMIT};
use crate::radau::{self, Differences};
use crate::rates::Rates;
use crate::tolerances::Tolerances;

use super::right_side::RightSide;
use super::stop::Stop;

/// Number of stiff steps before an implicit one is taken.
const STIFF_STEPS: u32 = 5;

/// Number of steps that are not stiff which reset the count.
const EASY_STEPS: u32 = 6;

/// Part of the length of a stable explicit step up to which decays need no implicit step.
const NEEDLESS: f64 = 0.5;

/// Method of all steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// The explicit method, and the implicit one while a motion is stiff.
    #[default]
    Automatic,
    /// DOP853, explicit, of order 8.
    Explicit,
    /// Radau IIA, implicit, of order 9.
    Implicit,
}

/// Step of either method.
#[derive(Clone, Debug)]
pub(super) enum Step {
    Explicit(dormand_prince::Step),
    Implicit(radau::Step),
}

/// Method of the next step, and the evidence for the other one.
#[derive(Clone, Debug)]
pub(super) struct Chosen {
    wanted: Method,
    is_implicit: bool,
    /// Number of steps that favor the other method, and of those since the last of them that do not.
    for_other: u32,
    against: u32,
}

impl Chosen {
    /// Creates the selection before the first step.
    pub fn new(wanted: Method) -> Chosen {
        Chosen {
            wanted,
            is_implicit: wanted == Method::Implicit,
            for_other: 0,
            against: 0,
        }
    }

    /// True if the next step is implicit.
    pub fn is_implicit(&self) -> bool {
        self.is_implicit
    }

    /// Tries a step from a state and its rates; derivatives are computed once for all lengths.
    ///
    /// # Errors
    /// Rates do not exist at one of the stages.
    pub fn attempt(
        &self,
        right_side: &mut RightSide,
        [from, to]: [f64; 2],
        [state, slope]: [&[f64]; 2],
        differences: &mut Option<Differences>,
        tolerances: &Tolerances,
    ) -> Result<Step, Stop> {
        let range = [from, to];
        if !self.is_implicit {
            let step = dormand_prince::Step::attempt(right_side, range, state, slope, tolerances)?;
            return Ok(Step::Explicit(step));
        }
        let differences = match differences {
            Some(differences) => differences,
            none @ None => none.insert(Differences::of(right_side, from, state, slope, to - from)?),
        };
        let step = radau::Step::attempt(right_side, range, state, slope, differences, tolerances)?;
        Ok(Step::Implicit(step))
    }

    /// Records an accepted step and selects the method of the next one.
    pub fn see(
        &mut self,
        step: &Step,
        right_side: &mut RightSide,
        differences: Option<&Differences>,
    ) {
        if self.wanted != Method::Automatic {
            return;
        }
        let judged = right_side.judged();
        let (speaks_for_other, enough) = match step {
            Step::Explicit(step) => (
                step.stiffness(judged) > NEEDLESS * STABILITY_LIMIT,
                STIFF_STEPS,
            ),
            Step::Implicit(step) => {
                let is_stiff =
                    differences.is_none_or(|it| is_stiff(it, step.to - step.from, judged));
                (!is_stiff, EASY_STEPS)
            }
        };
        match speaks_for_other {
            true => (self.for_other, self.against) = (self.for_other + 1, 0),
            false => self.against += 1,
        }
        if self.against >= EASY_STEPS {
            self.for_other = 0;
        }
        if self.for_other < enough {
            return;
        }
        (self.for_other, self.against) = (0, 0);
        self.is_implicit = match step {
            Step::Implicit(_) => false,
            // If stages differ by rounding only, their rates are meaningless.
            Step::Explicit(step) => {
                let length = step.to - step.from;
                let (state, slope) = (step.end(), step.end_rates());
                let differences = Differences::of(right_side, step.to, state, slope, length);
                differences.is_ok_and(|it| is_stiff(&it, length, judged))
            }
        };
    }
}

/// True if a step of this length is long relative to a stable explicit one, or to one that is accurate along decays.
fn is_stiff(differences: &Differences, length: f64, judged: usize) -> bool {
    let [fastest, decay] = differences.fastest(judged);
    length * fastest > STABILITY_LIMIT || length * decay > NEEDLESS * STABILITY_LIMIT
}

impl Step {
    /// Error in tolerances.
    pub fn error(&self) -> f64 {
        match self {
            Step::Explicit(step) => step.error,
            Step::Implicit(step) => step.error,
        }
    }

    /// Returns the length of the next step. A `held` step may not be longer.
    pub fn next_length(&self, held: bool) -> f64 {
        match self {
            Step::Explicit(step) => step.next_length(held),
            Step::Implicit(step) => step.next_length(held),
        }
    }

    /// State at the end.
    pub fn end(&self) -> &[f64] {
        match self {
            Step::Explicit(step) => step.end(),
            Step::Implicit(step) => step.end(),
        }
    }

    /// Evaluates the rates at the end.
    ///
    /// # Errors
    /// The rates do not exist.
    pub fn finish<R: Rates>(&mut self, rates: &mut R) -> Result<(), R::Failure> {
        match self {
            Step::Explicit(step) => step.finish(rates),
            Step::Implicit(step) => step.finish(rates),
        }
    }

    /// Rates at the end of a finished step.
    pub fn end_rates(&self) -> &[f64] {
        match self {
            Step::Explicit(step) => step.end_rates(),
            Step::Implicit(step) => step.end_rates(),
        }
    }

    /// Returns the state at a time within a finished step.
    ///
    /// # Errors
    /// Rates do not exist at one of the stages of the dense output.
    pub fn at<R: Rates>(&mut self, rates: &mut R, t: f64) -> Result<Vec<f64>, R::Failure> {
        match self {
            Step::Explicit(step) => step.at(rates, t),
            Step::Implicit(step) => Ok(step.at(t)),
        }
    }
}
