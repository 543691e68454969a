//! Reads arguments that give a size to each measured column, such as a tolerance, in SI units.

use linkwright_codegen::stages::columns::Unit;

use super::Data;

/// Returns the size of each measured column; `None` if the argument, which is called `option` in messages, does not give one.
///
/// # Errors
/// A size cannot be read, or belongs to no column.
pub fn sizes(option: &str, asked: &[String], data: &Data) -> Result<Vec<Option<f64>>, String> {
    let mut sizes = vec![None; data.measured.len()];
    let mut is_individual = vec![false; data.measured.len()];
    for text in asked {
        let (name, value) = match text.rsplit_once('=') {
            Some((name, value)) => (Some(name.trim()), value.trim()),
            None => (None, text.trim()),
        };
        // The longest prefix that is a number is taken, so that `1e-3mm` and `2 deg` are read.
        let (number, unit) = match number_and_unit(value) {
            Some((number, "")) => (number, None),
            Some((number, unit)) => match Unit::parse(unit) {
                Some(unit) => (number, Some(unit)),
                None => {
                    return Err(format!(
                        "error: `{unit}` in `{option} {text}` is not a unit"
                    ));
                }
            },
            None => {
                return Err(format!(
                    "error: `{option} {text}` is not a number\n  = help: write `1e-6`, `0.5mm` or `COLUMN=0.5mm`"
                ));
            }
        };
        if !(number.is_finite() && number >= 0.0) {
            return Err(format!("error: `{option} {text}` is not a size"));
        }
        let mut is_used = false;
        for (place, measured) in data.measured.iter().enumerate() {
            let is_meant = match name {
                Some(name) => name == measured.name,
                None => {
                    let powers = measured.quantity.powers;
                    let is_same = |it: Unit| it.powers == powers || it.counts_turns_of(powers);
                    !is_individual[place] && unit.is_none_or(is_same)
                }
            };
            if !is_meant {
                continue;
            }
            let unit = match unit.map(|it| it.measuring(measured.quantity.powers)) {
                Some(None) => {
                    return Err(format!(
                        "error: the unit in `{option} {text}` does not measure `{}`",
                        measured.quantity.name
                    ));
                }
                Some(unit) => unit,
                None => None,
            };
            is_used = true;
            is_individual[place] |= name.is_some();
            sizes[place] = Some(unit.map_or(number, |it| it.si(number)));
        }
        if !is_used {
            let names: Vec<&str> = data.measured.iter().map(|it| it.name.as_str()).collect();
            return Err(format!(
                "error: `{option} {text}` matches none of the compared columns\n  = help: they are: {}",
                names.join(", ")
            ));
        }
    }
    Ok(sizes)
}

/// Splits a text into the longest number at its beginning and the unit behind it, which may be empty.
pub fn number_and_unit(text: &str) -> Option<(f64, &str)> {
    let ends = (1..=text.len()).rev();
    ends.filter(|&it| text.is_char_boundary(it))
        .find_map(|it| Some((text[..it].trim().parse().ok()?, text[it..].trim())))
}
