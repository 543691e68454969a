//! Draws a measured column and the motion as an SVG: both curves over time, and below them their difference.

use linkwright_solver::comparison::difference;

use super::comparison::{Column, Report};
use super::plot::{self, Panel};
use linkwright_page::motion::Extreme;
use linkwright_solver::data::Data;

/// Returns a file name for each column. Characters that file systems refuse are replaced, and equal names get a number.
pub fn file_names(data: &Data) -> Vec<String> {
    let mut taken: Vec<String> = Vec::new();
    let names = data.measured.iter().map(|it| {
        let is_plain = |it: char| it.is_alphanumeric() || matches!(it, '_' | '-' | '.');
        let plain: String = it
            .name
            .chars()
            .map(|it| if is_plain(it) { it } else { '_' })
            .collect();
        let plain = plain.trim_start_matches('.').to_string();
        let (mut name, mut number) = (plain.clone(), 2);
        while taken.contains(&name.to_lowercase()) {
            name = format!("{plain}-{number}");
            number += 1;
        }
        taken.push(name.to_lowercase());
        format!("{name}.svg")
    });
    names.collect()
}

/// Draws a column; `None` if fewer than two rows can be compared.
///
/// # Errors
/// Errors of the drawing library.
pub fn picture(report: &Report<'_>, column: &Column<'_>) -> Result<Option<String>, String> {
    let measured_column = column.measured;
    let in_unit = |value: f64| measured_column.scale.unit.of_si(value);
    let (mut measured, mut solved, mut apart): (Vec<Extreme>, Vec<Extreme>, Vec<Extreme>) =
        Default::default();
    for (t, (a, b)) in report
        .data
        .times
        .iter()
        .zip(measured_column.values.iter().zip(&column.compared.solved))
    {
        if let (Some(a), Some(b)) = (a, b) {
            let difference = difference(*a, *b, column.compared.is_angle);
            // Measured angles are drawn in the turn of the solved ones.
            measured.push((*t, in_unit(b + difference)));
            solved.push((*t, in_unit(*b)));
            apart.push((*t, in_unit(difference)));
        }
    }
    if measured.len() < 2 || measured[0].0 == measured[measured.len() - 1].0 {
        return Ok(None);
    }
    let largest = |curve: &[Extreme]| curve.iter().fold(0.0_f64, |most, it| most.max(it.1.abs()));
    let positive = |value: f64| if value > 0.0 { value } else { 1.0 };
    let unit = measured_column.scale.text.as_str();
    let panels = [
        Panel {
            title: measured_column.quantity.name.clone(),
            unit,
            reference: positive(largest(&solved)),
            curves: vec![("data", measured), ("solved", solved)],
        },
        Panel {
            title: "data - solved".to_string(),
            unit,
            reference: positive(largest(&apart)),
            curves: vec![("", apart)],
        },
    ];
    let title = format!(
        "{} and {} of {}",
        measured_column.name, measured_column.quantity.name, report.title
    );
    plot::picture(&title, &panels)
        .map(Some)
        .map_err(|error| format!("cannot draw `{}`: {error}", measured_column.name))
}
