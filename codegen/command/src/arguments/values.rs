//! Reads the text of an argument as a number with a meaning.

use linkwright_codegen::stages::columns::Unit;

/// Units of time. Longer names precede the names that they end in.
const UNITS: [&str; 3] = ["min", "ms", "s"];

/// Smallest tolerance of an integration; below it, steps follow rounding only.
const SMALLEST_TOLERANCE: f64 = 1e-15;

/// Reads a time in s, written in s or with a unit: `0.5`, `500ms`.
pub fn time(text: &str) -> Result<f64, String> {
    let with_unit = UNITS.iter().find_map(|unit| {
        let number = text.strip_suffix(unit)?.trim_end().parse::<f64>();
        let unit = Unit::parse(unit)?;
        Some(number.map(|value| unit.si(value)))
    });
    match with_unit.unwrap_or_else(|| text.parse()) {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err("not a finite number".to_string()),
        Err(_) => Err("not a time: write it in s, or with a unit as in `500ms`".to_string()),
    }
}

/// Reads a positive time in s.
pub fn step(text: &str) -> Result<f64, String> {
    match time(text)? {
        value if value > 0.0 => Ok(value),
        _ => Err("a step must be positive".to_string()),
    }
}

/// Reads the largest error of an integration step.
pub fn tolerance(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if (SMALLEST_TOLERANCE..1.0).contains(&value) => Ok(value),
        Ok(_) => Err(format!(
            "a tolerance is between {SMALLEST_TOLERANCE:e} and 1"
        )),
        Err(_) => Err("not a number".to_string()),
    }
}

/// Reads a size in pixels, `800x600`, from a thumbnail to a print.
pub fn size(text: &str) -> Result<[u32; 2], String> {
    let sides = text.split_once('x').map(|(width, height)| [width, height]);
    let sides = sides.and_then(|it| Some([it[0].parse().ok()?, it[1].parse().ok()?]));
    match sides {
        Some(size) if size.iter().all(|it| (100..=10_000).contains(it)) => Ok(size),
        Some(_) => Err("width and height are between 100 and 10000".to_string()),
        None => Err("write width and height as in `800x600`".to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_units() {
        for (text, expected) in [
            ("0.5", 0.5),
            ("500ms", 0.5),
            ("-3 ms", -0.003),
            ("5s", 5.0),
            ("1e-3s", 1e-3),
            ("2min", 120.0),
        ] {
            assert_eq!(time(text), Ok(expected), "{text}");
        }
        for text in ["", "s", "5 m", "5h", "1e400", "NaN", "nans", "inf", "0x1s"] {
            assert!(time(text).is_err(), "{text}");
        }
        assert!(step("0ms").is_err() && step("-1s").is_err());
    }
}
