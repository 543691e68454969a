//! How much a graph may hold: *every new node, and every term that is touched* → *whether there is room for more*.
//!
//! What is past a bound becomes the number NaN, as what is undefined does, so that whatever is built on it ends soon; and the
//! graph says which bound it was. Work is counted in terms and factors, not in seconds, so that the same description ends at the
//! same place on every machine. This file does not know which statement caused the work.

use super::graph::Graph;
use super::node::ExprId;

/// The deepest expression: what walks an expression by recursion has room for as many levels on every thread.
pub const DEEPEST: u32 = 512;

/// The most terms, factors and symbols that a graph stores, of some 100 bytes each.
pub const LARGEST_STORE: usize = 3_000_000;

/// The most terms of one sum, or factors of one product: no text of 1 MB writes more.
const LARGEST_NODE: usize = 200_000;

/// The most terms and factors that are touched to build them, some 50 ns each.
const LARGEST_WORK: usize = 50_000_000;

/// What a graph has no room for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Excess {
    /// An expression nested deeper than [`DEEPEST`].
    Depth,
    /// More terms and factors than are stored, or touched to build them.
    Size,
}

/// What has been used of it.
#[derive(Clone, Debug)]
pub(super) struct Ledger {
    stored: usize,
    touched: usize,
    /// The bounds; smaller in tests.
    largest_store: usize,
    largest_work: usize,
    /// The first bound that was passed.
    excess: Option<Excess>,
    depths: Vec<u32>,
}

impl Ledger {
    pub(super) fn new() -> Ledger {
        Ledger {
            stored: 0,
            touched: 0,
            largest_store: LARGEST_STORE,
            largest_work: LARGEST_WORK,
            excess: None,
            depths: Vec::new(),
        }
    }

    /// Counts what is stored whatever there is room for: a symbol, or a leaf.
    pub(super) fn store(&mut self, parts: usize) {
        self.stored += parts;
    }

    /// Counts terms and factors that are looked at.
    pub(super) fn touch(&mut self, parts: usize) {
        self.touched = self.touched.saturating_add(parts);
    }

    /// Whether a node of this depth with so many operands may be stored.
    pub(super) fn admits(&mut self, parts: usize, depth: u32) -> bool {
        let is_large = parts > LARGEST_NODE || self.stored + parts > self.largest_store;
        let found = if depth > DEEPEST {
            Some(Excess::Depth)
        } else if is_large || self.touched > self.largest_work {
            Some(Excess::Size)
        } else {
            None
        };
        if found.is_none() {
            self.stored += parts;
        }
        self.excess = self.excess.or(found);
        found.is_none()
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
    /// The bound that was passed first, if one was: some expression is NaN for that reason alone.
    pub fn excess(&self) -> Option<Excess> {
        let ledger = &self.ledger;
        let too_much = ledger.touched > ledger.largest_work || ledger.stored > ledger.largest_store;
        self.ledger.excess.or(too_much.then_some(Excess::Size))
    }

    /// Counts work that is done beside the graph, in terms and factors that would take as long.
    pub fn spend(&mut self, parts: usize) {
        self.ledger.touch(parts);
    }

    /// How many levels of operands are below the expression.
    pub fn depth(&self, expr: ExprId) -> u32 {
        self.ledger.depth(expr)
    }

    /// How many terms and factors have been touched to build what there is: the work so far.
    pub fn work(&self) -> usize {
        self.ledger.touched
    }

    /// How many terms, factors and symbols are stored.
    pub fn store(&self) -> usize {
        self.ledger.stored
    }

    /// Sets smaller bounds.
    #[cfg(test)]
    pub(super) fn limit(&mut self, store: usize, work: usize) {
        (self.ledger.largest_store, self.ledger.largest_work) = (store, work);
    }
}
