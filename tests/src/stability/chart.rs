//! Draws the verdicts on a family as an SVG: errors as points and predicted bounds as lines, on logarithmic axes.

use std::error::Error;
use std::path::Path;

use plotters::prelude::*;

/// Curve of one procedure, with (x, error, bound) of each sample it solved.
pub struct Series {
    /// Label.
    pub label: String,
    /// Points.
    pub points: Vec<(f64, f64, f64)>,
}

const COLORS: [RGBColor; 4] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
];

/// Ordinate of an error of exactly zero.
const ZERO_ERROR_ORDINATE: f64 = 1e-18;

/// Ordinate of an error that exceeds the whole magnitude.
const MAX_ERROR_ORDINATE: f64 = 1e2;

/// End of the axis: the legend stands above all points.
const END: f64 = 1e9;

/// Draws the chart of a family; false if no point has a place on a logarithmic axis.
///
/// # Errors
/// If the file cannot be written.
pub fn draw(
    file: &Path,
    title: &str,
    varies: &str,
    series: &[Series],
) -> Result<bool, Box<dyn Error>> {
    let points = || {
        series
            .iter()
            .flat_map(|it| &it.points)
            .filter(|it| it.0 > 0.0)
    };
    let (low, high) = points().fold((f64::INFINITY, 0.0_f64), |(low, high), it| {
        (low.min(it.0), high.max(it.0))
    });
    if low >= high || low < 1e-30 || high > 1e30 {
        return Ok(false);
    }
    let drawn = |value: f64| value.clamp(ZERO_ERROR_ORDINATE, MAX_ERROR_ORDINATE);
    let mut svg = String::new();
    {
        let root = SVGBackend::with_string(&mut svg, (760, 440)).into_drawing_area();
        root.fill(&WHITE)?;
        let mut chart = ChartBuilder::on(&root)
            .margin(10)
            .margin_right(24)
            .caption(title, ("sans-serif", 19))
            .x_label_area_size(40)
            .y_label_area_size(60)
            .build_cartesian_2d(
                (low / 2.0..high * 2.0).log_scale(),
                (ZERO_ERROR_ORDINATE..END).log_scale(),
            )?;
        let power = |value: &f64| format!("1e{:.0}", value.log10());
        chart
            .configure_mesh()
            .x_desc(varies)
            .y_desc("error of the pose (points) and bound (lines)")
            .x_label_formatter(&power)
            .y_label_formatter(&power)
            .label_style(("sans-serif", 13))
            .light_line_style(WHITE)
            .draw()?;
        for (index, line) in series.iter().enumerate() {
            let color = COLORS[index % COLORS.len()];
            let here = || line.points.iter().filter(|it| it.0 > 0.0);
            chart.draw_series(LineSeries::new(
                here().map(|it| (it.0, drawn(it.2))),
                color.stroke_width(1),
            ))?;
            chart
                .draw_series(here().map(|it| Circle::new((it.0, drawn(it.1)), 4, color.filled())))?
                .label(line.label.clone())
                .legend(move |(x, y)| Circle::new((x + 8, y), 4, color.filled()));
        }
        chart
            .configure_series_labels()
            .position(SeriesLabelPosition::UpperLeft)
            .label_font(("sans-serif", 13))
            .background_style(WHITE.mix(0.8))
            .draw()?;
        root.present()?;
    }
    std::fs::write(file, svg)?;
    Ok(true)
}
