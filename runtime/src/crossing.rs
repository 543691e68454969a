//! A pose near which two assembly modes of a block meet → its time, and the modes on both sides of it on the smooth path.
//!
//! Where the links of a parallelogram are in line, its two modes have the same pose. The smooth path goes straight on there, which
//! exchanges the names of the modes: the sign of the determinant changes. Before the meeting the square of the distance between the
//! modes is a smooth function of time. Where it vanishes to rounding they meet; where it does not, they only come close, and nothing is
//! crossed. Several blocks may cross in the same instant ([`crate::continuation`]). The module does not know equations.

use crate::blocks::Blocks;
use crate::math::Real;
use crate::way::Way;

/// Part to which the square of the distance is fallen where the meeting is looked at: small enough that it is a parabola.
const NEAR: f64 = 1.0 / (1u64 << 32) as f64;

/// Multiple of ε above which it is known there.
const KNOWN: f64 = 16384.0;

/// Part of that below which rounding is all that is seen.
const TOO_NEAR: f64 = 1.0 / 64.0;

/// Multiple of ε to which the square of the distance must fall at the meeting.
const ROUNDING: f64 = 1024.0;

/// Part of the largest square above which it is no parabola, and its vertex is not gone to.
const BENT: f64 = 1.0 / 256.0;

/// Factor by which the times before the meeting are brought closer to it or taken farther away.
pub const CLOSER: f64 = 4.0;

/// Distance of the vertex from the middle, in distances of the times, at which these may come closer, at which it is looked at, and to
/// which it is followed at once.
const REACHED: f64 = 1.5;
const AT_VERTEX: f64 = 1.0 / 16.0;
const LARGEST_SHIFT: f64 = 4.0;

/// Number of attempts to find the meeting.
const REFINEMENTS: u8 = 32;

/// Number of the ways, each [`CLOSER`] times as long as the one before, at which the modes are seen well apart, and the first, which is no
/// part of a turn.
const WAYS: u8 = 12;
pub const SHORTER: f64 = 0.381_966_011_250_105_1;

/// A pose at which modes meet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Meeting<T> {
    /// Its time (s).
    pub time: T,
    /// Time from it to the nearest frames by which the path is told (s), positive.
    pub width: T,
    /// The square of the distance of the modes there.
    pub edge: T,
}

/// The modes of one block of a way about a meeting, as they are solved at any time.
pub(crate) struct Crossing<'a, 'w, B: Blocks> {
    pub way: &'a Way<'w, B>,
    /// The block of which two modes meet.
    pub block: u16,
    /// 1 where time grows on the way, and else −1.
    pub direction: B::Scalar,
    /// The end of the way from which signals go on as smoothly as they can; `None` for those of the way.
    pub about: Option<B::Scalar>,
}

impl<B: Blocks> Crossing<'_, '_, B> {
    /// The frame at a time (s) in these modes, from one nearby.
    #[inline(never)]
    pub fn solved(&self, t: B::Scalar, near: &B::Frame, modes: &B::Branches) -> Option<B::Frame> {
        self.way.solved_at(t, self.about, near, modes).ok()
    }

    /// Square of the distance of the modes where they are well apart: about `place` (s), as far as a way is long, or farther.
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

    /// The meeting near the time `place` (s), if there is one; times of the distance `first_step` (s) before it are looked at first.
    /// `whole` is the square of the distance elsewhere.
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
        let known = number(NEAR).max(number(KNOWN) * B::Scalar::EPSILON);
        for _ in 0..REFINEMENTS {
            let is_ahead = step > B::Scalar::ZERO && whole > B::Scalar::ZERO;
            if !is_ahead {
                return None;
            }
            // Beyond the meeting other blocks may have left the smooth path, so that the distance has a kink there.
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
                // What was seen from too far away may have led elsewhere.
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
                // The polynomial of the third degree, at the middle; below zero there is a gap between two dead points.
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
                // Seen from so far away, what is between is known better from a larger step.
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

    /// The square of the distance between the poses in both modes of a block.
    #[inline(never)]
    pub fn distance(&self, block: u16, t: B::Scalar, near: &B::Frame) -> Option<B::Scalar> {
        let own = &self.way.branches;
        let other = self.way.blocks.exchanged(own, block)?;
        let first = self.solved(t, near, own)?;
        let second = self.solved(t, near, &other)?;
        Some(square_of_distance(self.way.blocks, [&first, &second], 0))
    }
}

/// The square of the distance of modes at the width of a meeting, of that elsewhere: what rounding leaves of frames there, and what
/// interpolation between them leaves, are alike.
pub(crate) fn edge<T: Real>(whole: T) -> T {
    T::EPSILON.sqrt().sqrt() * whole
}

/// The sum of the squares of the differences of all coordinates, or where frames hold none, of all components of points; or, at the
/// level 1, of the rates of coordinates.
pub(crate) fn square_of_distance<B: Blocks>(
    blocks: &B,
    frames: [&B::Frame; 2],
    level: usize,
) -> B::Scalar {
    sum_of_products(blocks, [frames, frames, [frames[0]; 2]], level)
}

/// The sum of the sizes of the products of the differences of two pairs of frames in those of these values that are equal in a third
/// pair.
#[inline(never)]
pub(crate) fn sum_of_products<B: Blocks>(
    blocks: &B,
    pairs: [[&B::Frame; 2]; 3],
    level: usize,
) -> B::Scalar {
    // Points follow from coordinates, and are then left out of a program that never asks for them.
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
