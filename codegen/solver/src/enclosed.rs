//! *Expressions, and bounds of their symbols* → *bounds of the expressions*.

use std::collections::HashMap;

use linkwright_codegen::stages::expr::{ExprId, Graph, Node, SymbolId};
use linkwright_codegen::stages::program::{Function, Statement};

use crate::interval::Interval;

/// Bounds of everything that is known.
pub(crate) struct Enclosed<'a> {
    graph: &'a Graph,
    symbols: HashMap<SymbolId, Interval>,
    // Only looked up.
    values: HashMap<ExprId, Interval>,
}

impl<'a> Enclosed<'a> {
    pub fn new(graph: &'a Graph, known: impl IntoIterator<Item = (SymbolId, Interval)>) -> Self {
        Enclosed {
            graph,
            symbols: known.into_iter().collect(),
            values: HashMap::new(),
        }
    }

    /// Goes through the statements of a function. What they would fail with is in the bounds.
    pub fn run(&mut self, function: &Function) {
        for statement in &function.statements {
            match *statement {
                Statement::Let { target, value, .. } => {
                    let value = self.value(value);
                    self.symbols.insert(target, value);
                }
                Statement::SineCosine {
                    sine,
                    cosine,
                    angle,
                } => {
                    let angle = self.value(angle);
                    self.symbols.insert(sine, angle.sine());
                    self.symbols.insert(cosine, angle.cosine());
                }
                _ => {}
            }
        }
    }

    /// The bounds of an expression; of what is not known here, and of functions that equations of links do not hold, every number.
    pub fn value(&mut self, expr: ExprId) -> Interval {
        if let Some(&known) = self.values.get(&expr) {
            return known;
        }
        let found = match self.graph.node(expr) {
            Node::Number(number) => {
                let value = number.to_f64();
                // An exact number may lie between two of the machine.
                let is_whole = value.fract() == 0.0 && number.is_rational();
                match is_whole {
                    true => Interval::point(value),
                    false => Interval::new(value.next_down(), value.next_up()),
                }
            }
            Node::Pi => {
                let pi = std::f64::consts::PI;
                Interval::new(pi, pi.next_up())
            }
            Node::Symbol(symbol) => {
                let known = self.symbols.get(symbol).copied();
                known.unwrap_or_else(Interval::undefined)
            }
            Node::Sum(terms) => {
                let mut sum = Interval::point(0.0);
                for term in terms.iter() {
                    let coefficient = term.coefficient.to_f64();
                    let coefficient =
                        match coefficient.fract() == 0.0 && term.coefficient.is_rational() {
                            true => Interval::point(coefficient),
                            false => Interval::new(coefficient.next_down(), coefficient.next_up()),
                        };
                    sum = sum.plus(coefficient.times(self.value(term.expr)));
                }
                sum
            }
            Node::Product(factors) => {
                let mut product = Interval::point(1.0);
                for factor in factors.iter() {
                    let base = self.value(factor.base);
                    let (numerator, denominator) =
                        (factor.exponent.numerator(), factor.exponent.denominator());
                    let base = match denominator {
                        1 => base,
                        2 => base.root(),
                        _ => Interval::undefined(),
                    };
                    let power = u32::try_from(numerator.unsigned_abs())
                        .map_or(Interval::undefined(), |exponent| base.power(exponent));
                    let power = match numerator < 0 {
                        true => power.reciprocal(),
                        false => power,
                    };
                    product = product.times(power);
                }
                product
            }
            Node::Sin(angle) => self.value(*angle).sine(),
            Node::Cos(angle) => self.value(*angle).cosine(),
            _ => Interval::undefined(),
        };
        self.values.insert(expr, found);
        found
    }
}
