//! Draws a motion as one SVG per point and per coordinate: value, rate and acceleration over time.
//!
//! Variations within rounding are drawn as a level line.

use std::ops::Range;

use linkwright_codegen::stages::units::{OutputUnit, OutputUnits};
use linkwright_solver::View;
use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::picture::signed;
use linkwright_page::motion::{Course, Curve, Extreme, Followed};
use linkwright_page::units::{LENGTHS, Units};

/// Width and height of a picture in pixels.
const SIZE: (u32, u32) = (960, 900);

/// Number of units per pixel, a factor of all lengths below. The drawing library rounds coordinates to whole units, which would make
/// curves ragged.
pub(super) const UNITS: u32 = 4;

/// Blue and vermillion of the palette of Okabe and Ito, which remain distinct for the color-blind.
pub(super) const COLORS: [RGBColor; 2] = [RGBColor(0, 114, 178), RGBColor(213, 94, 0)];

/// A range below this fraction of the values' magnitude is rounding.
const LEVEL_RANGE: f64 = 1e-9;

/// Range below which a quantity rests, relative to its scale.
const REST_RANGE: f64 = 1e-12;

/// Limits of labels without exponents: magnitudes below the first, ranges above the second.
const LARGEST_PLAIN: f64 = 1e6;
const SMALLEST_PLAIN: f64 = 1e-4;

/// A label below this fraction of the range is zero.
const ZERO: f64 = 1e-9;

/// Panel of a picture.
pub(super) struct Panel<'a> {
    pub title: String,
    pub unit: &'a str,
    /// Curves, each with its symbol.
    pub curves: Vec<(&'static str, Vec<Extreme>)>,
    /// Magnitude that variations are compared with.
    pub reference: f64,
}

/// Returns the largest magnitude of a component.
fn largest<'a, const N: usize>(
    curves: impl Iterator<Item = &'a Curve<N>>,
    components: Range<usize>,
) -> f64 {
    let values = curves.flat_map(|curve| components.clone().flat_map(|it| curve.component(it)));
    values.fold(0.0, |most, (_, it)| most.max(it.abs()))
}

/// Converts values from SI units.
fn scaled(values: Vec<Extreme>, unit: &OutputUnit) -> Vec<Extreme> {
    let values = values.into_iter();
    values.map(|(t, value)| (t, unit.of_si(value))).collect()
}

/// Returns `value` if it is positive, otherwise `otherwise`.
fn or(value: f64, otherwise: f64) -> f64 {
    if value > 0.0 { value } else { otherwise }
}

/// Draws each selected point; `None` if it rests.
///
/// # Errors
/// Errors of the drawing library.
pub fn points<V: View>(
    motion: &Followed<V>,
    course: &Course,
    units: &OutputUnits,
) -> Result<Vec<Option<String>>, String> {
    let size = motion.system().mechanism.characteristic_length;
    let titles = ["position", "velocity", "acceleration"];
    let units = LENGTHS.map(|it| units.of(it));
    let symbols = [["x", "y"], ["vx", "vy"], ["ax", "ay"]];
    let references = [
        size,
        or(largest(course.points.iter(), 2..4), size),
        or(largest(course.points.iter(), 4..6), size),
    ];
    let pictures = course.points.iter().zip(motion.point_names());
    let pictures = pictures.map(|(curve, name)| {
        let panels: Vec<Panel<'_>> = (0..3)
            .map(|level| Panel {
                title: titles[level].to_string(),
                unit: &units[level].name,
                curves: [0, 1]
                    .map(|axis| {
                        let values = curve.component(2 * level + axis);
                        (symbols[level][axis], scaled(values, &units[level]))
                    })
                    .into(),
                reference: units[level].of_si(references[level]),
            })
            .collect();
        if rests(&panels[0]) {
            return Ok(None);
        }
        let title = format!("Point {name} of {}", motion.title());
        let drawn = picture(&title, &panels);
        drawn
            .map(Some)
            .map_err(|error| format!("cannot draw point `{name}`: {error}"))
    });
    pictures.collect()
}

/// Draws each selected coordinate; `None` if it rests.
///
/// # Errors
/// Errors of the drawing library.
pub fn coordinates<V: View>(
    motion: &Followed<V>,
    course: &Course,
    units: &OutputUnits,
) -> Result<Vec<Option<String>>, String> {
    let selected = motion.wanted.coordinates.iter();
    let pictures = course.coordinates.iter().zip(selected);
    let pictures = pictures.map(|(curve, &coordinate)| {
        let units = Units::of(motion.system(), coordinate, units);
        let name = &motion.system().coordinates[coordinate].name;
        let panels: Vec<Panel<'_>> = (0..3)
            .map(|level| {
                let values = scaled(curve.component(level), &units.levels[level]);
                let most = values.iter().fold(0.0_f64, |most, it| most.max(it.1.abs()));
                Panel {
                    title: format!("{name}{}", &"''"[..level]),
                    unit: &units.levels[level].name,
                    curves: vec![("", values)],
                    reference: match level {
                        0 => units.size,
                        _ => or(most, units.size),
                    },
                }
            })
            .collect();
        if rests(&panels[0]) {
            return Ok(None);
        }
        let title = format!("{name} of {}", motion.title());
        let drawn = picture(&title, &panels);
        drawn
            .map(Some)
            .map_err(|error| format!("cannot draw coordinate `{name}`: {error}"))
    });
    pictures.collect()
}

/// Draws each requested force and each measure; `None` for powers, which the driving forces show, and for constant values.
///
/// # Errors
/// Errors of the drawing library.
pub fn reported<V: View>(
    motion: &Followed<V>,
    course: &Course,
    units: &OutputUnits,
) -> Result<Vec<Option<String>>, String> {
    let pictures = course.reported.iter().zip(&motion.reported_names);
    let pictures = pictures.map(|(curve, (name, si))| {
        let unit = units.of(si);
        let values = scaled(curve.component(0), &unit);
        let most = values.iter().fold(0.0_f64, |most, it| most.max(it.1.abs()));
        let panel = Panel {
            title: name.clone(),
            unit: &unit.name,
            curves: vec![("", values)],
            reference: or(most, 1.0),
        };
        if name.starts_with("power_") || rests(&panel) {
            return Ok(None);
        }
        let title = format!("{name} of {}", motion.title());
        let drawn = picture(&title, &[panel]);
        drawn
            .map(Some)
            .map_err(|error| format!("cannot draw `{name}`: {error}"))
    });
    pictures.collect()
}

/// True if the values of a panel vary by rounding alone.
fn rests(panel: &Panel<'_>) -> bool {
    panel.curves.iter().all(|(_, curve)| {
        let values = curve.iter().map(|it| it.1);
        let (low, high) = extent(values);
        high - low <= REST_RANGE * panel.reference
    })
}

/// Returns the smallest and the largest value.
pub(super) fn extent(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), it| {
        (low.min(it), high.max(it))
    })
}

pub(super) type Drawing<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub(super) type Refused = Box<dyn std::error::Error>;

/// Draws panels one below the other.
pub(super) fn picture(title: &str, panels: &[Panel<'_>]) -> Result<String, Refused> {
    drawn(title, SIZE, |body| {
        for (area, panel) in body.split_evenly((panels.len(), 1)).iter().zip(panels) {
            draw_panel(area, panel)?;
        }
        Ok(())
    })
}

/// Draws a picture of this size in pixels with a title, in the finer units of [`UNITS`].
pub(super) fn drawn(
    title: &str,
    size: (u32, u32),
    contents: impl FnOnce(&Drawing<'_>) -> Result<(), Refused>,
) -> Result<String, Refused> {
    let units = (size.0 * UNITS, size.1 * UNITS);
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, units).into_drawing_area();
        area.fill(&WHITE)?;
        let area = area.margin(8 * UNITS, 0, 0, 0);
        let body = area.titled(title, ("sans-serif", 22 * UNITS))?;
        contents(&body)?;
        area.present()?;
    }
    // The view box keeps the units; only the displayed size changes.
    let attributes = |(width, height): (u32, u32)| format!("width=\"{width}\" height=\"{height}\"");
    Ok(signed(&text.replacen(
        &attributes(units),
        &attributes(size),
        1,
    )))
}

type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// An axis: its label, its ends and its largest number of ticks.
type Axis<'a> = (&'a str, (f64, f64), usize);

/// Draws both axes of a curve over time.
pub(super) fn mesh(chart: &mut Chart<'_, '_>, axes: [Axis<'_>; 2]) -> Result<(), Refused> {
    mesh_with(chart, axes, Some(4 * UNITS))
}

/// Draws both axes of a picture of the plane, with the longer tick marks of the drawing library.
pub(super) fn plane_mesh(chart: &mut Chart<'_, '_>, axes: [Axis<'_>; 2]) -> Result<(), Refused> {
    mesh_with(chart, axes, None)
}

fn mesh_with(
    chart: &mut Chart<'_, '_>,
    axes: [Axis<'_>; 2],
    tick_marks: Option<u32>,
) -> Result<(), Refused> {
    let [x_format, y_format] = axes.map(|(_, (low, high), _)| label_format(low, high));
    let [(x_label, _, x_ticks), (y_label, _, y_ticks)] = axes;
    let mut mesh = chart.configure_mesh();
    if let Some(size) = tick_marks {
        mesh.set_all_tick_mark_size(size);
    }
    mesh.light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.12).stroke_width(UNITS))
        .axis_style(BLACK.mix(0.6).stroke_width(UNITS))
        .label_style(("sans-serif", 15 * UNITS))
        .axis_desc_style(("sans-serif", 16 * UNITS))
        .x_labels(x_ticks)
        .y_labels(y_ticks)
        .x_label_formatter(&x_format)
        .y_label_formatter(&y_format)
        .x_desc(x_label)
        .y_desc(y_label)
        .draw()?;
    Ok(())
}

fn draw_panel(area: &Drawing<'_>, panel: &Panel<'_>) -> Result<(), Refused> {
    let all = || panel.curves.iter().flat_map(|(_, curve)| curve);
    let (low, high) = range(all().map(|it| it.1), panel.reference);
    let (begin, end) = extent(all().map(|it| it.0));
    let is_word = |it: &(&str, Vec<Extreme>)| it.0.len() > 2;
    let beside = if panel.curves.iter().any(is_word) {
        92
    } else {
        72
    };
    let mut chart = ChartBuilder::on(area)
        .margin(8 * UNITS)
        .margin_right(beside * UNITS)
        .x_label_area_size(42 * UNITS)
        .y_label_area_size(84 * UNITS)
        .build_cartesian_2d(begin..end, low..high)?;
    let label = format!("{} ({})", panel.title, panel.unit);
    mesh(
        &mut chart,
        [("t (s)", (begin, end), 11), (&label, (low, high), 7)],
    )?;
    let (width, _) = area.dim_in_pixel();
    let left = (width - (beside - 10) * UNITS) as i32;
    for (row, ((symbol, points), color)) in panel.curves.iter().zip(COLORS).enumerate() {
        let stroke = color.stroke_width(2 * UNITS);
        chart.draw_series(LineSeries::new(points.iter().copied(), stroke))?;
        if !symbol.is_empty() {
            legend(area, left, row, symbol, color)?;
        }
    }
    Ok(())
}

/// Draws a line of a legend beside the curves, where it hides nothing.
pub(super) fn legend(
    area: &Drawing<'_>,
    left: i32,
    row: usize,
    symbol: &str,
    color: RGBColor,
) -> Result<(), Refused> {
    let units = UNITS as i32;
    let y = (24 + 22 * row as i32) * units;
    let sample = vec![(left, y), (left + 20 * units, y)];
    area.draw(&PathElement::new(sample, color.stroke_width(2 * UNITS)))?;
    let style = TextStyle::from(("sans-serif", 15 * UNITS).into_font())
        .pos(Pos::new(HPos::Left, VPos::Center));
    area.draw(&Text::new(
        symbol.to_string(),
        (left + 26 * units, y),
        style,
    ))?;
    Ok(())
}

/// Returns the range of the vertical axis: all values with a margin, or the surroundings of a level line.
pub(super) fn range(values: impl Iterator<Item = f64>, reference: f64) -> (f64, f64) {
    let (low, high) = extent(values);
    let center = 0.5 * (low + high);
    let magnitude = low.abs().max(high.abs()).max(reference);
    if high - low > LEVEL_RANGE * magnitude {
        let margin = 0.06 * (high - low);
        (low - margin, high + margin)
    } else {
        // The level is rounded as well, so that zero is labeled 0.
        let center = if center.abs() <= LEVEL_RANGE * magnitude {
            0.0
        } else {
            center
        };
        (center - 0.1 * magnitude, center + 0.1 * magnitude)
    }
}

/// Formats labels with as many decimals as about ten steps across the range need.
pub(super) fn label_format(low: f64, high: f64) -> impl Fn(&f64) -> String {
    let (span, magnitude) = (high - low, low.abs().max(high.abs()));
    let decimals = (1.0 - span.log10()).ceil().clamp(0.0, 12.0) as usize;
    let plain = magnitude < LARGEST_PLAIN && span > SMALLEST_PLAIN;
    let digits = (magnitude / span).log10().max(0.0) as usize + 2;
    move |value| {
        // The rounding of the axis can move the label zero off zero.
        let value = if value.abs() < ZERO * span {
            0.0
        } else {
            *value
        };
        match plain {
            true => linkwright_solver::number::fixed(value, decimals),
            false => linkwright_solver::number::scientific(value, digits),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_is_drawn_as_a_level_line() {
        let root = 3.0_f64.sqrt();
        let (low, high) = range([root, root + 3e-16].into_iter(), 2.0);
        assert!(low < root - 0.1 && high > root + 0.1, "{low} {high}");
        assert_eq!(range([0.0, 1e-17].into_iter(), 1.0), (-0.1, 0.1));
        let (low, high) = range([1.0, 1.001].into_iter(), 1.0);
        assert!(low > 0.999 && high < 1.002, "{low} {high}");
    }
}
