//! Draws the spread of a measure over time as an SVG: its value, and below it the departures from it as bands.

use linkwright_solver::View as _;
use linkwright_solver::stack_up::{LinearSpread, SampledMeasure};
use plotters::prelude::*;

use super::plot::{Drawing, Refused, UNITS, drawn, extent, legend, mesh};
use super::stack_up::Report;

/// Width and height of a picture in pixels.
const SIZE: (u32, u32) = (960, 640);

/// Width beside the panels for the legend, in pixels.
const BESIDE: u32 = 206;

/// Colors of the value, the worst case and the samples: black, and blue and vermillion of the palette of Okabe and Ito.
const VALUE: RGBColor = RGBColor(60, 60, 60);
const WORST: RGBColor = RGBColor(0, 114, 178);
const SAMPLED: RGBColor = RGBColor(213, 94, 0);

/// Opacity of a band.
const OPACITY: f64 = 0.18;

/// Part of a range that stays empty around it, and part of the magnitude of a level line.
const MARGIN: f64 = 0.06;
const AROUND: f64 = 0.1;

/// Curve of a panel, by time.
type Curve = Vec<(f64, f64)>;

/// Band between two curves with its color and its name.
struct Band {
    name: &'static str,
    color: RGBColor,
    low: Curve,
    high: Curve,
}

/// Draws each measure; `None` for those with fewer than two frames, and without a spread.
///
/// # Errors
/// Errors of the drawing library.
pub fn pictures(report: &Report<'_>) -> Result<Vec<Option<String>>, String> {
    let measures = report.measures().into_iter().enumerate();
    let drawn = measures.map(|(place, (name, unit))| {
        let linear = &report.spread.measures[place];
        let sampled = report.sampled.map(|it| &it.measures[place]);
        let times = &report.spread.times;
        let bands = bands(times, linear, sampled, &|si| unit.of_si(si));
        let spread = bands.iter().flat_map(|it| it.low.iter().chain(&it.high));
        let (low, high) = extent(spread.map(|it| it.1));
        if times.len() < 2 || low >= high {
            return Ok(None);
        }
        let values = times.iter().zip(&linear.nominal);
        let values: Curve = values.map(|(t, it)| (*t, unit.of_si(*it))).collect();
        let mechanism = report.blocks.system().mechanism.title();
        let title = format!("Spread of {name} of {mechanism}");
        let labels = [name.as_str(), "departure"].map(|it| match unit.name.as_str() {
            "" => it.to_string(),
            unit => format!("{it} ({unit})"),
        });
        let picture = drawn_panels(&title, &labels, &values, &bands);
        picture
            .map(Some)
            .map_err(|error| format!("cannot draw `{name}`: {error}"))
    });
    drawn.collect()
}

/// Returns the bands of departures from the nominal value.
fn bands(
    times: &[f64],
    linear: &LinearSpread,
    sampled: Option<&SampledMeasure>,
    of_si: &dyn Fn(f64) -> f64,
) -> Vec<Band> {
    let curve = |value: &dyn Fn(usize) -> f64| -> Curve {
        let points = times.iter().enumerate();
        let points = points.map(|(place, t)| (*t, of_si(value(place))));
        points.filter(|it| it.1.is_finite()).collect()
    };
    let mut bands = vec![Band {
        name: "worst case",
        color: WORST,
        low: curve(&|it| -linear.worst[it]),
        high: curve(&|it| linear.worst[it]),
    }];
    if let Some(sampled) = sampled {
        let departure = |it: usize, quantile: usize| {
            sampled.moments[it].quantiles[quantile] - linear.nominal[it]
        };
        bands.push(Band {
            name: "99.73 % of samples",
            color: SAMPLED,
            low: curve(&|it| departure(it, 0)),
            high: curve(&|it| departure(it, 2)),
        });
    }
    bands
}

fn drawn_panels(
    title: &str,
    [above, below]: &[String; 2],
    values: &Curve,
    bands: &[Band],
) -> Result<String, Refused> {
    drawn(title, SIZE, |area| {
        let areas = area.split_evenly((2, 1));
        panel(&areas[0], above, values, &[])?;
        panel(&areas[1], below, values, bands)?;
        Ok(())
    })
}

/// Draws the values; or with bands, the bands about zero.
fn panel(area: &Drawing<'_>, label: &str, values: &Curve, bands: &[Band]) -> Result<(), Refused> {
    let ends = match bands {
        [] => extent(values.iter().map(|it| it.1)),
        bands => extent(
            bands
                .iter()
                .flat_map(|it| it.low.iter().chain(&it.high))
                .map(|it| it.1),
        ),
    };
    let (low, high) = around(ends);
    let (begin, end) = extent(values.iter().map(|it| it.0));
    let mut chart = ChartBuilder::on(area)
        .margin(8 * UNITS)
        .margin_right(BESIDE * UNITS)
        .x_label_area_size(42 * UNITS)
        .y_label_area_size(92 * UNITS)
        .build_cartesian_2d(begin..end, low..high)?;
    mesh(
        &mut chart,
        [("t (s)", (begin, end), 11), (label, (low, high), 7)],
    )?;
    let (width, _) = area.dim_in_pixel();
    let left = (width - (BESIDE - 10) * UNITS) as i32;
    if bands.is_empty() {
        let stroke = VALUE.stroke_width(2 * UNITS);
        chart.draw_series(LineSeries::new(values.iter().copied(), stroke))?;
        return legend(area, left, 0, "nominal value", VALUE);
    }
    for (row, band) in bands.iter().enumerate() {
        // Bands are nested: each is filled up to the next one, so that their colors do not mix.
        let areas = match bands.get(row + 1) {
            Some(inner) => vec![(&band.low, &inner.low), (&inner.high, &band.high)],
            None => vec![(&band.low, &band.high)],
        };
        for (below, above) in areas {
            let outline: Curve = below.iter().chain(above.iter().rev()).copied().collect();
            let filled = Polygon::new(outline, band.color.mix(OPACITY).filled());
            chart.draw_series(std::iter::once(filled))?;
        }
        for side in [&band.low, &band.high] {
            let stroke = band.color.stroke_width(2 * UNITS);
            chart.draw_series(LineSeries::new(side.iter().copied(), stroke))?;
        }
        legend(area, left, row, band.name, band.color)?;
    }
    Ok(())
}

/// Returns a range with a margin, or the surroundings of a single value.
fn around((low, high): (f64, f64)) -> (f64, f64) {
    let margin = match low < high {
        true => MARGIN * (high - low),
        false => AROUND * if low == 0.0 { 1.0 } else { low.abs() },
    };
    (low - margin, high + margin)
}
