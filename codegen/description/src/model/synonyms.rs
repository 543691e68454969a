//! Translates words of other languages and textbooks, for help lines.

use crate::diagnostic::nearest;
use crate::units::{UNITS, of_column};

/// Names of functions in other languages.
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

/// Names of joints in other programs and textbooks.
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

/// Returns the word that was probably meant: the synonym of `word`, or else the nearest existing word; `None` if there is
/// neither.
pub(super) fn meant<'a>(
    word: &str,
    synonyms: &[(&str, &'a str)],
    words: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    let synonym = synonyms.iter().find(|(other, _)| *other == word);
    synonym
        .map(|(_, own)| *own)
        .or_else(|| nearest(word, words))
}

/// Returns the unit that was probably meant: the unit with this name in columns, or else the nearest; `None` if there is
/// neither. Case distinguishes units: `Mm` differs from `mm`.
pub(super) fn meant_unit(word: &str) -> Option<&'static str> {
    let synonym = of_column(word).and_then(|it| it.names.first().copied());
    synonym.or_else(|| {
        nearest(word, UNITS.iter().copied()).filter(|own| !own.eq_ignore_ascii_case(word))
    })
}

#[cfg(test)]
mod tests {
    use super::{JOINTS, meant, meant_unit};

    #[test]
    fn synonyms_come_first_and_the_case_of_units_counts() {
        assert_eq!(meant_unit("in"), Some("inch"));
        assert_eq!(meant_unit("degrees"), Some("deg"));
        assert_eq!(meant_unit("dge"), Some("deg"));
        assert_eq!(meant_unit("Mm"), None);
        assert_eq!(meant("Slide", &[], ["slide"]), Some("slide"));
        assert_eq!(meant("hinge", JOINTS, ["hang"]), Some("revolute"));
    }
}
