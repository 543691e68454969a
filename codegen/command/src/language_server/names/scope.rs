//! Which names are known where, and what has been found so far.

use std::collections::HashMap;

use linkwright_codegen::diagnostic::Span;
use linkwright_codegen::stages::syntax::{Direction, Document, Lexeme, Name};

use super::written::{Reading, identifier};
use super::{Mention, Names, Sort, Symbol, SymbolId};

/// What is always there, and declared nowhere.
pub(super) const GROUND: &str = "ground";

/// Names of one sort do not stand in the way of names of another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Space {
    Values,
    Tables,
    Drawn,
    Bodies,
    Curves,
    Drivers,
    Equations,
    Elements,
    Motions,
}

impl Space {
    /// Where names of a sort are looked for; nothing where they are not.
    pub(super) fn of(sort: Sort) -> Option<Space> {
        Some(match sort {
            Sort::Constant | Sort::Parameter | Sort::Input | Sort::Free => Space::Values,
            Sort::Table => Space::Tables,
            Sort::Point => Space::Drawn,
            Sort::Body | Sort::Angle => Space::Bodies,
            Sort::Curve => Space::Curves,
            Sort::Driver => Space::Drivers,
            Sort::Equation => Space::Equations,
            Sort::Element => Space::Elements,
            Sort::Motion => Space::Motions,
            Sort::Mechanism
            | Sort::BodyPoint
            | Sort::CurveParameter
            | Sort::Joint
            | Sort::Part
            | Sort::Index => return None,
        })
    }
}

/// A body that an operand names; the ground is one, too.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Owner {
    Ground,
    Body(SymbolId),
}

/// A joint with a name or a line.
pub(super) struct JointNames {
    pub motion: Option<Span>,
    pub name: Option<String>,
    /// What the name stands for.
    pub symbol: Option<SymbolId>,
    /// The line as written, with what its ends stand for.
    pub along: Option<(Direction, [Option<SymbolId>; 2])>,
}

/// What is known of a document so far.
#[derive(Default)]
pub(super) struct Scopes {
    symbols: Vec<Symbol>,
    mentions: Vec<Mention>,
    carried: Vec<(SymbolId, SymbolId)>,
    /// By the motion, the space and the name; only looked up.
    known: HashMap<(Option<Span>, Space, String), SymbolId>,
    /// By the body and the name; only looked up.
    points: HashMap<(SymbolId, String), SymbolId>,
    /// The first point of each name that bodies carry; only looked up.
    first_carried: HashMap<String, SymbolId>,
    /// The symbols by the places of their declarations; only looked up.
    declared: HashMap<Span, SymbolId>,
    pub(super) joints: Vec<JointNames>,
    /// A symbol that is the same as this one and was declared before; itself where there is none.
    earlier: Vec<SymbolId>,
    /// The motion whose statements are looked at.
    pub(super) motion: Option<Span>,
}

impl Scopes {
    /// Declares a symbol; a second one of a name is not found by it.
    pub(super) fn declare(&mut self, symbol: Symbol) -> SymbolId {
        let id = self.symbols.len();
        if let Some(space) = Space::of(symbol.sort) {
            let key = (self.motion, space, symbol.name.clone());
            self.known.entry(key).or_insert(id);
        }
        self.declared.insert(symbol.declared, id);
        self.earlier.push(id);
        self.mentions.push(Mention {
            span: symbol.declared,
            symbol: id,
        });
        self.symbols.push(symbol);
        id
    }

    /// Says that a body carries a point.
    pub(super) fn carry(&mut self, body: SymbolId, point: SymbolId) {
        let name = self.symbols[point].name.clone();
        self.first_carried.entry(name.clone()).or_insert(point);
        self.points.entry((body, name)).or_insert(point);
        self.carried.push((body, point));
    }

    /// Notes that a symbol is mentioned.
    pub(super) fn mention(&mut self, span: Span, symbol: SymbolId) {
        self.mentions.push(Mention { span, symbol });
    }

    /// Says that two symbols are one thing.
    pub(super) fn unite(&mut self, one: SymbolId, other: SymbolId) {
        let [one, other] = [one, other].map(|it| self.first(it));
        self.earlier[one.max(other)] = one.min(other);
    }

    fn first(&self, mut symbol: SymbolId) -> SymbolId {
        while self.earlier[symbol] != symbol {
            symbol = self.earlier[symbol];
        }
        symbol
    }

    /// What a name stands for: in the motion that is looked at, or outside of all.
    pub(super) fn find(&self, space: Space, name: &str) -> Option<SymbolId> {
        let of = |motion| self.known.get(&(motion, space, name.to_string())).copied();
        self.motion
            .and_then(|_| of(self.motion))
            .or_else(|| of(None))
    }

    /// A value that is declared above a place.
    pub(super) fn value(&self, name: &Name) -> Option<SymbolId> {
        let found = self.find(Space::Values, &name.text)?;
        (self.symbols[found].declared.end <= name.span.start).then_some(found)
    }

    /// The symbol that is declared at a place.
    pub(super) fn declared_at(&self, span: Span) -> Option<SymbolId> {
        self.declared.get(&span).copied()
    }

    /// The body of a name, without mentioning it.
    pub(super) fn owner(&self, name: &str) -> Option<Owner> {
        match name == GROUND {
            true => Some(Owner::Ground),
            false => self.find(Space::Bodies, name).map(Owner::Body),
        }
    }

    /// An angle that needs no body.
    pub(super) fn angle(&self, name: &str) -> Option<SymbolId> {
        let found = self.find(Space::Bodies, name)?;
        (self.symbols[found].sort == Sort::Angle).then_some(found)
    }

    /// A point of a body. The ground carries every drawn point.
    pub(super) fn point_on(&self, owner: Owner, name: &str) -> Option<SymbolId> {
        match owner {
            Owner::Ground => self.find(Space::Drawn, name),
            Owner::Body(body) => self.points.get(&(body, name.to_string())).copied(),
        }
    }

    /// A point that is named without a body: a drawn one, or the first that bodies carry.
    pub(super) fn bare_point(&self, name: &str) -> Option<SymbolId> {
        let drawn = self.find(Space::Drawn, name);
        drawn.or_else(|| self.first_carried.get(name).copied())
    }

    /// Names as they are written: what shares a place is one.
    pub(super) fn into_names(
        mut self,
        document: &Document,
        text: &str,
        lexemes: &[Lexeme],
    ) -> Names {
        for symbol in &mut self.symbols {
            symbol.declared = identifier(text, symbol.place);
            if let Some(spelled) = document.spellings.get(&symbol.name) {
                symbol.spelled.clone_from(spelled);
            }
        }
        for mention in &mut self.mentions {
            mention.span = identifier(text, mention.span);
        }
        let count = self.symbols.len();
        let symbols = std::mem::take(&mut self.symbols);
        let mentions = std::mem::take(&mut self.mentions);
        let mut reading = Reading::new(text, lexemes, symbols, mentions);
        reading.all();
        let Reading {
            symbols,
            mut mentions,
            ..
        } = reading;
        self.earlier.extend(count..symbols.len());
        mentions.sort();
        mentions.dedup();
        for pair in mentions.windows(2) {
            if pair[0].span == pair[1].span {
                self.unite(pair[0].symbol, pair[1].symbol);
            }
        }
        let first = (0..symbols.len()).map(|it| self.first(it)).collect();
        Names {
            first,
            symbols,
            mentions,
            carried: self.carried,
        }
    }
}
