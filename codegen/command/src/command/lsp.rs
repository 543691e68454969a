//! *An editor on stdin and stdout → its answers.* What is said is made by [`language_server`](crate::language_server).

use super::{Outcome, Problem};
use crate::language_server::serve;

/// Serves the editor until it goes.
///
/// # Errors
/// Nobody reads the answers.
pub fn run() -> Result<Outcome, Problem> {
    match serve().map_err(Problem::of)? {
        true => Ok(Outcome::Done),
        false => Ok(Outcome::Failed),
    }
}
