//! Why a simulated motion ends.

use linkwright::{Blocks, Failure};

use crate::instant::Instant;
use crate::interpreted::Interpreted;
use crate::measures::Measures;
use crate::number::time;
use crate::view::View;

/// The measure below which a part of the last frame is about to be singular.
pub(super) const SINGULAR: f64 = 1e-3;

/// Why a motion ends before its time, or does not begin.
#[derive(Clone, Debug, PartialEq)]
pub enum Stop {
    /// No coordinate is free.
    NothingFree,
    /// It cannot be assembled where it starts.
    NotAssembled(Failure),
    /// The mechanism cannot be solved there: an end of its motion, a singular pose, or one in which the free coordinate moves nothing on.
    Unsolvable(Failure),
    /// Nothing that moves with a free coordinate has a mass.
    Massless {
        /// When (s).
        t: f64,
        /// Which: its place among the free coordinates.
        coordinate: usize,
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
}

impl Stop {
    /// When (s).
    pub fn time(&self) -> f64 {
        match self {
            Stop::NothingFree => 0.0,
            Stop::NotAssembled(failure) | Stop::Unsolvable(failure) => failure.time,
            Stop::Massless { t, .. } | Stop::NotFinite { t } | Stop::TooShort { t } => *t,
        }
    }

    /// Whether the motion ends because several loops become singular at once.
    pub fn is_where_loops_meet(&self, view: &Interpreted, last: &Instant) -> bool {
        matches!(self, Stop::Unsolvable(_) | Stop::TooShort { .. })
            && are_several(&sizes(view, last))
    }

    /// That and why the motion ends after its last instant, where it has one.
    pub fn explained(&self, view: &Interpreted, last: Option<&Instant>) -> String {
        let at = time(self.time());
        let reached = time(last.map_or(0.0, Instant::t));
        match self {
            Stop::NothingFree => "has no free coordinate".to_string(),
            Stop::NotAssembled(failure) => view.not_assembled(failure),
            Stop::Unsolvable(failure) => {
                let cause = view.explained(failure);
                format!(
                    "cannot be simulated beyond t = {reached} s: {}{}",
                    cause.cause(),
                    closeness(view, last)
                )
            }
            Stop::Massless { coordinate, .. } => {
                let free = view.system().mechanism.forces.free.get(*coordinate);
                let joint = free.map(|it| &view.system().mechanism.joints[it.joint].label);
                let name = joint.map_or("", String::as_str);
                format!(
                    "has no acceleration at t = {at} s: nothing that moves along `{name}` alone has a mass"
                )
            }
            Stop::NotFinite { .. } => {
                format!("cannot be simulated beyond t = {reached} s: an acceleration is infinite")
            }
            Stop::TooShort { .. } => format!(
                "cannot be simulated beyond t = {reached} s: no step is short enough for the tolerances{}",
                closeness(view, last)
            ),
        }
    }
}

/// The measures of all parts of a frame.
fn sizes(view: &Interpreted, frame: &Instant) -> Vec<(String, f64)> {
    let measures = Measures::new(view);
    let samples = measures.at(frame);
    let parts = measures.parts().iter().zip(samples);
    let sizes =
        parts.map(|(part, [size, _])| (part.unknowns.join(" and "), part.bounded(size.abs())));
    sizes.collect()
}

/// The part of a frame that is closest to singular, and its measure.
pub(super) fn closest(view: &Interpreted, frame: &Instant) -> Option<(String, f64)> {
    smallest(&sizes(view, frame)).cloned()
}

fn smallest(sizes: &[(String, f64)]) -> Option<&(String, f64)> {
    sizes
        .iter()
        .min_by(|(_, one), (_, other)| one.total_cmp(other))
}

/// How close to singular the closest part of a frame is.
fn closeness(view: &Interpreted, frame: Option<&Instant>) -> String {
    let sizes = frame.map_or(Vec::new(), |frame| sizes(view, frame));
    let Some((part, size)) = smallest(&sizes) else {
        return String::new();
    };
    let several = match are_several(&sizes) {
        true => ", and several loops become singular there at once",
        false => "",
    };
    format!("; in the last frame the normalized determinant of {part} is {size:.1e}{several}")
}

/// Whether more than one part is about to be singular.
fn are_several(sizes: &[(String, f64)]) -> bool {
    sizes.iter().filter(|(_, size)| *size < SINGULAR).count() > 1
}
