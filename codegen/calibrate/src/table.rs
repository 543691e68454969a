//! Takes measured values from a table.

use linkwright_codegen::stages::system::Derived;
use linkwright_solver::data::{Data, sizes};

use crate::{Calibrator, Column, Measurements};

impl Measurements {
    /// Returns the measured values of a table. `deviations` are `0.1mm` of columns in this unit, or `K_x=2mm` of one; `option` is their name
    /// in messages.
    ///
    /// # Errors
    /// The printed message: a deviation cannot be read, is zero, or belongs to no column.
    #[doc(hidden)]
    pub fn of(data: &Data, option: &str, deviations: &[String]) -> Result<Measurements, String> {
        let deviations = sizes(option, deviations, data)?;
        if let Some(place) = deviations.iter().position(|it| *it == Some(0.0)) {
            let name = &data.measured[place].name;
            return Err(format!(
                "error: the deviation of `{name}` is zero\n  = help: leave it out if it is unknown"
            ));
        }
        let mut kinds: Vec<[i32; 4]> = Vec::new();
        let columns = data.measured.iter().zip(deviations);
        let columns = columns.map(|(measured, deviation)| {
            let powers = measured.quantity.powers;
            let known = kinds.iter().position(|it| *it == powers);
            Column {
                group: known.unwrap_or_else(|| {
                    kinds.push(powers);
                    kinds.len() - 1
                }),
                observable: measured.quantity.observable,
                rounding: measured.rounding(),
                values: measured.values.clone(),
                deviation,
            }
        });
        Ok(Measurements {
            columns: columns.collect(),
            times: data.times.clone(),
        })
    }
}

/// Leaves out the columns that cannot be fitted: accelerations, forces, and measures of these.
///
/// # Errors
/// The printed message: none remains.
pub fn leave_out_underived(data: &mut Data, derived: &Derived) -> Result<(), String> {
    let (kept, left): (Vec<_>, Vec<_>) = std::mem::take(&mut data.measured)
        .into_iter()
        .partition(|it| Calibrator::can_fit(derived, it.quantity.observable).is_ok());
    let left = left.into_iter().map(|it| {
        let why = format!(
            "accelerations and forces such as `{}` cannot be fitted",
            it.quantity.name
        );
        (it.name, why)
    });
    data.left_out.extend(left);
    data.measured = kept;
    match data.measured.is_empty() {
        true => Err(format!(
            "error: `{}` has neither positions nor rates\n  = help: fit positions and rates, not accelerations and forces",
            data.name
        )),
        false => Ok(()),
    }
}
