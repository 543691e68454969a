//! Resolves statements of one word.

use super::resolve::Resolver;
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::{RequestKind, Statement};

impl Resolver<'_> {
    /// True if there is a statement of this kind; a second one is reported.
    pub(super) fn has(&mut self, wished: RequestKind, statements: &[&Statement]) -> bool {
        let wishes = statements.iter().filter_map(|it| it.request(wished));
        let spans: Vec<_> = wishes.map(|wish| wish.span).collect();
        let Some((first, others)) = spans.split_first() else {
            return false;
        };
        let message = match wished {
            RequestKind::Monitor => "the mechanism is monitored already",
            RequestKind::Unguarded => "the mechanism is unguarded already",
            RequestKind::Effort => "efforts are already requested",
            RequestKind::Reactions => "all reactions are already requested",
            RequestKind::LeastNorm => "reactions of the least norm are already requested",
            RequestKind::Energy => "energies are already requested",
            _ => "this is already requested",
        };
        for &span in others {
            self.diagnostics.push(
                Diagnostic::error(Code::DuplicateName, span, message)
                    .label("written again here")
                    .also(*first, "first written here")
                    .help("remove one of them"),
            );
        }
        true
    }
}
