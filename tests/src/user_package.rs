//! Runs cargo in a user's package, and returns its output.

use std::path::Path;
use std::process::{Command, Output};

/// Cargo in a package, with a command of several words; `target` is where it builds.
///
/// # Panics
/// If cargo cannot be started.
pub fn cargo(package: &Path, target: &Path, command: &str) -> Output {
    let mut words = command.split_whitespace();
    Command::new(env!("CARGO"))
        .args(words.next())
        .args(["--offline", "--manifest-path"])
        .arg(package.join("Cargo.toml"))
        .arg("--target-dir")
        .arg(target)
        .args(words)
        .env("CARGO_TERM_COLOR", "never")
        .env("RUSTDOCFLAGS", "--deny warnings")
        .output()
        .expect("cargo runs")
}
