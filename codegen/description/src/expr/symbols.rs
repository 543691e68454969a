//! Stores the sorted set of symbols of every node.
//!
//! The set of a node is recorded on its creation. Nodes share a set if the set of one operand contains all others.

use std::sync::Arc;

use super::graph::Graph;
use super::node::{ExprId, Node, SymbolId};

/// Sets of symbols, with the set of each node.
#[derive(Clone, Debug)]
pub(super) struct SymbolSets {
    members: Vec<Arc<[SymbolId]>>,
    set_of_node: Vec<u32>,
}

impl SymbolSets {
    pub(super) fn new() -> SymbolSets {
        SymbolSets {
            members: vec![Arc::default()],
            set_of_node: Vec::new(),
        }
    }

    fn of(&self, expr: ExprId) -> &[SymbolId] {
        &self.members[self.set_of_node[expr.index()] as usize]
    }

    /// Records the set of the next node; returns the number of symbols stored for it.
    pub(super) fn record(&mut self, node: &Node) -> usize {
        let before = self.members.len();
        let set = match node {
            Node::Number(_) | Node::Pi => 0,
            Node::Symbol(symbol) => self.store(Arc::new([*symbol])),
            Node::Sin(operand)
            | Node::Cos(operand)
            | Node::Exp(operand)
            | Node::Ln(operand)
            | Node::Floor(operand)
            | Node::Spline {
                argument: operand, ..
            } => self.set_of_node[operand.index()],
            Node::Atan2(y, x) => self.union([*y, *x].into_iter()),
            Node::Choose {
                condition,
                below,
                otherwise,
            } => self.union([*condition, *below, *otherwise].into_iter()),
            Node::Sum(terms) => self.union(terms.iter().map(|term| term.expr)),
            Node::Product(factors) => self.union(factors.iter().map(|factor| factor.base)),
        };
        self.set_of_node.push(set);
        self.members[before..].iter().map(|it| it.len()).sum()
    }

    fn union(&mut self, operands: impl Iterator<Item = ExprId>) -> u32 {
        let mut sets: Vec<u32> = operands
            .map(|operand| self.set_of_node[operand.index()])
            .filter(|&set| set != 0)
            .collect();
        sets.sort_unstable();
        sets.dedup();
        let size = |set: &u32| self.members[*set as usize].len();
        let Some(&largest) = sets.iter().max_by_key(|set| size(set)) else {
            return 0;
        };
        if sets.len() == 1 {
            return largest;
        }
        let mut union: Vec<SymbolId> = sets
            .iter()
            .flat_map(|&set| self.members[set as usize].iter().copied())
            .collect();
        union.sort_unstable();
        union.dedup();
        if union.len() == size(&largest) {
            return largest;
        }
        self.store(union.into())
    }

    fn store(&mut self, set: Arc<[SymbolId]>) -> u32 {
        // There are never more sets than nodes, whose number fits.
        self.members.push(set);
        (self.members.len() - 1) as u32
    }
}

impl Graph {
    /// Returns the symbols in the expression, sorted.
    pub fn symbols(&self, expr: ExprId) -> &[SymbolId] {
        self.symbol_sets.of(expr)
    }

    /// True if the symbol occurs in the expression.
    pub fn depends_on(&self, expr: ExprId, symbol: SymbolId) -> bool {
        self.symbols(expr).binary_search(&symbol).is_ok()
    }

    /// True if no symbol occurs in the expression.
    pub fn is_constant(&self, expr: ExprId) -> bool {
        self.symbols(expr).is_empty()
    }
}
