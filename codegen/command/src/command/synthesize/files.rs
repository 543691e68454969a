//! Writes the files of solutions: descriptions, and pictures of the mechanism with paths and targets.

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::emit::drawing::{self, Options, Traced};
use linkwright_solver::drawn::pose;
use linkwright_solver::{Observable, Schedule, View as _};

use super::super::description::outputs_besides;
use super::super::rewritten::SIGNATURE;
use super::super::{Problem, in_folder, print};
use super::certified::Certified;
use crate::arguments::Synthesize;
use crate::output::Output;
use crate::report::picture;
use crate::report::synthesis::Report;
use linkwright_page::motion::{Followed, Shown, Sink, Wanted};

/// Number of positions on a path.
const PLACES: usize = 360;

/// Files of the solutions: of each a description and a picture.
pub struct Files(Vec<[Output; 2]>);

impl Files {
    /// Announces the files of all solutions of a mechanism of this name that may be found.
    ///
    /// # Errors
    /// A file exists or cannot be written.
    pub fn announced(
        arguments: &Synthesize,
        source: &Source,
        name: &str,
    ) -> Result<Files, Problem> {
        let Some(folder) = &arguments.out else {
            return Ok(Files(Vec::new()));
        };
        let path = &arguments.described.file;
        let table = Some(arguments.table.data.as_path());
        let mut outputs = outputs_besides(path, source, table, arguments.force);
        let mut files = Vec::new();
        for place in 1..=arguments.solutions {
            let description = in_folder(folder, &format!("{name}_{place}.mech"))?;
            let drawing = in_folder(folder, &format!("{name}_{place}.svg"))?;
            files.push([
                outputs.file(&description, SIGNATURE)?,
                outputs.file(&drawing, picture::SIGNATURE)?,
            ]);
        }
        Ok(Files(files))
    }

    /// Writes the files of the solutions that were found.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn write(&mut self, report: &Report<'_>, is_quiet: bool) -> Result<(), Problem> {
        let files = self.0.drain(..).zip(report.solutions).enumerate();
        for (place, ([description, drawing], solution)) in files {
            let picture = picture(report, solution, place + 1)?;
            let written = [
                (description, solution.text.as_str()),
                (drawing, picture.as_str()),
            ];
            for (output, text) in written {
                let path = output.path().to_path_buf();
                output.write(|output| output.write_all(text.as_bytes()))?;
                if !is_quiet {
                    print(|output| writeln!(output, "wrote {}", path.display()))?;
                }
            }
        }
        Ok(())
    }
}

/// Positions of points at every instant.
#[derive(Default)]
struct Places(Vec<Vec<[f64; 2]>>);

impl Sink for Places {
    fn take(&mut self, shown: &Shown<'_>) -> std::io::Result<()> {
        let places = shown.motions.iter().map(|motion| motion.position);
        self.0.push(places.collect());
        Ok(())
    }
}

/// Draws a solution at its first row, with the paths of points that have targets, and the targets on them.
fn picture(report: &Report<'_>, solution: &Certified, number: usize) -> Result<String, Problem> {
    let view = &solution.check.interpreted;
    let system = view.system();
    let targets = report.synthesis.targets();
    let mut points: Vec<usize> = Vec::new();
    for target in &targets.columns {
        if let Observable::Point {
            place, level: 0, ..
        } = target.observable
            && !points.contains(&place)
        {
            points.push(place);
        }
    }
    let [from, to] = report.range;
    let step = ((to - from) / PLACES as f64).max(f64::MIN_POSITIVE);
    let schedule = match to > from {
        true => Schedule::whole(from, to, step),
        false => Schedule::instants(from, &[from], 1.0),
    };
    let schedule = schedule.map_err(|text| Problem(format!("error: {text}")))?;
    let selection = Wanted {
        points: points.clone(),
        ..Wanted::default()
    };
    let mut places = Places::default();
    let mut motion = Followed::new(view.clone(), selection, from, None);
    let followed = motion.follow(&schedule, &mut [&mut places], |_| ());
    followed.map_err(Problem::of)?;
    let paths = points.iter().enumerate().map(|(column, point)| Traced {
        name: system.outputs[*point].name.clone(),
        points: places.0.iter().map(|it| it[column]).collect(),
        ticks: targeted(report, *point),
    });
    let paths: Vec<Traced> = paths.collect();
    let first = solution.candidate.times.first().copied().unwrap_or(from);
    let assembled = report.synthesis.assembled(&solution.candidate, first);
    let Some(instant) = assembled else {
        return Err(Problem("error: a solution cannot be drawn".to_string()));
    };
    let options = Options {
        caption: format!("{}, solution {number}", system.mechanism.title()),
        ..Options::default()
    };
    let drawing = drawing::draw(
        view.pool(),
        system,
        &pose(report.synthesis.view(), &instant),
        &[],
        &paths,
        &options,
    );
    Ok(picture::signed(&drawing))
}

/// Returns the targets of a point whose both coordinates are given.
fn targeted(report: &Report<'_>, point: usize) -> Vec<[f64; 2]> {
    let targets = report.synthesis.targets();
    let column = |wanted: usize| {
        let mut columns = targets.columns.iter();
        columns.find(|it| {
            matches!(it.observable, Observable::Point { place, axis, level: 0 } if place == point && axis == wanted)
        })
    };
    let (Some(x), Some(y)) = (column(0), column(1)) else {
        return Vec::new();
    };
    let rows = x.values.iter().zip(&y.values);
    rows.filter_map(|(x, y)| Some([(*x)?, (*y)?])).collect()
}
