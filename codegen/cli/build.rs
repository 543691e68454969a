//! Says of which commit the command is built, where that is known: `LINKWRIGHT_COMMIT` is ` (0123456789ab)`, or nothing in a build
//! from a package.

use std::path::Path;
use std::process::Command;

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let repository = Path::new("../..");
    // A package may be unpacked anywhere, also inside another repository.
    let is_clone = repository.join(".git").exists() && repository.join("codegen/cli").is_dir();
    let commit = match is_clone {
        true => git(&["rev-parse", "--short=12", "HEAD"]),
        false => None,
    };
    let suffix = commit.map_or(String::new(), |commit| format!(" ({commit})"));
    println!("cargo::rustc-env=LINKWRIGHT_COMMIT={suffix}");
    if !is_clone {
        return;
    }
    // What changes with a commit: which one is checked out, and what its branch is.
    let branch = git(&["symbolic-ref", "--quiet", "HEAD"]);
    let places = ["HEAD", "packed-refs"].map(String::from);
    for place in places.into_iter().chain(branch) {
        let path = git(&["rev-parse", "--git-path", &place]);
        if let Some(path) = path.filter(|path| Path::new(path).exists()) {
            println!("cargo::rerun-if-changed={path}");
        }
    }
}

/// Output of git in one line; empty if it fails.
fn git(arguments: &[&str]) -> Option<String> {
    let ran = Command::new("git").args(arguments).output().ok()?;
    let text = String::from_utf8(ran.stdout).ok()?;
    let text = text.trim();
    (ran.status.success() && !text.is_empty()).then(|| text.to_string())
}
