//! R(φ) p + c = 0 with a known c: a link between two pins whose places are known.
//!
//! The link points from one pin to the other, w = −c, and its angle is that of w. What the two equations say beside that is that the
//! pins are as far apart as the link is long: (w · w − p · p)/2 remains, in which the angle does not occur.

use crate::expr::ExprId;
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
        let p = self.link;
        let square = builder.dot(p, p);
        let square = builder.value("p^2", square);
        let (along, across) = (builder.dot(p, w), builder.cross(p, w));
        let [cosine, sine] = [along, across].map(|part| builder.graph().divide(part, square));
        let direction = builder.direction(self.angle, cosine, sine, "");
        builder.angle(self.angle, direction);
        Between {
            link: self.clone(),
            w,
            square,
            velocity: None,
            moved: Vec::new(),
        }
    }
}

/// A link whose pins are stated.
#[derive(Clone, Debug)]
pub(super) struct Between {
    link: TwoPins,
    w: Vector,
    square: ExprId,
    velocity: Option<Vector>,
    /// What the vector between the pins does at each level.
    moved: Vec<(Level, Vector)>,
}

impl Between {
    /// (w · w − p · p)/2.
    pub fn residual(&self, builder: &mut Builder<'_>) -> ExprId {
        let square = builder.dot(self.w, self.w);
        let twice = builder.graph().subtract(square, self.square);
        builder.half(twice)
    }

    /// The length of the link: the slope of the residual in the distance of the pins.
    pub fn length(&self, builder: &mut Builder<'_>) -> ExprId {
        let square = builder.dot(self.link.link, self.link.link);
        builder.graph().sqrt(square)
    }

    /// States what a level finds.
    pub fn rates(&mut self, level: Level, builder: &mut Builder<'_>) {
        let c = self.link.closure.map(|part| builder.rate_at(part, level));
        let moved = builder.negated(c);
        let moved = builder.vector("v", moved);
        self.moved.push((level, moved));
        if level == Level::Velocity {
            self.velocity = Some(moved);
        }
        let p = self.link.link;
        let stretch = p.map(|part| builder.rate_at(part, level));
        // w × ẇ = φ̇ p² + p × ṗ, and w × ẅ = φ̈ p² + 2 φ̇ p · ṗ + p × p̈.
        let (across, own) = (builder.cross(self.w, moved), builder.cross(p, stretch));
        let mut numerator = builder.graph().subtract(across, own);
        if level == Level::Acceleration {
            let rate = p.map(|part| builder.rate(part));
            let along = builder.dot(p, rate);
            let turning = builder.rate_of(self.link.angle);
            let product = builder.graph().multiply(turning, along);
            let twice = builder.graph().add(product, product);
            numerator = builder.graph().subtract(numerator, twice);
        }
        let value = builder.graph().divide(numerator, self.square);
        builder.find(self.link.angle, level, value);
    }

    /// The rate of the residual at a level, once what the level finds is stated.
    pub fn residual_rate(&self, level: Level, builder: &mut Builder<'_>) -> ExprId {
        let moved = self.moved.iter().rev().find(|(own, _)| *own == level);
        let moved = moved.map_or([builder.graph().zero(); 2], |(_, moved)| *moved);
        let p = self.link.link;
        let stretch = p.map(|part| builder.rate_at(part, level));
        let (between, own) = (builder.dot(self.w, moved), builder.dot(p, stretch));
        let mut rate = builder.graph().subtract(between, own);
        if let (Level::Acceleration, Some(velocity)) = (level, self.velocity) {
            let stretch = p.map(|part| builder.rate(part));
            let squares = [
                builder.dot(velocity, velocity),
                builder.dot(stretch, stretch),
            ];
            let difference = builder.graph().subtract(squares[0], squares[1]);
            rate = builder.graph().add(rate, difference);
        }
        rate
    }
}
