//! Chooses parameters of a description for which its motion meets a table of targets.

mod certified;
mod chosen;
mod files;
mod task;

use std::sync::Mutex;
use std::sync::atomic::Ordering;

use linkwright_calibrate::{StartSampling, Synthesis};

pub use self::certified::Certified;
use self::certified::Certifier;
use self::chosen::chosen;
use self::files::Files;
use self::task::{MotionRange, targets, unsearchable};
use super::compare::read;
use super::description::{along, determined, interpreted, source};
use super::{Outcome, Problem, print, say, threads};
use crate::arguments::Synthesize;
use crate::interruption;
use crate::progress::Progress;
use crate::report::synthesis::{self, Report, Search};
use crate::report::synthesis_json;

/// Number of candidates from which each listed solution is certified, at most.
const CANDIDATES_EACH: usize = 8;

/// Searches and reports the solutions.
///
/// # Errors
/// The description or the table has errors, an option cannot be used, or a file cannot be written. An [`Outcome`] reports a search
/// without a solution.
pub fn run(arguments: &Synthesize) -> Result<Outcome, Problem> {
    let source =
        source(&arguments.described.file)?.reported_in(arguments.reported_in.units.clone());
    let motion = arguments.described.motion.as_deref();
    let derived = determined(&source, motion)?;
    let title = derived.system.mechanism.title();
    if !derived.system.mechanism.forces.free.is_empty() {
        return Err(Problem(format!(
            "error: forces move coordinates of `{title}`, so its motion does not follow from its parameters at each instant\n  = help: name a motion without `free` coordinates with `--motion`, or write `drive` instead"
        )));
    }
    let bounds = chosen(&derived.system, &arguments.param)?;
    let data = read(&arguments.table, &derived, false)?;
    let derived = data.drive(derived).map_err(Problem)?;
    let range = MotionRange::of(arguments, &data, &derived)?;
    let (targets, permitted) = targets(&data, &arguments.tolerance, &derived)?;
    let mut files = Files::announced(arguments, &source, &derived.system.mechanism.name)?;
    // Prints the findings of the solution, which the search repeats.
    interpreted(&derived, &source)?;
    let names: Vec<&str> = bounds.iter().map(|it| it.0.as_str()).collect();
    let driven = |names: &[&str]| data.drive(along(&source, motion, names)?).map_err(Problem);
    let (plain, differentiated) = (driven(&[])?, driven(&names)?);
    let (frames, threads) = (range.frames(), threads(arguments.threads));
    let synthesis = Synthesis::new(&plain, &differentiated, targets, &bounds, frames, threads);
    let synthesis = synthesis.map_err(|reason| unsearchable(&reason))?;
    let sampling = StartSampling {
        count: arguments.samples,
        fits: arguments.fits as usize,
        seed: arguments.seed,
    };
    let most = arguments.solutions as usize;
    let progress = Mutex::new(Progress::of_share());
    let stop = interruption::flag();
    let reached = |share: f64| {
        if let Ok(mut progress) = progress.lock() {
            progress.reached_share(share);
        }
    };
    let (candidates, counts) = synthesis.search(sampling, CANDIDATES_EACH * most, stop, &reached);
    if let Ok(progress) = progress.into_inner() {
        progress.finish();
    }
    let certifier = Certifier {
        source: &source,
        derived: &derived,
        motion,
        synthesis: &synthesis,
        range: &range,
        step: arguments.step,
    };
    let (mut solutions, mut rejected) = (Vec::new(), Vec::new());
    for candidate in candidates {
        if solutions.len() == most {
            break;
        }
        match certifier.certified(candidate) {
            Ok(solution) => solutions.push(solution),
            Err(reason) => rejected.push(reason),
        }
    }
    let report = Report {
        derived: &derived,
        data: &data,
        synthesis: &synthesis,
        bounds: &bounds,
        permitted: &permitted,
        range: range.ends,
        turning: range.turning.as_deref(),
        solutions: &solutions,
        rejected: &rejected,
        search: Search {
            counts,
            requested: sampling,
            is_interrupted: stop.load(Ordering::Relaxed),
        },
    };
    print(|output| match arguments.json {
        true => synthesis_json::write(&report, output),
        false => synthesis::write(&report, output),
    })?;
    files.write(&report, arguments.json)?;
    if solutions.is_empty() {
        say(&report.without_solution());
        return Ok(Outcome::Failed);
    }
    Ok(match solutions.iter().any(|it| report.is_within(it)) {
        true => Outcome::Done,
        false => {
            say(
                "error: no solution meets all targets\n  = help: choose more parameters or wider bounds with `--param`, search longer with `--samples` and `--fits`, or permit larger differences with `--tolerance`",
            );
            Outcome::Failed
        }
    })
}
