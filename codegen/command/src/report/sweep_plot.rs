//! Draws the extremes of a quantity over one or two varied values as an SVG: curves, or two maps. Failed sets are hatched.

use plotters::prelude::*;

use super::hatching::{Surface, hatching};
use super::plot::{Drawing, Refused, UNITS, drawn, extent, label_format, mesh};

/// Width and height of the curves and of the maps, in pixels.
const CURVES: (u32, u32) = (960, 480);
const MAPS: (u32, u32) = (1160, 520);

/// Width of a color scale with its labels, in pixels.
const SCALE: u32 = 104;

/// Blue and vermillion of the palette of Okabe and Ito, for the minimum and the maximum.
const COLORS: [RGBColor; 2] = [RGBColor(0, 114, 178), RGBColor(213, 94, 0)];

/// Colors of maps from the lowest to the highest value, of rising lightness.
const LADDER: [RGBColor; 6] = [
    RGBColor(52, 24, 92),
    RGBColor(54, 82, 141),
    RGBColor(33, 125, 140),
    RGBColor(46, 170, 120),
    RGBColor(140, 205, 75),
    RGBColor(248, 228, 60),
];

/// Number of steps of a color scale.
const STEPS: u32 = 64;

/// Part of a range that stays empty around it.
const MARGIN: f64 = 0.06;

/// Part of the magnitude of a single value that surrounds it.
const AROUND: f64 = 0.1;

const TITLES: [&str; 2] = ["minimum", "maximum"];

/// Axis of a picture.
#[derive(Clone, Debug)]
pub struct Axis {
    /// Name with its unit.
    pub label: String,
    /// Values of a grid, ascending; empty for scattered sets.
    pub values: Vec<f64>,
}

/// Set in a picture.
#[derive(Clone, Debug)]
pub struct Point {
    /// Varied values, one or two.
    pub at: Vec<f64>,
    /// Minimum and maximum; `None` if the set failed.
    pub extremes: Option<[f64; 2]>,
}

/// Draws a quantity over one or two axes; `None` if no set is solved, or all have one value.
///
/// # Errors
/// Errors of the drawing library.
pub fn picture(
    title: &str,
    quantity: &str,
    axes: &[Axis],
    points: &[Point],
) -> Result<Option<String>, String> {
    let solved = points.iter().filter(|it| it.extremes.is_some()).count();
    let varies = |axis: usize| {
        let (low, high) = extent(points.iter().filter_map(|it| it.at.get(axis)).copied());
        low < high
    };
    if solved == 0 || !(0..axes.len()).all(varies) {
        return Ok(None);
    }
    let drawing = match axes {
        [axis] => drawn(title, CURVES, |area| curves(area, quantity, axis, points)),
        [across, up] => drawn(title, MAPS, |area| {
            for (area, which) in area.split_evenly((1, 2)).iter().zip(0..) {
                map(area, quantity, [across, up], points, which)?;
            }
            Ok(())
        }),
        _ => return Ok(None),
    };
    drawing
        .map(Some)
        .map_err(|error| format!("cannot draw `{quantity}`: {error}"))
}

fn curves(
    area: &Drawing<'_>,
    quantity: &str,
    axis: &Axis,
    points: &[Point],
) -> Result<(), Refused> {
    let mut points: Vec<&Point> = points.iter().collect();
    points.sort_by(|a, b| a.at[0].total_cmp(&b.at[0]));
    let values = points.iter().filter_map(|it| it.extremes).flatten();
    let (low, high) = around(extent(values));
    let (begin, end) = extent(points.iter().map(|it| it.at[0]));
    let mut chart = ChartBuilder::on(area)
        .margin(8 * UNITS)
        .margin_right(112 * UNITS)
        .x_label_area_size(42 * UNITS)
        .y_label_area_size(84 * UNITS)
        .build_cartesian_2d(begin..end, low..high)?;
    mesh(
        &mut chart,
        [(&axis.label, (begin, end), 9), (quantity, (low, high), 7)],
    )?;
    // A failed set takes the range up to the middles between it and its neighbors.
    let middle = |a: usize, b: usize| 0.5 * (points[a].at[0] + points[b].at[0]);
    let surface = Surface {
        ends: [(begin, end), (low, high)],
        size: chart.plotting_area().dim_in_pixel(),
    };
    let failed = points.iter().enumerate();
    let failed = failed.filter(|(_, it)| it.extremes.is_none());
    let failed = failed.map(|(place, _)| {
        let left = middle(place.saturating_sub(1), place);
        let right = middle(place, (place + 1).min(points.len() - 1));
        [[left, right], [low, high]]
    });
    let failed: Vec<[[f64; 2]; 2]> = failed.collect();
    let lines = surface.hatched(&failed).into_iter();
    chart.draw_series(lines.map(hatching))?;
    for (which, color) in COLORS.iter().enumerate() {
        let stroke = color.stroke_width(2 * UNITS);
        for run in points.split(|it| it.extremes.is_none()) {
            let line = run
                .iter()
                .filter_map(|it| Some((it.at[0], it.extremes?[which])));
            match run.len() {
                1 => {
                    let dot = |at| Circle::new(at, 2 * UNITS as i32, color.filled());
                    chart.draw_series(line.map(dot))?;
                }
                _ => {
                    chart.draw_series(LineSeries::new(line, stroke))?;
                }
            }
        }
    }
    let (width, _) = area.dim_in_pixel();
    let left = (width - 104 * UNITS) as i32;
    for (row, (color, title)) in COLORS.iter().zip(TITLES).enumerate() {
        let y = (24 + 22 * row as i32) * UNITS as i32;
        let sample = vec![(left, y), (left + 20 * UNITS as i32, y)];
        area.draw(&PathElement::new(sample, color.stroke_width(2 * UNITS)))?;
        text(
            area,
            title,
            [left + 26 * UNITS as i32, y - 8 * UNITS as i32],
        )?;
    }
    Ok(())
}

fn map(
    area: &Drawing<'_>,
    quantity: &str,
    axes: [&Axis; 2],
    points: &[Point],
    which: usize,
) -> Result<(), Refused> {
    let values = points.iter().filter_map(|it| Some(it.extremes?[which]));
    let (low, high) = extent(values);
    let ends = [0, 1].map(|axis| {
        let (begin, end) = extent(points.iter().map(|it| it.at[axis]));
        // Cells of a grid reach half a step beyond its ends.
        let steps = axes[axis].values.len().saturating_sub(1);
        let half = match steps {
            0 => 0.5 * MARGIN * (end - begin),
            steps => 0.5 * (end - begin) / steps as f64,
        };
        (begin - half, end + half)
    });
    let (width, height) = area.dim_in_pixel();
    let (left, right) = area.split_horizontally(width - SCALE * UNITS);
    let mut chart = ChartBuilder::on(&left)
        .caption(TITLES[which], ("sans-serif", 17 * UNITS))
        .margin(8 * UNITS)
        .x_label_area_size(42 * UNITS)
        .y_label_area_size(84 * UNITS)
        .build_cartesian_2d(ends[0].0..ends[0].1, ends[1].0..ends[1].1)?;
    let surface = Surface {
        ends,
        size: chart.plotting_area().dim_in_pixel(),
    };
    // Cells overlap by a pixel, so that no seams shine through; the last ones end at the axes.
    let overlap = surface.pixel();
    let mut failed: Vec<[[f64; 2]; 2]> = Vec::new();
    for point in points {
        let color = point.extremes.map(|it| color(it[which], low, high));
        let edges = [0, 1].map(|axis| cell(&axes[axis].values, point.at[axis], ends[axis]));
        match (edges, color) {
            ([Some(x), Some(y)], Some(color)) => {
                let corners = [(x[0], y[0]), (x[1] + overlap[0], y[1] + overlap[1])];
                chart.draw_series([Rectangle::new(corners, color.filled())])?;
            }
            ([Some(x), Some(y)], None) => failed.push([x, y]),
            (_, Some(color)) => {
                let at = (point.at[0], point.at[1]);
                chart.draw_series([Circle::new(at, 3 * UNITS as i32, color.filled())])?;
            }
            (_, None) => {
                let at = (point.at[0], point.at[1]);
                let stroke = BLACK.mix(0.6).stroke_width(UNITS);
                chart.draw_series([Cross::new(at, 3 * UNITS as i32, stroke)])?;
            }
        }
    }
    let lines = surface.hatched(&failed).into_iter();
    chart.draw_series(lines.map(hatching))?;
    mesh(
        &mut chart,
        [(&axes[0].label, ends[0], 9), (&axes[1].label, ends[1], 7)],
    )?;
    scale(&right, quantity, (low, high), height)
}

/// Draws a color scale with its labels.
fn scale(
    area: &Drawing<'_>,
    quantity: &str,
    (low, high): (f64, f64),
    height: u32,
) -> Result<(), Refused> {
    let units = UNITS as i32;
    let [top, bottom] = [48 * units, height as i32 - 58 * units];
    let at = |step: u32| bottom - (bottom - top) * step as i32 / STEPS as i32;
    for step in 0..STEPS {
        let share = f64::from(step) / f64::from(STEPS - 1);
        let corners = [(0, at(step + 1)), (18 * units, at(step))];
        area.draw(&Rectangle::new(corners, color(share, 0.0, 1.0).filled()))?;
    }
    let format = label_format(low, high.max(low.next_up()));
    let labels: &[u32] = match low < high {
        true => &[0, 1, 2, 3, 4],
        false => &[2],
    };
    for quarter in labels {
        let share = f64::from(*quarter) / 4.0;
        let value = low * (1.0 - share) + high * share;
        let y = at(quarter * STEPS / 4);
        text(area, &format(&value), [24 * units, y - 8 * units])?;
    }
    text(area, quantity, [0, height as i32 - 40 * units])
}

/// Draws a text with its upper left corner at a place.
fn text(area: &Drawing<'_>, text: &str, [x, y]: [i32; 2]) -> Result<(), Refused> {
    let style = ("sans-serif", 15 * UNITS).into_font();
    Ok(area.draw(&Text::new(text.to_string(), (x, y), style))?)
}

/// Returns the edges of the cell of a value; `None` if the values are not those of a grid.
fn cell(values: &[f64], at: f64, (begin, end): (f64, f64)) -> Option<[f64; 2]> {
    let place = values.iter().position(|it| *it == at)?;
    let middle = |other: Option<&f64>, outer: f64| other.map_or(outer, |it| 0.5 * (at + it));
    let before = place.checked_sub(1).and_then(|it| values.get(it));
    Some([middle(before, begin), middle(values.get(place + 1), end)])
}

/// Returns the color of a value in a range.
fn color(value: f64, low: f64, high: f64) -> RGBColor {
    let share = match high > low {
        true => ((value - low) / (high - low)).clamp(0.0, 1.0),
        false => 0.5,
    };
    let steps = LADDER.len() - 1;
    let place = share * steps as f64;
    let below = (place as usize).min(steps - 1);
    let part = place - below as f64;
    let (one, other) = (LADDER[below], LADDER[below + 1]);
    let mixed = |a: u8, b: u8| (f64::from(a) * (1.0 - part) + f64::from(b) * part).round() as u8;
    RGBColor(
        mixed(one.0, other.0),
        mixed(one.1, other.1),
        mixed(one.2, other.2),
    )
}

/// Returns a range with a margin, or the surroundings of a single value.
fn around((low, high): (f64, f64)) -> (f64, f64) {
    let margin = match low < high {
        true => MARGIN * (high - low),
        false => AROUND * if low == 0.0 { 1.0 } else { low.abs() },
    };
    (low - margin, high + margin)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_meet_in_the_middles() {
        let values = [1.0, 2.0, 4.0];
        let cells = values.map(|it| cell(&values, it, (0.5, 5.0)));
        assert_eq!(
            cells,
            [Some([0.5, 1.5]), Some([1.5, 3.0]), Some([3.0, 5.0])]
        );
        assert_eq!(cell(&[], 1.0, (0.0, 2.0)), None);
    }
}
