//! A link that points along a known vector: its angle, and how fast that turns.
//!
//! With the link p in its body and the vector w between its pins, the angle turns p to w. That both are equally long is not assumed:
//! (w · w − p · p)/2 is what remains where nothing else makes them so.

use crate::expr::ExprId;
use crate::joint::geometry::Vector;
use crate::program::builder::Builder;
use crate::program::function::Level;

/// A link whose pins are stated.
#[derive(Clone, Debug)]
pub(super) struct TurnedLink {
    angle: usize,
    link: Vector,
    w: Vector,
    square: ExprId,
    /// 1/(p · p).
    inverse: ExprId,
    velocity: Option<Vector>,
    /// What the vector between the pins does at each level.
    moved: Vec<(Level, Vector)>,
}

impl TurnedLink {
    /// States the angle and the arms of a link; `square` is p · p.
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

    /// The vector between the pins.
    pub fn vector(&self) -> Vector {
        self.w
    }

    /// What it does at a level that is stated.
    pub fn moved(&self, level: Level, builder: &mut Builder<'_>) -> Vector {
        let moved = self.moved.iter().rev().find(|(own, _)| *own == level);
        moved.map_or([builder.graph().zero(); 2], |(_, moved)| *moved)
    }

    /// (w · w − p · p)/2.
    pub fn residual(&self, builder: &mut Builder<'_>) -> ExprId {
        let square = builder.dot(self.w, self.w);
        let twice = builder.graph().subtract(square, self.square);
        builder.half(twice)
    }

    /// The length of the link: the slope of the residual in the distance of the pins.
    pub fn length(&self, builder: &mut Builder<'_>) -> ExprId {
        let square = builder.dot(self.link, self.link);
        builder.graph().sqrt(square)
    }

    /// States how the link turns, whose vector does this.
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

    /// The rate of (p · p)/2 at a level.
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

    /// The rate of the residual at a level, once what the level finds is stated.
    pub fn residual_rate(&self, level: Level, builder: &mut Builder<'_>) -> ExprId {
        let moved = self.moved(level, builder);
        let mut between = builder.dot(self.w, moved);
        if let (Level::Acceleration, Some(velocity)) = (level, self.velocity) {
            let square = builder.dot(velocity, velocity);
            between = builder.graph().add(between, square);
        }
        let own = self.square_rate(level, builder);
        builder.graph().subtract(between, own)
    }
}
