//! Compares a measured motion with the solved one.

use std::io;

use linkwright_solver::Observable;
use linkwright_solver::comparison::difference;
use linkwright_solver::{Comparison, Interpreted, Schedule};

use super::description::{chosen, determined, interpreted, outputs_besides, set_all, source};
use super::{Outcome, Problem, in_folder, print, say};
use crate::arguments::Compare;
use crate::data::{Data, sizes};
use crate::output::Output;
use crate::progress::Progress;
use crate::report::comparison::{self, Column, Report};
use crate::report::{comparison_json, comparison_plot, picture};
use linkwright_page::motion::{Followed, Shown, Sink, Wanted};

/// Compares a table with a description and reports the differences.
///
/// # Errors
/// The description or the table has errors, an option cannot be used, or a picture cannot be written. An [`Outcome`] reports a mechanism
/// that cannot be solved and differences beyond their tolerances.
pub fn run(arguments: &Compare) -> Result<Outcome, Problem> {
    let source =
        source(&arguments.described.file)?.reported_in(arguments.reported_in.units.clone());
    let derived = determined(&source, arguments.described.motion.as_deref())?;
    let derived = set_all(derived, &arguments.setting.set)?;
    let data = Data::read(&arguments.table, &derived.pool, &derived.system).map_err(Problem)?;
    let derived = data.drive(derived).map_err(Problem)?;
    let tolerances = sizes("--tolerance", &arguments.tolerance, &data).map_err(Problem)?;
    let start = arguments.from.unwrap_or(data.times[0]);
    let schedule = Schedule::instants(start, &data.times, arguments.step)
        .map_err(|text| Problem(format!("error: {text}")))?;
    let mut pictures: Vec<Output> = Vec::new();
    if let Some(folder) = &arguments.plot {
        let mut outputs = outputs_besides(
            &arguments.described.file,
            &source,
            Some(&arguments.table.data),
            arguments.force,
        );
        for name in comparison_plot::file_names(&data) {
            let path = in_folder(folder, &name)?;
            pictures.push(outputs.file(&path, picture::SIGNATURE)?);
        }
    }
    let interpreted = interpreted(&derived, &source)?;
    let chosen = chosen(&arguments.setting.branch, &interpreted, start)?;
    let selection = Wanted {
        points: Vec::new(),
        coordinates: Vec::new(),
        monitor: false,
        curves: false,
    };
    let mut collected = Collected {
        view: interpreted.clone(),
        observables: data
            .measured
            .iter()
            .map(|it| it.quantity.observable)
            .collect(),
        times: Vec::new(),
        values: Vec::new(),
    };
    let mut motion = Followed::new(interpreted, selection, start, chosen);
    let mut progress = Progress::new(schedule.visits());
    motion
        .follow(&schedule, &mut [&mut collected], |count| {
            progress.reached(count)
        })
        .map_err(Problem::of)?;
    progress.finish();
    let columns = data.measured.iter().enumerate().map(|(place, measured)| {
        let is_angle = measured.quantity.observable.is_angle(&derived.system);
        let solved: Vec<Option<f64>> = data
            .times
            .iter()
            .map(|t| Some(collected.at(*t)?[place]).filter(|it| it.is_finite()))
            .collect();
        let rows = data.times.iter().zip(measured.values.iter().zip(&solved));
        let differences = rows.filter_map(|(t, (measured, solved))| {
            Some((*t, difference((*measured)?, (*solved)?, is_angle)))
        });
        Column {
            comparison: Comparison::of(differences),
            tolerance: tolerances[place],
            measured,
            is_angle,
            solved,
        }
    });
    let report = Report {
        title: motion.title(),
        columns: columns.collect(),
        error: motion.error.as_deref(),
        data: &data,
    };
    print(|output| match arguments.json {
        true => comparison_json::write(&report, output),
        false => comparison::write(&report, output),
    })?;
    if !arguments.json {
        for warning in &motion.warnings {
            say(&format!("warning: {warning}"));
        }
        for hint in report.hints() {
            say(&hint);
        }
    }
    if let Some(error) = &motion.error {
        say(&format!("error: `{}` {error}", motion.title()));
    }
    for (output, column) in pictures.into_iter().zip(&report.columns) {
        let picture = comparison_plot::picture(&report, column)
            .map_err(|text| Problem(format!("error: {text}")))?;
        let Some(picture) = picture else { continue };
        let path = output.path().to_path_buf();
        output.write(|output| output.write_all(picture.as_bytes()))?;
        if !arguments.json {
            print(|output| writeln!(output, "wrote {}", path.display()))?;
        }
    }
    Ok(match report.is_within() && motion.error.is_none() {
        true => Outcome::Done,
        false => Outcome::Failed,
    })
}

/// Compared values, instant by instant.
struct Collected {
    view: Interpreted,
    observables: Vec<Observable>,
    times: Vec<f64>,
    values: Vec<Vec<f64>>,
}

impl Collected {
    /// Returns the values at a visited time; `None` if the time was not visited.
    fn at(&self, t: f64) -> Option<&[f64]> {
        let place = self.times.binary_search_by(|it| it.total_cmp(&t)).ok()?;
        self.values.get(place).map(Vec::as_slice)
    }
}

impl Sink for Collected {
    fn take(&mut self, shown: &Shown<'_>) -> io::Result<()> {
        self.times.push(shown.instant.t());
        self.values.push(Observable::values(
            &self.view,
            &self.observables,
            shown.instant,
        ));
        Ok(())
    }
}
