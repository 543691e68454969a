//! Committed high-precision references of mechanisms, by name.
//!
//! The tables are written by `tests/data/references.py`, which shares no code with the generator or the runtime.

use crate::table::Table;

/// Every mechanism with a reference, and the file it is in: t, then q, q̇, q̈ in the order of the mechanism's coordinates.
pub const REFERENCES: &[(&str, &str)] = &[
    ("two_body", "exam.csv"),
    ("four_bar", "four_bar.csv"),
    ("slider_crank", "slider_crank.csv"),
    ("inverted_slider_crank", "inverted_slider_crank.csv"),
    ("stephenson", "stephenson.csv"),
    ("platform_3rpr", "platform_3rpr.csv"),
    ("excavator", "excavator_centers.csv"),
    ("excavator_pins", "excavator.csv"),
    ("arm", "arm.csv"),
    ("scissor", "scissor.csv"),
    ("jansen", "jansen.csv"),
    ("peaucellier", "peaucellier.csv"),
    ("andrews", "andrews.csv"),
    ("quick_return", "quick_return.csv"),
    ("scotch_yoke", "scotch_yoke.csv"),
    ("double_wishbone", "double_wishbone.csv"),
    ("pantograph", "pantograph.csv"),
    ("planetary_gear", "planetary_gear.csv"),
    ("rack_steering", "rack_steering.csv"),
    ("disc_cam", "disc_cam.csv"),
    ("cam_dwell", "cam_dwell.csv"),
];

/// The file of a mechanism's reference.
///
/// # Panics
/// If it has none.
pub fn file(mechanism: &str) -> &'static str {
    let entry = REFERENCES.iter().find(|(name, _)| *name == mechanism);
    let (_, file) = entry.unwrap_or_else(|| panic!("`{mechanism}` has no reference"));
    file
}

/// The reference of a mechanism.
///
/// # Panics
/// If it has none.
pub fn reference(mechanism: &str) -> Table {
    Table::read(file(mechanism))
}

/// Scale of the errors of each column after t: the largest absolute value in the column. For an angle it is at least
/// 1 rad, since an angle is computed from a direction, whose components are of the order of one. In a column of zeros
/// it is the largest among the columns of the same level (q, q̇ or q̈).
pub fn yardsticks(table: &Table) -> Vec<f64> {
    let magnitudes: Vec<f64> = (1..table.names.len())
        .map(|column| table.magnitude(column))
        .collect();
    let level_length = magnitudes.len() / 3;
    magnitudes
        .iter()
        .enumerate()
        .map(|(index, magnitude)| {
            if index < level_length && index % 3 == 2 {
                return magnitude.max(1.0);
            }
            if *magnitude > 0.0 {
                return *magnitude;
            }
            let start = index / level_length * level_length;
            let level = &magnitudes[start..start + level_length];
            level.iter().copied().fold(0.0, f64::max)
        })
        .collect()
}
