//! Draws paths of points, axes of frames and gaps on request.

use super::figure::{Figure, Frame, Group, Layer, Look, Outline};
use super::plane::{Point, onward, scaled};

/// The path of a point, in m.
#[derive(Clone, Debug, PartialEq)]
pub struct Traced {
    /// The name of the point.
    pub name: String,
    /// Positions at successive times.
    pub points: Vec<Point>,
    /// Positions at equal intervals of time.
    pub ticks: Vec<Point>,
}

/// Two points that should coincide and do not, in m.
#[derive(Clone, Debug, PartialEq)]
pub struct Gap {
    /// Positions of the two ends.
    pub ends: [Point; 2],
    /// Distance of the ends, as text.
    pub text: String,
    /// Joint that is open between them.
    pub title: String,
}

/// Length of the axes of a frame, in units.
pub(super) const AXIS: f64 = 58.0;

impl Figure {
    /// Adds the path of a point with its ticks.
    pub fn trace(&mut self, traced: &Traced) {
        let mut group = Group::new(
            format!("path-{}", traced.name),
            format!("path of point {}", traced.name),
        );
        let pixels = |point: &Point| scaled(*point, self.scale);
        let path = Outline::Open(traced.points.iter().map(pixels).collect());
        group.add(Layer::Below, Frame::Body(0), Look::Path, path);
        for tick in &traced.ticks {
            let dot = Outline::Circle(pixels(tick), 2.4);
            group.add(Layer::Below, Frame::Body(0), Look::Tick, dot);
        }
        self.extras.push(group);
    }

    /// Adds a line across a gap.
    pub fn gap(&mut self, gap: &Gap) {
        let mut group = Group::new("gap".to_string(), gap.title.clone());
        let ends = gap.ends.map(|it| scaled(it, self.scale));
        let line = Outline::Open(ends.to_vec());
        group.add(Layer::Above, Frame::Body(0), Look::Gap, line);
        for end in ends {
            let ring = Outline::Circle(end, 7.0);
            group.add(Layer::Above, Frame::Body(0), Look::Gap, ring);
        }
        self.extras.push(group);
    }

    /// Adds the axes of a body's frame.
    pub fn axes(&mut self, body: usize, name: &str, unit: f64) {
        let mut group = Group::new(format!("frame-{name}"), format!("frame of body {name}"));
        let frame = Frame::Body(body);
        for along in [[1.0, 0.0], [0.0, 1.0]] {
            let tip = scaled(along, AXIS * unit);
            let shaft = Outline::line([0.0; 2], onward(tip, -5.0 * unit, along));
            group.add(Layer::Above, frame, Look::Axis, shaft);
            let head = Outline::head(tip, along, 8.0 * unit);
            group.add(Layer::Above, frame, Look::AxisHead, head);
        }
        self.extras.push(group);
    }
}
