//! Differentiates unknowns and expressions for a level: rates, accelerations, responses.

use super::Builder;
use crate::expr::{ExprId, SymbolId};
use crate::program::function::Level;

impl Builder<'_> {
    /// Returns d/dt of an expression.
    pub fn rate(&mut self, expr: ExprId) -> ExprId {
        self.pool.rate(expr)
    }

    /// Returns the first or the second rate of an expression, its derivative along a direction, or the rate of that derivative.
    pub fn rate_at(&mut self, expr: ExprId, level: Level) -> ExprId {
        match level {
            Level::Position => expr,
            Level::Velocity => self.rate(expr),
            Level::Acceleration => {
                let first = self.rate(expr);
                self.rate(first)
            }
            Level::Response(direction) => self.along(expr, direction),
            Level::ResponseRate(direction) => {
                let response = self.along(expr, direction);
                self.rate(response)
            }
            // Forces need no derivatives.
            Level::Forces => expr,
        }
    }

    /// Returns that derivative with the level's derivatives of these unknowns set to zero.
    pub fn drift_at(&mut self, expr: ExprId, unknowns: &[usize], level: Level) -> ExprId {
        let whole = self.rate_at(expr, level);
        let derivative = |unknown: &usize| {
            let unknown = &self.system.vector_form.unknowns[*unknown];
            match level {
                Level::Velocity => Some(unknown.rate),
                Level::Acceleration => Some(unknown.acceleration),
                // Unsolved unknowns count as constant.
                _ => None,
            }
        };
        let symbols: Vec<SymbolId> = unknowns.iter().filter_map(derivative).collect();
        self.without(whole, &symbols)
    }

    /// Assigns the level's derivative of an unknown.
    pub fn find(&mut self, unknown: usize, level: Level, value: ExprId) {
        let described = &self.system.vector_form.unknowns[unknown];
        let target = match level {
            Level::Position => described.position,
            Level::Velocity => described.rate,
            Level::Acceleration => described.acceleration,
            Level::Response(direction) => return self.respond(unknown, direction, value),
            Level::ResponseRate(direction) => return self.respond_rate(unknown, direction, value),
            // Unknowns have no forces.
            Level::Forces => return,
        };
        self.assign(target, value);
    }

    /// Returns an expression with some symbols set to zero.
    pub fn without(&mut self, expr: ExprId, symbols: &[SymbolId]) -> ExprId {
        let zero = self.pool.graph.zero();
        let replacements: Vec<_> = symbols.iter().map(|&symbol| (symbol, zero)).collect();
        self.graph().substitute(expr, &replacements)
    }

    /// Returns an unknown as an expression.
    pub fn position(&mut self, unknown: usize) -> ExprId {
        let symbol = self.system.vector_form.unknowns[unknown].position;
        self.graph().variable(symbol)
    }

    /// Returns the rate of an unknown as an expression.
    pub fn rate_of(&mut self, unknown: usize) -> ExprId {
        let symbol = self.system.vector_form.unknowns[unknown].rate;
        self.graph().variable(symbol)
    }
}
