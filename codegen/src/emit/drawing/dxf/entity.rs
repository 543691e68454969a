//! Entities of a DXF, in mm.

use super::super::dimension::{Dimension, HEAD, Measured};
use super::super::figure::Outline;
use super::super::plane::{Point, onward, scaled};
use super::layer::LineType;
use super::pairs::{Handle, Pairs};

/// Height of capitals relative to the size of letters.
pub(super) const CAPITALS: f64 = 0.72;

/// Vertex of a polyline with the bulge of the segment behind it: the tangent of a quarter of its angle.
pub(super) type Vertex = (Point, f64);

/// Shape of an entity.
#[derive(Clone, Debug)]
pub(super) enum Shape {
    Line([Point; 2]),
    Circle(Point, f64),
    /// Counterclockwise from the first to the second angle, in rad.
    Arc(Point, f64, [f64; 2]),
    Polyline {
        vertices: Vec<Vertex>,
        is_closed: bool,
        /// Width of the line.
        width: f64,
    },
    /// Filled triangle or quadrangle; its corners in order.
    Solid(Vec<Point>),
    /// Text about its center, with the height of its capitals and its angle in rad.
    Text(String, Point, f64, f64),
    /// Text that begins at a point.
    Note(String, Point, f64),
    Point(Point),
    /// Dimension with the name of its block, in mm.
    Dimension(Box<Dimension>, String),
}

/// Shape on a layer.
#[derive(Clone, Debug)]
pub(super) struct Entity {
    pub layer: String,
    /// Line type; `None` for that of the layer.
    pub line_type: Option<LineType>,
    pub shape: Shape,
}

impl Entity {
    /// Adds its pairs.
    pub fn write(&self, pairs: &mut Pairs, handle: Handle, owner: Handle) {
        let kind = match self.shape {
            Shape::Line(_) => "LINE",
            Shape::Circle(..) => "CIRCLE",
            Shape::Arc(..) => "ARC",
            Shape::Polyline { .. } => "LWPOLYLINE",
            Shape::Solid(_) => "SOLID",
            Shape::Text(..) | Shape::Note(..) => "TEXT",
            Shape::Point(_) => "POINT",
            Shape::Dimension(..) => "DIMENSION",
        };
        pairs.word(0, kind).handle(5, handle).handle(330, owner);
        pairs.word(100, "AcDbEntity").text(8, &self.layer);
        if let Some(line_type) = self.line_type {
            pairs.word(6, line_type.definition().0);
        }
        self.shape.write(pairs);
    }
}

impl Shape {
    fn write(&self, pairs: &mut Pairs) {
        match self {
            Shape::Line([from, to]) => {
                pairs.word(100, "AcDbLine").point(10, *from).point(11, *to);
            }
            Shape::Circle(center, radius) => {
                pairs
                    .word(100, "AcDbCircle")
                    .point(10, *center)
                    .real(40, *radius);
            }
            Shape::Arc(center, radius, angles) => {
                let [from, to] = angles.map(|it| it.to_degrees().rem_euclid(360.0));
                pairs
                    .word(100, "AcDbCircle")
                    .point(10, *center)
                    .real(40, *radius);
                pairs.word(100, "AcDbArc").real(50, from).real(51, to);
            }
            Shape::Polyline {
                vertices,
                is_closed,
                width,
            } => {
                pairs
                    .word(100, "AcDbPolyline")
                    .integer(90, vertices.len() as i64);
                pairs.integer(70, i64::from(*is_closed)).real(43, *width);
                for (point, bulge) in vertices {
                    pairs.flat(10, *point);
                    if *bulge != 0.0 {
                        pairs.real(42, *bulge);
                    }
                }
            }
            Shape::Solid(corners) => {
                pairs.word(100, "AcDbTrace");
                // The third corner lies across the second; that of a triangle counts twice.
                let last = corners.len() - 1;
                for (code, corner) in [(10, 0), (11, 1), (12, last), (13, 2)] {
                    pairs.point(code, corners[corner]);
                }
            }
            Shape::Text(text, center, height, angle) => {
                pairs
                    .word(100, "AcDbText")
                    .point(10, *center)
                    .real(40, *height);
                pairs.text(1, text).real(50, angle.to_degrees());
                // In the middle of the text, both ways.
                pairs.word(7, "Standard").integer(72, 1).point(11, *center);
                pairs.word(100, "AcDbText").integer(73, 2);
            }
            Shape::Note(text, start, height) => {
                pairs
                    .word(100, "AcDbText")
                    .point(10, *start)
                    .real(40, *height);
                pairs
                    .text(1, text)
                    .word(7, "Standard")
                    .word(100, "AcDbText");
            }
            Shape::Point(point) => {
                pairs.word(100, "AcDbPoint").point(10, *point);
            }
            Shape::Dimension(dimension, block) => write_dimension(dimension, block, pairs),
        }
    }

    /// Points between which the shape lies; of a text its anchor.
    pub fn points(&self) -> Vec<Point> {
        match self {
            Shape::Line(points) => points.to_vec(),
            Shape::Circle(center, radius) | Shape::Arc(center, radius, _) => [-radius, *radius]
                .map(|it| [center[0] + it, center[1] + it])
                .to_vec(),
            Shape::Polyline { vertices, .. } => vertices.iter().map(|it| it.0).collect(),
            Shape::Solid(corners) => corners.clone(),
            Shape::Text(_, at, ..) | Shape::Note(_, at, _) | Shape::Point(at) => vec![*at],
            Shape::Dimension(dimension, _) => dimension.ends.to_vec(),
        }
    }
}

fn write_dimension(dimension: &Dimension, block: &str, pairs: &mut Pairs) {
    let lines = dimension.lines();
    // Aligned, with a block of its own: 1 + 32; with a text that is not where the style would put it: 128 more.
    let kind = if lines.is_text_beyond { "161" } else { "33" };
    pairs.word(100, "AcDbDimension").word(2, block);
    pairs.point(10, lines.feet[1]).point(11, lines.text_at);
    pairs.word(70, kind);
    pairs.word(
        1,
        match dimension.measured {
            Measured::Distance => "",
            Measured::Diameter => "%%c<>",
        },
    );
    pairs.integer(71, 5).real(42, 1000.0 * dimension.length);
    pairs.word(3, "Standard").word(100, "AcDbAlignedDimension");
    pairs
        .point(13, dimension.ends[0])
        .point(14, dimension.ends[1]);
}

/// Shapes of the block of a dimension, each with a flag that is true for measured points.
pub(super) fn dimension_block(dimension: &Dimension) -> Vec<(Shape, bool)> {
    let drawn = dimension.lines();
    let mut shapes: Vec<(Shape, bool)> = drawn
        .lines
        .iter()
        .map(|line| (Shape::Line(*line), false))
        .collect();
    for (foot, along) in drawn.feet.iter().zip(drawn.heads) {
        let head = Outline::head(*foot, along, HEAD * dimension.unit).points();
        shapes.push((Shape::Solid(head), false));
    }
    let text = match dimension.measured {
        Measured::Distance => dimension.text.clone(),
        Measured::Diameter => dimension.text.replace('Ø', "%%c"),
    };
    let height = CAPITALS * dimension.letters();
    let text = Shape::Text(text, drawn.text_at, height, drawn.text_angle);
    shapes.push((text, false));
    let points = dimension.ends.into_iter().chain([drawn.feet[1]]);
    shapes.extend(points.map(|it| (Shape::Point(it), true)));
    shapes
}

/// Filled circle: a closed polyline of two half circles, as wide as its radius.
pub(super) fn dot(center: Point, radius: f64) -> Shape {
    let side = |x: f64| (onward(center, 0.5 * radius, scaled([1.0, 0.0], x)), 1.0);
    Shape::Polyline {
        vertices: vec![side(-1.0), side(1.0)],
        is_closed: true,
        width: radius,
    }
}
