//! The blocks of a plan that are two links between known pins → what shows that they do not come in line.
//!
//! Two links of lengths a and b, from one pin to the other by way of the pin between them, make an angle ψ with
//! ab cos ψ = (d² − a² − b²)/2, where d is the distance of the outer pins. They can leave their assembly mode only where sin ψ is zero.
//! Both frames say how cos ψ and the angles of the links run on; how far they may be from that follows from how far the pins go (m)
//! and how far they are from a straight line (σ), with 1/a + 1/b as the largest derivative of cos ψ, 1/(a |sin ψ|) as that of an
//! angle, and the remainder of linear interpolation. The bounds of the angles are those of arms in the next block. The guide
//! (`theory.md`) has the argument.
//!
//! A mechanism that has other blocks is not looked at so. Deliberately unknown here: how a part is solved.

use super::builder::Builder;
use super::function::{Function, Statement};
use super::passes::enclosure::Enclosure;
use super::pin_motion::Known;
use crate::expr::ExprId;
use crate::joint::geometry::Vector;
use crate::structure::{Part, SolvedBlock};

/// How far a link may turn, in rad: two frames that are no farther from a third one are less than half a turn apart.
const LARGEST_TURN: (i64, i64) = (3, 2);

/// R(φ_a) p + R(φ_b) q + c = 0, as a closed form has noted it.
#[derive(Clone, Copy, Debug)]
pub(super) struct TwoLinks {
    /// φ_a and φ_b.
    pub angles: [usize; 2],
    /// p and q.
    pub links: [Vector; 2],
    /// c.
    pub closure: Vector,
    /// The scalar product of both links, as the frame holds it.
    pub product: ExprId,
}

impl Builder<'_> {
    /// Notes two links of a closed form that stands by itself.
    pub(super) fn note_links(&mut self, links: TwoLinks) {
        if self.inside.is_none() {
            let both = links.angles.map(|angle| (angle, links));
            self.paths.links.extend(both);
        }
    }

    /// What shows that all of these blocks, with their places in the plan, keep to their path because no two links come in line;
    /// `None` where one of them is something else.
    pub(super) fn two_links<'b>(
        mut self,
        blocks: impl Iterator<Item = (usize, &'b SolvedBlock)>,
    ) -> Option<Function> {
        self.begin_path();
        let mut known = Known::default();
        let mut pairs = 0;
        for (place, block) in blocks {
            for part in &block.parts {
                pairs += usize::from(self.bound_part(part, place, &mut known)?);
            }
            for definition in &block.definitions {
                self.note_size(definition, &mut known);
                self.path_of_definition(definition, place);
            }
        }
        (pairs > 0).then(|| Function {
            statements: self.statements,
            ..Function::default()
        })
    }

    /// Bounds what a part finds; false where it does not move.
    fn bound_part(&mut self, part: &Part, block: usize, known: &mut Known) -> Option<bool> {
        let equations = part.equations.iter();
        let residuals: Vec<ExprId> = equations.map(|it| self.in_short(it.residual)).collect();
        for &residual in &residuals {
            self.bound_definitions(residual, known);
        }
        if self.is_still(&part.unknowns, &residuals) {
            part.unknowns.iter().for_each(|&it| self.know_still(it));
            return Some(false);
        }
        let links = *self.paths.links.get(part.unknowns.first()?)?;
        self.bound_links(links, block, known);
        Some(true)
    }

    /// Asks that two links are not in line, and bounds how far they turn.
    fn bound_links(&mut self, links: TwoLinks, block: usize, known: &mut Known) {
        let TwoLinks {
            angles,
            links,
            closure,
            product,
        } = links;
        let name = angles.map(|angle| self.system.unknown_name(angle).to_string());
        let pair = name.join("_");
        let closure = closure.map(|part| self.undriven(part));
        let links = links.map(|link| link.map(|part| self.in_short(part)));
        let lengths = links.map(|link| self.length_of(link));
        let rounding = {
            let [x, y] = closure.map(|part| self.size_of(part, known));
            let [a, b] = lengths.map(|length| self.size_of(length, known));
            let size = self.graph().sum(&[x, y, a, b]);
            let rounding = self.paths.span.rounding;
            let rounding = self.graph().variable(rounding);
            let rounding = self.graph().multiply(rounding, size);
            self.bounded(&format!("{pair}_rounding"), rounding)
        };
        let closure = closure.map(|part| self.in_short(part));
        let mut parts = closure.iter().chain(links.iter().flatten());
        let is_linked = parts.any(|&part| self.is_linked(part, known));
        let pins = self.motion_of(closure, known);
        let stretched = links.map(|link| self.components(link));
        let zero = self.graph().zero();
        // Where a length changes along a line that passes the pin, the link turns in its body by that, too.
        let is_oblique =
            [0, 1].map(|side| stretched[side].radius != zero && !links[side].contains(&zero));
        let oblique = [0, 1].map(|side| {
            if is_oblique[side] {
                stretched[side].radius
            } else {
                zero
            }
        });
        let moved = {
            let parts = [
                pins.radius,
                stretched[0].radius,
                stretched[1].radius,
                oblique[0],
                oblique[1],
                rounding,
            ];
            let moved = self.graph().sum(&parts);
            self.bounded(&format!("{pair}_moved"), moved)
        };
        let strayed = {
            // Such a length is no linear function of what drives it: it strays by what it moves, here and along the line.
            let twice = self.graph().integer(2);
            let oblique = oblique.map(|part| self.graph().multiply(twice, part));
            let sags = stretched.map(|it| it.sag);
            let parts = [pins.sag, sags[0], sags[1], oblique[0], oblique[1], rounding];
            let strayed = self.graph().sum(&parts);
            self.bounded(&format!("{pair}_strayed"), strayed)
        };
        self.require(block);
        let is_fixed = stretched.iter().all(|it| it.radius == zero);
        let shortest = [0, 1].map(|side| {
            if stretched[side].radius == zero {
                return lengths[side];
            }
            let least = self.graph().subtract(lengths[side], stretched[side].radius);
            let least = self.bounded(&format!("{}_length", name[side]), least);
            self.state(Statement::Require {
                value: least,
                block,
            });
            least
        });
        let one = self.graph().one();
        let slopes = shortest.map(|length| self.graph().divide(one, length));
        let slopes = [0, 1].map(|side| {
            let slope = format!("{}_slope", name[side]);
            self.bounded(&slope, slopes[side])
        });
        let slope = self.graph().add(slopes[0], slopes[1]);
        let slope = self.bounded(&format!("{pair}_slope"), slope);
        let bend = self.paths.span.bend;
        let bend = self.graph().variable(bend);
        let moved_square = self.graph().multiply(moved, moved);
        let moved_square = self.bounded(&format!("{pair}_moved_square"), moved_square);
        let cosine = {
            let area = self.graph().multiply(lengths[0], lengths[1]);
            let inverse = self.graph().divide(one, area);
            let now = self.graph().magnitude(product);
            let (scaled, further) = match is_fixed {
                true => {
                    let way = self.way_of(product);
                    let curved = self.graph().multiply(bend, moved_square);
                    let scaled = self.graph().sum(&[now, way, curved]);
                    let scaled = self.bounded(&format!("{pair}_product"), scaled);
                    (scaled, strayed)
                }
                false => (now, moved),
            };
            let scaled = self.graph().multiply(inverse, scaled);
            let further = self.graph().multiply(slope, further);
            let largest = self.graph().add(scaled, further);
            self.bounded(&format!("{pair}_cosine"), largest)
        };
        let sine_square = {
            let square = self.graph().multiply(cosine, cosine);
            let rest = self.graph().subtract(one, square);
            self.bounded(&format!("{pair}_sine_square"), rest)
        };
        let value = {
            // moved/(a |sin ψ|) is no more than this where moved (1/a + 1/b)/|sin ψ| is not.
            let (above, below) = LARGEST_TURN;
            let part = self.graph().rational(below, above);
            let part = self.graph().multiply(part, slope);
            let least = self.graph().product(&[part, part, moved_square]);
            self.graph().subtract(sine_square, least)
        };
        self.path_geometry(&[value]);
        self.state(Statement::Require { value, block });
        let inverse = {
            let sine = self.graph().sqrt(sine_square);
            let inverse = self.graph().divide(one, sine);
            self.bounded(&format!("{pair}_inverse"), inverse)
        };
        let turned = self.graph().multiply(moved, inverse);
        let turned = self.bounded(&format!("{pair}_turned"), turned);
        let bent = {
            // What the square of a turn is multiplied by in the second derivative of an angle.
            let own = match is_fixed {
                true => self.larger(slopes),
                false => self.graph().add(slope, slope),
            };
            let other = self.graph().product(&[slope, cosine, inverse]);
            let both = self.graph().add(own, other);
            let curved = self.graph().product(&[bend, turned, turned, both]);
            let strayed = self.graph().multiply(inverse, strayed);
            let bent = self.graph().add(curved, strayed);
            self.bounded(&format!("{pair}_bent"), bent)
        };
        for side in [0, 1] {
            let [sag, first] = [bent, turned].map(|it| self.graph().multiply(it, slopes[side]));
            let way = self.way_of_angle(angles[side]);
            let sag = match is_oblique[side] {
                true => self.graph().add(way, first),
                false => sag,
            };
            let sag = self.bounded(&format!("{}_sag", name[side]), sag);
            // Where links move the pins, bounds of bounds grow by more than what they bound, and frames know better.
            let radius = match is_oblique[side] || !is_linked {
                true => first,
                false => self.graph().add(way, sag),
            };
            let radius = self.bounded(&format!("{}_radius", name[side]), radius);
            self.know(angles[side], Enclosure { radius, sag });
            known.linked.insert(angles[side]);
        }
    }

    /// The larger one of two constants that are not negative, or else their sum.
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

    /// Bounds what an expression mentions, as far as nothing has mentioned it before.
    fn bound_definitions(&mut self, expr: ExprId, known: &mut Known) {
        for symbol in self.system.mechanism.graph.symbols(expr).to_vec() {
            let Some((definition, block)) = self.awaited(symbol) else {
                continue;
            };
            let unknown = definition.unknown;
            let value = self.in_short(definition.value);
            self.bound_definitions(value, known);
            let found = self.enclosure(value);
            self.path_geometry(&[found.radius, found.sag]);
            self.require(block);
            if found.radius == self.graph().zero() {
                self.know(unknown, found);
                continue;
            }
            if self.is_linked(value, known) {
                known.linked.insert(unknown);
            }
            // Between both frames it moves by their difference, and beyond them as much.
            let name = self.system.unknown_name(unknown).to_string();
            let rounding = self.paths.span.rounding;
            let [rounding, value] = [self.graph().variable(rounding), self.position(unknown)];
            let size = self.graph().magnitude(value);
            let rounding = self.graph().multiply(rounding, size);
            let sag = self.graph().add(found.sag, rounding);
            let sag = self.bounded(&format!("{name}_sag"), sag);
            let way = self.way_of(value);
            let radius = self.graph().add(way, sag);
            let radius = self.bounded(&format!("{name}_radius"), radius);
            self.know(unknown, Enclosure { radius, sag });
        }
    }
}
