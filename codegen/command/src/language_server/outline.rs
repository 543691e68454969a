//! Lists the statements of a description for an editor.

use std::collections::{BTreeMap, BTreeSet};

use linkwright_codegen::diagnostic::Span;
use linkwright_codegen::stages::syntax::Statement;
use lsp_types::{DocumentSymbol, SymbolKind};

use super::description::Description;
use super::document::Document;
use super::names::{Sort, Symbol, Whole, mechanisms};

/// Largest number of characters of an entry.
const MAX_CHARACTERS: usize = 60;

/// Returns the mechanism with its statements; bodies contain their points, motions their statements.
pub fn outline(document: &Document, description: &Description) -> Vec<DocumentSymbol> {
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
        document,
        description,
        declared,
    };
    let Some(read) = &description.document else {
        return Vec::new();
    };
    let statements = &read.mechanism.statements;
    let mechanisms = mechanisms(&description.source.text, &description.lexemes);
    let entry = |whole: &Whole| {
        let name = description.source.text.get(whole.name.range());
        let name = format!("mechanism {}", name.unwrap_or_default());
        let children = outline.statements(statements, whole.span);
        outline.entry(name, SymbolKind::MODULE, whole.span, whole.name, children)
    };
    mechanisms.iter().map(entry).collect()
}

struct Outline<'a> {
    document: &'a Document,
    description: &'a Description,
    /// Declarations of each statement, by place.
    declared: BTreeMap<Span, Vec<&'a Symbol>>,
}

impl Outline<'_> {
    /// Returns the statements that are written in a range of the text, each once.
    fn statements(&self, statements: &[Statement], part: Span) -> Vec<DocumentSymbol> {
        let inside = |it: &Span| part.start <= it.start && it.end <= part.end;
        let mut seen = BTreeSet::new();
        let in_range = statements.iter().filter(|it| {
            let span = it.span();
            inside(&span) && seen.insert(span)
        });
        in_range.flat_map(|it| self.statement(it)).collect()
    }

    /// Returns one entry, or one for each point of a `point` statement.
    fn statement(&self, statement: &Statement) -> Vec<DocumentSymbol> {
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
        let kind = whole.map_or(SymbolKind::EVENT, |it| kind(it.sort));
        let selected = whole.map_or(span, |it| it.declared);
        vec![self.entry(self.head(span), kind, span, selected, children)]
    }

    fn symbol(&self, symbol: &Symbol) -> DocumentSymbol {
        let name = self.written(symbol.place).to_string();
        self.entry(
            name,
            kind(symbol.sort),
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

    fn entry(
        &self,
        name: String,
        kind: SymbolKind,
        span: Span,
        selected: Span,
        children: Vec<DocumentSymbol>,
    ) -> DocumentSymbol {
        let text = &self.document.text;
        #[expect(deprecated, reason = "the field has to be given")]
        DocumentSymbol {
            name,
            detail: None,
            kind,
            tags: None,
            deprecated: None,
            range: text.range(span.to(selected)),
            selection_range: text.range(selected),
            children: (!children.is_empty()).then_some(children),
        }
    }
}

/// Returns the nearest kind that editors have.
fn kind(sort: Sort) -> SymbolKind {
    match sort {
        Sort::Mechanism => SymbolKind::MODULE,
        Sort::Motion => SymbolKind::NAMESPACE,
        Sort::Constant => SymbolKind::CONSTANT,
        Sort::Parameter | Sort::Input | Sort::Free | Sort::Angle | Sort::Index => {
            SymbolKind::VARIABLE
        }
        Sort::Table | Sort::Curve => SymbolKind::FUNCTION,
        Sort::Point | Sort::BodyPoint | Sort::CurveParameter => SymbolKind::FIELD,
        Sort::Body | Sort::Part => SymbolKind::STRUCT,
        Sort::Joint | Sort::Element => SymbolKind::INTERFACE,
        Sort::Driver | Sort::Equation => SymbolKind::EVENT,
    }
}
