//! Rotates a link along a known vector: its angle, and the rates of the angle.
//!
//! The angle rotates the link p in its body to the vector w between its pins. Equal lengths are not assumed: (w · w − p · p)/2 is
//! the residual unless other equations satisfy it.

use crate::expr::ExprId;
use crate::joint::geometry::Vector;
use crate::program::builder::Builder;
use crate::program::function::Level;

/// Link whose pins have been stated.
#[derive(Clone, Debug)]
pub(super) struct TurnedLink {
    angle: usize,
    link: Vector,
    w: Vector,
    square: ExprId,
    /// Value 1/(p · p).
    inverse: ExprId,
    velocity: Option<Vector>,
    /// Derivatives of the vector between the pins, by level.
    moved: Vec<(Level, Vector)>,
}

impl TurnedLink {
    /// States the angle and the rotated vectors of a link; `square` is p · p.
    pub fn new(
        angle: usize,
        [link, w]: [Vector; 2],
        square: ExprId,
        builder: &mut Builder<'_>,
    ) -> Self {
        let (along, across) = (builder.dot(link, w), builder.cross(link, w));
        let one = builder.graph().one();
        let inverse = builder.graph().divide(one, square);
        let inverse = builder.value("inverse", inverse);
        let [cosine, sine] = [along, across].map(|part| builder.graph().multiply(part, inverse));
        let direction = builder.direction(angle, cosine, sine, "");
        builder.angle(angle, direction);
        TurnedLink {
            angle,
            link,
            w,
            square,
            inverse,
            velocity: None,
            moved: Vec::new(),
        }
    }

    /// Returns the vector between the pins.
    pub fn vector(&self) -> Vector {
        self.w
    }

    /// Returns the derivative of this vector at a level that has been stated.
    pub fn moved(&self, level: Level, builder: &mut Builder<'_>) -> Vector {
        let moved = self.moved.iter().rev().find(|(own, _)| *own == level);
        moved.map_or([builder.graph().zero(); 2], |(_, moved)| *moved)
    }

    /// Returns (w · w − p · p)/2.
    pub fn residual(&self, builder: &mut Builder<'_>) -> ExprId {
        let square = builder.dot(self.w, self.w);
        let twice = builder.graph().subtract(square, self.square);
        builder.half(twice)
    }

    /// Returns the length of the link: the derivative of the residual in the distance of the pins.
    pub fn length(&self, builder: &mut Builder<'_>) -> ExprId {
        let square = builder.dot(self.link, self.link);
        builder.graph().sqrt(square)
    }

    /// States the rotation of the link for this derivative of its vector.
    pub fn turn(&mut self, level: Level, moved: Vector, builder: &mut Builder<'_>) {
        self.moved.push((level, moved));
        if level == Level::Velocity {
            self.velocity = Some(moved);
        }
        let p = self.link;
        let stretch = p.map(|part| builder.rate_at(part, level));
        // w × ẇ = φ̇ p² + p × ṗ, and w × ẅ = φ̈ p² + 2 φ̇ p · ṗ + p × p̈.
        let (across, own) = (builder.cross(self.w, moved), builder.cross(p, stretch));
        let mut numerator = builder.graph().subtract(across, own);
        if level == Level::Acceleration {
            let rate = p.map(|part| builder.rate(part));
            let along = builder.dot(p, rate);
            let turning = builder.rate_of(self.angle);
            let product = builder.graph().multiply(turning, along);
            let twice = builder.graph().add(product, product);
            numerator = builder.graph().subtract(numerator, twice);
        }
        let value = builder.graph().multiply(numerator, self.inverse);
        builder.find(self.angle, level, value);
    }

    /// Returns the rate of (p · p)/2 at a level.
    pub fn square_rate(&self, level: Level, builder: &mut Builder<'_>) -> ExprId {
        let p = self.link;
        let stretch = p.map(|part| builder.rate_at(part, level));
        let rate = builder.dot(p, stretch);
        if level != Level::Acceleration {
            return rate;
        }
        let stretch = p.map(|part| builder.rate(part));
        let square = builder.dot(stretch, stretch);
        builder.graph().add(rate, square)
    }

    /// Returns the rate of the residual at a level, after the level's results have been stated.
    pub fn residual_rate(&self, level: Level, builder: &mut Builder<'_>) -> ExprId {
        let moved = self.moved(level, builder);
        let mut between = builder.dot(self.w, moved);
        if let (Level::Acceleration, Some(velocity)) = (level, self.velocity) {
            let square = builder.dot(velocity, velocity);
            between = builder.graph().add(between, square);
        }
        let square_rate = self.square_rate(level, builder);
        builder.graph().subtract(between, square_rate)
    }
}
