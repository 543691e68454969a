//! Finds the units of values on a page for its scripts.

use std::collections::BTreeMap;

use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::system::System;

use crate::units::{ANGLES, LENGTHS, OTHERS};

/// Units of groups of curves: name and factor from SI units, of values, rates and accelerations.
pub type ShownUnits = BTreeMap<String, Vec<(String, f64)>>;

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
    let motions = motions.map(|(group, si)| (group.to_string(), si.map(converted).to_vec()));
    let forces = FORCES.map(|(group, si)| (group.to_string(), vec![converted(si)]));
    let measures = system.mechanism.measurements.iter().map(|measurement| {
        let si = measurement.unit();
        (measured(&si), vec![converted(&si)])
    });
    motions.into_iter().chain(forces).chain(measures).collect()
}

/// Returns the requested forces and the measures, each with the group of its curve.
pub fn grouped(pool: &Pool, system: &System) -> Vec<(String, String)> {
    let columns = linkwright_solver::reported::names(pool, system);
    let forces = columns.len() - system.mechanism.measurements.len();
    let columns = columns.into_iter().enumerate();
    let grouped = columns.map(|(place, (name, si))| {
        let mut groups = FORCES
            .iter()
            .filter(|(_, unit)| *unit == si && place < forces);
        let group = groups.next().map(|(group, _)| group.to_string());
        (name, group.unwrap_or_else(|| measured(&si)))
    });
    grouped.collect()
}

/// Returns the group of measures in a unit.
fn measured(si: &str) -> String {
    format!("measured {si}").trim_end().to_string()
}
