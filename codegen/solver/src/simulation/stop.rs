//! Why a simulated motion ends.

use linkwright::Failure;
use nalgebra::DVector;

use crate::concerned::Concerned;
use crate::condition::{Weakness, dimensionless, jacobian};
use crate::dense::Dense;
use crate::instant::Instant;
use crate::interpreted::Interpreted;
use crate::number::time;
use crate::view::View;

/// Why a motion ends before its time, or does not begin.
#[derive(Clone, Debug, PartialEq)]
pub enum Stop {
    /// No coordinate is free.
    NothingFree,
    /// It cannot be assembled where it starts.
    NotAssembled(Failure),
    /// The equations of joints and of drivers that are not free lose rank there, and the motion has no smooth way through that is
    /// known to be one.
    LosesRank {
        /// When (s).
        t: f64,
    },
    /// No pose is found on the constraints: drivers or tables lead to where there is none.
    Unsettled {
        /// When (s).
        t: f64,
    },
    /// Nothing that moves with a free coordinate has a mass.
    Massless {
        /// When (s).
        t: f64,
        /// Which: its place among the free coordinates; `None` where it is a combination of several.
        coordinate: Option<usize>,
    },
    /// An acceleration or a power is infinite or no number.
    NotFinite {
        /// When (s).
        t: f64,
    },
    /// No step is short enough for the tolerances.
    TooShort {
        /// When (s).
        t: f64,
    },
    /// The motion has been so close to where joints and drivers lose rank that rounding changes it by more than the tolerances.
    Rounded {
        /// When (s).
        t: f64,
    },
    /// The energy changes by something else than the work that is done: the motion is wrong from about there on.
    Unbalanced {
        /// When (s).
        t: f64,
        /// What the work does not account for (J).
        drift: f64,
    },
}

impl Stop {
    /// When (s).
    pub fn time(&self) -> f64 {
        match self {
            Stop::NothingFree => 0.0,
            Stop::NotAssembled(failure) => failure.time,
            Stop::LosesRank { t }
            | Stop::Unsettled { t }
            | Stop::Massless { t, .. }
            | Stop::NotFinite { t }
            | Stop::TooShort { t }
            | Stop::Rounded { t }
            | Stop::Unbalanced { t, .. } => *t,
        }
    }

    /// That and why the motion does not begin.
    pub fn not_begun(&self, view: &Interpreted) -> String {
        match self {
            Stop::NotAssembled(failure) => view.not_assembled(failure),
            Stop::Massless {
                coordinate: Some(place),
                ..
            } => {
                let mechanism = &view.system().mechanism;
                let free = mechanism.forces.free.get(*place);
                let joint = free.map(|it| &mechanism.joints[it.joint].label);
                let name = joint.map_or("", String::as_str);
                format!(
                    "has no acceleration at t = {} s: nothing that moves along `{name}` alone has a mass",
                    time(self.time())
                )
            }
            Stop::NothingFree => "has no free coordinate".to_string(),
            _ => format!("cannot be simulated from t = 0 s: {}", self.cause()),
        }
    }

    /// That and why the motion ends after its last instant.
    pub fn explained(&self, view: &Dense, last: &Instant) -> String {
        let reached = time(last.t());
        let concerned = match self {
            Stop::LosesRank { .. }
            | Stop::TooShort { .. }
            | Stop::Rounded { .. }
            | Stop::Unsettled { .. } => concerned(view, last),
            _ => String::new(),
        };
        format!(
            "cannot be simulated beyond t = {reached} s: {}{concerned}",
            self.cause()
        )
    }

    fn cause(&self) -> String {
        let at = time(self.time());
        match self {
            Stop::NothingFree => "no coordinate is free".to_string(),
            Stop::NotAssembled(_) => "the mechanism cannot be assembled".to_string(),
            Stop::LosesRank { .. } => format!(
                "the equations of the joints lose rank at about t = {at} s, and no smooth way through is certain"
            ),
            Stop::Unsettled { .. } => {
                format!(
                    "the equations of joints and drivers have no solution on the way to t = {at} s"
                )
            }
            Stop::Massless { .. } => {
                format!(
                    "there is no acceleration at t = {at} s: nothing that moves in one of its directions has a mass"
                )
            }
            Stop::NotFinite { .. } => {
                format!("an acceleration or a power is infinite at t = {at} s")
            }
            Stop::Rounded { .. } => format!(
                "up to t = {at} s it has been so close to a pose in which joints lose rank that rounding exceeds the tolerances; try a larger `--rtol`, or start farther away"
            ),
            Stop::TooShort { .. } => "no step is short enough for the tolerances".to_string(),
            Stop::Unbalanced { drift, .. } => format!(
                "the energy is out of balance at t = {at} s: {drift:.1e} J more than the work accounts for; try a smaller `--rtol`"
            ),
        }
    }
}

/// The joints and bodies that are closest to singular in a frame.
fn concerned(view: &Dense, last: &Instant) -> String {
    let equations = view.equations();
    let inputs = view.layout().inputs(last);
    equations.supply(
        &crate::supplied::Numbers::nominal_parameters(view.system()),
        &inputs,
    );
    let q = DVector::from_column_slice(last.q());
    let matrix = jacobian(equations, &q, last.t());
    let weakness = Weakness::of(&dimensionless(equations, matrix));
    weakness.map_or(String::new(), |weakness| {
        format!("; {}", Concerned::of(view.system(), &weakness))
    })
}
