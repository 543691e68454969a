//! Writes a figure as a DXF in mm, of version AC1015, in ASCII.
//!
//! Pins are circles, arcs are arcs, links are polylines with arcs at their ends, and dimensions are dimensions with their blocks.
//! Figure, names and dimensions are laid out as in the SVG.

mod contents;
mod entity;
mod layer;
mod pairs;
mod sections;
mod shapes;
mod tables;

use std::fmt;

use super::dimension::{Dimension, LETTERS};
use super::plane::{Bounds, Point, scaled};
use super::pose::Scene;
pub(super) use contents::{CENTER_MARK, Inscription, Plate};
use contents::{Drawn, outlines, texts};
use entity::{CAPITALS, Entity};
use layer::Layers;
use sections::Sections;
use tables::Facts;

/// Largest coordinate, in mm: beyond it a double does not resolve a micrometer.
const MAX_COORDINATE: f64 = 1e12;

/// Reason that a drawing cannot be written as a DXF.
#[derive(Clone, Debug, PartialEq)]
pub enum Undrawable {
    /// A coordinate of this part is infinite or undefined.
    NotFinite(String),
    /// A coordinate of this part, in mm, is larger than a DXF resolves.
    TooFar(String, f64),
}

impl fmt::Display for Undrawable {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Undrawable::NotFinite(part) => {
                write!(formatter, "a coordinate of {part} is not a finite number")
            }
            Undrawable::TooFar(part, coordinate) => write!(
                formatter,
                "a coordinate of {part} is {coordinate:.3e} mm, and a DXF resolves micrometers up to {MAX_COORDINATE:e} mm"
            ),
        }
    }
}

impl std::error::Error for Undrawable {}

/// Writes a drawing.
///
/// # Errors
/// A coordinate is not finite, or too large.
pub(super) fn written(plate: &Plate<'_>) -> Result<String, Undrawable> {
    let factor = 1000.0 / plate.figure.scale;
    let mut layers = Layers::default();
    let mut entities = Vec::new();
    let mut bounds = Bounds::EMPTY;
    let mut add = |layers: &mut Layers, it: Drawn| -> Result<(), Undrawable> {
        let points = checked(&it.part, it.shape.points())?;
        points.into_iter().for_each(|point| bounds.include(point));
        entities.push(Entity {
            layer: layers.name(it.content, &plate.names),
            line_type: it.line_type,
            shape: it.shape,
        });
        Ok(())
    };
    for drawn in outlines(plate, factor) {
        add(&mut layers, drawn)?;
    }
    let dimensions = plate.figure.dimensions.iter();
    let dimensions: Vec<Dimension> = dimensions.map(|it| it.scaled(factor)).collect();
    for dimension in &dimensions {
        let points = checked("a dimension", dimension.lines().feet.to_vec())?;
        points.into_iter().for_each(|point| bounds.include(point));
        bounds.include(dimension.bounds().low);
        bounds.include(dimension.bounds().high);
    }
    if bounds.is_empty() {
        bounds = Bounds::of([[0.0; 2]]);
    }
    for drawn in texts(plate, factor, &mut bounds) {
        entities.push(Entity {
            layer: layers.name(drawn.content, &plate.names),
            line_type: None,
            shape: drawn.shape,
        });
    }
    let corners = bounds.low.iter().chain(&bounds.high);
    let extent = corners.fold(f64::MIN_POSITIVE, |most, it| most.max(it.abs()));
    let sections = Sections {
        entities,
        dimensions,
        extent,
    };
    let facts = Facts {
        bounds,
        factor,
        capitals: CAPITALS * LETTERS * factor,
        decimals: plate.decimals,
        deviation: plate.deviation,
    };
    Ok(sections.text(layers, &facts))
}

/// Checks that the points of a part lie where a DXF resolves them, and returns them.
fn checked(part: &str, points: Vec<Point>) -> Result<Vec<Point>, Undrawable> {
    for coordinate in points.iter().flatten().map(|it| it.abs()) {
        if !coordinate.is_finite() {
            return Err(Undrawable::NotFinite(part.to_string()));
        }
        if coordinate > MAX_COORDINATE {
            return Err(Undrawable::TooFar(part.to_string(), coordinate));
        }
    }
    Ok(points)
}

impl Scene {
    /// Checks that all bodies, their points and the marks of joints can be drawn.
    ///
    /// # Errors
    /// A coordinate is not finite, or too large.
    pub fn check(&self) -> Result<(), Undrawable> {
        let millimeters =
            |points: Vec<Point>| points.into_iter().map(|it| scaled(it, 1000.0)).collect();
        for body in &self.bodies {
            let mut points = vec![body.place.origin];
            points.extend(body.points.iter().map(|it| body.place.globally(*it)));
            checked(&format!("body `{}`", body.name), millimeters(points))?;
        }
        for sign in &self.signs {
            let mut points: Vec<Point> = sign.marks.iter().map(|it| self.global(*it)).collect();
            let curve = sign.curve.iter();
            points.extend(curve.flat_map(|it| it.points.iter().copied()));
            points.push([sign.number; 2]);
            checked(&sign.label, millimeters(points))?;
        }
        Ok(())
    }
}
