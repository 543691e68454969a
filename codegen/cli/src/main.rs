//! The command `linkwright`: see [`linkwright_command`], whose features are those of this package.

use std::process::ExitCode;

/// Version, with the commit of a clone.
const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), env!("LINKWRIGHT_COMMIT"));

fn main() -> ExitCode {
    linkwright_command::run(VERSION)
}
