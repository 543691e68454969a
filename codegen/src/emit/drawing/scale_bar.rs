//! *Pixels per metre and the room that there is* → *a round length and how it is written*.

use super::plane::NEGLIGIBLE;

/// Longer bars are written with a power of ten, in m.
const LONGEST: f64 = 1e6;

/// A length that is shown.
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

/// The largest length of one, two or five times a power of ten that is not longer than `room` pixels.
pub(super) fn scale_bar(scale: f64, room: f64) -> Option<ScaleBar> {
    let most = room / scale;
    if !(most.is_finite() && most > 0.0) {
        return None;
    }
    let power = most.log10().floor() as i32;
    let digits = [5.0, 2.0, 1.0, 0.5];
    let round = |digit: f64| digit * 10.0_f64.powi(power);
    let metres = digits
        .into_iter()
        .map(round)
        .find(|it| *it <= most * (1.0 + NEGLIGIBLE))?;
    let unit = UNITS
        .iter()
        .find(|(_, size)| metres >= size * (1.0 - NEGLIGIBLE));
    let text = match unit {
        // What is so long or so short is written with its power of ten.
        Some((name, size)) if metres < LONGEST => format!("{} {name}", (metres / size).round()),
        _ => format!("{metres:e} m"),
    };
    Some(ScaleBar {
        length: metres * scale,
        text,
    })
}

#[cfg(test)]
mod tests {
    use super::scale_bar;

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
            let bar = scale_bar(scale, 140.0).expect("a length");
            assert_eq!(bar.text, text);
            assert!((bar.length - length).abs() < 1e-9, "{bar:?}");
        }
    }
}
