//! Reports the reason that a simulated motion ends.

use linkwright::{Blocks, Failure};
use linkwright_codegen::stages::model::Mechanism;
use nalgebra::DVector;

use crate::condition::{Weakness, dimensionless, jacobian};
use crate::dense::Dense;
use crate::instant::Instant;
use crate::interpreted::Interpreted;
use crate::not_finite;
use crate::number::time;
use crate::ranges::outside;
use crate::singular_participants::SingularParticipants;
use crate::view::View;

/// Time (s) before the end of a motion at which loads are compared with those at its end.
const BEFORE: f64 = 1e-6;

/// Ratio of two loads beyond which the later one is called unbounded.
const GROWTH: f64 = 1e3;

/// Reason that a motion ends early, or does not begin.
#[derive(Clone, Debug, PartialEq)]
pub enum Stop {
    /// No coordinate is free.
    NothingFree,
    /// The mechanism cannot be assembled at the start.
    NotAssembled(Failure),
    /// The law of an input leaves its range.
    OutsideRange(Failure),
    /// The equations of joints and of drivers that are not free lose rank, and no continuation of the motion is verified as smooth.
    LosesRank {
        /// Time (s).
        t: f64,
    },
    /// No pose on the constraints is found: drivers or tables lead out of reach.
    Unsettled {
        /// Time (s).
        t: f64,
    },
    /// No mass resists a free coordinate, or a combination of several.
    Massless {
        /// Time (s).
        t: f64,
        /// Indices of these free coordinates, ascending.
        coordinates: Vec<usize>,
    },
    /// An acceleration or a power is infinite or NaN.
    NotFinite {
        /// Time (s).
        t: f64,
    },
    /// No step is short enough for the tolerances.
    TooShort {
        /// Time (s).
        t: f64,
    },
    /// The motion was so close to a loss of rank of joints and drivers that rounding changes it by more than the tolerances.
    Rounded {
        /// Time (s).
        t: f64,
    },
    /// The change of energy differs from the work: the motion is wrong from about this time on.
    Unbalanced {
        /// Time (s).
        t: f64,
        /// Change of energy that the work does not explain (J).
        drift: f64,
    },
}

impl Stop {
    /// Time (s).
    pub fn time(&self) -> f64 {
        match self {
            Stop::NothingFree => 0.0,
            Stop::NotAssembled(failure) | Stop::OutsideRange(failure) => failure.time,
            Stop::LosesRank { t }
            | Stop::Unsettled { t }
            | Stop::Massless { t, .. }
            | Stop::NotFinite { t }
            | Stop::TooShort { t }
            | Stop::Rounded { t }
            | Stop::Unbalanced { t, .. } => *t,
        }
    }

    /// Name of the reason in tables and JSON, in lower case with underscores: `loses_rank`; that of the failure if the mechanism cannot be
    /// assembled or an input leaves its range.
    pub fn name(&self) -> &'static str {
        match self {
            Stop::NothingFree => "nothing_free",
            Stop::NotAssembled(failure) | Stop::OutsideRange(failure) => failure.kind.name(),
            Stop::LosesRank { .. } => "loses_rank",
            Stop::Unsettled { .. } => "unsettled",
            Stop::Massless { .. } => "massless",
            Stop::NotFinite { .. } => "not_finite",
            Stop::TooShort { .. } => "too_short",
            Stop::Rounded { .. } => "rounded",
            Stop::Unbalanced { .. } => "unbalanced",
        }
    }

    /// Reports that the motion does not begin, with the reason.
    pub fn not_begun(&self, view: &Interpreted) -> String {
        match self {
            Stop::NotAssembled(failure) => view.not_assembled(failure),
            Stop::NothingFree => "has no free coordinate".to_string(),
            _ => {
                let cause = self.cause(&view.system().mechanism);
                format!("cannot be simulated from t = 0 s: {cause}")
            }
        }
    }

    /// Reports that the motion ends after its last instant, with the reason.
    pub fn explained(&self, view: &Dense, last: &Instant) -> String {
        let reached = time(last.t());
        let cause = match self {
            Stop::NotFinite { t } => infinite_load(view, last, *t),
            Stop::TooShort { .. } => growing_load(view, last),
            _ => None,
        };
        let cause = cause
            .unwrap_or_else(|| self.cause(&view.system().mechanism) + &self.concerned(view, last));
        format!("cannot be simulated beyond t = {reached} s: {cause}")
    }

    fn concerned(&self, view: &Dense, last: &Instant) -> String {
        match self {
            Stop::LosesRank { .. }
            | Stop::TooShort { .. }
            | Stop::Rounded { .. }
            | Stop::Unsettled { .. } => concerned(view, last),
            _ => String::new(),
        }
    }

    fn cause(&self, mechanism: &Mechanism) -> String {
        let at = time(self.time());
        match self {
            Stop::NothingFree => "no coordinate is free".to_string(),
            Stop::NotAssembled(_) => "the mechanism cannot be assembled".to_string(),
            Stop::OutsideRange(failure) => {
                let cause = outside(mechanism, failure);
                cause.unwrap_or_else(|| failure.kind.words().to_string())
            }
            Stop::LosesRank { .. } => format!(
                "the mechanism is singular at about t = {at} s, where the joints lose rank, and no smooth path beyond is certain"
            ),
            Stop::Unsettled { .. } => {
                format!(
                    "the equations of joints and drivers have no solution on the way to t = {at} s"
                )
            }
            Stop::Massless { coordinates, .. } => format!(
                "the acceleration at t = {at} s is undefined, since no mass resists {}",
                unresisted(coordinates, mechanism)
            ),
            Stop::NotFinite { .. } => {
                format!("an acceleration or a power is infinite at t = {at} s")
            }
            Stop::Rounded { .. } => format!(
                "up to t = {at} s it has been so close to a pose in which joints lose rank that rounding exceeds the tolerances; try a larger relative tolerance, or start farther away"
            ),
            Stop::TooShort { .. } => "no step is short enough for the tolerances".to_string(),
            Stop::Unbalanced { drift, .. } => format!(
                "the energy is out of balance at t = {at} s: {drift:.1e} J more than the work accounts for; try a smaller relative tolerance"
            ),
        }
    }
}

/// Returns the load that is not finite at a time (s) in the pose of a frame, in words; `None` if all are finite.
fn infinite_load(view: &Dense, last: &Instant, t: f64) -> Option<String> {
    let mut instant = last.clone();
    Dense::set_time(&mut instant, t);
    let load = not_finite::load(view.pool(), view.system(), view.layout(), &instant)?;
    Some(format!("`{load}` is not finite at t = {} s", time(t)))
}

/// Returns the load that grows without bound toward the time of a frame, in words; `None` if none does.
fn growing_load(view: &Dense, last: &Instant) -> Option<String> {
    let mut before = last.clone();
    Dense::set_time(&mut before, last.t() - BEFORE);
    let load = not_finite::growing(
        view.pool(),
        view.system(),
        view.layout(),
        [&before, last],
        GROWTH,
    )?;
    let t = time(last.t());
    Some(format!("`{load}` grows without bound toward t = {t} s"))
}

/// Returns the names of free coordinates that no mass resists, and the statement that is missing.
fn unresisted(places: &[usize], mechanism: &Mechanism) -> String {
    let free = mechanism.forces.free.iter().enumerate();
    let unresisted_coordinates = free.filter(|(place, _)| places.contains(place));
    let names =
        unresisted_coordinates.map(|(_, free)| format!("`{}`", mechanism.joints[free.joint].label));
    let names: Vec<String> = names.collect();
    let named = match names.as_slice() {
        [only] => format!("the free coordinate {only}"),
        [several @ .., last] => format!(
            "a motion of the free coordinates {} and {last} together",
            several.join(", ")
        ),
        [] => "the motion".to_string(),
    };
    format!("{named}: write `mass BODY = 1kg at POINT;` for a body that moves so")
}

/// Returns the joints and bodies that are closest to singular in a frame.
fn concerned(view: &Dense, last: &Instant) -> String {
    let equations = view.equations();
    let inputs = view.layout().inputs(last);
    equations.supply(
        &crate::supplied::Numbers::nominal_parameters(view.pool(), view.system()),
        &inputs,
    );
    let q = DVector::from_column_slice(last.q());
    let matrix = jacobian(equations, &q, last.t());
    let weakness = Weakness::of(&dimensionless(equations, matrix));
    weakness.map_or(String::new(), |weakness| {
        format!("; {}", SingularParticipants::of(view.system(), &weakness))
    })
}
