//! Arrows of drivers: the current sense of driven quantities.

use super::draft::{BLOCK, Draft};
use super::figure::{Frame, Group, Layer, Look, Outline};
use super::plane::{RELATIVE_ROUNDING, distance, heading, left_of, onward, scaled};
use super::pose::{At, Sign};
use crate::joint::Feature;

/// The length of an arrow's head, in units.
const HEAD: f64 = 8.0;

impl Draft<'_> {
    /// Draws the driven angle of a body: an arc about its pin.
    pub fn turning(&mut self, sign: &Sign, group: &mut Group) {
        let body = sign.marks[0].body;
        let center = self.pivot(body);
        let start = self.facing(center) + self.figure.stance.places[body].angle;
        let way = if sign.is_falling { -1.0 } else { 1.0 };
        let radius = self.clear_radius(center);
        let ends = match self.corners[body].len() {
            // The body has no direction: above, away from a support.
            0 | 1 => [-0.7, 0.7].map(|it| std::f64::consts::FRAC_PI_2 + way * it),
            _ => [start + way * 0.35, start + way * 1.75],
        };
        let at = match self.scene.bodies[body].is_dial {
            true => self.dial(body),
            false => center,
        };
        let frame = Frame::Riding(at, 0);
        self.curved(frame, radius, ends, Look::Drive, group);
        self.curved_head(frame, radius, ends[1], way, group);
    }

    /// The radius of an arc about a pin, beside a wheel's edge or within it.
    fn clear_radius(&self, center: At) -> f64 {
        let wheels = self.figure.bodies.iter().flat_map(|it| it.parts());
        let rims = wheels.filter(|it| it.frame == Frame::Body(center.body));
        let radii = rims
            .flat_map(|it| &it.elements)
            .filter_map(|it| match it.outline {
                Outline::Circle(about, radius) if distance(about, center.local) < 1.0 => {
                    Some(radius)
                }
                _ => None,
            });
        let largest = radii.fold(0.0, f64::max);
        let usual = 24.0 * self.unit;
        match largest {
            wheel if wheel > 0.0 && (wheel - usual).abs() < 8.0 => wheel + 9.0 * self.unit,
            _ => usual,
        }
    }

    /// An arc in a frame about its origin.
    pub fn curved(&self, frame: Frame, radius: f64, ends: [f64; 2], look: Look, group: &mut Group) {
        let arc = Outline::Arc([0.0; 2], radius, ends);
        group.add(Layer::Above, frame, look, arc);
    }

    /// The head at the end of an arc.
    pub fn curved_head(&self, frame: Frame, radius: f64, end: f64, way: f64, group: &mut Group) {
        let size = HEAD * self.unit;
        // The head begins on the arc and its tip stays near it.
        let tip = scaled(heading(end + way * 0.8 * size / radius), radius);
        let along = scaled(left_of(heading(end + way * 0.4 * size / radius)), way);
        group.add(
            Layer::Above,
            frame,
            Look::DriveHead,
            Outline::head(tip, along, size),
        );
    }

    /// The pin about which a body turns, in pixels: on the ground rather than elsewhere.
    pub fn pivot(&self, body: usize) -> At {
        let marks = self.scene.signs.iter().filter_map(|sign| {
            let is_kept = matches!(sign.feature, Feature::Coordinate(_)) && !sign.is_driver;
            let mark = *sign.marks.iter().find(|it| it.body == body)?;
            let is_grounded = sign.marks.iter().any(|it| it.body == 0);
            match sign.feature {
                Feature::Pin => Some((if is_grounded { 0 } else { 2 }, mark)),
                _ if is_kept => Some((1, mark)),
                _ => None,
            }
        });
        let best = marks.min_by_key(|(rank, _)| *rank);
        let origin = At {
            body,
            local: [0.0; 2],
        };
        self.pixels(best.map_or(origin, |(_, at)| at))
    }

    /// Draws the driven x or y of a point: an arrow from it.
    pub fn moved_coordinate(&mut self, sign: &Sign, axis: usize, group: &mut Group) {
        let at = self.pixels(sign.marks[0]);
        let mut along = [0.0; 2];
        along[axis] = if sign.is_falling { -1.0 } else { 1.0 };
        let is_block = self.keeps_angle(at.body) && self.is_guided(at.body);
        let start = if is_block { BLOCK[0] + 5.0 } else { 8.0 } * self.unit;
        let frame = Frame::Riding(at, 0);
        self.straight(
            frame,
            [
                scaled(along, start),
                scaled(along, start + 32.0 * self.unit),
            ],
            group,
        );
    }

    /// Draws the driven length along a line: an arrow beside the sliding body.
    pub fn stroke(&mut self, sign: &Sign, group: &mut Group) {
        let Some((line, owner, other)) = Self::line_of(sign) else {
            return;
        };
        let [from, to] = [owner, other].map(|it| self.pixels(it));
        if self.is_cylinder(sign) {
            self.arrow_along(from, to, sign.is_falling, group);
            return;
        }
        let way = if sign.is_falling { -1.0 } else { 1.0 };
        let along = scaled(line.along, way);
        // Hatching lies below rather than above.
        let left = left_of(line.along);
        let is_up = self.figure.stance.places[owner.body].rotate(left)[1] > -RELATIVE_ROUNDING;
        let out = scaled(left, if is_up { 1.0 } else { -1.0 });
        let middle = scaled(out, (BLOCK[1] + 9.0) * self.unit);
        let half = 17.0 * self.unit;
        let ends = [onward(middle, -half, along), onward(middle, half, along)];
        self.straight(Frame::Riding(to, owner.body), ends, group);
    }

    /// An arrow beside the line from one point to another.
    pub fn arrow_along(&mut self, from: At, to: At, is_falling: bool, group: &mut Group) {
        let frame = Frame::Toward(from, to);
        let [a, b] = [from, to].map(|it| self.figure.stance.places[it.body].globally(it.local));
        let length = distance(a, b);
        let (middle, half, aside) = (0.72 * length, 0.5 * 30.0 * self.unit, 16.0 * self.unit);
        let way = if is_falling { -1.0 } else { 1.0 };
        let ends = [-way, way].map(|it| [middle + it * half, aside]);
        self.straight(frame, ends, group);
    }

    fn straight(&self, frame: Frame, [from, to]: [[f64; 2]; 2], group: &mut Group) {
        let length = distance(from, to);
        let along = scaled(super::plane::difference(to, from), 1.0 / length);
        let size = HEAD * self.unit;
        let shaft = Outline::line(from, onward(to, -0.7 * size, along));
        group.add(Layer::Above, frame, Look::Drive, shaft);
        group.add(
            Layer::Above,
            frame,
            Look::DriveHead,
            Outline::head(to, along, size),
        );
    }
}
