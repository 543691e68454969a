//! One expression → one line of text.

use super::super::named_parts::NamedParts;
use super::super::notation::Notation;

use super::super::parts::{Addend, Fraction, Part, addends, fraction, terms};
use crate::expr::{Comparison, ExprId, Graph, Node, Rational, Term};
use crate::program::ConstantPart;
use crate::system::{Described, SymbolRole, System, WrittenOrder};

/// Prints the formulas of one row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Printer<'a> {
    system: &'a System,
    order: WrittenOrder<'a>,
    notation: Notation,
    parts: Option<&'a NamedParts>,
    /// Whether what is shared has a name, and not choices alone.
    is_long: bool,
    /// Whether constants are written exactly, however long they are.
    is_exact: bool,
}

impl<'a> Printer<'a> {
    /// A printer that mentions the bodies in this order.
    pub(crate) fn new(system: &'a System, bodies: &'a [usize], notation: Notation) -> Printer<'a> {
        Printer {
            system,
            order: WrittenOrder::new(system, bodies),
            notation,
            parts: None,
            is_long: false,
            is_exact: false,
        }
    }

    /// The same, with names in the place of long choices; in a long formula of everything that has one.
    pub(crate) fn naming(self, parts: &'a NamedParts, is_long: bool) -> Printer<'a> {
        Printer {
            parts: Some(parts),
            is_long,
            ..self
        }
    }

    /// The same with every constant written exactly, however long it is.
    pub(crate) fn exact(self) -> Printer<'a> {
        Printer {
            is_exact: true,
            ..self
        }
    }

    /// The name that stands for an expression.
    fn name(&self, expr: ExprId) -> Option<String> {
        let is_choice = matches!(self.graph().node(expr), Node::Choose { .. });
        let parts = self.parts.filter(|_| is_choice || self.is_long)?;
        parts.name(self.system, expr)
    }

    fn graph(&self) -> &'a Graph {
        &self.system.mechanism.graph
    }

    /// Picks the spelling of the notation.
    fn either<T>(&self, ascii: T, unicode: T) -> T {
        match self.notation {
            Notation::Ascii => ascii,
            Notation::Unicode => unicode,
        }
    }

    /// The whole expression.
    pub(crate) fn expression(&self, expr: ExprId) -> String {
        self.name(expr).unwrap_or_else(|| self.written_out(expr))
    }

    /// The whole expression, whether or not it has a name.
    pub(crate) fn written_out(&self, expr: ExprId) -> String {
        match self.graph().node(expr) {
            Node::Choose { .. } => self.choice(expr),
            _ => self.sum(&terms(expr, self.graph(), &self.order)),
        }
    }

    /// `if t < 1 { 0 } else if t < 2 { t - 1 } else { 1 }`.
    fn choice(&self, mut expr: ExprId) -> String {
        let mut text = String::new();
        while let Node::Choose {
            condition,
            below,
            otherwise,
        } = *self.graph().node(expr)
        {
            let (condition, below) = (self.condition(condition), self.expression(below));
            text.push_str(&format!("if {condition} {{ {below} }} else "));
            expr = otherwise;
        }
        text.push_str(&format!("{{ {} }}", self.expression(expr)));
        text
    }

    /// `t < 2` of the condition t - 2.
    fn condition(&self, condition: ExprId) -> String {
        let Comparison {
            left,
            is_less,
            right,
        } = self.graph().comparison(condition);
        let sign = if is_less { '<' } else { '>' };
        let [left, right] = [left, right].map(|terms| match terms.is_empty() {
            true => "0".to_string(),
            false => self.sum(&self.order.terms(&terms)),
        });
        format!("{left} {sign} {right}")
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
                self.fraction(&whole)
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
        let mut text = String::new();
        for (position, addend) in addends.iter().enumerate() {
            text.push_str(match (position, addend.negative) {
                (0, false) => "",
                (0, true) => self.either("-", "−"),
                (_, false) => " + ",
                (_, true) => self.either(" - ", " − "),
            });
            text.push_str(&self.fraction(&addend.fraction));
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

    fn fraction(&self, fraction: &Fraction) -> String {
        let numerator = match fraction.numerators.as_slice() {
            [] => "1".to_string(),
            parts => self.product(parts, !fraction.denominators.is_empty()),
        };
        match fraction.denominators.as_slice() {
            [] => numerator,
            [only] => format!("{numerator}/{}", self.part(only, false)),
            parts => format!("{numerator}/({})", self.product(parts, false)),
        }
    }

    /// A product; `followed` by a division or not.
    fn product(&self, parts: &[Part], followed: bool) -> String {
        let last = parts.len().saturating_sub(1);
        let part = |(index, part)| self.part(part, followed || index < last);
        let parts: Vec<String> = parts.iter().enumerate().map(part).collect();
        parts.join(self.either("*", "·"))
    }

    /// One part of a product; `followed` by something that a reader could take into the argument of a function.
    fn part(&self, part: &Part, followed: bool) -> String {
        match part {
            Part::Digits(digits) => digits.clone(),
            Part::Root(radicand) => match self.notation {
                Notation::Ascii => format!("sqrt({radicand})"),
                Notation::Unicode => format!("√{radicand}"),
            },
            Part::Power(base, exponent) if *exponent == Rational::ONE => {
                self.operand(*base, followed)
            }
            Part::Power(base, exponent)
                if (exponent.numerator(), exponent.denominator()) == (1, 2) =>
            {
                let radicand = self.expression(*base);
                format!("{}({radicand})", self.either("sqrt", "√"))
            }
            Part::Power(base, exponent) => {
                let base = self.operand(*base, true);
                let (numerator, denominator) = (exponent.numerator(), exponent.denominator());
                match (self.notation, denominator) {
                    (Notation::Unicode, 1) => format!("{base}{}", raised(numerator)),
                    (_, 1) => format!("{base}^{numerator}"),
                    _ => format!("{base}^({numerator}/{denominator})"),
                }
            }
        }
    }

    /// An expression that stands beside a multiplication sign or under a power.
    fn operand(&self, expr: ExprId, followed: bool) -> String {
        if let Some(name) = self.name(expr) {
            return name;
        }
        match self.graph().node(expr) {
            Node::Symbol(symbol) => match self.system.roles[symbol.index()] {
                SymbolRole::Arm(_)
                | SymbolRole::Intermediate
                | SymbolRole::Parameter(_)
                | SymbolRole::Input { .. } => {
                    let name = self.system.local_name(*symbol);
                    match self.notation {
                        // The square of a length has it in its name.
                        Notation::Unicode => name.replace("|^2", "|²"),
                        Notation::Ascii => name.to_string(),
                    }
                }
                role => self.symbol(role),
            },
            Node::Pi => self.either("pi", "π").to_string(),
            Node::Sin(angle) => self.function("sin", &[*angle], followed),
            Node::Cos(angle) => self.function("cos", &[*angle], followed),
            Node::Atan2(y, x) => self.function("atan2", &[*y, *x], followed),
            Node::Exp(exponent) => self.function("exp", &[*exponent], followed),
            Node::Ln(argument) => self.function("ln", &[*argument], followed),
            Node::Floor(argument) => self.function("floor", &[*argument], true),
            Node::Choose { .. } => format!("({})", self.choice(expr)),
            Node::Spline {
                spline,
                order,
                argument,
            } => {
                let name = &self.graph().spline_of(*spline).name;
                let primes = "'".repeat(usize::from(*order));
                self.function(&format!("{name}{primes}"), &[*argument], true)
            }
            Node::Number(_) | Node::Sum(_) | Node::Product(_) => {
                format!("({})", self.written_out(expr))
            }
        }
    }

    fn function(&self, name: &str, arguments: &[ExprId], followed: bool) -> String {
        // A person leaves out the parentheses around a single symbol at the end of a term: √3·cos φ₂, but cos(φ₁)·φ̇₁².
        if let (Notation::Unicode, [only], false) = (self.notation, arguments, followed)
            && matches!(self.graph().node(*only), Node::Symbol(_))
        {
            return format!("{name} {}", self.operand(*only, false));
        }
        let arguments: Vec<String> = arguments
            .iter()
            .map(|argument| self.expression(*argument))
            .collect();
        format!("{name}({})", arguments.join(", "))
    }

    /// `phi1`, `phi1'`, `phi1''`, or φ₁ with dots.
    pub(crate) fn symbol(&self, role: SymbolRole) -> String {
        let (coordinate, level) = match role {
            SymbolRole::Position(coordinate) => (coordinate, 0),
            SymbolRole::Rate(coordinate) => (coordinate, 1),
            SymbolRole::Acceleration(coordinate) => (coordinate, 2),
            SymbolRole::Arm(arm) => return self.system.vector_form.arms[arm].name.clone(),
            SymbolRole::Parameter(parameter) => {
                let parameter = self.system.mechanism.parameters[parameter].symbol;
                return self.system.local_name(parameter).to_string();
            }
            SymbolRole::Input { input, level } => {
                let signal = self.system.mechanism.inputs[input].symbols[level];
                return self.system.local_name(signal).to_string();
            }
            SymbolRole::Intermediate | SymbolRole::Last(_) | SymbolRole::Time => {
                return "t".to_string();
            }
        };
        let name = self.system.unknown_name(coordinate);
        let coordinate = self.system.coordinates.get(coordinate);
        match (
            self.notation,
            coordinate.map(|coordinate| coordinate.describes),
        ) {
            (Notation::Unicode, Some(Described::Pose { body, axis })) => {
                let body = &self.system.mechanism.bodies[body].name;
                let letter = ["x", "y", "φ"][axis];
                let dots = ["", "\u{307}", "\u{308}"][level];
                let index: Option<String> = body.chars().map(lowered).collect();
                let index = index.unwrap_or_else(|| format!("_{body}"));
                format!("{letter}{dots}{index}")
            }
            _ => format!("{name}{}", &"''"[..level]),
        }
    }
}

fn lowered(digit: char) -> Option<char> {
    let value = digit.to_digit(10)?;
    char::from_u32('₀' as u32 + value)
}

/// An integer in raised digits.
fn raised(exponent: i128) -> String {
    let digits = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let text = exponent.to_string();
    text.chars()
        .map(|character| {
            character
                .to_digit(10)
                .map_or('⁻', |digit| digits[digit as usize])
        })
        .collect()
}
