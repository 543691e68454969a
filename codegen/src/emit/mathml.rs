//! Formulas and whole systems in MathML, as browsers show it: the elements of MathML Core and no others.
//!
//! An unknown says in `data-q` which it is, so that a page can tell what a formula is about.

mod lines;
mod spelling;

pub use lines::lines;
pub(crate) use lines::shown;
pub(crate) use spelling::{MathMl, brackets, name, typed, vector_name};

use super::formula::Printer;
use super::inspection::Inspection;
use crate::expr::ExprId;
use crate::system::{SymbolRole, System};

/// One expression, with the bodies mentioned in this order.
pub fn formula(system: &System, bodies: &[usize], expr: ExprId) -> String {
    Printer::new(system, bodies, MathMl).expression(expr)
}

/// An unknown, its rate or its acceleration.
pub fn symbol(system: &System, role: SymbolRole) -> String {
    Printer::new(system, &[], MathMl).symbol(role)
}

/// The equations of a system.
pub fn inspection(system: &System) -> Inspection {
    Inspection::of(system, MathMl)
}
