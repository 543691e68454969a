//! Prints a script that completes the arguments of this command in a shell.

use clap::Command;

use super::{Outcome, Problem, print};
use crate::arguments::Completions;

/// Prints the script for `interface`.
///
/// # Errors
/// Errors of stdout.
pub fn run(mut interface: Command, arguments: &Completions) -> Result<Outcome, Problem> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut interface, "linkwright", &mut script);
    print(|output| output.write_all(&script))?;
    Ok(Outcome::Done)
}
