//! Draws the path of an equilibrium as SVG: each free coordinate over the parameter.

use linkwright_codegen::stages::system::System;
use linkwright_solver::equilibrium::{PathEventKind, Stability};
use plotters::prelude::*;

use super::equilibrium_path::Followed;
use super::equilibrium_text::free_columns;
use super::picture::signed;
use super::plot::{COLORS, Drawing, Refused, UNITS, drawn, extent, plane_mesh, range};

/// Width of the picture and height of a panel, in pixels.
const WIDTH: u32 = 860;
const PANEL: u32 = 380;

/// Height of the title and of the legend, in pixels.
const TITLE: u32 = 44;
const LEGEND: u32 = 36;

/// Length of a dash and of the gap behind it, in pixels.
const DASH: u32 = 6;

/// Radius of the mark of an event, in pixels.
const MARK: u32 = 4;

/// Draws the path.
///
/// # Errors
/// Errors of the drawing library.
pub fn picture(followed: &Followed, system: &System) -> Result<String, String> {
    let count = free_columns(system).len().max(1) as u32;
    let size = (WIDTH, TITLE + count * PANEL + LEGEND);
    let title = format!(
        "{}: equilibrium {} over {}",
        system.mechanism.title(),
        followed.of + 1,
        followed.name
    );
    let drawing = drawn(&title, size, |area| draw(area, followed, system));
    let drawing = drawing.map_err(|error| format!("cannot draw the path: {error}"))?;
    Ok(signed(&drawing))
}

fn draw(area: &Drawing<'_>, followed: &Followed, system: &System) -> Result<(), Refused> {
    let columns = free_columns(system);
    let (_, height) = area.dim_in_pixel();
    let (upper, lower) = area.split_vertically(height - LEGEND * UNITS);
    let unit = system.mechanism.units.of_messages().of(&followed.unit);
    let across = format!("{} ({})", followed.name, unit.name);
    let path = &followed.path;
    let (low, high) = extent(path.rows.iter().map(|it| unit.of_si(it.value)));
    let margin = 0.03 * (high - low).max(f64::MIN_POSITIVE);
    let ends = (low - margin, high + margin);
    let panels = upper.split_evenly((columns.len().max(1), 1));
    for (place, (panel, column)) in panels.iter().zip(&columns).enumerate() {
        let point = |row: &linkwright_solver::equilibrium::PathRow| {
            let value = row.equilibrium.free.get(place).copied().unwrap_or(f64::NAN);
            (unit.of_si(row.value), column.unit.of_si(value))
        };
        let reference = column.unit.of_si(column.scale);
        let up = range(path.rows.iter().map(|it| point(it).1), reference);
        let mut chart = ChartBuilder::on(panel)
            .margin(10 * UNITS)
            .x_label_area_size(44 * UNITS)
            .y_label_area_size(84 * UNITS)
            .build_cartesian_2d(ends.0..ends.1, up.0..up.1)?;
        let label = format!("{} ({})", column.name, column.unit.name);
        plane_mesh(&mut chart, [(&across, ends, 9), (&label, up, 9)])?;
        for (is_stable, places) in sections(followed) {
            let points = places.into_iter().map(point);
            let style = COLORS[usize::from(!is_stable)].stroke_width(2 * UNITS);
            match is_stable {
                true => chart.draw_series(LineSeries::new(points, style))?,
                false => chart.draw_series(DashedLineSeries::new(
                    points,
                    DASH * UNITS,
                    DASH * UNITS,
                    style,
                ))?,
            };
        }
        let marks = path.events.iter().map(|event| {
            let style = match event.kind {
                PathEventKind::Fold => BLACK.filled(),
                PathEventKind::ChangeOfStability => BLACK.stroke_width(UNITS),
            };
            Circle::new(point(&event.row), (MARK * UNITS) as i32, style)
        });
        chart.draw_series(marks)?;
    }
    legend(&lower)
}

/// Returns sections of equal stability, joined at events.
fn sections(followed: &Followed) -> Vec<(bool, Vec<&linkwright_solver::equilibrium::PathRow>)> {
    let path = &followed.path;
    let mut sections: Vec<(bool, Vec<_>)> = Vec::new();
    for (place, row) in path.rows.iter().enumerate() {
        let events = path.events.iter().filter(|it| it.place == place);
        let is_stable = row.equilibrium.verdict.stability == Stability::Stable;
        let joints: Vec<_> = events.map(|it| &it.row).collect();
        if let Some((_, places)) = sections.last_mut() {
            places.extend(joints.iter().copied());
        }
        let is_same = sections.last().is_some_and(|it| it.0 == is_stable);
        if !is_same {
            let before = sections.last().and_then(|it| it.1.last().copied());
            sections.push((is_stable, before.into_iter().collect()));
        }
        if let Some((_, places)) = sections.last_mut() {
            places.push(row);
        }
    }
    sections
}

fn legend(area: &Drawing<'_>) -> Result<(), Refused> {
    let units = UNITS as i32;
    let y = LEGEND as i32 / 2 * units;
    let text = |words: &str, x: i32| {
        let style = ("sans-serif", 14 * UNITS).into_font();
        Text::new(words.to_string(), (x * units, y - 6 * units), style)
    };
    let line = |from: i32, to: i32, color: RGBColor| {
        let places = vec![(from * units, y), (to * units, y)];
        PathElement::new(places, color.stroke_width(2 * UNITS))
    };
    area.draw(&line(94, 124, COLORS[0]))?;
    area.draw(&text("stable", 132))?;
    area.draw(&line(214, 225, COLORS[1]))?;
    area.draw(&line(232, 243, COLORS[1]))?;
    area.draw(&text("not stable", 252))?;
    let mark = (MARK * UNITS) as i32;
    area.draw(&Circle::new((366 * units, y), mark, BLACK.filled()))?;
    area.draw(&text("fold", 378))?;
    let ring = BLACK.stroke_width(UNITS);
    area.draw(&Circle::new((440 * units, y), mark, ring))?;
    area.draw(&text("change of stability", 452))?;
    Ok(())
}
