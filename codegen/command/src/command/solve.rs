//! Solves the motion of a description, and reports it as text, CSV and plots.

use std::io;

use linkwright_codegen::stages::joint::Quantity;
use linkwright_codegen::stages::system::System;
use linkwright_solver::{Dense, Schedule, View};

use super::description::{chosen, determined, interpreted, outputs, set_all, source};
use super::report::{check_stdout, report};
use super::solve_files::Files;
use super::{Outcome, Problem};
use crate::arguments::{Formulation, Reported, Solve};
use crate::report::summary::Layout;
use linkwright_page::motion::{self, Followed, Sink, Wanted};

/// Solves the motion and reports it.
///
/// # Errors
/// The description has errors, its equations do not determine the motion, an option cannot be used, or a file cannot
/// be written. An [`Outcome`] reports a mechanism that cannot be solved.
pub fn run(arguments: &Solve) -> Result<Outcome, Problem> {
    check_stdout(&arguments.reported)?;
    let source = source(&arguments.described.file)?.reported_in(arguments.reported.units());
    let derived = determined(&source, arguments.described.motion.as_deref())?;
    let mut derived = set_all(derived, &arguments.setting.set)?;
    if arguments.at_rest {
        if !derived.system.mechanism.forces.are_wanted() {
            return Err(Problem(format!(
                "error: `--static` needs forces to compute\n  = help: write `effort;` or `reactions;` into `{}`",
                arguments.described.file.display()
            )));
        }
        derived.system = derived.system.at_rest(&mut derived.pool);
    }
    let schedule = schedule(arguments)?;
    let [points, coordinates] = shown(&arguments.reported, &derived.system)?;
    let reported = &arguments.reported;
    let writable = outputs(&arguments.described.file, &source, reported.force);
    let is_brief = !arguments.at.is_empty();
    let files = Files::new(
        reported,
        writable,
        is_brief,
        &derived.pool,
        &derived.system,
        [&points, &coordinates],
        &schedule,
    )?;
    let first_steps = match (arguments.first_step, is_brief) {
        (true, true) => arguments.at.clone(),
        (true, false) => vec![schedule.start.t],
        (false, _) => Vec::new(),
    };
    let layout = Layout {
        first_steps,
        ..Layout::of(reported, &derived.system.mechanism)
    };
    let selection = Wanted {
        points,
        coordinates,
        monitor: arguments.monitor,
        curves: files.has_pictures(),
        pairs: files.pairs(),
    };
    match arguments.formulation {
        Formulation::Textbook => {
            let dense = Dense::new(&derived);
            let motion = Followed::new(dense, selection, schedule.start.t, None);
            report(reported, layout, motion, &schedule, files, &mut follow)
        }
        Formulation::Solved => {
            let interpreted = interpreted(&derived, &source)?;
            let chosen = chosen(&arguments.setting.branch, &interpreted, schedule.start.t)?;
            let motion = Followed::new(interpreted, selection, schedule.start.t, chosen);
            report(reported, layout, motion, &schedule, files, &mut follow)
        }
    }
}

/// Follows the motion of drivers and inputs.
fn follow<V: View>(
    motion: &mut Followed<V>,
    schedule: &Schedule,
    sinks: &mut [&mut dyn Sink],
    reached: &mut dyn FnMut(usize),
) -> io::Result<()> {
    motion.follow(schedule, sinks, reached)
}

fn schedule(arguments: &Solve) -> Result<Schedule, Problem> {
    let Solve {
        from, to, step, at, ..
    } = arguments;
    match at.is_empty() {
        true if to < from => Schedule::range(*from, *to, *step)
            .map_err(|text| format!("{text}\n  = help: name earlier instants with `--at`")),
        true => Schedule::range(*from, *to, *step),
        false => Schedule::instants(*from, at, *step),
    }
    .map_err(|text| Problem(format!("error: {text}")))
}

/// Returns the selected points and coordinates; without a selection, all points and all angles.
pub(super) fn shown(reported: &Reported, system: &System) -> Result<[Vec<usize>; 2], Problem> {
    let refused = |text| Problem(format!("error: {text}"));
    let [mut coordinates, others] = motion::shown(system, &reported.show).map_err(refused)?;
    let mut points = match (&reported.points[..], &reported.show[..]) {
        ([], [_, ..]) => Vec::new(),
        (names, _) => motion::points(system, names).map_err(refused)?,
    };
    for point in others {
        if !points.contains(&point) {
            points.push(point);
        }
    }
    if reported.points.is_empty() && reported.show.is_empty() {
        let all = system.coordinates.iter().enumerate();
        let angles = all.filter(|(_, it)| it.quantity == Quantity::Angle);
        coordinates.extend(angles.map(|(place, _)| place));
    }
    Ok([points, coordinates])
}
