//! Chooses a round length for the scale bar of a picture, and its text.

use super::plane::RELATIVE_ROUNDING;
use crate::units::OutputUnit;

/// Length from which on a bar has a power of ten, in m.
const POWER_OF_TEN_LIMIT: f64 = 1e6;

/// Length of a scale bar.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ScaleBar {
    /// In pixels.
    pub length: f64,
    pub text: String,
}

/// Units with their size in m; the first in which the length is at least one is taken.
const UNITS: [(&str, f64); 6] = [
    ("km", 1000.0),
    ("m", 1.0),
    ("mm", 0.001),
    ("µm", 0.000_001),
    ("nm", 0.000_000_001),
    ("pm", 0.000_000_000_001),
];

/// Returns the largest length of one, two or five times a power of ten that is not longer than `room` pixels, where a meter has `scale`.
/// It is round in `unit`, if that is chosen, otherwise in the first unit in which it is at least one.
pub(super) fn scale_bar(scale: f64, room: f64, unit: Option<&OutputUnit>) -> Option<ScaleBar> {
    let per_meter = unit.map_or(1.0, |it| it.of_si(1.0));
    let scale = scale / per_meter;
    let most = room / scale;
    if !(most.is_finite() && most > 0.0) {
        return None;
    }
    let power = most.log10().floor() as i32;
    let digits = [5.0, 2.0, 1.0, 0.5];
    let round = |digit: f64| digit * 10.0_f64.powi(power);
    let length = digits
        .into_iter()
        .map(round)
        .find(|it| *it <= most * (1.0 + RELATIVE_ROUNDING))?;
    Some(ScaleBar {
        length: length * scale,
        text: match unit {
            Some(unit) => format!("{} {}", rounded(length), unit.name),
            None => in_usual_unit(length),
        },
    })
}

/// Returns the length of so many meters as text.
fn in_usual_unit(meters: f64) -> String {
    let unit = UNITS
        .iter()
        .find(|(_, size)| meters >= size * (1.0 - RELATIVE_ROUNDING));
    match unit {
        // An extreme length is written with its power of ten.
        Some((name, size)) if meters < POWER_OF_TEN_LIMIT => {
            format!("{} {name}", (meters / size).round())
        }
        _ => format!("{meters:e} m"),
    }
}

/// Returns a number without the rounding of a product.
fn rounded(length: f64) -> f64 {
    format!("{length:.6e}").parse().unwrap_or(length)
}

#[cfg(test)]
mod tests {
    use super::scale_bar;
    use crate::units::OutputUnits;

    #[test]
    fn lengths_are_round() {
        for (scale, text, length) in [
            (100.0, "1 m", 100.0),
            (250.0, "500 mm", 125.0),
            (2000.0, "50 mm", 100.0),
            (45000.0, "2 mm", 90.0),
            (1.0, "100 m", 100.0),
            (0.06, "2 km", 120.0),
            (1e9, "100 nm", 100.0),
        ] {
            let bar = scale_bar(scale, 140.0, None).expect("a length");
            assert_eq!(bar.text, text);
            assert!((bar.length - length).abs() < 1e-9, "{bar:?}");
        }
    }
    #[test]
    fn lengths_are_round_in_the_chosen_unit() {
        for (unit, scale, text, length) in [
            ("mm", 250.0, "500 mm", 125.0),
            ("inch", 2000.0, "2 inch", 101.6),
            ("m", 2000.0, "0.05 m", 100.0),
        ] {
            let units = OutputUnits::listed(unit).expect("a unit");
            let bar = scale_bar(scale, 140.0, units.of_lengths()).expect("a length");
            assert_eq!(bar.text, text);
            assert!((bar.length - length).abs() < 1e-9, "{bar:?}");
        }
    }
}
