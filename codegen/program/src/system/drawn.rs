//! Evaluates expressions of the vector form in the design configuration.
//!
//! The design configuration gives every body's pose, and so a value to every unknown and every rotated vector, whatever the
//! drivers require at any time. Parameters and inputs have their defaults, and t is zero; neither affects the design
//! configuration.

use linkwright_math::double;

use super::System;
use crate::expr::{ExprId, SymbolId, evaluate_by};
use crate::joint::geometry::{Mark, Vector};
use crate::pool::{Pool, SymbolRole};

impl System {
    /// Returns the design value of an expression of unknowns and rotated vectors.
    pub fn drawn_value(&self, expr: ExprId, pool: &Pool) -> f64 {
        let graph = &pool.graph;
        // Most expressions are constant.
        if let Some(value) = graph.constant_value(expr) {
            return value;
        }
        evaluate_by(graph, expr, |symbol| self.drawn_symbol(symbol, pool))
    }

    /// Returns R(φ) v with the design value of φ.
    pub fn drawn_turn(&self, angle: usize, v: Vector, pool: &Pool) -> [f64; 2] {
        let (sine, cosine) = double::sin_cos(self.drawn_unknown(angle, pool));
        let [x, y] = v.map(|part| self.drawn_value(part, pool));
        [cosine * x - sine * y, sine * x + cosine * y]
    }

    /// Returns the design value of an unknown.
    pub fn drawn_unknown(&self, unknown: usize, pool: &Pool) -> f64 {
        let estimate = self.vector_form.unknowns[unknown].estimate;
        pool.graph.constant_value(estimate).unwrap_or(0.0)
    }

    /// Returns the design position of a mark.
    pub fn drawn_position(&self, mark: Mark, pool: &mut Pool) -> [f64; 2] {
        let drawn = self.mechanism.bodies[mark.frame.body.0].drawn;
        let graph = &mut pool.graph;
        let position = Mark::new(drawn, mark.local, graph).position(graph);
        position.map(|part| self.drawn_value(part, pool))
    }

    /// Returns the design value of a symbol; 0 if the design configuration does not determine the symbol.
    pub fn drawn_symbol(&self, symbol: SymbolId, pool: &Pool) -> f64 {
        let graph = &pool.graph;
        match pool.role(symbol) {
            SymbolRole::Position(unknown) => self.drawn_unknown(unknown, pool),
            SymbolRole::Arm(place) => {
                let arm = &pool.arms()[place];
                let turned = self.drawn_turn(arm.angle, arm.local, pool);
                turned[usize::from(symbol != arm.symbols[0])]
            }
            SymbolRole::Parameter(_) => graph.nominal(symbol).unwrap_or(0.0),
            SymbolRole::Input { input, level: 0 } => {
                let initial = self.mechanism.inputs[input].initial;
                graph.constant_value(initial).unwrap_or(0.0)
            }
            _ => 0.0,
        }
    }
}
