//! Proof that a mechanism moves on one smooth path over a whole range of time, and what holds all the while.
//!
//! The range is covered by windows between frames. In each of them the equations have one solution near the chord, which
//! `window` verifies in intervals that are rounded outwards; every frame between two windows lies in both, so that their solutions are
//! one path. A window that is too wide is halved. Frames are only where windows are looked for: how they were found proves nothing.

mod claims;
mod functions;
mod matrices;
mod prover;
mod window;

use crate::check::CheckedPart;
use crate::interpreted::Interpreted;
use crate::schedule::Schedule;
use crate::view::View;
use prover::{Prover, Window};

/// What is proven of a whole motion, or where it cannot be.
#[derive(Clone, Debug, PartialEq)]
pub struct Proof {
    /// The range of time (s).
    pub range: [f64; 2],
    /// The windows that cover it, or what was proven before the first one that cannot be.
    pub windows: usize,
    /// The length of the shortest one (s).
    pub shortest: f64,
    /// What holds all over the range; nothing where it cannot be proven.
    pub proven: Option<Proven>,
    /// The first window that cannot be proven.
    pub unproven: Option<Unproven>,
}

/// What holds all over a range.
#[derive(Clone, Debug, PartialEq)]
pub struct Proven {
    /// The normalized determinants of blocks.
    pub determinants: Vec<Determinant>,
    /// The coordinates, in their order.
    pub coordinates: Vec<Enclosed>,
    /// Both components of each point that was asked for.
    pub points: Vec<[Enclosed; 2]>,
}

/// A bound on a normalized determinant.
#[derive(Clone, Debug, PartialEq)]
pub struct Determinant {
    /// The block of the plan, from 0.
    pub block: usize,
    /// The part of the block, from 0.
    pub part: usize,
    /// What its size is at least.
    pub least: f64,
    /// The smallest size that was located.
    pub located: f64,
}

/// A range in which a quantity stays.
#[derive(Clone, Debug, PartialEq)]
pub struct Enclosed {
    /// Its name.
    pub name: String,
    /// Whether it is an angle (rad), or else a length (m).
    pub is_angle: bool,
    /// Its bounds.
    pub bounds: [f64; 2],
    /// The smallest and the largest value in a frame.
    pub swept: [f64; 2],
}

/// Where a motion cannot be proven.
#[derive(Clone, Debug, PartialEq)]
pub struct Unproven {
    /// The window (s).
    pub window: [f64; 2],
    /// The block of the plan, from 0; `None` where no block is to blame.
    pub block: Option<usize>,
    /// Why.
    pub reason: String,
}

impl Proof {
    /// Proves the motion from its assembly as drawn over a schedule; `parts` are what was located of its blocks, and `points` the outputs
    /// whose places are wanted.
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
