//! Spelling of formulas in MathML.
//!
//! Every formula is a row of elements, which stands where a row may stand; where one element is needed, it is
//! wrapped.

use super::super::formula::{Printer, Spelling};
use super::super::parts::Fraction;
use super::super::typeset::{Index, Local, Typeset, letter_and_index, side_by_side};
use crate::emit::markup::escaped;
use crate::expr::{ExprId, Node};
use crate::system::System;

/// The notation of MathML.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MathMl;

/// Space between factors: a name of several letters would run into its neighbour.
const GAP: &str = "<mspace width=\"0.15em\"/>";

impl Spelling for MathMl {
    fn minus(self) -> &'static str {
        "<mo>−</mo>"
    }

    fn plus(self) -> &'static str {
        "<mo>+</mo>"
    }

    fn digits(self, digits: &str) -> String {
        format!("<mn>{digits}</mn>")
    }

    fn time(self) -> String {
        "<mi>t</mi>".to_string()
    }

    fn pi(self) -> &'static str {
        "<mi>π</mi>"
    }

    /// An axis at the end of a name becomes an index, and the square of a length is one.
    fn local(self, name: &str) -> String {
        match Local::of(name) {
            Local::SquaredLength(vector) => {
                let length = format!("<mo>|</mo>{}<mo>|</mo>", vector_name(vector));
                self.power(&length, "<mn>2</mn>")
            }
            Local::Component(vector, axis) => {
                format!("<msub>{}<mi>{axis}</mi></msub>", identifier(vector))
            }
            Local::Name(name) => identifier(name),
        }
    }

    fn arm(self, name: &str) -> String {
        identifier(name)
    }

    /// x₁, φ̈ with the index c1.
    fn unknown(self, unknown: usize, level: usize, system: &System) -> String {
        let (letter, index) = letter_and_index(system, unknown);
        let index = match index {
            Index::Name(index) => name(index),
            Index::Ends(ends) => name(&ends.replace('_', "\u{2009}")),
        };
        let letter = match level {
            0 => format!("<mi>{letter}</mi>"),
            _ => format!(
                "<mover accent=\"true\"><mi>{letter}</mi><mo stretchy=\"false\">{}</mo></mover>",
                ["˙", "¨"][level - 1]
            ),
        };
        format!("<msub data-q=\"{unknown}\">{letter}{index}</msub>")
    }

    fn choice(self, choices: &[[String; 2]], otherwise: &str, _inside: bool) -> String {
        let choices = choices.iter();
        let rows: String = choices
            .map(|[value, condition]| {
                format!("<mtr><mtd>{value}</mtd><mtd><mtext>if </mtext>{condition}</mtd></mtr>")
            })
            .collect();
        format!(
            "<mrow><mo>{{</mo><mtable class=\"cases\">{rows}<mtr><mtd>{otherwise}</mtd><mtd><mtext>otherwise</mtext></mtd></mtr></mtable></mrow>"
        )
    }

    fn fraction(self, fraction: &Fraction, printer: &Printer<'_, Self>) -> String {
        let is_symbol = |expr| matches!(printer.graph().node(expr), Node::Symbol(_) | Node::Pi);
        let is_short = |base| match *printer.graph().node(base) {
            Node::Sin(angle) | Node::Cos(angle) => is_symbol(angle),
            _ => is_symbol(base),
        };
        match Typeset::of(fraction, printer, self, is_short) {
            Typeset::Line(text) => text,
            Typeset::Bar {
                above,
                below,
                beside,
            } => {
                let beside = beside.map_or(String::new(), |it| format!("{GAP}{it}"));
                format!("<mfrac><mrow>{above}</mrow><mrow>{below}</mrow></mfrac>{beside}")
            }
        }
    }

    fn product(self, factors: &[(bool, String)]) -> String {
        side_by_side(factors, "<mo>·</mo>", GAP)
    }

    fn root(self, radicand: &str, is_digits: bool) -> String {
        match is_digits {
            true => format!("<msqrt><mn>{radicand}</mn></msqrt>"),
            false => format!("<msqrt>{radicand}</msqrt>"),
        }
    }

    fn exponent(self, numerator: i128, denominator: i128) -> String {
        let sign = if numerator < 0 { self.minus() } else { "" };
        let size = numerator.unsigned_abs();
        match denominator {
            1 if numerator >= 0 => format!("<mn>{size}</mn>"),
            1 => format!("<mrow>{sign}<mn>{size}</mn></mrow>"),
            _ => format!("<mrow>{sign}<mn>{size}</mn><mo>/</mo><mn>{denominator}</mn></mrow>"),
        }
    }

    fn power(self, base: &str, exponent: &str) -> String {
        format!("<msup><mrow>{base}</mrow>{exponent}</msup>")
    }

    fn comparison(self, left: &str, is_less: bool, right: &str) -> String {
        let sign = if is_less { "&lt;" } else { "&gt;" };
        format!("{left}<mo>{sign}</mo>{right}")
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
        let all = all.collect::<Vec<String>>().join("<mo>,</mo>");
        let written = match exponent {
            "" => format!("<mi>{name}</mi>"),
            _ => format!("<msup><mi>{name}</mi>{exponent}</msup>"),
        };
        match (name, arguments) {
            ("exp", _) => format!("<msup><mi>e</mi><mrow>{all}</mrow></msup>"),
            ("floor", _) => format!("<mrow><mo>⌊</mo>{all}<mo>⌋</mo></mrow>"),
            // A symbol stands alone after a function's name at the end of a term; everything else in parentheses.
            (_, [only]) if !followed && matches!(printer.graph().node(*only), Node::Symbol(_)) => {
                format!("{written}{GAP}{}", printer.operand(*only, false))
            }
            _ => format!("{written}{}", self.parentheses(&all)),
        }
    }

    fn table(self, name: &str, order: usize, argument: &str) -> String {
        let primes = "<mo>′</mo>".repeat(order);
        format!("{}{primes}{}", identifier(name), self.parentheses(argument))
    }

    fn parentheses(self, inner: &str) -> String {
        brackets(inner)
    }
}

/// Parentheses that do not grow, which those around symbols would by a little.
pub(super) const FIXED_PARENTHESES: [&str; 2] = [
    "<mo stretchy=\"false\">(</mo>",
    "<mo stretchy=\"false\">)</mo>",
];

/// Parentheses that grow with what is in them.
pub(super) const GROWING_PARENTHESES: [&str; 2] = ["<mo>(</mo>", "<mo>)</mo>"];

/// A row in parentheses, between which a line may be broken.
pub(crate) fn brackets(inner: &str) -> String {
    let tall = [
        "<mfrac>",
        "<mtable",
        "<msqrt>",
        "→",
        GROWING_PARENTHESES[0],
        FIXED_PARENTHESES[0],
    ];
    let [open, close] = match tall.iter().any(|it| inner.contains(it)) {
        true => GROWING_PARENTHESES,
        false => FIXED_PARENTHESES,
    };
    format!("{open}{inner}{close}")
}

/// A name in upright letters, or a number.
pub(crate) fn name(name: &str) -> String {
    match name.chars().all(|letter| letter.is_ascii_digit()) {
        true => format!("<mn>{name}</mn>"),
        false => format!("<mi mathvariant=\"normal\">{}</mi>", escaped(name)),
    }
}

/// A name as a symbol: a single letter is slanted.
fn identifier(name: &str) -> String {
    format!("<mi>{}</mi>", escaped(name))
}

/// The vector from one point to another, or a vector with a name of its own.
pub(crate) fn vector_name(name: &str) -> String {
    match name.chars().count() > 1 {
        true => format!(
            "<mover accent=\"true\"><mi mathvariant=\"normal\">{}</mi><mo>→</mo></mover>",
            escaped(name)
        ),
        false => format!(
            "<mi mathvariant=\"normal\" class=\"bold\">{}</mi>",
            escaped(name)
        ),
    }
}

/// A formula that is typed as text: numbers, names and signs.
pub(crate) fn typed(text: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let is_number = |letter: char| letter.is_ascii_digit() || letter == '.';
        let length =
            |holds: &dyn Fn(char) -> bool| rest.find(|letter| !holds(letter)).unwrap_or(rest.len());
        let taken = if first.is_whitespace() {
            first.len_utf8()
        } else if first.is_ascii_digit() {
            let taken = length(&is_number);
            out += &format!("<mn>{}</mn>", &rest[..taken]);
            taken
        } else if first.is_alphabetic() {
            let taken = length(&|letter| letter.is_alphanumeric() || letter == '_');
            out += &identifier(&rest[..taken]);
            taken
        } else {
            out += &match first {
                '-' => MathMl.minus().to_string(),
                _ => format!("<mo>{}</mo>", escaped(&first.to_string())),
            };
            first.len_utf8()
        };
        rest = &rest[taken..];
    }
    out
}

#[cfg(test)]
mod tests {
    use super::{name, typed};

    #[test]
    fn typed_formulas_have_their_elements() {
        assert_eq!(
            typed("k2 - 0.5<a"),
            "<mi>k2</mi><mo>−</mo><mn>0.5</mn><mo>&lt;</mo><mi>a</mi>"
        );
    }

    #[test]
    fn names_are_escaped() {
        assert_eq!(name("12"), "<mn>12</mn>");
        assert_eq!(name("<b>"), "<mi mathvariant=\"normal\">&lt;b&gt;</mi>");
    }
}
