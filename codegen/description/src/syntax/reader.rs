//! What every rule may ask about the text: how it is written, what is documented and known by name, and what has been found.

use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;

use super::brackets::StatementStarts;
use super::formula::Name;
use super::repair::Repaired;
use super::scan::Documentation;
use super::scope::{Scope, Spellings};
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Span};

/// What a rule gives: its node, or the one finding that stopped it.
pub(super) type Outcome<T> = Result<T, Box<Diagnostic>>;

/// What every rule may ask about the text.
pub(super) struct Reader<'a> {
    pub text: &'a str,
    pub repaired: &'a Repaired,
    pub starts: &'a StatementStarts,
    pub documentation: &'a [Documentation],
    /// Offsets near which errors say nothing new, ascending.
    pub damage: &'a [usize],
    /// The place after the last thing written.
    end: Span,
    findings: RefCell<Vec<Diagnostic>>,
    /// Whether what is read has been read before, and its findings are known.
    is_muted: Cell<bool>,
    /// Where documentation has been taken from.
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

    /// Keeps a finding, unless what was found by the scan explains it.
    pub(super) fn report(&self, finding: Diagnostic, from: u32, to: u32) {
        let first = self.damage.partition_point(|place| *place < from as usize);
        let damaged = self
            .damage
            .get(first)
            .is_some_and(|place| *place <= to as usize);
        let mut findings = self.findings.borrow_mut();
        if !damaged && !self.is_muted.get() && findings.len() < Diagnostics::MOST {
            findings.push(finding);
        }
    }

    /// Whether so much was found that going on is pointless.
    pub(super) fn is_full(&self) -> bool {
        self.findings.borrow().len() >= Diagnostics::MOST
    }

    /// Reads something again whose findings are known, where that is so.
    pub(super) fn again<T>(&self, is_known: bool, read: impl FnOnce() -> T) -> T {
        let before = self.is_muted.replace(is_known || self.is_muted.get());
        let read = read();
        self.is_muted.set(before);
        read
    }

    pub(super) fn count_of_findings(&self) -> usize {
        self.findings.borrow().len()
    }

    /// The findings, and how names are written.
    pub(super) fn into_parts(self) -> (Vec<Diagnostic>, Spellings) {
        (
            self.findings.into_inner(),
            self.scope.into_inner().spellings,
        )
    }

    /// Asks what is known by name. The question reads nothing.
    pub(super) fn known<T>(&self, ask: impl FnOnce(&Scope) -> T) -> T {
        ask(&self.scope.borrow())
    }

    /// Changes what is known by name, in the same manner.
    pub(super) fn learn<T>(&self, change: impl FnOnce(&mut Scope) -> T) -> T {
        change(&mut self.scope.borrow_mut())
    }

    /// How a name is written.
    pub(super) fn spelled(&self, name: &str) -> String {
        self.known(|scope| scope.spelled(name).to_string())
    }

    /// Keeps how a name is written.
    ///
    /// # Errors
    /// Another one is called so.
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

    /// The text of a span.
    pub(super) fn written(&self, span: Span) -> &'a str {
        self.text.get(span.range()).unwrap_or("")
    }

    /// The end of the last thing written.
    pub(super) fn end_of_text(&self) -> Span {
        self.end
    }

    /// The lines of the documentation directly before an offset.
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
            // Nothing is said.
            lines.clear();
        }
        lines
    }

    /// Documentation that no rule has asked for.
    pub(super) fn idle_documentation(&self) -> Vec<Span> {
        let documented = self.documented.borrow();
        let spans = self.documentation.iter().map(|it| it.span);
        spans
            .filter(|span| !documented.contains(&span.start))
            .collect()
    }
}
