//! Formulas and whole systems in LaTeX, for amsmath.

mod formula;
mod inspect;

pub(crate) use formula::{escaped, vector_name};
pub use inspect::inspect;

use crate::expr::ExprId;
use crate::system::{SymbolRole, System};
pub(super) use formula::Printer;

/// One expression for math mode, with the bodies mentioned in this order.
pub fn formula(system: &System, bodies: &[usize], expr: ExprId) -> String {
    Printer::new(system, bodies).expression(expr)
}

/// An unknown, its rate or its acceleration.
pub(crate) fn symbol(system: &System, role: SymbolRole) -> String {
    Printer::new(system, &[]).symbol(role)
}
