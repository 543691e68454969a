//! Generated source as the formatter leaves it → as a person lays it out.
//!
//! The formatter knows neither comments nor empty lines. Comments are emitted as statements of a marker macro, which are
//! replaced here, and items are set apart by an empty line.

use proc_macro2::TokenStream;
use quote::quote;

/// What a comment is until the source is laid out; no generated code uses a macro of this name.
const MARKER: &str = "comment_in_generated_code!(";

/// A statement that becomes the comment `// text`. The text must not hold quotes or backslashes.
pub(super) fn comment(text: &str) -> TokenStream {
    let text: String = text
        .chars()
        .filter(|character| !matches!(character, '"' | '\\'))
        .collect();
    quote!(comment_in_generated_code!(#text);)
}

/// The source with its comments, and an empty line before every item that follows another.
pub(super) fn laid_out(source: &str) -> String {
    let mut text = String::with_capacity(source.len() + source.len() / 16);
    let mut previous = "";
    let mut lines = source.lines();
    while let Some(line) = lines.next() {
        let content = line.trim_start();
        let indent = &line[..line.len() - content.len()];
        if begins_item(content) && ends_item(previous.trim_start()) {
            text.push('\n');
        }
        match content.strip_prefix(MARKER) {
            Some(rest) => {
                // The formatter breaks a long comment after the opening parenthesis and before the closing one.
                let quoted = if rest.is_empty() {
                    lines.next().unwrap_or_default().trim()
                } else {
                    rest
                };
                if rest.is_empty() {
                    lines.next();
                }
                text.push_str(indent);
                text.push_str("// ");
                text.push_str(quoted.trim_end_matches(");").trim_matches('"'));
            }
            None => text.push_str(line),
        }
        text.push('\n');
        previous = line;
    }
    text
}

/// Whether a line is the first of an item: its documentation, its attributes, or an item that needs none.
fn begins_item(line: &str) -> bool {
    ["///", "#[", "impl ", "fn ", "const "]
        .iter()
        .any(|start| line.starts_with(start))
}

/// Whether a line closes an item. An item's own documentation and attributes do not, however they end.
fn ends_item(line: &str) -> bool {
    if line.starts_with("//") {
        return false;
    }
    line == "}"
        || line == "];"
        || line == "};"
        || (line.ends_with(';') && !line.starts_with("let "))
}

#[cfg(test)]
mod tests {
    use super::laid_out;

    #[test]
    fn documentation_that_ends_in_a_semicolon_is_not_torn_apart() {
        let source = "/// One thing;\n/// another.\nstruct A;\n/// B.\nstruct B;\n";
        let wanted = "/// One thing;\n/// another.\nstruct A;\n\n/// B.\nstruct B;\n";
        assert_eq!(laid_out(source), wanted);
    }
}
