//! One expression → LaTeX for math mode.

use super::super::named_parts::NamedParts;
use super::super::parts::{Fraction, Part, addends, terms};
use crate::expr::{Comparison, ExprId, Graph, Node, Rational, Term};
use crate::system::{Described, SymbolRole, System, WrittenOrder};

/// Prints the formulas of one row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Printer<'a> {
    system: &'a System,
    order: WrittenOrder<'a>,
    parts: Option<&'a NamedParts>,
    /// Whether what is shared has a name, and not choices alone.
    is_long: bool,
}

impl<'a> Printer<'a> {
    /// A printer that mentions the bodies in this order.
    pub(crate) fn new(system: &'a System, bodies: &'a [usize]) -> Printer<'a> {
        Printer {
            system,
            order: WrittenOrder::new(system, bodies),
            parts: None,
            is_long: false,
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

    fn graph(&self) -> &'a Graph {
        &self.system.mechanism.graph
    }

    /// The whole expression.
    pub(crate) fn expression(&self, expr: ExprId) -> String {
        match self.name(expr) {
            Some(name) => local(&name),
            None => self.sum(&terms(expr, self.graph(), &self.order)),
        }
    }

    /// The name that stands for an expression.
    fn name(&self, expr: ExprId) -> Option<String> {
        let is_choice = matches!(self.graph().node(expr), Node::Choose { .. });
        let parts = self.parts.filter(|_| is_choice || self.is_long)?;
        parts.name(self.system, expr)
    }

    /// A choice, and those it continues with, as cases.
    fn cases(&self, mut expr: ExprId) -> String {
        let mut text = "\\begin{cases} ".to_string();
        while let Node::Choose {
            condition,
            below,
            otherwise,
        } = *self.graph().node(expr)
        {
            let (below, condition) = (self.expression(below), self.condition(condition));
            text.push_str(&format!("{below} & {condition} \\\\ "));
            expr = otherwise;
        }
        let last = self.expression(expr);
        text.push_str(&format!("{last} & \\text{{otherwise}} \\end{{cases}}"));
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

    fn sum(&self, terms: &[Term]) -> String {
        let addends = addends(terms, self.graph(), &self.order, &|expr| {
            self.name(expr).is_some()
        });
        let mut text = String::new();
        for (position, addend) in addends.iter().enumerate() {
            text.push_str(match (position, addend.negative) {
                (0, false) => "",
                (0, true) => "-",
                (_, false) => " + ",
                (_, true) => " - ",
            });
            text.push_str(&self.fraction(&addend.fraction));
        }
        text
    }

    fn fraction(&self, fraction: &Fraction) -> String {
        if fraction.denominators.is_empty() {
            return match fraction.numerators.as_slice() {
                [] => "1".to_string(),
                parts => self.product(parts),
            };
        }
        // Only short numerators go over the bar; a long one stands beside its coefficient.
        let (above, beside): (Vec<Part>, Vec<Part>) = fraction
            .numerators
            .iter()
            .cloned()
            .partition(|part| match part {
                Part::Power(base, _) => {
                    matches!(self.graph().node(*base), Node::Symbol(_) | Node::Pi)
                }
                _ => true,
            });
        let above = if above.is_empty() {
            "1".to_string()
        } else {
            self.product(&above)
        };
        let bar = format!(
            "\\frac{{{above}}}{{{}}}",
            self.product(&fraction.denominators)
        );
        if beside.is_empty() {
            bar
        } else {
            format!("{bar} {}", self.product(&beside))
        }
    }

    fn product(&self, parts: &[Part]) -> String {
        let mut text = String::new();
        let last = parts.len().saturating_sub(1);
        for (position, part) in parts.iter().enumerate() {
            // Digits after something need a sign between; symbols and functions stand side by side.
            let digits = matches!(part, Part::Digits(_));
            text.push_str(match position {
                0 => "",
                _ if digits => " \\cdot ",
                _ => " ",
            });
            text.push_str(&self.part(part, position < last));
        }
        text
    }

    /// One part of a product; `followed` by another that a reader could take into the argument of a function.
    fn part(&self, part: &Part, followed: bool) -> String {
        match part {
            Part::Digits(digits) => digits.clone(),
            Part::Root(radicand) => format!("\\sqrt{{{radicand}}}"),
            Part::Power(base, exponent) if *exponent == Rational::ONE => {
                self.operand(*base, followed)
            }
            Part::Power(base, exponent) => {
                let (numerator, denominator) = (exponent.numerator(), exponent.denominator());
                if (numerator, denominator) == (1, 2) {
                    return format!("\\sqrt{{{}}}", self.expression(*base));
                }
                let power = if denominator == 1 {
                    numerator.to_string()
                } else {
                    format!("{numerator}/{denominator}")
                };
                // The exponent of a function stands between its name and its argument.
                match self.graph().node(*base) {
                    _ if self.name(*base).is_some() => {
                        format!("{}^{{{power}}}", self.operand(*base, true))
                    }
                    Node::Sin(angle) => {
                        format!("\\sin^{{{power}}} {}", self.argument(*angle, followed))
                    }
                    Node::Cos(angle) => {
                        format!("\\cos^{{{power}}} {}", self.argument(*angle, followed))
                    }
                    _ => format!("{}^{{{power}}}", self.operand(*base, true)),
                }
            }
        }
    }

    fn operand(&self, expr: ExprId, followed: bool) -> String {
        if let Some(name) = self.name(expr) {
            return local(&name);
        }
        match self.graph().node(expr) {
            Node::Symbol(symbol) => match self.system.roles[symbol.index()] {
                SymbolRole::Arm(_)
                | SymbolRole::Intermediate
                | SymbolRole::Parameter(_)
                | SymbolRole::Input { .. } => local(self.system.local_name(*symbol)),
                role => self.symbol(role),
            },
            Node::Pi => "\\pi".to_string(),
            Node::Sin(angle) => format!("\\sin {}", self.argument(*angle, followed)),
            Node::Cos(angle) => format!("\\cos {}", self.argument(*angle, followed)),
            Node::Atan2(y, x) => {
                format!(
                    "\\operatorname{{atan2}}({}, {})",
                    self.expression(*y),
                    self.expression(*x)
                )
            }
            Node::Exp(exponent) => format!("e^{{{}}}", self.expression(*exponent)),
            Node::Ln(argument) => format!("\\ln {}", self.argument(*argument, followed)),
            Node::Floor(argument) => format!(
                "\\left\\lfloor {} \\right\\rfloor",
                self.expression(*argument)
            ),
            Node::Choose { .. } => self.cases(expr),
            Node::Spline {
                spline,
                order,
                argument,
            } => {
                let name = escaped(&self.graph().spline_of(*spline).name);
                let primes = "'".repeat(usize::from(*order));
                let argument = self.argument_in_parentheses(*argument);
                format!("\\mathit{{{name}}}{primes}{argument}")
            }
            Node::Number(_) | Node::Sum(_) | Node::Product(_) => self.argument_in_parentheses(expr),
        }
    }

    /// A symbol stands alone after a function's name at the end of a term; everything else in parentheses.
    fn argument(&self, expr: ExprId, followed: bool) -> String {
        match self.graph().node(expr) {
            Node::Symbol(_) if !followed => self.operand(expr, false),
            _ => self.argument_in_parentheses(expr),
        }
    }

    fn argument_in_parentheses(&self, expr: ExprId) -> String {
        format!("\\left({}\\right)", self.expression(expr))
    }

    /// `x_{1}`, `\dot{\varphi}_{c1}`, `t`.
    pub(crate) fn symbol(&self, role: SymbolRole) -> String {
        let (coordinate, accent) = match role {
            SymbolRole::Position(coordinate) => (coordinate, None),
            SymbolRole::Rate(coordinate) => (coordinate, Some("dot")),
            SymbolRole::Acceleration(coordinate) => (coordinate, Some("ddot")),
            SymbolRole::Arm(arm) => return escaped(&self.system.vector_form.arms[arm].name),
            SymbolRole::Parameter(parameter) => {
                let parameter = self.system.mechanism.parameters[parameter].symbol;
                return local(self.system.local_name(parameter));
            }
            SymbolRole::Input { input, level } => {
                let signal = self.system.mechanism.inputs[input].symbols[level];
                return local(self.system.local_name(signal));
            }
            SymbolRole::Intermediate | SymbolRole::Last(_) | SymbolRole::Time => {
                return "t".to_string();
            }
        };
        if coordinate >= self.system.coordinates.len() {
            let name = self.system.unknown_name(coordinate);
            let symbols = [("psi_", "\\psi"), ("offset_", "h"), ("length_", "\\ell")];
            let found = symbols
                .iter()
                .find_map(|(prefix, letter)| Some((name.strip_prefix(prefix)?, *letter)));
            let (ends, letter) = found.unwrap_or((name, "\\ell"));
            let index = format!("_{{\\mathrm{{{}}}}}", ends.replace('_', "\\,"));
            return match accent {
                None => format!("{letter}{index}"),
                Some(accent) => format!("\\{accent}{{{letter}}}{index}"),
            };
        }
        let (letter, body) = match self.system.coordinates[coordinate].describes {
            Described::Pose { body, axis } => {
                let letter = ["x", "y", "\\varphi"][axis];
                (letter, &self.system.mechanism.bodies[body].name)
            }
            Described::Contact { joint } => ("s", &self.system.mechanism.joints[joint].slug),
        };
        let index = if body.chars().all(|character| character.is_ascii_digit()) {
            body.clone()
        } else {
            format!("\\mathrm{{{}}}", escaped(body))
        };
        match accent {
            None => format!("{letter}_{{{index}}}"),
            Some(accent) => format!("\\{accent}{{{letter}}}_{{{index}}}"),
        }
    }
}

/// The name of an arm or of a value computed on the way; an axis at its end becomes an index, and the square of a length is one.
fn local(name: &str) -> String {
    let length = name
        .strip_prefix('|')
        .and_then(|rest| rest.strip_suffix("|^2"));
    if let Some(vector) = length {
        return format!("{{|{}|^2}}", vector_name(vector));
    }
    let axis = ["x", "y"]
        .into_iter()
        .find_map(|axis| Some((name.strip_suffix(axis)?.strip_suffix('_')?, axis)));
    match axis {
        Some((vector, axis)) => format!("\\mathit{{{}}}_{{{axis}}}", escaped(vector)),
        None => format!("\\mathit{{{}}}", escaped(name)),
    }
}

/// The vector from one point to another, or a vector with a name of its own.
pub(crate) fn vector_name(name: &str) -> String {
    match name.chars().count() > 1 {
        true => format!("\\overrightarrow{{\\mathrm{{{}}}}}", escaped(name)),
        false => format!("\\mathbf{{{name}}}"),
    }
}

/// A name with the characters that LaTeX reads as commands escaped.
pub(crate) fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        if matches!(character, '_' | '#' | '$' | '%' | '&' | '{' | '}') {
            escaped.push('\\');
        }
        escaped.push(character);
    }
    escaped
}
