//! Formats a text as edits. A text with errors is left unchanged: its diagnostics report them.

use linkwright_codegen::diagnostic::Span;
use lsp_types::TextEdit;

use super::document::Document;

/// Returns one edit of all lines that change; empty if none does.
pub fn edits(document: &Document) -> Vec<TextEdit> {
    let text = document.text.as_str();
    let Ok(formatted) = linkwright_codegen::format(&document.source()) else {
        return Vec::new();
    };
    if formatted == text {
        return Vec::new();
    }
    let before = common(text.split_inclusive('\n'), formatted.split_inclusive('\n'));
    let [old, new] = [&text[before..], &formatted[before..]];
    let after = common(
        old.split_inclusive('\n').rev(),
        new.split_inclusive('\n').rev(),
    );
    vec![TextEdit {
        range: document.text.range(Span::new(before, text.len() - after)),
        new_text: new[..new.len() - after].to_string(),
    }]
}

/// Returns the number of bytes of the first lines that agree.
fn common<'a>(one: impl Iterator<Item = &'a str>, other: impl Iterator<Item = &'a str>) -> usize {
    let same = one.zip(other).take_while(|(one, other)| one == other);
    same.map(|(line, _)| line.len()).sum()
}
