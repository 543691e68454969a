//! *Findings in any order → findings by position, each once.*

use super::source::Lines;
use super::{Diagnostic, Severity, Source, render};

/// Where every stage puts what it finds.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Diagnostics {
    found: Vec<Diagnostic>,
    errors: usize,
}

impl Diagnostics {
    /// So many errors are kept, and as many warnings: nobody reads more, and a large file of rubbish would produce millions.
    pub const MOST: usize = 100;

    /// An empty sink.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds one finding; beyond [`Diagnostics::MOST`] of its severity it is left out.
    pub fn push(&mut self, diagnostic: Diagnostic) {
        let is_error = diagnostic.severity == Severity::Error;
        let others = if is_error {
            self.errors
        } else {
            self.found.len() - self.errors
        };
        if others < Diagnostics::MOST {
            self.errors += usize::from(is_error);
            self.found.push(diagnostic);
        }
    }

    /// Whether so many errors were found that going on is pointless.
    pub fn is_full(&self) -> bool {
        self.errors >= Diagnostics::MOST
    }

    /// The findings as they are now, to come back to.
    pub fn mark(&self) -> usize {
        self.found.len()
    }

    /// Forgets what was found after a mark.
    pub fn forget_after(&mut self, mark: usize) {
        self.found.truncate(mark);
        let is_error = |it: &&Diagnostic| it.severity == Severity::Error;
        self.errors = self.found.iter().filter(is_error).count();
    }

    /// Whether nothing was found, not even a warning.
    pub fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    /// Whether the pipeline must stop at the border of this stage.
    pub fn has_errors(&self) -> bool {
        self.errors > 0
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
            Diagnostics::MOST.. => text.push_str(&format!(
                "error: at least {errors} errors in {}\n",
                lines.name()
            )),
            _ => text.push_str(&format!("error: {errors} errors in {}\n", lines.name())),
        }
        text
    }
}

impl Extend<Diagnostic> for Diagnostics {
    fn extend<I: IntoIterator<Item = Diagnostic>>(&mut self, diagnostics: I) {
        diagnostics.into_iter().for_each(|it| self.push(it));
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
