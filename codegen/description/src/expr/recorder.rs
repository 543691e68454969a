//! Writes the code that computes expressions of a graph, each node once and operands first.
//!
//! The order of operations is the graph's, not that of generated code: a recorder serves what the generator itself evaluates.

use std::collections::{HashMap, HashSet};

use super::assembler::Assembler;
use super::code::{Code, Computation, Register};
use super::graph::Graph;
use super::hashing::BuildExprHasher;
use super::node::{ExprId, Factor, Node, SymbolId, Term};
use super::rational::Rational;

/// Writes the code of expressions.
#[derive(Clone, Debug)]
pub struct Recorder<'a> {
    assembler: Assembler<'a>,
    recorded: HashMap<ExprId, Register, BuildExprHasher>,
}

impl<'a> Recorder<'a> {
    /// Code without instructions.
    pub fn new(graph: &'a Graph) -> Recorder<'a> {
        Recorder {
            assembler: Assembler::new(graph),
            recorded: HashMap::default(),
        }
    }

    fn graph(&self) -> &'a Graph {
        self.assembler.graph()
    }

    /// Symbols of the recorded expressions, in the order of their first use, with the registers that the caller has to write.
    pub fn symbols(&self) -> &[(SymbolId, Register)] {
        self.assembler.unbound()
    }

    /// Returns the recorded code.
    pub fn finish(self) -> Code {
        self.assembler.finish()
    }

    /// Records the scale of a residual: the sum of the absolute values of an expression's terms. An expression that is not a sum has one
    /// term.
    pub fn magnitude(&mut self, expr: ExprId) -> Register {
        let terms = match self.graph().node(expr) {
            Node::Sum(terms) => terms
                .iter()
                .map(|it| (it.coefficient.to_f64().abs(), it.expr))
                .collect(),
            _ => vec![(1.0, expr)],
        };
        let mut sum = None;
        for (coefficient, term) in terms {
            let value = self.value(term);
            let size = self.assembler.write(Computation::Magnitude(value));
            let scaled = self.scaled(coefficient, size);
            sum = Some(match sum {
                Some(sum) => self.assembler.write(Computation::Add([sum, scaled])),
                None => scaled,
            });
        }
        sum.unwrap_or_else(|| self.assembler.constant(0.0))
    }

    /// Records the parts of an expression that are not recorded yet. Returns its register.
    pub fn value(&mut self, expr: ExprId) -> Register {
        if let Some(&register) = self.recorded.get(&expr) {
            return register;
        }
        let order = self.missing(expr);
        // The sine and the cosine of one angle are computed together.
        let mut waves: HashMap<ExprId, [Option<ExprId>; 2], BuildExprHasher> = HashMap::default();
        for &expr in &order {
            match *self.graph().node(expr) {
                Node::Sin(angle) => waves.entry(angle).or_default()[0] = Some(expr),
                Node::Cos(angle) => waves.entry(angle).or_default()[1] = Some(expr),
                _ => {}
            }
        }
        for &expr in &order {
            if self.recorded.contains_key(&expr) {
                continue;
            }
            match *self.graph().node(expr) {
                Node::Sin(angle) | Node::Cos(angle)
                    if waves[&angle].iter().all(Option::is_some) =>
                {
                    let both = self.assembler.sine_cosine(self.recorded[&angle]);
                    for (wave, register) in waves[&angle].into_iter().flatten().zip(both) {
                        self.recorded.insert(wave, register);
                    }
                }
                _ => {
                    let register = self.node(expr);
                    self.recorded.insert(expr, register);
                }
            }
        }
        self.recorded[&expr]
    }

    /// Unrecorded operands of an expression, in the order of ids: operands have smaller ids than what uses them.
    fn missing(&self, expr: ExprId) -> Vec<ExprId> {
        let mut seen: HashSet<ExprId, BuildExprHasher> = HashSet::default();
        let mut order = Vec::new();
        let mut open = vec![expr];
        while let Some(expr) = open.pop() {
            if self.recorded.contains_key(&expr) || !seen.insert(expr) {
                continue;
            }
            order.push(expr);
            open.extend(self.graph().operands(expr));
        }
        order.sort_unstable();
        order
    }

    /// A node whose operands are recorded.
    fn node(&mut self, expr: ExprId) -> Register {
        let graph = self.graph();
        let of = |expr: &ExprId| self.recorded[expr];
        match graph.node(expr) {
            Node::Number(value) => self.assembler.constant(value.to_f64()),
            Node::Pi => self.assembler.constant(std::f64::consts::PI),
            Node::Symbol(symbol) => self.assembler.symbol(*symbol),
            Node::Sum(terms) => self.sum(terms),
            Node::Product(factors) => self.product(factors),
            Node::Sin(angle) => {
                let angle = of(angle);
                self.assembler.write(Computation::Sine(angle))
            }
            Node::Cos(angle) => {
                let angle = of(angle);
                self.assembler.write(Computation::Cosine(angle))
            }
            Node::Atan2(y, x) => {
                let both = [of(y), of(x)];
                self.assembler.write(Computation::Arctangent(both))
            }
            Node::Exp(exponent) => {
                let exponent = of(exponent);
                self.assembler.write(Computation::Exponential(exponent))
            }
            Node::Ln(argument) => {
                let argument = of(argument);
                self.assembler.write(Computation::Logarithm(argument))
            }
            Node::Floor(argument) => {
                let argument = of(argument);
                self.assembler.write(Computation::Floor(argument))
            }
            Node::Choose {
                condition,
                below,
                otherwise,
            } => {
                let all = [condition, below, otherwise].map(of);
                self.assembler.write(Computation::Choose(all))
            }
            Node::Spline {
                spline,
                order,
                argument,
            } => {
                let argument = of(argument);
                let spline = self.assembler.spline(*spline);
                self.assembler
                    .write(Computation::Spline(argument, spline, *order))
            }
        }
    }

    fn scaled(&mut self, coefficient: f64, register: Register) -> Register {
        if coefficient == 1.0 {
            return register;
        }
        let factor = self.assembler.constant(coefficient);
        self.assembler
            .write(Computation::Multiply([factor, register]))
    }

    /// From the first term to the last.
    fn sum(&mut self, terms: &[Term]) -> Register {
        let mut sum = None;
        for term in terms {
            let value = self.recorded[&term.expr];
            let coefficient = term.coefficient.to_f64();
            sum = Some(match sum {
                None => self.scaled(coefficient, value),
                Some(sum) if coefficient == -1.0 => {
                    self.assembler.write(Computation::Subtract([sum, value]))
                }
                Some(sum) => {
                    let value = self.scaled(coefficient, value);
                    self.assembler.write(Computation::Add([sum, value]))
                }
            });
        }
        sum.unwrap_or_else(|| self.assembler.constant(0.0))
    }

    /// The factors with positive exponents over those with negative ones: one division, and one rounding less per quotient.
    fn product(&mut self, factors: &[Factor]) -> Register {
        let [above, below] = [false, true].map(|is_divisor| {
            let factors = factors
                .iter()
                .filter(|it| it.exponent.is_negative() == is_divisor);
            let mut product = None;
            for factor in factors {
                let value = self.power(self.recorded[&factor.base], factor.exponent.absolute());
                product = Some(match product {
                    Some(product) => self
                        .assembler
                        .write(Computation::Multiply([product, value])),
                    None => value,
                });
            }
            product
        });
        let above = above.unwrap_or_else(|| self.assembler.constant(1.0));
        match below {
            Some(below) => self.assembler.write(Computation::Divide([above, below])),
            None => above,
        }
    }

    fn power(&mut self, base: Register, exponent: Rational) -> Register {
        match (exponent.numerator(), exponent.denominator()) {
            (1, 1) => base,
            (2, 1) => self.assembler.write(Computation::Multiply([base, base])),
            (1, 2) => self.assembler.write(Computation::SquareRoot(base)),
            (odd, 2) => match Rational::new(odd / 2, 1) {
                Some(whole) => {
                    let whole = self.power(base, whole);
                    let root = self.assembler.write(Computation::SquareRoot(base));
                    self.assembler.write(Computation::Multiply([whole, root]))
                }
                None => self.assembler.constant(f64::NAN),
            },
            _ => {
                let number = self.assembler.exponent(exponent);
                self.assembler
                    .write(Computation::RationalPower(base, number))
            }
        }
    }
}
