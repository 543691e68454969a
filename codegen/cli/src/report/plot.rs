//! *A motion* → *one SVG per point*: position, velocity and acceleration over time, x and y in each panel.
//!
//! What varies by less than rounding is drawn as a level line. The module does not know files.

use linkwright_solver::view::View;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::picture::signed;
use crate::motion::{Curve, Followed};

/// Width and height of a picture in pixels.
const SIZE: (u32, u32) = (960, 900);

/// The drawing library rounds coordinates to whole units, which would make curves ragged: it draws in quarters of a
/// pixel, and every length below is multiplied by this.
const UNITS: u32 = 4;

/// Blue and vermillion of the palette of Okabe and Ito, which remain distinct for the color-blind.
const COLORS: [RGBColor; 2] = [RGBColor(0, 114, 178), RGBColor(213, 94, 0)];

/// A range below this fraction of the values' magnitude is rounding.
const FLAT: f64 = 1e-9;

/// Labels have no exponents where magnitudes are below the first and the range is above the second.
const LARGEST_PLAIN: f64 = 1e6;
const SMALLEST_PLAIN: f64 = 1e-4;

/// A label below this fraction of the range is zero.
const ZERO: f64 = 1e-9;

/// What one panel shows.
struct Panel {
    title: &'static str,
    unit: &'static str,
    symbols: [&'static str; 2],
    /// The magnitude that variations are compared with.
    reference: f64,
    /// 0 for position, 1 for velocity, 2 for acceleration.
    level: usize,
}

/// The picture of each shown point with its name, in their order; nothing for fewer than two frames.
///
/// # Errors
/// What the drawing library refuses.
pub fn draw<V: View>(motion: &Followed<V>) -> Result<Vec<(String, String)>, String> {
    let curves = &motion.curves;
    if motion.count < 2 {
        return Ok(Vec::new());
    }
    let size = motion.system().mechanism.characteristic_length;
    let largest = |level: usize| {
        let components = curves
            .iter()
            .flat_map(|curve| [0, 1].map(|axis| curve.component(level, axis)));
        let largest = components
            .flatten()
            .fold(0.0_f64, |most, (_, it)| most.max(it.abs()));
        if largest > 0.0 { largest } else { size }
    };
    let panels = [
        Panel {
            title: "position",
            unit: "m",
            symbols: ["x", "y"],
            reference: size,
            level: 0,
        },
        Panel {
            title: "velocity",
            unit: "m/s",
            symbols: ["vx", "vy"],
            reference: largest(1),
            level: 1,
        },
        Panel {
            title: "acceleration",
            unit: "m/s²",
            symbols: ["ax", "ay"],
            reference: largest(2),
            level: 2,
        },
    ];
    let mut pictures = Vec::with_capacity(curves.len());
    for (curve, name) in curves.iter().zip(motion.point_names()) {
        let title = format!("Point {name} of {}", motion.title());
        let picture = picture(&title, curve, &panels)
            .map_err(|error| format!("cannot draw point `{name}`: {error}"))?;
        pictures.push((name.to_string(), picture));
    }
    Ok(pictures)
}

type Drawing<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Refused = Box<dyn std::error::Error>;

fn picture(title: &str, curve: &Curve, panels: &[Panel]) -> Result<String, Refused> {
    let units = (SIZE.0 * UNITS, SIZE.1 * UNITS);
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, units).into_drawing_area();
        area.fill(&WHITE)?;
        let area = area.margin(8 * UNITS, 0, 0, 0);
        let body = area.titled(title, ("sans-serif", 22 * UNITS))?;
        for (area, panel) in body.split_evenly((panels.len(), 1)).iter().zip(panels) {
            draw_panel(area, panel, curve)?;
        }
        area.present()?;
    }
    // The view box keeps the units; only the size at which it is shown changes.
    let size = |(width, height): (u32, u32)| format!("width=\"{width}\" height=\"{height}\"");
    Ok(signed(&text.replacen(&size(units), &size(SIZE), 1)))
}

fn draw_panel(area: &Drawing, panel: &Panel, curve: &Curve) -> Result<(), Refused> {
    let components = [0, 1].map(|axis| curve.component(panel.level, axis));
    let values = components.iter().flatten().map(|(_, value)| *value);
    let (low, high) = range(values, panel.reference);
    let [begin, end] = curve.range().unwrap_or_default();
    let mut chart = ChartBuilder::on(area)
        .margin(8 * UNITS)
        .margin_right(72 * UNITS)
        .x_label_area_size(42 * UNITS)
        .y_label_area_size(84 * UNITS)
        .build_cartesian_2d(begin..end, low..high)?;
    let (across, up) = (label_format(begin, end), label_format(low, high));
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.12).stroke_width(UNITS))
        .axis_style(BLACK.mix(0.6).stroke_width(UNITS))
        .set_all_tick_mark_size(4 * UNITS)
        .label_style(("sans-serif", 15 * UNITS))
        .axis_desc_style(("sans-serif", 16 * UNITS))
        .x_labels(11)
        .y_labels(7)
        .x_label_formatter(&across)
        .y_label_formatter(&up)
        .x_desc("t (s)")
        .y_desc(format!("{} ({})", panel.title, panel.unit))
        .draw()?;
    let (width, _) = area.dim_in_pixel();
    let units = UNITS as i32;
    let left = width as i32 - 62 * units;
    let curves = components.iter().zip(COLORS).zip(panel.symbols);
    for (row, ((points, color), symbol)) in (0..).zip(curves) {
        let stroke = color.stroke_width(2 * UNITS);
        chart.draw_series(LineSeries::new(points.iter().copied(), stroke))?;
        // The legend stands beside the curves, where it hides nothing.
        let y = (24 + 22 * row) * units;
        let sample = vec![(left, y), (left + 20 * units, y)];
        area.draw(&PathElement::new(sample, stroke))?;
        let style = TextStyle::from(("sans-serif", 15 * UNITS).into_font())
            .pos(Pos::new(HPos::Left, VPos::Center));
        area.draw(&Text::new(symbol, (left + 26 * units, y), style))?;
    }
    Ok(())
}

/// What the vertical axis shows: all values with a margin, or the surroundings of a level line.
fn range(values: impl Iterator<Item = f64>, reference: f64) -> (f64, f64) {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), it| {
        (low.min(it), high.max(it))
    });
    let center = 0.5 * (low + high);
    let magnitude = low.abs().max(high.abs()).max(reference);
    if high - low > FLAT * magnitude {
        let margin = 0.06 * (high - low);
        (low - margin, high + margin)
    } else {
        // The level itself is rounded as well, so that zero is labelled 0.
        let center = if center.abs() <= FLAT * magnitude {
            0.0
        } else {
            center
        };
        (center - 0.1 * magnitude, center + 0.1 * magnitude)
    }
}

/// Labels with as many decimals as about ten steps across the range need.
fn label_format(low: f64, high: f64) -> impl Fn(&f64) -> String {
    let (span, magnitude) = (high - low, low.abs().max(high.abs()));
    let decimals = (1.0 - span.log10()).ceil().clamp(0.0, 12.0) as usize;
    let plain = magnitude < LARGEST_PLAIN && span > SMALLEST_PLAIN;
    let digits = (magnitude / span).log10().max(0.0) as usize + 2;
    move |value| {
        // A label next to zero is zero up to the rounding of the axis.
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
