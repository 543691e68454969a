//! Proposes words at an offset.
//!
//! Statements, kinds, functions and units come from the tables of the language, so that new ones appear without changes here.

use std::collections::BTreeSet;

use linkwright_codegen::diagnostic::Span;
use linkwright_codegen::stages::joint::{CONSTRAINTS, DRIVERS, Kind as JointKind, Slot};
use linkwright_codegen::stages::model::{FUNCTIONS, LAWS, MEASURE_FUNCTIONS, UNITS};
use linkwright_codegen::stages::syntax::{AXES, BUILT_IN, CLAUSES, KEYWORDS, Kind};

use crate::description::Description;
use crate::names::{Sort, SymbolId};
use crate::statement::Statement;

/// Components of a point.
const COMPONENTS: [&str; 2] = ["x", "y"];

/// Proposed word.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Completion {
    /// Word in the list.
    pub label: String,
    /// Kind, for a symbol beside the word.
    pub kind: CompletionKind,
    /// Kind in words.
    pub detail: String,
    /// Documentation, or an example; `None` if there is none.
    pub documentation: Option<String>,
    /// Replaced text: the word that has begun.
    pub replaced: Span,
    /// New text.
    pub text: String,
}

/// Kind of a proposed word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CompletionKind {
    /// Word that begins a statement or a clause.
    Keyword,
    /// Kind of joint or driver.
    Joint,
    /// Unit of a number.
    Unit,
    /// Function or law of motion.
    Function,
    /// Predefined name.
    BuiltIn,
    /// Fixed body.
    Ground,
    /// Component of a point.
    Component,
    /// Name that the description declares.
    Name(Sort),
}

impl CompletionKind {
    /// Returns the name of the kind in one word.
    pub fn name(self) -> &'static str {
        match self {
            CompletionKind::Keyword => "keyword",
            CompletionKind::Joint => "joint",
            CompletionKind::Unit => "unit",
            CompletionKind::Function => "function",
            CompletionKind::BuiltIn | CompletionKind::Ground => "constant",
            CompletionKind::Component => "property",
            CompletionKind::Name(_) => "variable",
        }
    }
}

/// Returns the words that are valid at an offset.
pub fn completions(description: &Description, offset: usize) -> Vec<Completion> {
    let here = description.lexeme_at(offset);
    let written = here.filter(|it| it.start < offset);
    let is_text = written.is_some_and(|it| it.kind == Kind::Text);
    if is_text || description.is_in_comment(offset) {
        return Vec::new();
    }
    let word = written.filter(|it| matches!(it.kind, Kind::Word | Kind::Number));
    let number = word.filter(|it| it.kind == Kind::Number);
    let text = number.map_or("", |it| description.written(it));
    // `1.` is a number until a name follows.
    if let Some(body) = text.strip_suffix('.') {
        let offer = Offer::new(description, offset, offset);
        return offer.members(body);
    }
    if let (Some(number), false) = (number, text.bytes().all(|it| it.is_ascii_digit())) {
        let is_digit = |it: char| it.is_ascii_digit() || matches!(it, '.' | '_');
        let digits = text.len() - text.trim_start_matches(is_digit).len();
        let start = (number.start + digits).min(offset);
        let offer = Offer::new(description, start, offset);
        return offer.words(UNITS, CompletionKind::Unit, "unit");
    }
    if number.is_some() {
        // More digits, a unit, or the end of a body's name can follow.
        let offer = Offer::new(description, offset, offset);
        return offer.words(UNITS, CompletionKind::Unit, "unit");
    }
    let start = word.map_or(offset, |it| it.start);
    Offer::new(description, start, offset).anything()
}

/// Context of the proposals at an offset.
struct Offer<'a> {
    description: &'a Description,
    statement: Statement<'a>,
    /// Replaced text: the word that has begun, up to the offset.
    replaced: Span,
}

impl<'a> Offer<'a> {
    fn new(description: &'a Description, start: usize, offset: usize) -> Offer<'a> {
        Offer {
            description,
            statement: Statement::before(description, start),
            replaced: Span::new(start, offset),
        }
    }

    fn anything(&self) -> Vec<Completion> {
        let statement = &self.statement;
        if let Some((Kind::Mark(b'.'), _)) = statement.last() {
            return self.members(&statement.owner());
        }
        let Some(opening) = statement.opening() else {
            return match (statement.open.is_empty(), statement.around()) {
                (true, _) => self.words(&["mechanism"], CompletionKind::Keyword, "statement"),
                (false, Some("body")) => self.named(|sort| sort == Sort::Point),
                (false, _) => self.statements(),
            };
        };
        let last = statement.last().map_or("", |(_, text)| text);
        let second = statement.first.and_then(|it| statement.word(it + 1));
        if opening == "redundant" && last == opening {
            return self.kinds(CONSTRAINTS, "joint");
        }
        if matches!(opening, "drive" | "free") && (last == opening || last == ":") {
            let mut items = self.kinds(DRIVERS, "driven quantity");
            items.extend(self.named(is_place));
            return items;
        }
        if opening == "friction" && last == opening {
            // A pin may have the name of its point.
            return self.named(|sort| matches!(sort, Sort::Joint | Sort::Point | Sort::BodyPoint));
        }
        if opening == "motor" && last == opening {
            return self.named(|sort| sort == Sort::Driver);
        }
        let kinds = [CONSTRAINTS, DRIVERS].concat();
        let kind = [Some(opening), second].into_iter().flatten();
        let kind = kind.filter_map(|word| kinds.iter().find(|it| it.keyword == word));
        if let (Some(kind), Some(open), false) =
            (kind.clone().next(), statement.open.last(), last == ")")
            && open.bracket == b'('
            && !self.is_behind_equals()
        {
            let slot = kind.operands.slots.get(open.commas).copied();
            return self.operand(slot);
        }
        self.formula()
    }

    /// True if the value of the statement has begun.
    fn is_behind_equals(&self) -> bool {
        let statement = &self.statement;
        let written = &statement.before[statement.first.unwrap_or(0)..];
        written.iter().any(|it| it.kind == Kind::Mark(b'='))
    }

    /// True inside a `measure` statement.
    fn is_measure(&self) -> bool {
        self.statement.opening() == Some("measure")
    }

    fn statements(&self) -> Vec<Completion> {
        let mut items = self.words(&KEYWORDS, CompletionKind::Keyword, "statement");
        items.extend(self.kinds(CONSTRAINTS, "joint"));
        items
    }

    /// Returns proposals for the parentheses of a joint or a driver.
    fn operand(&self, slot: Option<Slot>) -> Vec<Completion> {
        match slot {
            Some(Slot::Body | Slot::Counterpart | Slot::Carrier) => self.bodies(),
            Some(Slot::Turning) => {
                let mut items = self.bodies();
                items.extend(self.named(|sort| sort == Sort::Angle));
                items
            }
            Some(Slot::Curve) => self.named(|sort| sort == Sort::Curve),
            Some(Slot::GroundPoint) => self.named(|sort| sort == Sort::Point),
            Some(Slot::Point | Slot::Pin) | None => {
                let mut items = self.bodies();
                items.extend(self.named(|sort| sort == Sort::Point));
                items
            }
        }
    }

    fn bodies(&self) -> Vec<Completion> {
        let mut items = self.named(|sort| sort == Sort::Body);
        items.extend(self.words(&["ground"], CompletionKind::Ground, "fixed body"));
        items
    }

    /// Returns all beginnings of a formula or a clause.
    fn formula(&self) -> Vec<Completion> {
        let mut items = self.named(|sort| !matches!(sort, Sort::Mechanism | Sort::Motion));
        items.extend(self.words(FUNCTIONS, CompletionKind::Function, "function"));
        if self.is_measure() {
            let functions = CompletionKind::Function;
            items.extend(self.words(MEASURE_FUNCTIONS, functions, "function of measures"));
        }
        items.extend(self.words(LAWS, CompletionKind::Function, "law of motion"));
        items.extend(self.words(&AXES, CompletionKind::Function, "coordinate"));
        items.extend(self.words(BUILT_IN, CompletionKind::BuiltIn, "built-in name"));
        items.extend(self.words(&CLAUSES, CompletionKind::Keyword, "keyword"));
        items.extend(self.words(&["ground"], CompletionKind::Ground, "fixed body"));
        let mut seen = BTreeSet::new();
        items.retain(|item| seen.insert(item.label.clone()));
        items
    }

    /// Returns proposals behind `OWNER.`: points of a body, bodies and points of a part, components of a point or an origin.
    ///
    /// All repetitions of an owner have the same members.
    fn members(&self, owner: &str) -> Vec<Completion> {
        if owner == "ground" {
            return self.named(|sort| sort == Sort::Point);
        }
        let names = &self.description.names;
        let owner = without_indices(owner);
        let spelled = |it: SymbolId| without_indices(&names.symbols[it].spelled);
        let is_body = |it: &SymbolId| names.symbols[*it].sort == Sort::Body;
        let body = self
            .known()
            .filter(is_body)
            .find(|&it| spelled(it) == owner);
        let points = body.into_iter().flat_map(|it| names.points_of(it));
        let mut items: Vec<Completion> = points
            .map(|it| {
                let symbol = &names.symbols[it];
                let last = symbol.spelled.rsplit('.').next();
                self.item_called(it, last.unwrap_or(&symbol.spelled))
            })
            .collect();
        let inside = format!("{owner}.");
        let mut seen = BTreeSet::new();
        for id in self.known() {
            let symbol_name = spelled(id);
            if let Some(rest) = symbol_name.strip_prefix(&inside)
                && !rest.contains('.')
                && seen.insert(rest.to_string())
            {
                items.push(self.item_called(id, rest));
            }
        }
        if seen.is_empty() {
            items.extend(self.words(&COMPONENTS, CompletionKind::Component, "component"));
        }
        items
    }

    /// Returns the symbols that are visible at the offset: those declared above it, except for those of other motions.
    fn known(&self) -> impl Iterator<Item = SymbolId> + '_ {
        let at = self.replaced.start;
        let symbols = self.description.names.symbols.iter().enumerate();
        symbols.filter_map(move |(id, symbol)| {
            let is_near = symbol
                .motion
                .is_none_or(|motion| motion.start <= at && at <= motion.end);
            let runs_here = symbol.sort != Sort::CurveParameter
                || (symbol.statement.start <= at && at <= symbol.statement.end);
            let is_here = !matches!(symbol.sort, Sort::Index | Sort::Mechanism)
                || (symbol.sort == Sort::Index && self.statement.is_inside(symbol.statement));
            (symbol.declared.end <= at && is_near && runs_here && is_here).then_some(id)
        })
    }

    fn named(&self, wanted: impl Fn(Sort) -> bool) -> Vec<Completion> {
        let symbols = &self.description.names.symbols;
        let mut seen = BTreeSet::new();
        let known = self.known().filter(|&it| wanted(symbols[it].sort));
        let new = known.filter(|&it| seen.insert(symbols[it].spelled.as_str()));
        new.map(|it| self.item(it)).collect()
    }

    fn item(&self, id: SymbolId) -> Completion {
        self.item_called(id, &self.description.names.symbols[id].spelled)
    }

    fn item_called(&self, id: SymbolId, label: &str) -> Completion {
        let symbol = &self.description.names.symbols[id];
        let docs = symbol.docs.join("\n");
        Completion {
            documentation: (!docs.is_empty()).then_some(docs),
            ..self.word(label, CompletionKind::Name(symbol.sort), symbol.sort.noun())
        }
    }

    /// Returns joints or drivers, each with an example.
    fn kinds(&self, kinds: &[&JointKind], detail: &str) -> Vec<Completion> {
        let each = kinds.iter().map(|kind| Completion {
            documentation: Some(kind.example.to_string()),
            ..self.word(kind.keyword, CompletionKind::Joint, detail)
        });
        each.collect()
    }

    fn words(&self, words: &[&str], kind: CompletionKind, detail: &str) -> Vec<Completion> {
        let each = words.iter().map(|word| self.word(word, kind, detail));
        each.collect()
    }

    fn word(&self, word: &str, kind: CompletionKind, detail: &str) -> Completion {
        Completion {
            label: word.to_string(),
            kind,
            detail: detail.to_string(),
            documentation: None,
            replaced: self.replaced,
            text: word.to_string(),
        }
    }
}

/// Removes the indices in brackets from a name.
fn without_indices(name: &str) -> String {
    let mut depth = 0_usize;
    let mut kept = String::new();
    for character in name.chars() {
        match character {
            '[' => depth += 1,
            ']' => depth = depth.saturating_sub(1),
            other if depth == 0 => kept.push(other),
            _ => {}
        }
    }
    kept
}

/// True if symbols of this sort have coordinates.
fn is_place(sort: Sort) -> bool {
    matches!(sort, Sort::Body | Sort::Point)
}
