//! Checks equations and their solution: they must determine the motion, all numbers must be finite, and the work
//! within its bounds.
//!
//! Warns if the design configuration does not decide every assembly mode.

use crate::diagnostic::{self, Diagnostics};
use crate::emit::derivation::Derivation;
use crate::finiteness;
use crate::modes;
use crate::program::{Program, Report, lower};
use crate::structure;
use crate::system::System;

/// Findings of all motions; a finding of some motions alone names the motion.
pub(crate) fn of_motions(motions: &[System], find: impl Fn(&System) -> Diagnostics) -> Diagnostics {
    let found = motions.iter().map(|system| {
        let motion = system.mechanism.motion.as_ref();
        let name = motion.map_or("", |motion| motion.name.as_str());
        let found = find(system).respelled(&system.mechanism.spellings);
        (name, None, found)
    });
    diagnostic::merged(found.collect())
}

/// Checks that the equations determine every coordinate exactly once and that the numbers of their solution are
/// finite. Returns warnings.
///
/// # Errors
/// Too few or too many equations, with their bodies and joints; numbers that become infinite or undefined.
pub fn check(system: &System) -> Result<Diagnostics, Diagnostics> {
    let _work = diagnostic::internal::work_at(system.mechanism.place());
    let spellings = &system.mechanism.spellings;
    let mut diagnostics = Diagnostics::new();
    if !structure::analyze(system, &mut diagnostics) {
        return Err(diagnostics.respelled(spellings));
    }
    let mut diagnostics = diagnostics.respelled(spellings);
    let mut system = system.clone();
    let solved = structure::plan(&mut system);
    let program = solved.map(|solved| lower(&mut system, &solved));
    diagnostics.extend(findings(&system, program.as_ref())?);
    Ok(diagnostics)
}

/// Checks that the numbers of a system's program are finite. Returns warnings. Without a program, only the bounds of
/// work are checked.
///
/// # Errors
/// Numbers that become infinite or undefined, and work beyond its bounds.
pub fn findings(system: &System, program: Option<&Program>) -> Result<Diagnostics, Diagnostics> {
    let spellings = &system.mechanism.spellings;
    let mut found = finiteness::of_program(system, program, finiteness::Range::F64);
    if found.has_errors() {
        return Err(found.respelled(spellings));
    }
    found.extend(
        program
            .iter()
            .flat_map(|it| modes::undecided(system, &it.blocks, &it.branches)),
    );
    Ok(found.respelled(spellings))
}

/// Checks that the numbers of a derivation are finite. Returns warnings.
///
/// # Errors
/// Those of [`findings`].
pub fn findings_of_derivation(derivation: &Derivation<'_>) -> Result<Diagnostics, Diagnostics> {
    let (system, blocks) = (derivation.system(), derivation.blocks());
    let spellings = &system.mechanism.spellings;
    let mut found = finiteness::of_blocks(system, blocks);
    if found.has_errors() {
        return Err(found.respelled(spellings));
    }
    found.extend(modes::undecided(system, blocks, derivation.branches()));
    Ok(found.respelled(spellings))
}

/// Checks every motion; a finding of some motions alone names the motion.
///
/// # Errors
/// Those of [`check`], each once.
pub fn check_all(motions: &[System]) -> Result<(), Diagnostics> {
    let found = of_motions(motions, |system| {
        let mut found = Diagnostics::new();
        structure::analyze(system, &mut found);
        found
    });
    if found.has_errors() {
        Err(found)
    } else {
        Ok(())
    }
}

/// Report of the values that the solved formulation computes and leaves out, with counts of operations; `None` if the
/// equations do not determine the motion, or exceed the bounds of work.
pub fn report(system: &System) -> Option<Report> {
    let mut system = system.clone();
    let plan = structure::plan(&mut system)?;
    let report = lower(&mut system, &plan).report;
    let is_whole = system.mechanism.graph.excess().is_none();
    is_whole.then_some(report)
}
