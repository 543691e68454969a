//! Writes prose as comments and literals of C, from which no text of a description can break out.

use super::ascii::ascii;
use crate::emit::code::Code;
use crate::emit::module::wrapped::wrapped;

/// Returns the text in ASCII without comment marks, trigraphs, line continuations and changes of writing direction.
pub(super) fn inert(text: &str) -> String {
    let is_visible = |it: &char| {
        !it.is_control() && !matches!(it, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    let text = text.replace('\t', "    ");
    let visible: String = ascii(&text.chars().filter(is_visible).collect::<String>());
    let mut inert = String::with_capacity(visible.len());
    for letter in visible.chars() {
        let joins = matches!(
            (inert.chars().next_back(), letter),
            (Some('*'), '/') | (Some('/'), '*') | (Some('?'), '?')
        );
        if joins {
            inert.push(' ');
        }
        inert.push(letter);
    }
    inert.trim_end_matches([' ', '\\']).to_string()
}

impl Code {
    /// Writes a comment; only lines that are too long are wrapped.
    pub(super) fn comment<S: AsRef<str>>(&mut self, lines: impl IntoIterator<Item = S>) {
        let lines: Vec<String> = lines.into_iter().map(|it| inert(it.as_ref())).collect();
        let mut broken = wrapped(lines);
        while broken.last().is_some_and(String::is_empty) {
            broken.pop();
        }
        let last = broken.len().saturating_sub(1);
        for (place, line) in broken.iter().enumerate() {
            let begin = if place == 0 { "/* " } else { "   " };
            let end = if place == last { " */" } else { "" };
            let text = format!("{begin}{line}");
            self.whole(format!("{}{end}", text.trim_end()));
        }
    }
}

/// Returns a text as a string literal.
pub(super) fn quoted(text: &str) -> String {
    let mut literal = String::from("\"");
    for letter in inert(text).chars() {
        match letter {
            '"' => literal.push_str("\\\""),
            '\\' => literal.push_str("\\\\"),
            '?' => literal.push_str("\\?"),
            _ => literal.push(letter),
        }
    }
    literal.push('"');
    literal
}
