//! Lists the assemblies of a description, and finds its closest approach to a singular pose.

use linkwright_solver::{Check, Schedule, View};

use super::description::{determined, interpreted, outputs, set_all, source};
use super::{Outcome, Problem, in_folder, print, say};
use crate::arguments::Check as Arguments;
use crate::progress::Progress;
use crate::report::{drawing, picture, proof_text};
use crate::terminal;
use linkwright_page::{check_json, check_text, motion};

/// Width of tables in characters, unless the terminal is narrower.
const WIDTH: usize = 110;

/// Checks the mechanism and reports the results.
///
/// # Errors
/// The description has errors, its equations do not determine the motion, an option cannot be used, or the picture cannot be
/// written. An [`Outcome`] reports a mechanism that cannot be solved.
pub fn run(arguments: &Arguments) -> Result<Outcome, Problem> {
    let source =
        source(&arguments.described.file)?.reported_in(arguments.reported_in.units.clone());
    let derived = determined(&source, arguments.described.motion.as_deref())?;
    let derived = set_all(derived, &arguments.set)?;
    let schedule = Schedule::whole(arguments.from, arguments.to, arguments.step)
        .map_err(|text| Problem(format!("error: {text}")))?;
    let output = match &arguments.plot {
        Some(folder) => {
            let path = in_folder(folder, "assemblies.svg")?;
            let mut outputs = outputs(&arguments.described.file, &source, arguments.force);
            Some(outputs.file(&path, picture::SIGNATURE)?)
        }
        None => None,
    };
    let points = motion::points(&derived.system, &arguments.points);
    let points = points.map_err(|text| Problem(format!("error: {text}")))?;
    let mut progress = Progress::new(schedule.visits());
    let interpreted = interpreted(&derived, &source)?;
    let check = Check::new(interpreted, &schedule, |count| progress.reached(count));
    progress.finish();
    let proof = arguments.prove.then(|| check.prove(&schedule, &points));
    print(|output| match arguments.json {
        true => check_json::write(&check, proof.as_ref(), output),
        false => {
            let mut text = Vec::new();
            let width = terminal::columns().map_or(WIDTH, |it| it.min(WIDTH));
            check_text::write(&check, width, &mut text)?;
            if let Some(proof) = &proof {
                proof_text::write(&check, proof, &mut text)?;
            }
            let text = String::from_utf8_lossy(&text).into_owned();
            output.write_all(terminal::fitted(text).as_bytes())
        }
    })?;
    if !arguments.json {
        for warning in &check.warnings {
            say(&format!("warning: {warning}"));
        }
    }
    let system = check.interpreted.system();
    if let Some(error) = &check.error {
        say(&format!("error: `{}` {error}", system.mechanism.title()));
    }
    if let Some(output) = output {
        let picture = drawing::assemblies(&check.interpreted, &check.assemblies.found);
        if !picture.is_empty() {
            let path = output.path().to_path_buf();
            output.write(|output| output.write_all(picture.as_bytes()))?;
            if !arguments.json {
                print(|output| writeln!(output, "wrote {}", path.display()))?;
            }
        }
    }
    let is_unproven = proof.is_some_and(|proof| proof.proven.is_none());
    let denied = arguments.deny_warnings && !check.warnings.is_empty();
    let keeps_limits = check.measured.broken.is_empty();
    Ok(match check.error {
        None if !denied && !is_unproven && keeps_limits => Outcome::Done,
        _ => Outcome::Failed,
    })
}
