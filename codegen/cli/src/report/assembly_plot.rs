//! *Assemblies* → *one SVG*: every body as the lines between its points, each assembly in a panel of its own, the drawing's first.
//!
//! All panels have the same scale. The module does not know files.

use linkwright_codegen::stages::expr::Tape;
use linkwright_codegen::stages::system::System;
use linkwright_solver::assemblies::Assembly;
use plotters::prelude::*;

use super::picture::signed;

/// Width and height of a panel in pixels.
const PANEL: u32 = 320;

/// How many panels stand side by side.
const COLUMNS: usize = 4;

/// How many assemblies are drawn.
const DRAWN: usize = 64;

/// The palette of Okabe and Ito, whose colors remain distinct for the color-blind.
const COLORS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
];

type Refused = Box<dyn std::error::Error>;

/// The points of each body, in the order in which it carries them.
type Shape = Vec<Vec<(f64, f64)>>;

/// The picture of all assemblies; empty where there are none.
///
/// # Errors
/// What the drawing library refuses.
pub fn draw(system: &System, assemblies: &[Assembly]) -> Result<String, String> {
    let shapes: Vec<Shape> = assemblies
        .iter()
        .take(DRAWN)
        .map(|assembly| shape(system, assembly))
        .collect();
    let mut text = String::new();
    if !shapes.is_empty() {
        picture(&mut text, &shapes, assemblies)
            .map_err(|error| format!("cannot draw the assemblies: {error}"))?;
        text = signed(&text);
    }
    Ok(text)
}

/// Where the points and the origin of every body are; a body's outline returns to where it began.
fn shape(system: &System, assembly: &Assembly) -> Shape {
    let mut system = system.clone();
    let mechanism = &mut system.mechanism;
    let graph = &mut mechanism.graph;
    let mut symbols = vec![0.0; graph.symbol_count()];
    graph.fill_nominal(&mut symbols);
    symbols[mechanism.time.index()] = assembly.instant.t();
    for (coordinate, value) in system.coordinates.iter().zip(assembly.instant.q()) {
        symbols[coordinate.position.index()] = *value;
    }
    let bodies = mechanism.bodies.iter().skip(1);
    bodies
        .map(|body| {
            let mut roots: Vec<_> = body
                .marks
                .iter()
                .flat_map(|it| it.mark.position(graph))
                .collect();
            if body.marks.len() < 2 {
                roots.extend(body.frame.origin);
            } else if let [x, y, ..] = roots[..] {
                roots.extend([x, y]);
            }
            let mut places = vec![0.0; roots.len()];
            Tape::new(graph, &roots).evaluate(&symbols, &mut Vec::new(), &mut places);
            places.chunks_exact(2).map(|it| (it[0], it[1])).collect()
        })
        .collect()
}

fn picture(text: &mut String, shapes: &[Shape], assemblies: &[Assembly]) -> Result<(), Refused> {
    let columns = shapes.len().min(COLUMNS);
    let rows = shapes.len().div_ceil(COLUMNS);
    let area = SVGBackend::with_string(text, (PANEL * columns as u32, PANEL * rows as u32))
        .into_drawing_area();
    area.fill(&WHITE)?;
    let range = |pick: fn(&(f64, f64)) -> f64| {
        let values = shapes.iter().flatten().flatten().map(pick);
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), it| {
            (low.min(it), high.max(it))
        })
    };
    let (x, y) = (range(|it| it.0), range(|it| it.1));
    // A tenth more than the widest, and as much again for the title of a tall one.
    let half = (0.6 * (x.1 - x.0).max(y.1 - y.0)).max(f64::MIN_POSITIVE);
    let around = |(low, high): (f64, f64), half: f64| {
        let middle = 0.5 * (low + high);
        middle - half..middle + half
    };
    for ((panel, shape), assembly) in area
        .split_evenly((rows, columns))
        .iter()
        .zip(shapes)
        .zip(assemblies)
    {
        let signs = assembly.label().replace('-', "−");
        let drawn = if assembly.drawn { " as drawn" } else { "" };
        // The title takes from the height: lengths must look the same in x and y.
        let panel = panel.titled(&format!("{signs}{drawn}"), ("sans-serif", 16))?;
        let (width, height) = panel.dim_in_pixel();
        let tall = half * f64::from(height) / f64::from(width);
        let mut chart =
            ChartBuilder::on(&panel).build_cartesian_2d(around(x, half), around(y, tall))?;
        for (body, color) in shape.iter().zip(COLORS.iter().cycle()) {
            chart.draw_series(LineSeries::new(body.iter().copied(), color.stroke_width(2)))?;
            let pins = body.iter().map(|&pin| Circle::new(pin, 3, color.filled()));
            chart.draw_series(pins)?;
        }
    }
    area.present()?;
    Ok(())
}
