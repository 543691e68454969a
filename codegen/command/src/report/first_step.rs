//! Writes the first Newton-Raphson step from the design configuration, as for a calculation by hand: Φ_q Δq = -Φ, and the new q.

use std::io::{self, Write};

use linkwright_solver::View;
use linkwright_solver::first_step::first_step;
use linkwright_solver::number::{fixed, time};

use super::motion_table::{Column, table};

/// Largest number of columns of a matrix that is printed whole; nonzero entries of wider ones are listed row by row.
const LARGEST_MATRIX: usize = 9;

/// Decimals of each number.
const DECIMALS: usize = 6;

/// Writes the step from the design configuration at the time `t` (s).
///
/// # Errors
/// Errors of `output`.
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
        let column = |values: &mut dyn Iterator<Item = f64>| values.map(number).collect();
        let matrix = names.iter().zip(step.jacobian.column_iter());
        let matrix = matrix
            .map(|(name, entries)| Column::of_texts(*name, column(&mut entries.iter().copied())));
        let mut columns: Vec<Column> = matrix.collect();
        columns.push(Column::of_texts("|", vec!["|".to_string(); rows]));
        let right = column(&mut step.residual.iter().map(|it| -it));
        columns.push(Column::of_texts("-Φ", right));
        write!(output, "{}", table(&columns))?;
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
