//! The order in which unknowns are defined by one another.

use std::collections::BTreeSet;

use linkwright_codegen::diagnostic::Source;
use linkwright_tests::plan::solved;

/// Bodies in a ring: the place of each follows from that of the next, by this share of it.
fn ring(bodies: usize, share: &str) -> String {
    let all: Vec<usize> = (0..bodies).collect();
    let declared = all
        .iter()
        .map(|k| format!("body b{k} at (0, 0) {{ P: (1, 0) }}"));
    let held = all.iter().map(|k| {
        let next = (k + 1) % bodies;
        format!(
            "equation x(b{k}) = {share}*b{next}.P.x; equation y(b{k}) = {share}*b{next}.P.y; equation phi(b{k}) = {k}*t;"
        )
    });
    let statements: Vec<String> = declared.chain(held).collect();
    format!("mechanism ring {{ {} }}", statements.join("\n"))
}

#[test]
fn no_definition_mentions_what_is_defined_after_it() {
    // The product of all shares may be too small for a number, and is zero then.
    for share in ["0.1", "1e-60", "1e-74"] {
        for bodies in [2, 3, 6, 9] {
            let source = Source::new("ring.mech", ring(bodies, share));
            let read = linkwright_codegen::read(&source);
            let read = read.unwrap_or_else(|errors| panic!("{}", errors.render(&source)));
            let solved = solved(read.only().expect("one motion"));
            let form = &solved.system().vector_form;
            let mut known = BTreeSet::new();
            for block in &solved.plan().blocks {
                known.extend(block.parts.iter().flat_map(|part| &part.unknowns).copied());
                for definition in &block.definitions {
                    let mentioned = solved.pool().mentioned(definition.value);
                    assert!(
                        mentioned.iter().all(|unknown| known.contains(unknown)),
                        "{share}, {bodies} bodies: {}",
                        form.unknowns[definition.unknown].name
                    );
                    known.insert(definition.unknown);
                }
            }
            assert_eq!(known.len(), form.unknowns.len());
        }
    }
}
