//! Orders the terms of sums and the factors of products as they are printed.
//!
//! The arena sorts operands by id, so that equal expressions are one node. Printed formulas have the coordinates of a joint's
//! first body first, then those of the second, then constants and functions of time.

use super::{Described, System};
use crate::expr::{ExprId, Factor, Graph, Node, SymbolId, Term};
use crate::pool::{Pool, SymbolRole};

/// Written order of one formula.
#[derive(Clone, Copy, Debug)]
pub struct WrittenOrder<'a> {
    pool: &'a Pool,
    system: &'a System,
    /// Bodies in the order in which the formula should mention them.
    bodies: &'a [usize],
}

/// Key of the sort: class, then first symbol, then order of the arena.
type Key = (u8, usize, ExprId);

impl<'a> WrittenOrder<'a> {
    /// Returns the written order of a joint between these bodies.
    pub fn new(pool: &'a Pool, system: &'a System, bodies: &'a [usize]) -> WrittenOrder<'a> {
        WrittenOrder {
            pool,
            system,
            bodies,
        }
    }

    fn graph(&self) -> &'a Graph {
        &self.pool.graph
    }

    /// Returns the rank of a symbol, smaller for symbols that are written earlier; `None` for parameters, which are written as
    /// constants.
    fn rank(&self, symbol: SymbolId) -> Option<usize> {
        let (unknown, level) = match self.pool.role(symbol) {
            SymbolRole::Position(unknown) => (unknown, 0),
            SymbolRole::Rate(unknown) => (unknown, 1),
            SymbolRole::Acceleration(unknown) => (unknown, 2),
            // A rotated vector has the rank of its angle.
            SymbolRole::Arm(arm) => (self.pool.arms()[arm].angle, 0),
            SymbolRole::Intermediate | SymbolRole::Last(_) => {
                return Some(usize::MAX - self.graph().symbol_count() + symbol.index());
            }
            SymbolRole::Time => return Some(usize::MAX),
            SymbolRole::Input { input, level } => {
                let inputs = self.system.mechanism.inputs.len();
                return Some(usize::MAX - 3 * inputs + 3 * input + level);
            }
            SymbolRole::Parameter(_) => return None,
        };
        let after_all_poses =
            9 * (self.bodies.len() + self.system.mechanism.bodies.len()) + 3 * unknown + level;
        let unknown = &self.system.vector_form.unknowns[unknown];
        let Described::Pose { body, axis } = unknown.describes else {
            return Some(after_all_poses);
        };
        let place = self.bodies.iter().position(|&named| named == body);
        let place = place.unwrap_or(self.bodies.len() + body);
        Some((3 * place + axis) * 3 + level)
    }

    fn first_symbol(&self, expr: ExprId) -> Option<usize> {
        let symbols = self.graph().symbols(expr);
        symbols.iter().filter_map(|&symbol| self.rank(symbol)).min()
    }

    /// Returns the rank of a constant expression: numbers first, then parameters as they are declared.
    fn fixed_rank(&self, expr: ExprId) -> usize {
        let parameters = self.graph().symbols(expr).iter();
        let place = |symbol: &SymbolId| match self.pool.role(*symbol) {
            SymbolRole::Parameter(parameter) => Some(1 + parameter),
            _ => None,
        };
        parameters.filter_map(place).min().unwrap_or(0)
    }

    fn term_key(&self, expr: ExprId) -> Key {
        match self.first_symbol(expr) {
            Some(usize::MAX) => (2, 0, expr),
            Some(rank) => (0, rank, expr),
            None => (1, self.fixed_rank(expr), expr),
        }
    }

    fn factor_key(&self, expr: ExprId) -> Key {
        // Constants and parameters come first, then short factors, then sums in parentheses.
        match self.first_symbol(expr) {
            None => (0, self.fixed_rank(expr), expr),
            Some(rank) => match self.graph().node(expr) {
                Node::Sum(terms) if terms.len() > 1 => (2, rank, expr),
                _ => (1, rank, expr),
            },
        }
    }

    /// Returns the terms in written order, without a leading minus if possible.
    pub fn terms(&self, terms: &[Term]) -> Vec<Term> {
        let mut sorted = terms.to_vec();
        sorted.sort_by_cached_key(|term| self.term_key(term.expr));
        if let Some(first) = sorted
            .iter()
            .position(|term| !term.coefficient.is_negative())
        {
            sorted[..=first].rotate_right(1);
        }
        sorted
    }

    /// Returns the factors in written order.
    pub fn factors(&self, factors: &[Factor]) -> Vec<Factor> {
        let mut sorted = factors.to_vec();
        sorted.sort_by_cached_key(|factor| self.factor_key(factor.base));
        sorted
    }
}
