//! Evaluates the acceleration of the free coordinates under forces: mass · s̈ = force.

use linkwright_codegen::stages::program::{Program, Reduced};
use nalgebra::{Cholesky, DMatrix, DVector};

use super::massless::{SMALLEST_PIVOT, unresisted};
use crate::instant::{Instant, Layout};
use crate::interpreted::Interpreted;
use crate::view::View;

/// Indices in instants of the reduced mass and force.
#[derive(Clone, Debug)]
pub struct ReducedMotion {
    /// Signals of the free coordinates: indices into the inputs.
    pub inputs: Vec<usize>,
    /// Lower triangle, row by row.
    masses: Vec<usize>,
    forces: Vec<usize>,
}

impl ReducedMotion {
    /// Creates the equation of a mechanism; `None` if no coordinate is free.
    pub fn of(view: &Interpreted) -> Option<ReducedMotion> {
        ReducedMotion::new(view.program(), view.layout())
    }

    fn new(program: &Program, layout: &Layout) -> Option<ReducedMotion> {
        let reduced = program.forces.reduced.as_ref()?;
        let slots = |fields: Vec<_>| -> Option<Vec<usize>> {
            fields.into_iter().map(|field| layout.slot(field)).collect()
        };
        Some(ReducedMotion {
            inputs: reduced.coordinates.iter().map(|it| it.input).collect(),
            masses: slots(reduced.masses.clone())?,
            forces: slots(reduced.coordinates.iter().map(|it| it.force).collect())?,
        })
    }

    /// Returns the reduced mass at an instant, symmetric.
    pub fn mass(&self, instant: &Instant) -> DMatrix<f64> {
        let count = self.forces.len();
        DMatrix::from_fn(count, count, |row, column| {
            instant.values()[self.masses[Reduced::place(row, column)]]
        })
    }

    /// Returns the reduced force at an instant, which does not depend on accelerations.
    pub fn force(&self, instant: &Instant) -> DVector<f64> {
        let forces = self.forces.iter().map(|&slot| instant.values()[slot]);
        DVector::from_iterator(self.forces.len(), forces)
    }

    /// Returns the acceleration of the mass by the force.
    ///
    /// # Errors
    /// The indices of the coordinates that move together without a positive mass.
    pub fn acceleration(&self, instant: &Instant) -> Result<DVector<f64>, Vec<usize>> {
        let (mass, force) = (self.mass(instant), self.force(instant));
        let diagonal = mass.diagonal();
        let positive = |value: &f64| *value > 0.0 && value.is_finite();
        if let Some(place) = diagonal.iter().position(|value| !positive(value)) {
            return Err(vec![place]);
        }
        let Some(factor) = Cholesky::new(mass.clone()) else {
            return Err(alone(&mass));
        };
        let pivots = factor.l_dirty().diagonal();
        let mut pivots = pivots.iter().zip(&diagonal);
        let small = |(pivot, whole): (&f64, &f64)| pivot * pivot <= SMALLEST_PIVOT * whole;
        match pivots.any(small) {
            true => Err(alone(&mass)),
            false => Ok(factor.solve(&force)),
        }
    }
}

/// Returns the indices of the free coordinates that no mass resists; the diagonal of the mass is positive.
fn alone(mass: &DMatrix<f64>) -> Vec<usize> {
    // Coordinates are compared by the energy of each alone.
    let scales = DMatrix::from_diagonal(&mass.diagonal().map(|own| 1.0 / own.sqrt()));
    unresisted(
        &scales * mass * &scales,
        &DMatrix::identity(mass.nrows(), mass.ncols()),
    )
}
