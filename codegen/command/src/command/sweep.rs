//! Solves many sets of parameters and inputs, and writes a table and pictures.

use std::io::{self, BufReader, Write};
use std::path::PathBuf;

use linkwright_codegen::stages::system::Derived;
use linkwright_solver::sets::Extremes;
use linkwright_solver::{Interpreted, Numbers, Observable, Schedule};

use super::description::{assembled, determined, interpreted, selected, set_all, source};
#[cfg(feature = "parquet")]
use super::sweep_files::PARQUET_LEFT;
use super::sweep_files::{CSV_LEFT, Files, TableFormat, is_stdout};
use super::{Outcome, Problem, print, say, threads};
use crate::arguments;
use crate::output::Pieces;
use crate::progress::Progress;
#[cfg(feature = "parquet")]
use crate::sweep::ParquetRows;
use crate::sweep::{
    Continuation, CsvCells, Grid, Pictured, Range, Samples, Sets, Solved, Start, Summary, Sweep,
    Table, continuation, definition, quantities,
};

/// Solves all sets.
///
/// # Errors
/// The description has errors, an option cannot be used, or a file cannot be written.
pub fn run(arguments: &arguments::Sweep) -> Result<Outcome, Problem> {
    let format = TableFormat::of(arguments)?;
    let source =
        source(&arguments.described.file)?.reported_in(arguments.reported_in.units.clone());
    let motion = arguments.described.motion.as_deref();
    let derived = set_all(determined(&source, motion)?, &arguments.set)?;
    let sets = sets(arguments, &derived).map_err(Problem)?;
    check_apart(arguments, &sets)?;
    let schedule = Schedule::range(arguments.from, arguments.to, arguments.step)
        .map_err(|text| Problem(format!("error: {text}")))?;
    let visits = schedule.forward.visits().map(|it| it.t);
    let times: Vec<f64> = std::iter::once(schedule.start.t).chain(visits).collect();
    let quantities = quantities(&derived, &arguments.show).map_err(Problem)?;
    let files = Files::new(arguments, format, &source, &derived, &sets, &quantities)?;
    let blocks = interpreted(&derived, &source)?;
    let observables: Vec<Observable> = quantities.iter().map(|it| it.observable).collect();
    let threads = threads(arguments.threads);
    let sweep = Sweep::new(&blocks, &sets, &times, &observables, threads);
    let start = start(&arguments.branch, &blocks, times[0])?;
    let sweep = sweep.map_err(Problem)?.started(start);
    let has_instants = arguments.instants;
    let mut job = Job {
        table: Table::new(sets.varied(), &quantities, &times, &blocks, has_instants),
        summary: Summary::new(&blocks, sets.varied(), &quantities),
        pictured: Pictured::new(&sets, &quantities).filter(|_| !files.pictures.is_empty()),
        progress: Progress::of_sets(sets.count()),
    };
    let header = job.table.header().map_err(Problem::of)?;
    let definition = || {
        let (set, branch) = (&arguments.set, &arguments.branch);
        definition(&source, motion, set, branch, &sets, &times, &header)
    };
    let mut first = 0;
    match (files.table, format) {
        (None, _) => print(|output| {
            output.write_all(&header)?;
            job.solve_to_text(&sweep, &mut Continuation::default(), output)
        })?,
        (Some(output), TableFormat::Csv) => {
            let mut pieces = match arguments.resume {
                true => output.resumed_pieces(&definition())?,
                false => output.pieces(&definition(), CSV_LEFT)?,
            };
            let mut continuation = continued(&mut pieces, &header, sets.count())?;
            if continuation.length == 0 {
                let begun = pieces.write_all(&header).and_then(|()| pieces.flush());
                begun.map_err(Problem::of)?;
            }
            first = continuation.set;
            let solved = job.solve_to_text(&sweep, &mut continuation, &mut pieces);
            if solved.is_err() && !continuation.rows.is_empty() {
                return Err(pieces.foreign().into());
            }
            solved.map_err(Problem::of)?;
            pieces.finish()?;
        }
        #[cfg(feature = "parquet")]
        (Some(output), TableFormat::Parquet) => {
            let mut pieces = output.pieces(&definition(), PARQUET_LEFT)?;
            let rows = ParquetRows::new(&job.table.columns(), &mut pieces, |pieces, end| {
                pieces.end_so_far(end)
            });
            let mut rows = rows.map_err(Problem::of)?;
            let solved = job.solve(&sweep, 0, &mut |table, solved, extremes| {
                table.write(solved, extremes, &mut rows)
            });
            solved.and_then(|()| rows.finish()).map_err(Problem::of)?;
            pieces.finish()?;
        }
    }
    if let Some(pictured) = &mut job.pictured {
        // Pictures also show what an interrupted run has solved.
        let missing = pictured.missing(first);
        let table = &job.table;
        let solved = sweep.solve_all(missing.into_iter(), |solved| {
            pictured.take(&solved, &table.extremes(&solved));
            Ok(())
        });
        solved.map_err(Problem::of)?;
    }
    job.progress.finish();
    let title = derived.system.mechanism.title();
    let mut text = Vec::new();
    let frames = linkwright_solver::number::counted(times.len(), "frame");
    writeln!(text, "{title}: {frames} for each set").map_err(Problem::of)?;
    if first > 0 {
        writeln!(text, "continued with set {first}").map_err(Problem::of)?;
    }
    job.summary.write(&mut text).map_err(Problem::of)?;
    let drawn = match &job.pictured {
        None => Vec::new(),
        Some(pictured) => pictured
            .draw(&title)
            .map_err(|text| Problem(format!("error: {text}")))?,
    };
    let mut written: Vec<PathBuf> = files.path.into_iter().collect();
    for (output, picture) in files.pictures.into_iter().zip(drawn) {
        let Some(picture) = picture else { continue };
        written.push(output.path().to_path_buf());
        output.write(|output| output.write_all(picture.as_bytes()))?;
    }
    for path in &written {
        writeln!(text, "wrote {}", path.display()).map_err(Problem::of)?;
    }
    match is_stdout(arguments) {
        true => say(&String::from_utf8_lossy(&text)),
        false => print(|output| output.write_all(&text))?,
    }
    Ok(Outcome::Done)
}

/// Work on the sets of a sweep.
struct Job<'a> {
    table: Table<'a>,
    summary: Summary<'a>,
    /// Sets of the pictures; `None` without pictures.
    pictured: Option<Pictured<'a>>,
    progress: Progress,
}

/// Procedure that writes the rows of a set.
type Written<'a> = dyn FnMut(&Table<'_>, &Solved<'_>, &[Option<Extremes>]) -> io::Result<()> + 'a;

impl Job<'_> {
    /// Solves the sets from `first` on, and writes their rows.
    fn solve(&mut self, sweep: &Sweep<'_>, first: u64, write: &mut Written<'_>) -> io::Result<()> {
        sweep.solve(first, |solved: Solved<'_>| {
            let extremes = self.table.extremes(&solved);
            write(&self.table, &solved, &extremes)?;
            self.summary.take(&solved, &extremes);
            if let Some(pictured) = &mut self.pictured {
                pictured.take(&solved, &extremes);
            }
            let count = usize::try_from(solved.set + 1).unwrap_or(usize::MAX);
            self.progress.reached(count);
            Ok(())
        })
    }

    /// Solves the sets with which a table of CSV continues, and writes their rows. The rows of the continuation are removed if the first set
    /// repeats them; otherwise they stay, and the table ends with an error.
    fn solve_to_text(
        &mut self,
        sweep: &Sweep<'_>,
        continuation: &mut Continuation,
        output: &mut dyn Write,
    ) -> io::Result<()> {
        let mut rows = Vec::new();
        self.solve(sweep, continuation.set, &mut |table, solved, extremes| {
            rows.clear();
            let mut cells = CsvCells::new(&mut rows);
            table.write(solved, extremes, &mut cells)?;
            cells.flush()?;
            drop(cells);
            if !rows.starts_with(&continuation.rows) {
                return Err(io::Error::other("rows differ"));
            }
            continuation.rows.clear();
            output.write_all(&rows)
        })
    }
}

/// Returns the modes and the pose in which sets are assembled.
fn start(wished: &[String], blocks: &Interpreted, t: f64) -> Result<Start, Problem> {
    if wished.is_empty() {
        return Ok(Start::default());
    }
    let selection = selected(wished, blocks)?;
    // Closed forms of all sets have the selected signs. Other loops have a pose near the one of the description's values.
    if let Some(modes) = selection.closed(blocks) {
        return Ok(Start {
            modes: Some(modes),
            pose: None,
        });
    }
    let (instant, modes) = assembled(&selection, blocks, t)?;
    Ok(Start {
        modes: Some(modes),
        pose: Some(Numbers(instant.q().to_vec())),
    })
}

/// Returns the place at which a table continues, and cuts what is behind; the header of a new table has no bytes yet.
fn continued(pieces: &mut Pieces, header: &[u8], count: u64) -> Result<Continuation, Problem> {
    let place = match pieces.part()? {
        None => None,
        Some(part) => {
            let place = continuation(BufReader::new(part), header, count);
            let place = place.map_err(Problem::of)?;
            Some(place.ok_or_else(|| Problem::from(pieces.foreign()))?)
        }
    };
    match place {
        None => Ok(Continuation::default()),
        Some(place) => {
            pieces.cut(place.length)?;
            Ok(place)
        }
    }
}

/// Returns the sets that the options describe.
fn sets(arguments: &arguments::Sweep, derived: &Derived) -> Result<Sets, String> {
    if let Some(path) = &arguments.rows {
        return match arguments.vary.is_empty() {
            true => Sets::read(path, derived),
            false => Err("error: `--rows` and `--vary` both choose the sets\n  = help: leave out one of them".to_string()),
        };
    }
    if arguments.vary.is_empty() {
        return Err("error: nothing is varied\n  = help: pass `--vary NAME=FIRST..LAST:COUNT`, or sets with `--rows FILE`".to_string());
    }
    let mut ranges: Vec<Range> = Vec::with_capacity(arguments.vary.len());
    for text in &arguments.vary {
        let range = Range::read(derived, "--vary", text)?;
        let name = &range.varied.name;
        if ranges.iter().any(|it| it.varied.name == *name) {
            return Err(format!(
                "error: `{name}` is varied twice\n  = help: leave out one `--vary`"
            ));
        }
        ranges.push(range);
    }
    match arguments.samples {
        Some(count) => Samples::new(ranges, count, arguments.seed).map(Sets::Samples),
        None => Grid::new(ranges).map(Sets::Grid),
    }
}

/// Checks that nothing is both set and varied.
fn check_apart(arguments: &arguments::Sweep, sets: &Sets) -> Result<(), Problem> {
    let set = arguments.set.iter().filter_map(|it| it.split_once('='));
    for (name, _) in set {
        if sets.varied().iter().any(|it| it.name == name.trim()) {
            return Err(Problem(format!(
                "error: `{name}` is both set and varied\n  = help: leave out `--set {name}`"
            )));
        }
    }
    Ok(())
}
