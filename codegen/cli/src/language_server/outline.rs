//! *A description → its statements, as an editor lists them.*

use std::collections::BTreeMap;

use linkwright_codegen::diagnostic::Span;
use linkwright_codegen::stages::syntax::Statement;
use lsp_types::{DocumentSymbol, SymbolKind};

use super::description::Description;
use super::document::Document;
use super::names::{Sort, Symbol};

/// The longest text of an entry, in characters.
const LONGEST: usize = 60;

/// The mechanism with its statements; bodies with their points, motions with their statements.
pub fn outline(document: &Document, description: &Description) -> Vec<DocumentSymbol> {
    let mut declared: BTreeMap<Span, Vec<&Symbol>> = BTreeMap::new();
    for symbol in &description.names.symbols {
        declared.entry(symbol.statement).or_default().push(symbol);
    }
    for symbols in declared.values_mut() {
        symbols.sort_by_key(|it| it.declared.start);
    }
    let outline = Outline {
        document,
        description,
        declared,
    };
    let Some(read) = &description.document else {
        return Vec::new();
    };
    let item = &read.mechanism;
    let children = outline.statements(&item.statements);
    let name = format!("mechanism {}", item.name.text);
    vec![outline.entry(
        name,
        SymbolKind::MODULE,
        item.span,
        item.name.span,
        children,
    )]
}

struct Outline<'a> {
    document: &'a Document,
    description: &'a Description,
    /// What each statement declares, by place.
    declared: BTreeMap<Span, Vec<&'a Symbol>>,
}

impl Outline<'_> {
    fn statements(&self, statements: &[Statement]) -> Vec<DocumentSymbol> {
        let each = statements.iter().flat_map(|it| self.statement(it));
        each.collect()
    }

    /// One entry, or one for each point of a `point` statement.
    fn statement(&self, statement: &Statement) -> Vec<DocumentSymbol> {
        let span = statement.span();
        let declared = self.declared.get(&span).map_or(&[][..], Vec::as_slice);
        if let Statement::Points(_) = statement {
            let points = declared.iter().map(|it| self.symbol(it));
            return points.collect();
        }
        let children = match statement {
            Statement::Motion(motion) => self.statements(&motion.statements),
            Statement::Body(_) => {
                let points = declared.iter().filter(|it| it.sort == Sort::BodyPoint);
                points.map(|it| self.symbol(it)).collect()
            }
            _ => Vec::new(),
        };
        let own = declared.first().filter(|it| it.written == span);
        let kind = own.map_or(SymbolKind::EVENT, |it| kind(it.sort));
        let selected = own.map_or(span, |it| it.declared);
        vec![self.entry(self.head(span), kind, span, selected, children)]
    }

    fn symbol(&self, symbol: &Symbol) -> DocumentSymbol {
        let name = symbol.name.clone();
        self.entry(
            name,
            kind(symbol.sort),
            symbol.written,
            symbol.declared,
            Vec::new(),
        )
    }

    /// How a statement begins: without what stands in braces, on one line.
    fn head(&self, span: Span) -> String {
        let text = self.description.source.text.get(span.range());
        let text = text.unwrap_or_default();
        let head = text.split(['{', ';', '\n']).next().unwrap_or_default();
        let head: String = head.trim().chars().take(LONGEST).collect();
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

/// The nearest of the kinds that editors know.
fn kind(sort: Sort) -> SymbolKind {
    match sort {
        Sort::Mechanism => SymbolKind::MODULE,
        Sort::Motion => SymbolKind::NAMESPACE,
        Sort::Constant => SymbolKind::CONSTANT,
        Sort::Parameter | Sort::Input | Sort::Free => SymbolKind::VARIABLE,
        Sort::Table | Sort::Curve => SymbolKind::FUNCTION,
        Sort::Point | Sort::BodyPoint | Sort::CurveParameter => SymbolKind::FIELD,
        Sort::Body => SymbolKind::STRUCT,
        Sort::Joint | Sort::Element => SymbolKind::INTERFACE,
        Sort::Driver | Sort::Equation => SymbolKind::EVENT,
    }
}
