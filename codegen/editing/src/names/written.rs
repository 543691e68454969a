//! Finds places in the text: the identifier of a name, and the mechanisms of a file.

use linkwright_codegen::diagnostic::Span;
use linkwright_codegen::stages::syntax::{Kind, Lexeme};

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
