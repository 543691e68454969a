//! Formulas and whole systems in plain text.

mod formula;
mod inspect;
pub(super) mod table;

pub(super) use formula::Printer;
pub(crate) use inspect::given;
pub use inspect::inspect;

use super::Notation;
use crate::expr::ExprId;
use crate::program::ConstantPart;
use crate::system::{SymbolRole, System};

/// One expression on one line, with the bodies mentioned in this order.
pub fn formula(system: &System, bodies: &[usize], notation: Notation, expr: ExprId) -> String {
    Printer::new(system, bodies, notation).expression(expr)
}

/// An unknown, its rate or its acceleration.
pub(crate) fn symbol(system: &System, notation: Notation, role: SymbolRole) -> String {
    Printer::new(system, &[], notation).symbol(role)
}

/// A constant part of an expression on one line.
pub fn constant(system: &System, part: &ConstantPart) -> String {
    Printer::new(system, &[], Notation::Ascii).constant(part)
}
