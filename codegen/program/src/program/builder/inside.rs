//! Keeps the state of closed forms inside a torn block apart from the block's own statements.

use std::collections::BTreeMap;

use super::{Builder, Direction};
use crate::expr::{IdSet, SymbolId};
use crate::program::function::Statement;

/// Results of closed forms inside a torn block.
#[derive(Debug, Default)]
pub(in crate::program) struct Inside {
    /// Signs, with the values that have these signs in the design configuration.
    pub signs: Vec<(SymbolId, f64)>,
    /// Directions of angles.
    pub directions: BTreeMap<usize, Direction>,
}

/// State of a builder before a torn block.
pub(in crate::program) struct Before {
    statements: Vec<Statement>,
    defined: IdSet<SymbolId>,
    writes_prose: bool,
}

impl Builder<'_> {
    /// Begins the closed forms inside a torn block with an empty state.
    pub(in crate::program) fn begin_inside(&mut self) -> Before {
        self.inside = Some(Inside::default());
        Before {
            statements: std::mem::take(&mut self.statements),
            defined: std::mem::take(&mut self.defined),
            writes_prose: std::mem::replace(&mut self.writes_prose, false),
        }
    }

    /// Restores the state before the torn block.
    pub(in crate::program) fn end_inside(&mut self, before: Before) {
        self.inside = None;
        self.statements = before.statements;
        self.defined = before.defined;
        self.writes_prose = before.writes_prose;
    }
}
