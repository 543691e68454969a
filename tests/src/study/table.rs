//! Writes measurements as a table in Markdown, aligned, in the order of the methods.

use super::measurement::Measurement;

/// The table of one mechanism. `baseline` is what the ratios refer to (ns per frame).
pub fn markdown(measurements: &[Measurement], baseline: f64) -> String {
    let mut rows = vec![
        [
            "method",
            "scalar",
            "position",
            "velocity",
            "acceleration",
            "ns per frame",
            "fastest–slowest",
            "times faster than the baseline",
        ]
        .map(str::to_string),
    ];
    for it in measurements {
        let [position, velocity, acceleration] = it.errors.map(|error| format!("{error:.1e}"));
        rows.push([
            it.name.clone(),
            it.scalar.to_string(),
            position,
            velocity,
            acceleration,
            rounded(it.time),
            format!("{}–{}", rounded(it.range[0]), rounded(it.range[1])),
            format!("{:.2}", baseline / it.time),
        ]);
    }
    aligned(&rows, 2)
}

/// A time with at least three digits.
fn rounded(time: f64) -> String {
    if time < 100.0 {
        format!("{time:.1}")
    } else {
        format!("{time:.0}")
    }
}

/// A table whose first row is the header; the first `left` columns are aligned to the left, the others to the right.
pub fn aligned<R: AsRef<[String]>>(rows: &[R], left: usize) -> String {
    let columns = rows.first().map_or(0, |row| row.as_ref().len());
    let width = |column: usize| {
        rows.iter()
            .map(|row| row.as_ref()[column].chars().count())
            .max()
            .unwrap_or(0)
    };
    let mut text = String::new();
    for (index, row) in rows.iter().enumerate() {
        for (column, cell) in row.as_ref().iter().enumerate() {
            let width = width(column);
            text += &if column < left {
                format!("| {cell:<width$} ")
            } else {
                format!("| {cell:>width$} ")
            };
        }
        text += "|\n";
        if index == 0 {
            for column in 0..columns {
                let dashes = "-".repeat(width(column) + 1);
                text += &if column < left {
                    format!("|{dashes}-")
                } else {
                    format!("|{dashes}:")
                };
            }
            text += "|\n";
        }
    }
    text
}
