//! Finds the travel of a drive.

use linkwright_solver::number::time;
use linkwright_solver::travel::{Drive, Immovable, Travel};

use super::description::{determined, set_all, source};
use super::{Outcome, Problem, print, say};
use crate::arguments::Travel as Arguments;
use crate::progress::Progress;
use crate::report::{travel_json, travel_text};
use crate::terminal;

/// Number of steps of two ways of a full turn each, which the progress bar expects.
const EXPECTED_STEPS: usize = 720;

/// Follows the drive both ways and reports the ends.
///
/// # Errors
/// The description has errors, its equations do not determine the motion, or an option cannot be used. An [`Outcome`] reports a
/// mechanism that cannot be assembled.
pub fn run(arguments: &Arguments) -> Result<Outcome, Problem> {
    let source =
        source(&arguments.described.file)?.reported_in(arguments.reported_in.units.clone());
    let derived = determined(&source, arguments.described.motion.as_deref())?;
    let derived = set_all(derived, &arguments.set)?;
    let mechanism = &derived.system.mechanism;
    let drive = Drive::named(mechanism, &arguments.drive)
        .map_err(|[message, help]| Problem(format!("error: {message}\n  = help: {help}")))?;
    let unit = mechanism.units.of_messages().of(drive.si());
    let mut progress = Progress::new(EXPECTED_STEPS);
    let travel = Travel::new(
        &derived,
        &drive,
        arguments.at,
        &unit,
        arguments.prove,
        |count| progress.reached(count),
    );
    progress.finish();
    let title = mechanism.title();
    let travel = match travel {
        Ok(travel) => travel,
        Err(Immovable::Unsolvable) => {
            return Err(Problem(format!(
                "error: the equations of `{title}` cannot be solved with `{}` as an input",
                drive.name
            )));
        }
        Err(Immovable::NotAssembled(reason)) => {
            let t = time(arguments.at);
            say(&format!(
                "error: `{title}` cannot be assembled in the design modes at t = {t} s: {reason}"
            ));
            return Ok(Outcome::Failed);
        }
    };
    let is_unproven = travel.ends.iter().filter_map(|it| it.proof.as_ref());
    let is_unproven = is_unproven.clone().any(|it| it.proven.is_none());
    print(|output| match arguments.json {
        true => travel_json::write(&travel, &derived.system, output),
        false => {
            let mut text = Vec::new();
            travel_text::write(&travel, &derived.system, arguments.at, &mut text)?;
            let text = String::from_utf8_lossy(&text).into_owned();
            output.write_all(terminal::fitted(text).as_bytes())
        }
    })?;
    Ok(match is_unproven {
        true => Outcome::Failed,
        false => Outcome::Done,
    })
}
