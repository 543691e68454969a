//! Represents a step of a sequence whose position has been stated, with its rates and the link of its residual.

use super::three_circles::Circles;
use super::turned_link::TurnedLink;
use super::two_pins::Between;
use crate::program::builder::Builder;
use crate::program::forms::Solved;
use crate::program::function::Level;

/// Step whose position has been stated.
pub(super) enum Stated {
    Closed(Box<dyn Solved>),
    TwoPins(Between),
    ThreeCircles(Circles),
}

impl Stated {
    pub(super) fn rates(&mut self, level: Level, builder: &mut Builder<'_>) {
        match self {
            Stated::Closed(solved) => solved.rates(level, builder),
            Stated::TwoPins(between) => between.rates(level, builder),
            Stated::ThreeCircles(circles) => circles.rates(level, builder),
        }
    }

    /// Returns the link whose length gives a residual; `None` for closed forms.
    pub(super) fn link(&self) -> Option<&TurnedLink> {
        match self {
            Stated::Closed(_) => None,
            Stated::TwoPins(between) => Some(&between.link),
            Stated::ThreeCircles(circles) => circles.first(),
        }
    }
}
