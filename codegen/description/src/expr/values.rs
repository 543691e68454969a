//! Evaluates fixed expressions, and checks that all constants in a node are finite.
//!
//! The value of a node is computed on its creation from those of its operands, as a [`Tape`](super::Tape) does. The constants
//! of a moving sum or product are evaluated together, as in printed expressions. An infinite or undefined constant makes the
//! whole expression undefined.

use super::graph::Graph;
use super::hashing::BuildExprHasher;
use super::node::{ExprId, Factor, Node, Term};
use super::number::{Number, float_power};
use super::rational::Rational;
use linkwright_math::double;
use std::collections::HashSet;

/// Numeric value of a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Worth {
    /// True if every symbol has a nominal value.
    pub is_fixed: bool,
    /// Value of a fixed node at the nominal values; for a moving product, the product of its fixed factors; otherwise one.
    pub value: f64,
    /// True if this value and those of all operands are finite.
    pub is_sound: bool,
}

/// Worth of a moving part, which contributes no constant factor.
const MOVING: Worth = Worth {
    is_fixed: false,
    value: 1.0,
    is_sound: true,
};

fn fixed(value: f64) -> Worth {
    Worth {
        is_fixed: true,
        value,
        is_sound: true,
    }
}

impl Graph {
    pub(super) fn worth(&self, expr: ExprId) -> Worth {
        self.worths[expr.index()]
    }

    /// True if all constants in the expression are finite, and so are the values of fixed parts at the nominal values.
    pub fn is_sound(&self, expr: ExprId) -> bool {
        self.is_finite(expr) && self.worth(expr).is_sound
    }

    /// Returns the worth of a node with known operands; `None` if a constant in it is infinite or undefined. A number node may
    /// be non-finite.
    pub(super) fn worth_of(&self, node: &Node) -> Option<Worth> {
        let worth = self.marked_worth(node);
        let is_known = worth.value.is_finite() || matches!(node, Node::Number(_));
        (is_known || !self.is_undefined(node)).then_some(worth)
    }

    /// Returns the worth, including the soundness of the operands.
    fn marked_worth(&self, node: &Node) -> Worth {
        let mut worth = self.computed_worth(node);
        worth.is_sound = worth.value.is_finite();
        node.each_operand(|operand| worth.is_sound &= self.worth(operand).is_sound);
        worth
    }

    /// True if constants alone make a node undefined, for all values of the parameters.
    fn is_undefined(&self, node: &Node) -> bool {
        let is_constant = |expr: ExprId| self.is_constant(expr);
        match node {
            Node::Sum(terms) => {
                let value =
                    |term: &Term| term.coefficient.to_f64() * self.constant_factor(term.expr);
                let constants = terms.iter().filter(|term| is_constant(term.expr));
                let constants: f64 = constants.map(value).sum();
                !constants.is_finite() || terms.iter().any(|term| !value(term).is_finite())
            }
            Node::Product(factors) => {
                let constants = factors.iter().filter(|factor| is_constant(factor.base));
                !self.value_of_product(constants).is_finite()
            }
            _ => {
                let mut all = true;
                node.each_operand(|operand| all &= is_constant(operand));
                all
            }
        }
    }

    /// Returns the worth, finite or not.
    fn computed_worth(&self, node: &Node) -> Worth {
        let of = |expr: &ExprId| self.worth(*expr);
        let function = |argument: &ExprId, function: fn(f64) -> f64| match of(argument) {
            Worth {
                is_fixed: true,
                value,
                ..
            } => fixed(function(value)),
            _ => MOVING,
        };
        match node {
            Node::Number(value) => fixed(value.to_f64()),
            Node::Pi => fixed(std::f64::consts::PI),
            Node::Symbol(symbol) => self.nominal(*symbol).map_or(MOVING, fixed),
            Node::Sum(terms) => self.worth_of_sum(terms),
            Node::Product(factors) => self.worth_of_product(factors),
            Node::Sin(angle) => function(angle, double::sin),
            Node::Cos(angle) => function(angle, double::cos),
            Node::Exp(exponent) => function(exponent, double::exp),
            Node::Ln(argument) => function(argument, double::ln),
            Node::Floor(argument) => function(argument, f64::floor),
            Node::Atan2(y, x) => match (of(y), of(x)) {
                (y, x) if y.is_fixed && x.is_fixed => fixed(double::atan2(y.value, x.value)),
                _ => MOVING,
            },
            Node::Choose {
                condition,
                below,
                otherwise,
            } => {
                let [condition, below, otherwise] = [condition, below, otherwise].map(of);
                if condition.is_fixed && below.is_fixed && otherwise.is_fixed {
                    let is_below = condition.value < 0.0;
                    fixed(if is_below { below } else { otherwise }.value)
                } else {
                    MOVING
                }
            }
            Node::Spline {
                spline,
                order,
                argument,
            } => match of(argument) {
                Worth {
                    is_fixed: true,
                    value,
                    ..
                } => fixed(self.spline_of(*spline).at(value)[usize::from(*order)]),
                _ => MOVING,
            },
        }
    }

    /// The constant terms of a moving sum are printed as one number, and so are the constants of each moving term.
    fn worth_of_sum(&self, terms: &[Term]) -> Worth {
        let value_of = |term: &Term| term.coefficient.to_f64() * self.worth(term.expr).value;
        let is_fixed = |term: &&Term| self.worth(term.expr).is_fixed;
        if terms.iter().all(|term| is_fixed(&term)) {
            return fixed(terms.iter().map(value_of).sum());
        }
        // A single exact number cannot overflow a float, and most terms have the coefficient one.
        let is_short = |term: &&Term| {
            matches!(term.coefficient, Number::Exact { .. }) && self.worth(term.expr).value == 1.0
        };
        let (known, moving): (Vec<&Term>, Vec<&Term>) = terms
            .iter()
            .filter(|term| !is_short(term))
            .partition(is_fixed);
        let constants: f64 = known.into_iter().map(value_of).sum();
        if constants.is_finite() && moving.into_iter().all(|term| value_of(term).is_finite()) {
            MOVING
        } else {
            Worth {
                value: f64::NAN,
                ..MOVING
            }
        }
    }

    fn worth_of_product(&self, factors: &[Factor]) -> Worth {
        let is_fixed = |factor: &&Factor| self.worth(factor.base).is_fixed;
        Worth {
            is_fixed: factors.iter().all(|factor| is_fixed(&factor)),
            value: self.value_of_product(factors.iter().filter(is_fixed)),
            is_sound: true,
        }
    }

    fn value_of_product<'f>(&self, factors: impl Iterator<Item = &'f Factor>) -> f64 {
        let powers = factors.map(|factor| (self.worth(factor.base).value, factor.exponent));
        match quotient(powers) {
            (above, 1.0) => above,
            // A quotient by infinity is too small to be known.
            (_, below) if below.is_infinite() => f64::NAN,
            (above, below) => above / below,
        }
    }

    /// Recomputes all values after a change of a nominal value.
    pub(super) fn revalue(&mut self) {
        for place in 0..self.node_count() {
            let node = self.node(ExprId(place as u32));
            self.worths[place] = self.marked_worth(node);
        }
    }
}

/// Least and greatest magnitudes of nonzero constants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Magnitudes {
    /// Least magnitude; infinite without constants.
    pub least: f64,
    /// Greatest magnitude; zero without constants.
    pub largest: f64,
}

impl Magnitudes {
    fn take(&mut self, value: f64) {
        if value != 0.0 {
            self.least = self.least.min(value.abs());
            self.largest = self.largest.max(value.abs());
        }
    }
}

impl Graph {
    /// Returns the magnitudes of the constants in these expressions, as printed: the constants of a sum together, and those of
    /// each term. Values of parameters are not considered.
    pub fn magnitudes(&self, roots: &[ExprId]) -> Magnitudes {
        let mut magnitudes = Magnitudes {
            least: f64::INFINITY,
            largest: 0.0,
        };
        let mut seen: HashSet<ExprId, BuildExprHasher> = HashSet::default();
        let mut stack = roots.to_vec();
        while let Some(expr) = stack.pop() {
            if !seen.insert(expr) {
                continue;
            }
            if self.is_constant(expr) {
                magnitudes.take(self.worth(expr).value);
                continue;
            }
            match self.node(expr) {
                Node::Sum(terms) => {
                    let (constants, moving): (Vec<&Term>, Vec<&Term>) =
                        terms.iter().partition(|term| self.is_constant(term.expr));
                    let value =
                        |term: &Term| term.coefficient.to_f64() * self.constant_factor(term.expr);
                    magnitudes.take(constants.into_iter().map(value).sum());
                    moving
                        .into_iter()
                        .for_each(|term| magnitudes.take(value(term)));
                }
                Node::Product(_) => magnitudes.take(self.constant_factor(expr)),
                _ => {}
            }
            self.node(expr).each_operand(|operand| {
                if !self.is_constant(operand) {
                    stack.push(operand);
                }
            });
        }
        magnitudes
    }

    /// Returns a constant, or the product of the constant factors of a product.
    fn constant_factor(&self, expr: ExprId) -> f64 {
        if self.is_constant(expr) {
            return self.worth(expr).value;
        }
        let Node::Product(factors) = self.node(expr) else {
            return 1.0;
        };
        self.value_of_product(factors.iter().filter(|it| self.is_constant(it.base)))
    }
}

/// Returns the products of the factors with positive and with negative exponents. Their quotient takes one division, and has
/// one rounding less per divisor.
pub(super) fn quotient(powers: impl Iterator<Item = (f64, Rational)>) -> (f64, f64) {
    let (mut above, mut below) = (1.0, 1.0);
    for (base, exponent) in powers {
        let magnitude = exponent.absolute();
        let value = match (magnitude.numerator(), magnitude.denominator()) {
            (1, 1) => base,
            (1, 2) => base.sqrt(),
            (odd, 2) => match Rational::new(odd / 2, 1) {
                Some(whole) => float_power(base, whole) * base.sqrt(),
                None => f64::NAN,
            },
            _ => float_power(base, magnitude),
        };
        if exponent.is_negative() {
            below *= value;
        } else {
            above *= value;
        }
    }
    (above, below)
}
