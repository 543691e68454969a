//! Collects the symbols of a document, and the mentions that the generator has recorded.

use std::collections::BTreeMap;

use linkwright_codegen::diagnostic::Span;
use linkwright_codegen::stages::model;
use linkwright_codegen::stages::syntax::{Document, Name};

use super::written::identifier;
use super::{Mention, Names, Symbol, SymbolId};

/// Symbols and mentions of a document that have been found.
#[derive(Default)]
pub(super) struct Collector {
    symbols: Vec<Symbol>,
    mentions: Vec<Mention>,
    carried: Vec<(SymbolId, SymbolId)>,
    /// Symbols by place and name, of declarations and of uses.
    known: BTreeMap<(Span, String), SymbolId>,
    /// Earlier symbol that is equal to each symbol; itself if there is none.
    earlier: Vec<SymbolId>,
    /// Motion of the current statements; `None` outside of motions.
    pub(super) motion: Option<Span>,
}

impl Collector {
    /// Declares a symbol.
    pub(super) fn declare(&mut self, symbol: Symbol) -> SymbolId {
        let id = self.symbols.len();
        self.earlier.push(id);
        self.mention(symbol.place, &symbol.name, id);
        self.symbols.push(symbol);
        id
    }

    fn mention(&mut self, span: Span, name: &str, symbol: SymbolId) {
        self.known.entry((span, name.to_string())).or_insert(symbol);
        self.mentions.push(Mention { span, symbol });
    }

    /// Records the use of a name; without effect if its declaration is not a symbol, as that of the ground. A declaration that uses
    /// another one declares the same object.
    pub(super) fn add_use(&mut self, used: &model::Mention) {
        let Some(symbol) = self.at(used.declaration, &used.name) else {
            return;
        };
        match self.at(used.span, &used.name) {
            Some(own) if self.symbols[own].place == used.span => self.unite(own, symbol),
            _ => self.mention(used.span, &used.name, symbol),
        }
    }

    fn unite(&mut self, one: SymbolId, other: SymbolId) {
        let [one, other] = [one, other].map(|it| self.first(it));
        self.earlier[one.max(other)] = one.min(other);
    }

    /// Records that a body carries the point of a list.
    pub(super) fn carry(&mut self, body: &Name, listed: &Name) {
        let [body, point] = [body, listed].map(|it| self.at(it.span, &it.text));
        self.carried.extend(body.zip(point));
    }

    /// Finds the symbol of a declaration or a use.
    fn at(&self, place: Span, name: &str) -> Option<SymbolId> {
        self.known.get(&(place, name.to_string())).copied()
    }

    /// Records the place of a name that is declared at another place, of whichever repetition.
    pub(super) fn add_expanded(&mut self, place: Span, declaration: Span) {
        if let Some(symbol) = self.declared_at(declaration) {
            self.mentions.push(Mention {
                span: place,
                symbol,
            });
        }
    }

    /// Finds the first symbol at a place.
    pub(super) fn declared_at(&self, span: Span) -> Option<SymbolId> {
        let (found, &symbol) = self.known.range((span, String::new())..).next()?;
        (found.0 == span).then_some(symbol)
    }

    fn first(&self, mut symbol: SymbolId) -> SymbolId {
        while self.earlier[symbol] != symbol {
            symbol = self.earlier[symbol];
        }
        symbol
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
