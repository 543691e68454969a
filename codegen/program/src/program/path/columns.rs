//! Assembles the Jacobian of loop equations, and finds the columns that rotate with their angle.
//!
//! A column rotates if its unknown is an angle that occurs only in rotated vectors. The second derivative of each of its entries
//! then is minus the entry.

use std::collections::{BTreeMap, HashMap};

use super::chain::{self, Order};
use crate::expr::{ExprId, SymbolId};
use crate::pool::SymbolRole;
use crate::program::builder::Builder;

/// Nonzero entries of a matrix, with their rows and columns.
type Entries = Vec<([usize; 2], ExprId)>;

/// Jacobian by columns.
pub(super) struct Columns {
    pub jacobian: Entries,
    /// True for each column that rotates with its angle.
    pub turns: Vec<bool>,
    /// Derivatives of the entries of rotating columns.
    pub turning: Entries,
}

impl Columns {
    /// Returns the order in which the columns form a chain; `None` if they do not.
    pub fn chain(&self) -> Option<Order> {
        // Rotating columns are angles without other variation.
        let all_turn = self.turns.iter().all(|turns| *turns);
        let places = self.jacobian.iter().map(|(place, _)| *place);
        chain::order(self.turns.len(), places).filter(|_| all_turn)
    }

    /// Returns the Jacobian with its rows and columns in this order.
    pub fn in_order(self, order: &Order) -> Columns {
        let places = |order: &[usize]| {
            let mut places = vec![0; order.len()];
            for (place, &was) in order.iter().enumerate() {
                places[was] = place;
            }
            places
        };
        let [rows, columns] = [&order.rows, &order.columns].map(|it| places(it));
        let moved = |entries: Entries| {
            let entries = entries.into_iter();
            let mut entries: Entries = entries
                .map(|([row, column], entry)| ([rows[row], columns[column]], entry))
                .collect();
            entries.sort_by_key(|(place, _)| *place);
            entries
        };
        Columns {
            jacobian: moved(self.jacobian),
            turns: order.columns.iter().map(|&it| self.turns[it]).collect(),
            turning: moved(self.turning),
        }
    }
}

impl Builder<'_> {
    /// Returns the Jacobian of equations in the unknowns of these columns.
    pub(super) fn columns(
        &mut self,
        residuals: &[ExprId],
        columns: &HashMap<usize, usize>,
    ) -> Columns {
        let zero = self.graph().zero();
        let mut jacobian = Vec::new();
        let mut turns = vec![true; columns.len()];
        let mut turning = Vec::new();
        for (row, &residual) in residuals.iter().enumerate() {
            let rate = self.rate(residual);
            let rates = self.pool.graph.symbols(rate).iter();
            let moving = rates.filter_map(|&symbol| match self.pool.role(symbol) {
                SymbolRole::Rate(unknown) => Some((*columns.get(&unknown)?, symbol)),
                _ => None,
            });
            let moving: BTreeMap<usize, SymbolId> = moving.collect();
            for (column, moving) in moving {
                let entry = self.graph().derivative(rate, moving);
                if entry == zero {
                    continue;
                }
                jacobian.push(([row, column], entry));
                match self.turned(entry, moving) {
                    Some(turned) => turning.push(([row, column], turned)),
                    None => turns[column] = false,
                }
            }
        }
        turning.retain(|([_, column], _)| turns[*column]);
        Columns {
            jacobian,
            turns,
            turning,
        }
    }

    /// Returns the derivative of an entry that moves only with the unknown of this rate; `None` if the second derivative is not
    /// minus the entry.
    fn turned(&mut self, entry: ExprId, rate_symbol: SymbolId) -> Option<ExprId> {
        let first = self.derivative_by_one(entry, rate_symbol)?;
        let second = self.derivative_by_one(first, rate_symbol)?;
        (self.graph().negate(second) == entry).then_some(first)
    }

    /// Returns the derivative of an expression that moves only with the unknown of this rate; otherwise `None`.
    fn derivative_by_one(&mut self, expr: ExprId, rate_symbol: SymbolId) -> Option<ExprId> {
        let rate = self.rate(expr);
        let zero = self.graph().zero();
        let others = self.graph().substitute(rate, &[(rate_symbol, zero)]);
        (others == zero).then(|| self.graph().derivative(rate, rate_symbol))
    }
}
