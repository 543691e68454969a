//! Spelling of words and formulas as typed text, as LaTeX, or as HTML with MathML.

use crate::emit::formula::Printer;
use crate::emit::formula::Spelling as _;
use crate::emit::latex::Latex;
use crate::emit::markup::escaped;
use crate::emit::mathml::MathMl;
use crate::emit::named_parts::NamedParts;
use crate::emit::{Notation, latex, mathml, text};
use crate::expr::ExprId;
use crate::pool::{Pool, SymbolRole};
use crate::system::System;

/// Script of words and formulas.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Script {
    /// Plain text.
    Text(Notation),
    /// Formulas for math mode, words escaped.
    Latex,
    /// Formulas as rows of MathML, words escaped.
    Html,
}

impl Script {
    /// Picks the argument for the script.
    fn either<'a>(
        self,
        ascii: &'a str,
        unicode: &'a str,
        latex: &'a str,
        mathml: &'a str,
    ) -> &'a str {
        match self {
            Script::Html => mathml,
            Script::Text(Notation::Ascii) => ascii,
            Script::Text(Notation::Unicode) => unicode,
            Script::Latex => latex,
        }
    }

    /// An expression as a formula, with the names of parts where it is long.
    pub(super) fn expression(
        self,
        pool: &Pool,
        system: &System,
        parts: &NamedParts,
        is_long: bool,
        expr: ExprId,
    ) -> String {
        match self {
            Script::Text(notation) => Printer::new(pool, system, &[], notation)
                .naming(parts, is_long)
                .expression(expr),
            Script::Latex => Printer::new(pool, system, &[], Latex)
                .naming(parts, is_long)
                .expression(expr),
            Script::Html => Printer::new(pool, system, &[], MathMl)
                .naming(parts, is_long)
                .expression(expr),
        }
    }

    /// The value of a name, a choice written out.
    pub(super) fn value(self, pool: &Pool, system: &System, value: ExprId) -> String {
        match self {
            Script::Text(notation) => text::formula(pool, system, &[], notation, value),
            Script::Latex => latex::formula(pool, system, &[], value),
            Script::Html => mathml::formula(pool, system, &[], value),
        }
    }

    /// An unknown, a rate or an acceleration as a formula.
    pub(super) fn symbol(self, pool: &Pool, system: &System, role: SymbolRole) -> String {
        match self {
            Script::Text(notation) => text::symbol(pool, system, notation, role),
            Script::Latex => latex::symbol(pool, system, role),
            Script::Html => mathml::symbol(pool, system, role),
        }
    }

    /// A formula between words.
    pub(super) fn inline(self, formula: &str) -> String {
        match self {
            Script::Text(_) => formula.to_string(),
            Script::Latex => format!("${formula}$"),
            Script::Html => format!("<math>{formula}</math>"),
        }
    }

    /// A sentence in which formulas that follow one another are one.
    pub(super) fn joined(self, sentence: &str) -> String {
        sentence.replace(self.either("$$", "$$", "$$", "</math><math>"), "")
    }

    /// Words of a sentence.
    pub(super) fn words(self, text: &str) -> String {
        match self {
            Script::Text(_) | Script::Latex => text.to_string(),
            Script::Html => escaped(text),
        }
    }

    /// A formula that is typed as text.
    pub(super) fn typed(self, text: &str) -> String {
        match self {
            Script::Text(_) | Script::Latex => text.to_string(),
            Script::Html => mathml::typed(text),
        }
    }

    /// Length of a formula in characters of the text; of MathML only visible ones count.
    pub(super) fn length_of(self, formula: &str) -> usize {
        match self {
            Script::Text(_) | Script::Latex => formula.chars().count(),
            Script::Html => mathml::shown(formula),
        }
    }

    /// The angle of these coordinates.
    pub(super) fn atan2(self, sine: &str, cosine: &str) -> String {
        match self {
            Script::Text(_) => format!("atan2({sine}, {cosine})"),
            Script::Latex => format!("\\operatorname{{atan2}}({sine}, {cosine})"),
            Script::Html => {
                let both = format!("{sine}<mo>,</mo>{cosine}");
                format!("<mi>atan2</mi>{}", mathml::brackets(&both))
            }
        }
    }

    /// Name or label as a word.
    pub(super) fn word(self, name: &str) -> String {
        match self {
            Script::Text(_) => name.to_string(),
            Script::Latex => latex::escaped(name).replace("->", "$\\to$"),
            Script::Html => escaped(&name.replace("->", "→")),
        }
    }

    /// The vector from one point to another, or a vector with a name of its own.
    pub(super) fn vector(self, name: &str) -> String {
        match self {
            Script::Text(_) => name.to_string(),
            Script::Latex => latex::vector_name(name),
            Script::Html => mathml::vector_name(name),
        }
    }

    /// A length, without bars.
    pub(super) fn length(self, name: &str) -> String {
        match self {
            Script::Text(_) => format!("|{name}|"),
            Script::Latex => format!("|{}|", self.vector(name)),
            Script::Html => format!("<mrow><mo>|</mo>{}<mo>|</mo></mrow>", self.vector(name)),
        }
    }

    /// The square of a single symbol.
    pub(super) fn square(self, symbol: &str) -> String {
        match self {
            Script::Html => MathMl.power(symbol, &MathMl.digits("2")),
            _ => format!("{symbol}{}", self.either("^2", "²", "^2", "")),
        }
    }

    /// Two components as a column, or on a line.
    pub(super) fn pair(self, x: &str, y: &str) -> String {
        match self {
            Script::Text(_) => format!("({x}, {y})"),
            Script::Latex => {
                format!("\\begin{{pmatrix}} {x} \\\\ {y} \\end{{pmatrix}}")
            }
            Script::Html => format!(
                "<mrow><mo>(</mo><mtable><mtr><mtd>{x}</mtd></mtr><mtr><mtd>{y}</mtd></mtr></mtable><mo>)</mo></mrow>"
            ),
        }
    }

    /// The rotation matrix of an angle.
    pub(super) fn rotation(self, angle: &str) -> String {
        match self {
            Script::Text(_) => format!("R({angle})"),
            Script::Latex => format!("\\mathbf{{R}}({angle})"),
            Script::Html => format!("{}{}", self.vector("R"), mathml::brackets(angle)),
        }
    }

    /// The position vector of a body's origin.
    pub(super) fn origin(self, body: &str) -> String {
        let digits = body.chars().all(|character| character.is_ascii_digit());
        match self {
            Script::Text(Notation::Ascii) if digits => format!("r{body}"),
            Script::Text(Notation::Unicode) if digits => {
                let lowered = body.chars().filter_map(|digit| digit.to_digit(10));
                let index = lowered.filter_map(|digit| char::from_u32('₀' as u32 + digit));
                format!("r{}", index.collect::<String>())
            }
            Script::Text(_) => format!("r_{body}"),
            Script::Latex => format!("\\mathbf{{r}}_{{\\mathrm{{{}}}}}", latex::escaped(body)),
            Script::Html => format!("<msub>{}{}</msub>", self.vector("r"), mathml::name(body)),
        }
    }

    /// A vector turned by a quarter turn counterclockwise.
    pub(super) fn perpendicular(self, name: &str) -> String {
        match self {
            Script::Text(Notation::Ascii) => format!("perp({name})"),
            Script::Text(Notation::Unicode) => format!("{name}⊥"),
            Script::Latex => format!("{}^{{\\perp}}", self.vector(name)),
            Script::Html => MathMl.power(&self.vector(name), "<mo>⊥</mo>"),
        }
    }

    /// A matrix with an index.
    pub(super) fn matrix(self, name: &str, index: &str) -> String {
        match self {
            Script::Text(_) => format!("{name}_{index}"),
            Script::Latex => format!("\\mathbf{{{name}}}_{{\\mathbf{{{index}}}}}"),
            Script::Html => format!("<msub>{}{}</msub>", self.vector(name), self.vector(index)),
        }
    }

    /// A symbol with a number: `g1`.
    pub(super) fn numbered(self, name: &str, number: usize) -> String {
        match self {
            Script::Text(_) => format!("{name}{number}"),
            Script::Latex => format!("{name}_{{{number}}}"),
            Script::Html => format!("<msub><mi>{name}</mi><mn>{number}</mn></msub>"),
        }
    }

    /// The scalar product of two vectors.
    pub(super) fn dot(self, first: &str, second: &str) -> String {
        let sign = self.either(".", "·", "\\cdot", "<mo>·</mo>");
        format!("{} {sign} {}", self.vector(first), self.vector(second))
    }

    /// The plane cross product of two vectors, a number.
    pub(super) fn cross(self, first: &str, second: &str) -> String {
        let sign = self.either("x", "×", "\\times", "<mo>×</mo>");
        format!("{} {sign} {}", self.vector(first), self.vector(second))
    }

    /// Sign between a factor and an expression other than a number.
    pub(super) fn times(self) -> &'static str {
        match self {
            Script::Text(Notation::Ascii) => "*",
            Script::Text(Notation::Unicode) => "·",
            Script::Latex => "\\,",
            Script::Html => "<mspace width=\"0.15em\"/>",
        }
    }

    /// The plus sign between two terms.
    pub(super) fn plus(self) -> &'static str {
        self.either("+", "+", "+", MathMl.plus())
    }

    /// The minus sign between two terms.
    pub(super) fn minus(self) -> &'static str {
        match self {
            Script::Text(Notation::Unicode) => "−",
            Script::Text(Notation::Ascii) | Script::Latex => "-",
            Script::Html => MathMl.minus(),
        }
    }
}
