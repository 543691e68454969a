//! Defines hash-consed expressions: constructors, derivatives, substitution and evaluation.
//!
//! Constructor calls on a [`Graph`] return ids of canonical nodes, and a [`Tape`] evaluates them. Symbols are names without
//! meaning.
//!
//! Within one graph, expressions that are equal by the rules of `sum`, `product`, `power` and `trigonometry` have equal ids, in
//! whatever order they were built. An id never changes its meaning. Ids depend only on the sequence of calls. Rationals and
//! square roots of rationals stay exact. A value without an exact representation becomes [`Number::Float`], and an undefined
//! one a non-finite number that [`Graph::is_finite`] reports. Nothing is dropped silently.
//!
//! All arithmetic is real. A simplification may widen the domain (`x·x⁻¹ = 1`, `√x·√x = x`), but never changes a value where
//! the original has one.

mod assembler;
mod bounds;
mod choice;
mod circles;
mod code;
mod content;
mod derivative;
mod exponential;
mod graph;
mod hashing;
mod interner;
mod node;
mod nominal;
mod number;
mod product;
mod pythagoras;
mod radical;
mod rational;
mod recorder;
mod reduction;
mod spline;
mod substitute;
mod sum;
mod symbol_table;
mod symbols;
mod tape;
mod tidy;
mod trigonometry;
mod values;
mod written;

#[cfg(test)]
mod tests;

pub use assembler::Assembler;
pub use bounds::{Excess, MAX_DEPTH, MAX_STORED_TERMS};
pub use choice::Comparison;
pub use circles::Circle;
pub use code::{Code, Computation, LANES, Lanes, Register};
pub use graph::Graph;
pub use hashing::{IdMap, IdSet};
pub use node::{ExprId, Factor, Node, SymbolId, Term};
pub use number::Number;
pub use rational::Rational;
pub use recorder::Recorder;
pub use reduction::Reads;
pub use spline::{Spline, SplineId};
pub use tape::{Tape, evaluate_by};
pub use written::MAX_EXACT_LENGTH;
