//! Serves an editor on stdin and stdout; [`language_server`](crate::language_server) makes the answers.

use super::{Outcome, Problem};
use crate::language_server::serve;

/// Serves the editor until it closes the connection.
///
/// # Errors
/// Stdout is closed.
pub fn run() -> Result<Outcome, Problem> {
    match serve().map_err(Problem::of)? {
        true => Ok(Outcome::Done),
        false => Ok(Outcome::Failed),
    }
}
