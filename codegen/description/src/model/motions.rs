//! The statements of a document → one mechanism for each of its motions.
//!
//! A motion is a complete mechanism: the statements that stand outside of all motions, then its own. So no name of a motion is
//! known outside of it, and two motions may use one name for different things. Deliberately unknown here: what a statement
//! means.

use super::Mechanism;
use super::bounds::beyond_bounds;
use super::namespace::Namespace;
use super::naming::Naming;
use super::parameters::unused;
use super::resolve::resolve_statements;
use crate::diagnostic::{Diagnostics, merged};
use crate::expr::{Excess, LARGEST_STORE};
use crate::syntax::{Document, Statement};

/// The most that the motions of a document hold together, in terms: each has equations and code of its own.
const LARGEST_TOGETHER: usize = LARGEST_STORE / 4;

/// Resolves a document into its motions in written order; into one mechanism where it has none. `None` after an error; all
/// errors of the document are in `diagnostics`. Names are as `naming` wants them.
pub fn resolve(
    document: &Document,
    naming: &'static Naming,
    diagnostics: &mut Diagnostics,
) -> Option<Vec<Mechanism>> {
    let mut found = Diagnostics::new();
    let item = &document.mechanism;
    let shared: Vec<&Statement> = item
        .statements
        .iter()
        .filter(|statement| !matches!(statement, Statement::Motion(_)))
        .collect();
    check_names(document, naming, &mut found);
    let mut mechanisms = Vec::new();
    let mut parts = Vec::new();
    let mut size = 0;
    for motion in item.motions() {
        let own = motion.statements.iter();
        let statements: Vec<&Statement> = shared.iter().copied().chain(own).collect();
        let mut part = Diagnostics::new();
        let mechanism = resolve_statements(document, &statements, Some(motion), naming, &mut part);
        size += statements.len() + mechanism.graph.node_count() + mechanism.graph.store();
        let is_beyond = size > LARGEST_TOGETHER && mechanism.graph.excess().is_none();
        if is_beyond {
            part.push(beyond_bounds(Excess::Size, motion.name.span));
        }
        mechanisms.push(mechanism);
        parts.push((motion.name.text.as_str(), Some(motion.span), part));
        if is_beyond {
            break;
        }
    }
    if mechanisms.is_empty() {
        mechanisms.push(resolve_statements(
            document, &shared, None, naming, &mut found,
        ));
    }
    found.extend(merged(parts));
    // What was not reached may use it.
    let is_whole = mechanisms.iter().all(|it| it.graph.excess().is_none());
    if is_whole && !found.is_full() {
        found.extend(unused(&mechanisms));
    }
    let failed = found.has_errors();
    diagnostics.extend(found);
    if failed { None } else { Some(mechanisms) }
}

/// Every motion becomes a part of the output, so its name must be one, and no other's.
fn check_names(document: &Document, naming: &Naming, diagnostics: &mut Diagnostics) {
    let mut declared = Namespace::new("motion");
    for motion in document.mechanism.motions() {
        // A name that is missing has been reported.
        if motion.name.text.is_empty() {
            continue;
        }
        diagnostics.extend((naming.motion)(&motion.name));
        diagnostics.extend(declared.declare(&motion.name, ()));
    }
}
