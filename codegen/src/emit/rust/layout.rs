//! Generated source as the formatter leaves it → as a person lays it out.
//!
//! The formatter knows neither comments nor empty lines. Comments and what else is laid out already stand in strings until here, and
//! items are set apart by an empty line.

use proc_macro2::TokenStream;
use quote::quote;

use super::code;
use super::lines::{broken, wrapped};
use crate::emit::lines::{WIDTH, filled};

/// What a text that is laid out already is until then.
const VERBATIM: &str = "const VERBATIM_IN_GENERATED_CODE: &str = ";

/// An item that is laid out by hand: the call of a macro, of which the formatter knows nothing.
#[derive(Clone, Debug, Default)]
pub(super) struct Verbatim {
    lines: Vec<String>,
    depth: usize,
}

impl Verbatim {
    /// A line that the following ones are indented under.
    pub(super) fn open(&mut self, line: &str) {
        self.line(line);
        self.depth += 1;
    }

    /// The line that ends them.
    pub(super) fn close(&mut self, line: &str) {
        self.depth = self.depth.saturating_sub(1);
        self.line(line);
    }

    /// A line.
    pub(super) fn line(&mut self, line: impl AsRef<str>) {
        let text = format!("{}{}", "    ".repeat(self.depth), line.as_ref());
        self.lines.push(text.trim_end().to_string());
    }

    /// Elements with commas, as many to a line as it holds.
    pub(super) fn list<S: AsRef<str>>(&mut self, elements: impl IntoIterator<Item = S>) {
        let elements = elements.into_iter().map(|it| format!("{},", it.as_ref()));
        let elements: Vec<String> = elements.collect();
        let lines = filled(elements.iter().map(String::as_str), 4 * self.depth);
        self.lines.extend(lines);
    }

    /// Attributes, one a line.
    pub(super) fn tokens(&mut self, attributes: TokenStream) {
        let text = attributes
            .to_string()
            .replace("# [", "#[")
            .replace(" (", "(");
        for attribute in text.split("#[").filter(|it| !it.trim().is_empty()) {
            self.line(format!(
                "#[{}",
                attribute.trim().replace(" ,", ",").replace("( ", "(")
            ));
        }
    }

    /// Lines of documentation, each as it stands after the slashes.
    pub(super) fn docs<S: AsRef<str>>(&mut self, lines: impl IntoIterator<Item = S>) {
        for line in lines {
            let line = line.as_ref();
            let space = if line.starts_with(' ') || line.is_empty() {
                ""
            } else {
                " "
            };
            self.line(format!("///{space}{line}"));
        }
    }

    /// The item.
    pub(super) fn item(self) -> TokenStream {
        let text = self.lines.join("\n");
        quote!(const VERBATIM_IN_GENERATED_CODE: &str = #text;)
    }
}

/// The text of such an item.
fn verbatim(line: &str) -> Option<String> {
    let literal = line.strip_prefix(VERBATIM)?.strip_suffix(';')?;
    syn::parse_str::<syn::LitStr>(literal)
        .ok()
        .map(|it| it.value())
}

/// The source with its comments, and an empty line before every item that follows another.
pub(super) fn laid_out(source: &str) -> String {
    let mut text = Text::with_room(source.len() + source.len() / 16);
    let lines = broken(&source.lines().collect::<Vec<_>>());
    let mut lines = lines.iter().map(String::as_str);
    while let Some(line) = lines.next() {
        let content = line.trim_start();
        let depth = line.len() - content.len();
        if let Some(item) = verbatim(content) {
            text.item(&item, depth);
            continue;
        }
        let string = code::called(content).map(|rest| string(rest, &mut lines));
        match string.and_then(code::decoded) {
            Some(code) => code.iter().for_each(|line| text.code(line, depth)),
            None => text.line(line),
        }
    }
    text.all
}

/// Source that is being laid out.
struct Text {
    all: String,
    is_after_item: bool,
}

impl Text {
    fn with_room(capacity: usize) -> Text {
        Text {
            all: String::with_capacity(capacity),
            is_after_item: false,
        }
    }

    /// Adds a line as it is.
    fn line(&mut self, line: &str) {
        self.end_item_before(line.trim_start());
        self.all.extend([line, "\n"]);
    }

    /// Sets an item apart that this line begins.
    fn end_item_before(&mut self, content: &str) {
        if self.is_after_item && begins_item(content) {
            self.all.push('\n');
        }
        self.is_after_item = ends_item(content);
    }

    /// Adds a line that is indented by so much, in several lines where it is too long.
    fn code(&mut self, line: &str, depth: usize) {
        if depth + line.len() <= WIDTH {
            self.end_item_before(line.trim_start());
            self.all.extend(std::iter::repeat_n(' ', depth));
            self.all.extend([line, "\n"]);
            return;
        }
        let content = line.trim_start();
        let depth = depth + line.len() - content.len();
        for line in wrapped(content, depth) {
            self.line(&line);
        }
    }

    /// Adds an item with an empty line before it.
    fn item(&mut self, item: &str, depth: usize) {
        if !self.all.is_empty() && !self.all.ends_with("\n\n") {
            self.all.push('\n');
        }
        for line in item.lines() {
            let indent = if line.is_empty() { 0 } else { depth };
            self.all += &format!("{:indent$}{line}\n", "");
        }
        self.is_after_item = true;
    }
}

/// The string in the call of a macro, of which this follows the opening parenthesis. The formatter breaks a long one after that, and
/// before the closing one.
fn string<'a>(rest: &'a str, lines: &mut impl Iterator<Item = &'a str>) -> &'a str {
    let string = match rest.is_empty() {
        true => lines.next().unwrap_or_default().trim(),
        false => rest,
    };
    if rest.is_empty() {
        lines.next();
    }
    string.trim_end_matches(");")
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
