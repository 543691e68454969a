//! Writes tables of measured starts.

use super::measure::{Measured, Outcomes};

/// Table of one function that assembles.
pub fn table(rows: &[(&str, &Outcomes)]) -> String {
    let mut text =
        "| mechanism | drawing's pose | another pose | other branch | typed failures | wrong |\n\
        |---|---|---|---|---|---|\n"
            .to_string();
    for (name, outcomes) in rows {
        let failed: Vec<String> = outcomes
            .failed
            .iter()
            .map(|(kind, count)| format!("{count} {kind}"))
            .collect();
        let failed = if failed.is_empty() {
            "0".to_string()
        } else {
            failed.join(", ")
        };
        text += &format!(
            "| {name} | {:.2} % | {} | {} | {failed} | {} |\n",
            outcomes.success(),
            outcomes.another,
            outcomes.other_branch,
            outcomes.wrong
        );
    }
    text
}

/// Cost of the textbook formulation: median and maximum of the evaluations.
pub fn work(measured: &[Measured]) -> String {
    let mut text =
        "| mechanism | coordinates | Jacobians: median | maximum | residuals: median | maximum |\n\
        |---|---|---|---|---|---|\n"
            .to_string();
    for it in measured {
        let [jacobians, residuals] = [&it.afar.jacobians, &it.afar.residuals].map(|counts| {
            let mut counts = counts.clone();
            counts.sort_unstable();
            let median = counts.get(counts.len() / 2).copied().unwrap_or(0);
            format!("{median} | {}", counts.last().copied().unwrap_or(0))
        });
        text += &format!(
            "| {} | {} | {jacobians} | {residuals} |\n",
            it.name, it.coordinates
        );
    }
    text
}
