//! *A measured column and the motion* → *an SVG*: both curves over time, and below them their difference.

use linkwright_solver::comparison::difference;

use super::comparison::{Column, Report};
use super::plot::{self, Panel};
use crate::data::Data;
use crate::motion::Extreme;

/// A file name for each column: what file systems refuse is replaced, and what is equal then gets a number.
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

/// The picture of a column; `None` where fewer than two rows can be compared.
///
/// # Errors
/// What the drawing library refuses.
pub fn picture(report: &Report<'_>, column: &Column<'_>) -> Result<Option<String>, String> {
    let own = column.measured;
    let shown = |value: f64| own.scale.unit.of_si(value);
    let (mut measured, mut solved, mut apart): (Vec<Extreme>, Vec<Extreme>, Vec<Extreme>) =
        Default::default();
    for (t, (a, b)) in report
        .data
        .times
        .iter()
        .zip(own.values.iter().zip(&column.solved))
    {
        if let (Some(a), Some(b)) = (a, b) {
            let difference = difference(*a, *b, column.is_angle);
            // Angles are drawn in the turn of the motion.
            measured.push((*t, shown(b + difference)));
            solved.push((*t, shown(*b)));
            apart.push((*t, shown(difference)));
        }
    }
    if measured.len() < 2 || measured[0].0 == measured[measured.len() - 1].0 {
        return Ok(None);
    }
    let largest = |curve: &[Extreme]| curve.iter().fold(0.0_f64, |most, it| most.max(it.1.abs()));
    let positive = |value: f64| if value > 0.0 { value } else { 1.0 };
    let unit = own.scale.text.as_str();
    let panels = [
        Panel {
            title: own.quantity.name.clone(),
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
    let title = format!("{} and {} of {}", own.name, own.quantity.name, report.title);
    plot::picture(&title, &panels)
        .map(Some)
        .map_err(|error| format!("cannot draw `{}`: {error}", own.name))
}
