//! Records the uses of names for an editor.
//!
//! Every use is recorded where it is resolved, so that an editor and the equations agree about its declaration.

use super::resolve::Resolver;
use crate::diagnostic::Span;
use crate::syntax::{Direction, Name, Reference};

/// Use of a declared name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mention {
    /// Source location of the use.
    pub span: Span,
    /// Name in the use and in the declaration, after repetitions are expanded: `rod3`.
    pub name: String,
    /// Source location of the name that is used: of its declaration, or of a list or a line that names it.
    pub declaration: Span,
}

/// Recorder of mentions; `None` for a caller that does not read them.
pub(super) type Mentions = Option<Vec<Mention>>;

impl Resolver<'_> {
    /// Records a use of a name that is declared at this location.
    pub(super) fn note_use(&mut self, name: &Name, declaration: Span) {
        if let Some(mentions) = &mut self.mentions {
            mentions.push(Mention {
                name: name.text.clone(),
                span: name.span,
                declaration,
            });
        }
    }

    /// Records the bodies and points in a joint or driver that has an error of its form. Each end of the line is on the operand with
    /// the number in `owners`.
    pub(super) fn note_operands(
        &mut self,
        operands: &[Reference],
        along: Option<&Direction>,
        owners: [usize; 2],
    ) {
        if self.mentions.is_none() {
            return;
        }
        let before = self.diagnostics.mark();
        let mut bodies = Vec::new();
        for operand in operands {
            let body = self.body(operand.body.as_ref().unwrap_or(&operand.name));
            bodies.push(body);
            match (body, &operand.body) {
                (Some(body), Some(_)) => self.mark_on(body, &operand.name),
                (None, None) => self.mark_on_ground(&operand.name),
                _ => None,
            };
        }
        let ends = along.iter().flat_map(|along| [&along.from, &along.to]);
        for (end, owner) in ends.zip(owners) {
            let body = match &end.body {
                Some(body) => self.body(body),
                None => bodies.get(owner).copied().flatten(),
            };
            body.and_then(|body| self.mark_on(body, &end.name));
        }
        // The error of the form is the only one of the statement.
        self.diagnostics.forget_after(before);
    }
}
