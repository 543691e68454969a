//! Statements of one word → whether the mechanism has them.

use super::resolve::Resolver;
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::{Statement, WishKind};

impl Resolver<'_> {
    /// Whether there is a statement of this kind; a second one is reported.
    pub(super) fn wishes(&mut self, wished: WishKind, statements: &[&Statement]) -> bool {
        let spans = statements.iter().filter_map(|statement| match statement {
            Statement::Wish(wish) if wish.kind == wished => Some(wish.span),
            _ => None,
        });
        let spans: Vec<_> = spans.collect();
        let Some((first, others)) = spans.split_first() else {
            return false;
        };
        let message = match wished {
            WishKind::Monitor => "the mechanism is monitored already",
            WishKind::Unguarded => "the mechanism is unguarded already",
            WishKind::Effort => "efforts are already requested",
            WishKind::Reactions => "all reactions are already requested",
            WishKind::LeastNorm => "reactions of the least norm are already requested",
            WishKind::Energy => "energies are already requested",
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
