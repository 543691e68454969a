//! Words with the places of names and formulas between them.

use crate::expr::ExprId;
use crate::joint::geometry::Vector;

/// A text whose names and formulas are not spelled yet.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Phrase(Vec<Piece>);

/// A part of a phrase.
#[derive(Clone, Debug, PartialEq)]
pub enum Piece {
    /// Words.
    Text(String),
    /// A name or a label as the description writes it.
    Name(String),
    /// An unknown of the vector form.
    Unknown(usize),
    /// The rate of an unknown.
    Rate(usize),
    /// The acceleration of an unknown.
    Acceleration(usize),
    /// An expression.
    Formula(ExprId),
    /// The components of a constant vector.
    Pair(Vector),
    /// R(φ) v for the unknown φ.
    Turned(usize, Vector),
    /// Two expressions as a sum of origins, turned vectors and constants.
    Sum(Vector),
    /// A local value of a block by its name: `k`, `AB_x`.
    Local(String),
    /// A vector by its name: `AB`.
    Vector(String),
    /// The length of a vector: `|AB|`.
    Length(String),
    /// The square of its length.
    Square(String),
    /// A vector turned by a quarter turn counterclockwise.
    Across(String),
    /// The scalar product of two vectors.
    Dot(String, String),
    /// The plane cross product of two vectors.
    Cross(String, String),
    /// A matrix by its name, with an index.
    Matrix(&'static str, &'static str),
    /// A symbol with a number.
    Numbered(&'static str, usize),
    /// A multiplication sign before something that is no number.
    Times,
    /// A minus sign between two terms.
    Minus,
    /// A minus sign before a term.
    Opposite,
}

impl Phrase {
    /// Adds to the end.
    pub fn push(&mut self, part: impl Into<Phrase>) {
        self.0.extend(part.into().0);
    }

    /// What it is made of.
    pub fn pieces(&self) -> &[Piece] {
        &self.0
    }

    /// Whether nothing is said.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The text, every piece but words and names spelled by `spell`.
    pub fn text(&self, mut spell: impl FnMut(&Piece) -> String) -> String {
        let spelled = self.0.iter().map(|piece| match piece {
            Piece::Text(text) | Piece::Name(text) => text.clone(),
            other => spell(other),
        });
        spelled.collect()
    }
}

impl From<Piece> for Phrase {
    fn from(piece: Piece) -> Phrase {
        Phrase(vec![piece])
    }
}

impl From<&str> for Phrase {
    fn from(text: &str) -> Phrase {
        match text {
            "" => Phrase::default(),
            _ => Phrase(vec![Piece::Text(text.to_string())]),
        }
    }
}

impl From<String> for Phrase {
    fn from(text: String) -> Phrase {
        Phrase::from(text.as_str())
    }
}

impl From<&Phrase> for Phrase {
    fn from(phrase: &Phrase) -> Phrase {
        phrase.clone()
    }
}

/// A phrase from its parts in order: texts, pieces and phrases.
macro_rules! phrase {
    ($($part:expr),* $(,)?) => {{
        let mut whole = $crate::words::Phrase::default();
        $(whole.push($part);)*
        whole
    }};
}
pub(crate) use phrase;
