//! Lines about the values that the solved formulation computes and leaves out, for the generated header and the
//! command.

use crate::program::{
    BEYOND_STEPS, EVALUATIONS, Iterations, Operations, Report, STEPS, Work, work,
};

/// Writes one fact a line.
pub fn lines(report: &Report) -> Vec<String> {
    let mut lines = vec![format!(
        "Blocks in solve order: {}.",
        report.kept.join(", ")
    )];
    if !report.left_out.is_empty() {
        lines.push(format!(
            "Omitted, because no output needs them: {}.",
            listed(&report.left_out)
        ));
    }
    if !report.angles_left_out.is_empty() {
        let angles = listed(&report.angles_left_out);
        lines.push(format!(
            "Omitted angles, whose sines and cosines suffice: {angles}."
        ));
    }
    for (level, operations) in ["Position", "Velocity", "Acceleration"]
        .iter()
        .zip(report.operations)
    {
        lines.push(format!("{level}: {operations}."));
    }
    lines.extend(report.iterations.iter().flat_map(iterations));
    if let Some(operations) = report.transmission {
        lines.push(format!("Transmission: {operations}."));
    }
    if let Some(operations) = report.sensitivity {
        lines.push(format!("Sensitivity: {operations}."));
    }
    if let Some(operations) = report.forces {
        lines.push(format!("Forces: {operations}."));
    }
    lines.extend(of_work(&report.work));
    if report.operations != report.all_operations {
        let total = |levels: [Operations; 3]| levels.iter().map(Operations::total).sum::<usize>();
        lines.push(format!(
            "In total {} operations of {} without omissions.",
            total(report.operations),
            total(report.all_operations)
        ));
    }
    lines
}

/// Operations of Newton-Raphson in one block, and its largest number of iterations.
fn iterations(it: &Iterations) -> Vec<String> {
    let Iterations {
        block,
        unknowns,
        torn,
        residuals,
        jacobian,
    } = it;
    let [more_residuals, more_jacobians] = BEYOND_STEPS.map(|more| STEPS + more);
    let mut lines = Vec::new();
    let opening = match torn {
        None => format!("Newton-Raphson of {block}, in addition"),
        Some(torn) => {
            let tears = match torn.tears {
                1 => "1 tear".to_string(),
                count => format!("{count} tears"),
            };
            lines.push(format!(
                "Newton-Raphson of {block}, in addition: {tears} of {unknowns} unknowns, at most {EVALUATIONS} times {}; then once {}.",
                torn.evaluation, torn.completion
            ));
            "If that fails".to_string()
        }
    };
    lines.push(format!(
        "{opening}: {unknowns} unknowns at once, at most {more_residuals} times {residuals} for residuals, and at most {more_jacobians} \
         times {jacobian} for the Jacobian and its elimination."
    ));
    lines
}

/// The largest work of a call of `advance`, and of one of `recover`.
fn of_work(work: &Work) -> Vec<String> {
    let attempt = grouped(work.attempt.total());
    let substeps = work::SUBSTEPS;
    let call = |name: &str, operations: &str| match (work.is_iterated, work.has_friction) {
        (false, false) => format!("{name}: {operations} operations, the same for every frame."),
        (true, _) => format!("{name}: at most {operations} operations, with {STEPS} iterations."),
        (false, true) => format!(
            "{name}: at most {operations} operations, with {} steps of friction.",
            work::FRICTION_STEPS
        ),
    };
    let mut lines = vec![call("Advance", &attempt)];
    if let Some(window) = work.window {
        let look = grouped(window.look.total());
        let looks = work::LOOKS;
        let last = match window.last.total() {
            0 => String::new(),
            last => format!(", and {} if none of these verifies the path", grouped(last)),
        };
        lines.push(format!(
            "First frame of a window of the path: at most {looks} times {look} operations more{last}."
        ));
    }
    let [fixed, each] = work.whole();
    lines.push(format!(
        "Frame with n substeps: at most {} + {} n operations in all{}.",
        grouped(fixed),
        grouped(each),
        match work.window {
            Some(_) => ", including dead points",
            None => "",
        }
    ));
    lines.push(format!(
        "With {substeps} substeps, the default: {}.",
        grouped(fixed + substeps * each)
    ));
    let recover = grouped(work.recover.total());
    lines.push(call("Recover", &recover));
    lines
}

/// `1,234,567`
fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (place, digit) in digits.chars().enumerate() {
        if place > 0 && (digits.len() - place).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// The names, at most twenty of them.
fn listed(names: &[String]) -> String {
    const MAX_LISTED_NAMES: usize = 20;
    let list = names[..names.len().min(MAX_LISTED_NAMES)].join(", ");
    match names.len().saturating_sub(MAX_LISTED_NAMES) {
        0 => list,
        more => format!("{list} and {more} more"),
    }
}
