//! The command `linkwright`: see [`linkwright_cli`].

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    linkwright_cli::command::run(linkwright_cli::arguments::Arguments::parse())
}
