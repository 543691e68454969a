//! Turns the outlines of a figure into shapes of a DXF.

use super::super::figure::{Element, Figure, Frame, Look, Outline, offset_edges};
use super::super::plane::{Place, Point, RELATIVE_ROUNDING, angle_of, difference, scaled};
use super::entity::{Shape, Vertex, dot};

/// Number of corners of a circle that is stretched.
const STRETCHED: usize = 72;

/// Position of a frame of the figure in the drawing.
pub(super) struct Placed<'a> {
    figure: &'a Figure,
    frame: Frame,
    place: Place,
    stretch: [f64; 2],
    /// Millimeters of a pixel.
    factor: f64,
}

impl Placed<'_> {
    pub fn new(figure: &Figure, frame: Frame, factor: f64) -> Placed<'_> {
        Placed {
            figure,
            frame,
            place: figure.stance.place(frame),
            stretch: figure.stance.stretch(frame),
            factor,
        }
    }

    /// Point of the frame in mm.
    pub fn point(&self, point: Point) -> Point {
        let deformed = self.figure.stance.deformed(self.frame, point);
        scaled(self.place.globally(deformed), self.factor)
    }

    /// Length of the frame in mm; `None` if the directions differ in it.
    fn length(&self, length: f64) -> Option<f64> {
        let [x, y] = self.stretch.map(f64::abs);
        let is_even = (x - y).abs() <= RELATIVE_ROUNDING * x.max(y);
        (is_even && !matches!(self.frame, Frame::Wound(..))).then_some(length * x * self.factor)
    }

    /// Shapes of an outline.
    pub fn shapes(&self, element: &Element) -> Vec<Shape> {
        let is_filled = is_filled(element.look);
        match &element.outline {
            Outline::Circle(center, radius) => {
                let center_at = self.point(*center);
                match self.length(*radius) {
                    Some(radius) if is_filled => vec![dot(center_at, radius)],
                    Some(radius) => vec![Shape::Circle(center_at, radius)],
                    None => vec![self.polygon(&corners_of_circle(*center, *radius))],
                }
            }
            Outline::Ring(center, inner, outer) => [inner, outer]
                .into_iter()
                .flat_map(|radius| {
                    self.shapes(&Element {
                        look: element.look,
                        outline: Outline::Circle(*center, *radius),
                    })
                })
                .collect(),
            Outline::Arc(center, radius, ends) => match self.length(*radius) {
                Some(radius) => vec![self.arc(*center, radius, *ends)],
                None => vec![self.line(&element.outline.points())],
            },
            Outline::Rounded(corners, radius) => match (&corners[..], self.length(*radius)) {
                ([], _) => Vec::new(),
                ([only], Some(radius)) => vec![Shape::Circle(self.point(*only), radius)],
                (_, Some(_)) if *radius > 0.0 => vec![self.rounded(corners, *radius)],
                (corners, _) => vec![self.polygon(corners)],
            },
            Outline::Closed(points) if is_filled && matches!(points.len(), 3 | 4) => {
                vec![Shape::Solid(
                    points.iter().map(|it| self.point(*it)).collect(),
                )]
            }
            Outline::Closed(points) => vec![self.polygon(points)],
            Outline::Open(points) => vec![self.line(points)],
        }
    }

    fn arc(&self, center: Point, radius: f64, ends: [f64; 2]) -> Shape {
        let is_mirrored = self.stretch[0] * self.stretch[1] < 0.0;
        let ends = ends.map(|it| if is_mirrored { -it } else { it } + self.place.angle);
        let [from, to] = ends;
        let ends = if from < to { [from, to] } else { [to, from] };
        Shape::Arc(self.point(center), radius, ends)
    }

    fn line(&self, points: &[Point]) -> Shape {
        match points {
            [from, to] => Shape::Line([*from, *to].map(|it| self.point(it))),
            points => self.polyline(points, false),
        }
    }

    fn polygon(&self, points: &[Point]) -> Shape {
        self.polyline(points, true)
    }

    fn polyline(&self, points: &[Point], is_closed: bool) -> Shape {
        Shape::Polyline {
            vertices: points.iter().map(|it| (self.point(*it), 0.0)).collect(),
            is_closed,
            width: 0.0,
        }
    }

    /// Edges of a convex polygon at a distance, with arcs about its corners.
    fn rounded(&self, corners: &[Point], radius: f64) -> Shape {
        let edges = offset_edges(corners, radius);
        let next = edges.iter().cycle().skip(1);
        let vertices = edges
            .iter()
            .zip(next)
            .flat_map(|([from, to], [next_from, next_to])| {
                let directions = [difference(*to, *from), difference(*next_to, *next_from)];
                let [before, after] = directions.map(angle_of);
                let turn = (after - before).rem_euclid(std::f64::consts::TAU);
                let vertex = |point: &Point, bulge: f64| -> Vertex { (self.point(*point), bulge) };
                [vertex(from, 0.0), vertex(to, (0.25 * turn).tan())]
            });
        Shape::Polyline {
            vertices: vertices.collect(),
            is_closed: true,
            width: 0.0,
        }
    }
}

/// True if an outline is filled with ink.
fn is_filled(look: Look) -> bool {
    matches!(
        look,
        Look::Ink | Look::DriveHead | Look::LoadHead | Look::AxisHead | Look::Tick
    )
}

fn corners_of_circle(center: Point, radius: f64) -> Vec<Point> {
    let angle = |corner: usize| std::f64::consts::TAU * corner as f64 / STRETCHED as f64;
    (0..STRETCHED)
        .map(|corner| {
            let (sine, cosine) = angle(corner).sin_cos();
            [center[0] + radius * cosine, center[1] + radius * sine]
        })
        .collect()
}
