//! Measures mechanisms in lanes: generated modules in a package of their own, and the interpreter's batches; beside them programs in C and
//! in Python, whose results are compared with the interpreter's.

pub mod batches;
pub mod by_hand;
pub mod lines;
pub mod modules;
pub mod processor;
pub mod python;
pub mod report;
pub mod sweeps;

use linkwright_codegen::diagnostic::Source;

use crate::{description, dyad_chain};

/// Description that is measured.
pub struct Measured {
    /// Name in tables and of modules.
    pub name: String,
    /// Description, as it is.
    pub guarded: Source,
    /// Description without the proof of the path.
    pub unguarded: Source,
    /// Time between frames (s).
    pub step: f64,
    /// True if all blocks are closed forms, which generated modules solve in lanes.
    pub has_lanes: bool,
}

/// Mechanisms of the repository with their steps (s), and chains of so many dyads.
const NAMES: [(&str, f64); 4] = [
    ("two_body", 0.001),
    ("four_bar", 0.01),
    ("excavator", 0.01),
    ("platform_3rpr", 0.01),
];
const CHAINS: [usize; 4] = [1, 7, 17, 40];

/// Returns all descriptions that are measured.
pub fn measured() -> Vec<Measured> {
    let named = NAMES.iter().map(|&(name, step)| {
        let guarded = description::source(name);
        let head = format!("mechanism {name} {{");
        let unguarded = guarded
            .text
            .replacen(&head, &format!("{head}\n    unguarded;"), 1);
        Measured {
            name: name.to_string(),
            unguarded: Source::new("unguarded.mech", unguarded),
            guarded,
            step,
            has_lanes: name != "platform_3rpr",
        }
    });
    let chains = CHAINS.iter().map(|&dyads| Measured {
        name: format!("dyads_{dyads}"),
        guarded: Source::new("dyad_chain.mech", dyad_chain::description(dyads)),
        unguarded: Source::new("dyad_chain.mech", dyad_chain::unguarded(dyads)),
        step: 0.01,
        has_lanes: true,
    });
    named.chain(chains).collect()
}
