//! Represents random expressions as written, and evaluates them without simplification.

use super::estimate::{Dual, Estimate};
use super::generator::Generator;
use crate::expr::{ExprId, Graph, Node, Number, Rational, SymbolId};

pub(super) const SYMBOLS: usize = 3;

#[derive(Clone, Debug)]
pub(super) enum Tree {
    Fraction(i64, i64),
    /// A square root of a whole number, times a fraction.
    Surd(i64, i64, u8),
    Pi,
    Symbol(usize),
    Unary(Function, Box<Tree>),
    Power(Box<Tree>, i32, i32),
    Binary(Operation, Box<Tree>, Box<Tree>),
    /// The second operand if the first is negative, the third otherwise.
    Choose(Box<Tree>, Box<Tree>, Box<Tree>),
}

#[derive(Clone, Copy, Debug)]
pub(super) enum Function {
    Negate,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Exp,
    Ln,
    Sqrt,
    Floor,
}

#[derive(Clone, Copy, Debug)]
pub(super) enum Operation {
    Add,
    Subtract,
    Multiply,
    Divide,
    Atan2,
}

impl Tree {
    pub(super) fn random(generator: &mut Generator, depth: u32) -> Tree {
        let boxed = |generator: &mut Generator| Box::new(Tree::random(generator, depth - 1));
        if depth == 0 || generator.below(8) == 0 {
            return Tree::leaf(generator);
        }
        match generator.below(21) {
            19 => Tree::Choose(boxed(generator), boxed(generator), boxed(generator)),
            0..=4 => Tree::Binary(Operation::Add, boxed(generator), boxed(generator)),
            5..=6 => Tree::Binary(Operation::Subtract, boxed(generator), boxed(generator)),
            7..=11 => Tree::Binary(Operation::Multiply, boxed(generator), boxed(generator)),
            12 => Tree::Binary(Operation::Divide, boxed(generator), boxed(generator)),
            13 => Tree::Binary(Operation::Atan2, boxed(generator), boxed(generator)),
            14..=15 => {
                let exponents = [
                    (2, 1),
                    (3, 1),
                    (-1, 1),
                    (-2, 1),
                    (1, 2),
                    (3, 2),
                    (-1, 2),
                    (1, 3),
                    (2, 3),
                    (1, 4),
                ];
                let (numerator, denominator) = exponents[generator.below(10) as usize];
                Tree::Power(boxed(generator), numerator, denominator)
            }
            _ => {
                let functions = [
                    Function::Negate,
                    Function::Sin,
                    Function::Sin,
                    Function::Cos,
                    Function::Cos,
                    Function::Tan,
                    Function::Asin,
                    Function::Acos,
                    Function::Atan,
                    Function::Exp,
                    Function::Ln,
                    Function::Sqrt,
                    Function::Floor,
                ];
                let function = functions[generator.below(13) as usize];
                Tree::Unary(function, boxed(generator))
            }
        }
    }

    fn leaf(generator: &mut Generator) -> Tree {
        match generator.below(8) {
            0 => Tree::Fraction(generator.within(-4, 4), generator.within(1, 6)),
            1 => Tree::Surd(
                generator.within(-3, 3),
                generator.within(1, 4),
                generator.below(13) as u8,
            ),
            2 => match generator.below(2) {
                0 => Tree::Pi,
                _ => Tree::Binary(
                    Operation::Multiply,
                    Box::new(Tree::Fraction(generator.within(-30, 30), 12)),
                    Box::new(Tree::Pi),
                ),
            },
            _ => Tree::Symbol(generator.below(SYMBOLS as u64) as usize),
        }
    }

    /// Returns the tree with its symbols replaced.
    pub(super) fn with(&self, replacements: [&Tree; SYMBOLS]) -> Tree {
        let inner = |tree: &Tree| Box::new(tree.with(replacements));
        match self {
            Tree::Symbol(place) => replacements[*place].clone(),
            Tree::Unary(function, operand) => Tree::Unary(*function, inner(operand)),
            Tree::Power(base, above, below) => Tree::Power(inner(base), *above, *below),
            Tree::Binary(operation, left, right) => {
                Tree::Binary(*operation, inner(left), inner(right))
            }
            Tree::Choose(condition, below, otherwise) => {
                Tree::Choose(inner(condition), inner(below), inner(otherwise))
            }
            leaf => leaf.clone(),
        }
    }

    /// Builds the expression with the constructors under test.
    pub(super) fn build(&self, graph: &mut Graph, symbols: &[SymbolId]) -> ExprId {
        match self {
            Tree::Fraction(numerator, denominator) => graph.rational(*numerator, *denominator),
            Tree::Surd(numerator, denominator, radicand) => {
                let scale = graph.rational(*numerator, *denominator);
                let under = graph.integer(i64::from(*radicand));
                let root = graph.sqrt(under);
                graph.multiply(scale, root)
            }
            Tree::Pi => graph.pi(),
            Tree::Symbol(place) => graph.variable(symbols[*place]),
            Tree::Power(base, numerator, denominator) => {
                let base = base.build(graph, symbols);
                let exponent = Rational::new(i128::from(*numerator), i128::from(*denominator));
                graph.power(base, exponent.expect("a written fraction"))
            }
            Tree::Unary(function, operand) => {
                let operand = operand.build(graph, symbols);
                match function {
                    Function::Negate => graph.negate(operand),
                    Function::Sin => graph.sin(operand),
                    Function::Cos => graph.cos(operand),
                    Function::Tan => graph.tan(operand),
                    Function::Asin => graph.asin(operand),
                    Function::Acos => graph.acos(operand),
                    Function::Atan => graph.atan(operand),
                    Function::Exp => graph.exp(operand),
                    Function::Ln => graph.ln(operand),
                    Function::Sqrt => graph.sqrt(operand),
                    Function::Floor => graph.floor(operand),
                }
            }
            Tree::Choose(condition, below, otherwise) => {
                let parts = [condition, below, otherwise];
                let [condition, below, otherwise] = parts.map(|part| part.build(graph, symbols));
                graph.choose(condition, below, otherwise)
            }
            Tree::Binary(operation, left, right) => {
                let left = left.build(graph, symbols);
                let right = right.build(graph, symbols);
                match operation {
                    Operation::Add => graph.add(left, right),
                    Operation::Subtract => graph.subtract(left, right),
                    Operation::Multiply => graph.multiply(left, right),
                    Operation::Divide => graph.divide(left, right),
                    Operation::Atan2 => graph.atan2(left, right),
                }
            }
        }
    }

    /// Returns the value and its derivative by the symbol at `direction`, operation by operation as written.
    pub(super) fn evaluate(&self, values: &[f64], direction: usize) -> Dual {
        let number = |value: f64| Dual::constant(Estimate::rounded(value));
        let one = Dual::constant(Estimate::exact(1.0));
        match self {
            Tree::Fraction(numerator, denominator) => {
                number(*numerator as f64 / *denominator as f64)
            }
            Tree::Surd(numerator, denominator, radicand) => {
                number(*numerator as f64 / *denominator as f64 * f64::from(*radicand).sqrt())
            }
            Tree::Pi => number(std::f64::consts::PI),
            Tree::Symbol(place) => Dual {
                value: Estimate::exact(values[*place]),
                slope: Estimate::exact(f64::from(*place == direction)),
            },
            Tree::Power(base, numerator, denominator) => base
                .evaluate(values, direction)
                .pow(*numerator, *denominator),
            Tree::Unary(function, operand) => {
                let operand = operand.evaluate(values, direction);
                let negative = |dual: Dual| Dual {
                    value: dual.value.neg(),
                    slope: dual.slope.neg(),
                };
                match function {
                    Function::Negate => negative(operand),
                    Function::Sin => operand.sin(),
                    Function::Cos => operand.cos(),
                    Function::Tan => operand.sin().mul(operand.cos().pow(-1, 1)),
                    Function::Asin => operand.asin(),
                    Function::Acos => {
                        number(std::f64::consts::FRAC_PI_2).add(negative(operand.asin()))
                    }
                    Function::Atan => operand.atan2(one),
                    Function::Exp => operand.exp(),
                    Function::Ln => operand.ln(),
                    Function::Sqrt => operand.pow(1, 2),
                    Function::Floor => Dual::constant(operand.value.floor()),
                }
            }
            Tree::Choose(condition, below, otherwise) => {
                let [condition, below, otherwise] =
                    [condition, below, otherwise].map(|part| part.evaluate(values, direction));
                // A choice has a value only if both arms have one.
                let both = [below, otherwise]
                    .iter()
                    .all(|arm| arm.value.is_reliable() && arm.slope.is_reliable());
                match condition.value.is_below_zero().filter(|_| both) {
                    Some(true) => below,
                    Some(false) => otherwise,
                    None => Dual::constant(number(f64::NAN).value),
                }
            }
            Tree::Binary(operation, left, right) => {
                let left = left.evaluate(values, direction);
                let right = right.evaluate(values, direction);
                match operation {
                    Operation::Add => left.add(right),
                    Operation::Subtract => {
                        let minus_one = Dual::constant(Estimate::exact(-1.0));
                        left.add(minus_one.mul(right))
                    }
                    Operation::Multiply => left.mul(right),
                    Operation::Divide => left.mul(right.pow(-1, 1)),
                    Operation::Atan2 => left.atan2(right),
                }
            }
        }
    }
}

/// Returns the value of a node by recursion, with its error bound, for comparison with a tape.
pub(super) fn evaluate_node(graph: &Graph, expr: ExprId, values: &[f64]) -> Estimate {
    let at = |operand: ExprId| evaluate_node(graph, operand, values);
    let number = |value: &Number| Estimate::rounded(value.to_f64());
    match graph.node(expr) {
        Node::Number(value) => number(value),
        Node::Pi => Estimate::rounded(std::f64::consts::PI),
        Node::Symbol(symbol) => Estimate::exact(values[symbol.index()]),
        Node::Sum(terms) => terms.iter().fold(Estimate::exact(0.0), |sum, term| {
            sum.add(number(&term.coefficient).mul(at(term.expr)))
        }),
        Node::Product(factors) => factors
            .iter()
            .fold(Estimate::exact(1.0), |product, factor| {
                let narrow = |part: i128| i32::try_from(part).expect("a small exponent");
                let (numerator, denominator) = (
                    narrow(factor.exponent.numerator()),
                    narrow(factor.exponent.denominator()),
                );
                product.mul(at(factor.base).pow(numerator, denominator))
            }),
        Node::Sin(angle) => at(*angle).sin(),
        Node::Cos(angle) => at(*angle).cos(),
        Node::Atan2(y, x) => at(*y).atan2(at(*x)),
        Node::Exp(exponent) => at(*exponent).exp(),
        Node::Ln(argument) => at(*argument).ln(),
        Node::Floor(argument) => at(*argument).floor(),
        Node::Choose {
            condition,
            below,
            otherwise,
        } => match at(*condition).is_below_zero() {
            Some(true) => at(*below),
            Some(false) => at(*otherwise),
            None => Estimate::unknown(),
        },
        // Random trees contain no splines; separate tests compare splines with closed forms.
        Node::Spline { .. } => Estimate::unknown(),
    }
}
