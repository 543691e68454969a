//! Closed forms inside a torn block → what is noted of them while they are stated apart from the block's own statements.

use std::collections::BTreeMap;

use super::{Builder, Direction};
use crate::expr::{IdSet, SymbolId};
use crate::program::function::Statement;

/// What closed forms inside a torn block find.
#[derive(Debug, Default)]
pub(in crate::program) struct Inside {
    /// Their signs, with what has the sign in the drawing.
    pub signs: Vec<(SymbolId, f64)>,
    /// The directions of angles.
    pub directions: BTreeMap<usize, Direction>,
}

/// What a builder had stated before a torn block.
pub(in crate::program) struct Before {
    statements: Vec<Statement>,
    defined: IdSet<SymbolId>,
    writes_prose: bool,
}

impl Builder<'_> {
    /// Begins to state closed forms inside a torn block, as if nothing had been stated.
    pub(in crate::program) fn begin_inside(&mut self) -> Before {
        self.inside = Some(Inside::default());
        Before {
            statements: std::mem::take(&mut self.statements),
            defined: std::mem::take(&mut self.defined),
            writes_prose: std::mem::replace(&mut self.writes_prose, false),
        }
    }

    /// Goes on with what was stated before.
    pub(in crate::program) fn end_inside(&mut self, before: Before) {
        self.inside = None;
        self.statements = before.statements;
        self.defined = before.defined;
        self.writes_prose = before.writes_prose;
    }
}
