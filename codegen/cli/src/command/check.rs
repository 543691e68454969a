//! *A description and times → its assemblies and where it comes closest to singular.*

use linkwright_codegen::model::set;

use super::description::{determined, source};
use super::{Outcome, Problem, print, say};
use crate::arguments::Check as Arguments;
use crate::check::Check;
use crate::file::replace;
use crate::progress::Progress;
use crate::report::{assembly_plot, check_json, check_text};
use crate::schedule::Schedule;

/// How many frames are kept at most.
const LARGEST: usize = 1_000_000;

/// Checks the mechanism and reports it.
///
/// # Errors
/// The description has errors, its equations do not determine the motion, an option cannot be used, or the picture cannot be
/// written. That the mechanism cannot be solved is an outcome.
pub fn run(arguments: &Arguments) -> Result<Outcome, Problem> {
    let source = source(&arguments.file)?;
    let mut system = determined(&source, arguments.motion.as_deref())?;
    for assignment in &arguments.set {
        set(&mut system.mechanism, assignment).map_err(Problem)?;
    }
    let schedule = Schedule::range(arguments.from, arguments.to, arguments.step)
        .map_err(|text| Problem(format!("error: {text}")))?;
    if schedule.visits() > LARGEST {
        return Err(Problem(format!(
            "error: more than {LARGEST} frames: use a larger `--step`"
        )));
    }
    let mut progress = Progress::new(schedule.visits());
    let check = Check::new(system, &schedule, |count| progress.reached(count));
    progress.finish();
    print(|output| match arguments.json {
        true => check_json::write(&check, output),
        false => check_text::write(&check, output),
    })?;
    if !arguments.json {
        for warning in &check.warnings {
            say(&format!("warning: {warning}"));
        }
    }
    if let Some(error) = &check.solution.error {
        say(&format!("error: `{}` {error}", check.solution.title()));
    }
    if let Some(folder) = &arguments.plot {
        let found = check.assemblies.as_ref().map_or(&[][..], |it| &it.found);
        let picture = assembly_plot::draw(&check.solution.system, found)
            .map_err(|text| Problem(format!("error: {text}")))?;
        if !picture.is_empty() {
            let path = folder.join("assemblies.svg");
            replace(&path, |output| output.write_all(picture.as_bytes()))?;
            if !arguments.json {
                print(|output| writeln!(output, "wrote {}", path.display()))?;
            }
        }
    }
    let denied = arguments.deny_warnings && !check.warnings.is_empty();
    Ok(match check.solution.error {
        None if !denied => Outcome::Done,
        _ => Outcome::Failed,
    })
}
