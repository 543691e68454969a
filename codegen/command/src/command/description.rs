//! Reads a description and the systems of its motions, and prints findings. Most commands begin with this.

use std::io::Read as _;
use std::path::Path;
use std::{fs, io};

use linkwright_codegen::diagnostic::{Diagnostics, Source};
use linkwright_codegen::stages::files;
use linkwright_codegen::stages::model::set;
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::opened::{self, Unopened};
use linkwright_solver::{Instant, Interpreted, ModeSelection, Modes};

use super::{Problem, say};
use crate::output::Outputs;

/// Name in messages of a description from stdin.
const STDIN: &str = "<stdin>";

/// True if the path stands for stdin.
pub fn is_stdin(path: &Path) -> bool {
    path == Path::new("-")
}

/// Returns the text of the description at `path`, under this name; the contents of stdin if the path is `-`.
///
/// # Errors
/// The file cannot be read, or it is not UTF-8.
pub fn text(path: &Path) -> Result<Source, Problem> {
    let (name, bytes) = match is_stdin(path) {
        true => (STDIN.to_string(), from_stdin()),
        false => {
            let name = path.display().to_string();
            (name, files::read(path, Source::MAX_BYTES))
        }
    };
    let bytes = bytes.map_err(|error| unreadable(path, &error))?;
    Source::from_bytes(name, &bytes).map_err(|refused| {
        let (source, found) = *refused;
        rendered(&found, &source)
    })
}

/// Reads stdin, at most one byte more than the largest description.
fn from_stdin() -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut limited = io::stdin().lock().take(Source::MAX_BYTES as u64 + 1);
    limited.read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Returns the description at `path` with the tables that it names.
///
/// # Errors
/// Errors of [`text`].
pub fn source(path: &Path) -> Result<Source, Problem> {
    let source = text(path)?;
    Ok(linkwright_codegen::stages::files::attach_files(
        source,
        files::folder_of(path),
    ))
}

/// Creates the set of output files of a command that reads the description and its tables.
pub fn outputs(path: &Path, source: &Source, is_forced: bool) -> Outputs {
    outputs_besides(path, source, None, is_forced)
}

/// Creates the set of output files of a command that reads `besides` as well.
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

/// Returns the error of a description that cannot be read; of a folder, its help names a description in it.
fn unreadable(path: &Path, error: &io::Error) -> Problem {
    let name = path.display();
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
        Err(_) => return Problem(format!("error: cannot read `{name}`: {reason}")),
    };
    Problem(format!(
        "error: cannot read `{name}`: {reason}\n  = help: {help}"
    ))
}

/// Applies the assignments of `--set`.
///
/// # Errors
/// An assignment cannot be applied.
pub fn set_all(derived: Derived, assignments: &[String]) -> Result<Derived, Problem> {
    let Derived {
        mut pool,
        mut system,
    } = derived;
    for assignment in assignments {
        set(&mut pool, &mut system.mechanism, "--set", assignment).map_err(Problem)?;
    }
    Ok(Derived { pool, system })
}

/// Returns the equations of each motion of a description, or of the motion `wanted`; prints warnings on stderr.
///
/// # Errors
/// All errors of the description, rendered; or an unknown name of a motion.
pub fn motions(source: &Source, wanted: Option<&str>) -> Result<Vec<Derived>, Problem> {
    let mut warnings = Diagnostics::new();
    let motions = opened::named(source, wanted, &mut warnings);
    warn(&warnings, source);
    motions.map_err(|reason| unopened(&reason, source))
}

/// Returns the equations of a motion, named or the only one, if they determine it; prints warnings on stderr.
///
/// # Errors
/// All errors of the description, with surplus and missing equations; or several motions without a selection.
pub fn determined(source: &Source, wanted: Option<&str>) -> Result<Derived, Problem> {
    let mut warnings = Diagnostics::new();
    let derived = determined_with(source, wanted, &mut warnings);
    warn(&warnings, source);
    derived
}

/// Returns the equations as [`determined`] does, and collects warnings.
///
/// # Errors
/// Errors of [`determined`].
pub fn determined_with(
    source: &Source,
    wanted: Option<&str>,
    warnings: &mut Diagnostics,
) -> Result<Derived, Problem> {
    opened::determined(source, wanted, warnings).map_err(|reason| unopened(&reason, source))
}

/// Returns the equations of a motion that [`determined`] has found, with the sensitivities to these parameters alone.
///
/// # Errors
/// Errors of the description.
#[cfg(feature = "calibrate")]
pub fn along(
    source: &Source,
    motion: Option<&str>,
    parameters: &[&str],
) -> Result<Derived, Problem> {
    let read = linkwright_codegen::Read::along(source, parameters);
    let read = read.map_err(|found| rendered(&found, source))?;
    let derived = match motion {
        Some(name) => read.motion(name).cloned(),
        None => read.only(),
    };
    // Names of motions were checked before.
    derived.ok_or_else(|| unopened(&Unopened::NoOrder, source))
}

/// Returns the blocks of a system; prints warnings on stderr.
///
/// # Errors
/// Numbers in the blocks become infinite or undefined, or the blocks have no order of solution.
pub fn interpreted(derived: &Derived, source: &Source) -> Result<Interpreted, Problem> {
    let mut warnings = Diagnostics::new();
    let interpreted = opened::solvable(derived, &mut warnings);
    warn(&warnings, source);
    interpreted.map_err(|reason| unopened(&reason, source))
}

/// Returns the blocks of a mechanism that is drawn at `t` (s), even if its loops cannot close there, and collects warnings.
///
/// # Errors
/// Errors of [`interpreted`] for all other mechanisms.
pub fn drawable(
    derived: &Derived,
    source: &Source,
    t: f64,
    warnings: &mut Diagnostics,
) -> Result<Interpreted, Problem> {
    opened::drawable(derived, t, warnings).map_err(|reason| unopened(&reason, source))
}

/// Returns the pose and the modes that `LOOP=MODE` selects; `None` without such options.
///
/// # Errors
/// An option cannot be read, or selects no assembly.
pub fn chosen(
    wished: &[String],
    interpreted: &Interpreted,
    t: f64,
) -> Result<Option<(Instant, Modes)>, Problem> {
    if wished.is_empty() {
        return Ok(None);
    }
    assembled(&selected(wished, interpreted)?, interpreted, t).map(Some)
}

/// Reads `LOOP=MODE` of each option.
///
/// # Errors
/// An option cannot be read.
pub fn selected(wished: &[String], interpreted: &Interpreted) -> Result<ModeSelection, Problem> {
    ModeSelection::read(interpreted, wished).map_err(|text| Problem(format!("error: {text}")))
}

/// Returns the pose and the modes of a selection.
///
/// # Errors
/// The selection has no assembly.
pub fn assembled(
    selection: &ModeSelection,
    interpreted: &Interpreted,
    t: f64,
) -> Result<(Instant, Modes), Problem> {
    selection.assembled(interpreted, t).map_err(|reason| {
        let explained = reason.explained(interpreted);
        Problem(format!(
            "error: the mechanism cannot be assembled in this mode: {explained}"
        ))
    })
}

/// Returns the error of a description that cannot be solved, with the option that helps.
pub fn unopened(reason: &Unopened, source: &Source) -> Problem {
    let (message, help) = match reason.message(&source.name) {
        Ok(message) => message,
        Err(findings) => return rendered(findings, source),
    };
    let help = match reason {
        Unopened::Several(names) => {
            let first = names.first().map_or("NAME", String::as_str);
            Some(format!("name one of them, for example `--motion {first}`"))
        }
        Unopened::NoMotion { motions, .. } if motions.is_empty() => {
            Some("leave out `--motion`".to_string())
        }
        _ => help,
    };
    let help = help.map_or(String::new(), |help| format!("\n  = help: {help}"));
    Problem(format!("error: {message}{help}"))
}

/// Prints warnings.
pub fn warn(found: &Diagnostics, source: &Source) {
    if !found.is_empty() {
        say(&found.render(source));
    }
}

/// Returns findings as the error that ends a command.
pub fn rendered(found: &Diagnostics, source: &Source) -> Problem {
    Problem(found.render(source))
}
