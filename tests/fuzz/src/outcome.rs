//! Outcomes of inputs in words, by which a corpus tells inputs apart.

use std::collections::BTreeSet;

use linkwright_codegen::diagnostic::Diagnostics;

/// A stage with the codes of its findings, each once, in order.
pub fn with_codes(stage: &str, findings: &Diagnostics) -> String {
    let codes: BTreeSet<String> = findings.iter().map(|it| it.code.to_string()).collect();
    let codes: Vec<String> = codes.into_iter().collect();
    format!("{stage} {}", codes.join(" "))
        .trim_end()
        .to_string()
}
