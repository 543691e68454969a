//! *A mechanism in its drawing* → *the first Newton-Raphson step as it is written down by hand*: Φ_q Δq = -Φ, and the new q.

use std::io::{self, Write};

use linkwright_solver::first_step::first_step;
use linkwright_solver::number::{fixed, time};
use linkwright_solver::view::View;

/// More coordinates than these make a matrix that is wider than a page; its nonzero entries are then listed row by row.
const LARGEST_MATRIX: usize = 9;

/// The decimals of each number.
const DECIMALS: usize = 6;

/// Writes the step from the drawing at the time `t`.
///
/// # Errors
/// Those of `output`.
pub fn write<V: View>(view: &V, t: f64, output: &mut dyn Write) -> io::Result<()> {
    let system = view.system();
    let step = first_step(system, &view.drawn_pose(&view.nominal_parameters()).0, t);
    let names: Vec<&str> = system
        .coordinates
        .iter()
        .map(|it| it.name.as_str())
        .collect();
    writeln!(
        output,
        "\nfirst Newton-Raphson step from the drawing at t = {} s: Φ_q Δq = -Φ",
        time(t)
    )?;
    let number = |value: f64| fixed(value, DECIMALS);
    let order = names.len();
    let rows = step.jacobian.nrows();
    if order <= LARGEST_MATRIX {
        let mut cells = vec![names.iter().map(|it| it.to_string()).collect::<Vec<_>>()];
        cells[0].push("-Φ".to_string());
        for row in 0..rows {
            let entries = (0..order).map(|column| number(step.jacobian[(row, column)]));
            let mut entries: Vec<String> = entries.collect();
            entries.push(number(-step.residual[row]));
            cells.push(entries);
        }
        let width = |column: usize| cells.iter().map(|it| it[column].chars().count()).max();
        let widths: Vec<usize> = (0..=order)
            .map(|column| width(column).unwrap_or(0))
            .collect();
        for line in &cells {
            let (last, entries) = line.split_last().expect("at least the right-hand side");
            let entries = entries.iter().zip(&widths);
            let entries: Vec<String> = entries
                .map(|(cell, width)| format!("{cell:>width$}"))
                .collect();
            writeln!(
                output,
                "  {}  |  {last:>width$}",
                entries.join("  "),
                width = widths[order]
            )?;
        }
    } else {
        for row in 0..rows {
            let entries = (0..order).filter(|column| step.jacobian[(row, *column)] != 0.0);
            let terms: Vec<String> = entries
                .map(|column| {
                    format!(
                        "{} Δ{}",
                        number(step.jacobian[(row, column)]),
                        names[column]
                    )
                })
                .collect();
            writeln!(
                output,
                "  {} = {}",
                terms.join(" + "),
                number(-step.residual[row])
            )?;
        }
    }
    let Some(correction) = &step.correction else {
        return writeln!(
            output,
            "  Φ_q is singular in the drawing: there is no such step"
        );
    };
    let width = names.iter().map(|it| it.chars().count()).max().unwrap_or(0);
    writeln!(output)?;
    for (place, name) in names.iter().enumerate() {
        let (from, by) = (step.q[place], correction[place]);
        writeln!(
            output,
            "  {name:width$}  {:>12} + {:>12} = {:>12}",
            number(from),
            number(by),
            number(from + by)
        )?;
    }
    Ok(())
}
