//! Resolves statements of one word.

use super::resolve::Resolver;
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::{DirectiveKind, Statement};

impl Resolver<'_> {
    /// True if there is a statement of this kind; a second one is reported.
    pub(super) fn has(&mut self, wished: DirectiveKind, statements: &[&Statement]) -> bool {
        let spans = statements.iter().filter_map(|statement| match statement {
            Statement::Directive(wish) if wish.kind == wished => Some(wish.span),
            _ => None,
        });
        let spans: Vec<_> = spans.collect();
        let Some((first, others)) = spans.split_first() else {
            return false;
        };
        let message = match wished {
            DirectiveKind::Monitor => "the mechanism is monitored already",
            DirectiveKind::Unguarded => "the mechanism is unguarded already",
            DirectiveKind::Effort => "efforts are already requested",
            DirectiveKind::Reactions => "all reactions are already requested",
            DirectiveKind::LeastNorm => "reactions of the least norm are already requested",
            DirectiveKind::Energy => "energies are already requested",
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
