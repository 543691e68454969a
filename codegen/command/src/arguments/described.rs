//! Defines the arguments that select a motion of a description.

use std::path::PathBuf;

use clap::Args;

/// A motion of a description.
#[derive(Args, Debug)]
pub struct Described {
    /// The description, a `.mech` file; `-` is stdin
    pub file: PathBuf,
    /// Which motion, where the mechanism has several
    #[arg(long, value_name = "NAME")]
    pub motion: Option<String>,
}
