//! An expression of a function → the operations that compute it, in their order.
//!
//! Every language that computes writes this tree: what it adds first and what it multiplies first decides the bits of the result. What
//! was computed before is a variable. Long sums and products are lists, so that the tree is only as deep as parentheses are.

use super::scope::Scope;
use crate::expr::{ExprId, Node, SplineId, SymbolId};
use crate::program::{Addend, Compared, ConstantPart, LARGEST_PRODUCT, Power, addends, compared};
use crate::system::WrittenOrder;

/// An elementary function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::emit) enum Elementary {
    Sin,
    Cos,
    Exp,
    Ln,
    Atan2,
    Floor,
    Abs,
    Sqrt,
    Power,
}

/// What computes a number.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::emit) enum Arithmetic {
    /// A number as it is.
    Number(f64),
    /// A constant of this name.
    Constant(String),
    /// A value that is known.
    Variable(SymbolId),
    /// Terms one after another; true of those that are subtracted. More than one, or one that is subtracted.
    Sum(Vec<(bool, Arithmetic)>),
    /// Factors one after another, and then the product of the divisors, if there are any. More than one of both together.
    Product {
        factors: Vec<Arithmetic>,
        divisors: Vec<Arithmetic>,
    },
    Call(Elementary, Vec<Arithmetic>),
    /// The derivative of this order of a table at a place.
    Lookup {
        spline: SplineId,
        order: usize,
        place: Box<Arithmetic>,
    },
    /// One of two arms.
    Choice(Box<Choice>),
}

/// One of two arms: the first where left is less than right, or greater.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::emit) struct Choice {
    pub left: Arithmetic,
    pub is_less: bool,
    pub right: Arithmetic,
    pub below: Arithmetic,
    pub otherwise: Arithmetic,
}

impl Scope<'_> {
    /// An expression whose terms mention the bodies in this order.
    pub(in crate::emit) fn arithmetic(&self, expr: ExprId, bodies: &[usize]) -> Arithmetic {
        self.atom(expr).unwrap_or_else(|| self.sum(expr, bodies))
    }

    /// The value of an expression, which may have got its name from this very statement.
    pub(in crate::emit) fn arithmetic_of(&self, target: SymbolId, expr: ExprId) -> Arithmetic {
        match self.name_of(expr) == Some(target) {
            true => self.call(expr).unwrap_or_else(|| self.sum(expr, &[])),
            false => self.arithmetic(expr, &[]),
        }
    }

    /// A name, an input or a call.
    fn atom(&self, expr: ExprId) -> Option<Arithmetic> {
        if let Some(name) = self.name_of(expr) {
            return Some(Arithmetic::Variable(name));
        }
        let graph = &self.module.system.mechanism.graph;
        match graph.node(expr) {
            Node::Symbol(symbol) => Some(Arithmetic::Variable(*symbol)),
            _ if graph.is_constant(expr) => None,
            _ => self.call(expr),
        }
    }

    /// A function's call.
    fn call(&self, expr: ExprId) -> Option<Arithmetic> {
        let graph = &self.module.system.mechanism.graph;
        let call = |function, arguments: &[ExprId]| {
            let arguments = arguments.iter().map(|&it| self.arithmetic(it, &[]));
            Some(Arithmetic::Call(function, arguments.collect()))
        };
        match *graph.node(expr) {
            Node::Sin(x) => call(Elementary::Sin, &[x]),
            Node::Cos(x) => call(Elementary::Cos, &[x]),
            Node::Exp(x) => call(Elementary::Exp, &[x]),
            Node::Ln(x) => call(Elementary::Ln, &[x]),
            Node::Atan2(y, x) => call(Elementary::Atan2, &[y, x]),
            Node::Floor(x) => call(Elementary::Floor, &[x]),
            Node::Choose {
                condition,
                below,
                otherwise,
            } => match graph.magnitude_of(expr) {
                Some(value) => call(Elementary::Abs, &[value]),
                None => Some(self.one_of(condition, below, otherwise)),
            },
            Node::Spline {
                spline,
                order,
                argument,
            } => Some(Arithmetic::Lookup {
                spline,
                order: order.into(),
                place: Box::new(self.arithmetic(argument, &[])),
            }),
            Node::Number(_) | Node::Pi | Node::Symbol(_) | Node::Sum(_) | Node::Product(_) => None,
        }
    }

    fn one_of(&self, condition: ExprId, below: ExprId, otherwise: ExprId) -> Arithmetic {
        let graph = &self.module.system.mechanism.graph;
        let named = |other: ExprId| self.name_of(other).is_some();
        let order = WrittenOrder::new(self.module.system, &[]);
        let Compared {
            left,
            is_less,
            right,
        } = compared(condition, graph, &order, &named);
        let [left, right] = [left, right].map(|side| self.addends(&side));
        let [below, otherwise] = [below, otherwise].map(|arm| self.arithmetic(arm, &[]));
        Arithmetic::Choice(Box::new(Choice {
            left,
            is_less,
            right,
            below,
            otherwise,
        }))
    }

    fn sum(&self, expr: ExprId, bodies: &[usize]) -> Arithmetic {
        let named = |other: ExprId| self.name_of(other).is_some();
        let order = WrittenOrder::new(self.module.system, bodies);
        let addends = addends(expr, &self.module.system.mechanism.graph, &order, &named);
        self.addends(&addends)
    }

    fn addends(&self, addends: &[Addend]) -> Arithmetic {
        match addends {
            // A sum without terms is the number zero.
            [] => Arithmetic::Number(0.0),
            [only] if !only.negative => self.addend(only),
            terms => {
                let terms = terms.iter().map(|it| (it.negative, self.addend(it)));
                Arithmetic::Sum(terms.collect())
            }
        }
    }

    /// An addend without its sign.
    fn addend(&self, addend: &Addend) -> Arithmetic {
        let constant = addend.constant.iter().map(|part| self.constant(part));
        let powers = addend.factors.iter().flat_map(|power| self.power(power));
        let mut factors: Vec<Arithmetic> = constant.chain(powers).collect();
        let divisors = addend.divisors.iter();
        let divisors: Vec<Arithmetic> = divisors.flat_map(|power| self.power(power)).collect();
        if factors.is_empty() {
            factors.push(Arithmetic::Number(1.0));
        }
        match (factors.len(), divisors.is_empty()) {
            (1, true) => factors.remove(0),
            _ => Arithmetic::Product { factors, divisors },
        }
    }

    /// A number or the name of a constant.
    fn constant(&self, part: &ConstantPart) -> Arithmetic {
        match self.module.program.constants.name_of(part) {
            Some(name) => Arithmetic::Constant(name.to_string()),
            None => Arithmetic::Number(part.value(&self.module.system.mechanism.graph)),
        }
    }

    /// The factors that a power is written as.
    fn power(&self, power: &Power) -> Vec<Arithmetic> {
        // Made once: nested powers would otherwise be walked as a tree that doubles with each level.
        let base = self.arithmetic(power.base, &[]);
        match (power.exponent.numerator(), power.exponent.denominator()) {
            (whole, 1) if whole <= LARGEST_PRODUCT => {
                vec![base; whole.unsigned_abs() as usize]
            }
            (odd, 2) if odd / 2 <= LARGEST_PRODUCT => {
                let mut factors = vec![base.clone(); (odd / 2).unsigned_abs() as usize];
                factors.push(Arithmetic::Call(Elementary::Sqrt, vec![base]));
                factors
            }
            _ => {
                let exponent = Arithmetic::Number(power.exponent.to_f64());
                vec![Arithmetic::Call(Elementary::Power, vec![base, exponent])]
            }
        }
    }
}
