//! Cylinders: a barrel on one body and a rod on the other.

use super::draft::{BLOCK, Draft};
use super::figure::{Frame, Group, Layer, Look, Outline};
use super::plane::{Point, onward, scaled};
use super::pose::{At, Line, Sign};
use crate::joint::Feature;

/// Half the width of a barrel and of a rod, in units.
const BARREL: f64 = 7.5;
const ROD: f64 = 2.4;

/// Lengths of barrel and rod, in pixels.
struct Lengths {
    barrel: f64,
    rod: f64,
}

impl Lengths {
    /// Lengths for a stroke from `least` to `most`: the piston stays in the barrel, and some of the rod outside.
    fn of(least: f64, most: f64) -> Lengths {
        let rod = 0.86 * least;
        let barrel = (0.58 * least).max(most - rod + 0.06 * least);
        Lengths {
            barrel: barrel.min(0.94 * least).max(most - rod),
            rod,
        }
    }
}

impl Draft<'_> {
    /// True if the line of a sign is driven and both its bodies move, so that it keeps its direction.
    pub fn is_cylinder(&self, sign: &Sign) -> bool {
        let Some((line, owner, other)) = Self::line_of(sign) else {
            return false;
        };
        let is_same = |it: &Sign| {
            it.feature == Feature::Slide && it.is_driver != sign.is_driver && it.marks == sign.marks
        };
        let travel = self.scene.travel(sign, line);
        let shortest = 3.0 * BLOCK[0] * self.unit;
        self.partner(sign, is_same).is_some()
            && owner.body != 0
            && other.body != 0
            && travel.least * self.figure.scale > shortest
            && travel.most < 1.8 * travel.least
            && travel.aside.abs() * self.figure.scale < 1.0
    }

    /// Draws the barrel on the body of the line, the rod on the other.
    pub fn cylinder(&mut self, sign: &Sign, line: Line, group: &mut Group) {
        let [owner, other] = [line.owner, line.other].map(|mark| self.pixels(sign.marks[mark]));
        let travel = self.scene.travel(sign, line);
        let scale = self.figure.scale;
        let lengths = Lengths::of(travel.least * scale, travel.most * scale);
        let toward = line.along;
        let back = self.figure.stance.places[other.body].unrotate(self.scene.along(sign, line));
        let back = scaled(back, -1.0);
        for (look, outline) in self.rod(other.local, back, lengths.rod) {
            self.add_to_body(other.body, look, outline);
        }
        for (look, outline) in self.barrel(owner.local, toward, lengths.barrel) {
            self.add_to_body(owner.body, look, outline);
        }
        let gland = self.gland(owner.local, toward, lengths.barrel);
        group.add(Layer::Upon, Frame::Body(owner.body), Look::Edge, gland);
    }

    /// Draws a cylinder between two points whose distance is driven.
    pub fn free_cylinder(&mut self, from: At, to: At, [least, most]: [f64; 2], group: &mut Group) {
        let lengths = Lengths::of(least, most);
        let along = [1.0, 0.0];
        let rod = Frame::Toward(to, from);
        for (look, outline) in self.rod([0.0; 2], along, lengths.rod) {
            group.add(Layer::Upon, rod, look, outline);
        }
        let barrel = Frame::Toward(from, to);
        for (look, outline) in self.barrel([0.0; 2], along, lengths.barrel) {
            group.add(Layer::Upon, barrel, look, outline);
        }
        let gland = self.gland([0.0; 2], along, lengths.barrel);
        group.add(Layer::Upon, barrel, Look::Edge, gland);
    }

    fn barrel(&self, from: Point, along: Point, length: f64) -> Vec<(Look, Outline)> {
        let start = 9.0 * self.unit;
        let middle = onward(from, 0.5 * (start + length), along);
        let half = [0.5 * (length - start), BARREL * self.unit];
        let eye = Outline::Rounded(
            vec![from, onward(from, start, along)],
            2.0 * ROD * self.unit,
        );
        vec![
            (Look::Body, eye),
            (Look::Body, Outline::block(middle, along, half)),
        ]
    }

    fn rod(&self, from: Point, along: Point, length: f64) -> Vec<(Look, Outline)> {
        let end = onward(from, length, along);
        let rod = Outline::block(
            onward(from, 0.5 * length, along),
            along,
            [0.5 * length, ROD * self.unit],
        );
        let piston = Outline::block(end, along, [2.5 * self.unit, (BARREL - 1.0) * self.unit]);
        let eye = Outline::Circle(from, 2.6 * ROD * self.unit);
        vec![(Look::Body, rod), (Look::Body, piston), (Look::Body, eye)]
    }

    /// Ring at which the rod leaves the barrel.
    fn gland(&self, from: Point, along: Point, length: f64) -> Outline {
        let half = [1.6 * self.unit, (BARREL + 1.2) * self.unit];
        Outline::block(onward(from, length, along), along, half)
    }
}
