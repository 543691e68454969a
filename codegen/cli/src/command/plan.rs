//! *A description → the derivation of its solution on stdout.*

use linkwright_codegen::stages::emit::{Notation, derivation};
use linkwright_codegen::stages::structure;

use super::description::{determined, no_order, source};
use super::{Outcome, Problem, print};
use crate::arguments::{Plan, Script};
use crate::terminal;

/// Prints the derivation in the chosen format.
///
/// # Errors
/// The description has errors, or its equations do not determine the motion.
pub fn run(arguments: &Plan) -> Result<Outcome, Problem> {
    let source = source(&arguments.described.file)?;
    let mut system = determined(&source, arguments.described.motion.as_deref())?;
    let plan = structure::plan_of_motion(&mut system)
        .ok_or_else(|| no_order(&arguments.described.file))?;
    let text = match arguments.format {
        Script::Text => derivation::text(&system, &plan, Notation::Ascii),
        Script::Unicode => derivation::text(&system, &plan, Notation::Unicode),
        Script::Latex => derivation::latex(&system, &plan),
    };
    let text = match arguments.format {
        Script::Text | Script::Unicode => terminal::fitted(text),
        Script::Latex => text,
    };
    print(|output| output.write_all(text.as_bytes()))?;
    Ok(Outcome::Done)
}
