//! Drafts the figure of a scene at a scale: the signs of joints and the shapes of bodies, on one sheet.
//!
//! The kind of a joint decides its sign; several signs at one point are combined here. Fixed x and y of a point are a
//! pin on the ground. One of them together with the angle of the body is a block on a guide. A driven line between
//! two moving bodies is a cylinder.

use super::figure::{Figure, Frame, Group, Layer, Look, Outline};
use super::plane::{Point, distance, hull, scaled};
use super::pose::{At, Line, Scene, Sign};
use crate::force::Shape;
use crate::joint::Feature;

/// A sheet on which a scene is being drawn.
pub(super) struct Draft<'a> {
    pub scene: &'a Scene,
    pub figure: Figure,
    /// Size of signs: 1 if the figure has room, smaller if pins are close to one another.
    pub unit: f64,
    /// The corners of each body's shape, in pixels of its frame.
    pub corners: Vec<Vec<Point>>,
    /// True if a body has a shape already.
    pub is_shaped: Vec<bool>,
    /// Positions of supports.
    pub supports: Vec<Point>,
    /// Edges of bodies, and the lines of cylinders and of links without a body.
    pub lines: Vec<[Point; 2]>,
}

/// Half the width of a link, in units.
pub(super) const LINK: f64 = 7.0;

/// The radius of a pin, in units.
pub(super) const PIN: f64 = 4.5;

/// Half the length and the width of a sliding block, in units.
pub(super) const BLOCK: Point = [15.0, 9.0];

/// Draws a scene at a number of pixels per metre.
pub(super) fn drafted(scene: &Scene, scale: f64) -> (Figure, f64) {
    let moving = scene.bodies.iter().skip(1);
    let figure = Figure {
        scale,
        stance: scene.stance(0, scale),
        bodies: moving
            .map(|body| Group::new(format!("body-{}", body.name), format!("body {}", body.name)))
            .collect(),
        joints: Vec::new(),
        extras: Vec::new(),
        notes: Vec::new(),
        diameters: Vec::new(),
        dimensions: Vec::new(),
    };
    let mut draft = Draft {
        scene,
        figure,
        unit: 1.0,
        corners: corners(scene, scale),
        is_shaped: vec![false; scene.bodies.len()],
        supports: Vec::new(),
        lines: Vec::new(),
    };
    draft.collect_lines();
    draft.unit = draft.room();
    for sign in &scene.signs {
        let mut group = Group::new(format!("joint-{}", sign.slug), sign.label.clone());
        draft.sign(sign, &mut group);
        draft.figure.joints.push(group);
    }
    draft.dials();
    for body in 1..scene.bodies.len() {
        draft.shape(body);
    }
    draft.dots();
    draft.loads();
    let unit = draft.unit;
    (draft.figure, unit)
}

/// Points of each body's shape, in pixels of its frame: its own points, and those of its joints.
pub(super) fn corners(scene: &Scene, scale: f64) -> Vec<Vec<Point>> {
    let bodies = scene.bodies.iter();
    let mut corners: Vec<Vec<Point>> = bodies.map(|body| body.points.clone()).collect();
    for sign in &scene.signs {
        let is_held = match sign.feature {
            Feature::Pin | Feature::Weld | Feature::Link | Feature::Offset(_) => |_| true,
            Feature::Coordinate(_) | Feature::Contact(_) => |mark| mark == 0,
            Feature::Slide | Feature::Slot(_) | Feature::Pinion(_) => |_| true,
            _ => |_| false,
        };
        for (mark, at) in sign.marks.iter().enumerate() {
            if is_held(mark) {
                corners[at.body].push(at.local);
            }
        }
    }
    for points in &mut corners {
        *points = distinct(points.iter().map(|&it| scaled(it, scale)));
    }
    corners
}

/// Removes points that look like an earlier one, in pixels.
pub(super) fn distinct(points: impl Iterator<Item = Point>) -> Vec<Point> {
    let mut distinct: Vec<Point> = Vec::new();
    for point in points {
        if distinct.iter().all(|it| distance(*it, point) > 0.1) {
            distinct.push(point);
        }
    }
    distinct
}

impl Draft<'_> {
    fn collect_lines(&mut self) {
        for (corners, place) in self.corners.iter().zip(&self.figure.stance.places).skip(1) {
            let corners = hull(corners);
            let next = corners.iter().cycle().skip(1);
            let edges = corners.iter().zip(next).filter(|_| corners.len() > 1);
            let edges = edges.map(|(a, b)| [*a, *b].map(|it| place.globally(it)));
            self.lines.extend(edges);
        }
        for sign in &self.scene.signs {
            let is_line = matches!(sign.feature, Feature::Slide | Feature::Link);
            if is_line && sign.marks.iter().any(|mark| mark.body != 0) {
                let ends = [0, 1].map(|mark| self.global(sign.marks[mark]));
                self.lines.push(ends);
            }
        }
        for load in &self.scene.loads {
            if let (Shape::Spring | Shape::Damper, [from, to]) = (load.shape, &load.marks[..]) {
                let ends = [*from, *to].map(|it| self.global(it));
                self.lines.push(ends);
            }
        }
    }

    /// Largest size of signs: the length of the shortest link decides.
    fn room(&self) -> f64 {
        let links = self.corners.iter().skip(1);
        let lengths = links.map(|corners| {
            let first = corners.first().copied().unwrap_or_default();
            corners
                .iter()
                .fold(0.0, |most: f64, it| most.max(distance(first, *it)))
        });
        let shortest = lengths.filter(|it| *it > 4.0).fold(f64::INFINITY, f64::min);
        (shortest / 34.0).clamp(0.55, 1.0)
    }

    /// Mark in pixels of its body.
    pub fn pixels(&self, at: At) -> At {
        At {
            body: at.body,
            local: scaled(at.local, self.figure.scale),
        }
    }

    /// Position of a mark, in pixels.
    pub fn global(&self, at: At) -> Point {
        scaled(self.scene.global(at), self.figure.scale)
    }

    /// The group of a moving body.
    pub fn body(&mut self, body: usize) -> Option<&mut Group> {
        self.figure.bodies.get_mut(body.checked_sub(1)?)
    }

    /// Adds an outline to the shape of a body, which then has one.
    pub fn add_to_body(&mut self, body: usize, look: Look, outline: Outline) {
        self.is_shaped[body] = true;
        if let Some(group) = self.body(body) {
            group.add(Layer::Below, Frame::Body(body), look, outline);
        }
    }

    fn sign(&mut self, sign: &Sign, group: &mut Group) {
        match (sign.feature, sign.is_driver) {
            (Feature::Pin, _) => self.pin(sign, group),
            (Feature::Weld, _) => self.weld(sign, group),
            (Feature::Slide, false) => self.slide(sign, group),
            (Feature::Slide, true) => self.stroke(sign, group),
            (Feature::Slot(_), _) => self.slot(sign, group),
            (Feature::Coordinate(axis), false) => self.kept_coordinate(sign, axis, group),
            (Feature::Coordinate(axis), true) => self.moved_coordinate(sign, axis, group),
            (Feature::Orientation, false) => self.kept_orientation(sign, group),
            (Feature::Orientation, true) => self.turning(sign, group),
            (Feature::Link, is_driver) => self.link(sign, is_driver, group),
            (Feature::Offset(axis), is_driver) => self.offset(sign, axis, is_driver, group),
            (Feature::RelativeOrientation, is_driver) => self.angle(sign, is_driver, group),
            (Feature::Wheels(mesh, _), _) => self.wheels(sign, mesh, group),
            (Feature::Pinion(_), _) => self.pinion(sign, group),
            (Feature::Contact(follower), _) => self.contact(sign, follower, group),
            (Feature::Written, _) => self.written(sign, group),
        }
    }

    /// Adds the shape of a body: half a link's width around the convex hull of its points.
    fn shape(&mut self, body: usize) {
        let corners = hull(&self.corners[body]);
        let is_shaped = self.is_shaped[body];
        let radius = match corners.len() {
            0 | 1 if is_shaped => return,
            0 | 1 => 1.3 * LINK,
            _ if self.is_covered(body, &corners) => return,
            _ if self.has_face(body) => match corners.len() {
                2 => return,
                _ => 0.0,
            },
            _ => LINK,
        };
        let corners = match corners.is_empty() {
            true => vec![[0.0; 2]],
            false => corners,
        };
        let outline = Outline::Rounded(corners, radius * self.unit);
        let frame = match self.scene.bodies[body].is_dial {
            true => Frame::Riding(self.dial(body), body),
            false => Frame::Body(body),
        };
        if let Some(group) = self.body(body) {
            group.add(Layer::Below, frame, Look::Body, outline);
        }
    }

    /// Draws the points with a name, which pins may cover.
    fn dots(&mut self) {
        let radius = 2.0 * self.unit;
        let mut ground = Group::new("body-ground".to_string(), "ground".to_string());
        for point in &self.scene.points {
            let At { body, local } = self.pixels(point.at);
            let dot = Outline::Circle(local, radius);
            match self.body(body) {
                Some(group) => group.add(Layer::Below, Frame::Body(body), Look::Ink, dot),
                None => ground.add(Layer::Upon, Frame::Body(0), Look::Ink, dot),
            }
        }
        self.figure.extras.push(ground);
    }

    /// True if a wheel or a cam of the body, or a rack's bar, covers all its points.
    fn is_covered(&self, body: usize, corners: &[Point]) -> bool {
        let Some(group) = self.figure.bodies.get(body - 1) else {
            return false;
        };
        let elements = group.parts().flat_map(|part| &part.elements);
        let mut bodies = elements.filter(|it| matches!(it.look, Look::Body | Look::Disc));
        bodies.any(|it| match &it.outline {
            Outline::Circle(center, radius) => corners
                .iter()
                .all(|corner| distance(*corner, *center) < radius - 2.0),
            Outline::Closed(points) if points.len() > 4 => corners
                .iter()
                .all(|corner| super::plane::is_inside(*corner, points)),
            _ => false,
        })
    }

    fn has_face(&self, body: usize) -> bool {
        let mut signs = self.scene.signs.iter();
        signs.any(|sign| match sign.feature {
            Feature::Contact(crate::joint::Follower::Face) => sign.marks[0].body == body,
            Feature::Pinion(_) => sign
                .line
                .is_some_and(|line| sign.marks[line.owner].body == body),
            _ => false,
        })
    }

    /// Sign other than this one for which `wanted` holds.
    pub fn partner(&self, sign: &Sign, wanted: impl Fn(&Sign) -> bool) -> Option<&Sign> {
        let mut others = self.scene.signs.iter();
        others.find(|it| it.slug != sign.slug && wanted(it))
    }

    /// Line of a sign; `None` if it has none.
    pub fn line_of(sign: &Sign) -> Option<(Line, At, At)> {
        let line = sign.line?;
        Some((
            line,
            *sign.marks.get(line.owner)?,
            *sign.marks.get(line.other)?,
        ))
    }
}
