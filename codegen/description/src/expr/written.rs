//! How long an expression is when it is written out: *an expression* → *about how many characters a person needs for it*.
//!
//! The length counts what is shared as often as it is written, so it may be astronomic; it is found on the graph all the same, each
//! node once, and saturates. A printer asks for it before it writes anything out, and for a constant that is not short it writes
//! the decimal value or a name. This file does not know notations: it counts digits, signs and the names of functions.

use super::graph::Graph;
use super::hashing::BuildExprHasher;
use super::node::{ExprId, Factor, Node, Term};
use super::number::Number;
use super::rational::Rational;
use std::cell::Cell;
use std::collections::{HashMap, HashSet};

/// What a person still writes exactly, in characters: `sqrt(3)/2`, `0.125*sqrt(17)`, `pi/6 + atan2(3, 4)`.
pub const SHORT: u64 = 32;

/// The characters of a name.
const NAME: u64 = 8;

impl Graph {
    /// About how many characters the expression takes when it is written out whole.
    pub fn written_length(&self, expr: ExprId) -> u64 {
        let mut needed: HashSet<ExprId, BuildExprHasher> = HashSet::default();
        let mut stack = vec![expr];
        while let Some(expr) = stack.pop() {
            if needed.insert(expr) {
                self.node(expr).each_operand(|operand| stack.push(operand));
            }
        }
        let mut order: Vec<ExprId> = needed.into_iter().collect();
        order.sort_unstable();
        let mut lengths: HashMap<ExprId, u64, BuildExprHasher> = HashMap::default();
        for &expr in &order {
            let length = self.length_of(self.node(expr), &|operand| lengths[&operand]);
            lengths.insert(expr, length);
        }
        lengths[&expr]
    }

    /// Whether a person writes an expression exactly: a constant that is not short has a decimal value or a name.
    pub fn is_short(&self, expr: ExprId) -> bool {
        self.is_written_within(expr, SHORT)
    }

    /// Whether the expression takes at most so many characters when it is written out whole. No more of it is looked at.
    pub fn is_written_within(&self, expr: ExprId, characters: u64) -> bool {
        self.is_within_with_names(expr, characters, &|_| false)
    }

    /// The same where what `has_name` is written by its name.
    pub fn is_within_with_names(
        &self,
        expr: ExprId,
        characters: u64,
        has_name: &dyn Fn(ExprId) -> bool,
    ) -> bool {
        self.length_within(expr, &Cell::new(characters), has_name) <= characters
    }

    /// The length of an expression, or the largest number there is where more than `left` nodes would have to be looked at: each
    /// of them takes at least a character.
    fn length_within(
        &self,
        expr: ExprId,
        left: &Cell<u64>,
        has_name: &dyn Fn(ExprId) -> bool,
    ) -> u64 {
        let node = self.node(expr);
        if left.get() < node.size() as u64 {
            return u64::MAX;
        }
        left.set(left.get().saturating_sub(1));
        let of = |operand| match has_name(operand) {
            true => NAME,
            false => self.length_within(operand, left, has_name),
        };
        self.length_of(node, &of)
    }

    /// The same for the sum of these terms.
    pub fn is_sum_within(&self, terms: &[Term], characters: u64) -> bool {
        let left = Cell::new(characters);
        let of = |operand| self.length_within(operand, &left, &|_| false);
        let lengths = terms.iter().map(|term| self.term_length(term, &of));
        lengths.fold(0, u64::saturating_add) <= characters
    }

    /// The same for a number times these powers.
    pub fn is_product_within(&self, number: Number, factors: &[Factor], characters: u64) -> bool {
        let left = Cell::new(characters);
        let of = |operand| self.length_within(operand, &left, &|_| false);
        let lengths = factors.iter().map(|factor| self.factor_length(factor, &of));
        lengths.fold(number_length(number.absolute()), u64::saturating_add) <= characters
    }

    /// The length of a node whose operands' lengths are known.
    fn length_of(&self, node: &Node, of: &dyn Fn(ExprId) -> u64) -> u64 {
        let call = |name: u64, arguments: &[ExprId]| {
            let arguments = arguments
                .iter()
                .map(|&argument| of(argument).saturating_add(2));
            arguments.fold(name, u64::saturating_add)
        };
        match node {
            Node::Number(value) => number_length(*value),
            Node::Pi => 2,
            Node::Symbol(symbol) => self.symbol_name(*symbol).len() as u64,
            Node::Sum(terms) => terms
                .iter()
                .map(|term| self.term_length(term, of))
                .fold(0, u64::saturating_add),
            Node::Product(factors) => factors
                .iter()
                .map(|factor| self.factor_length(factor, of))
                .fold(0, u64::saturating_add),
            Node::Sin(x) | Node::Cos(x) | Node::Exp(x) => call(3, &[*x]),
            Node::Ln(x) => call(2, &[*x]),
            Node::Floor(x) => call(5, &[*x]),
            Node::Atan2(y, x) => call(5, &[*y, *x]),
            Node::Choose {
                condition,
                below,
                otherwise,
            } => call(12, &[*condition, *below, *otherwise]),
            Node::Spline {
                spline, argument, ..
            } => call(self.spline_of(*spline).name.len() as u64, &[*argument]),
        }
    }

    /// ` + 3*x`: the sign, the coefficient and what it multiplies.
    fn term_length(&self, term: &Term, of: &dyn Fn(ExprId) -> u64) -> u64 {
        let coefficient = term.coefficient.absolute();
        let (factor, whole) = (number_length(coefficient), of(term.expr));
        let written = if term.expr == self.one() {
            factor
        } else if coefficient.is_one() {
            whole
        } else {
            whole.saturating_add(factor + 1)
        };
        written.saturating_add(3)
    }

    /// `*(x + y)^2`: the sign between factors, parentheses, and the exponent.
    fn factor_length(&self, factor: &Factor, of: &dyn Fn(ExprId) -> u64) -> u64 {
        let magnitude = factor.exponent.absolute();
        let exponent = match (magnitude.numerator(), magnitude.denominator()) {
            (1, 1) => 0,
            (1, 2) => 4,
            _ => 1 + rational_length(magnitude),
        };
        let parentheses = match self.node(factor.base) {
            Node::Sum(_) | Node::Product(_) => 2,
            _ => 0,
        };
        of(factor.base).saturating_add(1 + exponent + parentheses)
    }
}

/// A number without its sign.
fn number_length(value: Number) -> u64 {
    match value {
        Number::Float(value) => format!("{:?}", value.abs()).len() as u64,
        Number::Exact { rational, radicand } => {
            let root = match radicand {
                1 => 0,
                radicand => 7 + digits(radicand),
            };
            rational_length(rational.absolute()) + root
        }
    }
}

/// As a decimal where its digits end soon, otherwise as a fraction.
fn rational_length(value: Rational) -> u64 {
    let (above, below) = (
        value.numerator().unsigned_abs(),
        value.denominator().unsigned_abs(),
    );
    let fraction = match below {
        1 => digits(above),
        _ => digits(above) + 1 + digits(below),
    };
    let places = (1..=12u32).find(|&places| 10u128.pow(places) % below == 0);
    match places {
        Some(places) if below > 1 => {
            let whole = digits(above / below);
            whole + 1 + u64::from(places)
        }
        _ => fraction,
    }
}

fn digits(value: u128) -> u64 {
    u64::from(value.checked_ilog10().unwrap_or(0)) + 1
}
