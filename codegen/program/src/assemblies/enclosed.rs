//! *Expressions, and bounds of some of their symbols* → *bounds of the expressions as functions of a few other symbols, the arguments*.
//!
//! What does not depend on the arguments is computed once. Lookups of tables and whatever else is not in the list of operations here
//! are bounded by every number, so that nothing is proven of them.

use std::collections::HashMap;

use super::interval::Interval;
use crate::expr::{ExprId, Factor, Graph, Node, Number, SymbolId, Term};
use crate::program::{Function, Statement};

/// Functions of some arguments.
#[derive(Clone, Debug)]
pub struct Enclosed {
    operations: Vec<Operation>,
    results: Vec<Place>,
}

/// Where bounds are found.
#[derive(Clone, Copy, Debug)]
pub enum Place {
    /// They are known, whatever the arguments are.
    Known(Interval),
    /// An argument, from 0.
    Argument(usize),
    /// The result of an operation, from 0.
    Found(usize),
}

#[derive(Clone, Debug)]
enum Operation {
    /// Each term with its coefficient.
    Sum(Vec<(Interval, Place)>),
    /// Each factor with the numerator and the denominator of its exponent.
    Product(Vec<(Place, [i128; 2])>),
    Sine(Place),
    Cosine(Place),
    /// Of y and x.
    Angle([Place; 2]),
    Exponential(Place),
    Logarithm(Place),
    /// The second where the first is negative, or else the third.
    Choose([Place; 3]),
    /// What is no larger than this, either way.
    Within(Place, f64),
}

/// Writes functions down.
#[derive(Clone)]
pub struct Enclosing<'a> {
    graph: &'a Graph,
    symbols: HashMap<SymbolId, Place>,
    // Only looked up.
    values: HashMap<ExprId, Place>,
    /// The largest magnitudes of some symbols. Only looked up.
    limits: HashMap<SymbolId, f64>,
    operations: Vec<Operation>,
}

impl Enclosed {
    /// The bounds of all results; `registers` is room to work in.
    pub fn at(&self, arguments: &[Interval], registers: &mut Vec<Interval>) -> Vec<Interval> {
        registers.clear();
        for operation in &self.operations {
            let value = operation.value(arguments, registers);
            registers.push(value);
        }
        let results = self.results.iter();
        results
            .map(|place| place.value(arguments, registers))
            .collect()
    }
}

impl Place {
    fn value(self, arguments: &[Interval], registers: &[Interval]) -> Interval {
        match self {
            Place::Known(value) => value,
            Place::Argument(at) => arguments[at],
            Place::Found(at) => registers[at],
        }
    }
}

impl Operation {
    fn value(&self, arguments: &[Interval], registers: &[Interval]) -> Interval {
        let of = |place: Place| place.value(arguments, registers);
        match self {
            Operation::Sum(terms) => {
                let terms = terms.iter();
                terms.fold(Interval::point(0.0), |sum, &(coefficient, term)| {
                    sum.plus(coefficient.times(of(term)))
                })
            }
            Operation::Product(factors) => {
                let factors = factors.iter();
                factors.fold(Interval::point(1.0), |product, &(base, exponent)| {
                    product.times(raised(of(base), exponent))
                })
            }
            Operation::Sine(angle) => of(*angle).sine(),
            Operation::Cosine(angle) => of(*angle).cosine(),
            Operation::Angle([y, x]) => Interval::angle(of(*y), of(*x)),
            Operation::Exponential(value) => of(*value).exponential(),
            Operation::Logarithm(value) => of(*value).logarithm(),
            Operation::Choose([condition, below, otherwise]) => {
                let condition = of(*condition);
                match (condition.high < 0.0, condition.low >= 0.0) {
                    _ if !condition.defined => Interval::undefined(),
                    (true, _) => of(*below),
                    (_, true) => of(*otherwise),
                    // It may jump.
                    _ => Interval {
                        defined: false,
                        ..of(*below).hull(of(*otherwise))
                    },
                }
            }
            Operation::Within(value, limit) => {
                let value = of(*value);
                Interval {
                    defined: value.defined,
                    ..value.intersection(Interval::new(-limit, *limit))
                }
            }
        }
    }

    /// Calls `visit` with everything that it is made of.
    fn each_operand(&self, mut visit: impl FnMut(Place)) {
        match self {
            Operation::Sum(terms) => terms.iter().for_each(|(_, term)| visit(*term)),
            Operation::Product(factors) => factors.iter().for_each(|(base, _)| visit(*base)),
            Operation::Sine(one)
            | Operation::Cosine(one)
            | Operation::Exponential(one)
            | Operation::Logarithm(one)
            | Operation::Within(one, _) => visit(*one),
            Operation::Angle(both) => both.iter().copied().for_each(visit),
            Operation::Choose(all) => all.iter().copied().for_each(visit),
        }
    }
}

/// A power whose exponent is a whole number or half of one.
fn raised(base: Interval, [numerator, denominator]: [i128; 2]) -> Interval {
    let base = match denominator {
        1 => base,
        2 => base.root(),
        _ => return Interval::undefined(),
    };
    let Ok(exponent) = u32::try_from(numerator.unsigned_abs()) else {
        return Interval::undefined();
    };
    match numerator < 0 {
        true => base.power(exponent).reciprocal(),
        false => base.power(exponent),
    }
}

/// Bounds of an exact number, which may lie between two of the machine.
fn number(number: Number) -> Interval {
    let value = number.to_f64();
    match value.fract() == 0.0 && number.is_rational() && value.abs() < f64::from(1_u32 << 31) {
        true => Interval::point(value),
        false => Interval::about(value),
    }
}

impl<'a> Enclosing<'a> {
    /// With these symbols as arguments.
    pub fn new(graph: &'a Graph, arguments: &[SymbolId]) -> Enclosing<'a> {
        let arguments = arguments.iter().enumerate();
        Enclosing {
            graph,
            symbols: arguments
                .map(|(at, &symbol)| (symbol, Place::Argument(at)))
                .collect(),
            values: HashMap::new(),
            limits: HashMap::new(),
            operations: Vec::new(),
        }
    }

    /// What is known of a symbol.
    pub fn know(&mut self, symbol: SymbolId, value: Interval) {
        self.symbols.insert(symbol, Place::Known(value));
    }

    /// Lets a symbol stand for what is found at a place.
    pub fn bind(&mut self, symbol: SymbolId, place: Place) {
        self.symbols.insert(symbol, place);
    }

    /// Says that a symbol is a component of a vector whose length has this square, where that is known.
    pub fn limit(&mut self, symbol: SymbolId, square: ExprId) {
        if let Place::Known(square) = self.value(square) {
            self.limits.insert(symbol, square.root().high);
        }
    }

    /// Goes through the statements of a function. What they would fail with is in the bounds.
    pub fn statements(&mut self, function: &Function) {
        for statement in &function.statements {
            self.statement(statement);
        }
    }

    /// Goes through one statement.
    pub fn statement(&mut self, statement: &Statement) {
        match *statement {
            Statement::Let { target, value, .. } => {
                let mut value = self.value(value);
                if let Some(&limit) = self.limits.get(&target) {
                    value = self.written(Operation::Within(value, limit));
                }
                self.symbols.insert(target, value);
            }
            Statement::SineCosine {
                sine,
                cosine,
                angle,
            } => {
                let angle = self.value(angle);
                let [s, c] = [self.sine(angle), self.cosine(angle)];
                self.symbols.insert(sine, s);
                self.symbols.insert(cosine, c);
            }
            _ => {}
        }
    }

    /// The bounds of a sine.
    pub fn sine(&mut self, angle: Place) -> Place {
        self.written(Operation::Sine(angle))
    }

    /// The bounds of a cosine.
    pub fn cosine(&mut self, angle: Place) -> Place {
        self.written(Operation::Cosine(angle))
    }

    /// The bounds of the results of a function, after its statements.
    pub fn results(&mut self, function: &Function) -> Vec<Place> {
        self.statements(function);
        let results = function.results.iter();
        results.map(|result| self.value(result.expr)).collect()
    }

    /// These results as functions of the arguments.
    pub fn finish(self, results: Vec<Place>) -> Enclosed {
        Enclosed {
            operations: self.operations,
            results,
        }
    }

    /// The bounds of an expression that does not depend on arguments.
    pub fn known(&mut self, expr: ExprId) -> Option<Interval> {
        match self.value(expr) {
            Place::Known(value) => Some(value),
            _ => None,
        }
    }

    /// The bounds of a symbol that does not depend on arguments, where it has been found.
    pub fn known_symbol(&self, symbol: SymbolId) -> Option<Interval> {
        match self.symbols.get(&symbol) {
            Some(Place::Known(value)) => Some(*value),
            _ => None,
        }
    }

    /// The bounds of an expression; of what is not known here every number.
    pub fn value(&mut self, expr: ExprId) -> Place {
        if let Node::Symbol(symbol) = self.graph.node(expr) {
            // A symbol may be found after an expression that holds it was asked for elsewhere.
            let known = self.symbols.get(symbol).copied();
            return known.unwrap_or(Place::Known(Interval::undefined()));
        }
        if let Some(&known) = self.values.get(&expr) {
            return known;
        }
        let graph = self.graph;
        let operation = match graph.node(expr) {
            Node::Number(value) => return Place::Known(number(*value)),
            Node::Pi => return Place::Known(Interval::about(std::f64::consts::PI)),
            Node::Sum(terms) => {
                let terms = terms.iter();
                let term = |term: &Term| (number(term.coefficient), self.value(term.expr));
                Operation::Sum(terms.map(term).collect())
            }
            Node::Product(factors) => {
                let factors = factors.iter();
                let factor = |factor: &Factor| {
                    let exponent = [factor.exponent.numerator(), factor.exponent.denominator()];
                    (self.value(factor.base), exponent)
                };
                Operation::Product(factors.map(factor).collect())
            }
            Node::Sin(angle) => Operation::Sine(self.value(*angle)),
            Node::Cos(angle) => Operation::Cosine(self.value(*angle)),
            Node::Atan2(y, x) => Operation::Angle([*y, *x].map(|part| self.value(part))),
            Node::Exp(value) => Operation::Exponential(self.value(*value)),
            Node::Ln(value) => Operation::Logarithm(self.value(*value)),
            Node::Choose {
                condition,
                below,
                otherwise,
            } => Operation::Choose([*condition, *below, *otherwise].map(|part| self.value(part))),
            _ => return Place::Known(Interval::undefined()),
        };
        let found = self.written(operation);
        self.values.insert(expr, found);
        found
    }

    /// An operation, or what it gives where that is known.
    fn written(&mut self, operation: Operation) -> Place {
        let mut is_known = true;
        operation.each_operand(|place| is_known &= matches!(place, Place::Known(_)));
        if is_known {
            return Place::Known(operation.value(&[], &[]));
        }
        self.operations.push(operation);
        Place::Found(self.operations.len() - 1)
    }
}
