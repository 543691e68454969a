//! Generated source as the formatter leaves it → as a person lays it out.
//!
//! The formatter knows neither comments nor empty lines. Comments are emitted as statements of a marker macro, which are
//! replaced here, and items are set apart by an empty line.

use proc_macro2::TokenStream;
use quote::quote;

use super::lines::broken;
use crate::emit::lines::filled;

/// What a comment is until the source is laid out; no generated code uses a macro of this name.
const MARKER: &str = "comment_in_generated_code!(";

/// What a text that is laid out already is until then.
const VERBATIM: &str = "const VERBATIM_IN_GENERATED_CODE: &str = ";

/// What lines of code are until then.
const LINES_MARKER: &str = "lines_in_generated_code!(";

/// What a string of lines begins with; no other string does.
pub(super) const LINES: &str = "=>";

/// The longest line that fits as deep as statements stand.
const LONGEST_LINE: usize = 96;

/// Statements that are lines already, one after the other: the formatter only sees one call of a macro.
#[derive(Clone, Debug, Default)]
pub(super) struct Lines(String);

impl Lines {
    /// Takes a statement, as the formatter would write it in a line of any length, where it fits into one.
    pub(super) fn take(&mut self, line: &str) -> bool {
        let is_line = line.len() <= LONGEST_LINE && !line.contains('{');
        if is_line {
            self.0.push_str(line);
        }
        is_line
    }

    /// What stands for those that have been taken since.
    pub(super) fn statement(&mut self) -> Option<TokenStream> {
        let text = std::mem::take(&mut self.0);
        (!text.is_empty()).then(|| {
            let text = format!("{LINES}{text}");
            quote!(lines_in_generated_code!(#text);)
        })
    }
}

/// Code as tokens.
pub(super) fn tokens(code: &str) -> TokenStream {
    // It is made of names and numbers, so this is a matter of our own code alone.
    code.parse()
        .unwrap_or_else(|error| panic!("generated code has no tokens: {error}: {code}"))
}

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
    let lines = broken(&source.lines().collect::<Vec<_>>());
    let mut lines = lines.iter().map(String::as_str);
    while let Some(line) = lines.next() {
        let content = line.trim_start();
        let indent = &line[..line.len() - content.len()];
        if begins_item(content) && ends_item(previous.trim_start()) {
            text.push('\n');
        }
        if let Some(item) = verbatim(content) {
            if !text.is_empty() && !text.ends_with("\n\n") {
                text.push('\n');
            }
            for line in item.lines() {
                text.push_str(if line.is_empty() { "" } else { indent });
                text.push_str(line);
                text.push('\n');
            }
            previous = "}";
            continue;
        }
        if let Some(rest) = content.strip_prefix(LINES_MARKER) {
            let code = quoted(rest, &mut lines).trim_start_matches(LINES);
            for line in code.split_inclusive(';') {
                text.push_str(indent);
                text.push_str(line);
                text.push('\n');
                previous = line;
            }
            continue;
        }
        match content.strip_prefix(MARKER) {
            Some(rest) => {
                text.push_str(indent);
                text.push_str("// ");
                text.push_str(quoted(rest, &mut lines));
            }
            None => text.push_str(line),
        }
        text.push('\n');
        previous = line;
    }
    text
}

/// The string in the call of a marker, of which this follows the opening parenthesis. The formatter breaks a long one after that, and
/// before the closing one.
fn quoted<'a>(rest: &'a str, lines: &mut impl Iterator<Item = &'a str>) -> &'a str {
    let quoted = match rest.is_empty() {
        true => lines.next().unwrap_or_default().trim(),
        false => rest,
    };
    if rest.is_empty() {
        lines.next();
    }
    quoted.trim_end_matches(");").trim_matches('"')
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
    use proc_macro2::TokenStream;
    use quote::quote;

    use super::super::pieces::formatted;
    use super::{LONGEST_LINE, Lines, laid_out, tokens};

    /// A function with these statements, and text of every kind around them.
    fn function(statements: TokenStream) -> String {
        let items = quote! {
            /// A function.
            fn f(at: &mut Frame, last: &Frame) -> Result<(), Failure> {
                #statements
                if !spans(a, b) { return Err(singular(a, t, 3)); }
                Ok(())
            }
            const ONE: f64 = 1.0;
        };
        laid_out(&formatted(items, &[]))
    }

    #[test]
    fn lines_are_what_the_formatter_makes_of_their_tokens() {
        let lines = [
            "let a = -2.5e-7 * x / (y - 1.0) + math::atan2(u, -v);",
            "let (sine, cosine) = math::sin_cos(at.q.phi + 0.5);",
            "at.q.phi = angle_near(sine, cosine, last.q.phi);",
            "required(a - b, 3)?;",
            "let lift = TABLE_LIFT.at(x)[1] * branches.loop_a.sign::<Scalar>();",
        ];
        let mut taken = Lines::default();
        assert!(lines.iter().all(|line| taken.take(line)));
        let taken = taken.statement().expect("five lines");
        assert_eq!(taken.clone().into_iter().count(), 4, "one call of a macro");
        assert_eq!(function(taken), function(tokens(&lines.concat())));
    }

    #[test]
    fn what_may_not_fit_into_a_line_is_left_to_the_formatter() {
        let mut taken = Lines::default();
        assert!(!taken.take(&format!("let a = {} + b;", "c".repeat(LONGEST_LINE))));
        assert!(!taken.take("let a = if b < 0.0 { 1.0 } else { 2.0 };"));
        assert!(taken.statement().is_none());
    }

    #[test]
    fn documentation_that_ends_in_a_semicolon_is_not_torn_apart() {
        let source = "/// One thing;\n/// another.\nstruct A;\n/// B.\nstruct B;\n";
        let wanted = "/// One thing;\n/// another.\nstruct A;\n\n/// B.\nstruct B;\n";
        assert_eq!(laid_out(source), wanted);
    }
}
