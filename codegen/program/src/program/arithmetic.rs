//! The order of arithmetic: which operations compute an expression of a function, with their order and signs.
//!
//! Every printed language writes the tree, and the interpreter executes it, so all of them find the same bits. An expression that a
//! statement has named is a variable. Long sums and products are lists: the tree is only as deep as parentheses are.

use super::addends::{Addend, Compared, Power, addends, compared};
use super::function::{Function, Written};
use super::passes::constants::{ConstantPart, Constants, Occurrence};
use super::passes::costs::LARGEST_PRODUCT;
use crate::expr::{ExprId, Node, SplineId, SymbolId};
use crate::pool::Pool;
use crate::system::{System, WrittenOrder};

/// An elementary function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Elementary {
    /// The sine.
    Sin,
    /// The cosine.
    Cos,
    /// The exponential function.
    Exp,
    /// The natural logarithm.
    Ln,
    /// The angle of a vector: ordinate and abscissa.
    Atan2,
    /// The largest whole number that is not greater.
    Floor,
    /// The absolute value.
    Abs,
    /// The square root.
    Sqrt,
    /// The power of a base with a real exponent.
    Power,
}

/// The operations that compute one number.
#[derive(Clone, Debug, PartialEq)]
pub enum Arithmetic {
    /// A literal.
    Number(f64),
    /// The constant of this place in [`Constants::list`].
    Constant(usize),
    /// A value that is computed or given before.
    Variable(SymbolId),
    /// Terms added one after another; true of those that are subtracted. More than one, or one that is subtracted.
    Sum(Vec<(bool, Arithmetic)>),
    /// Factors multiplied one after another. More than one.
    Product(Vec<Arithmetic>),
    /// The first over the second.
    Quotient(Box<[Arithmetic; 2]>),
    /// An elementary function of its arguments.
    Call(Elementary, Vec<Arithmetic>),
    /// A value or a derivative of a table.
    Lookup {
        /// The table.
        spline: SplineId,
        /// The order of the derivative.
        order: usize,
        /// The argument.
        place: Box<Arithmetic>,
    },
    /// One of two arms.
    Choice(Box<Choice>),
}

impl Arithmetic {
    /// True if the value depends on a variable.
    pub fn varies(&self) -> bool {
        match self {
            Arithmetic::Number(_) | Arithmetic::Constant(_) => false,
            Arithmetic::Variable(_) => true,
            Arithmetic::Sum(terms) => terms.iter().any(|(_, term)| term.varies()),
            Arithmetic::Product(all) | Arithmetic::Call(_, all) => all.iter().any(Self::varies),
            Arithmetic::Quotient(both) => both.iter().any(Self::varies),
            Arithmetic::Lookup { place, .. } => place.varies(),
            Arithmetic::Choice(choice) => {
                let Choice {
                    left,
                    right,
                    below,
                    otherwise,
                    ..
                } = &**choice;
                [left, right, below, otherwise]
                    .into_iter()
                    .any(Self::varies)
            }
        }
    }
}

/// One of two arms: the first where the left side is less than the right one, or greater.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// The left side.
    pub left: Arithmetic,
    /// True if the first arm is that of a smaller left side.
    pub is_less: bool,
    /// The right side.
    pub right: Arithmetic,
    /// The first arm.
    pub below: Arithmetic,
    /// The second arm.
    pub otherwise: Arithmetic,
}

/// The expressions of one function as arithmetic.
#[derive(Clone, Copy, Debug)]
pub struct Evaluation<'a> {
    /// The function, whose statements name expressions.
    pub function: &'a Function,
    /// The system, whose unknowns and bodies order terms and factors.
    pub system: &'a System,
    /// Expressions of the function.
    pub pool: &'a Pool,
    /// The constants of the program.
    pub constants: &'a Constants,
    /// The target of the statement whose value is evaluated, if any.
    target: Option<SymbolId>,
}

impl<'a> Evaluation<'a> {
    /// The expressions of a function of a program.
    pub fn new(
        function: &'a Function,
        pool: &'a Pool,
        system: &'a System,
        constants: &'a Constants,
    ) -> Evaluation<'a> {
        Evaluation {
            function,
            system,
            pool,
            constants,
            target: None,
        }
    }

    /// Arithmetic of a value.
    pub fn value(&self, expr: ExprId) -> Arithmetic {
        self.mentioning(expr, &[])
    }

    /// Arithmetic of a result, whose terms mention bodies in the order of its row.
    pub fn result(&self, result: &Written) -> Arithmetic {
        self.mentioning(result.expr, &result.bodies)
    }

    /// Arithmetic of the value that a statement assigns to a target, even if the value is named after that target.
    pub fn assigned(&self, target: SymbolId, expr: ExprId) -> Arithmetic {
        let assigned = Evaluation {
            target: Some(target),
            ..*self
        };
        match self.function.name_of(expr) == Some(target) {
            true => assigned
                .call(expr)
                .unwrap_or_else(|| assigned.sum(expr, &[])),
            false => assigned.mentioning(expr, &[]),
        }
    }

    fn mentioning(&self, expr: ExprId, bodies: &[usize]) -> Arithmetic {
        self.atom(expr).unwrap_or_else(|| self.sum(expr, bodies))
    }

    /// A name, an input or a call.
    fn atom(&self, expr: ExprId) -> Option<Arithmetic> {
        if let Some(name) = self.function.name_of(expr) {
            return Some(Arithmetic::Variable(name));
        }
        let graph = &self.pool.graph;
        match graph.node(expr) {
            Node::Symbol(symbol) => Some(Arithmetic::Variable(*symbol)),
            _ if graph.is_constant(expr) => None,
            _ => self.call(expr),
        }
    }

    /// A function's call.
    fn call(&self, expr: ExprId) -> Option<Arithmetic> {
        let graph = &self.pool.graph;
        let call = |function, arguments: &[ExprId]| {
            let arguments = arguments.iter().map(|&it| self.value(it));
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
                place: Box::new(self.value(argument)),
            }),
            Node::Number(_) | Node::Pi | Node::Symbol(_) | Node::Sum(_) | Node::Product(_) => None,
        }
    }

    fn one_of(&self, condition: ExprId, below: ExprId, otherwise: ExprId) -> Arithmetic {
        let graph = &self.pool.graph;
        let named = |other: ExprId| self.function.name_of(other).is_some();
        let order = WrittenOrder::new(self.pool, self.system, &[]);
        let Compared {
            left,
            is_less,
            right,
        } = compared(condition, graph, &order, &named);
        let [left, right] = [left, right].map(|side| self.addends(&side));
        let [below, otherwise] = [below, otherwise].map(|arm| self.value(arm));
        Arithmetic::Choice(Box::new(Choice {
            left,
            is_less,
            right,
            below,
            otherwise,
        }))
    }

    fn sum(&self, expr: ExprId, bodies: &[usize]) -> Arithmetic {
        let named = |other: ExprId| self.function.name_of(other).is_some();
        let order = WrittenOrder::new(self.pool, self.system, bodies);
        let addends = addends(expr, &self.pool.graph, &order, &named);
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
        let occurrence = Occurrence::of(addend, self.target, self.function, self.pool);
        let constant = addend.constant.iter();
        let constant = constant.map(|part| self.constant(part, occurrence));
        let powers = addend.factors.iter().flat_map(|power| self.power(power));
        let numerator = product(constant.chain(powers).collect());
        let divisors = addend.divisors.iter();
        let divisors: Vec<Arithmetic> = divisors.flat_map(|power| self.power(power)).collect();
        match divisors.is_empty() {
            true => numerator,
            false => Arithmetic::Quotient(Box::new([numerator, product(divisors)])),
        }
    }

    /// A number or the name of a constant.
    fn constant(&self, part: &ConstantPart, occurrence: Occurrence<'_>) -> Arithmetic {
        let graph = &self.pool.graph;
        match self.constants.place_of(part, occurrence, graph) {
            Some(place) => Arithmetic::Constant(place),
            None => Arithmetic::Number(part.value(graph)),
        }
    }

    /// The magnitude of x for the square root of x², which has the same bits; `None` for other powers.
    fn root_of_square(&self, power: &Power) -> Option<Arithmetic> {
        let graph = &self.pool.graph;
        let is_root = (power.exponent.numerator(), power.exponent.denominator()) == (1, 2);
        let Node::Product(factors) = graph.node(power.base) else {
            return None;
        };
        let [only] = &factors[..] else { return None };
        let is_square = (only.exponent.numerator(), only.exponent.denominator()) == (2, 1);
        let is_named = self.function.name_of(power.base).is_some();
        (is_root && is_square && !is_named)
            .then(|| Arithmetic::Call(Elementary::Abs, vec![self.value(only.base)]))
    }

    /// The factors that a power is written as.
    fn power(&self, power: &Power) -> Vec<Arithmetic> {
        if let Some(root) = self.root_of_square(power) {
            return vec![root];
        }
        // Made once: nested powers would otherwise be walked as a tree that doubles with each level.
        let base = self.value(power.base);
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

/// The product of factors; 1 of none.
fn product(mut factors: Vec<Arithmetic>) -> Arithmetic {
    match factors.len() {
        0 => Arithmetic::Number(1.0),
        1 => factors.remove(0),
        _ => Arithmetic::Product(factors),
    }
}
