//! Sets of lanes.

use core::ops::{BitAnd, BitOr, BitOrAssign, Not};

/// Set of lanes, of at most 32.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Mask<const N: usize>(u32);

impl<const N: usize> Mask<N> {
    /// No lane.
    pub const NONE: Self = Self(0);

    /// All lanes.
    pub const ALL: Self = Self(u32::MAX >> (32 - N));

    /// Returns the lanes for which a condition is true.
    #[inline(always)]
    pub fn of(mut condition: impl FnMut(usize) -> bool) -> Self {
        let mut lanes = 0;
        for lane in 0..N {
            lanes |= u32::from(condition(lane)) << lane;
        }
        Self(lanes)
    }

    /// True if the lane is in the set.
    #[inline(always)]
    pub fn has(self, lane: usize) -> bool {
        lane < N && self.0 >> lane & 1 != 0
    }

    /// True if no lane is in the set.
    #[inline(always)]
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Returns the lanes of the set in order.
    pub fn lanes(self) -> impl Iterator<Item = usize> {
        (0..N).filter(move |&lane| self.has(lane))
    }

    /// Returns the set of one lane.
    #[inline(always)]
    pub fn one(lane: usize) -> Self {
        Self::of(|it| it == lane)
    }
}

impl<const N: usize> BitOr for Mask<N> {
    type Output = Self;

    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl<const N: usize> BitOrAssign for Mask<N> {
    #[inline(always)]
    fn bitor_assign(&mut self, other: Self) {
        self.0 |= other.0;
    }
}

impl<const N: usize> BitAnd for Mask<N> {
    type Output = Self;

    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
}

impl<const N: usize> Not for Mask<N> {
    type Output = Self;

    #[inline(always)]
    fn not(self) -> Self {
        Self(!self.0 & Self::ALL.0)
    }
}
