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
use crate::pool::{Pool, SymbolRole};
use crate::system::{Derived, System};

/// One expression, with the bodies mentioned in this order.
pub fn formula(pool: &Pool, system: &System, bodies: &[usize], expr: ExprId) -> String {
    Printer::new(pool, system, bodies, MathMl).expression(expr)
}

/// An unknown, its rate or its acceleration.
pub fn symbol(pool: &Pool, system: &System, role: SymbolRole) -> String {
    Printer::new(pool, system, &[], MathMl).symbol(role)
}

/// Equations of a system.
pub fn inspection(derived: &Derived) -> Inspection {
    Inspection::of(derived, MathMl)
}
