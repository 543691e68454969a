//! Joins instants of the program that is written out with those of a fuller program of the same mechanism.

use crate::instant::{Instant, OutputMotion};

/// Blocks of the program that is written out, which omits some values of a fuller one.
#[derive(Clone, Debug)]
pub struct Emitted<B> {
    /// Blocks of the program.
    pub(crate) blocks: B,
    /// Indices of values in instants of the fuller program, and of equal values in instants of this one.
    pub(crate) equal: Vec<[usize; 2]>,
    /// Points of `output`.
    pub(crate) points: Vec<OutputSlots>,
}

/// Position, rate or acceleration of a point in instants of the emitted program.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OutputSlots {
    /// Index of the point in the fuller program.
    pub point: usize,
    /// Order of the derivative.
    pub level: usize,
    /// Indices of x and y.
    pub slots: [usize; 2],
}

impl<B> Emitted<B> {
    /// Returns an instant of the fuller program with all values that the emitted one has at the same time.
    pub(crate) fn joined(&self, fuller: &Instant, emitted: &Instant) -> Instant {
        let mut joined = fuller.clone();
        for &[to, from] in &self.equal {
            joined.values_mut()[to] = emitted.values()[from];
        }
        let points = self.points.iter().map(|it| OutputMotion {
            point: it.point,
            level: it.level,
            components: it.slots.map(|slot| emitted.values()[slot]),
        });
        joined.set_outputs(points.collect());
        joined
    }
}
