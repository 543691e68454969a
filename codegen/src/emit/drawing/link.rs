//! Signs between points without a body: massless links, fixed offsets and angles, written equations.

use super::draft::{BLOCK, Draft, PIN};
use super::figure::{Frame, Group, Layer, Look, Outline};
use super::plane::{Point, difference, distance, scaled};
use super::pose::{At, Sign};
use crate::joint::Feature;

/// Smallest length of a drawn link, in pixels: one that vanishes in a pose could not be stretched.
pub(super) const SHORTEST: f64 = 20.0;

impl Draft<'_> {
    /// Draws a link without a body of its own, or a cylinder if its length is driven.
    pub fn link(&mut self, sign: &Sign, is_driver: bool, group: &mut Group) {
        let [from, to] = [sign.marks[0], sign.marks[1]];
        for end in [from, to] {
            match end.body {
                0 => {
                    self.support(self.global(end), group);
                    let at = self.pixels(end).local;
                    let circle = Outline::Circle(at, PIN * self.unit);
                    group.add(Layer::Above, Frame::Body(0), Look::Part, circle);
                }
                _ => self.hole(end, group),
            }
        }
        let scale = self.figure.scale;
        let lengths: Vec<f64> = self
            .scene
            .motion
            .iter()
            .map(|places| {
                let [a, b] = [from, to].map(|it| places[it.body].globally(it.local));
                distance(a, b) * scale
            })
            .collect();
        let least = lengths.iter().copied().fold(f64::INFINITY, f64::min);
        let most = lengths.iter().copied().fold(0.0, f64::max);
        let [from, to] = [from, to].map(|it| self.pixels(it));
        if is_driver && least > 3.0 * BLOCK[0] * self.unit && most < 1.8 * least {
            self.free_cylinder(from, to, [least, most], group);
            self.arrow_along(from, to, sign.is_falling, group);
            return;
        }
        let length = lengths[0].max(SHORTEST);
        let line = Outline::line([0.0; 2], [length, 0.0]);
        let frame = Frame::Between(from, to, length);
        group.add(Layer::Upon, frame, Look::Massless, line);
        if is_driver {
            self.arrow_along(from, to, sign.is_falling, group);
        }
    }

    /// Draws the distance of one point beside, or above, another.
    pub fn offset(&mut self, sign: &Sign, axis: usize, is_driver: bool, group: &mut Group) {
        let [from, to] = [sign.marks[0], sign.marks[1]].map(|it| self.global(it));
        let mut corner = from;
        corner[axis] = to[axis];
        group.add(
            Layer::Upon,
            Frame::Still,
            Look::Thought,
            Outline::line(corner, to),
        );
        let length = distance(from, corner);
        if length < 1.0 {
            group.add(
                Layer::Upon,
                Frame::Still,
                Look::Thought,
                Outline::line(from, to),
            );
            return;
        }
        let along = scaled(difference(corner, from), 1.0 / length);
        let (look, head) = match is_driver {
            true => (Look::Drive, Look::DriveHead),
            false => (Look::Thought, Look::Ink),
        };
        let size = (7.0 * self.unit).min(0.4 * length);
        group.add(Layer::Upon, Frame::Still, look, Outline::line(from, corner));
        let tips: &[(Point, Point)] = &[(corner, along), (from, scaled(along, -1.0))];
        for &(tip, along) in tips {
            group.add(
                Layer::Upon,
                Frame::Still,
                head,
                Outline::head(tip, along, size),
            );
        }
    }

    /// The angle between two bodies, about the pin between them.
    pub fn angle(&mut self, sign: &Sign, is_driver: bool, group: &mut Group) {
        let [a, b] = [sign.marks[0].body, sign.marks[1].body];
        let center = self.pin_between(a, b).unwrap_or_else(|| {
            let local = self.corners[b].first().copied().unwrap_or_default();
            At { body: b, local }
        });
        let there = self.figure.stance.places[b].globally(center.local);
        let center = At {
            body: a,
            local: self.figure.stance.places[a].locally(there),
        };
        let turned = self.figure.stance.places[b].angle - self.figure.stance.places[a].angle;
        let from = self.facing(center);
        let to = self.facing(center) + turned;
        // The smaller angle.
        let span = (to - from + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU)
            - std::f64::consts::PI;
        let frame = Frame::Riding(center, a);
        let radius = 20.0 * self.unit;
        let look = if is_driver { Look::Drive } else { Look::Edge };
        self.curved(frame, radius, [from, from + span], look, group);
        if is_driver {
            let is_back = sign.is_falling != (span < 0.0);
            let (end, way) = match is_back {
                true => (from, -span.signum()),
                false => (from + span, span.signum()),
            };
            self.curved_head(frame, radius, end, way, group);
        }
    }

    /// Draws the points and bodies in an equation.
    pub fn written(&mut self, sign: &Sign, group: &mut Group) {
        let mut places: Vec<Point> = Vec::new();
        for mark in &sign.marks {
            if self.scene.bodies[mark.body].is_dial {
                continue;
            }
            let there = self.global(*mark);
            let local = self.pixels(*mark).local;
            // The origin of a frame alone is invisible.
            if self.corners[mark.body]
                .iter()
                .all(|it| distance(*it, local) > 0.5)
            {
                continue;
            }
            if places.iter().all(|it| distance(*it, there) > 1.0) {
                places.push(there);
                let at = self.pixels(*mark);
                let ring = Outline::Circle(at.local, 1.7 * PIN * self.unit);
                group.add(Layer::Upon, Frame::Body(at.body), Look::Thought, ring);
            }
        }
        if places.len() > 1 {
            group.add(
                Layer::Upon,
                Frame::Still,
                Look::Thought,
                Outline::Open(places),
            );
        }
        self.figure.notes.push(sign.label.clone());
    }

    /// Pin between two bodies in the frame of the second, in pixels.
    pub fn pin_between(&self, a: usize, b: usize) -> Option<At> {
        let mut signs = self.scene.signs.iter();
        signs.find_map(|sign| {
            if sign.feature != Feature::Pin {
                return None;
            }
            let [one, other] = [sign.marks[0], sign.marks[1]];
            let pair = [(one, other), (other, one)];
            let marks = pair.into_iter().find(|(i, j)| i.body == a && j.body == b)?;
            Some(self.pixels(marks.1))
        })
    }
}
