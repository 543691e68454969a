//! Holds the values that quantities are to take, row by row.

use linkwright_codegen::stages::system::Derived;
use linkwright_solver::Observable;

use super::Unsearchable;

/// Values that quantities are to take.
#[derive(Clone, Debug)]
pub struct Targets {
    /// Times (s) of the rows, never decreasing; `None` if the rows have an order only.
    pub times: Option<Vec<f64>>,
    /// Number of rows.
    pub rows: usize,
    /// Quantities.
    pub columns: Vec<Target>,
}

/// Quantity with its values.
#[derive(Clone, Debug)]
pub struct Target {
    /// Name in messages.
    pub name: String,
    /// Quantity.
    pub observable: Observable,
    /// Values in SI units, row by row; `None` where the row does not say.
    pub values: Vec<Option<f64>>,
    /// Difference in SI units that weighs 1.
    pub size: f64,
    /// True for an angle, whose whole turns are indistinguishable.
    pub is_angle: bool,
}

impl Targets {
    /// Number of values.
    pub fn count(&self) -> usize {
        let values = self.columns.iter().flat_map(|it| &it.values);
        values.filter(|it| it.is_some()).count()
    }

    /// Checks that all derivatives are known.
    pub(super) fn check(&self, derived: &Derived) -> Result<(), Unsearchable> {
        for target in &self.columns {
            let observable = target.observable;
            if observable.order(derived) > 1 {
                return Err(Unsearchable::NotDerived(target.name.clone()));
            }
            if self.times.is_none() && rate(observable).is_none() {
                return Err(Unsearchable::NoRate(target.name.clone()));
            }
        }
        Ok(())
    }

    /// Quantities of all columns.
    pub(super) fn observables(&self) -> Vec<Observable> {
        self.columns.iter().map(|it| it.observable).collect()
    }
}

/// Returns the rate of a quantity; `None` for measures and forces.
pub(super) fn rate(observable: Observable) -> Option<Observable> {
    match observable {
        Observable::Coordinate { place, level } => Some(Observable::Coordinate {
            place,
            level: level + 1,
        }),
        Observable::Point { place, axis, level } => Some(Observable::Point {
            place,
            axis,
            level: level + 1,
        }),
        Observable::Reported(_) => None,
    }
}
