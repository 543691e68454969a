//! Bounds the motion of vectors between pins over a window, and the magnitudes that determine rounding.
//!
//! Terms that one angle rotates are bounded together, and definitions replace the unknowns that they define.

use std::collections::{HashMap, HashSet};

use super::builder::Builder;
use super::passes::enclosure::Enclosure;
use super::two_links::Course;
use crate::expr::{ExprId, Node, Number, Rational, SymbolId};
use crate::joint::Quantity;
use crate::joint::geometry::Vector;
use crate::pool::SymbolRole;
use crate::structure::Definition;

/// Bound on arc over chord, for arcs up to the largest turn: 1.5/(2 sin 0.75) is 1.1003.
const ARC: (i64, i64) = (9, 8);

/// Knowledge of values besides their bounds.
#[derive(Default)]
pub(super) struct Known {
    /// Magnitudes of the terms of unknowns that follow from rotated vectors and constants.
    pub sizes: HashMap<SymbolId, ExprId>,
    /// Deviation from the chord of the end of a vector of length 1, by the angle that rotates it.
    pub arm_deviations: HashMap<usize, ExprId>,
    /// Unknowns that links move.
    pub linked: HashSet<usize>,
    /// True if enough pairs are in series for following courses.
    pub is_row: bool,
    /// Courses of angles over the window, if courses are followed.
    pub courses: HashMap<usize, Course>,
}

impl Builder<'_> {
    /// True if links move an expression.
    pub(super) fn is_linked(&self, expr: ExprId, known: &Known) -> bool {
        let symbols = self.pool.graph.symbols(expr).iter();
        let mut moving = symbols.filter_map(|&symbol| self.moving(symbol));
        moving.any(|unknown| known.linked.contains(&unknown))
    }

    /// Bounds the change, along the chord, of a value that frames keep.
    pub(super) fn change_of(&mut self, value: ExprId) -> ExprId {
        let last = self.pool.in_last_frame(value);
        let moved = self.graph().subtract(value, last);
        let moved = self.graph().magnitude(moved);
        let stretch = self.paths.window.steps;
        let stretch = self.graph().variable(stretch);
        self.graph().multiply(stretch, moved)
    }

    /// Bounds the change of an angle that follows from its cosine and sine, with rounding.
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

    /// Names a bound.
    pub(super) fn bounded(&mut self, name: &str, value: ExprId) -> ExprId {
        let graph = &self.pool.graph;
        if graph.is_constant(value) || matches!(graph.node(value), Node::Symbol(_)) {
            return value;
        }
        self.path_geometry(&[value]);
        let symbol = self.pool.intermediate(name);
        self.assign(symbol, value);
        self.graph().variable(symbol)
    }

    /// Bounds the change of a vector: terms of one angle together, then all others.
    pub(super) fn motion_of(&mut self, vector: Vector, known: &mut Known) -> Enclosure {
        let angles = self.angles_in(vector);
        let remainder = self.paths.window.remainder;
        let remainder = self.graph().variable(remainder);
        let (mut rest, mut radii, mut deviations) = (vector, Vec::new(), Vec::new());
        for angle in angles {
            let turned = self.pool.turned_vector(rest, angle);
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

    /// Returns the angles that rotate terms of a vector.
    pub(super) fn angles_in(&self, vector: Vector) -> Vec<usize> {
        let mut angles: Vec<usize> = Vec::new();
        for part in vector {
            for symbol in self.pool.graph.symbols(part) {
                if let SymbolRole::Arm(place) = self.pool.role(*symbol) {
                    angles.push(self.pool.arms()[place].angle);
                }
            }
        }
        angles.sort_unstable();
        angles.dedup();
        angles
    }

    /// Bounds the change of a vector by components.
    pub(super) fn components(&mut self, vector: Vector) -> Enclosure {
        let [x, y] = vector.map(|part| self.enclosure(part));
        Enclosure {
            radius: self.graph().add(x.radius, y.radius),
            deviation: self.graph().add(x.deviation, y.deviation),
        }
    }

    /// Returns |v|.
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

    /// Records the magnitude of the terms of an unknown, if its definition shows the magnitude.
    pub(super) fn note_size(&mut self, definition: &Definition, known: &mut Known) {
        let unknown = &self.system.vector_form.unknowns[definition.unknown];
        let (quantity, symbol) = (unknown.quantity, unknown.position);
        let symbols = self.pool.graph.symbols(definition.value);
        let mut roles = symbols.iter().map(|it| self.pool.role(*it));
        let is_driven =
            roles.any(|role| matches!(role, SymbolRole::Time | SymbolRole::Input { .. }));
        if quantity != Quantity::Angle && !is_driven {
            let value = self.undriven(definition.value);
            let size = self.size_of(value, known);
            known.sizes.insert(symbol, size);
        }
    }

    /// Returns an expression without driver terms that only derivatives need.
    pub(super) fn undriven(&mut self, expr: ExprId) -> ExprId {
        match &self.derivatives.shifts()[..] {
            [] => expr,
            shifts => self.without(expr, shifts),
        }
    }

    /// Returns the sum of the magnitudes of all values from which an expression is computed.
    pub(super) fn size_of(&mut self, expr: ExprId, known: &mut Known) -> ExprId {
        let graph = &mut self.pool.graph;
        if graph.is_constant(expr) {
            // The next power of two is short, and a rounding bound may be generous.
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
                if let SymbolRole::Arm(place) = self.pool.role(symbol) {
                    let local = self.pool.arms()[place].local;
                    let length = self.length_of(local);
                    return self.size_of(length, known);
                }
                self.graph().magnitude(expr)
            }
            _ => graph.magnitude(expr),
        }
    }
}
