//! Holds the state shared by all grammar rules: the text, documentation, names in scope, and findings.

use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;

use super::brackets::StatementStarts;
use super::formula::Name;
use super::repair::Repaired;
use super::scan::Documentation;
use super::scope::{Expansion, Scope, Spellings};
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Span};

/// Result of a rule: its node, or the finding that stopped it.
pub(super) type Outcome<T> = Result<T, Box<Diagnostic>>;

/// State shared by all grammar rules.
pub(super) struct Reader<'a> {
    pub text: &'a str,
    pub repaired: &'a Repaired,
    pub starts: &'a StatementStarts,
    pub documentation: &'a [Documentation],
    /// Offsets at which an error follows from an earlier one, ascending.
    pub damage: &'a [usize],
    /// Location after the last lexeme.
    end: Span,
    findings: RefCell<Vec<Diagnostic>>,
    /// True while text is parsed again, whose findings are known.
    is_muted: Cell<bool>,
    /// Offsets before which documentation was consumed.
    documented: RefCell<BTreeSet<u32>>,
    scope: RefCell<Scope>,
}

impl<'a> Reader<'a> {
    pub(super) fn new(
        text: &'a str,
        repaired: &'a Repaired,
        starts: &'a StatementStarts,
        documentation: &'a [Documentation],
        damage: &'a [usize],
    ) -> Self {
        Self {
            text,
            repaired,
            starts,
            documentation,
            damage,
            end: Span::empty(text.trim_end().len()),
            findings: RefCell::default(),
            is_muted: Cell::new(false),
            documented: RefCell::default(),
            scope: RefCell::new(Scope::new()),
        }
    }

    /// Adds a finding, unless a finding of the scan explains it.
    pub(super) fn report(&self, finding: Diagnostic, from: u32, to: u32) {
        let first = self.damage.partition_point(|place| *place < from as usize);
        let damaged = self
            .damage
            .get(first)
            .is_some_and(|place| *place <= to as usize);
        let mut findings = self.findings.borrow_mut();
        if !damaged && !self.is_muted.get() && findings.len() < Diagnostics::MAX_FINDINGS {
            findings.push(finding);
        }
    }

    /// True if the limit of findings is reached, so that parsing can stop.
    pub(super) fn is_full(&self) -> bool {
        self.findings.borrow().len() >= Diagnostics::MAX_FINDINGS
    }

    /// Parses text again; its findings are dropped if `is_known`.
    pub(super) fn again<T>(&self, is_known: bool, read: impl FnOnce() -> T) -> T {
        let before = self.is_muted.replace(is_known || self.is_muted.get());
        let read = read();
        self.is_muted.set(before);
        read
    }

    pub(super) fn count_of_findings(&self) -> usize {
        self.findings.borrow().len()
    }

    /// Returns the findings, the spellings and the expanded names.
    pub(super) fn into_parts(self) -> (Vec<Diagnostic>, Spellings, Expansion) {
        let scope = self.scope.into_inner();
        (self.findings.into_inner(), scope.spellings, scope.expansion)
    }

    /// Reads from the scope, without parsing.
    pub(super) fn known<T>(&self, ask: impl FnOnce(&Scope) -> T) -> T {
        ask(&self.scope.borrow())
    }

    /// Changes the scope, without parsing.
    pub(super) fn learn<T>(&self, change: impl FnOnce(&mut Scope) -> T) -> T {
        change(&mut self.scope.borrow_mut())
    }

    /// Returns the value of a name of the scope, and records the mention.
    pub(super) fn mentioned<T>(
        &self,
        name: &Name,
        find: impl FnOnce(&Scope, &str) -> Option<(T, Span)>,
    ) -> Option<T> {
        let (value, declared) = self.known(|scope| find(scope, &name.text))?;
        self.learn(|scope| scope.mention(name.span, declared));
        Some(value)
    }

    /// Returns the source spelling of a name.
    pub(super) fn spelled(&self, name: &str) -> String {
        self.known(|scope| scope.spelled(name).to_string())
    }

    /// Records the source spelling of a name.
    ///
    /// # Errors
    /// Returns an error if another spelling resolves to the same name.
    pub(super) fn spell(&self, name: &Name, written: String) -> Outcome<()> {
        let known = self.learn(|scope| {
            let known = scope.spellings.entry(name.text.clone());
            known.or_insert_with(|| written.clone()).clone()
        });
        if known == written {
            return Ok(());
        }
        let message = format!("`{written}` and `{known}` are one name");
        let finding = Diagnostic::error(Code::DuplicateName, name.span, message)
            .label(format!("both would be called {}", name.text));
        Err(Box::new(
            finding.help("choose another name for one of them"),
        ))
    }

    /// Returns the text of a span.
    pub(super) fn written(&self, span: Span) -> &'a str {
        self.text.get(span.range()).unwrap_or("")
    }

    /// Returns the location after the last lexeme.
    pub(super) fn end_of_text(&self) -> Span {
        self.end
    }

    /// Returns the lines of documentation directly before an offset.
    pub(super) fn docs(&self, offset: u32, inner: bool) -> Vec<String> {
        let first = self
            .documentation
            .partition_point(|it| it.before < offset as usize);
        let mut lines = Vec::new();
        for comment in self.documentation[first..]
            .iter()
            .take_while(|it| it.before == offset as usize)
        {
            if comment.inner == inner {
                self.documented.borrow_mut().insert(comment.span.start);
                lines.extend(comment.lines.iter().cloned());
            }
        }
        if lines.iter().all(String::is_empty) {
            // A comment without text is not documentation.
            lines.clear();
        }
        lines
    }

    /// Returns the locations of documentation that no rule has consumed.
    pub(super) fn idle_documentation(&self) -> Vec<Span> {
        let documented = self.documented.borrow();
        let spans = self.documentation.iter().map(|it| it.span);
        spans
            .filter(|span| !documented.contains(&span.start))
            .collect()
    }
}
