//! Estimates the length of printed expressions, in characters.
//!
//! A shared part counts at each occurrence, so the length may be astronomical. Each node of the graph is nevertheless visited
//! once, and the length saturates. Printers use the estimate first, and print a decimal value or a name for a constant that is
//! not short. The estimate counts digits, signs and names of functions, for any notation.

use super::graph::Graph;
use super::hashing::BuildExprHasher;
use super::node::{ExprId, Factor, Node, Term};
use super::number::Number;
use super::rational::Rational;
use std::cell::Cell;
use std::collections::{HashMap, HashSet};

/// Maximum length of a constant printed exactly, in characters: `sqrt(3)/2`, `0.125*sqrt(17)`, `pi/6 + atan2(3, 4)`.
pub const MAX_EXACT_LENGTH: u64 = 32;

/// Length of a name, in characters.
const NAME: u64 = 8;

impl Graph {
    /// Returns the approximate number of characters of the whole expression.
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

    /// True if an expression is printed exactly; a constant that is not short has a decimal value or a name.
    pub fn is_short(&self, expr: ExprId) -> bool {
        self.is_written_within(expr, MAX_EXACT_LENGTH)
    }

    /// True if the whole expression has at most so many characters. The search stops beyond them.
    pub fn is_written_within(&self, expr: ExprId, characters: u64) -> bool {
        self.is_within_with_names(expr, characters, &|_| false)
    }

    /// True if the expression has at most so many characters, with names for the parts that `has_name` selects.
    pub fn is_within_with_names(
        &self,
        expr: ExprId,
        characters: u64,
        has_name: &dyn Fn(ExprId) -> bool,
    ) -> bool {
        self.length_within(expr, &Cell::new(characters), has_name) <= characters
    }

    /// Returns the length of an expression, or the maximum of the type if more than `left` nodes would be visited, each of at
    /// least one character.
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

    /// True if the sum of these terms has at most so many characters.
    pub fn is_sum_within(&self, terms: &[Term], characters: u64) -> bool {
        let left = Cell::new(characters);
        let of = |operand| self.length_within(operand, &left, &|_| false);
        let lengths = terms.iter().map(|term| self.term_length(term, &of));
        lengths.fold(0, u64::saturating_add) <= characters
    }

    /// True if the product of a number and these powers has at most so many characters.
    pub fn is_product_within(&self, number: Number, factors: &[Factor], characters: u64) -> bool {
        let left = Cell::new(characters);
        let of = |operand| self.length_within(operand, &left, &|_| false);
        let lengths = factors.iter().map(|factor| self.factor_length(factor, &of));
        lengths.fold(number_length(number.absolute()), u64::saturating_add) <= characters
    }

    /// Returns the length of a node, given the lengths of its operands.
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

    /// Returns the length of ` + 3*x`: sign, coefficient and expression.
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

    /// Returns the length of `*(x + y)^2`: sign between factors, parentheses and exponent.
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

/// Returns the length of a number without its sign.
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

/// Returns the length as a decimal with few digits, otherwise as a fraction.
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
