//! *The arguments of this command → a script that completes them in a shell*, on stdout.

use clap::Command;

use super::{Outcome, Problem, print};
use crate::arguments::Completions;

/// Prints the script for `interface`.
///
/// # Errors
/// Those of stdout.
pub fn run(mut interface: Command, arguments: &Completions) -> Result<Outcome, Problem> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut interface, "linkwright", &mut script);
    print(|output| output.write_all(&script))?;
    Ok(Outcome::Done)
}
