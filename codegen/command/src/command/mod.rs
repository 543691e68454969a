//! Runs the commands, one file each: prints, writes files and returns an exit code.
//!
//! Results go to stdout, findings and errors to stderr. A reader of stdout that closes its pipe early does not cause an error. Input that
//! cannot be processed ends as a [`Problem`], printed once, with exit code 2.

pub mod animate;
mod animation_format;
#[cfg(feature = "calibrate")]
mod bounds;
#[cfg(feature = "calibrate")]
pub mod calibrate;
pub mod check;
pub mod compare;
pub mod completions;
pub mod description;
pub mod draw;
pub mod equilibrium;
pub mod fmt;
pub mod generate;
pub mod inspect;
pub mod left_out;
mod live;
#[cfg(feature = "lsp")]
pub mod lsp;
#[cfg(feature = "man")]
pub mod man;
pub mod new;
mod picture_format;
pub mod plan;
mod report;
#[cfg(feature = "calibrate")]
mod rewritten;
pub mod simulate;
pub mod solve;
mod solve_files;
pub mod sweep;
mod sweep_files;
#[cfg(feature = "calibrate")]
pub mod synthesize;
pub mod tolerance;
pub mod travel;
mod travel_region;
pub mod view;
pub mod watch;

use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::thread;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{CommandFactory as _, FromArgMatches as _};

use linkwright_codegen::diagnostic::internal::{self, InternalError};

use crate::arguments::{Arguments, Command, units};
use crate::colors;
use crate::output::Refused;

/// Licenses of the components of the command; a test of the binary writes them.
const NOTICES: &str = include_str!("../../NOTICES.txt");

/// Returns the requested number of threads; without a request as many as the machine has.
fn threads(requested: Option<u16>) -> usize {
    let available = || thread::available_parallelism().map_or(1, usize::from);
    requested.map_or_else(available, usize::from)
}

/// Outcome of a command; the discriminant is the exit code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The command succeeded.
    Done = 0,
    /// The mechanism cannot be solved, or a file does not have the expected contents.
    Failed = 1,
}

/// Input that a command cannot process: the printed message, without a closing line break.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem(pub String);

impl From<Refused> for Problem {
    fn from(refused: Refused) -> Self {
        Problem(format!("error: {refused}"))
    }
}

impl Problem {
    /// Converts an error of writing.
    pub fn of(error: io::Error) -> Problem {
        Problem(format!("error: {error}"))
    }
}

/// Runs the command that the arguments of the process name, and prints the reason of a refusal.
///
/// `--version` and manual pages print `version`. The binary passes it, because it changes with every commit.
pub fn run(version: &'static str) -> ExitCode {
    let interface = Arguments::command().version(version);
    let matches = interface.clone().try_get_matches();
    let matches = matches.unwrap_or_else(|error| units_apart(error).exit());
    let arguments = Arguments::from_arg_matches(&matches)
        .unwrap_or_else(|error| error.format(&mut interface.clone()).exit());
    internal::note_panics();
    ended(internal::caught(|| match arguments.command {
        Some(command) => outcome(command, interface),
        None => {
            print(|output| output.write_all(NOTICES.as_bytes()))?;
            Ok(Outcome::Done)
        }
    }))
}

/// Adds a help on the syntax of units if a list of units was taken for another argument.
fn units_apart(mut error: clap::Error) -> clap::Error {
    let unexpected = match error.get(ContextKind::InvalidArg) {
        Some(ContextValue::String(text)) if error.kind() == ErrorKind::UnknownArgument => text,
        _ => return error,
    };
    if units(unexpected).is_ok() && std::env::args_os().any(|it| it == "--units") {
        let tip = format!("write the list behind `=`: `--units={unexpected}`");
        let tips = ContextValue::StyledStrs(vec![tip.into()]);
        error.insert(ContextKind::Suggested, tips);
    }
    error
}

fn outcome(command: Command, interface: clap::Command) -> Result<Outcome, Problem> {
    match command {
        Command::Solve(solve) => solve::run(&solve),
        Command::Simulate(simulate) => simulate::run(&simulate),
        Command::Sweep(sweep) => sweep::run(&sweep),
        Command::Tolerance(tolerance) => tolerance::run(&tolerance),
        Command::Draw(draw) if draw.animate => animate::run(&draw),
        Command::Draw(draw) => draw::run(&draw),
        Command::View(view) => view::run(&view),
        Command::Generate(generate) => generate::run(&generate),
        Command::Inspect(inspect) => inspect::run(&inspect),
        Command::Plan(plan) => plan::run(&plan),
        Command::Check(check) => check::run(&check),
        Command::Travel(travel) => travel::run(&travel),
        Command::Equilibrium(equilibrium) => equilibrium::run(&equilibrium),
        Command::Compare(compare) => compare::run(&compare),
        #[cfg(feature = "calibrate")]
        Command::Calibrate(calibrate) => calibrate::run(&calibrate),
        #[cfg(not(feature = "calibrate"))]
        Command::Calibrate(_) => Err(left_out::refusal("calibrate", "fits parameters")),
        #[cfg(feature = "calibrate")]
        Command::Synthesize(synthesize) => synthesize::run(&synthesize),
        #[cfg(not(feature = "calibrate"))]
        Command::Synthesize(_) => Err(left_out::refusal("calibrate", "chooses parameters")),
        Command::Fmt(fmt) => fmt::run(&fmt),
        Command::New(new) => new::run(&new),
        #[cfg(feature = "lsp")]
        Command::Lsp(_) => lsp::run(),
        #[cfg(not(feature = "lsp"))]
        Command::Lsp(_) => Err(left_out::refusal("lsp", "serves editors")),
        Command::Completions(completions) => completions::run(interface, &completions),
        #[cfg(feature = "man")]
        Command::Man(man) => man::run(interface, &man),
        #[cfg(not(feature = "man"))]
        Command::Man(_) => Err(left_out::refusal("man", "writes manual pages")),
    }
}

/// Returns the exit code of a command, after printing a refusal or an internal error.
fn ended(outcome: Result<Result<Outcome, Problem>, InternalError>) -> ExitCode {
    match outcome {
        Ok(Ok(outcome)) => ExitCode::from(outcome as u8),
        Ok(Err(Problem(text))) => {
            say(&text);
            ExitCode::from(2)
        }
        Err(error) => {
            say(&error.to_string());
            // `EX_SOFTWARE` of `sysexits.h`.
            ExitCode::from(70)
        }
    }
}

/// Writes to stdout.
///
/// # Errors
/// Errors of stdout, except for a closed pipe.
pub fn print(write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), Problem> {
    let mut output = BufWriter::new(io::stdout().lock());
    match write(&mut output).and_then(|()| output.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(Problem(format!("error: cannot write to stdout: {error}")))
        }
        _ => {
            // The buffered rest must not be written to the closed pipe.
            let _ = output.into_parts();
            Ok(())
        }
    }
}

/// Returns the path of a file in a folder for pictures.
///
/// # Errors
/// The folder is `-`, which stands for stdout in other options.
pub fn in_folder(folder: &Path, name: &str) -> Result<PathBuf, Problem> {
    match folder == Path::new("-") {
        true => Err(Problem(
            "error: `--plot` takes a folder, and `-` is stdout".to_string(),
        )),
        false => Ok(folder.join(name)),
    }
}

/// Writes a line to stderr; an error is ignored because stderr is the place for errors.
pub fn say(text: &str) {
    let text = colors::on_terminal(text.trim_end_matches('\n'));
    let _ = writeln!(io::stderr(), "{text}");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_of_linkwright_itself_is_no_bad_input() {
        let code = |outcome| format!("{:?}", ended(outcome));
        let exit = |number: u8| format!("{:?}", ExitCode::from(number));
        assert_eq!(code(internal::caught(|| panic!("a defect"))), exit(70));
        assert_eq!(code(Ok(Err(Problem("bad".to_string())))), exit(2));
        assert_eq!(code(Ok(Ok(Outcome::Failed))), exit(1));
    }
}
