//! Writes expressions in C.

use super::printer::Printer;
use super::tables::table_name;
use crate::emit::module::scope::Scope;
use crate::expr::ExprId;
use crate::program::{Arithmetic, Choice, Elementary};

impl Printer<'_> {
    /// Returns an expression as text.
    pub(super) fn expression(&self, expr: ExprId, scope: &Scope<'_>) -> String {
        self.written(&scope.evaluation().value(expr), scope)
    }

    /// Returns the results of a function, with the terms of each in the order of its row.
    pub(super) fn results(&self, scope: &Scope<'_>) -> Vec<String> {
        let results = scope.function.results.iter();
        results
            .map(|result| self.written(&scope.evaluation().result(result), scope))
            .collect()
    }

    /// Returns arithmetic as text.
    pub(super) fn written(&self, arithmetic: &Arithmetic, scope: &Scope<'_>) -> String {
        match arithmetic {
            Arithmetic::Number(value) => self.number(*value),
            Arithmetic::Constant(place) => {
                self.own_constant(&self.module.program.constants.list()[*place].name)
            }
            Arithmetic::Variable(symbol) => self.symbol(*symbol, scope),
            Arithmetic::Sum(terms) => {
                let mut text = String::new();
                for (place, (is_negative, term)) in terms.iter().enumerate() {
                    let is_whole = matches!(term, Arithmetic::Choice(_));
                    let term = match is_whole {
                        true => self.operand(term, scope),
                        false => self.written(term, scope),
                    };
                    // Two signs would be an operator of their own.
                    let term = match *is_negative && term.starts_with('-') {
                        true => format!("({term})"),
                        false => term,
                    };
                    text.push_str(match (place, is_negative) {
                        (0, false) => "",
                        (0, true) => "-",
                        (_, false) => " + ",
                        (_, true) => " - ",
                    });
                    text.push_str(&term);
                }
                text
            }
            Arithmetic::Product(factors) => self.product(factors, scope),
            Arithmetic::Quotient(both) => {
                let [numerator, denominator] = &**both;
                let numerator = match numerator {
                    Arithmetic::Product(factors) => self.product(factors, scope),
                    _ => self.operand(numerator, scope),
                };
                format!("{numerator} / {}", self.operand(denominator, scope))
            }
            Arithmetic::Call(function, arguments) => {
                let arguments = arguments.iter().map(|it| self.written(it, scope));
                let arguments: Vec<String> = arguments.collect();
                format!("{}({})", self.called(*function), arguments.join(", "))
            }
            Arithmetic::Lookup {
                spline,
                order,
                place,
            } => {
                let table = table_name(self, *spline);
                let value = self.runtime("table_value");
                let place = self.written(place, scope);
                format!("{value}({table}(), {place}, {order}U)")
            }
            Arithmetic::Choice(choice) => self.choice(choice, scope),
        }
    }

    /// `(x < 2.0) ? … : …`; a second arm that is another choice continues it.
    fn choice(&self, choice: &Choice, scope: &Scope<'_>) -> String {
        let side = |side: &Arithmetic| match side {
            Arithmetic::Choice(_) => self.operand(side, scope),
            _ => self.written(side, scope),
        };
        let sign = if choice.is_less { '<' } else { '>' };
        let (left, right) = (side(&choice.left), side(&choice.right));
        let (below, otherwise) = (side(&choice.below), self.written(&choice.otherwise, scope));
        format!("({left} {sign} {right}) ? {below} : {otherwise}")
    }

    fn product(&self, factors: &[Arithmetic], scope: &Scope<'_>) -> String {
        let factors = factors.iter().map(|it| self.operand(it, scope));
        factors.collect::<Vec<_>>().join(" * ")
    }

    /// Returns a factor: sums, products, quotients and choices in parentheses.
    pub(super) fn operand(&self, arithmetic: &Arithmetic, scope: &Scope<'_>) -> String {
        let written = self.written(arithmetic, scope);
        match arithmetic {
            Arithmetic::Sum(_)
            | Arithmetic::Product(_)
            | Arithmetic::Quotient(_)
            | Arithmetic::Choice(_) => format!("({written})"),
            _ => written,
        }
    }

    /// Returns the name of an elementary function.
    fn called(&self, function: Elementary) -> String {
        let suffix = self.suffix();
        match function {
            Elementary::Sin => self.runtime("sin"),
            Elementary::Cos => self.runtime("cos"),
            Elementary::Atan2 => self.runtime("atan2"),
            Elementary::Exp => self.runtime("exp"),
            Elementary::Ln => format!("log{suffix}"),
            Elementary::Floor => format!("floor{suffix}"),
            Elementary::Abs => format!("fabs{suffix}"),
            Elementary::Sqrt => format!("sqrt{suffix}"),
            Elementary::Power => format!("pow{suffix}"),
        }
    }
}
