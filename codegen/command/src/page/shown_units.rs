//! Units in which a page shows values, as its scripts read them.

use std::collections::BTreeMap;

use linkwright_codegen::stages::system::System;

use crate::report::units::{ANGLES, LENGTHS, OTHERS};

/// Names of units of a group of curves and what values in SI units are multiplied by, for values, rates and accelerations.
pub type ShownUnits = BTreeMap<&'static str, Vec<(String, f64)>>;

/// Groups of forces with their units of SI.
const FORCES: [(&str, &str); 4] = [
    ("forces", "N"),
    ("torques", "N*m"),
    ("powers", "W"),
    ("energies", "J"),
];

/// Returns the units of all groups of curves of a mechanism.
pub fn shown_units(system: &System) -> ShownUnits {
    let units = system.mechanism.units.of_messages();
    let shown = |si: &str| {
        let unit = units.of(si);
        let scale = unit.of_si(1.0);
        (unit.name, scale)
    };
    let motions = [
        ("angles", ANGLES),
        ("lengths", LENGTHS),
        ("points", LENGTHS),
        ("contacts", OTHERS),
    ];
    let motions = motions.map(|(group, si)| (group, si.map(shown).to_vec()));
    let forces = FORCES.map(|(group, si)| (group, vec![shown(si)]));
    motions.into_iter().chain(forces).collect()
}
