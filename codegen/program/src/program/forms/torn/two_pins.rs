//! Solves R(φ) p + c = 0 with a known c: a link between two known pins.
//!
//! The link points from one pin to the other, w = −c, and its angle is that of w. Both equations also say that the distance of
//! the pins equals the length of the link: (w · w − p · p)/2 remains, which does not contain the angle.

use super::turned_link::TurnedLink;
use crate::joint::Quantity;
use crate::joint::geometry::Vector;
use crate::program::builder::Builder;
use crate::program::forms::Candidate;
use crate::program::function::Level;

/// Equation R(φ) p + c = 0.
#[derive(Clone, Debug)]
pub(in crate::program::forms) struct TwoPins {
    /// Angle φ.
    pub angle: usize,
    /// Vector p, constant in its body.
    pub link: Vector,
    /// Vector c, the known vector that closes the loop.
    pub closure: Vector,
}

impl TwoPins {
    /// Returns the link of two equations of a subsystem in one of its unknowns; `None` if there is none.
    pub fn of(
        equations: [usize; 2],
        angle: usize,
        candidate: &mut Candidate<'_>,
    ) -> Option<TwoPins> {
        let form = candidate.form;
        let pool = &mut *candidate.pool;
        if form.unknowns[angle].quantity != Quantity::Angle {
            return None;
        }
        let pair = equations.map(|it| candidate.equations[it]);
        let (link, closure) = pool.turned_vector(pair, angle)?;
        let mut parts = [link, closure].into_iter().flatten();
        let is_known = parts.all(|part| !pool.mentions(part, angle));
        let zero = pool.graph.zero();
        (is_known && link != [zero, zero]).then_some(TwoPins {
            angle,
            link,
            closure,
        })
    }

    /// States the vector between the pins, and the angle and rotated vectors of the link.
    pub(super) fn position(&self, builder: &mut Builder<'_>) -> Between {
        let minus = builder.negated(self.closure);
        let w = builder.vector("w", minus);
        let square = builder.dot(self.link, self.link);
        let square = builder.value("p^2", square);
        Between {
            closure: self.closure,
            link: TurnedLink::new(self.angle, [self.link, w], square, builder),
        }
    }
}

/// Link between two pins whose position has been stated.
#[derive(Clone, Debug)]
pub(super) struct Between {
    closure: Vector,
    pub link: TurnedLink,
}

impl Between {
    /// States the results of a level.
    pub fn rates(&mut self, level: Level, builder: &mut Builder<'_>) {
        let c = self.closure.map(|part| builder.rate_at(part, level));
        let moved = builder.negated(c);
        let moved = builder.vector("v", moved);
        self.link.turn(level, moved, builder);
    }
}
