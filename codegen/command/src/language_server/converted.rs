//! Converts answers about a text to those of the protocol.

use std::collections::HashMap;

use linkwright_codegen::diagnostic::Span;
use linkwright_editing::names::Sort;
use linkwright_editing::{Completion, CompletionKind, Edit, Entry, Hover};
use lsp_types::{
    self as lsp, CompletionItem, CompletionItemKind, CompletionTextEdit, DocumentSymbol,
    Documentation, HoverContents, Location, MarkupContent, MarkupKind, SymbolKind, TextEdit,
    WorkspaceEdit,
};

use super::document::Document;

/// Converts places to locations.
pub fn locations(document: &Document, places: &[Span]) -> Vec<Location> {
    let location = |place: &Span| Location::new(document.uri.clone(), document.text.range(*place));
    places.iter().map(location).collect()
}

/// Converts edits.
pub fn edits(document: &Document, edits: Vec<Edit>) -> Vec<TextEdit> {
    let each = edits.into_iter().map(|Edit { span, text }| TextEdit {
        range: document.text.range(span),
        new_text: text,
    });
    each.collect()
}

/// Converts edits of a document to those of a workspace.
pub fn workspace_edit(document: &Document, of_document: Vec<Edit>) -> WorkspaceEdit {
    let of_document = edits(document, of_document);
    WorkspaceEdit {
        changes: Some(HashMap::from([(document.uri.clone(), of_document)])),
        ..WorkspaceEdit::default()
    }
}

/// Converts the text beside the pointer.
pub fn hover(document: &Document, hover: Hover) -> lsp::Hover {
    lsp::Hover {
        contents: HoverContents::Markup(MarkupContent {
            kind: MarkupKind::Markdown,
            value: hover.text,
        }),
        range: Some(document.text.range(hover.span)),
    }
}

/// Converts a proposed word.
pub fn completion(document: &Document, completion: Completion) -> CompletionItem {
    CompletionItem {
        label: completion.label,
        kind: Some(item_kind(completion.kind)),
        detail: Some(completion.detail),
        documentation: completion.documentation.map(Documentation::String),
        text_edit: Some(CompletionTextEdit::Edit(TextEdit {
            range: document.text.range(completion.replaced),
            new_text: completion.text,
        })),
        ..CompletionItem::default()
    }
}

/// Returns the nearest kind of proposals that editors have.
fn item_kind(kind: CompletionKind) -> CompletionItemKind {
    match kind {
        CompletionKind::Keyword => CompletionItemKind::KEYWORD,
        CompletionKind::Joint => CompletionItemKind::CLASS,
        CompletionKind::Unit => CompletionItemKind::UNIT,
        CompletionKind::Function => CompletionItemKind::FUNCTION,
        CompletionKind::BuiltIn => CompletionItemKind::CONSTANT,
        CompletionKind::Ground => CompletionItemKind::STRUCT,
        CompletionKind::Component => CompletionItemKind::FIELD,
        CompletionKind::Name(sort) => match sort {
            Sort::Mechanism | Sort::Motion => CompletionItemKind::MODULE,
            Sort::Constant => CompletionItemKind::CONSTANT,
            Sort::Parameter
            | Sort::Input
            | Sort::Free
            | Sort::Angle
            | Sort::CurveParameter
            | Sort::Measure
            | Sort::Index => CompletionItemKind::VARIABLE,
            Sort::Table | Sort::Curve => CompletionItemKind::FUNCTION,
            Sort::Point | Sort::BodyPoint => CompletionItemKind::FIELD,
            Sort::Body | Sort::Part => CompletionItemKind::STRUCT,
            Sort::Joint | Sort::Element => CompletionItemKind::INTERFACE,
            Sort::Driver | Sort::Equation => CompletionItemKind::EVENT,
        },
    }
}

/// Converts an entry of an outline with its children.
pub fn symbol(document: &Document, entry: Entry) -> DocumentSymbol {
    let text = &document.text;
    let children = entry.children.into_iter();
    let children: Vec<DocumentSymbol> = children.map(|it| symbol(document, it)).collect();
    #[expect(deprecated, reason = "the field has to be given")]
    DocumentSymbol {
        name: entry.name,
        detail: None,
        kind: symbol_kind(entry.sort),
        tags: None,
        deprecated: None,
        range: text.range(entry.span),
        selection_range: text.range(entry.selected),
        children: (!children.is_empty()).then_some(children),
    }
}

/// Returns the nearest kind of symbols that editors have.
fn symbol_kind(sort: Option<Sort>) -> SymbolKind {
    match sort {
        Some(Sort::Mechanism) => SymbolKind::MODULE,
        Some(Sort::Motion) => SymbolKind::NAMESPACE,
        Some(Sort::Constant) => SymbolKind::CONSTANT,
        Some(
            Sort::Parameter | Sort::Input | Sort::Free | Sort::Angle | Sort::Measure | Sort::Index,
        ) => SymbolKind::VARIABLE,
        Some(Sort::Table | Sort::Curve) => SymbolKind::FUNCTION,
        Some(Sort::Point | Sort::BodyPoint | Sort::CurveParameter) => SymbolKind::FIELD,
        Some(Sort::Body | Sort::Part) => SymbolKind::STRUCT,
        Some(Sort::Joint | Sort::Element) => SymbolKind::INTERFACE,
        Some(Sort::Driver | Sort::Equation) | None => SymbolKind::EVENT,
    }
}
