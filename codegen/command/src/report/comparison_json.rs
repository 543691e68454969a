//! Writes measured and solved columns as one JSON object.
//!
//! | key | value |
//! |---|---|
//! | `mechanism`, `data` | name of the mechanism, and path of the data file |
//! | `read` | interpretation of the file, in words |
//! | `rows`, `from`, `to` | number of rows, and their first and last time (s) |
//! | `columns` | `{column, quantity, how, doubt, unit, unit_from, count, rms, largest, t, tolerance, within}` each, in the unit of the column; `counts_turns` is true of the rate of an angle in `1/min` or `Hz`; `how` is `name`, `option` or `guess`, `unit_from` is `header`, `option` or `assumed` |
//! | `left_out` | `{column, why}` each |
//! | `within` | true if all differences are within their tolerances; absent without tolerances |
//! | `error` | reason of an early end of the motion, if there is one |

use std::io::{self, Write};

use serde::Serialize;

use super::comparison::Report;
use linkwright_solver::data::{How, Origin};

#[derive(Serialize)]
struct Object<'a> {
    mechanism: &'a str,
    data: &'a str,
    read: String,
    rows: usize,
    from: f64,
    to: f64,
    columns: Vec<Entry<'a>>,
    left_out: Vec<LeftOut<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    within: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<&'a str>,
}

#[derive(Serialize)]
struct Entry<'a> {
    column: &'a str,
    quantity: &'a str,
    how: &'a str,
    #[serde(skip_serializing_if = "str::is_empty")]
    doubt: &'a str,
    unit: &'a str,
    unit_from: &'a str,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    counts_turns: bool,
    count: usize,
    rms: Option<f64>,
    largest: Option<f64>,
    t: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tolerance: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    within: Option<bool>,
}

#[derive(Serialize)]
struct LeftOut<'a> {
    column: &'a str,
    why: &'a str,
}

/// Writes the object and a line break.
///
/// # Errors
/// Errors of `output`.
pub fn write(report: &Report<'_>, output: &mut dyn Write) -> io::Result<()> {
    let data = report.data;
    let columns = report.columns.iter().map(|column| {
        let comparison = column.compared.comparison;
        let measured = column.measured;
        let in_unit = |value: f64| measured.scale.unit.of_si(value);
        let (how, doubt) = match &measured.how {
            How::Named => ("name", ""),
            How::Chosen => ("option", ""),
            How::Guessed(doubt) => ("guess", doubt.as_str()),
        };
        Entry {
            column: &measured.name,
            quantity: &measured.quantity.name,
            unit: &measured.scale.text,
            unit_from: match measured.scale.origin {
                Origin::Header => "header",
                Origin::Option => "option",
                Origin::Assumed => "assumed",
            },
            counts_turns: measured.scale.counts_turns,
            count: comparison.map_or(0, |it| it.count),
            rms: comparison.map(|it| in_unit(it.rms)),
            largest: comparison.map(|it| in_unit(it.largest)),
            t: comparison.map(|it| it.at),
            tolerance: column.tolerance.map(in_unit),
            within: column.is_within(),
            how,
            doubt,
        }
    });
    let left_out = data
        .left_out
        .iter()
        .map(|(column, why)| LeftOut { column, why });
    let object = Object {
        mechanism: &report.title,
        data: &data.name,
        read: data.columns.reading(),
        rows: data.times.len(),
        from: data.times.first().copied().unwrap_or(f64::NAN),
        to: data.times.last().copied().unwrap_or(f64::NAN),
        columns: columns.collect(),
        left_out: left_out.collect(),
        within: report.has_tolerances().then(|| report.is_within()),
        error: report.error,
    };
    serde_json::to_writer_pretty(&mut *output, &object)?;
    writeln!(output)
}
