//! The derivatives of rates by state and by time at the start of a step, by differences.
//!
//! Differences are central for components and of second order for the time, so that of quadratic rates only rounding is missed.

use nalgebra::{DMatrix, DVector, Schur};

use crate::rates::Rates;

/// Part of a scale by which a variable is moved: the cube root of a rounding error, where its square and rounding miss as much.
pub const PART: f64 = 6e-6;

/// Most iterations of an eigenvalue.
const ITERATIONS: usize = 100;

/// Derivatives of the rates of a state.
#[derive(Clone, Debug)]
pub struct Differences {
    /// Derivatives by the components of the state.
    pub jacobian: DMatrix<f64>,
    /// Derivatives by time.
    pub time: DVector<f64>,
}

impl Differences {
    /// At a time and a state with these rates, before a step of a length.
    ///
    /// # Errors
    /// There are no rates beside the state.
    pub fn of<R: Rates>(
        rates: &mut R,
        t: f64,
        state: &[f64],
        slope: &[f64],
        length: f64,
    ) -> Result<Differences, R::Failure> {
        let count = state.len();
        let mut jacobian = DMatrix::zeros(count, count);
        let mut sides = [vec![0.0; count], vec![0.0; count]];
        let mut moved = state.to_vec();
        let scales = rates.scales(state, slope, length);
        for (column, scale) in scales.iter().enumerate() {
            let from = state[column];
            let [after, before] = [from + PART * scale, from - PART * scale];
            for (side, at) in sides.iter_mut().zip([after, before]) {
                moved[column] = at;
                rates.rates(t, &moved, side)?;
            }
            moved[column] = from;
            for row in 0..count {
                jacobian[(row, column)] = (sides[0][row] - sides[1][row]) / (after - before);
            }
        }
        let ahead = [1.0, 2.0].map(|times| t + times * PART * length);
        for (side, at) in sides.iter_mut().zip(ahead) {
            rates.rates(at, state, side)?;
        }
        // The parabola through three values at unequal distances: times are rounded.
        let [one, two] = ahead.map(|at| at - t);
        let time = DVector::from_fn(count, |row, _| {
            let [near, far] = [(&sides[0], one), (&sides[1], two)]
                .map(|(side, distance)| (side[row] - slope[row]) / distance);
            near + (near - far) * one / (two - one)
        });
        Ok(Differences { jacobian, time })
    }

    /// The largest magnitude of an eigenvalue among the first components (1/s); infinite where it is not found.
    pub fn spectral_radius(&self, judged: usize) -> f64 {
        let own = self.jacobian.view((0, 0), (judged, judged)).into_owned();
        let limit = ITERATIONS * judged;
        let is_finite = own.iter().all(|it| it.is_finite());
        let found = is_finite.then(|| Schur::try_new(own, f64::EPSILON, limit));
        found.flatten().map_or(f64::INFINITY, |schur| {
            let values = schur.complex_eigenvalues();
            values
                .iter()
                .map(|it| it.re.hypot(it.im))
                .fold(0.0, f64::max)
        })
    }
}
