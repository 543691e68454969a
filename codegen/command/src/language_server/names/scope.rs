//! Holds the scopes of names, and the symbols and mentions that have been found.

use std::collections::HashMap;

use linkwright_codegen::diagnostic::Span;
use linkwright_codegen::stages::syntax::{Direction, Document, Name};

use super::written::identifier;
use super::{Mention, Names, Sort, Symbol, SymbolId};

/// Predefined body, which has no declaration.
pub(super) const GROUND: &str = "ground";

/// Name space: names in different spaces do not collide.
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
    /// Returns the space of a sort; `None` if its names are not looked up.
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

/// Body that an operand names, or the ground.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Owner {
    Ground,
    Body(SymbolId),
}

/// Joint with a name or a line.
pub(super) struct JointNames {
    pub motion: Option<Span>,
    pub name: Option<String>,
    /// Symbol of the name; `None` if the joint has no name.
    pub symbol: Option<SymbolId>,
    /// Line as it is written, with the symbols of its ends; `None` if the joint has no line.
    pub along: Option<(Direction, [Option<SymbolId>; 2])>,
}

/// Symbols and mentions of a document that have been found.
#[derive(Default)]
pub(super) struct Scopes {
    symbols: Vec<Symbol>,
    mentions: Vec<Mention>,
    carried: Vec<(SymbolId, SymbolId)>,
    /// Symbols by motion, space and name; only looked up.
    known: HashMap<(Option<Span>, Space, String), SymbolId>,
    /// Points by body and name; only looked up.
    points: HashMap<(SymbolId, String), SymbolId>,
    /// First point of each name that bodies carry; only looked up.
    first_carried: HashMap<String, SymbolId>,
    /// Symbols by the places of their declarations; only looked up.
    declared: HashMap<Span, SymbolId>,
    pub(super) joints: Vec<JointNames>,
    /// Earlier symbol that is equal to each symbol; itself if there is none.
    earlier: Vec<SymbolId>,
    /// Motion of the current statements; `None` outside of motions.
    pub(super) motion: Option<Span>,
}

impl Scopes {
    /// Declares a symbol. A lookup returns the first symbol of a name.
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

    /// Records that a body carries a point.
    pub(super) fn carry(&mut self, body: SymbolId, point: SymbolId) {
        let name = self.symbols[point].name.clone();
        self.first_carried.entry(name.clone()).or_insert(point);
        self.points.entry((body, name)).or_insert(point);
        self.carried.push((body, point));
    }

    /// Records a mention of a symbol.
    pub(super) fn mention(&mut self, span: Span, symbol: SymbolId) {
        self.mentions.push(Mention { span, symbol });
    }

    /// Records that two symbols are one object.
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

    /// Finds a name in the current motion, otherwise outside of motions.
    pub(super) fn find(&self, space: Space, name: &str) -> Option<SymbolId> {
        let of = |motion| self.known.get(&(motion, space, name.to_string())).copied();
        self.motion
            .and_then(|_| of(self.motion))
            .or_else(|| of(None))
    }

    /// Finds a value that is declared above a place.
    pub(super) fn value(&self, name: &Name) -> Option<SymbolId> {
        let symbol = self.find(Space::Values, &name.text)?;
        (self.symbols[symbol].declared.end <= name.span.start).then_some(symbol)
    }

    /// Finds the symbol that is declared at a place.
    pub(super) fn declared_at(&self, span: Span) -> Option<SymbolId> {
        self.declared.get(&span).copied()
    }

    /// Finds the body of a name without a mention.
    pub(super) fn owner(&self, name: &str) -> Option<Owner> {
        match name == GROUND {
            true => Some(Owner::Ground),
            false => self.find(Space::Bodies, name).map(Owner::Body),
        }
    }

    /// Finds an angle without a body.
    pub(super) fn angle(&self, name: &str) -> Option<SymbolId> {
        let symbol = self.find(Space::Bodies, name)?;
        (self.symbols[symbol].sort == Sort::Angle).then_some(symbol)
    }

    /// Finds a point of a body. The ground carries every drawn point.
    pub(super) fn point_on(&self, owner: Owner, name: &str) -> Option<SymbolId> {
        match owner {
            Owner::Ground => self.find(Space::Drawn, name),
            Owner::Body(body) => self.points.get(&(body, name.to_string())).copied(),
        }
    }

    /// Finds a point that is named without a body: a drawn one, or the first that bodies carry.
    pub(super) fn bare_point(&self, name: &str) -> Option<SymbolId> {
        let drawn = self.find(Space::Drawn, name);
        drawn.or_else(|| self.first_carried.get(name).copied())
    }

    /// Converts the findings to names as they are written: symbols of one place become one.
    pub(super) fn into_names(mut self, document: &Document, text: &str) -> Names {
        for symbol in &mut self.symbols {
            symbol.declared = identifier(text, symbol.place);
            if let Some(spelled) = document.spellings.get(&symbol.name) {
                symbol.spelled.clone_from(spelled);
            }
        }
        for mention in &mut self.mentions {
            mention.span = identifier(text, mention.span);
        }
        let mut mentions = std::mem::take(&mut self.mentions);
        mentions.sort();
        mentions.dedup();
        for pair in mentions.windows(2) {
            if pair[0].span == pair[1].span {
                self.unite(pair[0].symbol, pair[1].symbol);
            }
        }
        let first = (0..self.symbols.len()).map(|it| self.first(it)).collect();
        Names {
            first,
            symbols: self.symbols,
            mentions,
            carried: self.carried,
        }
    }
}
