//! Resolves a document into one mechanism for each of its motions.
//!
//! A motion is a complete mechanism: the statements outside all motions, followed by its own. A name of a motion is therefore
//! unknown outside it, and two motions may use one name differently.

use super::Mechanism;
use super::bounds::beyond_bounds;
use super::mention::{Mention, Mentions};
use super::namespace::Namespace;
use super::naming::Naming;
use super::parameters::unused;
use super::resolve::resolve_statements;
use crate::diagnostic::{Diagnostics, merged};
use crate::expr::{Excess, MAX_STORED_TERMS};
use crate::pool::Pool;
use crate::syntax::{Document, Statement};

/// Maximum total size of the motions of a document, in terms: each motion has its own equations and code.
const MAX_TOTAL_SIZE: usize = MAX_STORED_TERMS / 4;

/// Resolves a document into its motions in source order, or into one mechanism without motions, each with the pool of its
/// expressions. Names follow the rules of `naming`. `None` after an error; all errors of the document are in `diagnostics`.
pub fn resolve(
    document: &Document,
    naming: &'static Naming,
    diagnostics: &mut Diagnostics,
) -> Option<Vec<(Pool, Mechanism)>> {
    resolve_recording(document, naming, &mut None, diagnostics)
}

/// Returns the uses of names in a document, also in one with errors, in the order in which they are resolved. Every motion repeats
/// those of the statements outside all motions.
pub fn mentions(document: &Document, naming: &'static Naming) -> Vec<Mention> {
    let mut mentions = Some(Vec::new());
    resolve_recording(document, naming, &mut mentions, &mut Diagnostics::new());
    mentions.unwrap_or_default()
}

fn resolve_recording(
    document: &Document,
    naming: &'static Naming,
    mentions: &mut Mentions,
    diagnostics: &mut Diagnostics,
) -> Option<Vec<(Pool, Mechanism)>> {
    let mut findings = Diagnostics::new();
    let item = &document.mechanism;
    let shared: Vec<&Statement> = item
        .statements
        .iter()
        .filter(|statement| !matches!(statement, Statement::Motion(_)))
        .collect();
    check_names(document, naming, &mut findings);
    let mut motions = Vec::new();
    let mut parts = Vec::new();
    let mut size = 0;
    for motion in item.motions() {
        let statements = motion.statements.iter();
        let statements: Vec<&Statement> = shared.iter().copied().chain(statements).collect();
        let mut part = Diagnostics::new();
        let (pool, mechanism) = resolve_statements(
            document,
            &statements,
            Some(motion),
            naming,
            mentions,
            &mut part,
        );
        size += statements.len() + pool.graph.node_count() + pool.graph.store();
        let is_beyond = size > MAX_TOTAL_SIZE && pool.graph.excess().is_none();
        if is_beyond {
            part.push(beyond_bounds(Excess::Size, motion.name.span));
        }
        motions.push((pool, mechanism));
        parts.push((motion.name.text.as_str(), Some(motion.span), part));
        if is_beyond {
            break;
        }
    }
    if motions.is_empty() {
        motions.push(resolve_statements(
            document,
            &shared,
            None,
            naming,
            mentions,
            &mut findings,
        ));
    }
    findings.extend(merged(parts));
    // A statement that was not reached may use the parameter.
    let is_whole = motions
        .iter()
        .all(|(pool, _)| pool.graph.excess().is_none());
    if is_whole && !findings.is_full() {
        findings.extend(unused(motions.iter().map(|(_, it)| it)));
    }
    let failed = findings.has_errors();
    diagnostics.extend(findings);
    if failed { None } else { Some(motions) }
}

/// Checks the names of motions: each becomes part of the output, so it must be valid and unique.
fn check_names(document: &Document, naming: &Naming, diagnostics: &mut Diagnostics) {
    let mut declared = Namespace::new("motion");
    for motion in document.mechanism.motions() {
        // A missing name has been reported.
        if motion.name.text.is_empty() {
            continue;
        }
        diagnostics.extend((naming.motion)(&motion.name));
        diagnostics.extend(declared.declare(&motion.name, ()));
    }
}
