//! Hash-consed expressions: smart constructors, derivative, substitution and evaluation.
//!
//! *Takes* constructor calls on a [`Graph`] → *gives* ids of canonical nodes, and a [`Tape`] that evaluates them.
//!
//! What holds afterwards: within one graph equal expressions, as far as the rules of `sum`, `product`, `power` and
//! `trigonometry` see it, have equal ids whatever the order in which they were built; an id never changes its meaning; ids
//! depend on the sequence of calls only. Rationals and square roots of rationals stay exact; what no longer fits becomes
//! [`Number::Float`], and what is undefined becomes a non-finite number that [`Graph::is_finite`] reports. Nothing is
//! dropped silently.
//!
//! What this room does not know: mechanisms, units, bodies, printing. Symbols are names without meaning.
//!
//! Real arithmetic is meant throughout. A simplification may widen the domain (`x·x⁻¹ = 1`, `√x·√x = x`), but never
//! changes a value where the original has one.

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
mod node;
mod nominal;
mod number;
mod product;
mod pythagoras;
mod radical;
mod rational;
mod recorder;
mod spline;
mod substitute;
mod sum;
mod symbols;
mod tape;
mod tidy;
mod trigonometry;
mod values;
mod written;

#[cfg(test)]
mod tests;

pub use assembler::Assembler;
pub use bounds::{DEEPEST, Excess, LARGEST_STORE};
pub use choice::Comparison;
pub use circles::Circle;
pub use code::{Code, Computation, Register};
pub use graph::Graph;
pub use hashing::{IdMap, IdSet};
pub use node::{ExprId, Factor, Node, SymbolId, Term};
pub use number::Number;
pub use rational::Rational;
pub use recorder::Recorder;
pub use spline::{Spline, SplineId};
pub use tape::{Tape, evaluate_by};
pub use written::SHORT;
