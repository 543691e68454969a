//! Verifies that two links between bounded pins do not become collinear, and bounds their rotation.
//!
//! The letters are those of the [module](super): d, ψ, m, σ.

use super::{Course, TwoLinks};
use crate::expr::ExprId;
use crate::joint::geometry::Vector;
use crate::program::builder::Builder;
use crate::program::function::Statement;
use crate::program::passes::enclosure::Enclosure;
use crate::program::pin_motion::Known;
use crate::program::quantities::upper;

/// Largest rotation of a link, in rad: two frames within this distance of a third one are less than half a turn apart.
const LARGEST_TURN: (i64, i64) = (3, 2);

/// Pair of links before its verification.
pub(super) struct Pair {
    pub block: usize,
    pub angles: [usize; 2],
    /// Names of the angles, and of both together.
    pub names: [String; 2],
    pub name: String,
    /// Vectors p and q.
    pub links: [Vector; 2],
    /// Vector c.
    pub closure: Vector,
    /// Scalar product of both links.
    pub product: ExprId,
    /// Lengths a and b in this frame.
    pub lengths: [ExprId; 2],
    /// Motion of the ends of the links in their bodies.
    stretched: [Enclosure; 2],
    /// True if the length changes along a line that does not meet the pin, so that the link rotates in its body too.
    is_oblique: [bool; 2],
    /// True if rotating links move the pins.
    is_linked: bool,
    /// Effect of rounding.
    pub rounding: ExprId,
    /// Bound m on the change of all of these.
    moved: ExprId,
    /// Bound σ on their deviation from the chord.
    input_deviation: ExprId,
}

/// Factors of a pair's bounds: 1/a, 1/b and their sum, at the smallest lengths.
pub(super) struct Slopes {
    pub each: [ExprId; 2],
    pub both: ExprId,
}

/// Bound on the change of the angle between two links.
pub(super) struct Turn {
    /// Bound on |cos ψ|.
    pub cosine: ExprId,
    /// Bound on 1/|sin ψ|.
    pub inverse: ExprId,
    /// Bound on m/|sin ψ|, to be divided by the lengths.
    turned: ExprId,
}

impl Pair {
    /// True if both links have constant lengths.
    pub fn is_fixed(&self, zero: ExprId) -> bool {
        self.stretched.iter().all(|it| it.radius == zero)
    }
}

/// Two links that do not become collinear.
pub(super) struct Bounded {
    pub pair: Pair,
    pub slopes: Slopes,
    pub turn: Turn,
    /// Deviation of the links through their rotation, to be divided by the lengths.
    pub bent: ExprId,
}

impl Builder<'_> {
    /// Requires that two links do not become collinear, and bounds their rotation.
    pub(super) fn bound_links(&mut self, links: TwoLinks, block: usize, known: &mut Known) {
        self.name_bounds(links.angles);
        let pair = self.moving_pair(links, block, known);
        self.require(block);
        let slopes = self.slopes_of(&pair);
        let turn = self.turn_of(&pair, &slopes);
        let bent = self.input_deviation_of(&pair, &slopes, &turn);
        let bounded = Bounded {
            pair,
            slopes,
            turn,
            bent,
        };
        let courses = match known.is_row {
            true => self.courses_of(&bounded, known),
            false => None,
        };
        for (side, angle) in links.angles.into_iter().enumerate() {
            let course = courses.map(|courses| courses[side]);
            let enclosure = self.enclosure_of(side, &bounded, course);
            self.know(angle, enclosure);
            known.linked.insert(angle);
            known.courses.extend(course.map(|course| (angle, course)));
        }
    }

    /// Names the constants of the bounds.
    fn name_bounds(&mut self, angles: [usize; 2]) {
        self.quantities.add_turn_limit();
        let names = angles.map(|angle| self.paths.names.get(&angle).cloned());
        for link in names.iter().flatten() {
            self.quantities.add_link(link);
        }
        if let [Some(first), Some(second)] = &names {
            self.quantities.add_dyad_bounds([first, second]);
        }
    }

    /// Returns the bounds of one angle.
    fn enclosure_of(
        &mut self,
        side: usize,
        bounded: &Bounded,
        course: Option<Course>,
    ) -> Enclosure {
        let Bounded {
            pair,
            slopes,
            turn,
            bent,
        } = bounded;
        let [deviation, first] =
            [*bent, turn.turned].map(|it| self.graph().multiply(it, slopes.each[side]));
        let change = self.change_of_angle(pair.angles[side]);
        let name = &pair.names[side];
        let deviation = match course {
            Some(course) => course.deviation(name, self),
            None => {
                let deviation = match pair.is_oblique[side] {
                    true => self.graph().add(change, first),
                    false => deviation,
                };
                self.bounded(&format!("{name}_deviation"), deviation)
            }
        };
        // If links move the pins, bounds of bounds grow too fast, and changes between frames are better.
        let radius = match course.is_none() && (pair.is_oblique[side] || !pair.is_linked) {
            true => first,
            false => self.graph().add(change, deviation),
        };
        let radius = self.bounded(&format!("{name}_radius"), radius);
        Enclosure { radius, deviation }
    }

    /// Bounds the change of pins and ends of links, and their deviation from the chord.
    fn moving_pair(&mut self, two_links: TwoLinks, block: usize, known: &mut Known) -> Pair {
        let names = two_links
            .angles
            .map(|angle| self.system.unknown_name(angle).to_string());
        let name = names.join("_");
        let closure = two_links.closure.map(|part| self.undriven(part));
        let links = two_links
            .links
            .map(|link| link.map(|part| self.in_short(part)));
        let lengths = links.map(|link| self.length_of(link));
        let rounding = {
            let [x, y] = closure.map(|part| self.size_of(part, known));
            let [a, b] = lengths.map(|length| self.size_of(length, known));
            let size = self.graph().sum(&[x, y, a, b]);
            if let Some(value) = self.constant_of(size) {
                self.quantities.within(&["*_rounding"]);
                let stem = upper(&name);
                let words = "sum of the largest terms of the loop".to_string();
                self.quantities.add(["", "_LOOP_SIZE"], &stem, words, value);
            }
            let rounding = self.paths.window.rounding;
            let rounding = self.graph().variable(rounding);
            let rounding = self.graph().multiply(rounding, size);
            self.bounded(&format!("{name}_rounding"), rounding)
        };
        let closure = closure.map(|part| self.in_short(part));
        let mut parts = closure.iter().chain(links.iter().flatten());
        let is_linked = parts.any(|&part| self.is_linked(part, known));
        let pins = self.motion_of(closure, known);
        let stretched = links.map(|link| self.components(link));
        let zero = self.graph().zero();
        let is_oblique =
            [0, 1].map(|side| stretched[side].radius != zero && !links[side].contains(&zero));
        let oblique = [0, 1].map(|side| match is_oblique[side] {
            true => stretched[side].radius,
            false => zero,
        });
        let moved = {
            let [first, second] = stretched.map(|it| it.radius);
            let parts = [pins.radius, first, second, oblique[0], oblique[1], rounding];
            let moved = self.graph().sum(&parts);
            self.bounded(&format!("{name}_input_change"), moved)
        };
        let input_deviation = {
            // Such a length is a nonlinear function of its driver: it deviates by its change, here and along the chord.
            let twice = self.graph().integer(2);
            let oblique = oblique.map(|part| self.graph().multiply(twice, part));
            let [first, second] = stretched.map(|it| it.deviation);
            let parts = [
                pins.deviation,
                first,
                second,
                oblique[0],
                oblique[1],
                rounding,
            ];
            let input_deviation = self.graph().sum(&parts);
            self.bounded(&format!("{name}_input_deviation"), input_deviation)
        };
        Pair {
            block,
            angles: two_links.angles,
            names,
            name,
            links,
            closure,
            product: two_links.product,
            lengths,
            stretched,
            is_oblique,
            is_linked,
            rounding,
            moved,
            input_deviation,
        }
    }

    /// Requires that no link vanishes, and returns the largest derivatives of the angles.
    fn slopes_of(&mut self, pair: &Pair) -> Slopes {
        let zero = self.graph().zero();
        let shortest = [0, 1].map(|side| {
            let (length, radius) = (pair.lengths[side], pair.stretched[side].radius);
            if radius == zero {
                return length;
            }
            let value = self.graph().subtract(length, radius);
            let value = self.bounded(&format!("{}_length", pair.names[side]), value);
            let block = pair.block;
            self.state(Statement::Require { value, block });
            value
        });
        let one = self.graph().one();
        let each = shortest.map(|length| self.graph().divide(one, length));
        let each = [0, 1].map(|side| {
            let name = format!("{}_slope", pair.names[side]);
            self.bounded(&name, each[side])
        });
        let both = self.graph().add(each[0], each[1]);
        let both = self.bounded(&format!("{}_slope", pair.name), both);
        Slopes { each, both }
    }

    /// Requires that the links do not become collinear.
    fn turn_of(&mut self, pair: &Pair, slopes: &Slopes) -> Turn {
        let name = &pair.name;
        let remainder = self.paths.window.remainder;
        let remainder = self.graph().variable(remainder);
        let moved_square = self.graph().multiply(pair.moved, pair.moved);
        let moved_square = self.bounded(&format!("{name}_input_change_square"), moved_square);
        let [zero, one] = [self.graph().zero(), self.graph().one()];
        let cosine = {
            let area = self.graph().multiply(pair.lengths[0], pair.lengths[1]);
            let inverse = self.graph().divide(one, area);
            let now = self.graph().magnitude(pair.product);
            let (scaled, further) = match pair.is_fixed(zero) {
                true => {
                    let change = self.change_of(pair.product);
                    let curved = self.graph().multiply(remainder, moved_square);
                    let scaled = self.graph().sum(&[now, change, curved]);
                    let scaled = self.bounded(&format!("{name}_product"), scaled);
                    (scaled, pair.input_deviation)
                }
                false => (now, pair.moved),
            };
            let scaled = self.graph().multiply(inverse, scaled);
            let further = self.graph().multiply(slopes.both, further);
            let largest = self.graph().add(scaled, further);
            self.bounded(&format!("{name}_cosine"), largest)
        };
        let sine_square = {
            let square = self.graph().multiply(cosine, cosine);
            let rest = self.graph().subtract(one, square);
            self.bounded(&format!("{name}_sine_square"), rest)
        };
        let value = {
            // moved/(a |sin ψ|) is at most this if moved (1/a + 1/b)/|sin ψ| is.
            let (above, below) = LARGEST_TURN;
            let part = self.graph().rational(below, above);
            let part = self.graph().multiply(part, slopes.both);
            let least = self.graph().product(&[part, part, moved_square]);
            self.graph().subtract(sine_square, least)
        };
        self.path_geometry(&[value]);
        let block = pair.block;
        self.state(Statement::Require { value, block });
        let inverse = {
            let sine = self.graph().sqrt(sine_square);
            let inverse = self.graph().divide(one, sine);
            self.bounded(&format!("{name}_inverse"), inverse)
        };
        let turned = self.graph().multiply(pair.moved, inverse);
        let turned = self.bounded(&format!("{name}_turned"), turned);
        Turn {
            cosine,
            inverse,
            turned,
        }
    }

    /// Bounds the deviation of the links through their rotation, to be divided by the lengths.
    fn input_deviation_of(&mut self, pair: &Pair, slopes: &Slopes, turn: &Turn) -> ExprId {
        let Turn {
            cosine,
            inverse,
            turned,
        } = *turn;
        let zero = self.graph().zero();
        let remainder = self.paths.window.remainder;
        let remainder = self.graph().variable(remainder);
        // Factor of the squared rotation in the second derivative of an angle.
        let factor = match pair.is_fixed(zero) {
            true => self.larger(slopes.each),
            false => self.graph().add(slopes.both, slopes.both),
        };
        let other = self.graph().product(&[slopes.both, cosine, inverse]);
        let both = self.graph().add(factor, other);
        let curved = self.graph().product(&[remainder, turned, turned, both]);
        let input_deviation = self.graph().multiply(inverse, pair.input_deviation);
        let bent = self.graph().add(curved, input_deviation);
        self.bounded(&format!("{}_bent", pair.name), bent)
    }

    /// Returns the larger of two nonnegative constants, otherwise their sum.
    fn larger(&mut self, [first, second]: Vector) -> ExprId {
        let graph = self.graph();
        let value = |expr| {
            graph
                .constant_value(expr)
                .filter(|_| graph.is_constant(expr))
        };
        match (value(first), value(second)) {
            (Some(one), Some(other)) if one >= other => first,
            (Some(_), Some(_)) => second,
            _ => graph.add(first, second),
        }
    }
}
