//! Draws the paths of a motion's points as one SVG: x against y, both at one scale.

use linkwright_codegen::stages::units::OutputUnit;
use linkwright_solver::View;
use plotters::prelude::*;

use super::plot::{Drawing, Refused, UNITS, drawn, extent, plane_mesh};
use linkwright_page::motion::{Course, Followed};

/// Smallest shorter side of the drawn area, and its longer side, in pixels.
const SIDES: [f64; 2] = [240.0, 760.0];

/// Margin of the picture, width of the labels on the left and height of those below, in pixels.
const MARGIN: u32 = 8;
const LABELS: [u32; 2] = [84, 42];

/// Space around the paths, the title included.
const AROUND: [u32; 2] = [LABELS[0] + 60, LABELS[1] + 90];

/// Part of the extent that stays empty around the paths.
const PADDING: f64 = 0.12;

/// The palette of Okabe and Ito without black and yellow, which remain distinct for the color-blind.
const COLORS: [RGBColor; 6] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
];

/// Draws the paths of all points that move, each with a dot at its beginning; `None` if nothing moves.
///
/// # Errors
/// Errors of the drawing library.
pub fn paths<V: View>(
    motion: &Followed<V>,
    course: &Course,
    is_drawn: &[bool],
    unit: &OutputUnit,
) -> Result<Option<String>, String> {
    let paths = course.paths.iter().zip(motion.point_names()).zip(is_drawn);
    let paths: Vec<(&str, Vec<[f64; 2]>)> = paths
        .filter(|(_, is_drawn)| **is_drawn)
        .map(|((path, name), _)| {
            (
                name,
                path.places()
                    .map(|it| it.map(|own| unit.of_si(own)))
                    .collect(),
            )
        })
        .collect();
    if paths.is_empty() {
        return Ok(None);
    }
    let places = || paths.iter().flat_map(|(_, places)| places);
    let ends = [0, 1].map(|axis| extent(places().map(|it| it[axis])));
    let lengths = ends.map(|(low, high)| high - low);
    let longer = lengths[0].max(lengths[1]);
    // A narrow extent gets empty space on both sides.
    let sides = lengths.map(|it| (SIDES[1] * it / longer).max(SIDES[0]));
    let size = [0, 1].map(|axis| sides[axis] as u32 + 2 * MARGIN + AROUND[axis]);
    let title = format!("Paths of {}", motion.title());
    drawn(&title, (size[0], size[1]), |area| {
        draw(area, ends, &paths, &unit.name)
    })
    .map(Some)
    .map_err(|error| format!("cannot draw the paths: {error}"))
}

fn draw(
    area: &Drawing<'_>,
    ends: [(f64, f64); 2],
    paths: &[(&str, Vec<[f64; 2]>)],
    unit: &str,
) -> Result<(), Refused> {
    let (width, height) = area.dim_in_pixel();
    let pixels = [
        width - (2 * MARGIN + LABELS[0]) * UNITS,
        height - (2 * MARGIN + LABELS[1]) * UNITS,
    ];
    let scales = [0, 1].map(|axis| (ends[axis].1 - ends[axis].0) / f64::from(pixels[axis]));
    let scale = (1.0 + PADDING) * scales[0].max(scales[1]);
    let [across, up] = [0, 1].map(|axis| {
        let center = 0.5 * (ends[axis].0 + ends[axis].1);
        let half = 0.5 * scale * f64::from(pixels[axis]);
        (center - half, center + half)
    });
    let mut chart = ChartBuilder::on(area)
        .margin(MARGIN * UNITS)
        .x_label_area_size(LABELS[1] * UNITS)
        .y_label_area_size(LABELS[0] * UNITS)
        .build_cartesian_2d(across.0..across.1, up.0..up.1)?;
    let labels = ["x", "y"].map(|axis| format!("{axis} ({unit})"));
    plane_mesh(&mut chart, [(&labels[0], across, 9), (&labels[1], up, 9)])?;
    let units = UNITS as i32;
    for (row, (name, places)) in paths.iter().enumerate() {
        let color = COLORS[row % COLORS.len()];
        let line = places.iter().map(|it| (it[0], it[1]));
        chart.draw_series(LineSeries::new(line, color.stroke_width(2 * UNITS)))?;
        let start = places.first().map(|it| (it[0], it[1]));
        // The name stands beside the beginning of the path.
        chart.draw_series(start.map(|at| {
            EmptyElement::at(at)
                + Circle::new((0, 0), 4 * units, color.filled())
                + Text::new(
                    name.to_string(),
                    (7 * units, -8 * units),
                    ("sans-serif", 16 * UNITS).into_font(),
                )
        }))?;
    }
    Ok(())
}
