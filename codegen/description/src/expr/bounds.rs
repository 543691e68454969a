//! Bounds the size and the work of a graph.
//!
//! An expression past a bound becomes the number NaN, like an undefined one, so that any further construction on it is cheap.
//! The graph reports which bound was passed. Work is counted in terms and factors instead of seconds, so a description stops at
//! the same node on every machine. The caller attributes the work to a statement.

use super::graph::Graph;
use super::node::ExprId;

/// Maximum depth of an expression: recursive walks need stack for as many levels on every thread.
pub const MAX_DEPTH: u32 = 512;

/// Maximum number of stored terms, factors and symbols, of some 100 bytes each.
pub const MAX_STORED_TERMS: usize = 3_000_000;

/// Maximum number of terms of one sum, or factors of one product: no text of 1 MB contains more.
const MAX_NODE_PARTS: usize = 200_000;

/// Maximum number of terms and factors touched to build expressions, some 50 ns each.
const MAX_WORK: usize = 50_000_000;

/// Bound that a graph has passed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Excess {
    /// Depth: an expression nested deeper than [`MAX_DEPTH`].
    Depth,
    /// Size: too many terms and factors stored, or touched to build expressions.
    Size,
}

/// Consumption of a graph.
#[derive(Clone, Debug)]
pub(super) struct Ledger {
    stored: usize,
    touched: usize,
    /// Bounds; smaller in tests.
    largest_store: usize,
    largest_work: usize,
    /// First bound that was passed; `None` if none was.
    excess: Option<Excess>,
    depths: Vec<u32>,
}

impl Ledger {
    pub(super) fn new() -> Ledger {
        Ledger {
            stored: 0,
            touched: 0,
            largest_store: MAX_STORED_TERMS,
            largest_work: MAX_WORK,
            excess: None,
            depths: Vec::new(),
        }
    }

    /// Counts a symbol or a leaf, which is stored unconditionally.
    pub(super) fn store(&mut self, parts: usize) {
        self.stored += parts;
    }

    /// Counts touched terms and factors.
    pub(super) fn touch(&mut self, parts: usize) {
        self.touched = self.touched.saturating_add(parts);
    }

    /// True if a node of this depth with so many operands may be stored.
    pub(super) fn admits(&mut self, parts: usize, depth: u32) -> bool {
        let is_large = parts > MAX_NODE_PARTS || self.stored + parts > self.largest_store;
        let excess = if depth > MAX_DEPTH {
            Some(Excess::Depth)
        } else if is_large || self.touched > self.largest_work {
            Some(Excess::Size)
        } else {
            None
        };
        if excess.is_none() {
            self.stored += parts;
        }
        self.excess = self.excess.or(excess);
        excess.is_none()
    }

    /// Records the depth of the next node.
    pub(super) fn record(&mut self, depth: u32) {
        self.depths.push(depth);
    }

    pub(super) fn depth(&self, expr: ExprId) -> u32 {
        self.depths[expr.index()]
    }
}

impl Graph {
    /// Returns the first bound that was passed, which may be the cause of a NaN; `None` if none was.
    pub fn excess(&self) -> Option<Excess> {
        let ledger = &self.ledger;
        let too_much = ledger.touched > ledger.largest_work || ledger.stored > ledger.largest_store;
        self.ledger.excess.or(too_much.then_some(Excess::Size))
    }

    /// Counts work outside the graph, in terms and factors of equal duration.
    pub fn spend(&mut self, parts: usize) {
        self.ledger.touch(parts);
    }

    /// Returns the number of levels of operands below the expression.
    pub fn depth(&self, expr: ExprId) -> u32 {
        self.ledger.depth(expr)
    }

    /// Returns the number of terms and factors touched so far.
    pub fn work(&self) -> usize {
        self.ledger.touched
    }

    /// Returns the number of stored terms, factors and symbols.
    pub fn store(&self) -> usize {
        self.ledger.stored
    }

    /// Sets smaller bounds.
    #[cfg(test)]
    pub(super) fn limit(&mut self, store: usize, work: usize) {
        (self.ledger.largest_store, self.ledger.largest_work) = (store, work);
    }
}
