//! *A description and times* → *its motion*: printed, and written as CSV and plots.

use std::io;
use std::path::{Path, PathBuf};

use linkwright_codegen::stages::joint::Quantity;
use linkwright_codegen::stages::model::set;
use linkwright_codegen::stages::system::System;
use linkwright_solver::dense::Dense;
use linkwright_solver::instant::Instant;
use linkwright_solver::schedule::Schedule;
use linkwright_solver::supplied::Modes;
use linkwright_solver::view::View;

use super::description::{chosen, determined, interpreted, source};
use super::solve_files::Files;
use super::{Outcome, Problem, print, say};
use crate::arguments::{Equations, Solve};
use crate::motion::{self, Followed, Shown, Sink, Wanted};
use crate::output::{Output, Refused};
use crate::progress::{PATIENCE, Progress};
use crate::report::comma_separated::{self, Table};
use crate::report::json::Object;
use crate::report::summary::{self, How};

/// A table of more gigabytes than this is announced.
const LARGE: f64 = 1.0;

/// In bytes.
const GIGABYTE: f64 = 1e9;

/// Solves the motion and reports it.
///
/// # Errors
/// The description has errors, its equations do not determine the motion, an option cannot be used, or a file cannot
/// be written. That the mechanism cannot be solved is an outcome.
pub fn run(arguments: &Solve) -> Result<Outcome, Problem> {
    if is_stdout(&arguments.csv) && arguments.json {
        return Err(Problem(
            "error: `--json` and `--csv -` both want stdout".to_string(),
        ));
    }
    let source = source(&arguments.file)?;
    let mut system = determined(&source, arguments.motion.as_deref())?;
    for assignment in &arguments.set {
        set(&mut system.mechanism, assignment).map_err(Problem)?;
    }
    if arguments.at_rest {
        if !system.mechanism.forces.are_wanted() {
            return Err(Problem(format!(
                "error: `--static` needs something that is asked for\n  = help: write `effort;` or `reactions;` into `{}`",
                arguments.file.display()
            )));
        }
        system.rest();
    }
    let schedule = schedule(arguments)?;
    let [points, coordinates] = shown(arguments, &system)?;
    let files = Files::new(arguments, &source, &system, &points, &schedule)?;
    let wanted = Wanted {
        points,
        coordinates,
        monitor: arguments.monitor,
        curves: files.has_pictures(),
    };
    match arguments.view {
        Equations::Textbook => {
            let dense = Dense::new(&system);
            report(arguments, dense, wanted, &schedule, None, files)
        }
        Equations::Blocks => {
            let interpreted = interpreted(&system, &arguments.file)?;
            let chosen = chosen(&arguments.branch, &interpreted, schedule.start.t)?;
            report(arguments, interpreted, wanted, &schedule, chosen, files)
        }
    }
}

fn report<V: View>(
    arguments: &Solve,
    view: V,
    wanted: Wanted,
    schedule: &Schedule,
    chosen: Option<(Instant, Modes)>,
    mut files: Files,
) -> Result<Outcome, Problem> {
    let mut motion = Followed::new(view, wanted, schedule.start.t, chosen);
    // Nothing is written of a motion without a frame.
    let table = files.frames.take().filter(|_| motion.is_assembled);
    if let Some(table) = &table {
        let size = comma_separated::size(&motion, schedule.wanted()) as f64 / GIGABYTE;
        if size > LARGE {
            say(&format!(
                "warning: `{}` will take about {size:.1} GB\n  = help: `--no-files` writes none, and `--step` makes fewer frames",
                table.path().display()
            ));
        }
    }
    let mut progress = Progress::new(schedule.visits());
    let mut written: Vec<String> = table
        .iter()
        .map(|it| it.path().display().to_string())
        .collect();
    let mut reached = |count| progress.reached(count);
    let to_stdout = is_stdout(&arguments.csv);
    if arguments.json || to_stdout {
        let mut refused = Ok(());
        print(|output| match arguments.json {
            true => {
                let mut object = Object::new(&motion, output)?;
                refused = follow(
                    &mut motion,
                    schedule,
                    Some(&mut object),
                    (table, arguments.units),
                    &mut reached,
                )?;
                object.finish(&motion)
            }
            false => {
                let mut rows = Table::new(&motion, arguments.units, output)?;
                let table = (table, arguments.units);
                refused = follow(&mut motion, schedule, Some(&mut rows), table, &mut reached)?;
                rows.finish()
            }
        })?;
        refused?;
    } else {
        let table = (table, arguments.units);
        follow(&mut motion, schedule, None, table, &mut reached).map_err(Problem::of)??;
    }
    let elapsed = progress.finish();
    let how = How {
        points_chosen: !arguments.points.is_empty(),
        coordinates_chosen: !arguments.show.is_empty(),
        angles: arguments.angles,
        first_step: arguments.first_step,
    };
    if to_stdout {
        // If stderr is closed there is nobody to tell.
        let _ = summary::write(&motion, &how, &mut io::stderr());
    } else if !arguments.json {
        print(|output| {
            summary::write(&motion, &how, output)?;
            match elapsed > PATIENCE {
                true => writeln!(output, "solved in {:.1} s", elapsed.as_secs_f64()),
                false => Ok(()),
            }
        })?;
    }
    if !arguments.json {
        for warning in &motion.warnings {
            say(&format!("warning: {warning}"));
        }
    }
    if let Some(error) = &motion.error {
        say(&format!("error: `{}` {error}", motion.title()));
    }
    written.extend(files.draw(&motion, arguments.angles)?);
    if !arguments.json && !to_stdout {
        print(|output| {
            written
                .iter()
                .try_for_each(|line| writeln!(output, "wrote {line}"))
        })?;
    }
    Ok(match motion.error {
        None => Outcome::Done,
        Some(_) => Outcome::Failed,
    })
}

/// Follows the motion, and writes its frames to a file too, where they are wanted there. What is refused there is the inner error.
fn follow<V: View>(
    motion: &mut Followed<V>,
    schedule: &Schedule,
    sink: Option<&mut dyn Sink>,
    (table, has_units): (Option<Output>, bool),
    reached: &mut dyn FnMut(usize),
) -> io::Result<Result<(), Refused>> {
    let Some(table) = table else {
        let mut sinks: Vec<&mut dyn Sink> = sink.into_iter().collect();
        return motion.follow(schedule, &mut sinks, reached).map(Ok);
    };
    let written = table.write(|output| {
        let mut table = Table::new(motion, has_units, output)?;
        // The file is completed although a reader of stdout has gone away.
        let mut patient = sink.map(Patient);
        let mut sinks: Vec<&mut dyn Sink> = Vec::new();
        sinks.extend(patient.as_mut().map(|it| it as &mut dyn Sink));
        sinks.push(&mut table);
        motion.follow(schedule, &mut sinks, reached)?;
        table.finish()
    });
    Ok(written)
}

/// A sink whose reader may go away early.
struct Patient<'a>(&'a mut dyn Sink);

impl Sink for Patient<'_> {
    fn take(&mut self, shown: &Shown<'_>) -> io::Result<()> {
        match self.0.take(shown) {
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
            taken => taken,
        }
    }
}

fn is_stdout(path: &Option<PathBuf>) -> bool {
    path.as_deref() == Some(Path::new("-"))
}

fn schedule(arguments: &Solve) -> Result<Schedule, Problem> {
    let Solve {
        from, to, step, at, ..
    } = arguments;
    match at.is_empty() {
        true => Schedule::range(*from, *to, *step),
        false => Schedule::instants(*from, at, *step),
    }
    .map_err(|text| Problem(format!("error: {text}")))
}

/// The points and the coordinates that are shown: what is chosen, otherwise all points and all angles.
fn shown(arguments: &Solve, system: &System) -> Result<[Vec<usize>; 2], Problem> {
    let refused = |text| Problem(format!("error: {text}"));
    let points = match (&arguments.points[..], &arguments.show[..]) {
        ([], [_, ..]) => Vec::new(),
        (names, _) => motion::points(system, names).map_err(refused)?,
    };
    let coordinates = match (&arguments.points[..], &arguments.show[..]) {
        ([], []) => {
            let all = system.coordinates.iter().enumerate();
            let angles = all.filter(|(_, it)| it.quantity == Quantity::Angle);
            angles.map(|(place, _)| place).collect()
        }
        (_, names) => motion::coordinates(system, names).map_err(refused)?,
    };
    Ok([points, coordinates])
}
