//! A pose near which two assembly modes of a block meet → the frame beyond it on the smooth path, in the other mode.
//!
//! Where the links of a parallelogram are in line, its two modes have the same pose. The smooth path goes straight on there, which
//! exchanges the names of the modes: the sign of the determinant changes. Nearby the square of the distance between the modes is a
//! smooth function of time. Where it vanishes to rounding they meet; where it does not, they only come close, and nothing is crossed.
//! Beyond the meeting the pose must be the one that lies opposite to that before it. The module does not know equations.

use crate::blocks::Blocks;
use crate::math::Real;

/// How far the square of the distance is fallen where the meeting is looked at: small enough that it is a parabola, large enough that
/// it is known.
const NEAR: f64 = 1.0 / (1u32 << 30) as f64;

/// The multiple of ε to which it must fall there.
const ROUNDING: f64 = 1024.0;

/// Largest miss of what lies opposite by the pose beyond: towards the other mode, as a part of the distance of the modes, and in any
/// direction, as a part of the square of all that moves.
const MISS: [f64; 2] = [1.0 / 8.0, 1.0 / 64.0];

/// How many steps before and beyond the meeting the poses are compared, and at least.
const COMPARED: [f64; 2] = [256.0, 8.0];

/// The least distance of the first times about the meeting, as a part of the way so far.
const FIRST_STEP: f64 = 1.0 / 16.0;

/// By how much the times are brought closer together at once, and how many times their distance the middle may move.
const CLOSER: f64 = 4.0;
const LARGEST_SHIFT: f64 = 4.0;

/// How often the times about the meeting are brought closer together.
const REFINEMENTS: u8 = 32;

/// How often a way is doubled to see the modes well apart.
const DOUBLINGS: u8 = 8;

/// The last frame before a meeting, and the first one beyond it.
pub(crate) struct Meeting<T> {
    /// When the modes meet (s).
    pub time: T,
    /// How long before and after it they can be told apart (s), signed as time goes.
    pub apart: T,
}

/// The two modes of one block, as they are solved at any time.
pub(crate) struct TwoModes<'a, B: Blocks, S> {
    pub blocks: &'a B,
    /// The modes before the meeting, and beyond it.
    pub modes: [B::Branches; 2],
    /// Solves all blocks at a time (s) from a frame nearby.
    pub solve: S,
}

impl<B, S> TwoModes<'_, B, S>
where
    B: Blocks,
    S: FnMut(B::Scalar, &B::Frame, &B::Branches) -> Option<B::Frame>,
{
    /// The square of how far the modes are apart where they are well apart: at the first frame of a way, or as far before the way or
    /// beyond it as it is long, or farther.
    pub fn largest_distance(
        &mut self,
        [origin, reached]: [&B::Frame; 2],
        [from, to]: [B::Scalar; 2],
    ) -> Option<B::Scalar> {
        let mut largest = self.distance(B::time(origin), origin);
        let mut way = to - from;
        for _ in 0..DOUBLINGS {
            for t in [from - way, to + way] {
                largest = match (largest, self.distance(t, reached)) {
                    (Some(largest), Some(distance)) => Some(largest.max(distance)),
                    (largest, distance) => largest.or(distance),
                };
            }
            way += way;
        }
        largest
    }

    /// Where the modes meet, between `reached` and the time `to` (s), if they do. `whole` is the square of how far they are apart
    /// elsewhere.
    pub fn meeting(
        &mut self,
        [origin, reached]: [&B::Frame; 2],
        whole: B::Scalar,
        refused: B::Scalar,
        to: B::Scalar,
    ) -> Option<Meeting<B::Scalar>> {
        let [from, near] = [origin, reached].map(B::time);
        let four = B::Scalar::from_f64(4.0);
        let mut middle = near;
        let closer = B::Scalar::from_f64(CLOSER);
        let first = B::Scalar::from_f64(FIRST_STEP) * (near - from).abs();
        let mut step = (refused - near).abs().max(first);
        let is_ahead = step > B::Scalar::ZERO;
        if !is_ahead {
            return None;
        }
        for _ in 0..REFINEMENTS {
            let around = [middle - step, middle, middle + step];
            let [before, at, after] = around.map(|t| self.distance(t, reached));
            let (Some(before), Some(after)) = (before, after) else {
                step /= closer;
                continue;
            };
            // Where the modes meet, rounding may leave links apart, and where there is a gap, they are: the parabola through four other
            // times says which.
            let at = at.or_else(|| {
                let [before_that, after_that] =
                    [middle - step - step, middle + step + step].map(|t| self.distance(t, reached));
                let (near, far) = (before + after, before_that? + after_that?);
                Some((four * near - far) / B::Scalar::from_f64(6.0))
            });
            let Some(at) = at else {
                step /= closer;
                continue;
            };
            let curvature = before - at - at + after;
            let is_lowest = curvature > B::Scalar::ZERO;
            if !is_lowest {
                return None;
            }
            let slope = (after - before) * B::Scalar::HALF;
            let shift = slope / curvature;
            let lowest = at - slope * shift * B::Scalar::HALF;
            if curvature <= B::Scalar::from_f64(NEAR) * whole && shift.abs() <= B::Scalar::ONE {
                let time = middle - shift * step;
                let is_between = (time - near) * (to - time) >= B::Scalar::ZERO;
                // Below zero there is a gap between two dead points.
                let meets =
                    lowest.abs() <= B::Scalar::from_f64(ROUNDING) * B::Scalar::EPSILON * whole;
                let apart = if to < near { -step } else { step };
                return (is_between && meets).then_some(Meeting { time, apart });
            }
            // The parabola is followed as far as it can be trusted.
            let limit = B::Scalar::from_f64(LARGEST_SHIFT);
            let shift = if shift.abs() <= limit {
                shift
            } else {
                limit * shift / shift.abs()
            };
            middle -= shift * step;
            if shift.abs() <= B::Scalar::ONE {
                step /= closer;
            }
        }
        None
    }

    /// The frame beyond a meeting that lies opposite to the one as long before it, but not later than `to` (s); and that time before.
    pub fn opposite(
        &mut self,
        meeting: &Meeting<B::Scalar>,
        reached: &B::Frame,
        to: B::Scalar,
    ) -> Option<[B::Frame; 2]> {
        let &Meeting { time, apart } = meeting;
        let [far, least] = COMPARED.map(B::Scalar::from_f64);
        let mut way = far * apart;
        for limit in [(to - time).abs(), (time - B::time(reached)).abs()] {
            if limit < way.abs() {
                way = way * (limit / way.abs());
            }
        }
        let is_told_apart = way.abs() >= least * apart.abs();
        if !is_told_apart {
            return None;
        }
        let [own, other] = self.modes.clone();
        let before = (self.solve)(time - way, reached, &own)?;
        let beyond = (self.solve)(time + way, &before, &other)?;
        let unchanged = (self.solve)(time + way, &before, &own)?;
        let center = [
            (self.solve)(time - apart, &before, &own)?,
            (self.solve)(time - apart, &before, &other)?,
            (self.solve)(time + apart, &before, &own)?,
            (self.solve)(time + apart, &before, &other)?,
        ];
        let missed = |frame: &B::Frame| {
            self.sum_of_squares(|value| {
                let half = B::Scalar::HALF;
                let mut middle = B::Scalar::ZERO;
                for frame in &center {
                    middle += half * value(frame)?;
                }
                Some(value(frame)? + value(&before)? - middle)
            })
        };
        let [crossed, stayed] = [&beyond, &unchanged].map(missed);
        let apart = self.sum_of_squares(|value| Some(value(&unchanged)? - value(&beyond)?));
        let moved = self.sum_of_squares(|value| Some(value(&beyond)? - value(&before)?));
        // What the path bends by in other units must not hide in which mode it goes on: twice the product of the miss and the way between
        // the modes is what these squares differ by.
        let [towards, in_all] = MISS.map(B::Scalar::from_f64);
        let product = ((stayed - crossed) - apart) * B::Scalar::HALF;
        let lies_opposite =
            product.abs() <= towards * apart && crossed <= in_all * (stayed + moved);
        lies_opposite.then_some([before, beyond])
    }

    /// The square of the distance between the poses in both modes.
    fn distance(&mut self, t: B::Scalar, near: &B::Frame) -> Option<B::Scalar> {
        let [first, second] = self.modes.clone();
        let first = (self.solve)(t, near, &first)?;
        let second = (self.solve)(t, near, &second)?;
        Some(self.sum_of_squares(|value| Some(value(&first)? - value(&second)?)))
    }

    /// The sum of the squares of what is made of each coordinate, or where frames hold none, of each component of the points.
    fn sum_of_squares(
        &self,
        combine: impl Fn(&dyn Fn(&B::Frame) -> Option<B::Scalar>) -> Option<B::Scalar>,
    ) -> B::Scalar {
        let mut sum = B::Scalar::ZERO;
        let mut index = 0;
        while let Some(part) = combine(&|frame| Some(self.blocks.coordinate(frame, index)?[0])) {
            sum += part * part;
            index += 1;
        }
        // Points follow from coordinates, and are then left out of a program that never asks for them.
        if index > 0 || self.blocks.holds_coordinates() {
            return sum;
        }
        while let Some(part) = combine(&|frame| {
            let point = self.blocks.point(frame, index / 2)?;
            point.position.get(index % 2).copied()
        }) {
            sum += part * part;
            index += 1;
        }
        sum
    }
}
