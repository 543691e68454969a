//! What the formula that is read stands in, and what formulas have mentioned.
//!
//! A choice, a curve or an equation around a formula changes what its names mean. Deliberately unknown here: what is declared.

use std::collections::HashSet;

use super::curve;
use super::kinematic::KinematicTerms;
use crate::expr::{ExprId, SymbolId};
use crate::units::{OutputUnits, Tally};

/// The surroundings of formulas.
pub(super) struct Formulas {
    pub time: SymbolId,
    /// The choices around the formula that is read: each condition, and whether the formula stands where it is negative.
    pub choices: Vec<(ExprId, bool)>,
    /// The parameter of the curve whose formula is read.
    pub parameter: Option<curve::Parameter>,
    /// What the equation that is being read mentions; `None` elsewhere, where nothing moves but by t.
    pub kinematic: Option<KinematicTerms>,
    /// Every symbol that some expression mentions by the name of a constant, a parameter or an input; only looked up.
    pub mentioned: HashSet<SymbolId>,
    /// Units of the numbers that have been read.
    pub written_units: Tally,
    /// Units of output that the description or its reader requests.
    pub requested_units: Option<OutputUnits>,
}

impl Formulas {
    /// No formula has been read.
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

    /// Units of messages, as far as they are known.
    pub fn reported(&self) -> OutputUnits {
        let requested = self.requested_units.clone();
        requested.unwrap_or_else(|| self.written_units.most())
    }
}
