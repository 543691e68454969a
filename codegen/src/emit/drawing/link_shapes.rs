//! Each link alone: its shape, its pins with center marks, and the directions in which it slides.
//!
//! A link is the shape of its body in the figure of the mechanism, or a link without a body. Lengths are pixels of its own frame.

use super::draft::{BLOCK, LINK, PIN, corners, distinct};
use super::dxf::CENTER_MARK;
use super::figure::{Figure, Frame, Group, Layer, Look, Outline};
use super::measurable::{Measurable, fixed_points, longest, rods};
use super::plane::{
    Place, Point, RELATIVE_ROUNDING, angle_of, difference, distance, dot, heading, hull, left_of,
    onward, scaled,
};
use super::pose::{Scene, Sign};
use super::slides::slides;
use crate::joint::Feature;

/// Half the length of the line of a slide, and length of its arrowheads, in units.
const SLIDE: [f64; 2] = [46.0, 8.0];

/// Half the length of the mark of a point without a pin, in units.
const POINT_MARK: f64 = 4.5;

/// Length of a center line beyond its points, in units.
const BEYOND: f64 = 14.0;

/// Link alone.
#[derive(Clone, Debug)]
pub(super) struct LinkShape {
    /// Unique id.
    pub slug: String,
    pub name: String,
    pub title: String,
    pub elements: Vec<(Layer, Look, Outline)>,
    pub points: Vec<Point>,
    /// Centers and radii of circles whose diameters are lengths of the mechanism.
    pub circles: Vec<(Point, f64)>,
    /// Length without rounding, in m; `None` for a link with a body.
    pub length: Option<f64>,
    /// Points with their names.
    pub names: Vec<(Point, String)>,
    /// Angle at which its longest distance is horizontal.
    pub angle: f64,
}

impl LinkShape {
    /// Distances that the sheet shows, with points in the position of a frame.
    pub fn measurable(&self, place: Place, scale: f64) -> Measurable {
        let points: Vec<Point> = self.points.iter().map(|it| place.globally(*it)).collect();
        match (self.length, &points[..]) {
            (Some(length), [from, to]) => Measurable::rod([*from, *to], length),
            _ => {
                let circles = self.circles.iter();
                let circles = circles.map(|(center, radius)| (place.globally(*center), *radius));
                Measurable::of(points.clone(), circles, scale, true)
            }
        }
    }

    /// Outlines in the frame of this number.
    pub fn group(&self, frame: usize) -> Group {
        let mut group = Group::new(format!("link-{}", self.slug), self.title.clone());
        for (layer, look, outline) in &self.elements {
            group.add(*layer, Frame::Body(frame), *look, outline.clone());
        }
        group
    }
}

/// All links of a mechanism whose figure was drafted with signs of size `unit`: bodies, links without a body, and the ground.
pub(super) fn link_shapes(scene: &Scene, figure: &Figure, unit: f64) -> Vec<LinkShape> {
    let corners = corners(scene, figure.scale);
    let bodies = scene.bodies.iter().enumerate().skip(1);
    let bodies = bodies.filter(|(_, it)| !it.is_dial);
    let mut links: Vec<LinkShape> = bodies
        .map(|(body, carried)| {
            let mut link = Shaping::new(scene, figure, unit, body);
            link.shape.title = format!("body {}", carried.name);
            link.shape.points = corners[body].clone();
            link.draw_body();
            link.shape
        })
        .collect();
    let without_body = rods(scene);
    links.extend(without_body.map(|(sign, length)| rod(sign, length, figure.scale, unit)));
    let mut ground = Shaping::new(scene, figure, unit, 0);
    ground.shape.title = "ground".to_string();
    ground.shape.points = fixed_points(scene, figure.scale);
    // Their names may be those of points of other bodies in the same place.
    let named = scene.points.iter();
    let named = named.map(|it| {
        (
            scaled(scene.global(it.at), figure.scale),
            it.written.clone(),
        )
    });
    ground.shape.names.extend(named);
    if ground.shape.points.len() > 1 || !ground.shape.circles.is_empty() {
        ground.draw_circles();
        ground.draw_pins();
        ground.finish();
        links.push(ground.shape);
    }
    links.retain(|link| !link.points.is_empty() || !link.circles.is_empty());
    links
}

/// Link of constant length without a body.
fn rod(sign: &Sign, length: f64, scale: f64, unit: f64) -> LinkShape {
    let points = vec![[0.0; 2], [length * scale, 0.0]];
    let outline = Outline::Rounded(points.clone(), LINK * unit);
    let mut elements = vec![(Layer::Below, Look::Massless, outline)];
    for point in &points {
        let circle = Outline::Circle(*point, PIN * unit);
        elements.push((Layer::Above, Look::Part, circle));
        mark(*point, PIN * unit + CENTER_MARK, 0.0, &mut elements);
    }
    elements.push((Layer::Above, Look::Thought, center_line(&points, unit)));
    LinkShape {
        slug: sign.slug.clone(),
        name: sign.label.clone(),
        title: sign.label.clone(),
        elements,
        points,
        circles: Vec::new(),
        length: Some(length),
        names: Vec::new(),
        angle: 0.0,
    }
}

/// Center line through two points.
fn center_line(points: &[Point], unit: f64) -> Outline {
    let [from, to] = [points[0], points[points.len() - 1]];
    let along = scaled(difference(to, from), 1.0 / distance(from, to));
    Outline::line(
        onward(from, -BEYOND * unit, along),
        onward(to, BEYOND * unit, along),
    )
}

/// Mark of a center, turned with the link by the angle at which the sheet shows it.
fn mark(at: Point, half: f64, angle: f64, elements: &mut Vec<(Layer, Look, Outline)>) {
    for along in [heading(-angle), left_of(heading(-angle))] {
        let line = Outline::line(onward(at, -half, along), onward(at, half, along));
        elements.push((Layer::Above, Look::Mark, line));
    }
}

/// Link of a body that is being drawn.
struct Shaping<'a> {
    scene: &'a Scene,
    figure: &'a Figure,
    unit: f64,
    body: usize,
    shape: LinkShape,
    /// Centers with half the lengths of their marks.
    marks: Vec<(Point, f64)>,
}

impl Shaping<'_> {
    fn new<'a>(scene: &'a Scene, figure: &'a Figure, unit: f64, body: usize) -> Shaping<'a> {
        let circles = figure.diameters.iter().filter(|it| it.at.body == body);
        let carried = &scene.bodies[body];
        let places = carried.points.iter().map(|it| scaled(*it, figure.scale));
        let names = places.zip(carried.names.iter().cloned());
        Shaping {
            scene,
            figure,
            unit,
            body,
            shape: LinkShape {
                slug: carried.name.clone(),
                name: carried.name.clone(),
                title: String::new(),
                elements: Vec::new(),
                points: Vec::new(),
                circles: circles.map(|it| (it.at.local, it.radius)).collect(),
                length: None,
                names: names.collect(),
                angle: 0.0,
            },
            marks: Vec::new(),
        }
    }

    fn draw_body(&mut self) {
        let frame = Frame::Body(self.body);
        let parts = self.figure.bodies[self.body - 1].parts();
        let outlines = parts.flat_map(|part| part.elements.iter().map(move |it| (part.frame, it)));
        let joints = self.figure.joints.iter().flat_map(Group::parts);
        let joints = joints.flat_map(|part| part.elements.iter().map(move |it| (part.frame, it)));
        // Pins follow, with center marks.
        let outlines = outlines.filter(|(_, it)| it.look != Look::Ink);
        let is_shape = |look: Look, outline: &Outline| match (look, outline) {
            (Look::Face, _) | (Look::Edge, Outline::Closed(_)) => true,
            (Look::Thought, Outline::Circle(center, radius)) => {
                let mut circles = self.shape.circles.iter();
                circles.any(|(it, own)| distance(*it, *center) < 0.5 && (own - radius).abs() < 0.5)
            }
            _ => false,
        };
        let joints = joints.filter(|(_, it)| is_shape(it.look, &it.outline));
        let elements = outlines.chain(joints).filter(|(it, _)| *it == frame);
        let elements: Vec<_> = elements
            .map(|(_, it)| (Layer::Below, it.look, it.outline.clone()))
            .collect();
        self.shape.elements = elements;
        let slides = slides(self.scene, self.body, self.figure.scale);
        let is_empty = !self
            .shape
            .elements
            .iter()
            .any(|(_, look, _)| matches!(look, Look::Body | Look::Disc | Look::Face));
        if is_empty {
            let at = self.shape.points.first().copied().unwrap_or_default();
            let outline = match slides.first() {
                Some((at, along)) => Outline::block(*at, *along, scaled(BLOCK, self.unit)),
                None => Outline::Circle(at, 1.3 * LINK * self.unit),
            };
            self.shape
                .elements
                .push((Layer::Below, Look::Body, outline));
        }
        self.draw_circles();
        self.draw_pins();
        for (at, along) in slides {
            self.draw_slide(at, along);
        }
        self.finish();
    }

    /// Rollers and pitch circles that are not drawn yet.
    fn draw_circles(&mut self) {
        for (center, radius) in self.shape.circles.clone() {
            let is_drawn = self
                .shape
                .elements
                .iter()
                .any(|(_, _, outline)| match outline {
                    Outline::Circle(it, own) => {
                        distance(*it, center) < 0.5 && (own - radius).abs() < 0.5
                    }
                    _ => false,
                });
            if !is_drawn {
                let roller = Outline::Circle(center, radius);
                let look = if self.body == 0 {
                    Look::Thought
                } else {
                    Look::Edge
                };
                self.shape.elements.push((Layer::Upon, look, roller));
            }
        }
    }

    /// Pins of joints, and marks of the other points.
    fn draw_pins(&mut self) {
        let place = self.scene.bodies[self.body].place;
        let mut pins: Vec<Point> = Vec::new();
        for sign in &self.scene.signs {
            let count = match sign.feature {
                Feature::Pin | Feature::Link => 2,
                Feature::Coordinate(_) if !sign.is_driver => 1,
                _ => 0,
            };
            let marks = sign.marks.iter().take(count);
            let marks = marks.filter(|it| it.body == self.body || self.body == 0 && count == 1);
            pins.extend(marks.map(|it| place.locally(self.scene.global(*it))));
            if let (Feature::Slot(_), Some(line)) = (sign.feature, sign.line)
                && let Some(mark) = sign.marks.get(line.other)
                && mark.body == self.body
            {
                pins.push(mark.local);
            }
        }
        let pins = distinct(pins.into_iter().map(|it| scaled(it, self.figure.scale)));
        for point in self.shape.points.clone() {
            let mut half = POINT_MARK * self.unit;
            if pins.iter().any(|it| distance(*it, point) < 0.2) {
                let radius = PIN * self.unit;
                half = radius + CENTER_MARK;
                let circle = Outline::Circle(point, radius);
                self.shape.elements.push((Layer::Above, Look::Part, circle));
            }
            self.marks.push((point, half));
        }
    }

    /// Center line with an arrowhead at each end.
    fn draw_slide(&mut self, at: Point, along: Point) {
        let [half, head] = SLIDE.map(|it| it * self.unit);
        let elements = &mut self.shape.elements;
        let line = Outline::line(onward(at, -half, along), onward(at, half, along));
        elements.push((Layer::Above, Look::Thought, line));
        for way in [-1.0, 1.0] {
            let tip = onward(at, way * (half + head), along);
            let arrow = Outline::head(tip, scaled(along, way), head);
            elements.push((Layer::Above, Look::Ink, arrow));
        }
    }

    /// Adds the center line, and turns the link so that its longest distance is horizontal and most of it lies above.
    fn finish(&mut self) {
        let points = &self.shape.points;
        if points.len() > 1
            && let [from, to] = hull(points)[..]
        {
            let line = center_line(&[from, to], self.unit);
            self.shape
                .elements
                .push((Layer::Above, Look::Thought, line));
        }
        let along = match longest(points) {
            Some([a, b]) => difference(points[b], points[a]),
            None => slides(self.scene, self.body, self.figure.scale)
                .first()
                .map_or([1.0, 0.0], |(_, along)| *along),
        };
        let from = longest(points).map_or([0.0; 2], |[a, _]| points[a]);
        let above: f64 = points
            .iter()
            .map(|it| dot(left_of(along), difference(*it, from)))
            .sum();
        let is_upside_down = above < -RELATIVE_ROUNDING * dot(along, along)
            || (above.abs() <= RELATIVE_ROUNDING * dot(along, along) && along[0] < 0.0);
        let turn = if is_upside_down {
            std::f64::consts::PI
        } else {
            0.0
        };
        let angle = turn - angle_of(along);
        self.shape.angle = angle;
        for (at, half) in std::mem::take(&mut self.marks) {
            mark(at, half, angle, &mut self.shape.elements);
        }
        // Points of the ground that only place bodies are not part of it.
        let points = &self.shape.points;
        let is_on_link =
            |(at, _): &(Point, String)| points.iter().any(|it| distance(*it, *at) < 0.2);
        self.shape.names.retain(is_on_link);
    }
}
