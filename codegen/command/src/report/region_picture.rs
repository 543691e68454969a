//! Draws the region of two drives, and its image under a point, as SVG.

use linkwright_codegen::stages::units::OutputUnit;
use linkwright_solver::travel::{EndKind, Region, Section};
use plotters::prelude::*;

use super::picture::signed;
use super::plot::{Drawing, Refused, UNITS, drawn, extent, plane_mesh};
use super::region_text::section_words;

/// Width and height of the drawn area in pixels.
const AREA: [u32; 2] = [760, 560];

/// Margin of the picture, width of the labels on the left and height of those below, in pixels.
const MARGIN: u32 = 10;
const LABELS: [u32; 2] = [84, 44];

/// Height of a line of the legend, and of the title, in pixels.
const ROW: u32 = 24;
const TITLE: u32 = 44;

/// Part of the extent that stays empty around the curves.
const PADDING: f64 = 0.08;

/// Width of the stroke of a border, in pixels.
const STROKE: u32 = 2;

/// Length of a dash and of the gap behind it, in pixels.
const DASH: i32 = 6;

/// Palette of Okabe and Ito, which remains distinct for the color-blind.
const COLORS: [RGBColor; 6] = [
    RGBColor(213, 94, 0),
    RGBColor(0, 114, 178),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
];

/// Color of curves on which the image folds, and of the sides of the window.
const FOLD: RGBColor = RGBColor(0, 158, 115);
const WINDOW: RGBColor = RGBColor(130, 130, 130);

/// Fill of the region.
const FILL: RGBColor = RGBColor(232, 240, 248);

/// Line of a picture with its entry in the legend.
struct Stroke {
    places: Vec<[f64; 2]>,
    color: RGBColor,
    is_dashed: bool,
}

/// Entry of the legend.
struct Entry {
    words: String,
    color: RGBColor,
    is_dashed: bool,
}

/// Picture before it is drawn.
struct Sheet {
    title: String,
    labels: [String; 2],
    /// Polygons of borders, filled alternately.
    areas: Vec<Vec<[f64; 2]>>,
    strokes: Vec<Stroke>,
    entries: Vec<Entry>,
    start: Option<[f64; 2]>,
    /// True if both axes have one scale.
    is_to_scale: bool,
}

/// Draws the plane of both drives in these units.
///
/// # Errors
/// Errors of the drawing library.
pub fn plane(title: &str, region: &Region, units: &[OutputUnit; 2]) -> Result<String, String> {
    let converted = |values: &[[f64; 2]]| -> Vec<[f64; 2]> {
        let values = values.iter();
        values
            .map(|it| [units[0].of_si(it[0]), units[1].of_si(it[1])])
            .collect()
    };
    let labels = [0, 1].map(|it| {
        let name = &region.drives[it].name;
        format!("{name} ({})", units[it].name)
    });
    let mut sheet = sheet(region, labels, |section| converted(&section.values));
    sheet.title = format!(
        "{title}: region of {} and {}",
        region.drives[0].name, region.drives[1].name
    );
    sheet.start = converted(&[region.start]).first().copied();
    sheet.areas = region
        .borders
        .iter()
        .map(|it| {
            it.sections
                .iter()
                .flat_map(|it| converted(&it.values))
                .collect()
        })
        .collect();
    sheet.drawn()
}

/// Draws the image of the region under a point.
///
/// # Errors
/// Errors of the drawing library.
pub fn workspace(
    title: &str,
    region: &Region,
    point: &str,
    unit: &OutputUnit,
) -> Result<String, String> {
    let converted = |tip: &[f64; 2]| tip.map(|it| unit.of_si(it));
    let labels = ["x", "y"].map(|axis| format!("{axis} of {point} ({})", unit.name));
    // A drive that turns on leads back to the other side of the window, which is not a border of the workspace.
    let is_joined = |section: &Section| {
        let mut turning = region.drives.iter().filter(|it| it.is_angle);
        section.kind == EndKind::Unended && turning.any(|it| it.name == section.words)
    };
    let mut bordered = region.clone();
    for border in &mut bordered.borders {
        border.sections.retain(|it| !is_joined(it));
    }
    let mut sheet = sheet(&bordered, labels, |section| {
        section.tips.iter().map(converted).collect()
    });
    sheet.title = format!("{title}: workspace of {point}");
    sheet.start = region.start_tip.as_ref().map(converted);
    sheet.is_to_scale = true;
    sheet.drawn()
}

/// Collects the lines and the legend.
fn sheet(
    region: &Region,
    labels: [String; 2],
    places: impl Fn(&Section) -> Vec<[f64; 2]>,
) -> Sheet {
    let (mut strokes, mut entries) = (Vec::new(), Vec::<Entry>::new());
    let borders = region.borders.iter().map(|it| (it, false));
    let folds = region.folds.iter().map(|it| (it, true));
    for (curve, is_fold) in borders.chain(folds) {
        for section in &curve.sections {
            let is_window = !is_fold && section.kind == EndKind::Unended;
            let words = match is_fold {
                true => "both drives move the point along one line".to_string(),
                false => section_words(section),
            };
            let place = entries.iter().position(|it| it.words == words);
            let place = place.unwrap_or_else(|| {
                let used = entries
                    .iter()
                    .filter(|it| COLORS.contains(&it.color))
                    .count();
                let color = match (is_fold, is_window) {
                    (true, _) => FOLD,
                    (_, true) => WINDOW,
                    _ => COLORS[used % COLORS.len()],
                };
                entries.push(Entry {
                    words,
                    color,
                    is_dashed: is_fold || is_window,
                });
                entries.len() - 1
            });
            strokes.push(Stroke {
                places: places(section),
                color: entries[place].color,
                is_dashed: entries[place].is_dashed,
            });
        }
    }
    Sheet {
        title: String::new(),
        labels,
        areas: Vec::new(),
        strokes,
        entries,
        start: None,
        is_to_scale: false,
    }
}

impl Sheet {
    fn drawn(&self) -> Result<String, String> {
        let legend = ROW * (self.entries.len() as u32 + 1);
        let height = AREA[1] + LABELS[1] + TITLE + legend + 2 * MARGIN;
        let width = AREA[0] + LABELS[0] + 2 * MARGIN;
        let drawing = drawn(&self.title, (width, height), |area| self.draw(area, legend));
        let drawing = drawing.map_err(|error| format!("cannot draw the region: {error}"))?;
        Ok(signed(&drawing))
    }

    /// Returns the ends of both axes.
    fn ends(&self) -> [(f64, f64); 2] {
        let places = || {
            let places = self.strokes.iter().flat_map(|it| it.places.iter());
            places.chain(self.start.iter())
        };
        let ends = [0, 1].map(|axis| extent(places().map(|it| it[axis])));
        let mut half = [0, 1].map(|axis| {
            let (low, high) = ends[axis];
            let half = 0.5 * (high - low);
            (1.0 + 2.0 * PADDING) * if half > 0.0 { half } else { 1.0 }
        });
        if self.is_to_scale {
            let scales = [0, 1].map(|axis| half[axis] / f64::from(AREA[axis]));
            let scale = scales[0].max(scales[1]);
            half = [0, 1].map(|axis| scale * f64::from(AREA[axis]));
        }
        [0, 1].map(|axis| {
            let middle = 0.5 * (ends[axis].0 + ends[axis].1);
            (middle - half[axis], middle + half[axis])
        })
    }

    fn draw(&self, area: &Drawing<'_>, legend: u32) -> Result<(), Refused> {
        let (_, height) = area.dim_in_pixel();
        let (upper, lower) = area.split_vertically(height - legend * UNITS);
        let [across, up] = self.ends();
        let mut chart = ChartBuilder::on(&upper)
            .margin(MARGIN * UNITS)
            .x_label_area_size(LABELS[1] * UNITS)
            .y_label_area_size(LABELS[0] * UNITS)
            .build_cartesian_2d(across.0..across.1, up.0..up.1)?;
        for (place, polygon) in self.areas.iter().enumerate() {
            let color = if place == 0 { FILL } else { WHITE };
            let corners: Vec<(f64, f64)> = polygon.iter().map(|it| (it[0], it[1])).collect();
            chart.draw_series([Polygon::new(corners, color.filled())])?;
        }
        plane_mesh(
            &mut chart,
            [(&self.labels[0], across, 9), (&self.labels[1], up, 9)],
        )?;
        let units = UNITS as i32;
        for stroke in &self.strokes {
            let line = stroke.places.iter().map(|it| (it[0], it[1]));
            let style = stroke.color.stroke_width(STROKE * UNITS);
            match stroke.is_dashed {
                true => chart.draw_series(DashedLineSeries::new(
                    line,
                    (DASH * units) as u32,
                    (DASH * units) as u32,
                    style,
                ))?,
                false => chart.draw_series(LineSeries::new(line, style))?,
            };
        }
        let start = self.start.map(|it| (it[0], it[1]));
        chart.draw_series(start.map(|at| Circle::new(at, 4 * units, BLACK.filled())))?;
        let left = (MARGIN + LABELS[0]) as i32 * units;
        let row = |place: usize| (place as i32 * ROW as i32 + ROW as i32 / 2) * units;
        let text = |words: &str, place: usize| {
            let style = ("sans-serif", 14 * UNITS).into_font();
            let at = (left + 36 * units, row(place) - 8 * units);
            Text::new(words.to_string(), at, style)
        };
        for (place, entry) in self.entries.iter().enumerate() {
            let [from, to] = [left, left + 28 * units];
            let middle = [from + 11 * units, from + 17 * units];
            let parts = match entry.is_dashed {
                true => vec![[from, middle[0]], [middle[1], to]],
                false => vec![[from, to]],
            };
            for [from, to] in parts {
                let sample = vec![(from, row(place)), (to, row(place))];
                let style = entry.color.stroke_width(STROKE * UNITS);
                lower.draw(&PathElement::new(sample, style))?;
            }
            lower.draw(&text(&entry.words, place))?;
        }
        let last = self.entries.len();
        let center = (left + 14 * units, row(last));
        lower.draw(&Circle::new(center, 4 * units, BLACK.filled()))?;
        lower.draw(&text("design configuration", last))?;
        Ok(())
    }
}
