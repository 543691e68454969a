//! *A description's equations, and a start* → *pose, velocity and acceleration in 384 bits, and what floating point may make of
//! them*.
//!
//! The pose is found by Newton-Raphson in high precision. The bound is condition × rounding: the magnitudes of the inverse
//! Jacobian times the rounding errors of the rows, which are those of evaluating each row at the pose ([`super::bounded`]) and
//! what the solver lets pass as rounding, four ε of the row's scale; and ε of the largest coordinate. The bounds of the velocity contain the error of the pose,
//! those of the acceleration both.

use linkwright_codegen::expr::ExprId;
use linkwright_codegen::system::System;
use nalgebra::DMatrix;

use super::bounded::{Bounded, bounds};
use super::precise::{Factors, Precise, values};
use crate::magnitude::needed;

/// The factor for what a first-order analysis of each row does not see: the order of operations inside of closed forms, the
/// elimination, and the sines and cosines that are computed once more from rounded ones.
pub const FACTOR: f64 = 16.0;

/// What the solver takes for rounding in a scaled residual, in ε.
const LEVEL: f64 = 4.0;

/// Newton-Raphson steps in high precision: near a double root each one gains one bit.
const STEPS: usize = 200;

/// q, q̇ and q̈.
pub type Levels<T> = [Vec<T>; 3];

/// The equations of a mechanism, to be solved exactly.
pub struct Truth {
    system: System,
    /// What Φ needs, and what Φ and Φ_q need.
    residual: Vec<ExprId>,
    position: Vec<ExprId>,
    all: Vec<ExprId>,
}

/// What the equations are given at one instant: parameters, signals and the time.
#[derive(Clone, Debug, Default)]
pub struct Given {
    /// The parameters, in written order.
    pub parameters: Vec<f64>,
    /// Value, rate and acceleration of each signal, in written order.
    pub signals: Vec<[f64; 3]>,
    /// The time (s).
    pub t: f64,
}

/// The exact motion at one instant.
#[derive(Clone, Debug)]
pub struct Exact {
    /// q, q̇ and q̈.
    pub levels: Levels<Precise>,
    /// The magnitude of the inverse Jacobian's entries, row by row.
    inverse: Vec<Vec<f64>>,
    /// Whether the determinant of Φ_q is negative.
    pub is_negative: bool,
}

impl Truth {
    /// The equations of a system, which must be square.
    pub fn new(system: &System) -> Truth {
        let residual: Vec<ExprId> = system.rows.iter().map(|row| row.residual).collect();
        let entries = system.rows.iter().flat_map(|row| {
            let entries = row.jacobian.iter().map(|entry| entry.value);
            entries.chain([row.residual, row.time_derivative, row.gamma])
        });
        let all: Vec<ExprId> = entries.collect();
        let entries = system.rows.iter().flat_map(|row| &row.jacobian);
        let mut position = residual.clone();
        position.extend(entries.map(|entry| entry.value));
        Truth {
            residual: needed(&system.mechanism.graph, &residual),
            position: needed(&system.mechanism.graph, &position),
            all: needed(&system.mechanism.graph, &all),
            system: system.clone(),
        }
    }

    /// How many coordinates there are.
    pub fn count(&self) -> usize {
        self.system.coordinates.len()
    }

    /// The magnitude of each coordinate: the characteristic length given, and 1 for angles.
    pub fn scales(&self, length: f64) -> Vec<f64> {
        let coordinates = self.system.coordinates.iter();
        coordinates
            .map(|it| length.powi(it.quantity.power_of_length()))
            .collect()
    }

    /// A value for each symbol, those of the coordinates not yet.
    fn symbols<T: Clone>(&self, given: &Given, number: impl Fn(f64) -> T) -> Vec<T> {
        let mechanism = &self.system.mechanism;
        let mut symbols = vec![number(0.0); mechanism.graph.symbol_count()];
        for (parameter, value) in mechanism.parameters.iter().zip(&given.parameters) {
            symbols[parameter.symbol.index()] = number(*value);
        }
        for (input, signal) in mechanism.inputs.iter().zip(&given.signals) {
            for (symbol, value) in input.symbols.iter().zip(signal) {
                symbols[symbol.index()] = number(*value);
            }
        }
        symbols[mechanism.time.index()] = number(given.t);
        symbols
    }

    fn matrix(&self, values: &[Precise]) -> Vec<Vec<Precise>> {
        let mut rows = vec![vec![Precise::from_f64(0.0); self.count()]; self.count()];
        for (row, entries) in self.system.rows.iter().zip(&mut rows) {
            for entry in &row.jacobian {
                entries[entry.coordinate] = values[entry.value.index()].clone();
            }
        }
        rows
    }

    /// The motion on the path to which Newton-Raphson in high precision leads from `start` without changing the sign of the
    /// determinant; `None` where it leads nowhere, or the solution is singular.
    pub fn solve(&self, given: &Given, start: &[Precise]) -> Option<Exact> {
        let (symbols, q, factors) = self.converge(given, start, 1e-90)?;
        Some(self.complete(symbols, q, &factors))
    }

    /// The same pose to 20 digits, to start from.
    pub fn approach(&self, given: &Given, start: &[Precise]) -> Option<Vec<Precise>> {
        let (_, q, _) = self.converge(given, start, 1e-10)?;
        Some(q)
    }

    /// The symbols, the pose and the Jacobian there, once a step is below `limit`.
    fn converge(
        &self,
        given: &Given,
        start: &[Precise],
        limit: f64,
    ) -> Option<(Vec<Precise>, Vec<Precise>, Factors)> {
        let graph = &self.system.mechanism.graph;
        let mut symbols = self.symbols(given, Precise::from_f64);
        let mut q = start.to_vec();
        let mut first_sign = None;
        let mut settled = false;
        for _ in 0..STEPS {
            self.place(&mut symbols, 0, &q);
            let values = values(graph, &self.position, &symbols);
            let factors = Factors::new(self.matrix(&values))?;
            if *first_sign.get_or_insert(factors.is_negative) != factors.is_negative {
                return None;
            }
            if settled {
                return Some((symbols, q, factors));
            }
            let rows = self.system.rows.iter();
            let phi: Vec<Precise> = rows.map(|it| values[it.residual.index()].clone()).collect();
            let step = factors.solve(&phi);
            let before = q.iter().map(|it| it.to_f64().abs()).fold(0.0, f64::max);
            let sizes = self.scales(if before > 0.0 { before } else { 1.0 });
            let mut longest = 0.0_f64;
            for ((coordinate, change), size) in q.iter_mut().zip(&step).zip(sizes) {
                longest = longest.max(change.to_f64().abs() / size);
                *coordinate = coordinate.minus(change);
            }
            if !longest.is_finite() {
                return None;
            }
            settled = longest <= limit;
        }
        None
    }

    fn place(&self, symbols: &mut [Precise], level: usize, values: &[Precise]) {
        for (coordinate, value) in self.system.coordinates.iter().zip(values) {
            let symbol = [coordinate.position, coordinate.rate][level];
            symbols[symbol.index()] = value.clone();
        }
    }

    fn complete(&self, mut symbols: Vec<Precise>, q: Vec<Precise>, factors: &Factors) -> Exact {
        let graph = &self.system.mechanism.graph;
        let zero = Precise::from_f64(0.0);
        let values_at = |symbols: &[Precise]| values(graph, &self.all, symbols);
        let before = values_at(&symbols);
        let rows = || self.system.rows.iter();
        let b: Vec<Precise> = rows()
            .map(|row| zero.minus(&before[row.time_derivative.index()]))
            .collect();
        let qd = factors.solve(&b);
        self.place(&mut symbols, 1, &qd);
        let after = values_at(&symbols);
        let b: Vec<Precise> = rows().map(|row| after[row.gamma.index()].clone()).collect();
        let qdd = factors.solve(&b);
        let n = self.count();
        let mut inverse = vec![vec![0.0; n]; n];
        for column in 0..n {
            let mut unit = vec![zero.clone(); n];
            unit[column] = Precise::from_f64(1.0);
            for (row, entry) in factors.solve(&unit).iter().enumerate() {
                inverse[row][column] = entry.to_f64().abs();
            }
        }
        Exact {
            levels: [q, qd, qdd],
            inverse,
            is_negative: factors.is_negative,
        }
    }

    /// What [`Truth::bounds`] needs at a pose that is known to rounding, which is taken for the exact one; `None` where its Jacobian
    /// has no inverse. Unlike [`Truth::solve`] this takes no arithmetic of high precision.
    pub fn around(&self, given: &Given, levels: Levels<f64>) -> Option<Exact> {
        let graph = &self.system.mechanism.graph;
        let mut symbols = self.symbols(given, |number| number);
        for (coordinate, value) in self.system.coordinates.iter().zip(&levels[0]) {
            symbols[coordinate.position.index()] = *value;
        }
        let values = crate::magnitude::values(graph, &self.position, &symbols);
        let coordinates = self.system.coordinates.iter();
        let columns: Vec<f64> = coordinates
            .map(|it| self.system.scale(it.quantity))
            .collect();
        let rows = self.system.rows.iter();
        let rows: Vec<f64> = rows.map(|it| self.system.scale(it.quantity)).collect();
        let n = self.count();
        let mut matrix = DMatrix::zeros(n, n);
        for (index, row) in self.system.rows.iter().enumerate() {
            for entry in &row.jacobian {
                let scale = columns[entry.coordinate] / rows[index];
                matrix[(index, entry.coordinate)] = values[entry.value.index()] * scale;
            }
        }
        let lu = matrix.lu();
        let is_negative = lu.determinant() < 0.0;
        let inverse = lu.try_inverse()?;
        let entry =
            |row: usize, column: usize| inverse[(row, column)].abs() * columns[row] / rows[column];
        let inverse = (0..n).map(|row| (0..n).map(|column| entry(row, column)).collect());
        Some(Exact {
            levels: levels.map(|level| level.into_iter().map(Precise::from_f64).collect()),
            inverse: inverse.collect(),
            is_negative,
        })
    }

    /// The largest rounding error of a residual at a pose, in the scales of the rows: below it no solver can tell poses apart.
    pub fn rounding(&self, given: &Given, q: &[f64], epsilon: f64) -> f64 {
        let mut symbols = self.symbols(given, Bounded::exact);
        for (coordinate, value) in self.system.coordinates.iter().zip(q) {
            symbols[coordinate.position.index()] = Bounded::exact(*value);
        }
        let graph = &self.system.mechanism.graph;
        let found = bounds(graph, &self.residual, &symbols, epsilon);
        let rows = self.system.rows.iter();
        rows.map(|row| found[row.residual.index()].error / self.system.scale(row.quantity))
            .fold(0.0, f64::max)
    }

    /// By how much q, q̇ and q̈ may be off in a scalar with this ε. `length` is what residuals in m are judged against.
    pub fn bounds(&self, given: &Given, exact: &Exact, length: f64, epsilon: f64) -> Levels<f64> {
        let graph = &self.system.mechanism.graph;
        let scales = self.scales(length);
        let mut symbols = self.symbols(given, Bounded::exact);
        let at = |level: usize| -> Vec<f64> {
            exact.levels[level].iter().map(Precise::to_f64).collect()
        };
        let (q, qd, qdd) = (at(0), at(1), at(2));
        let place = |symbols: &mut Vec<Bounded>, level: usize, values: &[f64], errors: &[f64]| {
            for (index, coordinate) in self.system.coordinates.iter().enumerate() {
                let symbol = [coordinate.position, coordinate.rate][level];
                symbols[symbol.index()] = Bounded {
                    value: values[index],
                    error: errors[index],
                };
            }
        };
        let spread = |rows: &[f64], own: &[f64]| -> Vec<f64> {
            let sums = exact.inverse.iter().map(|row| {
                let terms = row.iter().zip(rows).filter(|(_, error)| **error > 0.0);
                terms.map(|(entry, error)| entry * error).sum::<f64>()
            });
            // Elimination and Newton-Raphson mix the coordinates: none is more exact than the largest, measured in their scales.
            let largest = own
                .iter()
                .zip(&scales)
                .map(|(value, scale)| value.abs() / scale);
            let largest = largest.fold(0.0, f64::max);
            let own = scales.iter().map(|scale| epsilon * scale * largest);
            sums.zip(own)
                .map(|(sum, own)| FACTOR * (sum + own))
                .collect()
        };
        let n = self.count();
        place(&mut symbols, 0, &q, &vec![0.0; n]);
        let found = bounds(graph, &self.all, &symbols, epsilon);
        let rows = self.system.rows.iter();
        let errors: Vec<f64> = rows
            .map(|row| {
                let scale = length.powi(row.quantity.power_of_length());
                found[row.residual.index()].error + LEVEL * epsilon * scale
            })
            .collect();
        let position = spread(&errors, &q);
        place(&mut symbols, 0, &q, &position);
        let found = bounds(graph, &self.all, &symbols, epsilon);
        let linear = |found: &[Bounded], right: ExprId, row: usize, rates: &[f64]| {
            let entries = self.system.rows[row].jacobian.iter();
            let matrix: f64 = entries
                .map(|entry| {
                    let value = found[entry.value.index()];
                    let rounding = n as f64 * epsilon * value.value.abs();
                    (value.error + rounding) * rates[entry.coordinate].abs()
                })
                .sum();
            matrix + found[right.index()].error
        };
        let rows = || self.system.rows.iter().enumerate();
        let errors: Vec<f64> = rows()
            .map(|(index, row)| linear(&found, row.time_derivative, index, &qd))
            .collect();
        let velocity = spread(&errors, &qd);
        place(&mut symbols, 1, &qd, &velocity);
        let found = bounds(graph, &self.all, &symbols, epsilon);
        let errors: Vec<f64> = rows()
            .map(|(index, row)| linear(&found, row.gamma, index, &qdd))
            .collect();
        let acceleration = spread(&errors, &qdd);
        [position, velocity, acceleration]
    }

    /// The largest scaled residual of an exact pose, in f64: what is left in 384 bits.
    pub fn residual(&self, given: &Given, q: &[Precise]) -> f64 {
        let mut symbols = self.symbols(given, Precise::from_f64);
        self.place(&mut symbols, 0, q);
        let values = values(&self.system.mechanism.graph, &self.residual, &symbols);
        let rows = self.system.rows.iter();
        rows.map(|row| values[row.residual.index()].to_f64().abs())
            .fold(0.0, f64::max)
    }
}
