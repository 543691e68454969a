//! Sliding bodies: blocks on guides, stems in bushings, pins in slots, rollers on the ground.

use super::draft::{BLOCK, Draft, LINK, PIN};
use super::figure::{Frame, Group, Layer, Look, Outline};
use super::plane::{Bounds, Point, RELATIVE_ROUNDING, difference, dot, left_of, onward, scaled};
use super::pose::{At, Line, Sign};
use crate::joint::Feature;

impl Draft<'_> {
    /// A body that slides along a line of another and does not turn against it.
    pub fn slide(&mut self, sign: &Sign, group: &mut Group) {
        let Some((line, owner, other)) = Self::line_of(sign) else {
            return;
        };
        if self.is_cylinder(sign) {
            self.cylinder(sign, line, group);
            return;
        }
        let along = self.scene.along(sign, line);
        let travel = self.scene.travel(sign, line);
        let scale = self.figure.scale;
        if owner.body == 0 {
            let range = [travel.least - travel.now, travel.most - travel.now];
            self.guided(other, along, range.map(|it| it * scale), group);
            return;
        }
        let range = [travel.least * scale, travel.most * scale];
        self.bar(
            owner,
            line,
            [
                range[0] - 1.9 * BLOCK[0] * self.unit,
                range[1] + 1.9 * BLOCK[0] * self.unit,
            ],
        );
        let frame = Frame::Riding(self.pixels(other), owner.body);
        let half = scaled(BLOCK, self.unit);
        let block = Outline::block([0.0; 2], line.along, half);
        let look = if other.body == 0 {
            Look::Part
        } else {
            Look::Body
        };
        self.is_shaped[other.body] = true;
        group.add(Layer::Upon, frame, look, block);
        if other.body == 0 {
            let along = self.scene.along(sign, line);
            let [base, behind] = self.base(self.global(other), along, [0.0; 2]);
            let ends = [onward(base, -half[0], along), onward(base, half[0], along)];
            self.ground(ends, behind, group);
        }
        // The sliding body encloses the bar.
        let slit = [
            onward([0.0; 2], -half[0], line.along),
            onward([0.0; 2], half[0], line.along),
        ];
        group.add(
            Layer::Upon,
            frame,
            Look::Thought,
            Outline::Open(slit.to_vec()),
        );
    }

    /// Draws the bar of a body along a line through one of its marks, unless a link of the body is that bar.
    fn bar(&mut self, owner: At, line: Line, [least, most]: [f64; 2]) {
        let mark = self.pixels(owner).local;
        let across = left_of(line.along);
        let on_line = self.corners[owner.body].iter().filter_map(|corner| {
            let gap = difference(*corner, mark);
            (dot(gap, across).abs() < 0.5).then(|| dot(gap, line.along))
        });
        let (low, high) = on_line.fold((0.0_f64, 0.0_f64), |(low, high), it| {
            (low.min(it), high.max(it))
        });
        let slack = 2.0 * BLOCK[0] * self.unit;
        if high - low > 1.0 && low < least + slack && high > most - slack {
            return;
        }
        let ends = [low.min(least), high.max(most)].map(|it| onward(mark, it, line.along));
        let outline = Outline::Rounded(ends.to_vec(), 2.6 * self.unit);
        if owner.body == 0 {
            return;
        }
        self.add_to_body(owner.body, Look::Body, outline);
    }

    /// A pin that slides along a line of another body and turns in it; beside the line it has an arm.
    pub fn slot(&mut self, sign: &Sign, group: &mut Group) {
        let Some((line, owner, other)) = Self::line_of(sign) else {
            return;
        };
        let scale = self.figure.scale;
        let travel = self.scene.travel(sign, line);
        let reach = 1.6 * BLOCK[0] * self.unit;
        let along = self.scene.along(sign, line);
        let across = left_of(along);
        let foot = onward(self.global(other), -travel.aside * scale, across);
        if owner.body == 0 {
            let [base, behind] = self.base(foot, along, [0.0; 2]);
            let ends = [travel.least, travel.most].map(|it| (it - travel.now) * scale);
            let ends = [ends[0] - reach, ends[1] + reach].map(|it| onward(base, it, along));
            self.ground(ends, behind, group);
        } else {
            self.bar(
                owner,
                line,
                [travel.least * scale - reach, travel.most * scale + reach],
            );
        }
        let frame = Frame::Riding(self.pixels(other), owner.body);
        let aside = onward([0.0; 2], -sign.number * scale, left_of(line.along));
        let block = Outline::block(aside, line.along, scaled(BLOCK, 0.8 * self.unit));
        group.add(Layer::Upon, frame, Look::Part, block);
        if sign.number.abs() * scale > 1.0 {
            let arm = Outline::line(aside, [0.0; 2]);
            group.add(Layer::Upon, frame, Look::Massless, arm);
        }
        self.hole(other, group);
    }

    /// Draws a body whose point stays on a line of the ground, and which does not turn: a block on a guide, or a stem
    /// in a bushing if its own shape or its contact is in the way. The range is its travel from here.
    pub fn guided(&mut self, at: At, along: Point, range: [f64; 2], group: &mut Group) {
        let center = self.global(at);
        let place = self.figure.stance.places[at.body];
        let (mut extent, mut aside) = ([0.0_f64; 2], 0.0_f64);
        for corner in &self.corners[at.body] {
            let gap = difference(place.globally(*corner), center);
            let reach = dot(gap, along);
            extent = [extent[0].min(reach), extent[1].max(reach)];
            aside = aside.max(dot(gap, left_of(along)).abs());
        }
        let touched = self.touched_from(at.body);
        if touched.is_none() && aside < 1.2 * BLOCK[1] * self.unit {
            self.block_on_ground(at, along, range, group);
            return;
        }
        let is_backward = touched.is_some_and(|from| dot(difference(center, from), along) < 0.0);
        let (along, extent, range) = match is_backward {
            true => (
                scaled(along, -1.0),
                [-extent[1], -extent[0]],
                [-range[1], -range[0]],
            ),
            false => (along, extent, range),
        };
        let [length, width] = scaled(BLOCK, self.unit);
        let roller = self.roller_of(at.body) * self.figure.scale;
        let clear = extent[1] + LINK.max(1.0) * self.unit + roller;
        let middle = clear + range[1] + 1.7 * length;
        let end = middle - range[0] + 1.7 * length;
        let local = |distance: f64| place.locally(onward(center, distance, along));
        let stem = Outline::Rounded(vec![local(0.0), local(end)], 2.6 * self.unit);
        self.add_to_body(at.body, Look::Body, stem);
        for side in [1.0, -1.0] {
            let out = scaled(left_of(along), side);
            let near = onward(onward(center, middle, along), 3.4 * self.unit, out);
            let cheek = Outline::block(
                onward(near, 0.25 * width, out),
                along,
                [length, 0.25 * width],
            );
            group.add(Layer::Below, Frame::Body(0), Look::Part, cheek);
            let wall = onward(near, 0.5 * width, out);
            let ends = [onward(wall, -length, along), onward(wall, length, along)];
            self.ground(ends, out, group);
        }
    }

    /// A block at a point, on a guide of the ground.
    fn block_on_ground(&mut self, at: At, along: Point, range: [f64; 2], group: &mut Group) {
        let center = self.global(at);
        let place = self.figure.stance.places[at.body];
        let half = scaled(BLOCK, self.unit);
        let block = Outline::block(self.pixels(at).local, place.unrotate(along), half);
        self.add_to_body(at.body, Look::Body, block);
        let [base, behind] = self.base(center, along, range);
        let overhang = half[0] + 14.0 * self.unit;
        let ends = [range[0] - overhang, range[1] + overhang].map(|it| onward(base, it, along));
        self.ground(ends, behind, group);
    }

    /// A point on the surface of a guide under a block, and the direction behind the surface: the lower side where that is free.
    fn base(&self, center: Point, along: Point, range: [f64; 2]) -> [Point; 2] {
        let width = BLOCK[1] * self.unit;
        let cost = |out: Point| {
            let middle = onward(center, 0.5 * (range[0] + range[1]), along);
            let middle = onward(middle, width + 5.0 * self.unit, out);
            let half = [0, 1].map(|axis| {
                let length = 0.5 * (range[1] - range[0]) + 2.0 * BLOCK[0] * self.unit;
                (along[axis] * length).abs() + (out[axis] * 5.0 * self.unit).abs()
            });
            let upward = if out[1] > RELATIVE_ROUNDING
                || (out[1].abs() <= RELATIVE_ROUNDING && out[0] < 0.0)
            {
                14.0
            } else {
                0.0
            };
            upward + self.inked(&Bounds::around(middle, half))
        };
        let left = left_of(along);
        let right = scaled(left, -1.0);
        let behind = if cost(left) < cost(right) {
            left
        } else {
            right
        };
        [onward(center, width, behind), behind]
    }

    /// A point that runs along the ground on a roller.
    pub fn roller_on_guide(&mut self, at: At, along: Point, range: [f64; 2], group: &mut Group) {
        let center = self.global(at);
        let radius = 1.6 * PIN * self.unit;
        let circle = Outline::Circle(self.pixels(at).local, radius);
        group.add(Layer::Above, Frame::Body(at.body), Look::Part, circle);
        let [_, behind] = self.base(center, along, range);
        let base = onward(center, radius, behind);
        let overhang = 26.0 * self.unit;
        let ends = [range[0] - overhang, range[1] + overhang].map(|it| onward(base, it, along));
        self.ground(ends, behind, group);
        self.hole(at, group);
    }

    /// Origin of the body whose curve a follower touches.
    fn touched_from(&self, follower: usize) -> Option<Point> {
        let mut signs = self.scene.signs.iter();
        let sign = signs
            .find(|it| matches!(it.feature, Feature::Contact(_)) && it.marks[0].body == follower)?;
        let body = sign.curve.as_ref()?.body;
        Some(self.figure.stance.places[body].origin)
    }

    /// The radius of a follower's roller, in m.
    fn roller_of(&self, follower: usize) -> f64 {
        let rollers =
            self.scene.signs.iter().filter(|it| {
                matches!(it.feature, Feature::Contact(_)) && it.marks[0].body == follower
            });
        rollers.fold(0.0, |most, it| it.number.max(most))
    }
}
