//! Joins the declarations of a document with the uses that the generator records.
//!
//! The generator decides which declaration a name refers to. Every mention belongs to one symbol, and an undeclared name is not a mention.
//! Symbols of one point are known as equal: the joint `P(1, 2)` makes the points P of both bodies one. A repeated statement, or one in a
//! part, has one name for each place in the text.

mod collector;
mod declare;
mod written;

use linkwright_codegen::diagnostic::Span;
use linkwright_codegen::stages::syntax::Document;

use collector::Collector;
pub(crate) use written::{Whole, mechanisms};

/// Meaning of a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Sort {
    /// The mechanism of the file.
    Mechanism,
    /// Motion that drives the mechanism.
    Motion,
    /// Constant.
    Constant,
    /// Value that can be changed at run time.
    Parameter,
    /// Signal that is supplied at run time.
    Input,
    /// Quantity that forces move.
    Free,
    /// Function through points.
    Table,
    /// Point of the drawing.
    Point,
    /// Point in the frame of a body.
    BodyPoint,
    /// Body.
    Body,
    /// Angle without a body.
    Angle,
    /// Curve of a body.
    Curve,
    /// Parameter of a curve.
    CurveParameter,
    /// Joint.
    Joint,
    /// Driver.
    Driver,
    /// Equation of the user.
    Equation,
    /// Spring or damper.
    Element,
    /// Quantity of the motion.
    Measure,
    /// Mechanism as a part of another.
    Part,
    /// Index of repeated statements.
    Index,
}

impl Sort {
    /// Noun in messages.
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
            Sort::Measure => "measure",
            Sort::Part => "part",
            Sort::Index => "index of a repetition",
        }
    }
}

/// Index of a symbol in [`Names::symbols`].
pub type SymbolId = usize;

/// Named object.
#[derive(Clone, Debug)]
pub struct Symbol {
    /// Meaning.
    pub sort: Sort,
    /// Name after repetitions are expanded: `rod3`.
    pub name: String,
    /// Name as it is written: `rod[3]`.
    pub spelled: String,
    /// Place of the name with its indices, as the generator records it.
    pub place: Span,
    /// Place of the identifier in the declaration.
    pub declared: Span,
    /// Text of the declaration, without other declarations of the same statement.
    pub written: Span,
    /// Statement of the declaration.
    pub statement: Span,
    /// First word of the declaration if it is elsewhere: `point` before the second point of a statement.
    pub opening: &'static str,
    /// Documentation, line by line.
    pub docs: Vec<String>,
    /// Body of a body's point; `None` for other symbols.
    pub body: Option<SymbolId>,
    /// Motion that the name is visible in; `None` if it is visible everywhere.
    pub motion: Option<Span>,
}

/// Place of a name in the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Mention {
    /// Place.
    pub span: Span,
    /// Mentioned symbol.
    pub symbol: SymbolId,
}

/// Names of a description.
#[derive(Clone, Debug, Default)]
pub struct Names {
    /// Symbols in written order.
    pub symbols: Vec<Symbol>,
    /// Mentions by place, declarations included; one place may mention two points that are one.
    pub mentions: Vec<Mention>,
    /// Pairs of a body and a point that the body carries.
    pub carried: Vec<(SymbolId, SymbolId)>,
    /// First of the symbols that are equal to each symbol.
    first: Vec<SymbolId>,
}

impl Names {
    /// Returns the names of a document with this text.
    pub fn of(document: &Document, text: &str) -> Names {
        let mut collector = Collector::default();
        collector.add_all(document);
        collector.into_names(document, text)
    }

    /// Returns the mention that contains an offset or ends there; `None` if there is none.
    pub fn mention_at(&self, offset: usize) -> Option<Mention> {
        let begun = |it: &Mention| it.span.start as usize <= offset;
        let end = self.mentions.partition_point(begun);
        // Where two names touch, the one that begins at the offset is preferred.
        let last = self.mentions[..end].last()?.span;
        let first = self.mentions.partition_point(|it| it.span < last);
        let mention = self.mentions.get(first)?;
        (offset <= last.range().end).then_some(*mention)
    }

    /// Returns the symbols that are mentioned at a place: two points if they are one.
    pub fn mentioned_at(&self, place: Span) -> impl Iterator<Item = SymbolId> {
        let start = self.mentions.partition_point(|it| it.span < place);
        let here = self.mentions[start..].iter();
        here.take_while(move |it| it.span == place)
            .map(|it| it.symbol)
    }

    /// True if two symbols are one object.
    pub fn are_same(&self, one: SymbolId, other: SymbolId) -> bool {
        self.first[one] == self.first[other]
    }

    /// Returns all places that mention a symbol or an equal one, each once.
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

    /// Returns the symbols that are equal to this one, itself included.
    pub fn same(&self, symbol: SymbolId) -> Vec<SymbolId> {
        let all = 0..self.symbols.len();
        all.filter(|&other| self.are_same(symbol, other)).collect()
    }

    /// Returns the points that a body carries, in written order.
    pub fn points_of(&self, body: SymbolId) -> impl Iterator<Item = SymbolId> {
        let carried = self.carried.iter().filter(move |(own, _)| *own == body);
        carried.map(|(_, point)| *point)
    }

    /// Returns the bodies that carry a point, in written order.
    pub fn carriers_of(&self, point: SymbolId) -> impl Iterator<Item = SymbolId> {
        let carried = self.carried.iter().filter(move |(_, own)| *own == point);
        carried.map(|(body, _)| *body)
    }
}
