//! Spelling of formulas in plain text.

use super::super::formula::{Printer, Spelling};
use super::super::notation::Notation;
use super::super::parts::Fraction;
use crate::expr::{ExprId, Node};
use crate::system::{Described, System};

impl Notation {
    /// Picks the spelling of the notation.
    fn either<T>(self, ascii: T, unicode: T) -> T {
        match self {
            Notation::Ascii => ascii,
            Notation::Unicode => unicode,
        }
    }
}

impl Spelling for Notation {
    fn minus(self) -> &'static str {
        self.either("-", "−")
    }

    fn pi(self) -> &'static str {
        self.either("pi", "π")
    }

    fn local(self, name: &str) -> String {
        // The square of a length has it in its name.
        name.replace("|^2", self.either("|^2", "|²"))
    }

    fn arm(self, name: &str) -> String {
        name.to_string()
    }

    /// `phi1`, `phi1'`, `phi1''`, or φ₁ with dots.
    fn unknown(self, unknown: usize, level: usize, system: &System) -> String {
        let unknown = &system.vector_form.unknowns[unknown];
        match (self, unknown.describes) {
            (Notation::Unicode, Described::Pose { body, axis }) => {
                let body = &system.mechanism.bodies[body].name;
                let letter = ["x", "y", "φ"][axis];
                let dots = ["", "\u{307}", "\u{308}"][level];
                let index: Option<String> = body.chars().map(lowered).collect();
                let index = index.unwrap_or_else(|| format!("_{body}"));
                format!("{letter}{dots}{index}")
            }
            _ => format!("{}{}", unknown.name, &"''"[..level]),
        }
    }

    /// `if t < 1 { 0 } else if t < 2 { t - 1 } else { 1 }`.
    fn choice(self, choices: &[[String; 2]], otherwise: &str, inside: bool) -> String {
        let choices = choices.iter();
        let choices: String = choices
            .map(|[value, condition]| format!("if {condition} {{ {value} }} else "))
            .collect();
        let text = format!("{choices}{{ {otherwise} }}");
        match inside {
            true => self.parentheses(&text),
            false => text,
        }
    }

    fn fraction(self, fraction: &Fraction, printer: &Printer<'_, Self>) -> String {
        let numerator = match fraction.numerators.as_slice() {
            [] => "1".to_string(),
            parts => printer.product(parts, !fraction.denominators.is_empty()),
        };
        match fraction.denominators.as_slice() {
            [] => numerator,
            [only] => format!("{numerator}/{}", printer.part(only, false)),
            parts => format!("{numerator}/({})", printer.product(parts, false)),
        }
    }

    fn product(self, factors: &[(bool, String)]) -> String {
        let factors: Vec<&str> = factors.iter().map(|(_, factor)| factor.as_str()).collect();
        factors.join(self.either("*", "·"))
    }

    fn root(self, radicand: &str, is_digits: bool) -> String {
        match (self, is_digits) {
            (Notation::Unicode, true) => format!("√{radicand}"),
            _ => format!("{}({radicand})", self.either("sqrt", "√")),
        }
    }

    fn exponent(self, numerator: i128, denominator: i128) -> String {
        match (self, denominator) {
            (Notation::Unicode, 1) => raised(numerator),
            (_, 1) => format!("^{numerator}"),
            _ => format!("^({numerator}/{denominator})"),
        }
    }

    fn raises_names(self) -> bool {
        false
    }

    fn function(
        self,
        name: &str,
        _exponent: &str,
        arguments: &[ExprId],
        followed: bool,
        printer: &Printer<'_, Self>,
    ) -> String {
        // The parentheses around a single symbol at the end of a term are left out: √3·cos φ₂, but cos(φ₁)·φ̇₁².
        if let (Notation::Unicode, [only], false) = (self, arguments, followed || name == "floor")
            && matches!(printer.graph().node(*only), Node::Symbol(_))
        {
            return format!("{name} {}", printer.operand(*only, false));
        }
        let arguments = arguments.iter().map(|it| printer.expression(*it));
        let arguments: Vec<String> = arguments.collect();
        format!("{name}({})", arguments.join(", "))
    }

    fn table(self, name: &str, order: usize, argument: &str) -> String {
        format!("{name}{}({argument})", "'".repeat(order))
    }

    fn parentheses(self, inner: &str) -> String {
        format!("({inner})")
    }
}

fn lowered(digit: char) -> Option<char> {
    let value = digit.to_digit(10)?;
    char::from_u32('₀' as u32 + value)
}

/// An integer in raised digits.
fn raised(exponent: i128) -> String {
    let digits = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raised = |letter: char| {
        let digit = letter.to_digit(10);
        digit.map_or('⁻', |digit| digits[digit as usize])
    };
    exponent.to_string().chars().map(raised).collect()
}
