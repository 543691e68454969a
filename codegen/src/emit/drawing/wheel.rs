//! Wheels: gears as pitch circles with their contact, belts, rack and pinion.

use super::draft::{Draft, LINK};
use super::figure::{Frame, Group, Layer, Look, Outline};
use super::plane::{
    Point, RELATIVE_ROUNDING, angle_of, difference, distance, dot, heading, left_of, onward, scaled,
};
use super::pose::{At, Sign};
use crate::joint::{Feature, Mesh};

/// Style of the edge of a wheel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Rim {
    /// The pitch circle of teeth outside.
    Pitch,
    /// Teeth inside of a ring.
    Ring,
    /// Edge under a belt.
    Solid,
}

/// True if two circles, or two rings, are one up to rounding.
fn is_near(one: &Outline, other: &Outline) -> bool {
    let near = |a: &Point, b: &Point, i: f64, j: f64| distance(*a, *b) < 0.5 && (i - j).abs() < 0.5;
    match (one, other) {
        (Outline::Circle(a, i), Outline::Circle(b, j)) => near(a, b, *i, *j),
        (Outline::Ring(a, i, _), Outline::Ring(b, j, _)) => near(a, b, *i, *j),
        _ => false,
    }
}

impl Draft<'_> {
    /// Draws two wheels and their contact.
    pub fn wheels(&mut self, sign: &Sign, mesh: Mesh, group: &mut Group) {
        let carrier = sign.marks[2].body;
        let centers = [0, 1].map(|side| self.center(sign.marks[side].body, carrier));
        let apart = {
            let [a, b] = centers.map(|it| self.figure.stance.places[it.body].globally(it.local));
            distance(a, b)
        };
        let ratio = sign.number;
        // r_i = ratio r_j, and the radii make the distance of the centres.
        let second = match mesh {
            Mesh::External => apart / (1.0 + ratio),
            Mesh::Internal if (1.0 - ratio).abs() > RELATIVE_ROUNDING => {
                apart / (1.0 - ratio).abs()
            }
            _ => 0.62 * apart / (1.0 + ratio),
        };
        let radii = [ratio * second, second];
        if apart < 1.0 || radii.iter().any(|it| !it.is_finite()) {
            self.coaxial(centers, group);
            return;
        }
        for side in [0, 1] {
            let look = match mesh {
                Mesh::External => Rim::Pitch,
                Mesh::Internal if radii[side] > radii[1 - side] => Rim::Ring,
                Mesh::Internal => Rim::Pitch,
                Mesh::Belt | Mesh::CrossedBelt => Rim::Solid,
            };
            self.wheel(centers[side], radii[side], look, group);
        }
        let frame = Frame::Toward(centers[0], centers[1]);
        match mesh {
            Mesh::External | Mesh::Internal => {
                // The larger wheel of two inside one another has the other's center between its own and the contact.
                let is_outward = mesh == Mesh::External || radii[0] < radii[1];
                let place = match (mesh, is_outward) {
                    (Mesh::Internal, true) => -radii[0],
                    _ => radii[0],
                };
                let tick = 6.0 * self.unit;
                let across = Outline::line([place, -tick], [place, tick]);
                group.add(Layer::Above, frame, Look::Edge, across);
                let dot = Outline::Circle([place, 0.0], 2.0 * self.unit);
                group.add(Layer::Above, frame, Look::Ink, dot);
            }
            Mesh::Belt | Mesh::CrossedBelt => {
                let sign = if mesh == Mesh::Belt { 1.0 } else { -1.0 };
                let lean = ((radii[0] - sign * radii[1]) / apart)
                    .clamp(-1.0, 1.0)
                    .acos();
                for side in [1.0, -1.0] {
                    let out = heading(side * lean);
                    let ends = [
                        scaled(out, radii[0]),
                        onward([apart, 0.0], sign * radii[1], out),
                    ];
                    group.add(Layer::Upon, frame, Look::Face, Outline::Open(ends.to_vec()));
                }
            }
        }
    }

    /// Wheels about one center have no radii: a ring shows that they turn together.
    fn coaxial(&mut self, centers: [At; 2], group: &mut Group) {
        for (at, radius) in centers.into_iter().zip([12.0, 16.0]) {
            let circle = Outline::Circle(at.local, radius * self.unit);
            group.add(Layer::Above, Frame::Body(at.body), Look::Thought, circle);
        }
    }

    /// Draws a wheel of a body, or one that is fixed to the ground. Several pairs may share it.
    fn wheel(&mut self, center: At, radius: f64, rim: Rim, group: &mut Group) {
        let At { body, local } = center;
        let pitch = Outline::Circle(local, radius);
        if rim != Rim::Solid {
            self.figure.add_diameter(center, radius);
            group.add(Layer::Upon, Frame::Body(body), Look::Thought, pitch.clone());
        }
        let width = 7.0 * self.unit;
        if body == 0 {
            self.fixed_wheel(local, radius, rim, width, group);
            return;
        }
        let (look, shape) = match rim {
            Rim::Ring => (Look::Body, Outline::Ring(local, radius, radius + width)),
            Rim::Pitch => (Look::Disc, pitch),
            Rim::Solid => (Look::Body, pitch),
        };
        let elements = self.figure.bodies[body - 1].parts();
        let elements: Vec<&Outline> = elements
            .flat_map(|it| &it.elements)
            .map(|it| &it.outline)
            .collect();
        if elements.iter().any(|it| is_near(it, &shape)) {
            return;
        }
        let has_wheel = !elements.is_empty();
        self.add_to_body(body, look, shape);
        if !has_wheel {
            let [from, to] = match rim {
                Rim::Ring => [radius, radius + width],
                _ => [width.min(radius), radius],
            };
            let ends = [from, to].map(|it| onward(local, it, [1.0, 0.0]));
            self.add_to_body(body, Look::Edge, Outline::Open(ends.to_vec()));
        }
    }

    /// Teeth of the ground: a hatched circle.
    fn fixed_wheel(&self, local: Point, radius: f64, rim: Rim, width: f64, group: &mut Group) {
        let outward = if rim == Rim::Ring { width } else { -width };
        let edge = (radius + outward).max(1.0);
        let frame = Frame::Body(0);
        group.add(
            Layer::Below,
            frame,
            Look::Edge,
            Outline::Circle(local, edge),
        );
        let turn = std::f64::consts::TAU;
        let strokes = (turn * edge / (7.0 * self.unit)).clamp(12.0, 400.0) as usize;
        for stroke in 0..strokes {
            let angle = turn * stroke as f64 / strokes as f64;
            let from = onward(local, edge, heading(angle));
            let end = heading(angle + 0.7 * width / edge);
            let to = onward(local, edge + 0.8 * outward, end);
            group.add(Layer::Below, frame, Look::Hatch, Outline::line(from, to));
        }
    }

    /// Point about which a wheel turns, seen from a carrier: its pin on the carrier, or a common pin of both.
    fn center(&self, wheel: usize, carrier: usize) -> At {
        let scene = self.scene;
        let pins = |body: usize| {
            scene.signs.iter().flat_map(move |sign| {
                let of_body = |at: &&At| at.body == body;
                let is_kept = matches!(sign.feature, Feature::Coordinate(_)) && !sign.is_driver;
                let count = match sign.feature {
                    Feature::Pin => 2,
                    _ if is_kept => 1,
                    _ => 0,
                };
                let pin_mark = sign.marks.iter().take(count).find(of_body).copied();
                // A fixed point on the ground is a pin of the ground too.
                let on_ground = (is_kept && body == 0)
                    .then(|| scene.carried_by(0, scene.global(sign.marks[0])));
                pin_mark.or(on_ground)
            })
        };
        let near = 1.0 / self.figure.scale;
        let common_pin = pins(wheel).find(|at| {
            let there = scene.global(*at);
            pins(carrier).any(|it| distance(scene.global(it), there) < near)
        });
        let origin = At {
            body: wheel,
            local: [0.0; 2],
        };
        self.pixels(common_pin.or_else(|| pins(wheel).next()).unwrap_or(origin))
    }

    /// A wheel that rolls on a line of another body.
    pub fn pinion(&mut self, sign: &Sign, group: &mut Group) {
        let Some((line, owner, wheel)) = Self::line_of(sign) else {
            return;
        };
        let radius = sign.number * self.figure.scale;
        let travel = self.scene.travel(sign, line);
        let scale = self.figure.scale;
        self.wheel(self.pixels(wheel), radius, Rim::Pitch, group);
        let side = if travel.aside < 0.0 { -1.0 } else { 1.0 };
        let (along, across) = (line.along, scaled(left_of(line.along), side));
        let mark = self.pixels(owner).local;
        let on_line = self.corners[owner.body].iter().filter_map(|corner| {
            let gap = difference(*corner, mark);
            (dot(gap, across).abs() < 0.5).then(|| dot(gap, along))
        });
        let reach = [travel.least * scale - radius, travel.most * scale + radius];
        let (low, high) = on_line.fold((reach[0], reach[1]), |(low, high), it| {
            (low.min(it), high.max(it))
        });
        let at =
            |along_line: f64, depth: f64| onward(onward(mark, along_line, along), -depth, across);
        let depth = 1.6 * LINK * self.unit;
        let (low, high) = (low - LINK * self.unit, high + LINK * self.unit);
        let bar = Outline::Closed(vec![
            at(low, 0.0),
            at(high, 0.0),
            at(high, depth),
            at(low, depth),
        ]);
        match owner.body {
            0 => {
                let behind = self.figure.stance.places[0].rotate(scaled(across, -1.0));
                self.ground([at(low, 0.0), at(high, 0.0)], behind, group);
            }
            body => self.add_to_body(body, Look::Body, bar),
        }
        let pitch = Outline::line(at(low, 0.0), at(high, 0.0));
        group.add(Layer::Upon, Frame::Body(owner.body), Look::Thought, pitch);
        let tick = 6.0 * self.unit;
        let contact = Frame::Riding(self.pixels(wheel), owner.body);
        let touched = scaled(across, -radius);
        let ends: [Point; 2] = [
            onward(touched, -tick, across),
            onward(touched, tick, across),
        ];
        group.add(
            Layer::Above,
            contact,
            Look::Edge,
            Outline::Open(ends.to_vec()),
        );
        group.add(
            Layer::Above,
            contact,
            Look::Ink,
            Outline::Circle(touched, 2.0 * self.unit),
        );
    }

    /// The angle, in a body's frame, at which its points lie as seen from one of them.
    pub fn facing(&self, at: At) -> f64 {
        let corners = self.corners[at.body].iter().copied();
        let farthest =
            corners.max_by(|a, b| distance(*a, at.local).total_cmp(&distance(*b, at.local)));
        match farthest {
            Some(corner) if distance(corner, at.local) > 1.0 => {
                angle_of(difference(corner, at.local))
            }
            _ => 0.0,
        }
    }
}
