//! Equations that are looked at together → their Jacobian, and which of its columns turn with their angle.
//!
//! A column turns where its unknown is an angle that only turns arms, and by itself: the second derivative of each of its entries is
//! minus the entry. Deliberately unknown here: what is made of that.

use std::collections::{BTreeMap, HashMap};

use super::chain::{self, Order};
use crate::expr::{ExprId, SymbolId};
use crate::program::builder::Builder;
use crate::system::SymbolRole;

/// A matrix, by the rows and columns of its entries that are not zero.
type Entries = Vec<([usize; 2], ExprId)>;

/// The columns of a Jacobian.
pub(super) struct Columns {
    pub jacobian: Entries,
    /// Whether each of them turns with its angle.
    pub turns: Vec<bool>,
    /// The derivatives of the entries of those that do.
    pub turning: Entries,
}

impl Columns {
    /// The order in which they are those of a chain, where they are.
    pub fn chain(&self) -> Option<Order> {
        // What turns is an angle, and does not vary beside.
        let all_turn = self.turns.iter().all(|turns| *turns);
        let places = self.jacobian.iter().map(|(place, _)| *place);
        chain::order(self.turns.len(), places).filter(|_| all_turn)
    }

    /// The same with its rows and columns in this order.
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
    /// The Jacobian of equations by the unknowns that have these columns.
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
            let rates = self.system.mechanism.graph.symbols(rate).iter();
            let own = rates.filter_map(|&symbol| match self.system.roles[symbol.index()] {
                SymbolRole::Rate(unknown) => Some((*columns.get(&unknown)?, symbol)),
                _ => None,
            });
            let own: BTreeMap<usize, SymbolId> = own.collect();
            for (column, own) in own {
                let entry = self.graph().derivative(rate, own);
                if entry == zero {
                    continue;
                }
                jacobian.push(([row, column], entry));
                match self.turned(entry, own) {
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

    /// The derivative of an entry that moves with the unknown of this rate alone, where the second one is minus the entry.
    fn turned(&mut self, entry: ExprId, own: SymbolId) -> Option<ExprId> {
        let first = self.derivative_by_one(entry, own)?;
        let second = self.derivative_by_one(first, own)?;
        (self.graph().negate(second) == entry).then_some(first)
    }

    /// The derivative of an expression that moves with the unknown of this rate alone.
    fn derivative_by_one(&mut self, expr: ExprId, own: SymbolId) -> Option<ExprId> {
        let rate = self.rate(expr);
        let zero = self.graph().zero();
        let others = self.graph().substitute(rate, &[(own, zero)]);
        (others == zero).then(|| self.graph().derivative(rate, own))
    }
}
