//! Prepares a description for a study of its tolerances.

use linkwright_codegen::diagnostic::{Diagnostics, Source};
use linkwright_codegen::stages::model::set;
use linkwright_codegen::stages::system::Derived;
use linkwright_codegen::{Read, Requests};

use crate::interpreted::Interpreted;
use crate::opened::{Unopened, determined, solvable};

/// Motion with the derivatives that the first order needs.
#[derive(Clone, Debug)]
pub struct Prepared {
    /// Blocks of the motion, without derivatives.
    pub blocks: Interpreted,
    /// Blocks with the sensitivities to all parameters with a tolerance, in the order of the description.
    pub along: Interpreted,
    /// Blocks without ranges of parameters, for differences about a value at the end of its range.
    pub unlimited: Interpreted,
}

/// Reason why a study of tolerances cannot begin.
#[derive(Clone, Debug)]
pub enum Unprepared {
    /// The description cannot be solved.
    Unopened(Unopened),
    /// An assignment cannot be applied: the rendered error.
    Assignment(String),
    /// No parameter has a tolerance.
    NoTolerance,
    /// The description has no measure.
    NoMeasure,
    /// Coordinates are moved by forces.
    Free,
}

/// Prepares a motion of a description with these assignments of parameters and inputs, and adds warnings. `option` is the subject of
/// their errors.
///
/// # Errors
/// The description cannot be solved, nothing has a tolerance, or nothing is measured.
pub fn prepared(
    source: &Source,
    motion: Option<&str>,
    option: &str,
    assignments: &[String],
    warnings: &mut Diagnostics,
) -> Result<Prepared, Unprepared> {
    let plain = determined(source, motion, warnings).map_err(Unprepared::Unopened)?;
    let mechanism = &plain.system.mechanism;
    let mut parameters = mechanism.parameters.iter();
    if !parameters.any(|it| it.tolerance.is_some()) && mechanism.clearances.is_empty() {
        return Err(Unprepared::NoTolerance);
    }
    if mechanism.measurements.is_empty() {
        return Err(Unprepared::NoMeasure);
    }
    if !mechanism.forces.free.is_empty() {
        return Err(Unprepared::Free);
    }
    // Without sensitivities, samples are solved in less time.
    let plain = match mechanism.clearances.is_empty() {
        true => plain,
        false => requesting(source, motion, Some(&[]))?,
    };
    let along = requesting(source, motion, None)?;
    let [plain, along] = [
        set_all(plain, option, assignments),
        set_all(along, option, assignments),
    ];
    let (plain, along) = (plain?, along?);
    let mut unlimited = plain.clone();
    for parameter in &mut unlimited.system.mechanism.parameters {
        parameter.range = None;
    }
    let mut repeated = Diagnostics::new();
    let blocks = |derived: &Derived, warnings: &mut Diagnostics| {
        solvable(derived, warnings).map_err(Unprepared::Unopened)
    };
    Ok(Prepared {
        blocks: blocks(&plain, warnings)?,
        along: blocks(&along, &mut repeated)?,
        unlimited: blocks(&unlimited, &mut repeated)?,
    })
}

/// Derives a motion that [`determined`] has found, with the offsets of loose pins, and sensitivities to all tolerances or to those
/// `along`.
fn requesting(
    source: &Source,
    motion: Option<&str>,
    along: Option<&[&str]>,
) -> Result<Derived, Unprepared> {
    let requests = Requests {
        along,
        tolerances: true,
        ..Requests::default()
    };
    let read = Read::requesting(source, requests);
    let read = read.map_err(|errors| Unprepared::Unopened(Unopened::Findings(errors)))?;
    let derived = match motion {
        Some(name) => read.motion(name).cloned(),
        None => read.only(),
    };
    derived.ok_or(Unprepared::Unopened(Unopened::NoOrder))
}

fn set_all(
    mut derived: Derived,
    option: &str,
    assignments: &[String],
) -> Result<Derived, Unprepared> {
    let Derived { pool, system } = &mut derived;
    for assignment in assignments {
        set(pool, &mut system.mechanism, option, assignment).map_err(Unprepared::Assignment)?;
    }
    Ok(derived)
}
