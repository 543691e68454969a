//! Finds the column of times and the quantities of the other columns.

use linkwright_codegen::diagnostic::nearest;
use linkwright_codegen::stages::columns::Columns;
use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::system::System;

use super::Reading;
use crate::observable::{Named, all, guess};

/// Names of columns of times, in lower case.
const TIMES: [&str; 8] = [
    "t", "time", "times", "zeit", "temps", "tiempo", "tempo", "czas",
];

/// Largest number of names in a message.
const MAX_LISTED: usize = 40;

/// Source of a column's quantity.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum How {
    /// The name of the column.
    Named,
    /// An option.
    Chosen,
    /// A guess, with the alternatives.
    Guessed(String),
}

/// Quantities of the columns.
pub struct Mapped {
    /// Column of times; `None` if the rows have an order only.
    pub time: Option<usize>,
    pub measured: Vec<(usize, Named, How)>,
    /// Columns that drive inputs, with the index of the input.
    pub inputs: Vec<(usize, usize)>,
    pub left_out: Vec<(String, String)>,
}

/// Returns the only column of a name.
pub fn column(file: &str, columns: &Columns, name: &str) -> Result<usize, String> {
    let mut matches = columns.named(name);
    match (matches.next(), matches.next()) {
        (Some(column), None) => Ok(column),
        (Some(first), Some(second)) => Err(format!(
            "error: columns {} and {} of `{file}` are both called `{name}`\n  = help: give them names of their own",
            first + 1,
            second + 1
        )),
        (None, _) => {
            let names = || columns.columns.iter().map(|it| it.name.as_str());
            let meant = nearest(name, names())
                .map_or(String::new(), |it| format!("; did you mean `{it}`?"));
            let names: Vec<&str> = names().collect();
            Err(format!(
                "error: no column of `{file}` is called `{name}`{meant}\n  = help: its columns are: {}",
                listed(&names)
            ))
        }
    }
}

fn listed(names: &[&str]) -> String {
    let text = names[..names.len().min(MAX_LISTED)].join(", ");
    match names.len() > MAX_LISTED {
        true => format!("{text}, … ({} in all)", names.len()),
        false => text,
    }
}

fn time(reading: &Reading, file: &str, columns: &Columns) -> Result<Option<usize>, String> {
    if let Some(name) = &reading.time {
        return column(file, columns, name).map(Some);
    }
    let is_time =
        |place: &usize| TIMES.contains(&columns.columns[*place].name.to_lowercase().as_str());
    let candidates: Vec<usize> = (0..columns.columns.len()).filter(is_time).collect();
    let names = |places: &mut dyn Iterator<Item = usize>| {
        let names: Vec<&str> = places.map(|it| columns.columns[it].name.as_str()).collect();
        listed(&names)
    };
    match candidates.as_slice() {
        [column] => Ok(Some(*column)),
        [] if !reading.needs_times => Ok(None),
        [] => Err(format!(
            "error: no column of `{file}` is called `t` or `time`\n  = help: name the column of times with `{}`: {}",
            reading.names.time,
            names(&mut (0..columns.columns.len()))
        )),
        several => Err(format!(
            "error: several columns of `{file}` could hold times\n  = help: name one of them with `{}`: {}",
            reading.names.time,
            names(&mut several.iter().copied())
        )),
    }
}

/// Finds the quantities of the columns.
pub fn mapped(
    reading: &Reading,
    file: &str,
    columns: &Columns,
    pool: &Pool,
    system: &System,
) -> Result<Mapped, String> {
    let time = time(reading, file, columns)?;
    let quantities = all(pool, system);
    let inputs = &system.mechanism.inputs;
    let input_named = |name: &str| inputs.iter().position(|it| it.name == name);
    let mut driving: Vec<(usize, usize)> = Vec::new();
    let mut chosen: Vec<(usize, usize)> = Vec::new();
    for wish in &reading.column {
        let Some((name, quantity)) = wish.rsplit_once('=') else {
            return Err(format!(
                "error: `{}` takes `COLUMN=QUANTITY`, such as `Sensor 3=phi2`, not `{wish}`",
                reading.names.column
            ));
        };
        let column_index = column(file, columns, name.trim())?;
        let quantity = quantity.trim();
        let is_quantity = quantities.iter().any(|it| it.name == quantity);
        if let Some(input) = input_named(quantity).filter(|_| !is_quantity) {
            driving.push((column_index, input));
            continue;
        }
        let Some(place) = quantities.iter().position(|it| it.name == quantity) else {
            return Err(unknown(system, &quantities, quantity));
        };
        if chosen.iter().any(|it| it.0 == column_index) {
            return Err(format!(
                "error: `{}` names `{}` twice",
                reading.names.column,
                name.trim()
            ));
        }
        chosen.push((column_index, place));
    }
    let mut skipped = Vec::new();
    for name in &reading.skip {
        skipped.push(column(file, columns, name)?);
    }
    let mut mapped = Mapped {
        time,
        measured: Vec::new(),
        inputs: Vec::new(),
        left_out: Vec::new(),
    };
    for (place, own) in columns.columns.iter().enumerate() {
        let option = chosen.iter().find(|it| it.0 == place).map(|it| it.1);
        if Some(place) == time && option.is_none() {
            continue;
        }
        let name = own.name.as_str();
        let mut leave = |why: &str| mapped.left_out.push((name.to_string(), why.to_string()));
        if skipped.contains(&place) {
            leave(&format!("`{}`", reading.names.skip));
            continue;
        }
        if own.is_text {
            leave("its cells are words");
            continue;
        }
        let named = || quantities.iter().position(|it| it.name == name);
        let option_input = driving.iter().find(|it| it.0 == place).map(|it| it.1);
        let by_name = || input_named(name).filter(|_| option.is_none() && named().is_none());
        if let Some(input) = option_input.or_else(by_name) {
            if let Some(other) = mapped.inputs.iter().find(|it| it.1 == input) {
                return Err(format!(
                    "error: columns {} and {} of `{file}` both drive the input `{}`\n  = help: leave one out with `{}`",
                    other.0 + 1,
                    place + 1,
                    inputs[input].name,
                    reading.names.skip
                ));
            }
            mapped.inputs.push((place, input));
            continue;
        }
        let choice = match option {
            Some(quantity) => Some((quantity, How::Chosen)),
            None => match named() {
                Some(quantity) => Some((quantity, How::Named)),
                None => {
                    guess(system, &quantities, name).map(|it| (it.place, How::Guessed(it.doubt)))
                }
            },
        };
        match choice {
            None => leave("no quantity of the mechanism has this name"),
            Some(_) if own.values.iter().all(Option::is_none) => leave("it has no numbers"),
            Some((quantity, how)) => {
                mapped
                    .measured
                    .push((place, quantities[quantity].clone(), how))
            }
        }
    }
    if let (None, Some((column, input))) = (time, mapped.inputs.first()) {
        return Err(format!(
            "error: column {} of `{file}` drives the input `{}`, and its rows have no times\n  = help: name the column of times with `{}`, or leave the column out with `{}`",
            column + 1,
            inputs[*input].name,
            reading.names.time,
            reading.names.skip
        ));
    }
    if mapped.measured.is_empty() {
        let names: Vec<&str> = quantities.iter().map(|it| it.name.as_str()).collect();
        let left: Vec<&str> = mapped.left_out.iter().map(|it| it.0.as_str()).collect();
        return Err(format!(
            "error: no column of `{file}` matches a quantity of `{}`: {}\n  = help: say what a column measures with `{}`; the quantities are: {}",
            system.mechanism.title(),
            listed(&left),
            reading.names.quantity,
            listed(&names)
        ));
    }
    Ok(mapped)
}

fn unknown(system: &System, quantities: &[Named], name: &str) -> String {
    let names = || quantities.iter().map(|it| it.name.as_str());
    let meant =
        nearest(name, names()).map_or(String::new(), |it| format!("; did you mean `{it}`?"));
    let names: Vec<&str> = names().collect();
    format!(
        "error: nothing of `{}` is called `{name}`{meant}\n  = help: the quantities are: {}",
        system.mechanism.title(),
        listed(&names)
    )
}
