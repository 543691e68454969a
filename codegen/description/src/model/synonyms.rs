//! Words of other languages and textbooks → the words of this one, for help lines.

use crate::diagnostic::nearest;

/// What functions are called elsewhere.
pub(super) const FUNCTIONS: &[(&str, &str)] = &[
    ("log", "ln"),
    ("arcsin", "asin"),
    ("arccos", "acos"),
    ("arctan", "atan"),
    ("arctan2", "atan2"),
    ("root", "sqrt"),
    ("dist", "distance"),
    ("length", "distance"),
];

/// What units are called elsewhere.
pub(super) const UNITS: &[(&str, &str)] = &[
    ("in", "inch"),
    ("inches", "inch"),
    ("foot", "ft"),
    ("feet", "ft"),
    ("meter", "m"),
    ("meters", "m"),
    ("metre", "m"),
    ("metres", "m"),
    ("degree", "deg"),
    ("degrees", "deg"),
    ("radian", "rad"),
    ("radians", "rad"),
    ("turns", "turn"),
    ("rev", "turn"),
    ("sec", "s"),
    ("second", "s"),
    ("seconds", "s"),
    ("minute", "min"),
    ("minutes", "min"),
    ("hz", "Hz"),
];

/// What joints are called elsewhere.
pub(super) const JOINTS: &[(&str, &str)] = &[
    ("prismatic", "translational"),
    ("slider", "translational"),
    ("slide", "translational"),
    ("sliding", "translational"),
    ("hinge", "revolute"),
    ("pin", "revolute"),
    ("pivot", "revolute"),
    ("rotational", "revolute"),
    ("rigid", "weld"),
    ("gear", "external_gear"),
    ("gears", "external_gear"),
    ("spur_gear", "external_gear"),
    ("ring_gear", "internal_gear"),
    ("chain", "belt"),
    ("rack_and_pinion", "rack"),
    ("pinion", "rack"),
    ("link", "revolute_revolute"),
    ("rod", "revolute_revolute"),
    ("slot", "point_on_line"),
    ("distance", "relative_distance"),
];

/// The word that was meant: what `word` is called here, or else the nearest of the words that exist. Words that differ in case
/// alone from one are not taken for it where `by_case` says that case tells them apart: `Mm` is no `mm`.
pub(super) fn meant<'a>(
    word: &str,
    synonyms: &[(&str, &'a str)],
    words: impl IntoIterator<Item = &'a str>,
    by_case: bool,
) -> Option<&'a str> {
    let synonym = synonyms.iter().find(|(other, _)| *other == word);
    synonym
        .map(|(_, own)| *own)
        .or_else(|| nearest(word, words).filter(|own| !(by_case && own.eq_ignore_ascii_case(word))))
}

#[cfg(test)]
mod tests {
    use super::{UNITS, meant};

    #[test]
    fn synonyms_come_first_and_the_case_of_units_counts() {
        let units = || ["m", "mm", "deg", "inch"];
        assert_eq!(meant("in", UNITS, units(), true), Some("inch"));
        assert_eq!(meant("degrees", UNITS, units(), true), Some("deg"));
        assert_eq!(meant("dge", UNITS, units(), true), Some("deg"));
        assert_eq!(meant("Mm", UNITS, units(), true), None);
        assert_eq!(meant("Mm", &[], units(), false), Some("mm"));
    }
}
