//! Reports the interpretation of a table of measured values.

use std::io::{self, Write};

use linkwright_solver::number::{counted, fixed, time};

use linkwright_solver::data::{Data, How, Measured, Origin};

/// Writes the interpretation of a table and of its columns, which begins a report.
///
/// # Errors
/// Errors of `output`.
pub fn write_data(title: &str, data: &Data, output: &mut dyn Write) -> io::Result<()> {
    let rows = counted(data.rows(), "row");
    let extent = match (data.times.first(), data.times.last()) {
        (Some(first), Some(last)) => format!("from t = {} s to {} s", time(*first), time(*last)),
        _ => "in this order".to_string(),
    };
    writeln!(output, "{title} and {}: {rows} {extent}", data.name)?;
    writeln!(output, "read as {}", data.columns.reading())?;
    let Some((column, scale)) = &data.time else {
        return Ok(());
    };
    let assumed = match scale.origin {
        Origin::Assumed => ", as no unit is given",
        _ => "",
    };
    writeln!(
        output,
        "times are `{}` in {}{assumed}",
        data.columns.columns[*column].name, scale.text
    )?;
    Ok(())
}

/// Returns the quantity of a column with the source of this choice, and its unit.
pub fn taken_for(measured: &Measured) -> [String; 2] {
    let quantity = &measured.quantity.name;
    let taken = match &measured.how {
        How::Named | How::Chosen => quantity.clone(),
        How::Guessed(_) => format!("{quantity} (guessed)"),
    };
    let unit = match measured.scale.origin {
        Origin::Assumed if !measured.scale.text.is_empty() => {
            format!("{} (assumed)", measured.scale.text)
        }
        _ => measured.scale.text.clone(),
    };
    [taken, unit]
}

/// Writes notes on guesses and on columns that are left out.
///
/// # Errors
/// Errors of `output`.
pub fn write_notes(data: &Data, output: &mut dyn Write) -> io::Result<()> {
    for measured in &data.measured {
        if let How::Guessed(doubt) = &measured.how
            && !doubt.is_empty()
        {
            writeln!(output, "guessed for `{}`: {doubt}", measured.name)?;
        }
    }
    for measured in data.measured.iter().filter(|it| it.scale.counts_turns) {
        let unit = &measured.scale.text;
        writeln!(
            output,
            "`{}` counts turns: 1 {unit} is taken for {} rad/s",
            measured.name,
            fixed(measured.scale.unit.si(1.0), 6)
        )?;
    }
    for input in &data.inputs {
        let (name, unit) = (&input.name, &input.scale.text);
        writeln!(
            output,
            "`{name}` in {unit} drives the input of the mechanism"
        )?;
    }
    for (name, why) in &data.left_out {
        writeln!(output, "left out: `{name}`, {why}")?;
    }
    Ok(())
}
