//! Pins, supports on the ground and welds.

use super::draft::{Draft, LINK, PIN};
use super::figure::{Frame, Group, Layer, Look, Outline};
use super::plane::{Bounds, Point, difference, distance, left_of, onward, scaled, sum};
use super::pose::{At, Sign};
use crate::joint::Feature;

/// The height of a support and half the length of its base, in units.
const SUPPORT: Point = [17.0, 13.0];

impl Draft<'_> {
    /// Two bodies on one pin.
    pub fn pin(&mut self, sign: &Sign, group: &mut Group) {
        let [a, b] = [sign.marks[0], sign.marks[1]];
        let moving = if a.body == 0 { b } else { a };
        for mark in [a, b] {
            if mark.body == 0 {
                self.support(self.global(mark), group);
            }
        }
        self.hole(moving, group);
    }

    /// The circle of a pin in a body.
    pub fn hole(&self, at: At, group: &mut Group) {
        let at = self.pixels(at);
        let circle = Outline::Circle(at.local, PIN * self.unit);
        group.add(Layer::Above, Frame::Body(at.body), Look::Part, circle);
    }

    /// Draws the support of a pin on the ground, on a side with room for it; one for each position.
    pub fn support(&mut self, at: Point, group: &mut Group) {
        if self.supports.iter().any(|it| distance(*it, at) < 1.0) {
            return;
        }
        self.supports.push(at);
        let [height, half] = scaled(SUPPORT, self.unit);
        let directions = [[0.0, -1.0], [0.0, 1.0], [-1.0, 0.0], [1.0, 0.0]];
        let crowded = |(place, down): (usize, Point)| {
            let center = onward(at, 0.75 * height + PIN * self.unit, down);
            let area = Bounds::around(center, [half, half]);
            let dislike = [0.0, 14.0, 10.0, 10.0][place];
            dislike + self.inked(&area)
        };
        let costs: Vec<f64> = directions.into_iter().enumerate().map(crowded).collect();
        let best = (0..4)
            .min_by(|a, b| costs[*a].total_cmp(&costs[*b]))
            .unwrap_or(0);
        let down = directions[best];
        let base = onward(at, height, down);
        let across = left_of(down);
        let foot = |side: f64| onward(base, side * 0.72 * half, across);
        let triangle = Outline::Closed(vec![at, foot(-1.0), foot(1.0)]);
        group.add(Layer::Below, Frame::Body(0), Look::Part, triangle);
        let ends = [onward(base, -half, across), onward(base, half, across)];
        self.ground(ends, down, group);
    }

    /// A line of the ground with hatching behind it.
    pub fn ground(&self, [from, to]: [Point; 2], behind: Point, group: &mut Group) {
        let frame = Frame::Body(0);
        group.add(Layer::Below, frame, Look::Edge, Outline::line(from, to));
        let length = distance(from, to);
        let along = scaled(difference(to, from), 1.0 / length);
        let (depth, gap) = (6.5 * self.unit, 6.0 * self.unit);
        let strokes = ((length - depth) / gap).floor().max(1.0);
        let step = (length - depth) / strokes;
        for stroke in 0..=strokes as usize {
            let start = onward(from, depth + step * stroke as f64, along);
            let end = sum(start, scaled(difference(behind, along), depth));
            group.add(Layer::Below, frame, Look::Hatch, Outline::line(start, end));
        }
    }

    /// Length of the bodies' lines inside an area.
    pub fn inked(&self, area: &Bounds) -> f64 {
        let area = area.widened(0.5 * LINK * self.unit);
        let lines = self.lines.iter();
        lines.map(|[a, b]| area.length_inside(*a, *b)).sum()
    }

    /// Draws the mark of a weld between two bodies.
    pub fn weld(&mut self, sign: &Sign, group: &mut Group) {
        let at = self.pixels(sign.marks[1]);
        let square = Outline::block(at.local, [1.0, 0.0], [5.0 * self.unit; 2]);
        group.add(Layer::Above, Frame::Body(at.body), Look::Ink, square);
    }

    /// Draws a point with a fixed x or y: with the other on the ground, with the angle a block on a guide, and alone
    /// a roller.
    pub fn kept_coordinate(&mut self, sign: &Sign, axis: usize, group: &mut Group) {
        let mark = sign.marks[0];
        let is_kept = |it: &Sign, axis: usize| {
            it.feature == Feature::Coordinate(axis) && !it.is_driver && it.marks[0] == mark
        };
        if self.partner(sign, |it| is_kept(it, 1 - axis)).is_some() {
            self.support(self.global(mark), group);
            self.hole(mark, group);
            return;
        }
        let along = if axis == 0 { [0.0, 1.0] } else { [1.0, 0.0] };
        let now = self.scene.global(mark);
        let reached = self.scene.motion.iter().map(|places| {
            let there = places[mark.body].globally(mark.local);
            (there[1 - axis] - now[1 - axis]) * self.figure.scale
        });
        let (least, most) = reached.fold((0.0_f64, 0.0_f64), |(least, most), it| {
            (least.min(it), most.max(it))
        });
        if self.keeps_angle(mark.body) {
            self.guided(mark, along, [least, most], group);
        } else {
            self.roller_on_guide(mark, along, [least, most], group);
        }
    }

    /// True if a constraint fixes the angle of a body.
    pub fn keeps_angle(&self, body: usize) -> bool {
        let mut signs = self.scene.signs.iter();
        signs.any(|it| {
            it.feature == Feature::Orientation && !it.is_driver && it.marks[0].body == body
        })
    }

    /// True if a point of the body is fixed on a line along an axis, but not on both.
    pub fn is_guided(&self, body: usize) -> bool {
        let kept = self.scene.signs.iter().filter(|it| {
            matches!(it.feature, Feature::Coordinate(_))
                && !it.is_driver
                && it.marks[0].body == body
        });
        kept.count() == 1
    }

    /// The angle of a body that is kept, where the block on its guide does not show it already: two guides across one another.
    pub fn kept_orientation(&mut self, sign: &Sign, group: &mut Group) {
        let body = sign.marks[0].body;
        let held = self.partner(sign, |it| {
            matches!(it.feature, Feature::Coordinate(_))
                && !it.is_driver
                && it.marks[0].body == body
        });
        let at = match held {
            Some(held) => self.pixels(held.marks[0]),
            None => At {
                body,
                local: self.corners[body].first().copied().unwrap_or_default(),
            },
        };
        let frame = Frame::Riding(at, 0);
        let size = match self.is_guided(body) {
            true => 2.4 * self.unit,
            false => 6.5 * self.unit,
        };
        if !self.is_guided(body) {
            let square = Outline::block([0.0; 2], [1.0, 0.0], [size; 2]);
            group.add(Layer::Upon, frame, Look::Part, square);
        }
        for along in [[1.0, 0.0], [0.0, 1.0]] {
            let ends = [
                onward([0.0; 2], -size, along),
                onward([0.0; 2], size, along),
            ];
            let line = Outline::Open(ends.to_vec());
            group.add(Layer::Upon, frame, Look::Edge, line);
        }
    }
}
