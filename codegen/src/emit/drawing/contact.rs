//! Cams and other curves with what touches them.

use super::draft::{Draft, PIN};
use super::figure::{Frame, Group, Layer, Look, Outline};
use super::plane::{Point, difference, distance, dot, left_of, onward, scaled};
use super::pose::{Drawn, Sign};
use crate::joint::Follower;

impl Draft<'_> {
    /// A curve and the point, the roller or the face that touches it.
    pub fn contact(&mut self, sign: &Sign, follower: Follower, group: &mut Group) {
        if let Some(curve) = &sign.curve {
            self.curve(curve, group);
        }
        let at = self.pixels(sign.marks[0]);
        let frame = Frame::Body(at.body);
        match follower {
            Follower::Point => {
                let tip = Outline::Circle(at.local, 0.8 * PIN * self.unit);
                group.add(Layer::Above, frame, Look::Ink, tip);
                self.is_shaped[at.body] |= self.corners[at.body].len() == 1;
            }
            Follower::Roller(_) => {
                let radius = sign.number * self.figure.scale;
                self.figure.add_diameter(at, radius);
                let roller = Outline::Circle(at.local, radius);
                group.add(Layer::Upon, frame, Look::Part, roller);
                let axle = Outline::Circle(at.local, 0.8 * PIN * self.unit);
                group.add(Layer::Above, frame, Look::Part, axle);
                self.is_shaped[at.body] |= self.corners[at.body].len() == 1;
            }
            Follower::Face => self.face(sign, group),
        }
    }

    /// The face of a follower: from end to end of its points on that line, and over what it touches.
    fn face(&mut self, sign: &Sign, group: &mut Group) {
        let Some(line) = sign.line else { return };
        let at = self.pixels(sign.marks[0]);
        let across = left_of(line.along);
        let mut ends = [0.0_f64; 2];
        for corner in &self.corners[at.body] {
            let gap = difference(*corner, at.local);
            if dot(gap, across).abs() < 0.5 {
                let reach = dot(gap, line.along);
                ends = [ends[0].min(reach), ends[1].max(reach)];
            }
        }
        let overhang = 4.0 * self.unit;
        let ends = [ends[0] - overhang, ends[1] + overhang];
        let ends = ends.map(|it| onward(at.local, it, line.along));
        self.is_shaped[at.body] = true;
        let face = Outline::Open(ends.to_vec());
        group.add(Layer::Upon, Frame::Body(at.body), Look::Face, face);
    }

    /// A curve in the shape of its body; one on the ground has hatching behind it.
    fn curve(&mut self, curve: &Drawn, group: &mut Group) {
        let points: Vec<Point> = curve
            .points
            .iter()
            .map(|&it| scaled(it, self.figure.scale))
            .collect();
        let is_same = |outline: &Outline| match outline {
            Outline::Open(other) | Outline::Closed(other) => *other == points,
            _ => false,
        };
        let outline = match curve.is_closed {
            true => Outline::Closed(points.clone()),
            false => Outline::Open(points.clone()),
        };
        if curve.body != 0 {
            let look = if curve.is_closed {
                Look::Body
            } else {
                Look::Face
            };
            let group = &self.figure.bodies[curve.body - 1];
            let elements = group.parts().flat_map(|it| &it.elements);
            // Several joints may touch one curve.
            let is_drawn = elements.into_iter().any(|it| is_same(&it.outline));
            if !is_drawn {
                self.add_to_body(curve.body, look, outline);
            }
            return;
        }
        group.add(Layer::Below, Frame::Body(0), Look::Edge, outline);
        let turn: f64 = {
            let next = points.iter().cycle().skip(1);
            points
                .iter()
                .zip(next)
                .map(|(a, b)| dot(left_of(*a), *b))
                .sum()
        };
        let outward = if turn < 0.0 { 1.0 } else { -1.0 };
        let (gap, depth) = (9.0 * self.unit, 6.0 * self.unit);
        let mut since = gap;
        for pair in points.windows(2) {
            let step = distance(pair[0], pair[1]);
            since += step;
            if since >= gap && step > 0.0 {
                since = 0.0;
                let along = scaled(difference(pair[1], pair[0]), 1.0 / step);
                let out = onward(scaled(left_of(along), outward), -0.7, along);
                let stroke = Outline::line(pair[0], onward(pair[0], depth, out));
                group.add(Layer::Below, Frame::Body(0), Look::Hatch, stroke);
            }
        }
    }
}
