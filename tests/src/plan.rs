//! Solution methods of a described mechanism.

use linkwright_codegen::stages::program::forms_of;
use linkwright_codegen::stages::structure::{self, SolvedPlan};
use linkwright_codegen::stages::system::System;

use crate::description;

/// The plan of a described mechanism with one motion.
///
/// # Panics
/// If it has none.
pub fn planned(name: &str) -> (System, SolvedPlan) {
    let mut system = description::system(name);
    let plan = structure::plan(&mut system);
    let plan = plan.unwrap_or_else(|| panic!("`{name}` has no plan"));
    (system, plan)
}

/// Steps that are more than explicit, in solve order: the names of the unknowns, and of the solution method.
pub fn forms(mut system: System, plan: &SolvedPlan) -> Vec<(Vec<String>, String)> {
    let forms = forms_of(&mut system, plan);
    let forms = forms.iter().flatten().map(|form| {
        let unknowns = form.unknowns().into_iter();
        let names = unknowns.map(|unknown| system.unknown_name(unknown).to_string());
        (names.collect(), form.name())
    });
    forms.collect()
}

/// Names of the solution methods of a described mechanism, in solve order.
///
/// # Panics
/// If it has no plan.
pub fn form_names(name: &str) -> Vec<String> {
    let (system, plan) = planned(name);
    forms(system, &plan)
        .into_iter()
        .map(|(_, name)| name)
        .collect()
}
