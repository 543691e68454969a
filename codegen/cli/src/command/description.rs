//! *A path → the source and the system of each motion, findings printed.* What every command begins with.

use std::fs::File;
use std::io::Read as _;
use std::path::Path;

use linkwright_codegen::diagnostic::{Diagnostics, Source, nearest};
use linkwright_codegen::system::System;

use super::{Problem, say};
use crate::file::FileError;

/// The text of the description at `path`, under the name that was given.
///
/// # Errors
/// The file cannot be read, is too large to be a description, or is not UTF-8.
pub fn source(path: &Path) -> Result<Source, Problem> {
    let mut bytes = Vec::new();
    // One byte more than allowed is enough to know that there are too many.
    let read = File::open(path).and_then(|file| {
        file.take(Source::LARGEST as u64 + 1)
            .read_to_end(&mut bytes)
    });
    if let Err(cause) = read {
        return Err(Problem::from(FileError {
            action: "read",
            path: path.to_path_buf(),
            cause,
        }));
    }
    if bytes.len() > Source::LARGEST {
        return Err(Problem(format!(
            "error: `{}` is larger than {} bytes: it is no description",
            path.display(),
            Source::LARGEST
        )));
    }
    let source = Source::from_bytes(path.display().to_string(), &bytes).map_err(|refused| {
        let (source, found) = *refused;
        rendered(&found, &source)
    })?;
    let folder = path.parent().unwrap_or(Path::new(""));
    Ok(linkwright_codegen::attach_files(source, folder))
}

/// The equations of every motion of a description, or of the one that is wanted; warnings go to stderr.
///
/// # Errors
/// All errors of the description, rendered; no motion of the wanted name.
pub fn motions(source: &Source, wanted: Option<&str>) -> Result<Vec<System>, Problem> {
    let read = linkwright_codegen::read(source).map_err(|found| rendered(&found, source))?;
    warn(&read.warnings, source);
    match wanted {
        None => Ok(read.motions),
        Some(name) => match read.motion(name) {
            Some(system) => Ok(vec![system.clone()]),
            None => Err(no_motion(name, &read.motions)),
        },
    }
}

/// The equations of the wanted motion of a description, or of its only one, which determine the motion.
///
/// # Errors
/// All errors of the description, too few and too many equations among them; several motions where none is named.
pub fn determined(source: &Source, wanted: Option<&str>) -> Result<System, Problem> {
    let mut motions = motions(source, wanted)?;
    if motions.len() > 1 {
        return Err(several(source, &motions));
    }
    // There is always one.
    let system = motions.remove(0);
    linkwright_codegen::check(&system).map_err(|found| rendered(&found, source))?;
    Ok(system)
}

/// The names of the motions in backticks.
fn names(motions: &[System]) -> Vec<String> {
    let named = motions
        .iter()
        .filter_map(|system| system.mechanism.motion.as_ref());
    named.map(|motion| format!("`{}`", motion.name)).collect()
}

fn several(source: &Source, motions: &[System]) -> Problem {
    let first = motions
        .iter()
        .find_map(|system| system.mechanism.motion.as_ref())
        .map_or("NAME", |motion| motion.name.as_str());
    Problem(format!(
        "error: `{}` has {} motions: {}\n  = help: name one of them, for example `--motion {first}`",
        source.name,
        motions.len(),
        names(motions).join(", ")
    ))
}

fn no_motion(wanted: &str, motions: &[System]) -> Problem {
    let names = names(motions);
    if names.is_empty() {
        return Problem(
            "error: the mechanism has no motions\n  = help: leave out `--motion`".to_string(),
        );
    }
    let bare = names.iter().map(|name| name.trim_matches('`'));
    let help = match nearest(wanted, bare) {
        Some(meant) => format!("did you mean `{meant}`?"),
        None => format!("the motions are {}", names.join(", ")),
    };
    Problem(format!(
        "error: no motion is named `{wanted}`\n  = help: {help}"
    ))
}

/// Prints findings that stop nothing.
pub fn warn(found: &Diagnostics, source: &Source) {
    if !found.is_empty() {
        say(&found.render(source));
    }
}

/// Findings as the end of a command.
pub fn rendered(found: &Diagnostics, source: &Source) -> Problem {
    Problem(found.render(source))
}
