//! Orders findings by position and removes duplicates.

use super::source::Lines;
use super::{Diagnostic, Severity, Source, render};

/// Sink for the findings of every stage.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Diagnostics {
    found: Vec<Diagnostic>,
    errors: usize,
}

impl Diagnostics {
    /// Maximum number of errors, and of warnings, that are kept. A large file of rubbish would produce millions.
    pub const MAX_FINDINGS: usize = 100;

    /// Creates an empty sink.
    #[doc(hidden)]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a finding, unless [`Diagnostics::MAX_FINDINGS`] of its severity are kept already.
    #[doc(hidden)]
    pub fn push(&mut self, diagnostic: Diagnostic) {
        let is_error = diagnostic.severity == Severity::Error;
        let others = if is_error {
            self.errors
        } else {
            self.found.len() - self.errors
        };
        if others < Diagnostics::MAX_FINDINGS {
            self.errors += usize::from(is_error);
            self.found.push(diagnostic);
        }
    }

    /// True if the limit of errors is reached, so that work can stop.
    #[doc(hidden)]
    pub fn is_full(&self) -> bool {
        self.errors >= Diagnostics::MAX_FINDINGS
    }

    /// Returns a mark of the present findings for [`Diagnostics::forget_after`].
    #[doc(hidden)]
    pub fn mark(&self) -> usize {
        self.found.len()
    }

    /// Removes the findings added after a mark.
    #[doc(hidden)]
    pub fn forget_after(&mut self, mark: usize) {
        self.found.truncate(mark);
        let is_error = |it: &&Diagnostic| it.severity == Severity::Error;
        self.errors = self.found.iter().filter(is_error).count();
    }

    /// True if there are neither errors nor warnings.
    pub fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    /// True if the pipeline must stop at the boundary of this stage.
    pub fn has_errors(&self) -> bool {
        self.errors > 0
    }

    /// Returns the findings in order of insertion.
    pub fn iter(&self) -> std::slice::Iter<'_, Diagnostic> {
        self.found.iter()
    }

    /// Returns the findings ordered by position, then by code, without duplicates.
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

    /// Renders all findings in the format of rustc, without color, with a final line that counts the errors. Empty if there are
    /// no findings.
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
            Diagnostics::MAX_FINDINGS.. => text.push_str(&format!(
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

    /// Iterates in the order of [`Diagnostics::into_sorted`].
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
        let mut findings = Diagnostics::new();
        let late = Diagnostic::error(Code::UnknownName, Span::new(9, 10), "late");
        let early = Diagnostic::warning(Code::UnknownName, Span::new(1, 2), "early");
        let same_place = Diagnostic::error(Code::UnexpectedToken, Span::new(9, 12), "same place");
        findings.extend([
            late.clone(),
            early.clone(),
            late.clone(),
            same_place.clone(),
        ]);
        assert!(findings.has_errors());
        assert_eq!(findings.into_sorted(), vec![early, same_place, late]);
    }

    #[test]
    fn a_warning_is_no_error() {
        let mut findings = Diagnostics::new();
        assert_eq!(findings.render(&Source::new("a.mech", "")), "");
        findings.push(Diagnostic::warning(
            Code::UnknownName,
            Span::new(0, 0),
            "look",
        ));
        assert!(!findings.has_errors() && !findings.is_empty());
        assert!(
            !findings
                .render(&Source::new("a.mech", ""))
                .contains("error")
        );
    }
}
