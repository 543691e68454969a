//! Formats descriptions in their files or on stdout.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use linkwright_codegen::stages::files;

use super::description::{is_stdin, rendered, text};
use super::{Outcome, Problem, print, say};
use crate::arguments::Fmt;
use crate::output::replaceable;

/// Formats every file, also those after a file that cannot be read.
///
/// # Errors
/// The error of the last file that cannot be read or written; earlier errors are printed.
pub fn run(arguments: &Fmt) -> Result<Outcome, Problem> {
    let mut outcome = Outcome::Done;
    let mut problem = None;
    for place in &arguments.files {
        if !arguments.check && !is_stdin(place) {
            files::sweep(match place.is_dir() {
                true => place,
                false => files::folder_of(place),
            });
        }
        for path in descriptions(place)? {
            match formatted(&path, arguments.check) {
                Ok(Outcome::Done) => {}
                Ok(Outcome::Failed) => outcome = Outcome::Failed,
                Err(Problem(text)) => {
                    if let Some(Problem(text)) = problem.replace(Problem(text)) {
                        say(&text);
                    }
                }
            }
        }
    }
    problem.map_or(Ok(outcome), Err)
}

/// Returns the file itself, or the descriptions in a folder, by name.
fn descriptions(place: &Path) -> Result<Vec<PathBuf>, Problem> {
    if !place.is_dir() {
        return Ok(vec![place.to_path_buf()]);
    }
    let unreadable = |error: io::Error| {
        let reason = files::reason(&error);
        Problem(format!(
            "error: cannot read `{}`: {reason}",
            place.display()
        ))
    };
    let mut paths = Vec::new();
    for entry in fs::read_dir(place).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        let is_hidden = path
            .file_name()
            .is_some_and(|it| it.as_encoded_bytes().starts_with(b"."));
        if path.extension().is_some_and(|it| it == "mech") && !is_hidden && path.is_file() {
            paths.push(path);
        }
    }
    paths.sort();
    match paths.is_empty() {
        true => Err(Problem(format!(
            "error: the folder `{}` holds no `.mech` file",
            place.display()
        ))),
        false => Ok(paths),
    }
}

/// Formats one file, or reports that it is not formatted.
fn formatted(path: &Path, is_check: bool) -> Result<Outcome, Problem> {
    let source = text(path)?;
    let formatted = linkwright_codegen::format(&source);
    let formatted = formatted.map_err(|found| rendered(&found, &source))?;
    let is_same = formatted == source.text;
    if is_check {
        if is_same {
            return Ok(Outcome::Done);
        }
        let help = match is_stdin(path) {
            true => String::new(),
            false => format!("\n  = help: run `linkwright fmt {}`", path.display()),
        };
        say(&format!("error: `{}` is not formatted{help}", source.name));
        return Ok(Outcome::Failed);
    }
    if is_stdin(path) {
        print(|output| output.write_all(formatted.as_bytes()))?;
    } else if !is_same {
        replaceable(path)?;
        files::replace(path, |output| output.write_all(formatted.as_bytes())).map_err(|error| {
            let reason = files::reason(&error);
            Problem(format!(
                "error: cannot write `{}`: {reason}",
                path.display()
            ))
        })?;
    }
    Ok(Outcome::Done)
}
