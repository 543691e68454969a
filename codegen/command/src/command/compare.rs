//! Compares a measured motion with the solved one.

use linkwright_codegen::stages::system::Derived;
use linkwright_page::motion::{Followed, Wanted};
use linkwright_solver::Schedule;
use linkwright_solver::data::{Data, bytes, sizes};

use super::description::{chosen, determined, interpreted, outputs_besides, set_all, source};
use super::{Outcome, Problem, in_folder, print, say};
use crate::arguments::{Compare, Table};
use crate::output::Output;
use crate::progress::Progress;
use crate::report::comparison::{self, Column, Report};
use crate::report::{comparison_json, comparison_plot, picture};

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
    let data = read(&arguments.table, &derived, true)?;
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
    let selection = Wanted::default();
    let mut motion = Followed::new(interpreted, selection, start, chosen);
    let mut progress = Progress::new(schedule.visits());
    let compared = motion
        .compare(&data, &schedule, &mut [], |count| progress.reached(count))
        .map_err(Problem::of)?;
    progress.finish();
    let measured = data.measured.iter().zip(&tolerances);
    let columns = compared.into_iter().zip(measured);
    let columns = columns.map(|(compared, (measured, tolerance))| Column {
        compared,
        tolerance: *tolerance,
        measured,
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

/// Reads the table of the arguments.
///
/// # Errors
/// The table has errors, an option cannot be used, or no column measures a quantity of the mechanism.
pub fn read(table: &Table, derived: &Derived, needs_times: bool) -> Result<Data, Problem> {
    let Derived { pool, system } = derived;
    let name = table.data.display().to_string();
    let bytes = bytes(&table.data).map_err(Problem)?;
    Data::read(&name, &bytes, &table.reading(needs_times), pool, system).map_err(Problem)
}
