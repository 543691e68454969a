//! Finds the spacing and the documentation of spline tables.

use crate::expr::SplineId;
use crate::pool::Pool;
use crate::system::System;

/// Relative deviation up to which starts count as equally spaced.
const EVEN: f64 = 1e-6;

/// Documentation of a table.
pub(in crate::emit) fn docs_of(id: SplineId, pool: &Pool, system: &System) -> Vec<String> {
    let declared = system.mechanism.tables.iter();
    let docs = declared
        .filter(|table| table.spline == id)
        .flat_map(|table| table.docs.clone());
    let lines: Vec<String> = docs.collect();
    match lines.is_empty() {
        true => vec![format!("Table `{}`.", pool.graph.spline_of(id).name)],
        false => lines,
    }
}

/// Returns the distance between starts; `None` if they are not equally spaced except for rounding.
pub(in crate::emit) fn spacing(starts: &[f64]) -> Option<f64> {
    let (first, last) = (*starts.first()?, *starts.last()?);
    let spacing = (last - first) / (starts.len() - 1) as f64;
    let even = starts.iter().enumerate().all(|(place, start)| {
        let expected = first + spacing * place as f64;
        (start - expected).abs() <= EVEN * spacing
    });
    // Two starts need no index computation.
    (even && starts.len() > 2).then_some(spacing)
}
