//! Prints expressions in Rust.

use super::names::identifier;
use super::tables::table_name;
use crate::emit::module::scope::Scope;
use crate::expr::{ExprId, SplineId};
use crate::program::{Arithmetic, Choice, Elementary};

impl Scope<'_> {
    /// Returns the results in order, with the terms of each in the order of its row.
    pub(super) fn results(&self) -> Vec<String> {
        let results = self.function.results.iter();
        results
            .map(|result| self.written(&self.evaluation().result(result)))
            .collect()
    }

    /// Returns an expression as text.
    pub(super) fn value(&self, expr: ExprId) -> String {
        self.whole(&self.evaluation().value(expr))
    }

    /// Returns arithmetic as text; in lanes, a constant becomes a number for all of them.
    pub(super) fn whole(&self, arithmetic: &Arithmetic) -> String {
        let written = self.written(arithmetic);
        match self.is_in_lanes() && !arithmetic.varies() {
            true => format!("lanes({written})"),
            false => written,
        }
    }

    /// Returns expressions, separated by commas.
    pub(super) fn values(&self, all: &[ExprId]) -> String {
        let all: Vec<String> = all.iter().map(|expr| self.value(*expr)).collect();
        all.join(", ")
    }

    /// Returns arithmetic as text.
    pub(super) fn written(&self, arithmetic: &Arithmetic) -> String {
        match arithmetic {
            Arithmetic::Number(value) => self.module.number(*value),
            Arithmetic::Constant(place) => {
                identifier(&self.module.program.constants.list()[*place].name)
            }
            Arithmetic::Variable(symbol) => self.read(*symbol),
            Arithmetic::Sum(terms) => {
                let terms = terms.iter().enumerate().map(|(place, (negative, term))| {
                    let term = match term {
                        Arithmetic::Choice(_) => self.operand(term),
                        _ => self.written(term),
                    };
                    match (place, negative) {
                        (0, false) => term,
                        (0, true) => format!("-{term}"),
                        (_, false) => format!(" + {term}"),
                        (_, true) => format!(" - {term}"),
                    }
                });
                chained(terms.collect())
            }
            Arithmetic::Product(factors) => self.product(factors),
            Arithmetic::Quotient(both) => {
                let [numerator, denominator] = &**both;
                let numerator = match numerator {
                    Arithmetic::Product(factors) => self.product(factors),
                    _ => self.operand(numerator),
                };
                format!("{numerator} / {}", self.operand(denominator))
            }
            Arithmetic::Call(function, arguments) => {
                let arguments = arguments.iter().map(|argument| self.whole(argument));
                let arguments: Vec<String> = arguments.collect();
                format!("math::{}({})", called(*function), arguments.join(", "))
            }
            Arithmetic::Lookup {
                spline,
                order,
                place,
            } => format!("{}[{order}]", self.lookup(*spline, place)),
            Arithmetic::Choice(choice) => self.choice(choice),
        }
    }

    /// `if x < 2.0 { … } else { … }`; a second arm that is another choice continues with `else if`.
    fn choice(&self, choice: &Choice) -> String {
        if self.is_in_lanes() {
            let [left, right] = [&choice.left, &choice.right].map(|side| self.whole(side));
            let [below, otherwise] = [&choice.below, &choice.otherwise].map(|arm| self.whole(arm));
            let (one, other) = match choice.is_less {
                true => (left, right),
                false => (right, left),
            };
            return format!("choose(less({one}, {other}), {below}, {otherwise})");
        }
        let [left, right] = [&choice.left, &choice.right].map(|side| match side {
            Arithmetic::Choice(_) => self.operand(side),
            _ => self.written(side),
        });
        let sign = if choice.is_less { "<" } else { ">" };
        let [below, otherwise] = [&choice.below, &choice.otherwise].map(|arm| self.written(arm));
        let otherwise = match choice.otherwise {
            Arithmetic::Choice(_) => otherwise,
            _ => format!("{{ {otherwise} }}"),
        };
        format!("if {left} {sign} {right} {{ {below} }} else {otherwise}")
    }

    /// `TABLE_LIFT.at(x)`: the value and three derivatives.
    pub(super) fn lookup(&self, spline: SplineId, place: &Arithmetic) -> String {
        let table = table_name(&self.module.pool.graph.spline_of(spline).name);
        match self.is_in_lanes() {
            true => format!("lookup(&{table}, {})", self.whole(place)),
            false => format!("{table}.at({})", self.written(place)),
        }
    }

    fn product(&self, factors: &[Arithmetic]) -> String {
        let factors = factors.iter().enumerate().map(|(place, factor)| {
            let factor = self.operand(factor);
            match place {
                0 => factor,
                _ => format!(" * {factor}"),
            }
        });
        chained(factors.collect())
    }

    /// Returns a factor: sums, products, quotients and choices in parentheses.
    pub(super) fn operand(&self, arithmetic: &Arithmetic) -> String {
        let written = self.written(arithmetic);
        match arithmetic {
            Arithmetic::Sum(_)
            | Arithmetic::Product(_)
            | Arithmetic::Quotient(_)
            | Arithmetic::Choice(_) => format!("({written})"),
            _ => written,
        }
    }
}

/// Name of an elementary function in the runtime.
fn called(function: Elementary) -> &'static str {
    match function {
        Elementary::Sin => "sin",
        Elementary::Cos => "cos",
        Elementary::Exp => "exp",
        Elementary::Ln => "ln",
        Elementary::Atan2 => "atan2",
        Elementary::Floor => "floor",
        Elementary::Abs => "abs",
        Elementary::Sqrt => "sqrt",
        Elementary::Power => "powf",
    }
}

/// Number of operations in one expression, which compilers and formatters walk by recursion.
const LONGEST_CHAIN: usize = 500;

/// Returns a chain of operations; a long chain has partial results, in the same order.
fn chained(parts: Vec<String>) -> String {
    let mut chunks = parts.chunks(LONGEST_CHAIN);
    let first = chunks.next().unwrap_or_default().concat();
    let Some(last) = chunks.next_back() else {
        return first;
    };
    let steps = chunks.map(|chunk| format!("let partial = partial{};", chunk.concat()));
    let steps: String = steps.collect();
    format!(
        "{{ let partial = {first}; {steps} partial{} }}",
        last.concat()
    )
}
