//! Width of a text.
//!
//! The font of a reader is unknown. The widths are those of a common sans serif (Helvetica, and Arial and Liberation
//! Sans like it), in thousandths of the size, with a reserve for wider ones.

/// The widths of the characters from space to tilde.
const WIDTHS: [u16; 95] = [
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278, 556, 556, 556,
    556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667,
    611, 778, 722, 278, 500, 667, 556, 833, 722, 778, 667, 778, 722, 667, 611, 722, 667, 944, 667,
    667, 611, 278, 278, 278, 469, 556, 333, 556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500,
    222, 833, 556, 556, 556, 556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584,
];

/// Width of a character outside the table: most letters are narrower, and ideographs equally wide.
const OTHERS: u16 = 1000;

/// Factor for wider fonts.
const RESERVE: f64 = 1.14;

/// The width of a text in letters of this size.
pub fn width(text: &str, size: f64) -> f64 {
    let width = |letter: char| {
        let place = (letter as usize).checked_sub(' ' as usize);
        let known = place.and_then(|place| WIDTHS.get(place)).copied();
        f64::from(known.unwrap_or(OTHERS))
    };
    RESERVE * size / 1000.0 * text.chars().map(width).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::width;

    #[test]
    fn widths_are_those_of_the_letters() {
        let thousandth = |text| (width(text, 1000.0) / 1.14).round();
        assert_eq!(thousandth("~"), 584.0);
        assert_eq!(thousandth("mill"), 833.0 + 3.0 * 222.0);
        assert_eq!(thousandth("W0 "), 944.0 + 556.0 + 278.0);
        assert_eq!(thousandth("é"), 1000.0);
    }
}
