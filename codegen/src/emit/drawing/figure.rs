//! Parts of a picture: groups of outlines, each in a frame that moves as a whole.
//!
//! Lengths are pixels and y points upwards; a frame of a body is its frame with lengths in pixels. A motion changes
//! only the frames.

use super::dimension::Dimension;
use super::plane::{Bounds, Point, difference, distance, heading, onward, sum};
use super::pose::At;
use super::stance::Stance;

/// Frame of outlines that move together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Frame {
    /// The body of this number; 0 is the ground.
    Body(usize),
    /// At a point, turned as this body.
    Riding(At, usize),
    /// At a point, turned as one body at the inner radius and as another at the outer one.
    Wound(At, Winding),
    /// From one point towards another, in pixels of their bodies: the first is the origin, and the second lies on the x axis.
    Toward(At, At),
    /// Place between two points, stretched along x so that the second point is always this far from the first.
    Between(At, At, f64),
    /// At a point, along the force of the load of this number, and with the length of its arrow.
    Force(At, usize),
    /// At a point and at an angle to its body, mirrored at x where the torque of the load of this number is clockwise.
    Torque(At, f64, usize),
    /// Drawn for this pose only.
    Still,
}

/// Spiral between two bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Winding {
    /// Bodies that its inner and its outer end turn with.
    pub bodies: [usize; 2],
    /// Angle of the second body to the first one in the design configuration, in rad.
    pub drawn: f64,
    /// Distance of its inner and its outer end from the point.
    pub radii: [f64; 2],
}

/// Kind of an outline, which decides its style.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Look {
    /// The shape of a body, filled with its tint.
    Body,
    /// Shape of a body without an edge of its own.
    Disc,
    /// A hole through it or a part set upon it.
    Part,
    /// An edge without a filling.
    Edge,
    /// A thick edge, where bodies touch.
    Face,
    /// Pitch line, or another imaginary line.
    Thought,
    /// Mark of a center.
    Mark,
    /// A link without a body.
    Massless,
    /// Hatching of the ground.
    Hatch,
    /// Sign of a driver.
    Drive,
    /// The head of its arrow.
    DriveHead,
    /// Axes of a frame.
    Axis,
    /// The head of an axis.
    AxisHead,
    /// The path of a point.
    Path,
    /// A tick on it.
    Tick,
    /// Area filled with ink.
    Ink,
    /// A spring or a damper.
    Element,
    /// The arrow of a force or a torque.
    Load,
    /// The head of it.
    LoadHead,
    /// Line across a loop that does not close.
    Gap,
}

/// Outline in a frame.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Outline {
    /// From point to point.
    Open(Vec<Point>),
    /// Back to the first.
    Closed(Vec<Point>),
    /// All within this distance of the convex polygon with these corners, counterclockwise.
    Rounded(Vec<Point>, f64),
    /// About a point.
    Circle(Point, f64),
    /// Between two circles about a point.
    Ring(Point, f64, f64),
    /// Part of a circle about a point, from one angle to another, in rad.
    Arc(Point, f64, [f64; 2]),
}

/// Outlines of one look.
#[derive(Clone, Debug)]
pub(super) struct Element {
    pub look: Look,
    pub outline: Outline,
}

/// Elements of one frame.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub frame: Frame,
    pub elements: Vec<Element>,
}

/// Outlines of a body, a joint or a path.
#[derive(Clone, Debug, Default)]
pub(super) struct Group {
    /// Id in the file.
    pub id: String,
    /// Tooltip.
    pub title: String,
    pub layers: [Vec<Part>; 3],
}

/// Layer of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Layer {
    /// Under the bodies.
    Below,
    /// Upon them.
    Upon,
    /// Upon everything else.
    Above,
}

impl Group {
    pub fn new(id: String, title: String) -> Group {
        Group {
            id,
            title,
            ..Group::default()
        }
    }

    /// Adds an outline.
    pub fn add(&mut self, layer: Layer, frame: Frame, look: Look, outline: Outline) {
        let parts = &mut self.layers[layer as usize];
        let element = Element { look, outline };
        match parts.last_mut() {
            Some(last) if last.frame == frame => last.elements.push(element),
            _ => parts.push(Part {
                frame,
                elements: vec![element],
            }),
        }
    }

    /// All parts, the lowest first.
    pub fn parts(&self) -> impl Iterator<Item = &Part> {
        self.layers.iter().flatten()
    }
}

/// Picture of a mechanism.
#[derive(Clone, Debug)]
pub(super) struct Figure {
    /// Pixels per metre.
    pub scale: f64,
    /// Positions of all bodies and points.
    pub stance: Stance,
    /// One for each moving body, in their order.
    pub bodies: Vec<Group>,
    /// One for each joint and driver.
    pub joints: Vec<Group>,
    /// Loads, paths, axes and gaps.
    pub extras: Vec<Group>,
    /// Loads without a sign, in words.
    pub notes: Vec<String>,
    /// Circles whose diameters are lengths of the mechanism.
    pub diameters: Vec<Diameter>,
    /// Dimensions in this pose, on request.
    pub dimensions: Vec<Dimension>,
}

/// Circle of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Diameter {
    /// Center, in pixels of its body.
    pub at: At,
    pub radius: f64,
}

impl Figure {
    pub fn groups(&self) -> impl Iterator<Item = &Group> {
        self.bodies.iter().chain(&self.joints).chain(&self.extras)
    }

    /// Every outline in global components, as a polygon.
    pub fn traces(&self, group: &Group) -> Vec<Trace> {
        group
            .parts()
            .flat_map(|part| {
                let place = self.stance.place(part.frame);
                part.elements.iter().map(move |element| Trace {
                    look: element.look,
                    is_closed: !matches!(element.outline, Outline::Open(_) | Outline::Arc(..)),
                    points: element
                        .outline
                        .points()
                        .into_iter()
                        .map(|point| place.globally(self.stance.deformed(part.frame, point)))
                        .collect(),
                })
            })
            .collect()
    }

    /// Returns the figure in another pose.
    pub fn moved(&self, stance: Stance) -> Figure {
        Figure {
            stance,
            ..self.clone()
        }
    }

    /// Adds a circle whose diameter is a length of the mechanism. Several signs may share it.
    pub fn add_diameter(&mut self, at: At, radius: f64) {
        let is_near = |it: &Diameter| {
            let apart = distance(it.at.local, at.local);
            it.at.body == at.body && apart < 0.5 && (it.radius - radius).abs() < 0.5
        };
        if !self.diameters.iter().any(is_near) {
            self.diameters.push(Diameter { at, radius });
        }
    }

    /// Around all outlines and dimensions.
    pub fn bounds(&self) -> Bounds {
        let traces = self.groups().flat_map(|group| self.traces(group));
        let mut bounds = Bounds::of(traces.flat_map(|trace| trace.points));
        for Bounds { low, high } in self.dimensions.iter().map(Dimension::bounds) {
            bounds.include(low);
            bounds.include(high);
        }
        bounds
    }
}

/// Outline in its position.
#[derive(Clone, Debug)]
pub(super) struct Trace {
    pub look: Look,
    pub points: Vec<Point>,
    pub is_closed: bool,
}

impl Trace {
    /// A line.
    pub fn edge(ends: [Point; 2]) -> Trace {
        Trace {
            look: Look::Edge,
            points: ends.to_vec(),
            is_closed: false,
        }
    }

    /// Its edges.
    pub fn segments(&self) -> impl Iterator<Item = [Point; 2]> + '_ {
        let count = self.points.len();
        let edges = match self.is_closed {
            true => count,
            false => count.saturating_sub(1),
        };
        (0..edges).map(move |at| [self.points[at], self.points[(at + 1) % count]])
    }
}

/// Number of corners that stand for a circle.
const CORNERS: usize = 24;

impl Outline {
    /// From one point to another.
    pub fn line(from: Point, to: Point) -> Outline {
        Outline::Open(vec![from, to])
    }

    /// A rectangle about a point, half its length along a unit vector and half its width across.
    pub fn block(center: Point, along: Point, half: Point) -> Outline {
        let across = super::plane::left_of(along);
        let corner =
            |x: f64, y: f64| onward(onward(center, x * half[0], along), y * half[1], across);
        Outline::Closed(vec![
            corner(-1.0, -1.0),
            corner(1.0, -1.0),
            corner(1.0, 1.0),
            corner(-1.0, 1.0),
        ])
    }

    /// The head of an arrow that ends at a point.
    pub fn head(tip: Point, along: Point, length: f64) -> Outline {
        let back = onward(tip, -length, along);
        let across = super::plane::left_of(along);
        Outline::Closed(vec![
            tip,
            onward(back, 0.36 * length, across),
            onward(back, -0.36 * length, across),
        ])
    }

    /// Points along it.
    pub fn points(&self) -> Vec<Point> {
        let circle = |center: Point, radius: f64| {
            let angles = (0..CORNERS).map(|at| std::f64::consts::TAU * at as f64 / CORNERS as f64);
            angles.map(move |angle| onward(center, radius, heading(angle)))
        };
        match self {
            Outline::Open(points) | Outline::Closed(points) => points.clone(),
            Outline::Circle(center, radius) | Outline::Ring(center, _, radius) => {
                circle(*center, *radius).collect()
            }
            Outline::Arc(center, radius, [from, to]) => {
                let steps = ((to - from).abs() / 0.15).ceil().max(1.0);
                let angle = |step: f64| from + (to - from) * step / steps;
                let at = |step: usize| onward(*center, *radius, heading(angle(step as f64)));
                (0..=steps as usize).map(at).collect()
            }
            Outline::Rounded(corners, radius) => {
                let around: Vec<Point> = corners
                    .iter()
                    .flat_map(|&corner| circle(corner, *radius))
                    .collect();
                super::plane::hull(&around)
            }
        }
    }
}

/// Ends of the edges of a rounded polygon.
pub(super) fn offset_edges(corners: &[Point], radius: f64) -> Vec<[Point; 2]> {
    let next = corners.iter().cycle().skip(1);
    corners
        .iter()
        .zip(next)
        .map(|(&a, &b)| {
            let length = distance(a, b);
            let along = difference(b, a);
            // Counterclockwise, the outside lies to the right.
            let out = [along[1] * radius / length, -along[0] * radius / length];
            [sum(a, out), sum(b, out)]
        })
        .collect()
}
