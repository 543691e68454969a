//! `monitor` statements → whether one asks how close the mechanism is to a singular pose.

use super::resolve::Resolver;
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::Statement;

impl Resolver<'_> {
    /// Whether there is such a statement; a second one is reported.
    pub(super) fn monitor(&mut self, statements: &[&Statement]) -> bool {
        let spans = statements.iter().filter_map(|statement| match statement {
            Statement::Monitor(monitor) => Some(monitor.span),
            _ => None,
        });
        let spans: Vec<_> = spans.collect();
        let Some((first, others)) = spans.split_first() else {
            return false;
        };
        for &span in others {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::DuplicateName,
                    span,
                    "the mechanism is monitored already",
                )
                .label("written again here")
                .also(*first, "first written here")
                .help("remove one of them"),
            );
        }
        true
    }
}
