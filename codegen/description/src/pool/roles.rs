//! Gives symbols their roles, and unknowns their symbols.
//!
//! A symbol without a role is an intermediate value.

use super::Pool;
use crate::expr::SymbolId;

/// Role of a symbol.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SymbolRole {
    /// Coordinate q_k; the auxiliary unknowns of the vector form are numbered after the coordinates.
    Position(usize),
    /// Rate q̇_k.
    Rate(usize),
    /// Acceleration q̈_k.
    Acceleration(usize),
    /// Component of a rotated local vector of the vector form.
    Arm(usize),
    /// Intermediate value.
    Intermediate,
    /// Value of a symbol in the last frame.
    Last(SymbolId),
    /// Time t.
    Time,
    /// Parameter of the mechanism.
    Parameter(usize),
    /// Input of the mechanism.
    Input {
        /// Index into the mechanism's inputs.
        input: usize,
        /// 0 for the value, 1 for the rate, 2 for the acceleration.
        level: usize,
    },
}

impl Pool {
    /// Returns the role of a symbol.
    pub fn role(&self, symbol: SymbolId) -> SymbolRole {
        let role = self.roles.get(symbol.index());
        role.copied().unwrap_or(SymbolRole::Intermediate)
    }

    /// Records the role of a symbol.
    pub fn set_role(&mut self, symbol: SymbolId, role: SymbolRole) {
        if self.roles.len() <= symbol.index() {
            self.roles
                .resize(symbol.index() + 1, SymbolRole::Intermediate);
        }
        self.roles[symbol.index()] = role;
    }

    /// Adds an unknown by its symbols: itself, its rate and its acceleration.
    pub fn add_unknown(&mut self, symbols: [SymbolId; 3]) {
        let place = self.unknowns.len();
        let [position, rate, acceleration] = symbols;
        self.set_role(position, SymbolRole::Position(place));
        self.set_role(rate, SymbolRole::Rate(place));
        self.set_role(acceleration, SymbolRole::Acceleration(place));
        self.unknowns.push(symbols);
    }

    /// Returns the symbol of an unknown.
    pub fn position(&self, unknown: usize) -> SymbolId {
        self.unknowns[unknown][0]
    }

    /// Returns the index of the unknown that a symbol is; `None` if the symbol is not an unknown.
    pub fn place_of_unknown(&self, symbol: SymbolId) -> Option<usize> {
        match self.role(symbol) {
            SymbolRole::Position(place) => Some(place),
            _ => None,
        }
    }

    /// Returns the index of the arm that has a symbol as component; `None` if there is none.
    pub fn place_of_symbol(&self, symbol: SymbolId) -> Option<usize> {
        match self.role(symbol) {
            SymbolRole::Arm(place) => Some(place),
            _ => None,
        }
    }
}
