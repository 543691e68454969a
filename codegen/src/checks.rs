//! Equations, and what solves them → what is wrong with them, and what should be looked at.
//!
//! Whether they determine the motion, whether the numbers are numbers, whether the work is within its bounds, whether the drawing decides
//! every assembly mode. Deliberately unknown here: what is written afterwards.

use crate::diagnostic::{self, Diagnostics};
use crate::emit::derivation::Derivation;
use crate::finiteness;
use crate::modes;
use crate::pool::Pool;
use crate::program::{Kept, Program, Report, lower};
use crate::structure::{self, Shift};
use crate::system::{Derived, System};

/// What is found in motions; a finding of some motions alone names the motion.
pub(crate) fn of_motions(
    motions: &[Derived],
    find: impl Fn(&Derived) -> Diagnostics,
) -> Diagnostics {
    let found = motions.iter().map(|derived| {
        let mechanism = &derived.system.mechanism;
        let motion = mechanism.motion.as_ref();
        let name = motion.map_or("", |motion| motion.name.as_str());
        let found = find(derived).respelled(&mechanism.spellings);
        (name, None, found)
    });
    diagnostic::merged(found.collect())
}

/// Checks that the equations determine every coordinate exactly once and that what solves them is made of numbers. Gives warnings.
///
/// # Errors
/// Too few or too many equations, with the bodies and joints concerned; numbers that become infinite or undefined.
pub fn check(derived: &Derived) -> Result<Diagnostics, Diagnostics> {
    let Derived { pool, system } = derived;
    let _work = diagnostic::internal::work_at(system.mechanism.place());
    let mut diagnostics = structure::analyze(pool, system).respelled(&system.mechanism.spellings);
    if diagnostics.has_errors() {
        return Err(diagnostics);
    }
    let mut pool = pool.clone();
    let plan = structure::plan(&mut pool, system, Shift::Directions);
    let program = plan.map(|plan| lower(&mut pool, system, &plan, Kept::Requested));
    diagnostics.extend(findings(&pool, system, program.ok().as_ref())?);
    Ok(diagnostics)
}

/// Checks what solves a system: that its numbers are numbers. Gives warnings. Where nothing solves it, only the bounds of work are
/// checked.
///
/// # Errors
/// Numbers that become infinite or undefined, and work beyond its bounds.
pub fn findings(
    pool: &Pool,
    system: &System,
    program: Option<&Program>,
) -> Result<Diagnostics, Diagnostics> {
    let spellings = &system.mechanism.spellings;
    let mut found = finiteness::of_program(pool, system, program, finiteness::Range::F64);
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
    let (pool, system) = (derivation.pool(), derivation.system());
    let blocks = derivation.blocks();
    let spellings = &system.mechanism.spellings;
    let mut found = finiteness::of_blocks(pool, system, blocks);
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
pub fn check_all(motions: &[Derived]) -> Result<(), Diagnostics> {
    let found = of_motions(motions, |derived| {
        structure::analyze(&derived.pool, &derived.system)
    });
    if found.has_errors() {
        Err(found)
    } else {
        Ok(())
    }
}

/// What the solved view of a system computes and leaves out, with counts of operations; `None` where the equations do not
/// determine the motion, or take more work than one description may cause.
pub fn report(derived: &Derived) -> Option<Report> {
    let mut pool = derived.pool.clone();
    let plan = structure::plan(&mut pool, &derived.system, Shift::Directions).ok()?;
    let report = lower(&mut pool, &derived.system, &plan, Kept::Requested).report;
    let is_whole = pool.graph.excess().is_none();
    is_whole.then_some(report)
}
