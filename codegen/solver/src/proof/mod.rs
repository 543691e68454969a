//! Proves that a mechanism moves on one smooth path over a range of time, and bounds quantities over that range.
//!
//! The range is covered by windows between frames. In each window the equations have one solution near the chord, which `window`
//! verifies in intervals that are rounded outwards. Every frame between two windows lies in both, so that their solutions are one path.
//! A window that is too wide is halved. Frames only suggest where windows are: their computation proves nothing.

mod claims;
mod functions;
mod matrices;
mod prover;
mod window;

use crate::checked_part::CheckedPart;
use crate::interpreted::Interpreted;
use crate::schedule::Schedule;
use crate::view::View;
use prover::{Prover, Window};

/// Proof of a motion, or its first gap.
#[derive(Clone, Debug, PartialEq)]
pub struct Proof {
    /// Range of time (s).
    pub range: [f64; 2],
    /// Number of windows that cover the range, or those before the first gap.
    pub windows: usize,
    /// Length of the shortest window (s).
    pub shortest: f64,
    /// Bounds over the range; `None` if the motion cannot be proven.
    pub proven: Option<Proven>,
    /// First window that cannot be proven; `None` if all can.
    pub unproven: Option<Unproven>,
}

/// Bounds over a range of time.
#[derive(Clone, Debug, PartialEq)]
pub struct Proven {
    /// Normalized determinants of blocks.
    pub determinants: Vec<Determinant>,
    /// Coordinates in their order.
    pub coordinates: Vec<Enclosed>,
    /// Components of each requested point.
    pub points: Vec<[Enclosed; 2]>,
    /// Measures of positions, each with its index among the mechanism's measurements, in SI units.
    pub measures: Vec<(usize, Enclosed)>,
}

/// Bound on a normalized determinant.
#[derive(Clone, Debug, PartialEq)]
pub struct Determinant {
    /// Block of the plan, from 0.
    pub block: usize,
    /// Subsystem of the block, from 0.
    pub part: usize,
    /// Lower bound of its magnitude.
    pub least: f64,
    /// Smallest located magnitude.
    pub located: f64,
}

/// Range of a quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Enclosed {
    /// Name.
    pub name: String,
    /// True for an angle (rad), false for a length (m).
    pub is_angle: bool,
    /// Bounds.
    pub bounds: [f64; 2],
    /// Smallest and largest value in a frame.
    pub swept: [f64; 2],
}

/// Gap in the proof of a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Unproven {
    /// Window (s).
    pub window: [f64; 2],
    /// Block of the plan, from 0; `None` if no single block fails.
    pub block: Option<usize>,
    /// Reason.
    pub reason: String,
}

impl Proof {
    /// Proves the motion from its assembly in the design configuration over a schedule.
    ///
    /// `parts` are the located minima of its blocks, and `points` the outputs whose positions are bounded.
    pub fn new(
        interpreted: &Interpreted,
        schedule: &Schedule,
        parts: &[CheckedPart],
        points: &[usize],
    ) -> Proof {
        let mut proof = Proof {
            range: [schedule.start.t; 2],
            windows: 0,
            shortest: f64::INFINITY,
            proven: None,
            unproven: None,
        };
        let times = schedule.forward.visits().map(|visit| visit.t);
        let times: Vec<f64> = times.collect();
        proof.range[1] = times.last().copied().unwrap_or(proof.range[0]);
        match proof.prove(interpreted, &times, parts, points) {
            Ok(proven) => proof.proven = Some(proven),
            Err(unproven) => proof.unproven = Some(unproven),
        }
        if proof.windows == 0 {
            proof.shortest = 0.0;
        }
        proof
    }

    fn prove(
        &mut self,
        interpreted: &Interpreted,
        times: &[f64],
        parts: &[CheckedPart],
        points: &[usize],
    ) -> Result<Proven, Unproven> {
        let start = self.range[0];
        let mut prover = Prover::new(interpreted, start, parts, points)?;
        let mut windows = Vec::new();
        let next = times.first().copied().unwrap_or(start);
        let mut last = prover.node().map_err(|unproven| Unproven {
            window: [start, next],
            ..unproven
        })?;
        for &t in times {
            prover.cover(last, t, &mut windows, self)?;
            last = windows.last().map_or(last, |window| window.ends[1]);
        }
        self.note(&windows, &prover);
        let windows = prover.narrowed(windows, self)?;
        self.note(&windows, &prover);
        Ok(prover
            .claims
            .proven(interpreted.system(), &prover, &windows))
    }

    fn note(&mut self, windows: &[Window], prover: &Prover<'_>) {
        self.windows = windows.len();
        let lengths = windows.iter();
        let lengths = lengths.map(|it| prover.time(it.ends[1]) - prover.time(it.ends[0]));
        self.shortest = lengths.fold(f64::INFINITY, f64::min);
    }
}
