//! Finds the units of values on a page for its scripts.

use std::collections::BTreeMap;

use linkwright_codegen::stages::system::System;

use crate::units::{ANGLES, LENGTHS, OTHERS};

/// Units of groups of curves: name and factor from SI units, of values, rates and accelerations.
pub type ShownUnits = BTreeMap<&'static str, Vec<(String, f64)>>;

/// Groups of forces with their SI units.
const FORCES: [(&str, &str); 4] = [
    ("forces", "N"),
    ("torques", "N*m"),
    ("powers", "W"),
    ("energies", "J"),
];

/// Returns the units of all groups of curves of a mechanism.
pub fn shown_units(system: &System) -> ShownUnits {
    let units = system.mechanism.units.of_messages();
    let converted = |si: &str| {
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
    let motions = motions.map(|(group, si)| (group, si.map(converted).to_vec()));
    let forces = FORCES.map(|(group, si)| (group, vec![converted(si)]));
    motions.into_iter().chain(forces).collect()
}
