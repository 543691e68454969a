//! Builds vectors and their products as expressions.

use super::{Builder, Direction};
use crate::expr::{ExprId, Number, Rational};
use crate::joint::geometry::{Vector, dot, turned};

impl Builder<'_> {
    /// Returns a · b.
    pub fn dot(&mut self, a: Vector, b: Vector) -> ExprId {
        dot(a, b, self.graph())
    }

    /// Returns a_x b_y − a_y b_x.
    pub fn cross(&mut self, a: Vector, b: Vector) -> ExprId {
        let graph = self.graph();
        let [forward, backward] = [graph.multiply(a[0], b[1]), graph.multiply(a[1], b[0])];
        graph.subtract(forward, backward)
    }

    /// Returns a v + b w.
    pub fn combined(&mut self, a: ExprId, v: Vector, b: ExprId, w: Vector) -> Vector {
        [0, 1].map(|axis| {
            let graph = self.graph();
            let [first, second] = [graph.multiply(a, v[axis]), graph.multiply(b, w[axis])];
            graph.add(first, second)
        })
    }

    /// Returns half of a value.
    pub fn half(&mut self, value: ExprId) -> ExprId {
        self.graph().scale(Number::rational(Rational::HALF), value)
    }

    /// Returns −v.
    pub fn negated(&mut self, vector: Vector) -> Vector {
        vector.map(|component| self.graph().negate(component))
    }

    /// Returns Ω v: a vector rotated by a quarter turn counterclockwise.
    pub fn across(&mut self, v: Vector) -> Vector {
        [self.graph().negate(v[1]), v[0]]
    }

    /// Returns R(φ) v.
    pub fn turn(&mut self, direction: Direction, v: Vector) -> Vector {
        turned(direction.cosine, direction.sine, v, self.graph())
    }
}
