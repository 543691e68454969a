//! Finds the travel of a drive.

use linkwright_codegen::stages::model::Mechanism;
use linkwright_solver::number::time;
use linkwright_solver::travel::{Drive, Immovable, Travel};

use super::description::{determined, set_all, source};
use super::{Outcome, Problem, print, say, travel_region};
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
    let drives = arguments.drive.iter().map(|name| {
        let drive = Drive::named(mechanism, name);
        drive.map_err(|[message, help]| Problem(format!("error: {message}\n  = help: {help}")))
    });
    let drives: Vec<Drive> = drives.collect::<Result<_, _>>()?;
    let followed = match <[Drive; 2]>::try_from(drives) {
        Ok(drives) if drives[0] == drives[1] => Err("name two different drives"),
        Ok(drives) => return travel_region::run(arguments, &source, &derived, &drives),
        Err(drives) if drives.len() > 2 => Err("name one drive, or two"),
        Err(_) if arguments.point.is_some() || arguments.plot.is_some() => {
            Err("`--point` and `--plot` are for two drives: name another one")
        }
        Err(mut drives) => Ok(drives.remove(0)),
    };
    let drive = followed.map_err(|text| Problem(format!("error: {text}")))?;
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
    let travel = match travel {
        Ok(travel) => travel,
        Err(reason) => return immovable(&reason, mechanism, &arguments.drive, arguments.at),
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

/// Reports drives that cannot be followed.
///
/// # Errors
/// The equations cannot be solved with the drives as inputs. An [`Outcome`] reports a mechanism that cannot be assembled.
pub(super) fn immovable(
    reason: &Immovable,
    mechanism: &Mechanism,
    drives: &[String],
    t: f64,
) -> Result<Outcome, Problem> {
    let title = mechanism.title();
    match reason {
        Immovable::Unsolvable => Err(Problem(format!(
            "error: the equations of `{title}` cannot be solved with `{}` as input",
            drives.join("` and `")
        ))),
        Immovable::NotAssembled(reason) => {
            let t = time(t);
            say(&format!(
                "error: `{title}` cannot be assembled in the design modes at t = {t} s: {reason}"
            ));
            Ok(Outcome::Failed)
        }
    }
}
