//! Solution methods of a described mechanism.

use linkwright_codegen::stages::program::forms_of;
use linkwright_codegen::stages::structure::Shift;
use linkwright_codegen::stages::structure::{self, SolvedPlan};
use linkwright_codegen::stages::system::Derived;

use crate::description;

/// The plan of a described mechanism with one motion.
///
/// # Panics
/// If it has none.
pub fn planned(name: &str) -> (Derived, SolvedPlan) {
    let mut derived = description::system(name);
    let plan = structure::plan(&mut derived.pool, &derived.system, Shift::Directions);
    let plan = plan.unwrap_or_else(|_| panic!("`{name}` has no plan"));
    (derived, plan)
}

/// Steps that are more than explicit, in solve order: the names of the unknowns, and of the solution method.
pub fn forms(mut derived: Derived, plan: &SolvedPlan) -> Vec<(Vec<String>, String)> {
    let forms = forms_of(&mut derived.pool, &derived.system, plan);
    let forms = forms.iter().flatten().map(|form| {
        let unknowns = form.unknowns().into_iter();
        let names = unknowns.map(|unknown| derived.system.unknown_name(unknown).to_string());
        (names.collect(), form.name())
    });
    forms.collect()
}

/// Names of the solution methods of a described mechanism, in solve order.
///
/// # Panics
/// If it has no plan.
pub fn form_names(name: &str) -> Vec<String> {
    let (derived, plan) = planned(name);
    forms(derived, &plan)
        .into_iter()
        .map(|(_, name)| name)
        .collect()
}
