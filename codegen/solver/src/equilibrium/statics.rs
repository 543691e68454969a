//! Evaluates constraints, loads and their exact derivatives of a mechanism at rest.
//!
//! All unknowns are scaled: lengths in characteristic lengths, and forces by energies. With Φ_q of full rank, V an orthonormal basis of its
//! null space and μ the multipliers of Φ, the force along V is g = Vᵀ Q, and the stiffness on the constraints is
//! K = Vᵀ (−∂Q/∂q + Σ μ ∂²Φ/∂q²) V.

use linkwright_codegen::stages::expr::{ExprId, Node, SymbolId};
use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::system::System;
use nalgebra::{DMatrix, DVector};

use crate::instant::Instant;
use crate::reader::Reader;
use crate::simulation::{MotionEquations, Varied};

/// Rounding of sums, as a share of the sum of their magnitudes.
pub(super) const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Scaled residual up to which a redundant joint is satisfied.
const MISFIT: f64 = 1e-6;

/// Equations of a mechanism at rest.
#[derive(Clone, Debug)]
pub(super) struct StaticEquations {
    pub motion: MotionEquations,
    /// Time at which drivers and inputs stand (s).
    t: f64,
    /// Summands of the load along each unknown.
    summands: Reader,
    summand_rows: Vec<usize>,
    /// Summands of derivatives of loads by unknowns.
    slopes: Reader,
    slope_places: Vec<(usize, usize)>,
    /// Summands of second derivatives of constraints by unknowns.
    curvatures: Reader,
    curvature_places: Vec<(usize, usize, usize)>,
    /// Residuals of redundant joints, and their scales.
    monitored: Reader,
    monitored_scales: Vec<f64>,
}

/// Constraints and loads in a pose.
#[derive(Clone, Debug)]
pub(super) struct PoseForces {
    pub instant: Instant,
    /// Unknowns in SI units.
    pub unknowns: Vec<f64>,
    /// Φ, scaled.
    pub residual: DVector<f64>,
    /// Φ_q, scaled.
    pub jacobian: DMatrix<f64>,
    /// Inverse of [Φ_q; Vᵀ].
    pub inverse: DMatrix<f64>,
    /// V.
    pub basis: DMatrix<f64>,
    /// Loads along all unknowns (J).
    pub load: DVector<f64>,
    /// Sum of the magnitudes of their summands (J).
    pub magnitude: DVector<f64>,
    /// μ (J).
    pub multipliers: DVector<f64>,
    /// g (J).
    pub force: DVector<f64>,
    /// Potential energy of gravity and springs (J).
    pub potential: f64,
    /// Mass along V.
    pub mass: DMatrix<f64>,
}

/// Stiffness in a pose (J).
#[derive(Clone, Debug)]
pub(super) struct PoseStiffness {
    /// Stiffness along all unknowns, with the curvature of the constraints.
    pub whole: DMatrix<f64>,
    /// Sum of the magnitudes of its summands.
    pub magnitude: DMatrix<f64>,
    /// K.
    pub reduced: DMatrix<f64>,
}

impl StaticEquations {
    /// Creates the equations at a time (s); `None` if no coordinate is free or forces are undetermined.
    pub fn new(pool: &Pool, system: &System, t: f64) -> Option<StaticEquations> {
        let motion = MotionEquations::new(pool, system)?;
        let loads = system.forces.as_ref()?;
        let mut pool = pool.draft();
        let mechanism = &system.mechanism;
        let mut symbols: Vec<SymbolId> = system.coordinates.iter().map(|it| it.position).collect();
        let free = mechanism.forces.free.iter();
        symbols.extend(free.map(|it| mechanism.inputs[it.input].symbols[0]));
        let (mut summands, mut summand_rows) = (Vec::new(), Vec::new());
        let (mut slopes, mut slope_places) = (Vec::new(), Vec::new());
        for (row, &load) in loads
            .loads
            .iter()
            .enumerate()
            .take(system.coordinates.len())
        {
            let load = pool.graph.substitute(load, &loads.lengths);
            let load = pool.written_out(load);
            for term in parts(&mut pool, load) {
                summands.push(term);
                summand_rows.push(row);
            }
            for (column, &symbol) in symbols.iter().enumerate() {
                let slope = pool.graph.derivative(load, symbol);
                for term in parts(&mut pool, slope) {
                    slopes.push(term);
                    slope_places.push((row, column));
                }
            }
        }
        let (mut curvatures, mut curvature_places) = (Vec::new(), Vec::new());
        for (row, own) in system.rows.iter().enumerate() {
            let residual = pool.written_out(own.residual);
            for (column, &symbol) in symbols.iter().enumerate() {
                let slope = pool.graph.derivative(residual, symbol);
                for (other, &symbol) in symbols.iter().enumerate() {
                    let curvature = pool.graph.derivative(slope, symbol);
                    for term in parts(&mut pool, curvature) {
                        curvatures.push(term);
                        curvature_places.push((row, column, other));
                    }
                }
            }
        }
        let monitored: Vec<ExprId> = system.monitored.iter().map(|it| it.residual).collect();
        let scales = system.monitored.iter().map(|it| it.quantity);
        let reader = |roots: &[ExprId]| Reader::new(&pool.graph, motion.layout(), roots);
        Some(StaticEquations {
            summands: reader(&summands),
            summand_rows,
            slopes: reader(&slopes),
            slope_places,
            curvatures: reader(&curvatures),
            curvature_places,
            monitored: reader(&monitored),
            monitored_scales: scales.map(|it| system.scale(it, &pool)).collect(),
            motion,
            t,
        })
    }

    /// Sets a parameter or an input.
    pub fn set(&mut self, place: Varied, value: f64) {
        self.motion.set(place, value);
    }

    /// Number of unknowns, the free coordinates last.
    pub fn count(&self) -> usize {
        self.motion.coordinate_scales.len()
    }

    /// Number of degrees of freedom.
    pub fn freedom(&self) -> usize {
        let [rows, columns] = self.motion.dimensions();
        columns.saturating_sub(rows)
    }

    /// True for each unknown that is an angle.
    pub fn is_angle(&self, place: usize) -> bool {
        !self.motion.is_length[place]
    }

    /// Returns an instant at rest with these unknowns.
    pub fn instant(&self, unknowns: &[f64]) -> Instant {
        let mut instant = self.motion.resting_instant(self.t);
        self.motion.still(&mut instant);
        self.motion.set_level(&mut instant, 0, unknowns);
        instant
    }

    /// Returns unknowns that a scaled step leads to.
    pub fn stepped(&self, unknowns: &[f64], step: &DVector<f64>) -> Vec<f64> {
        let steps = step.iter().zip(&self.motion.coordinate_scales);
        let moved = unknowns.iter().zip(steps);
        moved.map(|(at, (step, scale))| at + step * scale).collect()
    }

    /// Returns the scaled difference of two poses.
    pub fn difference(&self, to: &[f64], from: &[f64]) -> DVector<f64> {
        DVector::from_fn(to.len(), |at, _| {
            (to[at] - from[at]) / self.motion.coordinate_scales[at]
        })
    }

    /// Returns the scaled loads along all unknowns, with the sum of magnitudes of their summands.
    pub fn loads(&self, instant: &Instant) -> [DVector<f64>; 2] {
        let count = self.count();
        let (mut load, mut magnitude) = (DVector::zeros(count), DVector::zeros(count));
        let values = self.summands.values(instant);
        for (&row, value) in self.summand_rows.iter().zip(values) {
            let value = value * self.motion.coordinate_scales[row];
            load[row] += value;
            magnitude[row] += value.abs();
        }
        [load, magnitude]
    }

    /// Returns constraints and loads; `None` if Φ_q has lost rank or a value is not finite.
    pub fn forces(&self, unknowns: &[f64]) -> Option<PoseForces> {
        let instant = self.instant(unknowns);
        let [rows, columns] = self.motion.dimensions();
        let (residual, jacobian) = self.motion.constraints(&instant);
        if jacobian.iter().chain(&residual).any(|it| !it.is_finite()) {
            return None;
        }
        let mut whole = DMatrix::identity(columns, columns);
        jacobian.transpose().col_piv_qr().q_tr_mul(&mut whole);
        let basis = whole.rows(rows, columns - rows).transpose();
        let mut bordered = DMatrix::zeros(columns, columns);
        bordered.rows_mut(0, rows).copy_from(&jacobian);
        bordered
            .rows_mut(rows, columns - rows)
            .copy_from(&basis.transpose());
        let inverse = bordered.try_inverse()?;
        let [load, magnitude] = self.loads(&instant);
        let dynamics = self.motion.dynamics(&instant);
        let along = inverse.tr_mul(&load);
        let scales =
            DMatrix::from_diagonal(&DVector::from_column_slice(&self.motion.coordinate_scales));
        let mass = basis.transpose() * &scales * dynamics.mass * &scales * &basis;
        let forces = PoseForces {
            instant,
            unknowns: unknowns.to_vec(),
            residual,
            jacobian,
            inverse,
            force: basis.tr_mul(&load),
            basis,
            multipliers: along.rows(0, rows).into_owned(),
            load,
            magnitude,
            potential: dynamics.energies[1],
            mass,
        };
        let values = forces.inverse.iter().chain(&forces.load);
        values
            .chain(&forces.mass)
            .all(|it| it.is_finite())
            .then_some(forces)
    }

    /// True if a pose satisfies redundant joints, which the equations leave out.
    pub fn holds_redundant(&self, pose: &PoseForces) -> bool {
        let values = self.monitored.values(&pose.instant);
        let mut pairs = values.iter().zip(&self.monitored_scales);
        pairs.all(|(value, scale)| value.abs() <= MISFIT * scale)
    }

    /// Returns the stiffness in a pose with these multipliers, along a basis.
    pub fn stiffness(
        &self,
        instant: &Instant,
        multipliers: &DVector<f64>,
        basis: &DMatrix<f64>,
    ) -> PoseStiffness {
        let count = self.count();
        let scales = &self.motion.coordinate_scales;
        let (mut whole, mut magnitude) =
            (DMatrix::zeros(count, count), DMatrix::zeros(count, count));
        let mut add = |row: usize, column: usize, value: f64| {
            let value = value * scales[row] * scales[column];
            whole[(row, column)] += value;
            magnitude[(row, column)] += value.abs();
        };
        let slopes = self.slopes.values(instant);
        for (&(row, column), value) in self.slope_places.iter().zip(slopes) {
            add(row, column, -value);
        }
        let curvatures = self.curvatures.values(instant);
        for (&(row, one, other), value) in self.curvature_places.iter().zip(curvatures) {
            let multiplier = multipliers[row] / self.motion.row_scales[row];
            add(one, other, multiplier * value);
        }
        PoseStiffness {
            reduced: basis.tr_mul(&(&whole * basis)),
            whole,
            magnitude,
        }
    }
}

impl PoseForces {
    /// Returns the stiffness.
    pub fn stiffness(&self, equations: &StaticEquations) -> PoseStiffness {
        equations.stiffness(&self.instant, &self.multipliers, &self.basis)
    }

    /// Returns the rounding of the force along a direction (J), with that of the pose itself.
    pub fn rounding(&self, along: &DVector<f64>, stiffness: &PoseStiffness) -> f64 {
        let along = along.map(f64::abs);
        let held = self
            .jacobian
            .map(f64::abs)
            .tr_mul(&self.multipliers.map(f64::abs));
        let moved = &stiffness.magnitude * DVector::from_element(along.len(), 1.0);
        let loads = &self.magnitude + held;
        // The direction itself is rounded.
        ROUNDING * (along.dot(&(&loads + moved)) + loads.norm())
    }
}

/// Returns the summands of an expression: none of zero.
fn parts(pool: &mut Pool, expr: ExprId) -> Vec<ExprId> {
    if expr == pool.graph.zero() {
        return Vec::new();
    }
    let Node::Sum(terms) = pool.graph.node(expr).clone() else {
        return vec![expr];
    };
    let terms = terms.iter();
    let parts = terms.map(|term| {
        let factor = pool.graph.number(term.coefficient);
        pool.graph.multiply(factor, term.expr)
    });
    parts.collect()
}
