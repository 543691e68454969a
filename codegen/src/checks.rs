//! Checks equations and their solution: they must determine the motion, all numbers must be finite, and the work
//! within its bounds.
//!
//! Warns if the design configuration does not decide every assembly mode.

use crate::diagnostic::{self, Diagnostics};
use crate::finiteness;
use crate::modes;
use crate::program::Kept;
use crate::solved::Solved;
use crate::structure::{self, Shift};
use crate::system::Derived;

/// Findings of all motions; a finding of some motions alone names the motion.
pub(crate) fn of_motions(
    motions: &[Derived],
    find: impl Fn(&Derived) -> Diagnostics,
) -> Diagnostics {
    let findings = motions.iter().map(|derived| {
        let mechanism = &derived.system.mechanism;
        let motion = mechanism.motion.as_ref();
        let name = motion.map_or("", |motion| motion.name.as_str());
        let findings = find(derived).respelled(&mechanism.spellings);
        (name, None, findings)
    });
    diagnostic::merged(findings.collect())
}

/// Checks that the equations determine every coordinate exactly once and that the numbers of their solution are
/// finite. Returns warnings.
///
/// # Errors
/// Too few or too many equations, with their bodies and joints; numbers that become infinite or undefined.
pub fn check(derived: &Derived) -> Result<Diagnostics, Diagnostics> {
    let Derived { pool, system } = derived;
    let _work = diagnostic::internal::work_at(system.mechanism.place());
    let mut diagnostics = structure::analyze(pool, system).respelled(&system.mechanism.spellings);
    if diagnostics.has_errors() {
        return Err(diagnostics);
    }
    match Solved::of(derived.clone(), Shift::Directions, Kept::Requested) {
        Ok(solved) => diagnostics.extend(findings_of(&solved)?),
        Err(unplanned) => {
            let exceeded = finiteness::of_unplanned(unplanned);
            if exceeded.has_errors() {
                return Err(exceeded);
            }
        }
    }
    Ok(diagnostics)
}

/// Checks that the numbers of a motion's program are finite. Returns warnings.
///
/// # Errors
/// Numbers that become infinite or undefined, and work beyond its bounds.
pub fn findings_of(solved: &Solved) -> Result<Diagnostics, Diagnostics> {
    let (pool, system, program) = (solved.pool(), solved.system(), solved.program());
    let spellings = &system.mechanism.spellings;
    let mut findings = finiteness::of_program(pool, system, program, finiteness::Range::F64);
    if findings.has_errors() {
        return Err(findings.respelled(spellings));
    }
    findings.extend(modes::undecided(system, &program.blocks, &program.branches));
    Ok(findings.respelled(spellings))
}

/// Checks every motion; a finding of some motions alone names the motion.
///
/// # Errors
/// Those of [`check`], each once.
pub fn check_all(motions: &[Derived]) -> Result<(), Diagnostics> {
    let findings = of_motions(motions, |derived| {
        structure::analyze(&derived.pool, &derived.system)
    });
    if findings.has_errors() {
        Err(findings)
    } else {
        Ok(())
    }
}
