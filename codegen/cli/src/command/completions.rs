//! *The arguments of this command → a script that completes them in a shell*, on stdout.

use clap::CommandFactory as _;

use super::{Outcome, Problem, print};
use crate::arguments::{Arguments, Completions};

/// Prints the script.
///
/// # Errors
/// Those of stdout.
pub fn run(arguments: &Completions) -> Result<Outcome, Problem> {
    let mut script = Vec::new();
    clap_complete::generate(
        arguments.shell,
        &mut Arguments::command(),
        "linkwright",
        &mut script,
    );
    print(|output| output.write_all(&script))?;
    Ok(Outcome::Done)
}
