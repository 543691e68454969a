//! Unknowns and expressions → what a level finds of them: rates, accelerations, responses.

use super::Builder;
use crate::expr::{ExprId, SymbolId};
use crate::program::function::Level;

impl Builder<'_> {
    /// d/dt of an expression.
    pub fn rate(&mut self, expr: ExprId) -> ExprId {
        self.system
            .vector_form
            .rate(expr, &mut self.system.mechanism.graph)
    }

    /// The first or the second rate of an expression, or its derivative along a direction, or the rate of that.
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
            // Nothing is differentiated for a force.
            Level::Forces => expr,
        }
    }

    /// The same with what the level finds of these unknowns taken as zero.
    pub fn drift_at(&mut self, expr: ExprId, unknowns: &[usize], level: Level) -> ExprId {
        let whole = self.rate_at(expr, level);
        let own = |unknown: &usize| {
            let unknown = &self.system.vector_form.unknowns[*unknown];
            match level {
                Level::Velocity => Some(unknown.rate),
                Level::Acceleration => Some(unknown.acceleration),
                // What has not been found is held.
                _ => None,
            }
        };
        let symbols: Vec<SymbolId> = unknowns.iter().filter_map(own).collect();
        self.without(whole, &symbols)
    }

    /// States what a level finds for an unknown.
    pub fn find(&mut self, unknown: usize, level: Level, value: ExprId) {
        let own = &self.system.vector_form.unknowns[unknown];
        let target = match level {
            Level::Position => own.position,
            Level::Velocity => own.rate,
            Level::Acceleration => own.acceleration,
            Level::Response(direction) => return self.respond(unknown, direction, value),
            Level::ResponseRate(direction) => return self.respond_rate(unknown, direction, value),
            // An unknown has no force of its own.
            Level::Forces => return,
        };
        self.assign(target, value);
    }

    /// An expression with some symbols set to zero.
    pub fn without(&mut self, expr: ExprId, symbols: &[SymbolId]) -> ExprId {
        let zero = self.system.mechanism.graph.zero();
        let replacements: Vec<_> = symbols.iter().map(|&symbol| (symbol, zero)).collect();
        self.graph().substitute(expr, &replacements)
    }

    /// An unknown as an expression.
    pub fn position(&mut self, unknown: usize) -> ExprId {
        let symbol = self.system.vector_form.unknowns[unknown].position;
        self.graph().variable(symbol)
    }

    /// The rate of an unknown as an expression.
    pub fn rate_of(&mut self, unknown: usize) -> ExprId {
        let symbol = self.system.vector_form.unknowns[unknown].rate;
        self.graph().variable(symbol)
    }
}
