//! Prints the derivation of a description's solution.

use linkwright_codegen::stages::emit::Notation;
use linkwright_codegen::stages::emit::derivation::Derivation;
use linkwright_codegen::stages::structure::Shift;
use linkwright_codegen::stages::{findings_of, finiteness};

use linkwright_solver::opened::Unopened;

use super::description::{determined, rendered, source, unopened, warn};
use super::inspect::no_fragment;
use super::{Outcome, Problem, print};
use crate::arguments::{Plan, Script};
use crate::terminal;

/// Prints the derivation in the selected format.
///
/// # Errors
/// The description has errors, or its equations do not determine the motion.
pub fn run(arguments: &Plan) -> Result<Outcome, Problem> {
    if arguments.fragment && arguments.format != Script::Latex {
        return Err(no_fragment());
    }
    let source = source(&arguments.described.file)?;
    let derived = determined(&source, arguments.described.motion.as_deref())?;
    let derivation = Derivation::of(derived, Shift::Efforts).map_err(|unplanned| {
        let exceeded = finiteness::of_unplanned(unplanned);
        match exceeded.has_errors() {
            true => rendered(&exceeded, &source),
            false => unopened(&Unopened::NoOrder, &source),
        }
    })?;
    let warnings = findings_of(derivation.solved());
    let warnings = warnings.map_err(|found| rendered(&found, &source))?;
    warn(&warnings, &source);
    let text = match arguments.format {
        Script::Text => derivation.text(Notation::Ascii),
        Script::Unicode => derivation.text(Notation::Unicode),
        Script::Latex if arguments.fragment => derivation.latex_fragment(),
        Script::Latex => derivation.latex(),
    };
    let text = match arguments.format {
        Script::Text | Script::Unicode => terminal::fitted(text),
        Script::Latex => text,
    };
    print(|output| output.write_all(text.as_bytes()))?;
    Ok(Outcome::Done)
}
