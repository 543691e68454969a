//! *A path → the source and its system, findings printed.* What every command begins with.

use std::fs::File;
use std::io::Read as _;
use std::path::Path;

use linkwright_codegen::diagnostic::{Diagnostics, Source};
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
    Source::from_bytes(path.display().to_string(), &bytes).map_err(|refused| {
        let (source, found) = *refused;
        rendered(&found, &source)
    })
}

/// The equations of a description; warnings go to stderr.
///
/// # Errors
/// All errors of the description, rendered.
pub fn system(source: &Source) -> Result<System, Problem> {
    let read = linkwright_codegen::read(source).map_err(|found| rendered(&found, source))?;
    warn(&read.warnings, source);
    Ok(read.system)
}

/// The equations of a description that determine its motion.
///
/// # Errors
/// All errors of the description, too few and too many equations among them.
pub fn determined(source: &Source) -> Result<System, Problem> {
    let system = system(source)?;
    linkwright_codegen::check(&system).map_err(|found| rendered(&found, source))?;
    Ok(system)
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
