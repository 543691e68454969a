//! Derives the constraint equations of a planar mechanism and writes them as specialised Rust.
//!
//! `Source → Document → Mechanism → System → Plan → Program → Rust`: each arrow is one function of one module, and each module
//! imports only those named before it. [`generate`] names all stages.
//!
//! In a build script, [`build`] does everything:
//! ```no_run
//! linkwright_codegen::build("descriptions");
//! ```

mod cargo;
mod consequences;
pub mod diagnostic;
pub mod emit;
pub mod expr;
pub mod joint;
pub mod model;
pub mod program;
pub mod structure;
pub mod syntax;
pub mod system;

pub use cargo::build;

use diagnostic::{Diagnostics, Source};
use structure::Plan;
use system::System;

/// A description whose equations have been derived.
#[derive(Clone, Debug)]
pub struct Read {
    /// The equations.
    pub system: System,
    /// What should be looked at although it is no error.
    pub warnings: Diagnostics,
}

/// The Rust source of a mechanism.
#[derive(Clone, Debug)]
pub struct Generated {
    /// The mechanism's name.
    pub name: String,
    /// The module's source, ending in a line break.
    pub code: String,
    /// What should be looked at although it is no error.
    pub warnings: Diagnostics,
}

/// Derives the equations of a description, whether or not they determine the motion.
///
/// # Errors
/// Every error of the text and of its names, values and forms.
pub fn read(source: &Source) -> Result<Read, Diagnostics> {
    let mut diagnostics = Diagnostics::new();
    let Some(document) = syntax::parse(source, &mut diagnostics) else {
        return Err(diagnostics);
    };
    let mut resolving = Diagnostics::new();
    let mechanism = model::resolve(&document, &mut resolving);
    if diagnostics.has_errors() {
        consequences::add_independent(resolving, &document, source, &mut diagnostics);
        return Err(diagnostics);
    }
    diagnostics.extend(resolving);
    match mechanism {
        Some(mechanism) => Ok(Read {
            system: system::assemble(mechanism),
            warnings: diagnostics,
        }),
        None => Err(diagnostics),
    }
}

/// Checks that the equations determine every coordinate exactly once, and says in which blocks they are solved.
///
/// # Errors
/// Too few or too many equations, with the bodies and joints concerned.
pub fn check(system: &System) -> Result<Plan, Diagnostics> {
    let mut diagnostics = Diagnostics::new();
    structure::analyze(system, &mut diagnostics).ok_or(diagnostics)
}

/// Writes the Rust module of a description.
///
/// # Errors
/// Every error of the description; nothing is written then.
pub fn generate(source: &Source) -> Result<Generated, Diagnostics> {
    let Read {
        mut system,
        warnings,
    } = read(source)?;
    let plan = check(&system)?;
    let solved = structure::plan(&mut system);
    let program = program::lower(&mut system, plan, solved.as_ref());
    let code = emit::rust::module(&system, &program);
    Ok(Generated {
        name: system.mechanism.name.clone(),
        code,
        warnings,
    })
}
