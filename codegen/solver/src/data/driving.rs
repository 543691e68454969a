//! Drives the inputs of a mechanism by measured columns.
//!
//! An input passes through all its values, on a C² spline between them; angles continue without jumps by whole turns.

use linkwright_codegen::stages::model::{Dimension, follow_points};
use linkwright_codegen::stages::system::Derived;

use super::{Data, Scale};
use crate::comparison::difference;

/// Column that drives an input.
#[derive(Clone, Debug)]
pub struct MeasuredInput {
    /// Name in the table.
    pub name: String,
    /// Index of the input.
    pub input: usize,
    /// Unit of the column.
    pub scale: Scale,
    /// Values in SI units, row by row; `None` if missing.
    pub values: Vec<Option<f64>>,
}

/// Powers of m, s, kg and rad of an input; those of its column if the description does not state them.
pub fn powers(dimension: Dimension, column: Option<[i32; 4]>) -> [i32; 4] {
    match dimension {
        Dimension::Angle | Dimension::AngleRate(_) => dimension.column_powers(),
        Dimension::Marked { length, time, mass } => [length, time, mass, 0],
        Dimension::Number | Dimension::OfTime => column.unwrap_or([0; 4]),
    }
}

impl Data {
    /// Returns the equations with inputs that follow their columns.
    ///
    /// # Errors
    /// A column begins or ends with a missing value, or has fewer than two times.
    pub fn drive(&self, derived: Derived) -> Result<Derived, String> {
        let Derived {
            mut pool,
            mut system,
        } = derived;
        for own in &self.inputs {
            let refused = |why: &str| {
                format!(
                    "error: the column `{}` of `{}` {why}\n  = help: an input is driven from the first row to the last one; `{}` leaves the column out",
                    own.name, self.name, self.names.skip
                )
            };
            let ends = [own.values.first(), own.values.last()];
            if ends.iter().any(|it| !matches!(it, Some(Some(_)))) {
                return Err(refused("has no value in its first or last row"));
            }
            let is_angle = system.mechanism.inputs[own.input].dimension == Dimension::Angle;
            let mut points: Vec<[f64; 2]> = Vec::with_capacity(self.times.len());
            for (t, value) in self.times.iter().zip(&own.values) {
                let (Some(value), last) = (value, points.last().copied()) else {
                    continue;
                };
                match last {
                    // Rows of the same time share one input.
                    Some([before, _]) if *t <= before => {}
                    Some([_, last]) if is_angle => {
                        points.push([*t, last + difference(*value, last, true)]);
                    }
                    _ => points.push([*t, *value]),
                }
            }
            if points.len() < 2 {
                return Err(refused("has fewer than two times"));
            }
            if !follow_points(&mut pool, &mut system.mechanism, own.input, &points) {
                return Err(refused("changes too fast for double precision"));
            }
        }
        Ok(Derived { pool, system })
    }
}
