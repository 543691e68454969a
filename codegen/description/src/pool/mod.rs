//! Holds the expressions of a motion, the roles of their symbols, rotated local vectors and the names in use.
//!
//! A stage takes a pool by `&mut` to add to it, and by `&` to read it. An id never changes its meaning, so what an earlier stage
//! has made stays valid. Ids depend only on the order of additions.

mod arms;
mod draft;
mod rates;
mod roles;
mod turned;

pub use arms::Arm;
pub use draft::Draft;
pub use roles::SymbolRole;
pub use turned::Turned;

use std::collections::{HashMap, HashSet};

use crate::diagnostic::Span;
use crate::expr::{Excess, ExprId, Graph, SymbolId};
use crate::joint::geometry::Vector;

/// Expressions of a motion, with what later stages add to them.
#[derive(Clone, Debug)]
pub struct Pool {
    /// Arena of all expressions.
    pub graph: Graph,
    /// Roles by symbol, up to the last symbol with one.
    roles: Vec<SymbolRole>,
    /// Symbols of each unknown: itself, its rate and its acceleration.
    unknowns: Vec<[SymbolId; 3]>,
    /// Rate d/dt of each symbol that moves; only looked up.
    rates: HashMap<SymbolId, ExprId>,
    /// Rotated local vectors, in order of first use.
    arms: Vec<Arm>,
    /// Indices of rotated local vectors; only looked up.
    arm_places: HashMap<(usize, Vector), usize>,
    /// Rotated local vectors of each angle; only looked up.
    arms_of: HashMap<usize, Vec<usize>>,
    /// Names of unknowns and arms; only looked up.
    taken_names: HashSet<String>,
    /// For each name, the last number that is taken; only looked up.
    name_numbers: HashMap<String, usize>,
    /// Rule that keeps names apart from those of the output.
    apart: fn(name: &str, prefix: &str) -> String,
    exceeded: Option<Exceeded>,
}

/// Limit that was exceeded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Exceeded {
    /// Statement that exceeded the limit.
    pub at: Span,
    /// Exceeded limit.
    pub bound: Bound,
}

/// Limits on the equations of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bound {
    /// Limit on memory or work of the graph.
    Graph(Excess),
    /// Limit on unknowns that are solved simultaneously; the value is their number.
    Together(usize),
}

impl Pool {
    /// Makes a pool with the expressions of a resolved mechanism. `apart` returns a name that the output does not use otherwise.
    pub fn new(graph: Graph, apart: fn(name: &str, prefix: &str) -> String) -> Pool {
        Pool {
            graph,
            roles: Vec::new(),
            unknowns: Vec::new(),
            rates: HashMap::new(),
            arms: Vec::new(),
            arm_places: HashMap::new(),
            arms_of: HashMap::new(),
            taken_names: HashSet::new(),
            name_numbers: HashMap::new(),
            apart,
            exceeded: None,
        }
    }

    /// Returns a pool with these expressions and without roles, for a changed mechanism that is assembled again.
    pub fn without_roles(&self) -> Pool {
        Pool::new(self.graph.clone(), self.apart)
    }

    /// Returns the first limit that was exceeded, if any: expressions behind that statement are incomplete.
    pub fn exceeded(&self) -> Option<Exceeded> {
        self.exceeded
    }

    /// Records an exceeded limit; the first one is kept.
    pub fn exceed(&mut self, exceeded: Exceeded) {
        self.exceeded.get_or_insert(exceeded);
    }

    /// True if a limit has been exceeded; an excess of the graph is recorded with this statement.
    pub fn is_beyond(&mut self, at: Span) -> bool {
        if let Some(excess) = self.graph.excess() {
            let bound = Bound::Graph(excess);
            self.exceed(Exceeded { at, bound });
        }
        self.exceeded.is_some()
    }

    /// Returns a new symbol for an intermediate value. Text after a space in `name` only distinguishes equal names.
    pub fn intermediate(&mut self, name: &str) -> SymbolId {
        let number = self.graph.symbol_count();
        self.graph.symbol(&format!("{name} {number}"))
    }

    /// Returns the symbol of a value in the last frame; constant values keep their symbol.
    pub fn last(&mut self, symbol: SymbolId) -> SymbolId {
        if self.graph.nominal(symbol).is_some() {
            return symbol;
        }
        let name = format!("last {}", self.graph.symbol_name(symbol));
        let last = self.graph.symbol(&name);
        self.set_role(last, SymbolRole::Last(symbol));
        last
    }

    /// Returns an expression with the values of the last frame.
    pub fn in_last_frame(&mut self, expr: ExprId) -> ExprId {
        let symbols = self.graph.symbols(expr).to_vec();
        let replaced: Vec<(SymbolId, ExprId)> = symbols
            .into_iter()
            .map(|symbol| {
                let last = self.last(symbol);
                (symbol, self.graph.variable(last))
            })
            .collect();
        self.graph.substitute(expr, &replaced)
    }

    /// Returns the name of an arm, a parameter, an input or an intermediate value. Text after a space only distinguishes equal
    /// names.
    pub fn local_name(&self, symbol: SymbolId) -> &str {
        let name = self.graph.symbol_name(symbol);
        name.split(' ').next().unwrap_or(name)
    }

    /// True if an unknown or an arm has this name.
    pub fn is_taken(&self, name: &str) -> bool {
        self.taken_names.contains(name)
    }

    /// Reserves the name of an unknown.
    pub fn take_name(&mut self, name: &str) {
        self.taken_names.insert(name.to_string());
    }
}
