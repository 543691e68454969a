//! How formulas are written in the math mode of LaTeX.

use super::super::formula::{Printer, Spelling};
use super::super::parts::{Fraction, Part};
use super::lines::chosen;
use crate::expr::{ExprId, Node};
use crate::system::{Described, System};

/// The notation of LaTeX.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Latex;

impl Spelling for Latex {
    fn minus(self) -> &'static str {
        "-"
    }

    fn pi(self) -> &'static str {
        "\\pi"
    }

    /// An axis at the end of a name becomes an index, and the square of a length is one.
    fn local(self, name: &str) -> String {
        let length = name.strip_prefix('|');
        if let Some(vector) = length.and_then(|rest| rest.strip_suffix("|^2")) {
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

    fn arm(self, name: &str) -> String {
        escaped(name)
    }

    /// `x_{1}`, `\dot{\varphi}_{c1}`.
    fn unknown(self, unknown: usize, level: usize, system: &System) -> String {
        let of_body = |name: &str| match name.chars().all(|letter| letter.is_ascii_digit()) {
            true => name.to_string(),
            false => format!("\\mathrm{{{}}}", escaped(name)),
        };
        let unknown = &system.vector_form.unknowns[unknown];
        let (letter, index) = match unknown.describes {
            Described::Pose { body, axis } => {
                let name = &system.mechanism.bodies[body].name;
                (["x", "y", "\\varphi"][axis], of_body(name))
            }
            Described::Contact { joint } => ("s", of_body(&system.mechanism.joints[joint].slug)),
            Described::Auxiliary => {
                let symbols = [("psi_", "\\psi"), ("offset_", "h"), ("length_", "\\ell")];
                let found = symbols.iter().find_map(|(prefix, letter)| {
                    Some((unknown.name.strip_prefix(prefix)?, *letter))
                });
                let (ends, letter) = found.unwrap_or((&unknown.name, "\\ell"));
                (letter, format!("\\mathrm{{{}}}", ends.replace('_', "\\,")))
            }
        };
        match level {
            0 => format!("{letter}_{{{index}}}"),
            _ => format!("\\{}dot{{{letter}}}_{{{index}}}", &"d"[..level - 1]),
        }
    }

    fn choice(self, choices: &[[String; 2]], otherwise: &str, _inside: bool) -> String {
        let choices = choices.iter();
        let choices: String = choices
            .map(|[value, condition]| format!("{} & {condition} \\\\ ", chosen(value)))
            .collect();
        let otherwise = chosen(otherwise);
        format!("\\begin{{cases}} {choices}{otherwise} & \\text{{otherwise}} \\end{{cases}}")
    }

    fn fraction(self, fraction: &Fraction, printer: &Printer<'_, Self>) -> String {
        let product = |parts: &[Part]| match parts {
            [] => "1".to_string(),
            parts => printer.product(parts, false),
        };
        if fraction.denominators.is_empty() {
            return product(&fraction.numerators);
        }
        // Only short numerators go over the bar; a long one stands beside its coefficient.
        let is_short = |part: &Part| match part {
            Part::Power(base, _) => {
                matches!(printer.graph().node(*base), Node::Symbol(_) | Node::Pi)
            }
            _ => true,
        };
        let numerators = fraction.numerators.iter().cloned();
        let (above, beside): (Vec<Part>, Vec<Part>) = numerators.partition(is_short);
        let (above, below) = (product(&above), product(&fraction.denominators));
        let bar = format!("\\frac{{{above}}}{{{below}}}");
        match beside.is_empty() {
            true => bar,
            false => format!("{bar} {}", product(&beside)),
        }
    }

    fn product(self, factors: &[(bool, String)]) -> String {
        let mut text = String::new();
        for (position, (is_digits, factor)) in factors.iter().enumerate() {
            // Digits after something need a sign between; symbols and functions stand side by side.
            text.push_str(match (position, is_digits) {
                (0, _) => "",
                (_, true) => " \\cdot ",
                (_, false) => " ",
            });
            text.push_str(factor);
        }
        text
    }

    fn root(self, radicand: &str, _is_digits: bool) -> String {
        format!("\\sqrt{{{radicand}}}")
    }

    fn exponent(self, numerator: i128, denominator: i128) -> String {
        match denominator {
            1 => format!("^{{{numerator}}}"),
            _ => format!("^{{{numerator}/{denominator}}}"),
        }
    }

    fn raises_names(self) -> bool {
        true
    }

    fn function(
        self,
        name: &str,
        exponent: &str,
        arguments: &[ExprId],
        followed: bool,
        printer: &Printer<'_, Self>,
    ) -> String {
        let all = arguments.iter().map(|it| printer.expression(*it));
        let all = all.collect::<Vec<String>>().join(", ");
        match (name, arguments) {
            ("atan2", _) => format!("\\operatorname{{atan2}}({all})"),
            ("exp", _) => format!("e^{{{all}}}"),
            ("floor", _) => format!("\\left\\lfloor {all} \\right\\rfloor"),
            // A symbol stands alone after a function's name at the end of a term; everything else in parentheses.
            (_, [only]) if !followed && matches!(printer.graph().node(*only), Node::Symbol(_)) => {
                format!("\\{name}{exponent} {}", printer.operand(*only, false))
            }
            _ => format!("\\{name}{exponent} {}", self.parentheses(&all)),
        }
    }

    fn table(self, name: &str, order: usize, argument: &str) -> String {
        let (name, primes) = (escaped(name), "'".repeat(order));
        format!("\\mathit{{{name}}}{primes}{}", self.parentheses(argument))
    }

    fn parentheses(self, inner: &str) -> String {
        format!("\\left({inner}\\right)")
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
