//! Writes the coordinates of a point that has been dragged.

use crate::edit::Edit;
use crate::handles::{Coordinate, Handle};

/// Returns the edits that move a point to a position in m, in the frame of the handle. A coordinate that rounds to the written one is
/// kept.
///
/// Each number keeps its unit. It is rounded to 10⁻⁴ of the mechanism's characteristic length or to the decimals that are there,
/// whichever is finer.
///
/// `None` if the point cannot be dragged, if the position is not finite, or if the text is not that of the handle.
pub fn moved(text: &str, handle: &Handle, position: [f64; 2]) -> Option<Vec<Edit>> {
    let coordinates = handle.coordinates.as_ref().ok()?;
    let mut edits = Vec::new();
    for (coordinate, value) in coordinates.iter().zip(position) {
        let is_there = text.get(coordinate.span.range()) == Some(coordinate.written.as_str());
        if !is_there || !value.is_finite() {
            return None;
        }
        edits.extend(edit(coordinate, value));
    }
    Some(edits)
}

/// Returns the rounding of a moved coordinate, in m.
pub fn step(coordinate: &Coordinate) -> f64 {
    let unit = 1.0 / coordinate.measured.of_si(1.0);
    unit / 10_f64.powi(decimals(coordinate) as i32)
}

/// Returns the edit of one coordinate; `None` if its number is kept.
fn edit(coordinate: &Coordinate, value: f64) -> Option<Edit> {
    let Coordinate { measured, unit, .. } = coordinate;
    let there = written_decimals(&coordinate.digits);
    let decimals = decimals(coordinate);
    let [new, old] = [value, coordinate.value].map(|it| measured.of_si(it));
    let mut number = format!("{new:.decimals$}");
    if (new - old).abs() * 10_f64.powi(decimals as i32) < 0.5 {
        return None;
    }
    if decimals > there {
        let zeros = number.len() - number.trim_end_matches('0').len();
        number.truncate(number.len() - zeros.min(decimals - there));
    }
    let number = number.trim_end_matches('.');
    let number = match number.strip_prefix('-') {
        Some(digits) if digits.bytes().all(|it| matches!(it, b'0' | b'.')) => digits,
        _ => number,
    };
    Some(Edit {
        span: coordinate.span,
        text: format!("{number}{unit}"),
    })
}

/// Returns the largest number of decimals that a moved coordinate has in its unit.
fn decimals(coordinate: &Coordinate) -> usize {
    let resolution = coordinate.measured.of_si(coordinate.resolution);
    let (mut needed, mut step) = (0, 1.0);
    while step > resolution && needed < f64::DIGITS as usize {
        step /= 10.0;
        needed += 1;
    }
    let there = written_decimals(&coordinate.digits);
    needed.max(there).min(f64::DIGITS as usize)
}

/// Returns the number of decimals of digits with an exponent.
fn written_decimals(digits: &str) -> usize {
    let (digits, exponent) = digits.split_once(['e', 'E']).unwrap_or((digits, "0"));
    let written = digits.split_once('.').map_or(0, |(_, it)| it.len());
    let exponent: i64 = exponent.parse().unwrap_or(0);
    let decimals = i64::try_from(written).unwrap_or(0).saturating_sub(exponent);
    usize::try_from(decimals.max(0)).unwrap_or(0)
}
