//! Formats a text as edits. A text with errors is left unchanged: its diagnostics report them.

use linkwright_codegen::diagnostic::{Source, Span};

use crate::edit::Edit;

/// Returns one edit of all lines that change; empty if none does.
pub fn formatted(source: &Source) -> Vec<Edit> {
    let text = source.text.as_str();
    let Ok(formatted) = linkwright_codegen::format(source) else {
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
    vec![Edit {
        span: Span::new(before, text.len() - after),
        text: new[..new.len() - after].to_string(),
    }]
}

/// Returns the number of bytes of the first lines that agree.
fn common<'a>(one: impl Iterator<Item = &'a str>, other: impl Iterator<Item = &'a str>) -> usize {
    let same = one.zip(other).take_while(|(one, other)| one == other);
    same.map(|(line, _)| line.len()).sum()
}
