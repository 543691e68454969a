//! Defines the arguments that select a motion of a description.

use std::path::PathBuf;

use clap::Args;

/// A motion of a description.
#[derive(Args, Debug)]
pub struct Described {
    /// Description, a `.mech` file; `-` is stdin
    pub file: PathBuf,
    /// Motion to use if the mechanism has several
    #[arg(long, value_name = "NAME")]
    pub motion: Option<String>,
}
