//! What the solved view computes and leaves out → lines of text, for the generated header and for people.

use crate::program::{Operations, Report};

/// One fact a line.
pub fn lines(report: &Report) -> Vec<String> {
    let mut lines = vec![format!(
        "Blocks in solve order: {}.",
        report.kept.join(", ")
    )];
    if !report.left_out.is_empty() {
        lines.push(format!(
            "Left out, since no output needs it: {}.",
            listed(&report.left_out)
        ));
    }
    if !report.angles_left_out.is_empty() {
        let angles = listed(&report.angles_left_out);
        lines.push(format!(
            "Angles left out, since their sines and cosines suffice: {angles}."
        ));
    }
    for (level, operations) in ["Position", "Velocity", "Acceleration"]
        .iter()
        .zip(report.operations)
    {
        lines.push(format!("{level}: {operations}."));
    }
    if let Some(operations) = report.transmission {
        lines.push(format!("Transmission: {operations}."));
    }
    if let Some(operations) = report.sensitivity {
        lines.push(format!("Sensitivity: {operations}."));
    }
    if let Some(operations) = report.forces {
        lines.push(format!("Forces: {operations}."));
    }
    if report.operations != report.all_operations {
        let total = |levels: [Operations; 3]| levels.iter().map(Operations::total).sum::<usize>();
        lines.push(format!(
            "All in all {} operations of {} that everything would take.",
            total(report.operations),
            total(report.all_operations)
        ));
    }
    lines
}

/// The names, at most twenty of them.
fn listed(names: &[String]) -> String {
    const MOST: usize = 20;
    let shown = names[..names.len().min(MOST)].join(", ");
    match names.len().saturating_sub(MOST) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}
