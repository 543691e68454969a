//! An expression of the vector form → its value in the drawing.
//!
//! The drawing says where every body is, so it gives every unknown and every arm a value, whatever the drivers ask for at any time.
//! What is supplied at run time has its default, and t is zero: neither says anything about the drawing.

use linkwright_math::double;

use super::{SymbolRole, System};
use crate::expr::{ExprId, SymbolId, evaluate_by};
use crate::joint::geometry::{Mark, Vector};

impl System {
    /// The value of an expression of unknowns and arms in the drawing.
    pub fn drawn_value(&self, expr: ExprId) -> f64 {
        let graph = &self.mechanism.graph;
        // Most do not move.
        if let Some(value) = graph.constant_value(expr) {
            return value;
        }
        evaluate_by(graph, expr, |symbol| self.drawn_symbol(symbol))
    }

    /// R(φ) v with the drawing's angle φ.
    pub fn drawn_turn(&self, angle: usize, v: Vector) -> [f64; 2] {
        let (sine, cosine) = double::sin_cos(self.drawn_unknown(angle));
        let [x, y] = v.map(|part| self.drawn_value(part));
        [cosine * x - sine * y, sine * x + cosine * y]
    }

    /// The value of an unknown in the drawing.
    pub fn drawn_unknown(&self, unknown: usize) -> f64 {
        let estimate = self.vector_form.unknowns[unknown].estimate;
        self.mechanism.graph.constant_value(estimate).unwrap_or(0.0)
    }

    /// Where a mark is in the drawing.
    pub fn drawn_position(&mut self, mark: Mark) -> [f64; 2] {
        let drawn = self.mechanism.bodies[mark.frame.body.0].drawn;
        let graph = &mut self.mechanism.graph;
        let position = Mark::new(drawn, mark.local, graph).position(graph);
        position.map(|part| self.drawn_value(part))
    }

    /// The value of a symbol in the drawing; 0 of what the drawing does not show.
    pub fn drawn_symbol(&self, symbol: SymbolId) -> f64 {
        let graph = &self.mechanism.graph;
        match self.roles.get(symbol.index()) {
            Some(SymbolRole::Position(unknown)) => self.drawn_unknown(*unknown),
            Some(SymbolRole::Arm(place)) => {
                let arm = &self.vector_form.arms[*place];
                let turned = self.drawn_turn(arm.angle, arm.local);
                turned[usize::from(symbol != arm.symbols[0])]
            }
            Some(SymbolRole::Parameter(_)) => graph.nominal(symbol).unwrap_or(0.0),
            Some(SymbolRole::Input { input, level: 0 }) => {
                let initial = self.mechanism.inputs[*input].initial;
                graph.constant_value(initial).unwrap_or(0.0)
            }
            _ => 0.0,
        }
    }
}
