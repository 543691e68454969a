//! c cos φ + s sin φ + rest = 0: one angle.
//!
//! With ρ² = c² + s² and k = −rest, cos φ and sin φ follow from the root ±√((ρ − k)(ρ + k)), whose sign is the assembly mode and
//! which is minus the derivative of the equation in φ. Near the fold k = ±ρ the product keeps all digits of ρ − k, where an
//! arccosine would lose half of them.

use super::builder::{Builder, Direction};
use super::{Action, Level};
use crate::expr::ExprId;

/// What the rates need of the position.
#[derive(Clone, Copy, Debug)]
pub(super) struct Root {
    unknown: usize,
    root: ExprId,
    /// The equation in terms of arms.
    equation: ExprId,
}

impl Root {
    /// Minus the derivative of the equation.
    pub(super) fn determinant(&self) -> ExprId {
        self.root
    }
}

impl Builder<'_> {
    /// The position: `equation` is the same as c cos φ + s sin φ + rest, in arms.
    pub(super) fn one_angle(
        &mut self,
        unknown: usize,
        c: ExprId,
        s: ExprId,
        rest: ExprId,
        equation: ExprId,
    ) -> Root {
        let name = self.system.unknown_name(unknown).to_string();
        let [c, s] = [self.value("cosine_part", c), self.value("sine_part", s)];
        let target = self.graph().negate(rest);
        let target = self.value("target", target);
        let radius_square = {
            let graph = self.graph();
            let squares = [graph.multiply(c, c), graph.multiply(s, s)];
            graph.sum(&squares)
        };
        let radius_square = self.value("radius_square", radius_square);
        let radius = self.graph().sqrt(radius_square);
        let radius = self.value("radius", radius);
        let graph = self.graph();
        let [below, above] = [graph.subtract(radius, target), graph.add(radius, target)];
        let excess = graph.multiply(below, above);
        let excess = self.value("excess", excess);
        // The distance is |k|, as the root of its square.
        let graph = self.graph();
        let square = graph.multiply(target, target);
        let (distance, shortest) = (graph.sqrt(square), graph.zero());
        self.actions.push(Action::Reach {
            excess,
            scale: radius_square,
            distance,
            longest: radius,
            shortest,
        });
        let drawn = {
            let [c, s] = [c, s].map(|part| self.drawn_local(part));
            let symbol = self.system.vector_form.unknowns[unknown].position;
            let (sine, cosine) = self.drawn[symbol.index()].sin_cos();
            c * sine - s * cosine
        };
        let branch = self.branch(&name, format!("which of two values {name} takes"), drawn);
        let root = self.graph().sqrt(excess);
        let root = self.graph().multiply(branch, root);
        let root = self.value("root", root);
        let graph = self.graph();
        let [ck, cr] = [graph.multiply(c, target), graph.multiply(c, root)];
        let [sk, sr] = [graph.multiply(s, target), graph.multiply(s, root)];
        let (cosine, sine) = (graph.subtract(ck, sr), graph.add(sk, cr));
        let [cosine, sine] = [cosine, sine].map(|part| graph.divide(part, radius_square));
        let direction = Direction {
            cosine: self.value(&format!("cos_{name}"), cosine),
            sine: self.value(&format!("sin_{name}"), sine),
        };
        self.angle(unknown, direction);
        Root {
            unknown,
            root,
            equation,
        }
    }

    /// The rate, the acceleration or a response: the derivative of the equation in φ is minus the root.
    pub(super) fn one_angle_rates(&mut self, root: &Root, level: Level) {
        let drift = self.drift_at(root.equation, root.unknown, level);
        let value = self.graph().divide(drift, root.root);
        self.find(root.unknown, level, value);
    }
}
