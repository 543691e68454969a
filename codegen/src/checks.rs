//! Equations, and what solves them → what is wrong with them, and what should be looked at.
//!
//! Whether they determine the motion, whether the numbers are numbers, whether the work is within its bounds, whether the drawing decides
//! every assembly mode. Deliberately unknown here: what is written afterwards.

use crate::diagnostic::{self, Diagnostics};
use crate::emit::derivation::Derivation;
use crate::finiteness;
use crate::modes;
use crate::program::{Program, Report, lower};
use crate::structure;
use crate::system::System;

/// What is found in motions; a finding of some motions alone names the motion.
pub(crate) fn of_motions(motions: &[System], find: impl Fn(&System) -> Diagnostics) -> Diagnostics {
    let found = motions.iter().map(|system| {
        let motion = system.mechanism.motion.as_ref();
        let name = motion.map_or("", |motion| motion.name.as_str());
        let found = find(system).respelled(&system.mechanism.spellings);
        (name, None, found)
    });
    diagnostic::merged(found.collect())
}

/// Checks that the equations determine every coordinate exactly once and that what solves them is made of numbers. Gives warnings.
///
/// # Errors
/// Too few or too many equations, with the bodies and joints concerned; numbers that become infinite or undefined.
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

/// Checks what solves a system: that its numbers are numbers. Gives warnings. Where nothing solves it, only the bounds of work are
/// checked.
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

/// The same of what a derivation shows.
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

/// The same for every motion; a finding of some motions alone names the motion.
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

/// What the solved view of a system computes and leaves out, with counts of operations; `None` where the equations do not
/// determine the motion, or take more work than one description may cause.
pub fn report(system: &System) -> Option<Report> {
    let mut system = system.clone();
    let plan = structure::plan(&mut system)?;
    let report = lower(&mut system, &plan).report;
    let is_whole = system.mechanism.graph.excess().is_none();
    is_whole.then_some(report)
}
