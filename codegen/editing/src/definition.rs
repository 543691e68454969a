//! Finds declarations and mentions of a name.

use linkwright_codegen::diagnostic::Span;

use crate::names::Names;

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
