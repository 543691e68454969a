//! Finds declarations and mentions of a name.

use linkwright_codegen::diagnostic::Span;
use lsp_types::Location;

use super::document::Document;
use super::names::Names;

/// Returns the declarations of the name at an offset. A point that several bodies list under one name has one on each of them.
pub fn definitions(names: &Names, offset: usize) -> Vec<Span> {
    let Some(mention) = names.mention_at(offset) else {
        return Vec::new();
    };
    let here = names.mentioned_at(mention.span);
    let mut places: Vec<Span> = here.map(|it| names.symbols[it].declared).collect();
    places.sort();
    places.dedup();
    places
}

/// Returns the mentions of the name at an offset, with its declarations if `is_with_declaration`.
pub fn references(names: &Names, offset: usize, is_with_declaration: bool) -> Vec<Span> {
    let Some(mention) = names.mention_at(offset) else {
        return Vec::new();
    };
    let mut places = names.mentions_of(mention.symbol);
    let same = names.same(mention.symbol);
    let declared = |place: &Span| same.iter().any(|&it| names.symbols[it].declared == *place);
    places.retain(|place| is_with_declaration || !declared(place));
    places
}

/// Converts places to locations of the protocol.
pub fn locations(document: &Document, places: &[Span]) -> Vec<Location> {
    let location = |place: &Span| Location::new(document.uri.clone(), document.text.range(*place));
    places.iter().map(location).collect()
}
