//! Draws the measurements of a mechanism as an SVG: error over time per frame, both logarithmic, a panel per level.

use std::path::Path;

use plotters::coord::Shift;
use plotters::prelude::*;

use super::measurement::Measurement;

const SIZE: (u32, u32) = (1260, 560);
const LEVELS: [&str; 3] = ["position", "velocity", "acceleration"];

/// Ordinate of an error of exactly zero: below every rounding.
const ZERO_ERROR_ORDINATE: f64 = 1e-17;

/// Distinct also without colors, by their order in the legend and the labels at the points (Okabe and Ito 2008).
const COLORS: [RGBColor; 8] = [
    RGBColor(0, 0, 0),
    RGBColor(213, 94, 0),
    RGBColor(0, 114, 178),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(120, 120, 120),
];

/// Methods of one family and scalar: a line of the chart.
struct Series<'a> {
    label: String,
    color: RGBColor,
    points: Vec<&'a Measurement>,
}

/// Draws the chart of one mechanism.
///
/// # Errors
/// If the file cannot be written.
pub fn draw(
    file: &Path,
    title: &str,
    measurements: &[Measurement],
) -> Result<(), Box<dyn std::error::Error>> {
    let series = series(measurements);
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, SIZE).into_drawing_area();
        root.fill(&WHITE)?;
        let root = root.titled(
            &format!("{title}: largest relative error over 0 to 5 s against time per frame"),
            ("sans-serif", 24),
        )?;
        let (charts, legend) = root.split_vertically(440);
        for (level, area) in charts.split_evenly((1, 3)).iter().enumerate() {
            panel(area, level, &series, measurements)?;
        }
        key(&legend, &series)?;
        root.present()?;
    }
    std::fs::write(file, svg)?;
    Ok(())
}

fn series(measurements: &[Measurement]) -> Vec<Series<'_>> {
    let mut series: Vec<Series> = Vec::new();
    for it in measurements {
        let label = format!("{} ({})", it.family, it.scalar);
        match series.iter_mut().find(|series| series.label == label) {
            Some(series) => series.points.push(it),
            None => {
                let color = COLORS[series.len() % COLORS.len()];
                series.push(Series {
                    label,
                    color,
                    points: vec![it],
                });
            }
        }
    }
    series
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn = Result<(), Box<dyn std::error::Error>>;

/// Whole decades around the values.
fn decades(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = values.fold((f64::INFINITY, 0.0_f64), |(low, high), value| {
        (low.min(value), high.max(value))
    });
    let low = (low * 0.7).log10().floor();
    let high = (high * 1.4).log10().ceil().max(low + 1.0);
    (10_f64.powf(low), 10_f64.powf(high))
}

fn panel(
    area: &Area<'_>,
    level: usize,
    series: &[Series<'_>],
    measurements: &[Measurement],
) -> Drawn {
    let (left, right) = decades(measurements.iter().map(|it| it.time));
    // All levels have the same scale, so that they can be compared.
    let errors = measurements.iter().flat_map(|it| it.errors);
    let (bottom, top) = decades(errors.map(|error| error.max(ZERO_ERROR_ORDINATE)));
    let mut chart = ChartBuilder::on(area)
        .margin(8)
        .margin_right(28)
        .caption(LEVELS[level], ("sans-serif", 20))
        .x_label_area_size(36)
        .y_label_area_size(58)
        .build_cartesian_2d((left..right).log_scale(), (bottom..top).log_scale())?;
    let power = |value: &f64| format!("1e{:.0}", value.log10());
    chart
        .configure_mesh()
        .x_desc("ns per frame")
        .x_label_formatter(&|value| format!("{value:.0}"))
        .y_label_formatter(&power)
        .label_style(("sans-serif", 14))
        .light_line_style(WHITE)
        .draw()?;
    for line in series {
        let at = |it: &&Measurement| (it.time, it.errors[level].max(ZERO_ERROR_ORDINATE));
        chart.draw_series(LineSeries::new(
            line.points.iter().map(at),
            line.color.stroke_width(1),
        ))?;
        chart.draw_series(
            line.points
                .iter()
                .map(|it| Circle::new(at(it), 4, line.color.filled())),
        )?;
        let labelled = line.points.iter().filter(|it| !it.setting.is_empty());
        chart.draw_series(labelled.map(|it| {
            let style = ("sans-serif", 13).into_font().color(&line.color);
            EmptyElement::at(at(it)) + Text::new(it.setting.clone(), (6, -10), style)
        }))?;
    }
    Ok(())
}

fn key(area: &Area<'_>, series: &[Series<'_>]) -> Drawn {
    for (index, line) in series.iter().enumerate() {
        let (column, row) = (index as i32 / 4, index as i32 % 4);
        let (x, y) = (70 + 420 * column, 6 + 19 * row);
        area.draw(&Circle::new((x, y + 6), 5, line.color.filled()))?;
        let style = ("sans-serif", 17).into_font().color(&BLACK);
        area.draw(&Text::new(line.label.clone(), (x + 14, y), style))?;
    }
    Ok(())
}
