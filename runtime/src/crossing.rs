//! Locates a change point of a block, with the modes on both sides of it on the smooth path.
//!
//! If the links of a parallelogram are collinear, its two modes have the same pose. The smooth path continues straight
//! there, which exchanges the names of the modes: the sign of the determinant changes. Before the change point, the
//! square of the distance between the modes is a smooth function of time. If it vanishes to rounding, the modes meet;
//! otherwise they only come close, and the path keeps its mode. Several blocks may exchange modes at the same instant
//! ([`crate::continuation`]).

use crate::blocks::Blocks;
use crate::math::Real;
use crate::way::Way;

/// Factor of the squared distance at which a change point is located: small enough that the squared distance is a
/// parabola.
const LOCATING_FACTOR: f64 = 1.0 / (1u64 << 32) as f64;

/// Multiple of ε above which the squared distance is known there.
const KNOWN: f64 = 16384.0;

/// Part of that below which only rounding is left.
const TOO_NEAR: f64 = 1.0 / 64.0;

/// Multiple of ε to which the square of the distance must fall at the change point.
const ROUNDING: f64 = 1024.0;

/// Part of the largest square above which it is not a parabola, and its vertex is not used.
const BENT: f64 = 1.0 / 256.0;

/// Factor by which the times before the change point move closer to it or farther away.
pub const CLOSER: f64 = 4.0;

/// Distance of the vertex from the middle, in distances of the times, up to which these may come closer.
const REACHED: f64 = 1.5;
/// Such distance up to which the vertex is examined.
const AT_VERTEX: f64 = 1.0 / 16.0;
/// Such distance up to which the search moves to the vertex at once.
const LARGEST_SHIFT: f64 = 4.0;

/// Number of attempts to locate the change point.
const REFINEMENTS: u8 = 32;

/// Number of distances at which the modes are compared far from the change point, each [`CLOSER`] times the one before.
const WAYS: u8 = 12;
/// First of these distances, relative to the path. It is not a rational part of a turn.
pub const SHORTER: f64 = 0.381_966_011_250_105_1;

/// Change point of two modes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Meeting<T> {
    /// Time of the change point (s).
    pub time: T,
    /// Time from it to the nearest frames that determine the path (s), positive.
    pub width: T,
    /// Square of the distance of the modes there.
    pub edge: T,
}

/// Modes of one block of a path about a change point, as they are solved at any time.
pub(crate) struct Crossing<'a, 'w, B: Blocks> {
    pub way: &'a Way<'w, B>,
    /// Block of which two modes meet.
    pub block: u16,
    /// 1 if time grows on the path, otherwise −1.
    pub direction: B::Scalar,
    /// End of the path from which signals continue as smoothly as possible; `None` for those of the path.
    pub about: Option<B::Scalar>,
}

impl<B: Blocks> Crossing<'_, '_, B> {
    /// Solves the frame at a time (s) in these modes, from one nearby; `None` if that fails.
    #[inline(never)]
    pub fn solved(&self, t: B::Scalar, near: &B::Frame, modes: &B::Branches) -> Option<B::Frame> {
        self.way.solved_at(t, self.about, near, modes).ok()
    }

    /// Square of the distance of the modes far from the change point: about `place` (s), as far as a path is long, or
    /// farther.
    pub fn largest_distance(
        &self,
        near: &B::Frame,
        place: B::Scalar,
        way: B::Scalar,
    ) -> Option<B::Scalar> {
        let mut largest = None;
        let mut way = B::Scalar::from_f64(SHORTER) * way;
        for _ in 0..WAYS {
            for t in [place - way, place + way] {
                largest = match (largest, self.distance(self.block, t, near)) {
                    (Some(largest), Some(distance)) => Some(B::Scalar::max(largest, distance)),
                    (largest, distance) => largest.or(distance),
                };
            }
            way *= B::Scalar::from_f64(CLOSER);
        }
        largest
    }

    /// Change point near the time `place` (s); `None` if there is none. The search begins at times of the distance
    /// `first_step` (s) before it. `whole` is the square of the distance elsewhere.
    pub fn meeting(
        &self,
        near: &B::Frame,
        place: B::Scalar,
        mut first_step: B::Scalar,
        whole: B::Scalar,
    ) -> Option<Meeting<B::Scalar>> {
        let (mut middle, mut step) = (place, first_step);
        let number = B::Scalar::from_f64;
        let (two, closer, shorter) = (number(2.0), number(CLOSER), number(SHORTER));
        let known = number(LOCATING_FACTOR).max(number(KNOWN) * B::Scalar::EPSILON);
        for _ in 0..REFINEMENTS {
            let is_ahead = step > B::Scalar::ZERO && whole > B::Scalar::ZERO;
            if !is_ahead {
                return None;
            }
            // Beyond the change point, other blocks may have left the smooth path, so that the distance has a kink
            // there.
            let squares = [1.0, 2.0, 3.0, 4.0].map(|part| {
                self.distance(
                    self.block,
                    middle - self.direction * number(part) * step,
                    near,
                )
            });
            let [Some(first), Some(second), Some(third), Some(fourth)] = squares else {
                first_step *= shorter;
                (middle, step) = (place, first_step);
                continue;
            };
            let curvature = first - second - second + third;
            let slope = (first - third) * B::Scalar::HALF;
            let vertex = -two - slope / curvature;
            let is_lowest = curvature > B::Scalar::ZERO && vertex.is_finite();
            let is_bent = curvature.max(first) > number(BENT) * whole;
            if !is_lowest || is_bent {
                // A prediction from too far away may have led elsewhere.
                first_step *= shorter;
                (middle, step) = (place, first_step);
                continue;
            }
            let is_near = curvature <= known * whole;
            if is_near && curvature < number(TOO_NEAR) * known * whole {
                step *= closer;
                continue;
            }
            if is_near && vertex.abs() <= number(AT_VERTEX) {
                // Polynomial of the third degree, at the middle; below zero there is a gap between two dead points.
                let at_middle = number(4.0) * (first + third) - number(6.0) * second - fourth;
                let lowest = at_middle - B::Scalar::HALF * curvature * vertex * vertex;
                let meets = lowest.abs() <= number(ROUNDING) * B::Scalar::EPSILON * whole;
                let edge = edge(whole);
                return meets.then_some(Meeting {
                    time: middle + self.direction * vertex * step,
                    width: step * (two * edge / curvature).sqrt(),
                    edge,
                });
            }
            if vertex.abs() > number(LARGEST_SHIFT) {
                // From so far away, a larger step determines the middle better.
                step *= closer;
                continue;
            }
            middle += self.direction * vertex * step;
            if !is_near && vertex.abs() <= number(REACHED) {
                step /= closer;
            }
        }
        None
    }

    /// Square of the distance between the poses in both modes of a block.
    #[inline(never)]
    pub fn distance(&self, block: u16, t: B::Scalar, near: &B::Frame) -> Option<B::Scalar> {
        let current = &self.way.branches;
        let other = self.way.blocks.exchanged(current, block)?;
        let first = self.solved(t, near, current)?;
        let second = self.solved(t, near, &other)?;
        Some(square_of_distance(self.way.blocks, [&first, &second], 0))
    }
}

/// Squared distance of modes at the width of a change point, from that elsewhere: the errors of rounding in frames
/// there, and of interpolation between them, are similar.
pub(crate) fn edge<T: Real>(whole: T) -> T {
    T::EPSILON.sqrt().sqrt() * whole
}

/// Sum of the squares of the differences of all coordinates, or if frames hold none, of all components of points; at
/// the level 1, of the rates of coordinates.
pub(crate) fn square_of_distance<B: Blocks>(
    blocks: &B,
    frames: [&B::Frame; 2],
    level: usize,
) -> B::Scalar {
    sum_of_products(blocks, [frames, frames, [frames[0]; 2]], level)
}

/// Sum of the magnitudes of the products of the differences of two pairs of frames, over the values that are equal in a
/// third pair.
#[inline(never)]
pub(crate) fn sum_of_products<B: Blocks>(
    blocks: &B,
    pairs: [[&B::Frame; 2]; 3],
    level: usize,
) -> B::Scalar {
    // Points follow from coordinates, and are then omitted from a program that never reads them.
    let value = |frame: &B::Frame, index| match blocks.holds_coordinates() {
        true => blocks.coordinate(frame, index)?.get(level).copied(),
        false => blocks
            .point(frame, index / 2)?
            .position
            .get(index % 2)
            .copied(),
    };
    let difference =
        |[first, second]: [&B::Frame; 2], index| Some(value(first, index)? - value(second, index)?);
    let mut sum = B::Scalar::ZERO;
    let mut index = 0;
    while let [Some(one), Some(other), Some(change)] = pairs.map(|pair| difference(pair, index)) {
        if change == B::Scalar::ZERO {
            sum += (one * other).abs();
        }
        index += 1;
    }
    sum
}
