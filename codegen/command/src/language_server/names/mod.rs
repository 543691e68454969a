//! *Statements → names:* what each one stands for, where it is declared, and where it is mentioned.
//!
//! Names are found as the generator finds them: points by the bodies that carry them, a joint's name as that of its point, a motion's
//! names in that motion alone. Afterwards every mention belongs to one symbol, and symbols that are one point (as the joint `P(1, 2)`
//! makes the points P of both bodies one) are known as the same. What names stand for is not computed here, and what nothing
//! declares is no mention. What is repeated, or belongs to a part, has one name for each of its places.

mod declare;
mod formula;
mod mention;
mod operand;
mod scope;
mod written;

use linkwright_codegen::diagnostic::Span;
use linkwright_codegen::stages::syntax::{Document, Lexeme};

use scope::Scopes;
pub use written::{Whole, mechanisms};

/// What a name stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Sort {
    /// The mechanism of the file.
    Mechanism,
    /// A way in which it is driven.
    Motion,
    /// A constant.
    Constant,
    /// A value that can be changed at run time.
    Parameter,
    /// A signal that is supplied at run time.
    Input,
    /// A quantity that forces move.
    Free,
    /// A function through points.
    Table,
    /// A point of the drawing.
    Point,
    /// A point in the frame of a body.
    BodyPoint,
    /// A body.
    Body,
    /// An angle that needs no body.
    Angle,
    /// A curve of a body.
    Curve,
    /// What runs along a curve.
    CurveParameter,
    /// A joint.
    Joint,
    /// A driver.
    Driver,
    /// An equation of the user's own.
    Equation,
    /// A spring or a damper.
    Element,
    /// A mechanism as a part of another.
    Part,
    /// What counts the repetitions of statements.
    Index,
}

impl Sort {
    /// How a person calls it.
    pub fn noun(self) -> &'static str {
        match self {
            Sort::Mechanism => "mechanism",
            Sort::Motion => "motion",
            Sort::Constant => "constant",
            Sort::Parameter => "parameter",
            Sort::Input => "input",
            Sort::Free => "free coordinate",
            Sort::Table => "table",
            Sort::Point => "point in global coordinates",
            Sort::BodyPoint => "point of a body",
            Sort::Body => "body",
            Sort::Angle => "angle",
            Sort::Curve => "curve",
            Sort::CurveParameter => "parameter of a curve",
            Sort::Joint => "joint",
            Sort::Driver => "driver",
            Sort::Equation => "equation",
            Sort::Element => "spring or damper",
            Sort::Part => "part",
            Sort::Index => "index of a repetition",
        }
    }
}

/// A symbol, by its place in the list of all.
pub type SymbolId = usize;

/// Something that has a name.
#[derive(Clone, Debug)]
pub struct Symbol {
    /// What it is.
    pub sort: Sort,
    /// What it is called where statements are written out: `rod3`.
    pub name: String,
    /// How that is written: `rod[3]`.
    pub spelled: String,
    /// The place of its name with its indices, as the generator knows it.
    pub place: Span,
    /// Where the name is declared: the identifier alone.
    pub declared: Span,
    /// All that declares it, without what else the statement declares.
    pub written: Span,
    /// The statement that declares it.
    pub statement: Span,
    /// The word that the declaration begins with, where it stands elsewhere: `point` before the second point of a statement.
    pub opening: &'static str,
    /// Its documentation.
    pub docs: Vec<String>,
    /// The body that carries it, for a point of a body.
    pub body: Option<SymbolId>,
    /// The motion outside of which it is not known.
    pub motion: Option<Span>,
}

/// A place where a name is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Mention {
    /// The place.
    pub span: Span,
    /// What is mentioned.
    pub symbol: SymbolId,
}

/// The names of a description.
#[derive(Clone, Debug, Default)]
pub struct Names {
    /// What has a name, in written order.
    pub symbols: Vec<Symbol>,
    /// The mentions by place, declarations among them; one place may mention two points that are one.
    pub mentions: Vec<Mention>,
    /// The points that each body carries, by the symbols of bodies: names, and what they stand for.
    pub carried: Vec<(SymbolId, SymbolId)>,
    /// The first of the symbols that are the same as this one.
    first: Vec<SymbolId>,
}

impl Names {
    /// The names of a document, whose text and lexemes these are.
    pub fn of(document: &Document, text: &str, lexemes: &[Lexeme]) -> Names {
        let mut scopes = Scopes::default();
        scopes.declare_all(document);
        scopes.mention_all(document);
        scopes.into_names(document, text, lexemes)
    }

    /// The mention that an offset is in, or that ends there.
    pub fn mention_at(&self, offset: usize) -> Option<Mention> {
        let begun = |it: &Mention| it.span.start as usize <= offset;
        let end = self.mentions.partition_point(begun);
        // Where two names touch, the one that begins here is meant.
        let last = self.mentions[..end].last()?.span;
        let first = self.mentions.partition_point(|it| it.span < last);
        let own = self.mentions.get(first)?;
        (offset <= last.range().end).then_some(*own)
    }

    /// What is mentioned at a place: two points, where they are one.
    pub fn mentioned_at(&self, place: Span) -> impl Iterator<Item = SymbolId> {
        let start = self.mentions.partition_point(|it| it.span < place);
        let here = self.mentions[start..].iter();
        here.take_while(move |it| it.span == place)
            .map(|it| it.symbol)
    }

    /// Whether two symbols are one thing.
    pub fn are_same(&self, one: SymbolId, other: SymbolId) -> bool {
        self.first[one] == self.first[other]
    }

    /// All places that mention a symbol or one that is the same, each once.
    pub fn mentions_of(&self, symbol: SymbolId) -> Vec<Span> {
        let same = |it: &&Mention| self.are_same(it.symbol, symbol);
        let mut places: Vec<Span> = self
            .mentions
            .iter()
            .filter(same)
            .map(|it| it.span)
            .collect();
        places.dedup();
        places
    }

    /// The symbols that are one with this one, itself among them.
    pub fn same(&self, symbol: SymbolId) -> Vec<SymbolId> {
        let all = 0..self.symbols.len();
        all.filter(|&other| self.are_same(symbol, other)).collect()
    }

    /// The points that a body carries, in written order.
    pub fn points_of(&self, body: SymbolId) -> impl Iterator<Item = SymbolId> {
        let carried = self.carried.iter().filter(move |(own, _)| *own == body);
        carried.map(|(_, point)| *point)
    }

    /// The bodies that carry a point, in written order.
    pub fn carriers_of(&self, point: SymbolId) -> impl Iterator<Item = SymbolId> {
        let carried = self.carried.iter().filter(move |(_, own)| *own == point);
        carried.map(|(body, _)| *body)
    }
}
