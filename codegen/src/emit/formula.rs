//! Writes one expression on one line, in the spelling of a notation.
//!
//! The order of terms, fractions and parentheses are equal in all notations; a [`Spelling`] writes each part.

use super::named_parts::NamedParts;
use super::parts::{Addend, Fraction, Part, addends, fraction, terms};
use crate::expr::{Comparison, ExprId, Graph, Node, Rational, Term};
use crate::pool::{Pool, SymbolRole};
use crate::program::ConstantPart;
use crate::system::{System, WrittenOrder};

/// Spelling of the parts of a formula.
pub(crate) trait Spelling: Copy {
    /// The sign before a term that is subtracted.
    fn minus(self) -> &'static str;

    /// The sign before a term that is added.
    fn plus(self) -> &'static str {
        "+"
    }

    /// A number without a sign.
    fn digits(self, digits: &str) -> String {
        digits.to_string()
    }

    /// The time.
    fn time(self) -> String {
        "t".to_string()
    }

    /// π.
    fn pi(self) -> &'static str;

    /// Name other than a coordinate's: `l_c3_x`.
    fn local(self, name: &str) -> String;

    /// The name of a vector.
    fn arm(self, name: &str) -> String;

    /// An unknown, its rate or its acceleration.
    fn unknown(self, unknown: usize, level: usize, system: &System) -> String;

    /// Choices, each with its condition, and the remaining value; `inside` a product or not.
    fn choice(self, choices: &[[String; 2]], otherwise: &str, inside: bool) -> String;

    /// A fraction.
    fn fraction(self, fraction: &Fraction, printer: &Printer<'_, Self>) -> String;

    /// A product of factors, some of which are digits.
    fn product(self, factors: &[(bool, String)]) -> String;

    /// Square root of a number in digits, or of another formula.
    fn root(self, radicand: &str, is_digits: bool) -> String;

    /// Exponent behind a base.
    fn exponent(self, numerator: i128, denominator: i128) -> String;

    /// A base with its exponent.
    fn power(self, base: &str, exponent: &str) -> String {
        format!("{base}{exponent}")
    }

    /// `left < right`, or `left > right`.
    fn comparison(self, left: &str, is_less: bool, right: &str) -> String {
        let sign = if is_less { '<' } else { '>' };
        format!("{left} {sign} {right}")
    }

    /// True if the exponent of a sine or a cosine stands behind its name.
    fn raises_names(self) -> bool;

    /// Function of these arguments; `followed` is true before text that could be taken for part of the argument.
    fn function(
        self,
        name: &str,
        exponent: &str,
        arguments: &[ExprId],
        followed: bool,
        printer: &Printer<'_, Self>,
    ) -> String;

    /// A derivative of a table's function.
    fn table(self, name: &str, order: usize, argument: &str) -> String;

    /// Something in parentheses.
    fn parentheses(self, inner: &str) -> String;
}

/// Prints the formulas of one row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Printer<'a, S> {
    pub(super) pool: &'a Pool,
    system: &'a System,
    order: WrittenOrder<'a>,
    spelling: S,
    parts: Option<&'a NamedParts>,
    /// True if shared parts have names, and not choices alone.
    is_long: bool,
    /// True if constants are written exactly at any length.
    is_exact: bool,
}

impl<'a, S: Spelling> Printer<'a, S> {
    /// Printer that mentions the bodies in this order.
    pub(crate) fn new(
        pool: &'a Pool,
        system: &'a System,
        bodies: &'a [usize],
        spelling: S,
    ) -> Printer<'a, S> {
        Printer {
            pool,
            system,
            order: WrittenOrder::new(pool, system, bodies),
            spelling,
            parts: None,
            is_long: false,
            is_exact: false,
        }
    }

    /// Printer with names for long choices; in a long formula for every named part.
    pub(crate) fn naming(self, parts: &'a NamedParts, is_long: bool) -> Printer<'a, S> {
        Printer {
            parts: Some(parts),
            is_long,
            ..self
        }
    }

    /// Printer that writes every constant exactly at any length.
    pub(crate) fn exact(self) -> Printer<'a, S> {
        Printer {
            is_exact: true,
            ..self
        }
    }

    /// The graph of the formulas.
    pub(super) fn graph(&self) -> &'a Graph {
        &self.pool.graph
    }

    /// Name of an expression.
    fn name(&self, expr: ExprId) -> Option<String> {
        let is_choice = matches!(self.graph().node(expr), Node::Choose { .. });
        let parts = self.parts.filter(|_| is_choice || self.is_long)?;
        Some(
            self.spelling
                .local(&parts.name(self.pool, self.system, expr)?),
        )
    }

    /// The whole expression.
    pub(crate) fn expression(&self, expr: ExprId) -> String {
        self.name(expr).unwrap_or_else(|| self.written_out(expr))
    }

    /// Whole expression, even if it has a name.
    pub(crate) fn written_out(&self, expr: ExprId) -> String {
        match self.graph().node(expr) {
            Node::Choose { .. } => self.choice(expr, false),
            _ => self.sum(&terms(expr, self.graph(), &self.order)),
        }
    }

    /// A choice, and those it continues with.
    fn choice(&self, mut expr: ExprId, inside: bool) -> String {
        let mut choices = Vec::new();
        while let Node::Choose {
            condition,
            below,
            otherwise,
        } = *self.graph().node(expr)
        {
            choices.push([self.expression(below), self.condition(condition)]);
            expr = otherwise;
        }
        self.spelling
            .choice(&choices, &self.expression(expr), inside)
    }

    /// `t < 2` of the condition t - 2.
    fn condition(&self, condition: ExprId) -> String {
        let Comparison {
            left,
            is_less,
            right,
        } = self.graph().comparison(condition);
        let [left, right] = [left, right].map(|terms| match terms.is_empty() {
            true => self.spelling.digits("0"),
            false => self.sum(&self.order.terms(&terms)),
        });
        self.spelling.comparison(&left, is_less, &right)
    }

    /// A constant part: a sum, or a number times powers.
    pub(crate) fn constant(&self, part: &ConstantPart) -> String {
        match part {
            ConstantPart::Sum(terms) => self.sum(terms),
            ConstantPart::Product(number, factors) => {
                let number = Term {
                    coefficient: *number,
                    expr: self.graph().one(),
                };
                let mut whole = fraction(&number, self.graph(), &self.order);
                for factor in factors {
                    whole.push(*factor);
                }
                self.spelling.fraction(&whole, self)
            }
        }
    }

    fn sum(&self, terms: &[Term]) -> String {
        let addends = match self.is_exact {
            true => self.exact_addends(terms),
            false => addends(terms, self.graph(), &self.order, &|expr| {
                self.name(expr).is_some()
            }),
        };
        let (plus, minus) = (self.spelling.plus(), self.spelling.minus());
        let mut text = String::new();
        for (position, addend) in addends.iter().enumerate() {
            match (position, addend.negative) {
                (0, false) => {}
                (0, true) => text.push_str(minus),
                (_, false) => text.push_str(&format!(" {plus} ")),
                (_, true) => text.push_str(&format!(" {minus} ")),
            }
            text.push_str(&self.spelling.fraction(&addend.fraction, self));
        }
        text
    }

    fn exact_addends(&self, terms: &[Term]) -> Vec<Addend> {
        let terms = terms.iter().map(|term| Addend {
            negative: term.coefficient.is_negative(),
            fraction: fraction(term, self.graph(), &self.order),
        });
        terms.collect()
    }

    /// A product; `followed` by a division or not.
    pub(super) fn product(&self, parts: &[Part], followed: bool) -> String {
        let last = parts.len().saturating_sub(1);
        let factor = |(index, part)| {
            let is_digits = matches!(part, &Part::Digits(_));
            (is_digits, self.part(part, followed || index < last))
        };
        let factors: Vec<(bool, String)> = parts.iter().enumerate().map(factor).collect();
        self.spelling.product(&factors)
    }

    /// Factor of a product; `followed` is true before text that could be taken for part of a function's argument.
    pub(super) fn part(&self, part: &Part, followed: bool) -> String {
        let (base, exponent) = match part {
            Part::Digits(digits) => return self.spelling.digits(digits),
            Part::Root(radicand) => return self.spelling.root(&radicand.to_string(), true),
            Part::Power(base, exponent) => (*base, exponent),
        };
        if *exponent == Rational::ONE {
            return self.operand(base, followed);
        }
        let (numerator, denominator) = (exponent.numerator(), exponent.denominator());
        if (numerator, denominator) == (1, 2) {
            return self.spelling.root(&self.expression(base), false);
        }
        let exponent = self.spelling.exponent(numerator, denominator);
        let raises_name = self.spelling.raises_names() && self.name(base).is_none();
        let function = |name, angle| {
            let spelling = self.spelling;
            spelling.function(name, &exponent, &[angle], followed, self)
        };
        match *self.graph().node(base) {
            Node::Sin(angle) if raises_name => function("sin", angle),
            Node::Cos(angle) if raises_name => function("cos", angle),
            _ => {
                let base = self.operand(base, true);
                self.spelling.power(&base, &exponent)
            }
        }
    }

    /// Expression beside a multiplication sign or under a power.
    pub(super) fn operand(&self, expr: ExprId, followed: bool) -> String {
        if let Some(name) = self.name(expr) {
            return name;
        }
        let function = |name, arguments: &[ExprId]| {
            let spelling = self.spelling;
            spelling.function(name, "", arguments, followed, self)
        };
        match *self.graph().node(expr) {
            Node::Symbol(symbol) => match self.pool.role(symbol) {
                SymbolRole::Arm(_) | SymbolRole::Intermediate => {
                    self.spelling.local(self.pool.local_name(symbol))
                }
                role => self.symbol(role),
            },
            Node::Pi => self.spelling.pi().to_string(),
            Node::Sin(angle) => function("sin", &[angle]),
            Node::Cos(angle) => function("cos", &[angle]),
            Node::Atan2(y, x) => function("atan2", &[y, x]),
            Node::Exp(exponent) => function("exp", &[exponent]),
            Node::Ln(argument) => function("ln", &[argument]),
            Node::Floor(argument) => function("floor", &[argument]),
            Node::Choose { .. } => self.choice(expr, true),
            Node::Spline {
                spline,
                order,
                argument,
            } => {
                let name = &self.graph().spline_of(spline).name;
                let argument = self.expression(argument);
                self.spelling.table(name, order.into(), &argument)
            }
            Node::Number(_) | Node::Sum(_) | Node::Product(_) => {
                self.spelling.parentheses(&self.written_out(expr))
            }
        }
    }

    /// Formula of the symbol with this role.
    pub(crate) fn symbol(&self, role: SymbolRole) -> String {
        let (system, spelling) = (self.system, self.spelling);
        match role {
            SymbolRole::Position(unknown) => spelling.unknown(unknown, 0, system),
            SymbolRole::Rate(unknown) => spelling.unknown(unknown, 1, system),
            SymbolRole::Acceleration(unknown) => spelling.unknown(unknown, 2, system),
            SymbolRole::Arm(arm) => spelling.arm(&self.pool.arms()[arm].name),
            SymbolRole::Parameter(parameter) => spelling.local(
                self.pool
                    .local_name(system.mechanism.parameters[parameter].symbol),
            ),
            SymbolRole::Input { input, level } => spelling.local(
                self.pool
                    .local_name(system.mechanism.inputs[input].symbols[level]),
            ),
            SymbolRole::Intermediate | SymbolRole::Last(_) | SymbolRole::Time => spelling.time(),
        }
    }
}
