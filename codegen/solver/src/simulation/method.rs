//! The method of the next step: explicit, or implicit while a motion is stiff.
//!
//! A motion is stiff where explicit steps come near the limit of their stability: there the estimate of their error says little. Over several
//! steps [`dormand_prince::Step::stiffness`] says so (Hairer and Wanner 1996, section IV.2), and eigenvalues of the rates confirm it. It is no
//! longer where an explicit step twice as long as the implicit one would be stable.

use crate::dormand_prince::{self, STABLE};
use crate::radau::{self, Differences};
use crate::rates::Rates;
use crate::tolerances::Tolerances;

use super::right_side::RightSide;
use super::stop::Stop;

/// Number of stiff steps before an implicit one is taken.
const STIFF_STEPS: u32 = 5;

/// Number of steps that are not stiff which end the count.
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

/// A step of either method.
#[derive(Clone, Debug)]
pub(super) enum Step {
    Explicit(dormand_prince::Step),
    Implicit(radau::Step),
}

/// The method of the next step, and what speaks for the other one.
#[derive(Clone, Debug)]
pub(super) struct Chosen {
    wanted: Method,
    is_implicit: bool,
    /// Steps for the other method, and those against it since the last of them.
    for_other: u32,
    against: u32,
}

impl Chosen {
    /// Before the first step.
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

    /// Tries a step from a state and its rates; derivatives there are found once for all lengths.
    ///
    /// # Errors
    /// There are no rates somewhere on the way.
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

    /// Sees a step that was taken and chooses the method of the next one.
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
            Step::Explicit(step) => (step.stiffness(judged) > NEEDLESS * STABLE, STIFF_STEPS),
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
            // Where stages differ by rounding, their rates say nothing.
            Step::Explicit(step) => {
                let length = step.to - step.from;
                let (state, slope) = (step.end(), step.end_rates());
                let found = Differences::of(right_side, step.to, state, slope, length);
                found.is_ok_and(|it| is_stiff(&it, length, judged))
            }
        };
    }
}

/// True if a step of this length is long beside an explicit one that is stable, or that is accurate along decays.
fn is_stiff(differences: &Differences, length: f64, judged: usize) -> bool {
    let [fastest, decay] = differences.fastest(judged);
    length * fastest > STABLE || length * decay > NEEDLESS * STABLE
}

impl Step {
    /// Its error in tolerances.
    pub fn error(&self) -> f64 {
        match self {
            Step::Explicit(step) => step.error,
            Step::Implicit(step) => step.error,
        }
    }

    /// Length of the next step.
    pub fn next_length(&self, held: bool) -> f64 {
        match self {
            Step::Explicit(step) => step.next_length(held),
            Step::Implicit(step) => step.next_length(held),
        }
    }

    /// The state at its end.
    pub fn end(&self) -> &[f64] {
        match self {
            Step::Explicit(step) => step.end(),
            Step::Implicit(step) => step.end(),
        }
    }

    /// Finds the rates at its end.
    ///
    /// # Errors
    /// There are none.
    pub fn finish<R: Rates>(&mut self, rates: &mut R) -> Result<(), R::Failure> {
        match self {
            Step::Explicit(step) => step.finish(rates),
            Step::Implicit(step) => step.finish(rates),
        }
    }

    /// The rates at the end of a finished step.
    pub fn end_rates(&self) -> &[f64] {
        match self {
            Step::Explicit(step) => step.end_rates(),
            Step::Implicit(step) => step.end_rates(),
        }
    }

    /// The state at a time on a finished step.
    ///
    /// # Errors
    /// There are no rates at one of the places that the dense output needs.
    pub fn at<R: Rates>(&mut self, rates: &mut R, t: f64) -> Result<Vec<f64>, R::Failure> {
        match self {
            Step::Explicit(step) => step.at(rates, t),
            Step::Implicit(step) => Ok(step.at(t)),
        }
    }
}
