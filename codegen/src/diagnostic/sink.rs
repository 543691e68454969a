//! *Findings in any order → findings by position, each once.*

use super::source::Lines;
use super::{Diagnostic, Severity, Source, render};

/// Where every stage puts what it finds.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Diagnostics {
    found: Vec<Diagnostic>,
}

impl Diagnostics {
    /// An empty sink.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds one finding.
    pub fn push(&mut self, diagnostic: Diagnostic) {
        self.found.push(diagnostic);
    }

    /// Whether nothing was found, not even a warning.
    pub fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    /// Whether the pipeline must stop at the border of this stage.
    pub fn has_errors(&self) -> bool {
        self.found
            .iter()
            .any(|diagnostic| diagnostic.severity == Severity::Error)
    }

    /// The findings in the order in which they were made.
    pub fn iter(&self) -> std::slice::Iter<'_, Diagnostic> {
        self.found.iter()
    }

    /// The findings ordered by position, then by code; equal ones once.
    pub fn into_sorted(mut self) -> Vec<Diagnostic> {
        self.found.sort_by(|one, other| {
            let key = |it: &Diagnostic| (it.primary.span.start, it.code, it.primary.span.end);
            key(one)
                .cmp(&key(other))
                .then_with(|| one.message.cmp(&other.message))
        });
        self.found.dedup();
        self.found
    }

    /// All findings as rustc would print them, without color, with a closing line that counts the errors.
    /// Empty when nothing was found.
    pub fn render(&self, source: &Source) -> String {
        let lines = Lines::of(source);
        let sorted = self.clone().into_sorted();
        let mut text = String::new();
        for diagnostic in &sorted {
            text.push_str(&render::one(diagnostic, &lines));
            text.push('\n');
        }
        let errors = sorted
            .iter()
            .filter(|it| it.severity == Severity::Error)
            .count();
        match errors {
            0 => {
                text.pop();
            }
            1 => text.push_str(&format!("error: 1 error in {}\n", lines.name())),
            _ => text.push_str(&format!("error: {errors} errors in {}\n", lines.name())),
        }
        text
    }
}

impl Extend<Diagnostic> for Diagnostics {
    fn extend<I: IntoIterator<Item = Diagnostic>>(&mut self, diagnostics: I) {
        self.found.extend(diagnostics);
    }
}

impl IntoIterator for Diagnostics {
    type Item = Diagnostic;
    type IntoIter = std::vec::IntoIter<Diagnostic>;

    /// The findings ordered by position, each once, as by [`Diagnostics::into_sorted`].
    fn into_iter(self) -> Self::IntoIter {
        self.into_sorted().into_iter()
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Code, Span};
    use super::*;

    #[test]
    fn sorted_by_position_then_code_and_each_once() {
        let mut found = Diagnostics::new();
        let late = Diagnostic::error(Code::UnknownName, Span::new(9, 10), "late");
        let early = Diagnostic::warning(Code::UnknownName, Span::new(1, 2), "early");
        let same_place = Diagnostic::error(Code::UnexpectedToken, Span::new(9, 12), "same place");
        found.extend([
            late.clone(),
            early.clone(),
            late.clone(),
            same_place.clone(),
        ]);
        assert!(found.has_errors());
        assert_eq!(found.into_sorted(), vec![early, same_place, late]);
    }

    #[test]
    fn a_warning_is_no_error() {
        let mut found = Diagnostics::new();
        assert_eq!(found.render(&Source::new("a.mech", "")), "");
        found.push(Diagnostic::warning(
            Code::UnknownName,
            Span::new(0, 0),
            "look",
        ));
        assert!(!found.has_errors() && !found.is_empty());
        assert!(!found.render(&Source::new("a.mech", "")).contains("error"));
    }
}
