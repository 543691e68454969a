//! Splines → how their places are found, and what is said of them.

use crate::expr::SplineId;
use crate::pool::Pool;
use crate::system::System;

/// By how much of their distance starts may be off where they are called equally spaced.
const EVEN: f64 = 1e-6;

/// What a table is.
pub(in crate::emit) fn docs_of(id: SplineId, pool: &Pool, system: &System) -> Vec<String> {
    let declared = system.mechanism.tables.iter();
    let own = declared
        .filter(|table| table.spline == id)
        .flat_map(|table| table.docs.clone());
    let lines: Vec<String> = own.collect();
    match lines.is_empty() {
        true => vec![format!("The table `{}`.", pool.graph.spline_of(id).name)],
        false => lines,
    }
}

/// The distance between starts that are equally spaced, but for rounding.
pub(in crate::emit) fn spacing(starts: &[f64]) -> Option<f64> {
    let (first, last) = (*starts.first()?, *starts.last()?);
    let spacing = (last - first) / (starts.len() - 1) as f64;
    let even = starts.iter().enumerate().all(|(place, start)| {
        let expected = first + spacing * place as f64;
        (start - expected).abs() <= EVEN * spacing
    });
    // Two starts are found without it.
    (even && starts.len() > 2).then_some(spacing)
}
