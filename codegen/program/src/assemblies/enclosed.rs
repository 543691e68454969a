//! Bounds expressions as functions of a few symbols, the arguments.
//!
//! Values that do not depend on the arguments are computed once. Table lookups and all operations that are not listed here have
//! infinite bounds, so that nothing is proven of them.

use std::collections::HashMap;

use super::interval::Interval;
use crate::expr::{ExprId, Factor, Graph, Node, Number, SymbolId, Term};
use crate::program::{Function, Statement};

/// Functions of some arguments.
#[derive(Clone, Debug)]
pub struct Enclosed {
    /// Operations that the results need, each with its register, in order.
    operations: Vec<(usize, Operation)>,
    results: Vec<Place>,
}

/// Location of bounds.
#[derive(Clone, Copy, Debug)]
pub enum Place {
    /// Known bounds, whatever the arguments are.
    Known(Interval),
    /// Argument, from 0.
    Argument(usize),
    /// Result of an operation, from 0.
    Found(usize),
}

#[derive(Clone, Debug)]
enum Operation {
    /// Sum: terms with their coefficients.
    Sum(Vec<(Interval, Place)>),
    /// Product: factors, each with numerator and denominator of its exponent.
    Product(Vec<(Place, [i128; 2])>),
    Sine(Place),
    Cosine(Place),
    /// Angle of a vector, from y and x.
    Angle([Place; 2]),
    Exponential(Place),
    Logarithm(Place),
    Magnitude(Place),
    /// Choice: the second value if the first is negative, otherwise the third.
    Choose([Place; 3]),
    /// Value whose magnitude is at most this limit.
    Within(Place, f64),
}

/// Records functions as operations.
#[derive(Clone)]
pub struct Enclosing<'a> {
    graph: &'a Graph,
    symbols: HashMap<SymbolId, Place>,
    // Bounds of expressions; only looked up.
    values: HashMap<ExprId, Place>,
    /// Largest magnitudes of some symbols; only looked up.
    limits: HashMap<SymbolId, f64>,
    operations: Vec<Operation>,
}

impl Enclosed {
    /// Returns the bounds of all results; `registers` is workspace.
    pub fn at(&self, arguments: &[Interval], registers: &mut Vec<Interval>) -> Vec<Interval> {
        let count = self
            .operations
            .last()
            .map_or(0, |(register, _)| register + 1);
        registers.resize(count, Interval::EMPTY);
        for (register, operation) in &self.operations {
            registers[*register] = operation.value(arguments, registers);
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
            Operation::Magnitude(value) => of(*value).magnitude(),
            Operation::Choose([condition, below, otherwise]) => {
                let condition = of(*condition);
                match (condition.high < 0.0, condition.low >= 0.0) {
                    _ if !condition.defined => Interval::undefined(),
                    (true, _) => of(*below),
                    (_, true) => of(*otherwise),
                    // The value may jump.
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

    /// Calls `visit` with every operand.
    fn each_operand(&self, mut visit: impl FnMut(Place)) {
        match self {
            Operation::Sum(terms) => terms.iter().for_each(|(_, term)| visit(*term)),
            Operation::Product(factors) => factors.iter().for_each(|(base, _)| visit(*base)),
            Operation::Sine(one)
            | Operation::Cosine(one)
            | Operation::Magnitude(one)
            | Operation::Exponential(one)
            | Operation::Logarithm(one)
            | Operation::Within(one, _) => visit(*one),
            Operation::Angle(both) => both.iter().copied().for_each(visit),
            Operation::Choose(all) => all.iter().copied().for_each(visit),
        }
    }
}

/// Bounds a power whose exponent is a multiple of one half.
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

/// Bounds an exact number, which may lie between two machine numbers.
fn number(number: Number) -> Interval {
    let value = number.to_f64();
    match value.fract() == 0.0 && number.is_rational() && value.abs() < f64::from(1_u32 << 31) {
        true => Interval::point(value),
        false => Interval::about(value),
    }
}

impl<'a> Enclosing<'a> {
    /// Starts with these symbols as arguments.
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

    /// Sets the bounds of a symbol.
    pub fn know(&mut self, symbol: SymbolId, value: Interval) {
        self.symbols.insert(symbol, Place::Known(value));
    }

    /// Equates a symbol with the bounds at a place.
    pub fn bind(&mut self, symbol: SymbolId, place: Place) {
        self.symbols.insert(symbol, place);
    }

    /// Limits a symbol that is a component of a vector, by the square of the vector's length if that is known.
    pub fn limit(&mut self, symbol: SymbolId, square: ExprId) {
        if let Place::Known(square) = self.value(square) {
            self.limits.insert(symbol, square.root().high);
        }
    }

    /// Records the statements of a function. Conditions of failures do not affect the bounds.
    pub fn statements(&mut self, function: &Function) {
        for statement in &function.statements {
            self.statement(statement);
        }
    }

    /// Records one statement.
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

    /// Returns the bounds of a sine.
    pub fn sine(&mut self, angle: Place) -> Place {
        self.written(Operation::Sine(angle))
    }

    /// Returns the bounds of a cosine.
    pub fn cosine(&mut self, angle: Place) -> Place {
        self.written(Operation::Cosine(angle))
    }

    /// Returns the bounds of the results of a function, after its statements.
    pub fn results(&mut self, function: &Function) -> Vec<Place> {
        self.statements(function);
        let results = function.results.iter();
        results.map(|result| self.value(result.expr)).collect()
    }

    /// Returns these results as functions of the arguments, without the operations that no result needs.
    pub fn finish(self, results: Vec<Place>) -> Enclosed {
        let mut is_needed = vec![false; self.operations.len()];
        let need = |place: Place, is_needed: &mut [bool]| {
            if let Place::Found(register) = place {
                is_needed[register] = true;
            }
        };
        results.iter().for_each(|&it| need(it, &mut is_needed));
        let mut operations = Vec::new();
        for (register, operation) in self.operations.into_iter().enumerate().rev() {
            if is_needed[register] {
                operation.each_operand(|it| need(it, &mut is_needed));
                operations.push((register, operation));
            }
        }
        operations.reverse();
        Enclosed {
            operations,
            results,
        }
    }

    /// Returns the bounds of an expression that does not depend on arguments; otherwise `None`.
    pub fn known(&mut self, expr: ExprId) -> Option<Interval> {
        match self.value(expr) {
            Place::Known(value) => Some(value),
            _ => None,
        }
    }

    /// Returns the bounds of a symbol that does not depend on arguments; `None` if they are not known.
    pub fn known_symbol(&self, symbol: SymbolId) -> Option<Interval> {
        match self.symbols.get(&symbol) {
            Some(Place::Known(value)) => Some(*value),
            _ => None,
        }
    }

    /// Returns the bounds of an expression; infinite for unknown values.
    pub fn value(&mut self, expr: ExprId) -> Place {
        if let Node::Symbol(symbol) = self.graph.node(expr) {
            // The symbol may have been bound after an expression that contains it was recorded.
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
            Node::Choose { condition, .. } if self.graph.magnitude_of(expr).is_some() => {
                Operation::Magnitude(self.value(*condition))
            }
            Node::Choose {
                condition,
                below,
                otherwise,
            } => Operation::Choose([*condition, *below, *otherwise].map(|part| self.value(part))),
            _ => return Place::Known(Interval::undefined()),
        };
        let place = self.written(operation);
        self.values.insert(expr, place);
        place
    }

    /// Records an operation, or evaluates it if all operands are known.
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
