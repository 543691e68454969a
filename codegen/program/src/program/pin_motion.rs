//! Vectors between pins, and what frames hold → how far they go over a window, and how large what they are computed from is.
//!
//! What turns with one angle goes together, and a definition stands for what it defines. Deliberately unknown here: what is shown by it.

use std::collections::{HashMap, HashSet};

use super::builder::Builder;
use super::passes::enclosure::Enclosure;
use super::two_links::Course;
use crate::expr::{ExprId, Node, Number, Rational, SymbolId};
use crate::joint::Quantity;
use crate::joint::geometry::Vector;
use crate::structure::Definition;
use crate::system::SymbolRole;

/// How much longer an arc may be than its chord where it is no more than the largest turn: 1.5/(2 sin 0.75) is 1.1003.
const ARC: (i64, i64) = (9, 8);

/// What is known of values beside how far they go.
#[derive(Default)]
pub(super) struct Known {
    /// How large what unknowns are computed from is, of those that follow from arms and constants.
    pub sizes: HashMap<SymbolId, ExprId>,
    /// How far the end of an arm of length 1 is from a straight line, by the angle that turns it.
    pub arm_deviations: HashMap<usize, ExprId>,
    /// The unknowns that links move.
    pub linked: HashSet<usize>,
    /// True if so many pairs stand in a row that courses are followed.
    pub is_row: bool,
    /// How angles run over the window, where courses are followed.
    pub courses: HashMap<usize, Course>,
}

impl Builder<'_> {
    /// Whether links move an expression.
    pub(super) fn is_linked(&self, expr: ExprId, known: &Known) -> bool {
        let symbols = self.system.mechanism.graph.symbols(expr).iter();
        let mut moving = symbols.filter_map(|&symbol| self.moving(symbol));
        moving.any(|unknown| known.linked.contains(&unknown))
    }

    /// How far a value that frames hold goes along the line.
    pub(super) fn change_of(&mut self, value: ExprId) -> ExprId {
        let last = self.system.in_last_frame(value);
        let moved = self.graph().subtract(value, last);
        let moved = self.graph().magnitude(moved);
        let stretch = self.paths.window.steps;
        let stretch = self.graph().variable(stretch);
        self.graph().multiply(stretch, moved)
    }

    /// The same of an angle that is found by its cosine and its sine, and rounding.
    pub(super) fn change_of_angle(&mut self, angle: usize) -> ExprId {
        let rounding = self.paths.window.rounding;
        let rounding = self.graph().variable(rounding);
        let Some(&direction) = self.paths.directions.get(&angle) else {
            let angle = self.position(angle);
            let size = self.graph().magnitude(angle);
            let rounding = self.graph().multiply(rounding, size);
            let change = self.change_of(angle);
            return self.graph().add(change, rounding);
        };
        let changes = direction.map(|part| {
            let part = self.graph().variable(part);
            self.change_of(part)
        });
        let chord = self.graph().add(changes[0], changes[1]);
        let arc = self.graph().rational(ARC.0, ARC.1);
        let arc = self.graph().multiply(arc, chord);
        self.graph().add(arc, rounding)
    }

    /// A name for a bound.
    pub(super) fn bounded(&mut self, name: &str, value: ExprId) -> ExprId {
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
    pub(super) fn motion_of(&mut self, vector: Vector, known: &mut Known) -> Enclosure {
        let angles = self.angles_in(vector);
        let remainder = self.paths.window.remainder;
        let remainder = self.graph().variable(remainder);
        let (mut rest, mut radii, mut deviations) = (vector, Vec::new(), Vec::new());
        for angle in angles {
            let graph = &mut self.system.mechanism.graph;
            let turned = self.system.vector_form.turned_vector(rest, angle, graph);
            let Some((arm, others)) = turned else {
                continue;
            };
            rest = others;
            let (symbol, name) = (
                self.position(angle),
                format!("{}_arm_deviation", self.system.unknown_name(angle)),
            );
            let Enclosure { radius, deviation } = self.enclosure(symbol);
            let deviation = match known.arm_deviations.get(&angle) {
                Some(&arm_deviation) => arm_deviation,
                None => {
                    let curved = self.graph().product(&[remainder, radius, radius]);
                    let arm_deviation = self.graph().add(deviation, curved);
                    let arm_deviation = self.bounded(&name, arm_deviation);
                    known.arm_deviations.insert(angle, arm_deviation);
                    arm_deviation
                }
            };
            let (length, own) = (self.length_of(arm), self.components(arm));
            let longest = self.graph().add(length, own.radius);
            let crossed = self.graph().product(&[remainder, radius, own.radius]);
            let parts = [
                [longest, deviation],
                [own.deviation, deviation],
                [longest, radius],
            ];
            let [turned, both, moved] = parts.map(|both| self.graph().product(&both));
            radii.extend([moved, own.radius]);
            deviations.extend([turned, own.deviation, both, crossed, crossed]);
        }
        let rest = self.components(rest);
        radii.push(rest.radius);
        deviations.push(rest.deviation);
        Enclosure {
            radius: self.graph().sum(&radii),
            deviation: self.graph().sum(&deviations),
        }
    }

    /// The angles that turn arms in a vector.
    pub(super) fn angles_in(&self, vector: Vector) -> Vec<usize> {
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
        angles
    }

    /// How far a vector goes at most, component by component.
    pub(super) fn components(&mut self, vector: Vector) -> Enclosure {
        let [x, y] = vector.map(|part| self.enclosure(part));
        Enclosure {
            radius: self.graph().add(x.radius, y.radius),
            deviation: self.graph().add(x.deviation, y.deviation),
        }
    }

    /// |v|.
    pub(super) fn length_of(&mut self, vector: Vector) -> ExprId {
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
    pub(super) fn note_size(&mut self, definition: &Definition, known: &mut Known) {
        let own = &self.system.vector_form.unknowns[definition.unknown];
        let (quantity, symbol) = (own.quantity, own.position);
        let symbols = self.system.mechanism.graph.symbols(definition.value);
        let mut roles = symbols.iter().map(|it| self.system.roles[it.index()]);
        let is_driven =
            roles.any(|role| matches!(role, SymbolRole::Time | SymbolRole::Input { .. }));
        if quantity != Quantity::Angle && !is_driven {
            let value = self.undriven(definition.value);
            let size = self.size_of(value, known);
            known.sizes.insert(symbol, size);
        }
    }

    /// An expression without what only derivatives need of drivers.
    pub(super) fn undriven(&mut self, expr: ExprId) -> ExprId {
        match &self.derivatives.shifts()[..] {
            [] => expr,
            shifts => self.without(expr, shifts),
        }
    }

    /// How large the values are that an expression is computed from, one after another, together.
    pub(super) fn size_of(&mut self, expr: ExprId, known: &mut Known) -> ExprId {
        let graph = &mut self.system.mechanism.graph;
        if graph.is_constant(expr) {
            // The next power of two reads well, and who rounds may be generous.
            let value = graph.constant_value(expr).unwrap_or(f64::NAN).abs();
            let value = if value > 0.0 {
                value.log2().ceil().exp2()
            } else {
                value
            };
            return graph.number(Number::float(value));
        }
        match graph.node(expr).clone() {
            Node::Sum(terms) => {
                let sizes: Vec<ExprId> = terms
                    .iter()
                    .map(|term| {
                        let size = self.size_of(term.expr, known);
                        let coefficient = match term.coefficient.is_negative() {
                            true => term.coefficient.neg(),
                            false => term.coefficient,
                        };
                        self.graph().scale(coefficient, size)
                    })
                    .collect();
                self.graph().sum(&sizes)
            }
            Node::Sin(_) | Node::Cos(_) => graph.one(),
            Node::Product(factors) if factors.iter().all(|it| it.exponent == Rational::ONE) => {
                let factors: Vec<ExprId> = factors
                    .iter()
                    .map(|factor| self.size_of(factor.base, known))
                    .collect();
                self.graph().product(&factors)
            }
            Node::Symbol(symbol) => {
                if let Some(&size) = known.sizes.get(&symbol) {
                    return size;
                }
                if let SymbolRole::Arm(place) = self.system.roles[symbol.index()] {
                    let local = self.system.vector_form.arms[place].local;
                    let length = self.length_of(local);
                    return self.size_of(length, known);
                }
                self.graph().magnitude(expr)
            }
            _ => graph.magnitude(expr),
        }
    }
}
