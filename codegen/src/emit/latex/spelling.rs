//! Spelling of formulas in the math mode of LaTeX.

use super::super::formula::{Printer, Spelling};
use super::super::parts::Fraction;
use super::super::typeset::{Index, Local, Typeset, letter_and_index, side_by_side};
use super::lines::chosen;
use crate::expr::{ExprId, Node};
use crate::system::System;

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
        match Local::of(name) {
            Local::SquaredLength(vector) => format!("{{|{}|^2}}", vector_name(vector)),
            Local::Component(vector, axis) => {
                format!("\\mathit{{{}}}_{{{axis}}}", escaped(vector))
            }
            Local::Name(name) => format!("\\mathit{{{}}}", escaped(name)),
        }
    }

    fn arm(self, name: &str) -> String {
        escaped(name)
    }

    /// `x_{1}`, `\dot{\varphi}_{c1}`.
    fn unknown(self, unknown: usize, level: usize, system: &System) -> String {
        let (letter, index) = letter_and_index(system, unknown);
        let letter = match letter {
            'φ' => "\\varphi".to_string(),
            'ψ' => "\\psi".to_string(),
            'ℓ' => "\\ell".to_string(),
            other => other.to_string(),
        };
        let index = match index {
            Index::Name(name) if name.chars().all(|letter| letter.is_ascii_digit()) => {
                name.to_string()
            }
            Index::Name(name) => format!("\\mathrm{{{}}}", escaped(name)),
            Index::Ends(ends) => format!("\\mathrm{{{}}}", ends.replace('_', "\\,")),
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
        let is_symbol = |base| matches!(printer.graph().node(base), Node::Symbol(_) | Node::Pi);
        match Typeset::of(fraction, printer, self, is_symbol) {
            Typeset::Line(text) => text,
            Typeset::Bar {
                above,
                below,
                beside,
            } => {
                let beside = beside.map_or(String::new(), |it| format!(" {it}"));
                format!("\\frac{{{above}}}{{{below}}}{beside}")
            }
        }
    }

    fn product(self, factors: &[(bool, String)]) -> String {
        side_by_side(factors, " \\cdot ", " ")
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
