//! Writes the motion of points and coordinates as tables of a readable number of times.
//!
//! Columns are aligned at the decimal point. A column has exponents only if six decimals would not show it. Numbers below 1e-12 of
//! the mechanism's size count as zero.

use linkwright::PointMotion;
use linkwright_codegen::stages::emit::text::shown_width;
use linkwright_codegen::stages::units::OutputUnit;
use linkwright_solver::number::{fixed, scientific};

/// Largest number of rows of a table.
const ROWS: usize = 11;

/// Fraction of the mechanism's size (and of that per second) that counts as rounding.
const NOISE: f64 = 1e-12;

/// Relative error up to which a printed time counts as exact, and its largest number of decimals.
const TIME_TOLERANCE: f64 = 1e-12;
const MOST_DECIMALS: usize = 9;

/// Largest magnitude of a column without exponents: from the first value to below the second.
const SMALLEST_PLAIN: f64 = 1e-2;
const LARGEST_PLAIN: f64 = 1e7;

/// Returns the indices of the frames to print: all of a few, otherwise every k-th and the last, with k of the series 1, 2, 5, 10 …
/// so that times stay round.
pub fn shown(count: usize) -> Vec<usize> {
    let last = count.saturating_sub(1);
    let strides = (0..).flat_map(|power| [1, 2, 5].map(|digit| digit * 10_usize.pow(power)));
    let stride = strides
        .take_while(|stride| *stride <= last)
        .find(|stride| last.div_ceil(*stride) < ROWS)
        .unwrap_or(last.max(1));
    let mut indices: Vec<usize> = (0..count).step_by(stride).collect();
    if !last.is_multiple_of(stride) {
        indices.push(last);
    }
    indices
}

/// True if a point rests up to rounding. `size` is the characteristic length of the mechanism.
pub fn rests(motions: &[PointMotion<f64>], size: f64) -> bool {
    [0, 1].into_iter().all(|axis| {
        let values = motions
            .iter()
            .map(|it| [it.position, it.velocity, it.acceleration].map(|level| level[axis]));
        stands(&values.collect::<Vec<_>>(), size)
    })
}

/// True if a coordinate rests up to rounding. `size` is a characteristic value of the coordinate.
pub fn stands(values: &[[f64; 3]], size: f64) -> bool {
    let noise = |value: f64| value.abs() <= NOISE * size;
    let Some(first) = values.first() else {
        return true;
    };
    values
        .iter()
        .all(|it| noise(it[0] - first[0]) && noise(it[1]) && noise(it[2]))
}

/// Column with its name.
pub struct Column {
    name: String,
    cells: Vec<String>,
}

impl Column {
    /// Creates a column of times with the decimals that they need.
    pub fn of_times(values: &[f64]) -> Column {
        Column {
            name: "t".to_string(),
            cells: exact(values),
        }
    }

    /// Creates a column of values with six decimals or exponents. `size` is a characteristic value.
    pub fn new(name: impl Into<String>, values: &[f64], size: f64) -> Column {
        Column {
            name: name.into(),
            cells: formatted(values, size),
        }
    }

    /// Creates a column of texts.
    pub fn of_texts(name: impl Into<String>, cells: Vec<String>) -> Column {
        Column {
            name: name.into(),
            cells,
        }
    }

    /// Width in characters.
    pub fn width(&self) -> usize {
        let texts = self.cells.iter().chain([&self.name]);
        texts.map(|it| shown_width(it)).max().unwrap_or(0)
    }
}

/// Returns position, velocity and acceleration of a point as columns in their units; `size` is in SI units.
pub fn of_point(motions: &[PointMotion<f64>], units: &[OutputUnit; 3], size: f64) -> Vec<Column> {
    let column = |name: &str, unit: &OutputUnit, pick: &dyn Fn(&PointMotion<f64>) -> f64| {
        let values: Vec<f64> = motions.iter().map(|it| unit.of_si(pick(it))).collect();
        Column::new(name, &values, unit.of_si(size))
    };
    let [position, velocity, acceleration] = units;
    vec![
        column("x", position, &|it| it.position[0]),
        column("y", position, &|it| it.position[1]),
        column("vx", velocity, &|it| it.velocity[0]),
        column("vy", velocity, &|it| it.velocity[1]),
        column("ax", acceleration, &|it| it.acceleration[0]),
        column("ay", acceleration, &|it| it.acceleration[1]),
    ]
}

/// Returns columns of equal length side by side, each aligned to the right.
pub fn table<'a>(columns: impl IntoIterator<Item = &'a Column>) -> String {
    let columns: Vec<&Column> = columns.into_iter().collect();
    let rows = columns.first().map_or(0, |it| it.cells.len());
    let mut text = String::new();
    for row in 0..=rows {
        for column in &columns {
            let cell = match row {
                0 => &column.name,
                _ => &column.cells[row - 1],
            };
            let gap = 2 + column.width() - shown_width(cell);
            text.push_str(&" ".repeat(gap));
            text.push_str(cell);
        }
        text.push('\n');
    }
    text
}

/// Formats all values with as many decimals as the longest needs.
fn exact(values: &[f64]) -> Vec<String> {
    let needed = |value: &f64| {
        (0..MOST_DECIMALS)
            .find(|decimals| {
                let printed: f64 = fixed(*value, *decimals).parse().unwrap_or(f64::NAN);
                (printed - value).abs() <= TIME_TOLERANCE * value.abs()
            })
            .unwrap_or(MOST_DECIMALS)
    };
    let decimals = values.iter().map(needed).max().unwrap_or(0);
    values.iter().map(|value| fixed(*value, decimals)).collect()
}

fn formatted(values: &[f64], size: f64) -> Vec<String> {
    let largest = values.iter().fold(0.0_f64, |most, it| most.max(it.abs()));
    let plain = (SMALLEST_PLAIN..LARGEST_PLAIN).contains(&largest) || largest <= NOISE * size;
    let cell = |value: &f64| match plain {
        true => fixed(*value, 6),
        false => scientific(*value, 6),
    };
    values.iter().map(cell).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_rows_with_round_times() {
        assert!(shown(0).is_empty());
        assert_eq!(shown(1), [0]);
        assert_eq!(shown(11).len(), 11);
        assert_eq!(shown(501), (0..=10).map(|k| 50 * k).collect::<Vec<_>>());
        assert_eq!(shown(13), [0, 2, 4, 6, 8, 10, 12]);
        assert_eq!(shown(1008), [0, 200, 400, 600, 800, 1000, 1007]);
        for count in 2..5000 {
            let rows = shown(count);
            assert!(
                rows.len() <= ROWS && rows.is_sorted_by(|a, b| a < b),
                "{rows:?}"
            );
            assert_eq!((rows[0], rows[rows.len() - 1]), (0, count - 1));
        }
    }

    #[test]
    fn rounding_is_no_motion() {
        let at = |x: f64, vx: f64| PointMotion {
            position: [x, 0.0],
            velocity: [vx, 0.0],
            acceleration: [0.0; 2],
        };
        assert!(rests(&[at(1.0, 0.0), at(1.0 + 2e-16, 1e-16)], 1.0));
        assert!(!rests(&[at(1.0, 0.0), at(1.0 + 1e-9, 0.0)], 1.0));
        assert!(!rests(&[at(1.0, 1e-9), at(1.0, 0.0)], 1.0));
    }

    #[test]
    fn columns_show_small_motions_but_not_rounding() {
        assert_eq!(formatted(&[1e-17, -1e-17], 1.0), ["0.000000", "0.000000"]);
        assert_eq!(
            formatted(&[1e-7, 0.0], 1.0),
            ["1.000000e-07", "0.000000e+00"]
        );
        assert_eq!(formatted(&[1.5, -0.0], 1.0), ["1.500000", "0.000000"]);
        assert_eq!(exact(&[0.0, 0.1 + 0.2, 1.25]), ["0.00", "0.30", "1.25"]);
    }
}
