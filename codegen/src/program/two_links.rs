//! The blocks of a plan that are two links between known pins → what shows that they do not come in line.
//!
//! Two links of lengths a and b, from one pin to the other by way of the pin between them, make an angle ψ with
//! ab cos ψ = (d² − a² − b²)/2, where d is the distance of the outer pins. They can leave their assembly mode only where sin ψ is zero.
//! Where the outer pins and the lengths move by no more than m together, cos ψ changes by no more than m (1/a + 1/b), since
//! d ≤ a + b; so |sin ψ| is at least some s, and the links turn by no more than m/(a s) and m/(b s). These bounds of the angles are
//! arms' bounds in the next block. Every bound is about what a frame holds, and rounding is a motion of the pins.
//!
//! A mechanism that has other blocks is not looked at so. Deliberately unknown here: how a part is solved.

use std::collections::{HashMap, HashSet};

use super::builder::Builder;
use super::function::{Function, Statement};
use super::passes::enclosure::Enclosure;
use crate::expr::{ExprId, Node, Number, SymbolId};
use crate::joint::Quantity;
use crate::joint::geometry::Vector;
use crate::structure::{Definition, Part, SolvedBlock};
use crate::system::SymbolRole;

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

/// What is known of all values while the links are looked at.
#[derive(Default)]
struct Bounds {
    /// The unknowns whose bounds follow from those of links.
    linked: HashSet<usize>,
    /// How large what unknowns are computed from is, of those that follow from arms and constants.
    sizes: HashMap<SymbolId, ExprId>,
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
        let mut bounds = Bounds::default();
        let mut pairs = 0;
        for (place, block) in blocks {
            for part in &block.parts {
                pairs += usize::from(self.bound_part(part, place, &mut bounds)?);
            }
            for definition in &block.definitions {
                self.note_size(definition, &mut bounds);
                self.path_of_definition(definition, place);
            }
        }
        (pairs > 0).then(|| Function {
            statements: self.statements,
            ..Function::default()
        })
    }

    /// Bounds what a part finds; false where it does not move.
    fn bound_part(&mut self, part: &Part, block: usize, bounds: &mut Bounds) -> Option<bool> {
        let equations = part.equations.iter();
        let residuals: Vec<ExprId> = equations.map(|it| self.in_short(it.residual)).collect();
        for &residual in &residuals {
            self.bound_definitions(residual, bounds);
        }
        if self.is_still(&part.unknowns, &residuals) {
            part.unknowns.iter().for_each(|&it| self.know_still(it));
            return Some(false);
        }
        let links = *self.paths.links.get(part.unknowns.first()?)?;
        self.bound_links(links, block, bounds);
        Some(true)
    }

    /// Asks that two links are not in line, and bounds how far they turn.
    fn bound_links(&mut self, links: TwoLinks, block: usize, bounds: &mut Bounds) {
        let TwoLinks {
            angles,
            links,
            closure,
            product,
        } = links;
        let links = links.map(|link| link.map(|part| self.in_short(part)));
        let closure = closure.map(|part| self.undriven(part));
        let size = {
            let parts = [closure[0], closure[1]].map(|part| self.size_of(part, bounds));
            let lengths = links.map(|link| self.length_of(link));
            let parts = [parts[0], parts[1], lengths[0], lengths[1]];
            self.graph().sum(&parts)
        };
        let closure = closure.map(|part| self.in_short(part));
        let lengths = links.map(|link| self.length_of(link));
        let stretched = links.map(|link| self.stretch_of(link));
        let rounding = self.paths.span.rounding;
        let moved = {
            let pins = self.motion_of(closure);
            let rounding = self.graph().variable(rounding);
            let rounding = self.graph().multiply(rounding, size);
            self.graph()
                .sum(&[pins, stretched[0], stretched[1], rounding])
        };
        let names = angles.map(|angle| self.system.unknown_name(angle).to_string());
        let moved = self.bounded(&format!("{}_{}_moved", names[0], names[1]), moved);
        self.require(block);
        let zero = self.graph().zero();
        let shortest = [0, 1].map(|side| {
            if stretched[side] == zero {
                return lengths[side];
            }
            let least = self.graph().subtract(lengths[side], stretched[side]);
            let least = self.bounded(&format!("{}_length", names[side]), least);
            self.state(Statement::Require {
                value: least,
                block,
            });
            least
        });
        let one = self.graph().one();
        let slopes = shortest.map(|length| self.graph().divide(one, length));
        let slope = self.graph().add(slopes[0], slopes[1]);
        let turned = self.graph().multiply(moved, slope);
        let cosine = {
            let lengths = self.graph().multiply(lengths[0], lengths[1]);
            let cosine = self.graph().divide(product, lengths);
            self.graph().magnitude(cosine)
        };
        let cosine = self.graph().add(cosine, turned);
        let cosine = self.bounded(&format!("{}_{}_cosine", names[0], names[1]), cosine);
        let square = self.graph().multiply(cosine, cosine);
        let sine_square = self.graph().subtract(one, square);
        // moved/(a s) is at most as much where moved (1/a + 1/b) is.
        let (above, below) = LARGEST_TURN;
        let part = self.graph().rational(below, above);
        let least = self.graph().multiply(part, turned);
        let least = self.graph().multiply(least, least);
        let value = self.graph().subtract(sine_square, least);
        self.path_geometry(&[value]);
        self.state(Statement::Require { value, block });
        let sine = self.graph().sqrt(sine_square);
        let turned = self.graph().divide(moved, sine);
        let turned = self.bounded(&format!("{}_{}_turned", names[0], names[1]), turned);
        for ((angle, name), slope) in angles.into_iter().zip(names).zip(slopes) {
            let radius = self.graph().multiply(turned, slope);
            let radius = self.bounded(&format!("{name}_radius"), radius);
            self.know(angle, Enclosure { radius, sag: zero });
            bounds.linked.insert(angle);
        }
    }

    /// Bounds what an expression mentions, as far as nothing has mentioned it before.
    fn bound_definitions(&mut self, expr: ExprId, bounds: &mut Bounds) {
        for symbol in self.system.mechanism.graph.symbols(expr).to_vec() {
            let Some((definition, block)) = self.awaited(symbol) else {
                continue;
            };
            let unknown = definition.unknown;
            let value = self.in_short(definition.value);
            self.bound_definitions(value, bounds);
            let found = self.enclosure(value);
            self.path_geometry(&[found.radius, found.sag]);
            self.require(block);
            let zero = self.graph().zero();
            if found.radius == zero {
                self.know(unknown, found);
                continue;
            }
            let name = self.system.unknown_name(unknown).to_string();
            let symbols = self.system.mechanism.graph.symbols(value);
            let mut moving = symbols.iter().filter_map(|&symbol| self.moving(symbol));
            let (radius, sag) = match moving.any(|unknown| bounds.linked.contains(&unknown)) {
                true => {
                    bounds.linked.insert(unknown);
                    // Nobody asks how straight the way of a link is.
                    (found.radius, zero)
                }
                // Between both frames it moves by their difference, and beyond them as much.
                false => {
                    let sag = self.bounded(&format!("{name}_sag"), found.sag);
                    let way = self.way(unknown);
                    let way = self.graph().variable(way);
                    (self.graph().add(way, sag), sag)
                }
            };
            let rounding = {
                let rounding = self.paths.span.rounding;
                let [rounding, value] = [self.graph().variable(rounding), self.position(unknown)];
                let size = self.graph().magnitude(value);
                self.graph().multiply(rounding, size)
            };
            let radius = self.graph().add(radius, rounding);
            let radius = self.bounded(&format!("{name}_radius"), radius);
            self.know(unknown, Enclosure { radius, sag });
        }
    }

    /// A name for a bound.
    fn bounded(&mut self, name: &str, value: ExprId) -> ExprId {
        let graph = &self.system.mechanism.graph;
        if graph.is_constant(value) || matches!(graph.node(value), Node::Symbol(_)) {
            return value;
        }
        self.path_geometry(&[value]);
        let symbol = self.system.intermediate(name);
        self.assign(symbol, value);
        self.graph().variable(symbol)
    }

    /// How far a vector goes: what turns with one angle together, and the rest.
    fn motion_of(&mut self, vector: Vector) -> ExprId {
        let mut angles: Vec<usize> = Vec::new();
        for part in vector {
            for symbol in self.system.mechanism.graph.symbols(part) {
                if let SymbolRole::Arm(place) = self.system.roles[symbol.index()] {
                    angles.push(self.system.vector_form.arms[place].angle);
                }
            }
        }
        angles.sort_unstable();
        angles.dedup();
        let (mut rest, mut parts) = (vector, Vec::new());
        for angle in angles {
            let graph = &mut self.system.mechanism.graph;
            let turned = self.system.vector_form.turned_vector(rest, angle, graph);
            let Some((arm, others)) = turned else {
                continue;
            };
            rest = others;
            let angle = self.position(angle);
            let radius = self.enclosure(angle).radius;
            let (length, stretched) = (self.length_of(arm), self.components_motion(arm));
            let longest = self.graph().add(length, stretched);
            parts.push(self.graph().multiply(longest, radius));
            parts.push(stretched);
        }
        parts.push(self.components_motion(rest));
        self.graph().sum(&parts)
    }

    /// How far a vector goes at most, component by component.
    fn components_motion(&mut self, vector: Vector) -> ExprId {
        let [x, y] = vector.map(|part| self.enclosure(part).radius);
        self.graph().add(x, y)
    }

    /// By how much a link changes its length, and twice as much where it may turn in its body by that.
    fn stretch_of(&mut self, link: Vector) -> ExprId {
        let zero = self.graph().zero();
        let stretched = self.components_motion(link);
        match link.contains(&zero) {
            true => stretched,
            false => self.graph().add(stretched, stretched),
        }
    }

    /// |v|.
    fn length_of(&mut self, vector: Vector) -> ExprId {
        let zero = self.graph().zero();
        match vector {
            [x, y] if y == zero => self.graph().magnitude(x),
            [x, y] if x == zero => self.graph().magnitude(y),
            _ => {
                let square = self.dot(vector, vector);
                self.graph().sqrt(square)
            }
        }
    }

    /// Notes how large what an unknown is computed from is, where that is known without looking.
    fn note_size(&mut self, definition: &Definition, bounds: &mut Bounds) {
        let own = &self.system.vector_form.unknowns[definition.unknown];
        let (quantity, symbol) = (own.quantity, own.position);
        let symbols = self.system.mechanism.graph.symbols(definition.value);
        let mut roles = symbols.iter().map(|it| self.system.roles[it.index()]);
        let is_driven =
            roles.any(|role| matches!(role, SymbolRole::Time | SymbolRole::Input { .. }));
        if quantity != Quantity::Angle && !is_driven {
            let value = self.undriven(definition.value);
            let size = self.size_of(value, bounds);
            bounds.sizes.insert(symbol, size);
        }
    }

    /// An expression without what only derivatives need of drivers.
    fn undriven(&mut self, expr: ExprId) -> ExprId {
        let shifts = self.derivatives.shifts();
        self.without(expr, &shifts)
    }

    /// How large the values are that an expression is computed from, one after another, together.
    fn size_of(&mut self, expr: ExprId, bounds: &Bounds) -> ExprId {
        let graph = &mut self.system.mechanism.graph;
        if graph.is_constant(expr) {
            let value = graph.constant_value(expr).unwrap_or(f64::NAN).abs();
            return graph.number(Number::float(value));
        }
        match graph.node(expr).clone() {
            Node::Sum(terms) => {
                let sizes: Vec<ExprId> = terms
                    .iter()
                    .map(|term| {
                        let size = self.size_of(term.expr, bounds);
                        let coefficient = match term.coefficient.is_negative() {
                            true => term.coefficient.neg(),
                            false => term.coefficient,
                        };
                        self.graph().scale(coefficient, size)
                    })
                    .collect();
                self.graph().sum(&sizes)
            }
            Node::Symbol(symbol) => {
                if let Some(&size) = bounds.sizes.get(&symbol) {
                    return size;
                }
                if let SymbolRole::Arm(place) = self.system.roles[symbol.index()] {
                    let local = self.system.vector_form.arms[place].local;
                    let length = self.length_of(local);
                    return self.size_of(length, bounds);
                }
                self.graph().magnitude(expr)
            }
            _ => graph.magnitude(expr),
        }
    }
}
