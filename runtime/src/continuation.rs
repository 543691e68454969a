//! Selects the smooth path through a change point, from frames on both sides.
//!
//! Four frames on each side determine the path. Their even and odd differences of the highest order vanish for a smooth
//! motion. If the modes beyond are not those of the path, the differences show a kink. Near the change point, where
//! equations are nearly singular, frames are interpolated between these eight.

use crate::blocks::Blocks;
use crate::crossing::{CLOSER, Crossing, Meeting, edge, square_of_distance, sum_of_products};
use crate::math::Real;

/// Highest differences of the sums of frames at the distances 1, 2, 3 and 4 on both sides.
const EVEN: [f64; 4] = [-7.0, 14.0, -9.0, 2.0];
/// Highest differences of the differences of these frames.
const ODD: [f64; 4] = [-14.0, 14.0, -6.0, 1.0];

/// Largest difference of the smooth path, relative to the distance of the modes, for passing the change point. A kink
/// leaves four times that distance.
const SMOOTH: f64 = 1.0 / 64.0;
/// Largest such difference for interpolation.
const MAX_INTERPOLATED_DIFFERENCE: f64 = 1.0 / 16384.0;

/// Multiple of the squared distance of the modes up to which modes of other blocks meet at the same instant.
const SIMULTANEOUS_FACTOR: f64 = 64.0;

/// Number of times at which modes of another block are compared, each [`CLOSER`] times as near to a change point as the
/// one before.
pub const NEARER: u8 = 3;
/// Factor by which the square of the modes' distance falls from one of these times to the next if they meet.
const FALLEN: f64 = 0.25;

/// Number of the first blocks whose modes may be exchanged.
pub const BLOCKS: u16 = 64;

/// Modes before a change point and beyond it, in the direction of the path.
pub(crate) struct Sides<M> {
    pub before: M,
    pub beyond: M,
}

impl<M> Sides<M> {
    /// Returns these modes before the change point, or beyond it.
    fn new(own: M, other: M, is_before: bool) -> Self {
        match is_before {
            true => Self {
                before: own,
                beyond: other,
            },
            false => Self {
                before: other,
                beyond: own,
            },
        }
    }
}

/// Weights of frames in sums.
#[derive(Clone, Copy)]
enum Weights<T> {
    /// Weights of the highest differences.
    Differences,
    /// Weights of interpolation at a time, and their sum.
    Interpolation(T, T),
}

impl<T: Real> Weights<T> {
    /// Weights of a frame on a side, −1 or 1, at a distance with this index.
    fn of(self, side: T, distance: T, index: usize) -> [T; 2] {
        match self {
            Self::Differences => [T::from_f64(EVEN[index]), side * T::from_f64(ODD[index])],
            Self::Interpolation(place, whole) => {
                let part = side * T::from_f64(ODD[index]) / (place - side * distance);
                [part / whole, T::ZERO]
            }
        }
    }

    /// Weights of interpolation at a time.
    fn at(place: T) -> Self {
        let parts = Self::Interpolation(place, T::ONE);
        let mut whole = T::ZERO;
        for side in [-T::ONE, T::ONE] {
            let mut distance = T::ZERO;
            for index in 0..ODD.len() {
                distance += T::ONE;
                whole += parts.of(side, distance, index)[0];
            }
        }
        Self::Interpolation(place, whole)
    }
}

impl<B: Blocks> Crossing<'_, '_, B> {
    /// Modes on both sides of a change point on the smooth path, which has the current modes before it, or beyond it;
    /// `None` if no path is smooth.
    #[inline(never)]
    pub fn sides(
        &self,
        near: &B::Frame,
        meeting: &Meeting<B::Scalar>,
        is_before: bool,
    ) -> Option<Sides<B::Branches>> {
        let current = self.way.branches.clone();
        let smooth = B::Scalar::from_f64(SMOOTH);
        let meets = self.blocks_that_meet(near, meeting);
        let mut chosen = current.clone();
        let mut is_exchanged = false;
        // Each block is judged by values that no later block changes, because later blocks are not decided yet.
        for block in (0..BLOCKS).filter(|block| meets & (1 << block) != 0) {
            let mut later = current.clone();
            for other in (block + 1..BLOCKS).filter(|other| meets & (1 << other) != 0) {
                later = self.way.blocks.exchanged(&later, other)?;
            }
            let change = [&self.way.blocks.exchanged(&current, block)?, &later];
            let tried = self.way.blocks.exchanged(&chosen, block)?;
            let is_smooth = |other: &B::Branches| {
                let sides = Sides::new(&current, other, is_before);
                let roughness = self.roughness(near, meeting, &sides, &current, change);
                roughness.is_some_and(|it| it <= smooth)
            };
            if is_smooth(&tried) {
                (chosen, is_exchanged) = (tried, true);
            } else if !is_smooth(&chosen) {
                return None;
            }
        }
        // A block that is wrongly left in its mode makes a kink elsewhere.
        let sides = Sides::new(&current, &chosen, is_before);
        let is_whole = is_exchanged && self.is_smooth(near, meeting, &sides, smooth);
        is_whole.then(|| Sides::new(current.clone(), chosen.clone(), is_before))
    }

    /// Change point with the least width of all blocks whose modes meet there: some modes separate faster than others.
    pub fn narrowed(&self, near: &B::Frame, meeting: Meeting<B::Scalar>) -> Meeting<B::Scalar> {
        let mut narrowed = meeting;
        for block in 0..BLOCKS {
            let other = Crossing { block, ..*self };
            if let Some(width) = other.width(near, &meeting) {
                narrowed.width = narrowed.width.min(width);
            }
        }
        narrowed
    }

    /// Width of a change point by the modes of this block; `None` if they do not meet there.
    #[inline(never)]
    fn width(&self, near: &B::Frame, meeting: &Meeting<B::Scalar>) -> Option<B::Scalar> {
        let number = B::Scalar::from_f64;
        let [from, end] = self.way.ends;
        let mut width = meeting.width;
        let mut last = None;
        for _ in 0..=NEARER {
            let t = meeting.time - self.direction * width;
            let square = self.distance(self.block, t, near)?;
            if last.is_some_and(|last| square <= number(FALLEN) * last) {
                let whole = self.largest_distance(near, meeting.time, end - from)?;
                return Some(width * (edge(whole) / square).sqrt());
            }
            last = Some(square);
            width /= number(CLOSER);
        }
        None
    }

    /// Blocks with two modes as near to each other as those of the change point: a bit for each.
    fn blocks_that_meet(&self, near: &B::Frame, meeting: &Meeting<B::Scalar>) -> u64 {
        let t = meeting.time - self.direction * meeting.width;
        let limit = B::Scalar::from_f64(SIMULTANEOUS_FACTOR) * meeting.edge;
        let mut meets = 0;
        for block in 0..BLOCKS {
            let is_near = self.distance(block, t, near).is_some_and(|it| it <= limit);
            meets |= u64::from(is_near || block == self.block) << block;
        }
        meets
    }

    /// Modes on both sides of a change point on the smooth path through a frame near it, of which one side has the
    /// current modes; `None` if the path is undecided.
    pub fn sides_through(
        &self,
        frame: &B::Frame,
        meeting: &Meeting<B::Scalar>,
    ) -> Option<Sides<B::Branches>> {
        let path = |is_before| {
            let sides = self.sides(frame, meeting, is_before)?;
            let interpolated = self.interpolated(frame, meeting, &sides, B::time(frame))?;
            let missed = square_of_distance(self.way.blocks, [&interpolated, frame], 1);
            Some((sides, missed))
        };
        let part = B::Scalar::from_f64(SMOOTH * SMOOTH);
        match [path(true), path(false)] {
            [Some((sides, missed)), Some((_, other))] if missed <= part * other => Some(sides),
            [Some((_, other)), Some((sides, missed))] if missed <= part * other => Some(sides),
            // The other path is too rough to be interpolated.
            [Some((sides, missed)), None] | [None, Some((sides, missed))] => {
                (missed <= part * self.rates_apart(frame, meeting)?).then_some(sides)
            }
            _ => None,
        }
    }

    /// Square of the distance of the rates of both modes at the nearest time before a change point.
    fn rates_apart(&self, near: &B::Frame, meeting: &Meeting<B::Scalar>) -> Option<B::Scalar> {
        let current = &self.way.branches;
        let other = self.way.blocks.exchanged(current, self.block)?;
        let t = meeting.time - self.direction * meeting.width;
        let first = self.solved(t, near, current)?;
        let second = self.solved(t, near, &other)?;
        Some(square_of_distance(self.way.blocks, [&first, &second], 1))
    }

    /// Frame at a time (s) near a change point; `None` if the path is too rough to be interpolated.
    #[inline(never)]
    pub fn interpolated(
        &self,
        near: &B::Frame,
        meeting: &Meeting<B::Scalar>,
        sides: &Sides<B::Branches>,
        t: B::Scalar,
    ) -> Option<B::Frame> {
        let sides = Sides {
            before: &sides.before,
            beyond: &sides.beyond,
        };
        let change = [sides.beyond, sides.before];
        let roughness = self.roughness(near, meeting, &sides, sides.before, change)?;
        let exact = B::Scalar::from_f64(MAX_INTERPOLATED_DIFFERENCE);
        let is_exact = roughness <= exact && self.is_smooth(near, meeting, &sides, exact);
        if !is_exact {
            return None;
        }
        let place = self.direction * (t - meeting.time) / meeting.width;
        let [_, mut found, _] = self.sums(near, meeting, &sides, Weights::at(place))?;
        B::set_time(&mut found, t);
        Some(found)
    }

    /// Highest differences of the path with these modes, in the values that the others do not change. They are relative
    /// to the distance of the current modes from changed ones, and along it.
    #[inline(never)]
    fn roughness(
        &self,
        near: &B::Frame,
        meeting: &Meeting<B::Scalar>,
        sides: &Sides<&B::Branches>,
        current: &B::Branches,
        [changed, others]: [&B::Branches; 2],
    ) -> Option<B::Scalar> {
        let [base, even, odd] = self.sums(near, meeting, sides, Weights::Differences)?;
        let t = B::time(&base);
        let current = self.solved(t, &base, current)?;
        let changed = self.solved(t, &base, changed)?;
        let others = self.solved(t, &base, others)?;
        let blocks = self.way.blocks;
        let apart = [&changed, &current];
        let along = |pair| sum_of_products(blocks, [pair, apart, [&others, &current]], 0);
        let roughness = along([&even, &base]).max(along([&odd, &base]));
        Some(roughness / along(apart))
    }

    /// True if the highest differences of the path with these modes are at most a part of its change before the change
    /// point, in all coordinates together.
    #[inline(never)]
    fn is_smooth(
        &self,
        near: &B::Frame,
        meeting: &Meeting<B::Scalar>,
        sides: &Sides<&B::Branches>,
        part: B::Scalar,
    ) -> bool {
        let Some([base, even, odd]) = self.sums(near, meeting, sides, Weights::Differences) else {
            return false;
        };
        let way = self.direction * meeting.width;
        let t = meeting.time - B::Scalar::from_f64(ODD.len() as f64) * way;
        let Some(first) = self.solved(t, &base, sides.before) else {
            return false;
        };
        let square = |frame| square_of_distance(self.way.blocks, [frame, &base], 0);
        square(&even).max(square(&odd)) <= part * part * square(&first)
    }

    /// Nearest frame before a change point, plus two weighted sums of the differences of all eight from it.
    #[inline(never)]
    fn sums(
        &self,
        near: &B::Frame,
        meeting: &Meeting<B::Scalar>,
        sides: &Sides<&B::Branches>,
        weights: Weights<B::Scalar>,
    ) -> Option<[B::Frame; 3]> {
        let way = self.direction * meeting.width;
        let base = self.solved(meeting.time - way, near, sides.before)?;
        let mut sums = [base.clone(), base.clone()];
        for (side, modes) in [
            (-B::Scalar::ONE, sides.before),
            (B::Scalar::ONE, sides.beyond),
        ] {
            let mut last = base.clone();
            let mut distance = B::Scalar::ZERO;
            for index in 0..ODD.len() {
                distance += B::Scalar::ONE;
                last = self.solved(meeting.time + side * distance * way, &last, modes)?;
                for (sum, weight) in sums.iter_mut().zip(weights.of(side, distance, index)) {
                    self.way.blocks.add(sum, weight, &last, &base);
                }
            }
        }
        let [first, second] = sums;
        Some([base, first, second])
    }
}
