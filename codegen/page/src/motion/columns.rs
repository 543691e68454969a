//! Names the columns of a motion, and reads their values from its instants.
//!
//! All tables of a motion have these columns in this order, after the time: coordinates, their rates and accelerations, points, derivatives,
//! forces, measures, distances from singular poses.

use linkwright_codegen::stages::joint::Quantity;
use linkwright_solver::View;

use super::{Followed, Shown};
use crate::units::{LENGTHS, si_levels};

/// Suffixes of a coordinate, its rate and its acceleration.
pub const RATES: [&str; 3] = ["", "_d", "_dd"];

/// Suffixes of a point's components.
pub const OF_POINT: [&str; 6] = ["_x", "_y", "_vx", "_vy", "_ax", "_ay"];

/// Column of a motion.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Name: `phi2`, `phi2_d`, `K_x`, `K_x per phi(crank)`, `effort_crank`.
    pub name: String,
    /// SI unit; empty for a pure number.
    pub unit: String,
    /// True for an angle, whose whole turns are indistinguishable.
    pub is_angle: bool,
}

/// Columns of a motion without its time.
#[derive(Clone, Debug)]
pub struct Columns {
    /// Names and units.
    pub columns: Vec<Column>,
    derivatives: usize,
    reported: usize,
}

impl Column {
    fn new(name: String, unit: &str) -> Column {
        Column {
            name,
            unit: unit.to_string(),
            is_angle: false,
        }
    }
}

impl Columns {
    /// Returns the columns of a motion.
    pub fn of<V: View>(motion: &Followed<V>) -> Columns {
        let mut columns = Vec::new();
        let coordinates = &motion.system().coordinates;
        for (level, suffix) in RATES.iter().enumerate() {
            columns.extend(coordinates.iter().map(|it| Column {
                is_angle: level == 0 && it.quantity == Quantity::Angle,
                ..Column::new(
                    format!("{}{suffix}", it.name),
                    si_levels(it.quantity)[level],
                )
            }));
        }
        for point in motion.point_names() {
            let suffixes = OF_POINT.iter().enumerate();
            columns.extend(suffixes.map(|(component, suffix)| {
                Column::new(format!("{point}{suffix}"), LENGTHS[component / 2])
            }));
        }
        let derivatives = motion.derivative_names.iter();
        columns.extend(derivatives.map(|(name, unit)| Column::new(name.clone(), unit)));
        let reported = motion.reported_names.iter();
        columns.extend(reported.map(|(name, unit)| Column::new(name.clone(), unit)));
        let measures = motion.measure_names.iter();
        columns.extend(measures.map(|name| Column::new(name.clone(), "")));
        Columns {
            columns,
            derivatives: motion.derivative_names.len(),
            reported: motion.reported_names.len(),
        }
    }

    /// Returns the values of an instant in SI units, column by column; `None` where Φ_q is singular.
    pub fn values<'a>(&self, shown: &'a Shown<'_>) -> impl Iterator<Item = Option<f64>> + 'a {
        let instant = shown.instant;
        let levels = [instant.q(), instant.qd(), instant.qdd()];
        let coordinates = levels.into_iter().flatten().copied();
        let points = shown.motions.iter();
        let points = points.flat_map(|it| [it.position, it.velocity, it.acceleration]);
        let known = coordinates.chain(points.flatten()).map(Some);
        known
            .chain(optional(shown.derivatives, self.derivatives))
            .chain(optional(shown.reported, self.reported))
            .chain(shown.measures.iter().copied().map(Some))
    }
}

fn optional(values: Option<&[f64]>, count: usize) -> impl Iterator<Item = Option<f64>> {
    (0..count).map(move |place| values.map(|it| it[place]))
}
