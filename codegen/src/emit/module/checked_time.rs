//! Finds out if the final check of a frame must include its time.
//!
//! Most motions compute from the time values that are infinite or NaN if the time is, and that are checked. A mechanism that rests does not,
//! nor does one whose laws become constant.

use super::Module;
use super::checks::checked;
use crate::expr::{ExprId, Graph, IdMap, Node, SymbolId};
use crate::pool::SymbolRole;
use crate::program::Statement;

/// Value at a time that is infinite or NaN. Operations keep the greatest one of their operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Value {
    Arbitrary,
    NotFinite,
    NotANumber,
}

/// Values of expressions and symbols.
struct Values<'a> {
    module: &'a Module<'a>,
    expressions: IdMap<ExprId, Value>,
    symbols: IdMap<SymbolId, Value>,
}

/// True if all checked values may be finite at a time that is infinite or NaN.
pub(in crate::emit) fn checks_time(module: &Module<'_>) -> bool {
    let mut values = Values {
        module,
        expressions: IdMap::default(),
        symbols: IdMap::default(),
    };
    let functions = module.program.blocks.iter().map(|block| &block.function);
    for statement in functions.flat_map(|it| &it.statements) {
        match statement {
            // The runtime refuses such a time.
            Statement::Newton { .. } => return false,
            Statement::Let { target, value, .. } => {
                let value = values.of(*value);
                values.symbols.insert(*target, value);
            }
            Statement::SineCosine {
                sine,
                cosine,
                angle,
            } => {
                let value = values.of(*angle).of_circle();
                values.symbols.extend([(*sine, value), (*cosine, value)]);
            }
            Statement::Angle {
                target,
                sine,
                cosine,
            } => {
                let value = values.of(*sine).max(values.of(*cosine));
                values.symbols.insert(*target, value.of_bounded());
            }
            Statement::Lookup {
                targets, argument, ..
            } => {
                let value = values.of(*argument);
                // The third derivative of a table is constant between its points.
                let targets = targets.iter().take(3).flatten();
                values.symbols.extend(targets.map(|it| (*it, value)));
            }
            _ => {}
        }
    }
    let checked = checked(module).into_iter();
    let mut checked = checked.filter_map(|it| values.symbols.get(&it));
    checked.all(|it| *it == Value::Arbitrary)
}

impl Value {
    /// Sine or cosine of such an angle.
    fn of_circle(self) -> Value {
        match self {
            Value::Arbitrary => Value::Arbitrary,
            Value::NotFinite | Value::NotANumber => Value::NotANumber,
        }
    }

    /// Function of such a value that may be finite at infinity.
    fn of_bounded(self) -> Value {
        match self {
            Value::Arbitrary | Value::NotFinite => Value::Arbitrary,
            Value::NotANumber => Value::NotANumber,
        }
    }
}

impl Values<'_> {
    fn graph(&self) -> &Graph {
        &self.module.pool.graph
    }

    /// Returns the value of an expression, whose operands are evaluated first.
    fn of(&mut self, expr: ExprId) -> Value {
        let mut open = vec![expr];
        while let Some(&next) = open.last() {
            let operands = self.graph().operands(next).into_iter();
            let is_open = |it: &ExprId| !self.expressions.contains_key(it);
            let missing: Vec<ExprId> = operands.filter(is_open).collect();
            if missing.is_empty() {
                let value = self.of_node(next);
                self.expressions.insert(next, value);
                open.pop();
            }
            open.extend(missing);
        }
        self.known(expr)
    }

    fn known(&self, expr: ExprId) -> Value {
        let known = self.expressions.get(&expr);
        known.copied().unwrap_or(Value::Arbitrary)
    }

    /// Returns the value of an expression from those of its operands.
    fn of_node(&self, expr: ExprId) -> Value {
        let most = |values: &mut dyn Iterator<Item = Value>| values.max();
        let value = match self.graph().node(expr) {
            Node::Number(_) | Node::Pi => None,
            Node::Symbol(symbol) => match self.module.pool.role(*symbol) {
                SymbolRole::Time => Some(Value::NotFinite),
                _ => self.symbols.get(symbol).copied(),
            },
            Node::Sum(terms) => most(&mut terms.iter().map(|it| self.known(it.expr))),
            Node::Product(factors) => most(&mut factors.iter().map(|it| {
                let base = self.known(it.base);
                // The inverse of infinity is zero.
                match it.exponent.numerator() < 0 {
                    true => base.of_bounded(),
                    false => base,
                }
            })),
            Node::Sin(angle) | Node::Cos(angle) => Some(self.known(*angle).of_circle()),
            Node::Atan2(y, x) => Some(self.known(*y).max(self.known(*x)).of_bounded()),
            Node::Exp(exponent) => Some(self.known(*exponent).of_bounded()),
            Node::Ln(operand) => Some(self.known(*operand)),
            Node::Floor(operand) => Some(self.known(*operand).of_bounded()),
            Node::Choose {
                below, otherwise, ..
            } => Some(self.known(*below).min(self.known(*otherwise))),
            Node::Spline {
                order, argument, ..
            } => (*order < 3).then(|| self.known(*argument)),
        };
        value.unwrap_or(Value::Arbitrary)
    }
}
