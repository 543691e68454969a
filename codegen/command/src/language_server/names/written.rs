//! Converts expanded names with places to names as they are written.
//!
//! A place in repeated statements or in a part stands for several objects: `rod[i]` for all rods, a declaration in a part for that of
//! every use. Here each place becomes that of one identifier, and symbols that share a place become one. Names that statements no longer
//! contain are found in the text: indices of repetitions, parts, and mechanisms that are parts.

use std::collections::HashMap;

use linkwright_codegen::diagnostic::Span;
use linkwright_codegen::stages::syntax::{Kind, Lexeme};

use super::{Mention, Sort, Symbol, SymbolId};

/// Returns the identifier of a written name: `rod` of `left.rod[i - 1]`.
pub(super) fn identifier(text: &str, span: Span) -> Span {
    let written = text.get(span.range()).unwrap_or_default();
    let start = span.start as usize;
    let mut depth = 0_usize;
    let (mut begun, mut found) = (None, span);
    for (at, character) in written.char_indices().chain([(written.len(), '.')]) {
        let is_part = depth == 0 && (character.is_alphanumeric() || character == '_');
        match (character, is_part, begun) {
            (_, true, None) => begun = Some(at),
            (_, false, Some(from)) => {
                found = Span::new(start + from, start + at);
                begun = None;
            }
            _ => {}
        }
        match character {
            '[' => depth += 1,
            ']' => depth = depth.saturating_sub(1),
            _ => {}
        }
    }
    found
}

/// Mechanism of the file.
#[derive(Clone, Copy, Debug)]
pub struct Whole {
    /// Place of the name.
    pub name: Span,
    /// Place from the first word to the closing brace.
    pub span: Span,
}

/// Returns the mechanisms of a file in written order.
pub fn mechanisms(text: &str, lexemes: &[Lexeme]) -> Vec<Whole> {
    let mut mechanisms: Vec<Whole> = Vec::new();
    let mut depth = 0_usize;
    for (place, lexeme) in lexemes.iter().enumerate() {
        match lexeme.kind {
            Kind::Open(b'{') => depth += 1,
            Kind::Close(b'}') => depth = depth.saturating_sub(1),
            Kind::Word if depth == 0 && &text[lexeme.start..lexeme.end] == "mechanism" => {
                let name = lexemes.get(place + 1).filter(|it| it.kind == Kind::Word);
                mechanisms.extend(name.map(|name| Whole {
                    name: Span::new(name.start, name.end),
                    span: Span::new(lexeme.start, text.len()),
                }));
            }
            _ => {}
        }
        if depth == 0
            && lexeme.kind == Kind::Close(b'}')
            && let Some(last) = mechanisms.last_mut()
        {
            last.span = Span::new(last.span.start as usize, lexeme.end);
        }
    }
    mechanisms
}

/// Names that are found in the text.
pub(super) struct Reading<'a> {
    text: &'a str,
    lexemes: &'a [Lexeme],
    wholes: Vec<Whole>,
    pub symbols: Vec<Symbol>,
    pub mentions: Vec<Mention>,
    /// Values by mechanism and identifier; only looked up.
    values: HashMap<(usize, String), SymbolId>,
    /// Parts by mechanism and identifier; only looked up.
    parts: HashMap<(usize, String), SymbolId>,
    /// Mentioned symbols by the beginnings of mentions; only looked up.
    known: HashMap<u32, SymbolId>,
    /// Visible indices, with the number of open braces around each.
    indices: Vec<(String, SymbolId, usize)>,
}

impl<'a> Reading<'a> {
    pub(super) fn new(
        text: &'a str,
        lexemes: &'a [Lexeme],
        symbols: Vec<Symbol>,
        mentions: Vec<Mention>,
    ) -> Reading<'a> {
        let wholes = mechanisms(text, lexemes);
        let mut reading = Reading {
            text,
            lexemes,
            wholes,
            known: mentions
                .iter()
                .map(|it| (it.span.start, it.symbol))
                .collect(),
            symbols,
            mentions,
            values: HashMap::new(),
            parts: HashMap::new(),
            indices: Vec::new(),
        };
        for id in 0..reading.symbols.len() {
            let symbol = &reading.symbols[id];
            let is_value = matches!(symbol.sort, Sort::Constant | Sort::Parameter);
            if let (true, Some(whole)) = (is_value, reading.whole_at(symbol.declared.start)) {
                let name = text[symbol.declared.range()].to_string();
                reading.values.entry((whole, name)).or_insert(id);
            }
        }
        reading
    }

    /// Returns the mechanism that contains an offset.
    fn whole_at(&self, offset: u32) -> Option<usize> {
        let inside = |it: &Whole| it.span.start <= offset && offset < it.span.end;
        self.wholes.iter().position(inside)
    }

    fn word(&self, place: usize) -> Option<&'a str> {
        let lexeme = self.lexemes.get(place)?;
        (lexeme.kind == Kind::Word).then(|| &self.text[lexeme.start..lexeme.end])
    }

    fn span(&self, place: usize) -> Span {
        let lexeme = self.lexemes[place];
        Span::new(lexeme.start, lexeme.end)
    }

    /// True if a statement begins here.
    fn begins(&self, place: usize) -> bool {
        let before = place.checked_sub(1).map(|it| self.lexemes[it].kind);
        matches!(
            before,
            Some(Kind::Mark(b';') | Kind::Open(b'{') | Kind::Close(b'}'))
        )
    }

    /// Returns the end of the statement that begins here, or of its head: its semicolon or its first brace.
    fn end(&self, place: usize) -> usize {
        let rest = self.lexemes[place..].iter();
        let ends = |it: &Lexeme| {
            matches!(
                it.kind,
                Kind::Mark(b';') | Kind::Open(b'{') | Kind::Close(b'}')
            )
        };
        let length = rest.clone().position(ends);
        place + length.unwrap_or(self.lexemes.len() - place)
    }

    fn declare(&mut self, sort: Sort, name: usize, first: usize, end: usize) -> SymbolId {
        let declared = self.span(name);
        let last = end.min(self.lexemes.len() - 1);
        let end = match self.lexemes[last].kind {
            Kind::Mark(b';') => self.lexemes[last].end,
            _ => self.lexemes[last.max(1) - 1].end,
        };
        let written = Span::new(self.lexemes[first].start, end.max(declared.end as usize));
        let name = self.text[declared.range()].to_string();
        let id = self.symbols.len();
        self.symbols.push(Symbol {
            sort,
            spelled: name.clone(),
            name,
            place: declared,
            declared,
            written,
            statement: written,
            opening: "",
            docs: Vec::new(),
            body: None,
            motion: None,
        });
        self.mention(declared, id);
        id
    }

    fn mention(&mut self, span: Span, symbol: SymbolId) {
        self.known.insert(span.start, symbol);
        self.mentions.push(Mention { span, symbol });
    }

    /// Declares the mechanisms that are parts, the parts and the indices, and finds their mentions.
    pub(super) fn all(&mut self) {
        let mut definitions: HashMap<String, usize> = HashMap::new();
        for (number, whole) in self.wholes.clone().into_iter().enumerate() {
            let at = self
                .lexemes
                .partition_point(|it| it.start < whole.name.start as usize);
            if !self.known.contains_key(&whole.name.start) {
                self.declare(Sort::Mechanism, at, at - 1, at + 1);
            }
            let name = self.text[whole.name.range()].to_string();
            definitions.entry(name).or_insert(number);
        }
        let mut depth = 0_usize;
        let mut head_until = 0;
        let mut brackets: Vec<bool> = Vec::new();
        for place in 0..self.lexemes.len() {
            match self.lexemes[place].kind {
                Kind::Open(b'{') => depth += 1,
                Kind::Close(b'}') => {
                    depth = depth.saturating_sub(1);
                    self.indices.retain(|(_, _, inside)| *inside <= depth);
                }
                Kind::Open(b'[') => {
                    let before = place.checked_sub(1).map(|it| self.lexemes[it].kind);
                    brackets.push(matches!(before, Some(Kind::Word | Kind::Close(b']'))));
                }
                Kind::Close(b']') => {
                    brackets.pop();
                }
                Kind::Word => {
                    match self.word(place) {
                        Some("repeat") if self.begins(place) => {
                            head_until = self.repeat(place, depth);
                        }
                        Some("part") if self.begins(place) => self.part(place, &definitions),
                        _ => {}
                    }
                    let is_index = brackets.last() == Some(&true) || place < head_until;
                    self.plain(place, is_index);
                }
                _ => {}
            }
        }
    }

    /// Declares the index of `repeat i from 1 to n {`; returns the end of the head.
    fn repeat(&mut self, place: usize, depth: usize) -> usize {
        let end = self.end(place);
        if let Some(name) = self.word(place + 1) {
            let id = self.declare(Sort::Index, place + 1, place, end);
            self.indices.push((name.to_string(), id, depth + 1));
        }
        end
    }

    /// Declares the part of `part left[1] = cell(L = 50mm) at (0, 0);`.
    fn part(&mut self, place: usize, definitions: &HashMap<String, usize>) {
        let end = self.end(place);
        let Some(name) = self.word(place + 1) else {
            return;
        };
        let id = self.declare(Sort::Part, place + 1, place, end);
        if let Some(whole) = self.whole_at(self.span(place).start) {
            let same = *self.parts.entry((whole, name.to_string())).or_insert(id);
            // `part leg[1]` and `part leg[2]` share one name.
            self.mention(self.span(place + 1), same);
        }
        let equals = (place..end).find(|&it| self.lexemes[it].kind == Kind::Mark(b'='));
        let Some((definition, at)) = equals.and_then(|equals| {
            let word = self.word(equals + 1)?;
            Some((*definitions.get(word)?, equals + 1))
        }) else {
            return;
        };
        let declared = self.wholes[definition].name.start;
        if let Some(&mechanism) = self.known.get(&declared) {
            self.mention(self.span(at), mechanism);
        }
        // An argument of the part is `L` before `=`.
        for given in at + 1..end.saturating_sub(1) {
            let is_given = self.lexemes[given + 1].kind == Kind::Mark(b'=');
            let value = self.word(given).filter(|_| is_given);
            let value = value.and_then(|it| self.values.get(&(definition, it.to_string())));
            if let Some(&value) = value {
                self.mention(self.span(given), value);
            }
        }
    }

    /// Finds a word that no statement mentions: an index, a value in an index, or a part before its `.`.
    fn plain(&mut self, place: usize, is_index: bool) {
        let span = self.span(place);
        let behind_dot = place
            .checked_sub(1)
            .is_some_and(|it| self.lexemes[it].kind == Kind::Mark(b'.'));
        let Some(word) = self
            .word(place)
            .filter(|_| !self.known.contains_key(&span.start))
        else {
            return;
        };
        let mut indices = self.indices.iter().rev();
        let index = indices.find(|it| it.0 == word && !behind_dot);
        if let Some(&(_, index, _)) = index {
            return self.mention(span, index);
        }
        let Some(whole) = self.whole_at(span.start) else {
            return;
        };
        let key = (whole, word.to_string());
        let value = self.values.get(&key).filter(|_| is_index && !behind_dot);
        let part = self.parts.get(&key).or_else(|| {
            // A part of a part is declared in the mechanism that it belongs to.
            let mut wholes = 0..self.wholes.len();
            wholes.find_map(|it| self.parts.get(&(it, word.to_string())))
        });
        let is_before_dot = self.is_before_dot(place);
        if let Some(&found) = value.or(part.filter(|_| is_before_dot)) {
            self.mention(span, found);
        }
    }

    /// True if a `.` follows a name and its indices.
    fn is_before_dot(&self, place: usize) -> bool {
        let mut depth = 0_usize;
        for lexeme in &self.lexemes[place + 1..] {
            match lexeme.kind {
                Kind::Open(b'[') => depth += 1,
                Kind::Close(b']') => depth = depth.saturating_sub(1),
                Kind::Mark(b'.') if depth == 0 => return true,
                _ if depth == 0 => return false,
                _ => {}
            }
        }
        false
    }
}
