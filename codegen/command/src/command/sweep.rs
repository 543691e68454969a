//! Solves many sets of parameters and inputs, and writes a table and pictures.

use std::io::{self, BufReader, Write};
use std::path::{Path, PathBuf};
use std::thread;

use linkwright_codegen::stages::system::Derived;
use linkwright_solver::{Observable, Schedule};

use super::description::{determined, interpreted, outputs_besides, set_all, source};
use super::solve_files::{distinct, folder};
use super::{Outcome, Problem, in_folder, print, say};
use crate::arguments;
use crate::output::{Output, Pieces};
use crate::progress::Progress;
use crate::report::picture;
use crate::sweep::{
    Continuation, Grid, Pictured, Quantity, Range, SIGNATURE, Samples, Sets, Solved, Summary,
    Sweep, Table, continuation, definition, quantities,
};

/// Solves all sets.
///
/// # Errors
/// The description has errors, an option cannot be used, or a file cannot be written.
pub fn run(arguments: &arguments::Sweep) -> Result<Outcome, Problem> {
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
    let mut files = Files::new(arguments, &source, &derived, &sets, &quantities)?;
    let blocks = interpreted(&derived, &source, &arguments.described.file)?;
    let observables: Vec<Observable> = quantities.iter().map(|it| it.observable).collect();
    let threads = arguments.threads.map(usize::from);
    let threads = threads.or_else(|| thread::available_parallelism().ok().map(usize::from));
    let sweep = Sweep::new(&blocks, &sets, &times, &observables, threads.unwrap_or(1));
    let sweep = sweep.map_err(Problem)?;
    let has_instants = arguments.instants;
    let mut job = Job {
        table: Table::new(sets.varied(), &quantities, &times, &blocks, has_instants),
        summary: Summary::new(&blocks, sets.varied(), &quantities),
        pictured: Pictured::new(&sets, &quantities).filter(|_| !files.pictures.is_empty()),
        progress: Progress::of_sets(sets.count()),
        repeated: Vec::new(),
        is_foreign: false,
    };
    let header = job.table.header().map_err(Problem::of)?;
    let mut first = 0;
    match files.table.take() {
        None => print(|output| {
            output.write_all(&header)?;
            job.solve(&sweep, 0, output)
        })?,
        Some(output) => {
            let definition = definition(&source, motion, &arguments.set, &sets, &times, &header);
            let mut pieces = match arguments.resume {
                true => output.resumed_pieces(&definition)?,
                false => output.pieces(&definition)?,
            };
            let start = start(&mut pieces, &header, sets.count())?;
            if start.length == 0 {
                let begun = pieces.write_all(&header).and_then(|()| pieces.flush());
                begun.map_err(Problem::of)?;
            }
            first = start.set;
            job.repeated = start.rows;
            let solved = job.solve(&sweep, first, &mut pieces);
            if job.is_foreign {
                return Err(pieces.foreign().into());
            }
            solved.map_err(Problem::of)?;
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
    /// Rows of an interrupted run that the first set must repeat.
    repeated: Vec<u8>,
    /// True if it does not.
    is_foreign: bool,
}

impl Job<'_> {
    /// Solves the sets from `first` on, and writes their rows.
    fn solve(&mut self, sweep: &Sweep<'_>, first: u64, output: &mut dyn Write) -> io::Result<()> {
        let mut rows = Vec::new();
        sweep.solve(first, |solved: Solved<'_>| {
            let extremes = self.table.extremes(&solved);
            rows.clear();
            self.table.write(&solved, &extremes, &mut rows)?;
            if !rows.starts_with(&self.repeated) {
                self.is_foreign = true;
                return Err(io::Error::other("rows differ"));
            }
            self.repeated.clear();
            output.write_all(&rows)?;
            self.summary.take(&solved, &extremes);
            if let Some(pictured) = &mut self.pictured {
                pictured.take(&solved, &extremes);
            }
            let count = usize::try_from(solved.set + 1).unwrap_or(usize::MAX);
            self.progress.reached(count);
            Ok(())
        })
    }
}

/// Returns the place at which a table continues, and cuts what is behind; the header of a new table has no bytes yet.
fn start(pieces: &mut Pieces, header: &[u8], count: u64) -> Result<Continuation, Problem> {
    let place = match pieces.part()? {
        None => None,
        Some(part) => {
            let place = continuation(BufReader::new(part), header, count);
            let place = place.map_err(Problem::of)?;
            Some(place.ok_or_else(|| Problem::from(pieces.foreign()))?)
        }
    };
    match place {
        None => Ok(Continuation {
            set: 0,
            length: 0,
            rows: Vec::new(),
        }),
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
        let range = Range::read(derived, text)?;
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

fn is_stdout(arguments: &arguments::Sweep) -> bool {
    arguments.csv.as_deref() == Some(Path::new("-"))
}

/// Files of a sweep.
struct Files {
    /// Table; `None` if it goes to stdout.
    table: Option<Output>,
    path: Option<PathBuf>,
    /// Picture of each quantity; empty without pictures.
    pictures: Vec<Output>,
}

impl Files {
    /// Announces the files.
    ///
    /// # Errors
    /// A file cannot be written, or options contradict.
    fn new(
        arguments: &arguments::Sweep,
        source: &linkwright_codegen::diagnostic::Source,
        derived: &Derived,
        sets: &Sets,
        quantities: &[Quantity],
    ) -> Result<Files, Problem> {
        let (file, rows) = (&arguments.described.file, arguments.rows.as_deref());
        let mut outputs = outputs_besides(file, source, rows, arguments.force);
        let is_stdout = is_stdout(arguments);
        if is_stdout && arguments.resume {
            return Err(Problem(
                "error: `--resume` continues a file, and `--csv -` is stdout\n  = help: name a file with `--csv`".to_string(),
            ));
        }
        let default = folder(&derived.system);
        let path = arguments.csv.clone();
        let path = path.unwrap_or_else(|| default.join("sweep.csv"));
        let (table, path) = match is_stdout {
            true => (None, None),
            false => (Some(outputs.file(&path, SIGNATURE)?), Some(path)),
        };
        let is_default = arguments.csv.is_none();
        let folder = arguments.plot.clone().or(is_default.then_some(default));
        let mut pictures = Vec::new();
        if let (Some(folder), true) = (folder, sets.varied().len() <= 2) {
            for name in distinct(quantities.iter().map(|it| it.name.as_str())) {
                let path = in_folder(&folder, &format!("sweep_{name}.svg"))?;
                pictures.push(outputs.file(&path, picture::SIGNATURE)?);
            }
        }
        Ok(Files {
            table,
            path,
            pictures,
        })
    }
}
