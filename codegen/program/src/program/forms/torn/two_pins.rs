//! R(φ) p + c = 0 with a known c: a link between two pins whose places are known.
//!
//! The link points from one pin to the other, w = −c, and its angle is that of w. What the two equations say beside that is that the
//! pins are as far apart as the link is long: (w · w − p · p)/2 remains, in which the angle does not occur.

use super::turned_link::TurnedLink;
use crate::joint::Quantity;
use crate::joint::geometry::Vector;
use crate::program::builder::Builder;
use crate::program::forms::Candidate;
use crate::program::function::Level;

/// R(φ) p + c = 0.
#[derive(Clone, Debug)]
pub(in crate::program::forms) struct TwoPins {
    /// φ.
    pub angle: usize,
    /// p, constant in its body.
    pub link: Vector,
    /// c, the known vector that closes the loop.
    pub closure: Vector,
}

impl TwoPins {
    /// The link of two equations of a part in one of its unknowns.
    pub fn of(
        equations: [usize; 2],
        angle: usize,
        candidate: &mut Candidate<'_>,
    ) -> Option<TwoPins> {
        let Candidate { form, graph, .. } = candidate;
        if form.unknowns[angle].quantity != Quantity::Angle {
            return None;
        }
        let pair = equations.map(|it| candidate.equations[it]);
        let (link, closure) = form.turned_vector(pair, angle, graph)?;
        let mut parts = [link, closure].into_iter().flatten();
        let is_known = parts.all(|part| !form.mentions(part, angle, graph));
        let zero = graph.zero();
        (is_known && link != [zero, zero]).then_some(TwoPins {
            angle,
            link,
            closure,
        })
    }

    /// States the vector between the pins, and the angle and arms of the link.
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

/// A link between two pins whose position is stated.
#[derive(Clone, Debug)]
pub(super) struct Between {
    closure: Vector,
    pub link: TurnedLink,
}

impl Between {
    /// States what a level finds.
    pub fn rates(&mut self, level: Level, builder: &mut Builder<'_>) {
        let c = self.closure.map(|part| builder.rate_at(part, level));
        let moved = builder.negated(c);
        let moved = builder.vector("v", moved);
        self.link.turn(level, moved, builder);
    }
}
