//! Motion of a mechanism with weights and free drivers in all coordinates, by the augmented equations of Lagrange.
//!
//! M q̈ + Φ_qᵀ λ = Q and Φ_q q̈ = γ are solved for q̈ and λ. All coordinates and their rates are integrated by
//! extrapolation of the modified midpoint rule (Gragg, Bulirsch and Stoer), and projected onto the constraints after
//! each step. The code is independent of the simulation: Φ comes from the textbook formulation, M and Q are those of
//! rigid bodies in plain numbers.

use linkwright::Equations;
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::textbook::TextbookEquations;
use linkwright_solver::{InputLaws, Numbers};
use nalgebra::{DMatrix, DVector};

use crate::forces::Weight;

/// Number of extrapolations of the midpoint rule.
const COLUMNS: usize = 8;

/// Largest number of steps between two frames.
const STEPS: usize = 1000;

/// Number of corrections of a pose; each about doubles the digits.
const CORRECTIONS: usize = 4;

/// Coordinates and their rates.
#[derive(Clone, Debug)]
pub struct Motion {
    /// q.
    pub pose: DVector<f64>,
    /// q̇.
    pub rates: DVector<f64>,
}

/// Augmented equations of a mechanism whose constraints do not depend on time.
pub struct Multipliers {
    equations: TextbookEquations,
    /// Rows of constraints, and rows of free drivers.
    held: Vec<usize>,
    free: Vec<usize>,
    /// Values of the free coordinates by the description.
    values: DVector<f64>,
    weights: Vec<Weight>,
    gravity: [f64; 2],
}

impl Multipliers {
    /// Equations of a system with these weights.
    pub fn new(derived: &Derived, weights: &[Weight], gravity: [f64; 2]) -> Multipliers {
        let drivers: Vec<usize> = derived
            .system
            .mechanism
            .forces
            .free
            .iter()
            .map(|it| it.joint)
            .collect();
        let rows = 0..derived.system.rows.len();
        let (free, held): (Vec<usize>, _) =
            rows.partition(|&row| drivers.contains(&derived.system.rows[row].joint));
        let inputs = InputLaws::of(&derived.pool, &derived.system).at(0.0);
        let values = free.iter().map(|&row| {
            let mut all = derived.system.mechanism.forces.free.iter();
            let coordinate = all.find(|it| it.joint == derived.system.rows[row].joint);
            inputs.0[coordinate.expect("a free coordinate").input].value
        });
        let values = DVector::from_vec(values.collect());
        let equations = TextbookEquations::new(&derived.pool, &derived.system);
        equations.supply(
            &Numbers::nominal_parameters(&derived.pool, &derived.system),
            &inputs,
        );
        Multipliers {
            equations,
            held,
            free,
            values,
            weights: weights.to_vec(),
            gravity,
        }
    }

    fn matrix(&self, pose: &DVector<f64>) -> DMatrix<f64> {
        let count = pose.len();
        let mut whole = DMatrix::zeros(count, count);
        self.equations.jacobian(pose, 0.0, &mut whole);
        whole
    }

    /// Φ_q of the joints.
    fn held_matrix(&self, pose: &DVector<f64>) -> DMatrix<f64> {
        self.matrix(pose).select_rows(&self.held)
    }

    /// Projection of a vector onto the null space of Φ_q.
    pub fn allowed(&self, pose: &DVector<f64>, vector: &DVector<f64>) -> DVector<f64> {
        let matrix = self.held_matrix(pose);
        let nothing = DVector::zeros(self.held.len());
        let unit = DMatrix::identity(pose.len(), pose.len());
        augmented(&unit, &matrix, vector, &nothing)
    }

    /// Values of the free coordinates.
    pub fn free_values(&self, pose: &DVector<f64>) -> DVector<f64> {
        let mut whole = DVector::zeros(pose.len());
        self.equations.residual(pose, 0.0, &mut whole);
        whole.select_rows(&self.free) + &self.values
    }

    /// Determinant of the free coordinates along an orthonormal basis of the null space, with gradients of length 1.
    pub fn determinant(&self, pose: &DVector<f64>) -> f64 {
        let gradients = self.matrix(pose).select_rows(&self.free);
        let parts = gradients.row_iter().map(|row| {
            let gradient = row.transpose().normalize();
            self.allowed(pose, &gradient)
        });
        let parts: Vec<DVector<f64>> = parts.collect();
        let triangle = DMatrix::from_columns(&parts).qr().r();
        triangle.diagonal().product().abs()
    }

    /// Rates of the free coordinates, from rates of all coordinates.
    pub fn free_rates(&self, motion: &Motion) -> DVector<f64> {
        self.matrix(&motion.pose).select_rows(&self.free) * &motion.rates
    }

    /// Largest residual of the joints, and of their rates.
    pub fn missed(&self, motion: &Motion) -> f64 {
        let matrix = self.held_matrix(&motion.pose);
        self.residual(&motion.pose)
            .amax()
            .max((matrix * &motion.rates).amax())
    }

    fn residual(&self, pose: &DVector<f64>) -> DVector<f64> {
        let mut whole = DVector::zeros(pose.len());
        self.equations.residual(pose, 0.0, &mut whole);
        whole.select_rows(&self.held)
    }

    /// Projects pose and rates onto the constraints.
    pub fn project(&self, motion: &mut Motion) {
        let count = motion.pose.len();
        let unit = DMatrix::identity(count, count);
        let nothing = DVector::zeros(count);
        for _ in 0..CORRECTIONS {
            let residual = self.residual(&motion.pose);
            if residual.amax() < 1e-15 {
                break;
            }
            motion.pose -= augmented(&unit, &self.held_matrix(&motion.pose), &nothing, &residual);
        }
        motion.rates = self.allowed(&motion.pose, &motion.rates);
    }

    /// M, and Q with the centrifugal terms.
    fn masses_and_loads(&self, motion: &Motion) -> (DMatrix<f64>, DVector<f64>) {
        let count = motion.pose.len();
        let (mut masses, mut loads) = (DMatrix::zeros(count, count), DVector::zeros(count));
        for weight in &self.weights {
            let at = 3 * weight.body;
            let (sine, cosine) = motion.pose[at + 2].sin_cos();
            let [x, y] = weight.center;
            let arm = [cosine * x - sine * y, sine * x + cosine * y];
            let turning = motion.rates[at + 2];
            let mass = weight.mass;
            // r̈_S = r̈ + φ̈ ẑ × arm − φ̇² arm.
            let moved = [-arm[1], arm[0]];
            for axis in [0, 1] {
                let load = mass * (self.gravity[axis] + turning * turning * arm[axis]);
                masses[(at + axis, at + axis)] += mass;
                masses[(at + axis, at + 2)] += mass * moved[axis];
                masses[(at + 2, at + axis)] += mass * moved[axis];
                loads[at + axis] += load;
                loads[at + 2] += moved[axis] * load;
            }
            masses[(at + 2, at + 2)] += weight.inertia + mass * (x * x + y * y);
        }
        (masses, loads)
    }

    /// q̈.
    fn acceleration(&self, motion: &Motion) -> DVector<f64> {
        let (masses, loads) = self.masses_and_loads(motion);
        let mut gamma = DVector::zeros(motion.pose.len());
        self.equations
            .gamma(&motion.pose, &motion.rates, 0.0, &mut gamma);
        let gamma = gamma.select_rows(&self.held);
        augmented(&masses, &self.held_matrix(&motion.pose), &loads, &gamma)
    }

    /// Sum of the kinetic and the potential energy.
    pub fn energy(&self, motion: &Motion) -> f64 {
        let (masses, _) = self.masses_and_loads(motion);
        let kinetic = 0.5 * motion.rates.dot(&(masses * &motion.rates));
        let potential = self.weights.iter().map(|weight| {
            let at = 3 * weight.body;
            let (sine, cosine) = motion.pose[at + 2].sin_cos();
            let [x, y] = weight.center;
            let height = [cosine * x - sine * y, sine * x + cosine * y];
            let along =
                [0, 1].map(|axis| self.gravity[axis] * (motion.pose[at + axis] + height[axis]));
            -weight.mass * (along[0] + along[1])
        });
        kinetic + potential.sum::<f64>()
    }

    /// State after a time, with steps of this relative and absolute error; `None` if rounding prevents a short enough
    /// step, or too many are needed.
    pub fn after(
        &self,
        start: &Motion,
        time: f64,
        tolerance: f64,
        length: &mut f64,
    ) -> Option<Motion> {
        let mut motion = start.clone();
        let mut passed = 0.0;
        for _ in 0..STEPS {
            if passed >= time {
                return Some(motion);
            }
            let step = length.min(time - passed);
            if step <= 1e-9 * time && step < time - passed {
                return None;
            }
            let (end, error) = self.extrapolated(&motion, step, tolerance);
            let factor = match error.is_finite() {
                true => 0.8 * error.max(1e-12).powf(-1.0 / (2 * COLUMNS - 1) as f64),
                false => 0.2,
            };
            if error <= 1.0 {
                passed = if step == time - passed {
                    time
                } else {
                    passed + step
                };
                motion = end;
                self.project(&mut motion);
                if step == *length || factor < 1.0 {
                    *length = step * factor.clamp(0.2, 3.0);
                }
            } else {
                *length = step * factor.clamp(0.2, 0.9);
            }
        }
        None
    }

    /// Result of a step, and its error in tolerances.
    fn extrapolated(&self, start: &Motion, step: f64, tolerance: f64) -> (Motion, f64) {
        let mut row: Vec<Motion> = Vec::new();
        let mut error = f64::INFINITY;
        for column in 0..COLUMNS {
            let parts = 2 * (column + 1);
            let mut refined = self.midpoint(start, step, parts);
            let mut next = vec![refined.clone()];
            for (back, before) in row.iter().enumerate() {
                let other = 2 * (column - back);
                let ratio = (parts as f64 / other as f64).powi(2);
                let better = Motion {
                    pose: &refined.pose + (&refined.pose - &before.pose) / (ratio - 1.0),
                    rates: &refined.rates + (&refined.rates - &before.rates) / (ratio - 1.0),
                };
                if back + 1 == column {
                    error = distance([&better, &refined], tolerance);
                }
                next.push(better.clone());
                refined = better;
            }
            row = next;
        }
        let end = row.pop().expect("columns");
        (end, error)
    }

    /// The modified midpoint rule.
    fn midpoint(&self, start: &Motion, step: f64, parts: usize) -> Motion {
        let length = step / parts as f64;
        let moved = |from: &Motion, at: &Motion, length: f64| Motion {
            pose: &from.pose + length * &at.rates,
            rates: &from.rates + length * self.acceleration(at),
        };
        let mut before = start.clone();
        let mut now = moved(start, start, length);
        for _ in 1..parts {
            let next = moved(&before, &now, 2.0 * length);
            (before, now) = (now, next);
        }
        now
    }
}

/// Larger of two numbers; NaN if one of them is, unlike `f64::max`.
pub fn larger(one: f64, other: f64) -> f64 {
    match one.is_nan() || one >= other {
        true => one,
        false => other,
    }
}

/// Largest difference of coordinates and rates; NaN if one of them is.
pub fn apart(one: &Motion, other: &Motion) -> f64 {
    let difference = |one: &DVector<f64>, other: &DVector<f64>| {
        let parts = one
            .iter()
            .zip(other)
            .map(|(one, other)| (one - other).abs());
        parts.fold(0.0, larger)
    };
    larger(
        difference(&one.pose, &other.pose),
        difference(&one.rates, &other.rates),
    )
}

/// Largest difference in tolerances.
fn distance([one, other]: [&Motion; 2], tolerance: f64) -> f64 {
    let difference = |one: &DVector<f64>, other: &DVector<f64>| {
        let pairs = one.iter().zip(other);
        let parts = pairs.map(|(one, other)| (one - other).abs() / (tolerance * (1.0 + one.abs())));
        parts.fold(0.0, larger)
    };
    larger(
        difference(&one.pose, &other.pose),
        difference(&one.rates, &other.rates),
    )
}

/// x of M x + Φ_qᵀ λ = `above` and Φ_q x = `below`; NaN if the joints have lost rank.
fn augmented(
    masses: &DMatrix<f64>,
    matrix: &DMatrix<f64>,
    above: &DVector<f64>,
    below: &DVector<f64>,
) -> DVector<f64> {
    let (rows, count) = matrix.shape();
    let mut whole = DMatrix::zeros(count + rows, count + rows);
    whole.view_mut((0, 0), (count, count)).copy_from(masses);
    whole
        .view_mut((0, count), (count, rows))
        .copy_from(&matrix.transpose());
    whole.view_mut((count, 0), (rows, count)).copy_from(matrix);
    let mut right = DVector::zeros(count + rows);
    right.rows_mut(0, count).copy_from(above);
    right.rows_mut(count, rows).copy_from(below);
    match whole.lu().solve(&right) {
        Some(found) => found.rows(0, count).into_owned(),
        None => DVector::repeat(count, f64::NAN),
    }
}
