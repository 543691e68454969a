//! Holds the context of the formula being resolved, and the symbols that formulas mention.
//!
//! A choice, a curve or an equation around a formula changes the meaning of its names.

use std::collections::HashSet;

use super::curve;
use super::kinematic::KinematicTerms;
use crate::expr::{ExprId, SymbolId};
use crate::units::{OutputUnits, Tally};

/// Context of formulas.
pub(super) struct Formulas {
    pub time: SymbolId,
    /// Conditions of the enclosing choices; true if the formula applies where the condition is negative.
    pub choices: Vec<(ExprId, bool)>,
    /// Parameter of the curve being resolved; `None` outside curves.
    pub parameter: Option<curve::Parameter>,
    /// Terms of the equation or load being resolved; `None` elsewhere, where only t moves.
    pub kinematic: Option<KinematicTerms>,
    /// Symbols mentioned by the name of a constant, a parameter or an input; never iterated.
    pub mentioned: HashSet<SymbolId>,
    /// Units of the numbers read so far.
    pub written_units: Tally,
    /// Units of output requested by the description or its reader; `None` without a request.
    pub requested_units: Option<OutputUnits>,
}

impl Formulas {
    /// Creates the context before any formula.
    pub fn new(time: SymbolId) -> Formulas {
        Formulas {
            time,
            choices: Vec::new(),
            parameter: None,
            kinematic: None,
            mentioned: HashSet::new(),
            written_units: Tally::default(),
            requested_units: None,
        }
    }

    /// Returns the units of messages, as far as they are known.
    pub fn reported(&self) -> OutputUnits {
        let requested = self.requested_units.clone();
        requested.unwrap_or_else(|| self.written_units.most())
    }
}
