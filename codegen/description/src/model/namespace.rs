//! Maps names to their meanings.
//!
//! Constants, points and bodies have separate name spaces. A name must be declared above its use. A declaration with an error
//! still declares its name, so that one mistake is reported once.

use std::collections::HashMap;

use crate::diagnostic::{Code, Diagnostic, Span, Suggestions};
use crate::syntax::Name;

/// Names of one sort in source order, with their meanings.
#[derive(Clone, Debug)]
pub(super) struct Namespace<T> {
    /// Noun in messages: `point`, `body`.
    sort: &'static str,
    declared: Vec<(Name, T)>,
    /// Index by name; never iterated.
    index: HashMap<String, usize>,
    suggestions: Suggestions,
}

impl<T> Namespace<T> {
    pub(super) fn new(sort: &'static str) -> Namespace<T> {
        Namespace {
            sort,
            declared: Vec::new(),
            index: HashMap::new(),
            suggestions: Suggestions::default(),
        }
    }

    /// Declares a name. For a duplicate, returns the error and keeps the first declaration.
    pub(super) fn declare(&mut self, name: &Name, value: T) -> Option<Diagnostic> {
        let duplicate = self.duplicate(name);
        if duplicate.is_none() {
            self.index.insert(name.text.clone(), self.declared.len());
            self.declared.push((name.clone(), value));
        }
        duplicate
    }

    /// Returns the error for a duplicate name; `None` if the name is free.
    pub(super) fn duplicate(&self, name: &Name) -> Option<Diagnostic> {
        let (earlier, _) = self.declaration(&name.text)?;
        let message = format!("the {} `{}` is declared twice", self.sort, name.text);
        Some(
            Diagnostic::error(Code::DuplicateName, name.span, message)
                .label("declared again here")
                .also(earlier.span, "first declared here")
                .help("give one of them another name"),
        )
    }

    pub(super) fn get(&self, text: &str) -> Option<&T> {
        self.index.get(text).map(|&at| &self.declared[at].1)
    }

    /// Returns declaration and meaning of a name; `None` if it is not declared.
    pub(super) fn declaration(&self, text: &str) -> Option<(&Name, &T)> {
        let (name, value) = &self.declared[*self.index.get(text)?];
        Some((name, value))
    }

    /// Returns location and meaning of a name; `None` if it is not declared.
    pub(super) fn found(&self, text: &str) -> Option<(Span, T)>
    where
        T: Copy,
    {
        self.declaration(text)
            .map(|(name, &value)| (name.span, value))
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = (&Name, &T)> {
        self.declared.iter().map(|(name, value)| (name, value))
    }

    /// Returns the error for an undeclared name, with the nearest declared one.
    pub(super) fn unknown(&self, text: &str, span: Span) -> Diagnostic {
        let message = format!("no {} is named `{text}`", self.sort);
        let diagnostic =
            Diagnostic::error(Code::UnknownName, span, message).label("not declared above");
        let known = self.declared.iter().map(|(name, _)| name.text.as_str());
        match self.suggestions.nearest(text, known) {
            Some(meant) => diagnostic.help(format!("did you mean `{meant}`?")),
            None => diagnostic.help(format!("declare the {} above this line", self.sort)),
        }
    }
}
