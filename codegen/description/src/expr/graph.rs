//! Stores canonical nodes in an arena, in which equal nodes have equal ids.
//!
//! Operands have smaller ids than the expressions built from them. A node other than a number contains neither a non-finite
//! number nor constants with a non-finite result: the constructors return the number NaN instead. Simplification is done
//! elsewhere.
//!
//! All constructors are methods of one type, because each builds its canonical form with the others: a product calls sums and
//! roots. Every new node gets its value, its set of symbols and its cost in one step, so that no constructor can omit one.
//! Interner, symbol table, splines and ledger do not need this invariant, and are types of their own.

use super::bounds::Ledger;
use super::derivative::TermIndex;
use super::hashing::BuildExprHasher;
use super::interner::Interner;
use super::node::{ExprId, Node, SymbolId};
use super::number::Number;
use super::rational::Rational;
use super::spline::SplineTable;
use super::symbol_table::SymbolTable;
use super::symbols::SymbolSets;
use super::values::Worth;
use std::collections::{HashMap, HashSet};

const ZERO: ExprId = ExprId(0);
const ONE: ExprId = ExprId(1);
const PI: ExprId = ExprId(2);

/// A growing set of hash-consed expressions. Ids are valid only in their own graph.
#[derive(Clone, Debug)]
pub struct Graph {
    interner: Interner,
    pub(super) symbol_table: SymbolTable,
    pub(super) symbol_sets: SymbolSets,
    /// Values by node.
    pub(super) worths: Vec<Worth>,
    pub(super) ledger: Ledger,
    pub(super) derivatives: HashMap<(ExprId, SymbolId), ExprId, BuildExprHasher>,
    /// Indices of long sums that have been differentiated.
    pub(super) term_indices: HashMap<ExprId, TermIndex, BuildExprHasher>,
    /// Shorter forms of constants, as requested so far.
    pub(super) tidied: HashMap<ExprId, ExprId, BuildExprHasher>,
    pub(super) spline_table: SplineTable,
}

impl Default for Graph {
    fn default() -> Graph {
        Graph::new()
    }
}

impl Graph {
    /// Creates a graph that contains the numbers 0, 1 and π.
    pub fn new() -> Graph {
        let mut graph = Graph {
            interner: Interner::new(),
            symbol_table: SymbolTable::default(),
            symbol_sets: SymbolSets::new(),
            worths: Vec::new(),
            ledger: Ledger::new(),
            derivatives: HashMap::default(),
            term_indices: HashMap::default(),
            tidied: HashMap::default(),
            spline_table: SplineTable::default(),
        };
        let zero = graph.intern(Node::Number(Number::ZERO));
        let one = graph.intern(Node::Number(Number::ONE));
        let pi = graph.intern(Node::Pi);
        assert!(
            (zero, one, pi) == (ZERO, ONE, PI),
            "the first three ids are fixed"
        );
        graph
    }

    /// Returns the operands of an expression, in the order of its node.
    pub fn operands(&self, id: ExprId) -> Vec<ExprId> {
        let mut operands = Vec::new();
        self.node(id).each_operand(|operand| operands.push(operand));
        operands
    }

    /// Returns the subexpressions below an expression that are open, operands first. Operands of others are not visited.
    pub(super) fn open_operands(
        &self,
        expr: ExprId,
        is_open: impl Fn(ExprId) -> bool,
    ) -> Vec<ExprId> {
        let mut seen: HashSet<ExprId, BuildExprHasher> = HashSet::default();
        let mut stack = self.operands(expr);
        while let Some(operand) = stack.pop() {
            if is_open(operand) && seen.insert(operand) {
                self.node(operand).each_operand(|inner| stack.push(inner));
            }
        }
        let mut open: Vec<ExprId> = seen.into_iter().collect();
        open.sort_unstable();
        open
    }

    /// Returns one more than the depth of the deepest operand; 0 without operands.
    fn depth_of(&self, node: &Node) -> u32 {
        let mut depth = 0;
        node.each_operand(|operand| depth = depth.max(self.depth(operand) + 1));
        depth
    }

    /// Returns the top node of an expression.
    pub fn node(&self, id: ExprId) -> &Node {
        self.interner.node(id)
    }

    /// Returns the number of nodes.
    pub fn node_count(&self) -> usize {
        self.interner.len()
    }

    /// Returns the symbol of this name, and creates it on the first call.
    pub fn symbol(&mut self, name: &str) -> SymbolId {
        if let Some(symbol) = self.symbol_table.find(name) {
            return symbol;
        }
        self.ledger.store(1);
        self.symbol_table.add(name)
    }

    /// Returns the symbol of this name; `None` if it does not exist.
    pub fn find_symbol(&self, name: &str) -> Option<SymbolId> {
        self.symbol_table.find(name)
    }

    /// Returns the name of a symbol.
    pub fn symbol_name(&self, symbol: SymbolId) -> &str {
        self.symbol_table.name(symbol)
    }

    /// Returns the number of symbols.
    pub fn symbol_count(&self) -> usize {
        self.symbol_table.len()
    }

    /// Returns the expression of a symbol.
    ///
    /// # Panics
    /// Panics if the symbol belongs to another graph and has no name in this one.
    pub fn variable(&mut self, symbol: SymbolId) -> ExprId {
        assert!(
            symbol.index() < self.symbol_count(),
            "a symbol belongs to the graph that named it"
        );
        self.intern(Node::Symbol(symbol))
    }

    /// Returns a number.
    pub fn number(&mut self, value: Number) -> ExprId {
        let value = match value {
            Number::Float(float) => Number::float(float),
            exact => exact,
        };
        self.intern(Node::Number(value))
    }

    /// Returns a whole number.
    pub fn integer(&mut self, value: i64) -> ExprId {
        self.number(Number::integer(value))
    }

    /// Returns a fraction, or the number NaN for a zero denominator.
    pub fn rational(&mut self, numerator: i64, denominator: i64) -> ExprId {
        match Rational::new(i128::from(numerator), i128::from(denominator)) {
            Some(rational) => self.number(Number::rational(rational)),
            None => self.not_a_number(),
        }
    }

    /// Returns the number 0.
    pub fn zero(&self) -> ExprId {
        ZERO
    }

    /// Returns the number 1.
    pub fn one(&self) -> ExprId {
        ONE
    }

    /// Returns the number π.
    pub fn pi(&self) -> ExprId {
        PI
    }

    /// True if the expression contains no non-finite number. Such numbers come from a division by a constant zero, a root of a
    /// negative number, or an angle of the zero vector. Other causes are constants whose product is too large, and a passed
    /// bound of the graph.
    pub fn is_finite(&self, expr: ExprId) -> bool {
        // The invariant of this module makes the top node sufficient.
        !matches!(self.node(expr), Node::Number(value) if !value.is_finite())
    }

    /// Returns the number of a number node; `None` for other nodes.
    pub(super) fn as_number(&self, expr: ExprId) -> Option<Number> {
        match self.node(expr) {
            Node::Number(value) => Some(*value),
            _ => None,
        }
    }

    /// Returns the expression for undefined values.
    pub(super) fn not_a_number(&mut self) -> ExprId {
        self.number(Number::Float(f64::NAN))
    }

    /// True if one of the operands is non-finite, which makes the result non-finite.
    pub(super) fn any_non_finite(&self, operands: &[ExprId]) -> bool {
        operands.iter().any(|&operand| !self.is_finite(operand))
    }

    /// Returns the id of a canonical node; `None` if it does not exist.
    pub fn find(&self, node: &Node) -> Option<ExprId> {
        self.interner.find(node).ok()
    }

    /// Returns the id of a canonical node, and stores the node if it is new. Returns the number NaN if a constant in the node
    /// is infinite or undefined, or if a bound is passed.
    pub(super) fn intern(&mut self, node: Node) -> ExprId {
        let vacancy = match self.interner.find(&node) {
            Ok(id) => return id,
            Err(vacancy) => vacancy,
        };
        let Some(worth) = self.worth_of(&node) else {
            return self.not_a_number();
        };
        let depth = self.depth_of(&node);
        if depth == 0 {
            self.ledger.store(1);
        } else if !self.ledger.admits(node.size(), depth) {
            return self.not_a_number();
        }
        // A symbol in a set takes a twentieth of a term.
        let listed = self.symbol_sets.record(&node);
        self.ledger.store(listed / 20);
        self.ledger.record(depth);
        self.worths.push(worth);
        self.interner.insert(node, vacancy)
    }
}
