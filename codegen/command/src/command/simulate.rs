//! Simulates a description with free coordinates under its forces, and reports the motion as text, CSV and plots.

use std::ops::ControlFlow;

use linkwright_codegen::stages::model::Role;
use linkwright_codegen::stages::system::System;
use linkwright_solver::simulation::Effort;
use linkwright_solver::{Method, Schedule, SimulationOptions, Tolerances};

use super::description::{chosen, determined, interpreted, outputs, set_all, source};
use super::report::{check_stdout, report};
use super::solve::shown;
use super::solve_files::Files;
use super::{Outcome, Problem, say};
use crate::arguments::{Simulate, StepMethod};
use crate::report::effort::hint;
use crate::report::summary::Layout;
use linkwright_page::motion::{Followed, Listeners, Wanted};

/// Simulates the motion and reports it.
///
/// # Errors
/// The description has errors or no free coordinate, an option cannot be used, or a file cannot be written. An [`Outcome`] reports a
/// motion that ends early.
pub fn run(arguments: &Simulate) -> Result<Outcome, Problem> {
    let reported = &arguments.reported;
    check_stdout(reported)?;
    let source = source(&arguments.described.file)?.reported_in(arguments.reported.units());
    let derived = determined(&source, arguments.described.motion.as_deref())?;
    let mut derived = set_all(derived, &arguments.set)?;
    let forces = &mut derived.system.mechanism.forces;
    if forces.free.is_empty() {
        return Err(Problem(format!(
            "error: no coordinate of `{}` is free, so forces move nothing\n  = help: {}",
            arguments.described.file.display(),
            missing_statement(&derived.system, ", or use `linkwright solve`")
        )));
    }
    // The drift of energy is always reported.
    forces.energy = true;
    if arguments.to < 0.0 {
        return Err(Problem(format!(
            "error: `--to {}` lies before the start of the motion, 0 s",
            arguments.to
        )));
    }
    let schedule = Schedule::range(0.0, arguments.to, arguments.step);
    let schedule = schedule.map_err(|text| Problem(format!("error: {text}")))?;
    let [points, coordinates] = shown(reported, &derived.system)?;
    let writable = outputs(&arguments.described.file, &source, reported.force);
    let files = Files::new(
        reported,
        writable,
        false,
        &derived.pool,
        &derived.system,
        [&points, &coordinates],
        &schedule,
    )?;
    let selection = Wanted {
        points,
        coordinates,
        monitor: false,
        curves: files.has_pictures(),
        pairs: files.pairs(),
    };
    let view = interpreted(&derived, &source)?;
    let chosen = chosen(&arguments.branch, &view, 0.0)?;
    let options = SimulationOptions {
        tolerances: Tolerances {
            relative: arguments.rtol,
            absolute: arguments.atol,
        },
        method: match arguments.method {
            None => Method::Automatic,
            Some(StepMethod::Dop853) => Method::Explicit,
            Some(StepMethod::Implicit) => Method::Implicit,
        },
    };
    let motion = Followed::moved_by_forces(&view, selection, chosen.clone());
    let mut is_hinted = false;
    let mut taken = |effort: &Effort| {
        if let Some(hint) = hint(effort, options.method).filter(|_| !is_hinted) {
            is_hinted = true;
            say(&format!(
                "warning: this takes long: more than a million evaluations so far\n  = help: {hint}"
            ));
        }
        ControlFlow::Continue(())
    };
    report(
        reported,
        Layout::of(reported, &derived.system.mechanism),
        motion,
        &schedule,
        files,
        &mut |motion, schedule, sinks, reached| {
            let listeners = Listeners {
                reached,
                taken: &mut taken,
            };
            motion.simulate((&view, chosen.clone()), schedule, options, sinks, listeners)
        },
    )
}

/// Returns a `free` statement that would replace the first driver, with what to do instead.
pub(super) fn missing_statement(system: &System, instead: &str) -> String {
    let mut joints = system.mechanism.joints.iter();
    let driver = joints.find(|joint| joint.role == Role::Driver);
    let Some(driver) = driver.and_then(|it| it.label.strip_prefix("drive ")) else {
        return format!(
            "write `free NAME: phi(BODY) = START;` in place of a `drive` statement{instead}"
        );
    };
    let (name, driven) = driver.split_once(": ").unwrap_or(("NAME", driver));
    let massless = match system.mechanism.forces.masses.is_empty() {
        true => " and `mass BODY = 2kg;` for the bodies",
        false => "",
    };
    format!(
        "write `free {name}: {driven} = START;` in place of `drive {driver} = …;`{massless}{instead}"
    )
}
