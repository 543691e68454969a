//! *A description → its equations on stdout.*

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::emit::{self, Notation};

use super::description::{rendered, source, system, warn};
use super::{Outcome, Problem, print};
use crate::arguments::{Format, Inspect};

/// Prints Φ, Φ_q, Φ_t and γ in the chosen format.
///
/// # Errors
/// The description has errors; for Rust also where its equations do not determine the motion.
pub fn run(arguments: &Inspect) -> Result<Outcome, Problem> {
    let source = source(&arguments.file)?;
    let text = match arguments.format {
        Format::Text => emit::text::inspect(&system(&source)?, Notation::Ascii),
        Format::Unicode => emit::text::inspect(&system(&source)?, Notation::Unicode),
        Format::Latex => emit::latex::inspect(&system(&source)?),
        Format::Rust => module(&source)?,
    };
    print(|output| {
        output.write_all(text.as_bytes())?;
        match text.ends_with('\n') {
            true => Ok(()),
            false => output.write_all(b"\n"),
        }
    })?;
    Ok(Outcome::Done)
}

/// The generated module; warnings go to stderr.
///
/// # Errors
/// All errors of the description.
pub fn module(source: &Source) -> Result<String, Problem> {
    let generated = linkwright_codegen::generate(source).map_err(|it| rendered(&it, source))?;
    warn(&generated.warnings, source);
    Ok(generated.code)
}
