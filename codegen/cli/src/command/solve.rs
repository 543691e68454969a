//! *A description and times* → *its motion*: printed, and written as CSV and plots.

use std::io;
use std::path::{Path, PathBuf};

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::model::set;
use linkwright_codegen::stages::system::System;
use linkwright_solver::dense::Dense;
use linkwright_solver::instant::Instant;
use linkwright_solver::schedule::Schedule;
use linkwright_solver::supplied::Modes;
use linkwright_solver::view::View;

use super::description::{chosen, determined, interpreted, outputs, source};
use super::{Outcome, Problem, in_folder, print, say};
use crate::arguments::{Equations, Solve};
use crate::motion::{Followed, Shown, Sink, Wanted, select};
use crate::output::{Output, Refused};
use crate::progress::{PATIENCE, Progress};
use crate::report::comma_separated::{self, Table};
use crate::report::json::Object;
use crate::report::{picture, plot, summary};

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
    let points =
        select(&system, &arguments.points).map_err(|text| Problem(format!("error: {text}")))?;
    let schedule = schedule(arguments)?;
    let files = files(arguments, &source, &system, &points, &schedule)?;
    let wanted = Wanted {
        points,
        monitor: arguments.monitor,
        curves: !files.pictures.is_empty(),
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
    let mut progress = Progress::new(schedule.visits());
    let mut motion = Followed::new(view, wanted, schedule.start.t, chosen);
    // Nothing is written of a motion without a frame.
    let table = files.frames.take().filter(|_| motion.start.is_some());
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
                    table,
                    &mut reached,
                )?;
                object.finish(&motion)
            }
            false => {
                let mut rows = Table::new(&motion, output)?;
                refused = follow(&mut motion, schedule, Some(&mut rows), table, &mut reached)?;
                rows.finish()
            }
        })?;
        refused?;
    } else {
        follow(&mut motion, schedule, None, table, &mut reached).map_err(Problem::of)??;
    }
    let elapsed = progress.finish();
    let is_chosen = !arguments.points.is_empty();
    if to_stdout {
        // If stderr is closed there is nobody to tell.
        let _ = summary::write(&motion, is_chosen, &mut io::stderr());
    } else if !arguments.json {
        print(|output| {
            summary::write(&motion, is_chosen, output)?;
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
    written.extend(files.draw(&motion)?);
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
    table: Option<Output>,
    reached: &mut dyn FnMut(usize),
) -> io::Result<Result<(), Refused>> {
    let Some(table) = table else {
        let mut sinks: Vec<&mut dyn Sink> = sink.into_iter().collect();
        return motion.follow(schedule, &mut sinks, reached).map(Ok);
    };
    let written = table.write(|output| {
        let mut table = Table::new(motion, output)?;
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

/// The files that are wanted.
struct Files {
    frames: Option<Output>,
    /// The name of each and, in the order of the points that are shown, where it goes.
    pictures: Vec<(String, Output)>,
    folder: PathBuf,
}

fn files(
    arguments: &Solve,
    source: &Source,
    system: &System,
    points: &[usize],
    schedule: &Schedule,
) -> Result<Files, Problem> {
    let unasked = !arguments.json && !arguments.no_files && arguments.at.is_empty();
    let wanted = |asked: &Option<PathBuf>, default: PathBuf| match asked {
        None if unasked => Some(default),
        asked => asked.clone(),
    };
    // What nobody asked for, and cannot be written, can be asked for elsewhere.
    let placed = |asked: &Option<PathBuf>, output: Result<Output, Refused>| {
        output.map_err(|refused| match asked {
            None => refused.or_help("`--csv FILE` and `--plot DIR` write to other places"),
            Some(_) => refused,
        })
    };
    let folder = folder(system);
    let mut outputs = outputs(&arguments.file, source, arguments.force);
    let frames = wanted(&arguments.csv, folder.join("motion.csv"));
    let frames = frames.filter(|path| path != Path::new("-"));
    let frames = frames.map(|path| {
        let output = outputs.file(&path, comma_separated::SIGNATURE);
        placed(&arguments.csv, output)
    });
    let frames = frames.transpose()?;
    let mut pictures = Vec::new();
    let folder = wanted(&arguments.plot, folder);
    // A curve needs two frames.
    if let (Some(folder), 2..) = (&folder, schedule.wanted()) {
        let names = points
            .iter()
            .map(|&point| system.outputs[point].name.as_str());
        for name in distinct(names) {
            let path = in_folder(folder, &format!("{name}.svg"))?;
            let output = outputs.file(&path, picture::SIGNATURE);
            pictures.push((name, placed(&arguments.plot, output)?));
        }
    }
    Ok(Files {
        frames,
        pictures,
        folder: folder.unwrap_or_default(),
    })
}

/// The folder for what is written unasked: `target/linkwright/excavator`, `target/linkwright/excavator/reach`.
fn folder(system: &System) -> PathBuf {
    let mechanism = &system.mechanism;
    let motion = mechanism.motion.as_ref().map(|motion| motion.name.as_str());
    let names = [mechanism.name.as_str()].into_iter().chain(motion);
    Path::new("target/linkwright").join(names.collect::<PathBuf>())
}

impl Files {
    /// Draws the points, if there are frames; a line about each folder.
    fn draw<V: View>(self, motion: &Followed<V>) -> Result<Vec<String>, Problem> {
        let mut written = Vec::new();
        if self.pictures.is_empty() {
            return Ok(written);
        }
        let drawn = plot::draw(motion).map_err(|text| Problem(format!("error: {text}")))?;
        let mut names = Vec::new();
        for ((name, output), (_, picture)) in self.pictures.into_iter().zip(&drawn) {
            output.write(|output| output.write_all(picture.as_bytes()))?;
            names.push(name);
        }
        match names.as_slice() {
            [] => {}
            [name] => written.push(
                self.folder
                    .join(format!("{name}.svg"))
                    .display()
                    .to_string(),
            ),
            names => written.push(format!(
                "{} ({})",
                self.folder.join("*.svg").display(),
                names.join(", ")
            )),
        }
        Ok(written)
    }
}

/// File names for points: where two differ in case only, the later one gets a number, since some file systems cannot
/// tell them apart.
fn distinct<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut taken: Vec<String> = Vec::new();
    names
        .map(|name| {
            let mut file = name.to_string();
            let mut number = 2;
            while taken.contains(&file.to_lowercase()) {
                file = format!("{name}-{number}");
                number += 1;
            }
            taken.push(file.to_lowercase());
            file
        })
        .collect()
}

#[cfg(test)]
mod tests {
    #[test]
    fn file_names_differ_in_more_than_case() {
        let names = super::distinct(["a", "A", "b", "A2"].into_iter());
        assert_eq!(names, ["a", "A-2", "b", "A2"]);
    }
}
