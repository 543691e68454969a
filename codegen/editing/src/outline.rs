//! Lists the statements of a description for an editor.

use std::collections::{BTreeMap, BTreeSet};

use linkwright_codegen::diagnostic::Span;
use linkwright_codegen::stages::syntax::Statement;

use crate::description::Description;
use crate::names::{Sort, Symbol, Whole, mechanisms};

/// Largest number of characters of an entry.
const MAX_CHARACTERS: usize = 60;

/// Statement or point in an outline.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Beginning of the statement, or name of the point.
    pub name: String,
    /// Meaning of the declared name; `None` for a statement that does not declare one.
    pub sort: Option<Sort>,
    /// Text of the statement.
    pub span: Span,
    /// Place of the name, or of the statement.
    pub selected: Span,
    /// Points of a body, statements of a mechanism or a motion.
    pub children: Vec<Entry>,
}

/// Returns the mechanism with its statements; bodies contain their points, motions their statements.
pub fn outline(description: &Description) -> Vec<Entry> {
    let mut declared: BTreeMap<Span, Vec<&Symbol>> = BTreeMap::new();
    for symbol in &description.names.symbols {
        declared.entry(symbol.statement).or_default().push(symbol);
    }
    for symbols in declared.values_mut() {
        // Repetitions share one place.
        symbols.sort_by_key(|it| it.declared);
        symbols.dedup_by_key(|it| it.declared);
    }
    let outline = Outline {
        description,
        declared,
    };
    let Some(read) = &description.document else {
        return Vec::new();
    };
    let statements = &read.mechanism.statements;
    let mechanisms = mechanisms(&description.source.text, &description.lexemes);
    let mechanism = |whole: &Whole| {
        let name = description.source.text.get(whole.name.range());
        let name = format!("mechanism {}", name.unwrap_or_default());
        let children = outline.statements(statements, whole.span);
        entry(
            name,
            Some(Sort::Mechanism),
            whole.span,
            whole.name,
            children,
        )
    };
    mechanisms.iter().map(mechanism).collect()
}

struct Outline<'a> {
    description: &'a Description,
    /// Declarations of each statement, by place.
    declared: BTreeMap<Span, Vec<&'a Symbol>>,
}

impl Outline<'_> {
    /// Returns the statements that are written in a range of the text, each once.
    fn statements(&self, statements: &[Statement], part: Span) -> Vec<Entry> {
        let inside = |it: &Span| part.start <= it.start && it.end <= part.end;
        let mut seen = BTreeSet::new();
        let in_range = statements.iter().filter(|it| {
            let span = it.span();
            inside(&span) && seen.insert(span)
        });
        in_range.flat_map(|it| self.statement(it)).collect()
    }

    /// Returns one entry, or one for each point of a `point` statement.
    fn statement(&self, statement: &Statement) -> Vec<Entry> {
        let span = statement.span();
        let declared = self.declared.get(&span).map_or(&[][..], Vec::as_slice);
        if let Statement::Points(_) = statement {
            let points = declared.iter().map(|it| self.symbol(it));
            return points.collect();
        }
        let children = match statement {
            Statement::Motion(motion) => self.statements(&motion.statements, span),
            Statement::Body(_) => {
                let points = declared.iter().filter(|it| it.sort == Sort::BodyPoint);
                points.map(|it| self.symbol(it)).collect()
            }
            _ => Vec::new(),
        };
        let whole = declared.first().filter(|it| it.written == span);
        let sort = whole.map(|it| it.sort);
        let selected = whole.map_or(span, |it| it.declared);
        vec![entry(self.head(span), sort, span, selected, children)]
    }

    fn symbol(&self, symbol: &Symbol) -> Entry {
        let name = self.written(symbol.place).to_string();
        entry(
            name,
            Some(symbol.sort),
            symbol.written,
            symbol.declared,
            Vec::new(),
        )
    }

    fn written(&self, span: Span) -> &str {
        let text = self.description.source.text.get(span.range());
        text.unwrap_or_default()
    }

    /// Returns the beginning of a statement on one line, without the contents of braces.
    fn head(&self, span: Span) -> String {
        let head = self.written(span);
        let head = head.split(['{', ';', '\n']).next().unwrap_or_default();
        let head: String = head.trim().chars().take(MAX_CHARACTERS).collect();
        match head.is_empty() {
            true => "…".to_string(),
            false => head,
        }
    }
}

/// Creates an entry whose text contains its name.
fn entry(
    name: String,
    sort: Option<Sort>,
    span: Span,
    selected: Span,
    children: Vec<Entry>,
) -> Entry {
    Entry {
        name,
        sort,
        span: span.to(selected),
        selected,
        children,
    }
}
