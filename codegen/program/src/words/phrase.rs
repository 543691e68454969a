//! Represents text with symbolic names and formulas.

use crate::expr::ExprId;
use crate::joint::geometry::Vector;

/// Text whose names and formulas are not spelled yet.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Phrase(Vec<Piece>);

/// Piece of a phrase.
#[derive(Clone, Debug, PartialEq)]
pub enum Piece {
    /// Words.
    Text(String),
    /// Name or label, as in the description.
    Name(String),
    /// Unknown of the vector form.
    Unknown(usize),
    /// Rate of an unknown.
    Rate(usize),
    /// Acceleration of an unknown.
    Acceleration(usize),
    /// Expression.
    Formula(ExprId),
    /// Components of a constant vector.
    Pair(Vector),
    /// Vector R(φ) v of the unknown φ.
    Turned(usize, Vector),
    /// Two expressions as a sum of origins, rotated vectors and constants.
    Sum(Vector),
    /// Local value of a block by its name: `k`, `AB_x`.
    Local(String),
    /// Vector by its name: `AB`.
    Vector(String),
    /// Length of a vector: `|AB|`.
    Length(String),
    /// Square of a vector's length.
    Square(String),
    /// Vector rotated by a quarter turn counterclockwise.
    Across(String),
    /// Scalar product of two vectors.
    Dot(String, String),
    /// Plane cross product of two vectors.
    Cross(String, String),
    /// Matrix by its name, with an index.
    Matrix(&'static str, &'static str),
    /// Symbol with a number.
    Numbered(&'static str, usize),
    /// Multiplication sign before a factor that is not a number.
    Times,
    /// Minus sign between two terms.
    Minus,
    /// Minus sign before a term.
    Opposite,
}

impl Phrase {
    /// Appends text, a piece or a phrase.
    pub fn push(&mut self, part: impl Into<Phrase>) {
        self.0.extend(part.into().0);
    }

    /// Returns the pieces, in order.
    pub fn pieces(&self) -> &[Piece] {
        &self.0
    }

    /// True if the phrase has no text.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Returns the text, with all pieces except for words and names spelled by `spell`.
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

/// Joins texts, pieces and phrases in order.
macro_rules! phrase {
    ($($part:expr),* $(,)?) => {{
        let mut whole = $crate::words::Phrase::default();
        $(whole.push($part);)*
        whole
    }};
}
pub(crate) use phrase;
