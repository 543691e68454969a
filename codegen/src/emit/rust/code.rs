//! Writes items of Rust.

use super::docs::doc_lines;
use super::lints;
use crate::emit::code::Code;
use crate::emit::module::wrapped::wrapped;

impl Code {
    /// Adds a comment.
    pub(super) fn remark(&mut self, text: &str) {
        let text = text.replace(char::is_control, "");
        for line in wrapped([text]) {
            self.whole(format!("// {line}"));
        }
    }

    /// Adds lines of documentation.
    pub(super) fn docs<S: AsRef<str>>(&mut self, lines: impl IntoIterator<Item = S>) {
        for line in doc_lines(lines) {
            self.whole(format!("///{line}"));
        }
    }

    /// Adds elements with commas, as many to a line as it holds.
    pub(super) fn list(&mut self, elements: &[String]) {
        match elements {
            [] => {}
            [only] => self.whole(format!("{only},")),
            _ => self.line(elements.join(", ") + ","),
        }
    }

    /// Adds lines between braces.
    pub(super) fn block(&mut self, head: &str, inside: Code) {
        self.open(format!("{head} {{"));
        self.append(inside);
        self.close("}");
    }

    /// Adds an item with this documentation and these attributes.
    pub(super) fn item<S: AsRef<str>>(
        &mut self,
        docs: impl IntoIterator<Item = S>,
        attributes: impl IntoIterator<Item = &'static str>,
        item: Code,
    ) {
        self.gap();
        self.docs(docs);
        attributes.into_iter().for_each(|it| self.line(it));
        self.append(item);
    }

    /// Adds a function with this documentation, these attributes, and these statements.
    pub(super) fn function<S: AsRef<str>>(
        &mut self,
        docs: impl IntoIterator<Item = S>,
        attributes: impl IntoIterator<Item = &'static str>,
        head: &str,
        statements: Code,
    ) {
        let mut function = Code::default();
        function.block(head, statements);
        self.item(docs, attributes, function);
    }

    /// Adds a method that returns this value.
    pub(super) fn getter<S: AsRef<str>>(
        &mut self,
        docs: impl IntoIterator<Item = S>,
        name: &str,
        kind: &str,
        value: impl Into<String>,
    ) {
        let mut statements = Code::default();
        statements.line(value);
        let head = format!("pub fn {name}(&self) -> {kind}");
        self.function(docs, [], &head, statements);
    }

    /// Adds a function that a user may leave unused.
    pub(super) fn unused_function<S: AsRef<str>>(
        &mut self,
        docs: impl IntoIterator<Item = S>,
        head: &str,
        statements: Code,
    ) {
        let mut function = Code::default();
        function.block(head, statements);
        self.item(docs, lints::unused_item(&function), function);
    }
}

/// Returns the statement that destructures a value into the fields that are read; `None` if none is.
pub(super) fn taken_apart(kind: &str, value: &str, fields: &[(bool, &str)]) -> Option<String> {
    let read = fields.iter().filter(|(is_read, _)| *is_read);
    let names: String = read.map(|(_, name)| format!("{name}, ")).collect();
    (!names.is_empty()).then(|| format!("let {kind} {{ {names}.. }} = {value};"))
}

/// Returns the name of an argument, with an underscore before it if the argument is not read.
pub(super) fn argument(name: &str, is_read: bool) -> String {
    match is_read {
        true => name.to_string(),
        false => format!("_{name}"),
    }
}

/// Returns an array of these elements; equal elements are written once.
pub(super) fn array(elements: &[String]) -> String {
    match elements {
        [first, others @ ..] if !others.is_empty() && others.iter().all(|it| it == first) => {
            format!("[{first}; {}]", elements.len())
        }
        _ => format!("[{}]", elements.join(", ")),
    }
}
