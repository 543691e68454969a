//! Solution, derivation and solution methods of a described mechanism.

use linkwright_codegen::stages::emit::derivation::Derivation;
use linkwright_codegen::stages::program::{Kept, Report};
use linkwright_codegen::stages::solved::Solved;
use linkwright_codegen::stages::structure::Shift;
use linkwright_codegen::stages::system::Derived;

use crate::description;

/// Solution of a motion, as generated code has it.
///
/// # Panics
/// If the motion has none.
pub fn solved(derived: Derived) -> Solved {
    let solved = Solved::of(derived, Shift::Directions, Kept::Requested);
    solved.expect("a solution")
}

/// Kept and omitted calculations of a motion.
///
/// # Panics
/// If the motion has no solution.
pub fn report(derived: &Derived) -> Report {
    let solved = solved(derived.clone());
    solved.report().expect("a whole program").clone()
}

/// Derivation of a motion with the shifts of its drivers.
///
/// # Panics
/// If the motion has no solution.
pub fn derivation(derived: Derived) -> Derivation {
    Derivation::of(derived, Shift::Directions).expect("a plan")
}

/// Steps that are more than explicit, in solve order: the names of the unknowns, and of the solution method.
///
/// # Panics
/// If the motion has no solution.
pub fn forms(derived: Derived) -> Vec<(Vec<String>, String)> {
    let solved = Solved::of(derived, Shift::Directions, Kept::Methods).expect("a plan");
    let forms = solved.program().forms.iter();
    let forms = forms.flatten().map(|form| {
        let unknowns = form.unknowns().into_iter();
        let names = unknowns.map(|unknown| solved.system().unknown_name(unknown).to_string());
        (names.collect(), form.name())
    });
    forms.collect()
}

/// Names of the solution methods of a described mechanism, in solve order.
///
/// # Panics
/// If it has no plan.
pub fn form_names(name: &str) -> Vec<String> {
    forms(description::system(name))
        .into_iter()
        .map(|(_, name)| name)
        .collect()
}
