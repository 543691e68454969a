//! Counts of arithmetic operations.

use std::ops::AddAssign;

use super::addends::{Addend, Power};
use crate::expr::{ExprId, Graph, Node};

/// How many operations a piece of straight-line code takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    /// Additions and subtractions.
    pub additions: usize,
    /// Multiplications.
    pub multiplications: usize,
    /// Divisions.
    pub divisions: usize,
    /// Square roots.
    pub square_roots: usize,
    /// Sines and cosines.
    pub sines: usize,
    /// Arctangents.
    pub arctangents: usize,
    /// Exponentials, logarithms and general powers.
    pub exponentials: usize,
    /// Choices between two values.
    pub choices: usize,
    /// Whole parts of numbers.
    pub whole_parts: usize,
    /// Places found in tables.
    pub lookups: usize,
}

impl AddAssign for Operations {
    fn add_assign(&mut self, other: Operations) {
        self.additions += other.additions;
        self.multiplications += other.multiplications;
        self.divisions += other.divisions;
        self.square_roots += other.square_roots;
        self.sines += other.sines;
        self.arctangents += other.arctangents;
        self.exponentials += other.exponentials;
        self.choices += other.choices;
        self.whole_parts += other.whole_parts;
        self.lookups += other.lookups;
    }
}

impl std::fmt::Display for Operations {
    /// `12 additions, 1 square root`; `none` for none.
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let counts = [
            (self.additions, "addition", "additions"),
            (self.multiplications, "multiplication", "multiplications"),
            (self.divisions, "division", "divisions"),
            (self.square_roots, "square root", "square roots"),
            (self.sines, "sine or cosine", "sines and cosines"),
            (self.arctangents, "arctangent", "arctangents"),
            (self.exponentials, "exponential", "exponentials"),
            (self.choices, "choice", "choices"),
            (self.whole_parts, "whole part", "whole parts"),
            (self.lookups, "table lookup", "table lookups"),
        ];
        let parts: Vec<String> = counts
            .into_iter()
            .filter(|(count, ..)| *count > 0)
            .map(|(count, one, several)| {
                format!("{count} {}", if count == 1 { one } else { several })
            })
            .collect();
        formatter.write_str(if parts.is_empty() { "none" } else { "" })?;
        formatter.write_str(&parts.join(", "))
    }
}

impl Operations {
    /// All of them.
    pub fn total(&self) -> usize {
        let arithmetic = self.additions + self.multiplications + self.divisions + self.square_roots;
        let functions = self.sines + self.arctangents + self.exponentials + self.whole_parts;
        arithmetic + functions + self.choices + self.lookups
    }

    /// Whether one of them is a function of the runtime's elementary functions.
    pub fn calls_math(&self) -> bool {
        let functions = self.sines + self.arctangents + self.exponentials + self.whole_parts;
        functions + self.square_roots > 0
    }

    /// What the addends of one expression take, its operands not counted.
    pub(super) fn of_addends(addends: &[Addend]) -> Operations {
        let mut operations = Operations {
            additions: addends.len().saturating_sub(1),
            ..Operations::default()
        };
        for addend in addends {
            let above =
                operations.product(&addend.factors) + usize::from(addend.constant.is_some());
            operations.multiplications += above.saturating_sub(1);
            if !addend.divisors.is_empty() {
                let below = operations.product(&addend.divisors);
                operations.multiplications += below.saturating_sub(1);
                operations.divisions += 1;
            }
        }
        operations
    }

    /// Counts what the powers take for themselves and returns how many factors are multiplied.
    fn product(&mut self, powers: &[Power]) -> usize {
        let mut factors = 0;
        for Power { exponent, .. } in powers {
            match (exponent.numerator(), exponent.denominator()) {
                (whole, 1) if whole <= LARGEST_PRODUCT => factors += whole.unsigned_abs() as usize,
                (1, 2) => {
                    self.square_roots += 1;
                    factors += 1;
                }
                _ => {
                    self.exponentials += 1;
                    factors += 1;
                }
            }
        }
        factors
    }

    /// What a function takes, its argument not counted.
    pub(super) fn of_function(node: &Node) -> Operations {
        let mut operations = Operations::default();
        match node {
            Node::Sin(_) | Node::Cos(_) => operations.sines = 1,
            Node::Atan2(..) => operations.arctangents = 1,
            Node::Exp(_) | Node::Ln(_) => operations.exponentials = 1,
            Node::Floor(_) => operations.whole_parts = 1,
            Node::Choose { .. } => operations.choices = 1,
            Node::Spline { .. } => operations.lookups = 1,
            Node::Number(_) | Node::Pi | Node::Symbol(_) | Node::Sum(_) | Node::Product(_) => {}
        }
        operations
    }
}

/// Powers up to this one are written as products.
pub const LARGEST_PRODUCT: i128 = 8;

/// Whether an expression is a function call, which always gets a name.
pub(super) fn is_function(node: &Node) -> bool {
    matches!(
        node,
        Node::Sin(_)
            | Node::Cos(_)
            | Node::Atan2(..)
            | Node::Exp(_)
            | Node::Ln(_)
            | Node::Floor(_)
            | Node::Choose { .. }
            | Node::Spline { .. }
    )
}

/// What an expression is written with: its operands, but a condition is taken apart into the terms it compares.
pub(super) fn written_operands(expr: ExprId, graph: &Graph) -> Vec<ExprId> {
    match *graph.node(expr) {
        Node::Choose {
            condition,
            below,
            otherwise,
        } => {
            let mut operands = match graph.node(condition) {
                Node::Sum(terms) => terms.iter().map(|term| term.expr).collect(),
                _ => vec![condition],
            };
            operands.extend([below, otherwise]);
            operands
        }
        _ => graph.operands(expr),
    }
}

/// Whether an expression is a variable read from the inputs.
pub(super) fn is_symbol(expr: ExprId, graph: &Graph) -> bool {
    matches!(graph.node(expr), Node::Symbol(_))
}
