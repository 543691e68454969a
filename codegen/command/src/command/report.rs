//! Prints and writes a motion while it is followed: a summary, JSON or CSV, and plots.

use std::io;
use std::path::{Path, PathBuf};

use linkwright_solver::{Schedule, View};

use super::solve_files::Files;
use super::{Outcome, Problem, print, say};
use crate::arguments::Reported;
use crate::output::{Output, Refused};
use crate::progress::{PATIENCE, Progress};
use crate::report::json::Object;
use crate::report::summary::{self, Layout};
use linkwright_page::comma_separated::{self, Table};
use linkwright_page::motion::{Followed, Shown, Sink};

/// Size of a table, in gigabytes, above which the size is announced.
const ANNOUNCED_SIZE: f64 = 1.0;

/// Number of bytes in a gigabyte.
const GIGABYTE: f64 = 1e9;

/// Checks that at most one text goes to stdout.
///
/// # Errors
/// Two texts are requested on stdout.
pub(super) fn check_stdout(reported: &Reported) -> Result<(), Problem> {
    match is_stdout(&reported.csv) && reported.json {
        true => Err(Problem(
            "error: `--json` and `--csv -` cannot both write to stdout".to_string(),
        )),
        false => Ok(()),
    }
}

/// Continuation of a motion over a schedule: passes requested instants to sinks, and reports the number of visited times.
///
/// # Errors
/// Errors of the sinks, which end the motion.
pub(super) type Course<'a, V> = &'a mut dyn FnMut(
    &mut Followed<V>,
    &Schedule,
    &mut [&mut dyn Sink],
    &mut dyn FnMut(usize),
) -> io::Result<()>;

/// Follows the motion, prints it and writes its files.
///
/// # Errors
/// A file cannot be written.
pub(super) fn report<V: View>(
    reported: &Reported,
    layout: Layout,
    mut motion: Followed<V>,
    schedule: &Schedule,
    mut files: Files,
    course: Course<'_, V>,
) -> Result<Outcome, Problem> {
    // Without a frame, no file is written.
    let table = files.frames.take().filter(|_| motion.is_assembled);
    if let Some(table) = &table {
        let size = comma_separated::size(&motion, schedule.wanted()) as f64 / GIGABYTE;
        if size > ANNOUNCED_SIZE {
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
    let to_stdout = is_stdout(&reported.csv);
    if reported.json || to_stdout {
        let mut refused = Ok(());
        print(|output| match reported.json {
            true => {
                let mut object = Object::new(&motion, output)?;
                let table = (table, reported.units.is_some());
                let sink = Some(&mut object as &mut dyn Sink);
                refused = follow(&mut motion, schedule, sink, table, course, &mut reached)?;
                object.finish(&motion)
            }
            false => {
                let mut rows = Table::new(&motion, reported.units.is_some(), output)?;
                let table = (table, reported.units.is_some());
                let sink = Some(&mut rows as &mut dyn Sink);
                refused = follow(&mut motion, schedule, sink, table, course, &mut reached)?;
                rows.finish()
            }
        })?;
        refused?;
    } else {
        let table = (table, reported.units.is_some());
        follow(&mut motion, schedule, None, table, course, &mut reached).map_err(Problem::of)??;
    }
    let elapsed = progress.finish();
    if to_stdout {
        // An error is ignored because stderr is the place for errors.
        let _ = summary::write(&motion, &layout, &mut io::stderr());
    } else if !reported.json {
        print(|output| {
            summary::write(&motion, &layout, output)?;
            match elapsed > PATIENCE {
                true => writeln!(output, "solved in {:.1} s", elapsed.as_secs_f64()),
                false => Ok(()),
            }
        })?;
    }
    if !reported.json {
        for warning in &motion.warnings {
            say(&format!("warning: {warning}"));
        }
    }
    if let Some(error) = &motion.error {
        say(&format!("error: `{}` {error}", motion.title()));
    }
    written.extend(files.draw(&motion, &layout.units)?);
    if !reported.json && !to_stdout {
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

/// Follows the motion, and writes its frames to a file if that is requested. The inner error is that of the file.
fn follow<V: View>(
    motion: &mut Followed<V>,
    schedule: &Schedule,
    sink: Option<&mut dyn Sink>,
    (table, has_units): (Option<Output>, bool),
    course: Course<'_, V>,
    reached: &mut dyn FnMut(usize),
) -> io::Result<Result<(), Refused>> {
    let Some(table) = table else {
        let mut sinks: Vec<&mut dyn Sink> = sink.into_iter().collect();
        return course(motion, schedule, &mut sinks, reached).map(Ok);
    };
    let written = table.write(|output| {
        let mut table = Table::new(motion, has_units, output)?;
        // The file is completed even if the reader of stdout has closed its pipe.
        let mut patient = sink.map(Patient);
        let mut sinks: Vec<&mut dyn Sink> = Vec::new();
        sinks.extend(patient.as_mut().map(|it| it as &mut dyn Sink));
        sinks.push(&mut table);
        course(motion, schedule, &mut sinks, reached)?;
        table.finish()
    });
    Ok(written)
}

/// Sink whose reader may close its pipe early.
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
