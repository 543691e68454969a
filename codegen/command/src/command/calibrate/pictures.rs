//! Draws the residuals of a fit, one picture for each column, as `compare` does.

use linkwright_calibrate::Fit;
use linkwright_codegen::stages::system::System;
use linkwright_page::motion::Compared;
use linkwright_solver::Comparison;
use linkwright_solver::data::Data;

use super::super::{Problem, print};
use crate::output::Output;
use crate::report::comparison::{Column, Report};
use crate::report::comparison_plot::picture;

/// Draws both curves of each column, and their difference below them.
pub fn draw(
    fit: &Fit,
    data: &Data,
    system: &System,
    outputs: Vec<Output>,
    is_quiet: bool,
) -> Result<(), Problem> {
    let columns = data.measured.iter().zip(&fit.residuals[1]);
    let columns = columns.map(|(measured, left)| {
        let values = measured.values.iter().zip(left);
        let rows = data.times.iter().zip(left);
        let compared = Compared {
            solved: values
                .map(|(value, left)| Some((*value)? - (*left)?))
                .collect(),
            is_angle: measured.quantity.observable.is_angle(system),
            comparison: Comparison::of(rows.filter_map(|(t, left)| Some((*t, (*left)?)))),
        };
        Column {
            compared,
            tolerance: None,
            measured,
        }
    });
    let report = Report {
        title: system.mechanism.title(),
        columns: columns.collect(),
        error: None,
        data,
    };
    for (output, column) in outputs.into_iter().zip(&report.columns) {
        let drawn = picture(&report, column).map_err(|text| Problem(format!("error: {text}")))?;
        let Some(drawn) = drawn else { continue };
        let path = output.path().to_path_buf();
        output.write(|output| output.write_all(drawn.as_bytes()))?;
        if !is_quiet {
            print(|output| writeln!(output, "wrote {}", path.display()))?;
        }
    }
    Ok(())
}
