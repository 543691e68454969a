//! *A path → the source and the system of each motion, findings printed.* What every command begins with.

use std::io::Read as _;
use std::path::Path;
use std::{fs, io};

use linkwright_codegen::diagnostic::{Diagnostics, Source, nearest};
use linkwright_codegen::stages::files;
use linkwright_codegen::stages::model::set;
use linkwright_codegen::stages::structure;
use linkwright_codegen::stages::system::System;
use linkwright_solver::instant::Instant;
use linkwright_solver::interpreted::Interpreted;
use linkwright_solver::mode_selection::ModeSelection;
use linkwright_solver::supplied::Modes;

use super::{Problem, say};
use crate::output::Outputs;

/// What a description is called that is read from stdin.
const STDIN: &str = "<stdin>";

/// Whether a description is to be read from stdin.
pub fn is_stdin(path: &Path) -> bool {
    path == Path::new("-")
}

/// The text of the description at `path`, under the name that was given; of `-` what stdin holds.
///
/// # Errors
/// The file cannot be read, or it is not UTF-8.
pub fn text(path: &Path) -> Result<Source, Problem> {
    let (name, bytes) = match is_stdin(path) {
        true => (STDIN.to_string(), from_stdin()),
        false => {
            let name = path.display().to_string();
            (name, files::read(path, Source::LARGEST))
        }
    };
    let bytes = bytes.map_err(|error| unreadable(path, &error))?;
    Source::from_bytes(name, &bytes).map_err(|refused| {
        let (source, found) = *refused;
        rendered(&found, &source)
    })
}

/// All that stdin holds; of more than is read, one byte more than that.
fn from_stdin() -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut limited = io::stdin().lock().take(Source::LARGEST as u64 + 1);
    limited.read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// The same with the tables that it names.
///
/// # Errors
/// Those of [`text`].
pub fn source(path: &Path) -> Result<Source, Problem> {
    let source = text(path)?;
    Ok(linkwright_codegen::attach_files(
        source,
        files::folder_of(path),
    ))
}

/// The files that a command writes besides those that it reads: the description, and the tables that it names.
pub fn outputs(path: &Path, source: &Source, is_forced: bool) -> Outputs {
    outputs_besides(path, source, None, is_forced)
}

/// The same where the command reads one more file.
pub fn outputs_besides(
    path: &Path,
    source: &Source,
    other: Option<&Path>,
    is_forced: bool,
) -> Outputs {
    let folder = files::folder_of(path);
    let tables = source.attachments.iter().map(|it| folder.join(&it.path));
    let other = other.into_iter().map(Path::to_path_buf);
    Outputs::of(path, other.chain(tables).collect(), is_forced)
}

/// Why a description cannot be read; of a folder, a description in it.
fn unreadable(path: &Path, error: &io::Error) -> Problem {
    let shown = path.display();
    let reason = files::reason(error);
    let help = match fs::read_dir(path) {
        Ok(entries) => {
            let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
            let example = paths
                .filter(|it| it.extension().is_some_and(|it| it == "mech"))
                .min();
            match example {
                Some(example) => {
                    format!("name a description in it, such as `{}`", example.display())
                }
                None => "name a description, a `.mech` file".to_string(),
            }
        }
        Err(_) if path.exists() && !path.is_file() => {
            "a description is a regular file, and its tables lie beside it".to_string()
        }
        Err(_) => return Problem(format!("error: cannot read `{shown}`: {reason}")),
    };
    Problem(format!(
        "error: cannot read `{shown}`: {reason}\n  = help: {help}"
    ))
}

/// Carries out the assignments of `--set`.
///
/// # Errors
/// One of them cannot be.
pub fn set_all(system: &mut System, assignments: &[String]) -> Result<(), Problem> {
    let mut assignments = assignments.iter();
    assignments.try_for_each(|it| set(&mut system.mechanism, it).map_err(Problem))
}

/// The equations of every motion of a description, or of the one that is wanted; warnings go to stderr.
///
/// # Errors
/// All errors of the description, rendered; no motion of the wanted name.
pub fn motions(source: &Source, wanted: Option<&str>) -> Result<Vec<System>, Problem> {
    let mut warnings = Diagnostics::new();
    let motions = read(source, wanted, &mut warnings);
    warn(&warnings, source);
    motions
}

/// The same; warnings are given.
fn read(
    source: &Source,
    wanted: Option<&str>,
    warnings: &mut Diagnostics,
) -> Result<Vec<System>, Problem> {
    let read = linkwright_codegen::read(source).map_err(|found| rendered(&found, source))?;
    warnings.extend(read.warnings.clone());
    match wanted {
        None => Ok(read.motions),
        Some(name) => match read.motion(name) {
            Some(system) => Ok(vec![system.clone()]),
            None => Err(no_motion(name, &read.motions)),
        },
    }
}

/// The equations of the wanted motion of a description, or of its only one, which determine the motion; warnings go to stderr.
///
/// # Errors
/// All errors of the description, too few and too many equations among them; several motions where none is named.
pub fn determined(source: &Source, wanted: Option<&str>) -> Result<System, Problem> {
    let mut warnings = Diagnostics::new();
    let system = determined_with(source, wanted, &mut warnings);
    warn(&warnings, source);
    system
}

/// The same; warnings are given.
///
/// # Errors
/// Those of [`determined`].
pub fn determined_with(
    source: &Source,
    wanted: Option<&str>,
    warnings: &mut Diagnostics,
) -> Result<System, Problem> {
    let mut motions = read(source, wanted, warnings)?;
    if motions.len() > 1 {
        return Err(several(source, &motions));
    }
    // There is always one.
    let system = motions.remove(0);
    let mut found = Diagnostics::new();
    let is_determined = structure::analyze(&system, &mut found);
    let found = found.respelled(&system.mechanism.spellings);
    match is_determined {
        true => warnings.extend(found),
        false => return Err(rendered(&found, source)),
    }
    Ok(system)
}

/// The blocks of a system; warnings go to stderr.
///
/// # Errors
/// Numbers in them become infinite or undefined, or there is no order in which they could be solved.
pub fn interpreted(system: &System, source: &Source, path: &Path) -> Result<Interpreted, Problem> {
    let mut warnings = Diagnostics::new();
    let interpreted = interpreted_with(system, source, path, &mut warnings);
    warn(&warnings, source);
    interpreted
}

/// The same; warnings are given.
///
/// # Errors
/// Those of [`interpreted`].
pub fn interpreted_with(
    system: &System,
    source: &Source,
    path: &Path,
    warnings: &mut Diagnostics,
) -> Result<Interpreted, Problem> {
    let (interpreted, found) =
        Interpreted::checked(system).map_err(|found| rendered(&found, source))?;
    warnings.extend(found);
    interpreted.ok_or_else(|| no_order(path))
}

/// The pose and the modes that are wished for by `LOOP=MODE`, where some are.
///
/// # Errors
/// A wish cannot be read, or there is no such assembly.
pub fn chosen(
    wished: &[String],
    interpreted: &Interpreted,
    t: f64,
) -> Result<Option<(Instant, Modes)>, Problem> {
    if wished.is_empty() {
        return Ok(None);
    }
    let wishes = ModeSelection::read(interpreted, wished);
    let wishes = wishes.map_err(|text| Problem(format!("error: {text}")))?;
    let assembled = wishes.assembled(interpreted, t).map_err(|reason| {
        let explained = reason.explained(interpreted);
        Problem(format!(
            "error: the mechanism cannot be assembled in this mode: {explained}"
        ))
    });
    assembled.map(Some)
}

/// That a mechanism has no order in which its blocks could be solved.
pub fn no_order(path: &Path) -> Problem {
    Problem(format!(
        "error: the equations of `{}` determine the motion, but no order in which they can be solved one block after the other",
        path.display()
    ))
}

/// The names of the motions in backticks.
fn names(motions: &[System]) -> Vec<String> {
    let named = motions
        .iter()
        .filter_map(|system| system.mechanism.motion.as_ref());
    named.map(|motion| format!("`{}`", motion.name)).collect()
}

/// That one of several motions is to be named.
pub fn several(source: &Source, motions: &[System]) -> Problem {
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
