//! Pose, velocity and acceleration of a description in 384 bits, and bounds on their error in floating point.
//!
//! The pose is solved by Newton-Raphson in high precision. [`Truth::bounds`] bounds the error of the textbook
//! formulation ([`super::dense`]); [`super::blocks`] bounds that of the solved formulation.

use linkwright_codegen::stages::expr::{ExprId, Tape};
use linkwright_codegen::stages::system::{Derived, Row};
use nalgebra::DMatrix;

use super::bounded::{Margin, errors};
use super::dense::{Bounds, Dense, Evaluated};
use super::precise::{Factors, Nodes, Precise, values};
use super::verdict::Scalar;
use crate::magnitude::needed;

/// Newton-Raphson steps in high precision: near a double root each one gains one bit.
const STEPS: usize = 200;

/// q, q̇ and q̈.
pub type Levels<T> = [Vec<T>; 3];

/// Equations of a mechanism, for exact solution.
pub struct Truth {
    /// The system.
    pub derived: Derived,
    /// Nodes that Φ needs, and nodes that Φ and Φ_q need.
    residual: Vec<ExprId>,
    position: Vec<ExprId>,
    pub(super) all: Vec<ExprId>,
}

/// Inputs of the equations at one instant: parameters, signals and the time.
#[derive(Clone, Debug, Default)]
pub struct Given {
    /// Parameters, in written order.
    pub parameters: Vec<f64>,
    /// Value, rate and acceleration of each signal, in written order.
    pub signals: Vec<[f64; 3]>,
    /// Time (s).
    pub t: f64,
}

impl Given {
    /// Value for each symbol; those of the coordinates are set later.
    pub fn symbols<T: Clone>(&self, derived: &Derived, number: impl Fn(f64) -> T) -> Vec<T> {
        let mechanism = &derived.system.mechanism;
        let mut symbols = vec![number(0.0); derived.pool.graph.symbol_count()];
        for (parameter, value) in mechanism.parameters.iter().zip(&self.parameters) {
            symbols[parameter.symbol.index()] = number(*value);
        }
        for (input, signal) in mechanism.inputs.iter().zip(&self.signals) {
            for (symbol, value) in input.symbols.iter().zip(signal) {
                symbols[symbol.index()] = number(*value);
            }
        }
        symbols[mechanism.time.index()] = number(self.t);
        symbols
    }
}

/// Exact motion at one instant.
#[derive(Clone, Debug)]
pub struct Exact {
    /// q, q̇ and q̈.
    pub levels: Levels<Precise>,
    /// Inverse Jacobian, row by row.
    pub(super) inverse: Vec<Vec<f64>>,
    /// True if the determinant of Φ_q is negative.
    pub is_negative: bool,
}

impl Truth {
    /// Equations of a system, which must be square.
    pub fn new(derived: &Derived) -> Truth {
        let residual: Vec<ExprId> = derived.system.rows.iter().map(|row| row.residual).collect();
        let entries = derived.system.rows.iter().flat_map(|row| {
            let entries = row.jacobian.iter().map(|entry| entry.value);
            entries.chain([row.residual, row.time_derivative, row.gamma])
        });
        let all: Vec<ExprId> = entries.collect();
        let entries = derived.system.rows.iter().flat_map(|row| &row.jacobian);
        let mut position = residual.clone();
        position.extend(entries.map(|entry| entry.value));
        Truth {
            residual: needed(&derived.pool.graph, &residual),
            position: needed(&derived.pool.graph, &position),
            all: needed(&derived.pool.graph, &all),
            derived: derived.clone(),
        }
    }

    /// Number of coordinates.
    pub fn count(&self) -> usize {
        self.derived.system.coordinates.len()
    }

    /// Magnitude of each coordinate: the characteristic length, and 1 for angles.
    pub fn scales(&self, length: f64) -> Vec<f64> {
        let coordinates = self.derived.system.coordinates.iter();
        coordinates
            .map(|it| length.powi(it.quantity.power_of_length()))
            .collect()
    }

    /// Characteristic length with these parameters (m).
    pub fn length(&self, given: &Given) -> f64 {
        let symbols = given.symbols(&self.derived, |value| value);
        let mut lengths = vec![0.0; self.derived.system.lengths.len()];
        let tape = Tape::new(&self.derived.pool.graph, &self.derived.system.lengths);
        tape.evaluate(&symbols, &mut Vec::new(), &mut lengths);
        let largest = lengths
            .iter()
            .fold(0.0_f64, |largest, it| largest.max(it.abs()));
        if largest > 0.0 && largest.is_finite() {
            largest
        } else {
            self.derived.system.mechanism.characteristic_length
        }
    }

    fn matrix(&self, values: &[Precise]) -> Vec<Vec<Precise>> {
        let mut rows = vec![vec![Precise::from_f64(0.0); self.count()]; self.count()];
        for (row, entries) in self.derived.system.rows.iter().zip(&mut rows) {
            for entry in &row.jacobian {
                entries[entry.coordinate] = values[entry.value.index()].clone();
            }
        }
        rows
    }

    /// Motion on the path to which Newton-Raphson in high precision leads from `start` without changing the sign of
    /// the determinant; `None` if it diverges, or if the solution is singular.
    pub fn solve(&self, given: &Given, start: &[Precise]) -> Option<Exact> {
        let (symbols, q, factors) = self.converge(given, start, 1e-90)?;
        Some(self.complete(symbols, q, &factors))
    }

    /// Solution pose to 20 digits, as a start.
    pub fn approach(&self, given: &Given, start: &[Precise]) -> Option<Vec<Precise>> {
        let (_, q, _) = self.converge(given, start, 1e-10)?;
        Some(q)
    }

    /// Symbols, pose and Jacobian once a step is below `limit`.
    fn converge(
        &self,
        given: &Given,
        start: &[Precise],
        limit: f64,
    ) -> Option<(Vec<Precise>, Vec<Precise>, Factors)> {
        let graph = &self.derived.pool.graph;
        let mut symbols = given.symbols(&self.derived, Precise::from_f64);
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
            let rows = self.derived.system.rows.iter();
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
        for (coordinate, value) in self.derived.system.coordinates.iter().zip(values) {
            let symbol = [coordinate.position, coordinate.rate][level];
            symbols[symbol.index()] = value.clone();
        }
    }

    fn complete(&self, mut symbols: Vec<Precise>, q: Vec<Precise>, factors: &Factors) -> Exact {
        let graph = &self.derived.pool.graph;
        let zero = Precise::from_f64(0.0);
        let values_at = |symbols: &[Precise]| values(graph, &self.all, symbols);
        let before = values_at(&symbols);
        let rows = || self.derived.system.rows.iter();
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
                inverse[row][column] = entry.to_f64();
            }
        }
        Exact {
            levels: [q, qd, qdd],
            inverse,
            is_negative: factors.is_negative,
        }
    }

    /// Data of [`Truth::bounds`] at a pose that is known to rounding and taken for the exact one; `None` if its
    /// Jacobian is singular. Unlike [`Truth::solve`] this takes no arithmetic of high precision.
    pub fn around(&self, given: &Given, levels: Levels<f64>) -> Option<Exact> {
        let graph = &self.derived.pool.graph;
        let mut symbols = given.symbols(&self.derived, |number| number);
        for (coordinate, value) in self.derived.system.coordinates.iter().zip(&levels[0]) {
            symbols[coordinate.position.index()] = *value;
        }
        let values = crate::magnitude::values(graph, &self.position, &symbols);
        let coordinates = self.derived.system.coordinates.iter();
        let columns: Vec<f64> = coordinates
            .map(|it| self.derived.system.scale(it.quantity, &self.derived.pool))
            .collect();
        let rows = self.derived.system.rows.iter();
        let rows: Vec<f64> = rows
            .map(|it| self.derived.system.scale(it.quantity, &self.derived.pool))
            .collect();
        let n = self.count();
        let mut matrix = DMatrix::zeros(n, n);
        for (index, row) in self.derived.system.rows.iter().enumerate() {
            for entry in &row.jacobian {
                let scale = columns[entry.coordinate] / rows[index];
                matrix[(index, entry.coordinate)] = values[entry.value.index()] * scale;
            }
        }
        let lu = matrix.lu();
        let is_negative = lu.determinant() < 0.0;
        let inverse = lu.try_inverse()?;
        let entry =
            |row: usize, column: usize| inverse[(row, column)] * columns[row] / rows[column];
        let inverse = (0..n).map(|row| (0..n).map(|column| entry(row, column)).collect());
        Some(Exact {
            levels: levels.map(|level| level.into_iter().map(Precise::from_f64).collect()),
            inverse: inverse.collect(),
            is_negative,
        })
    }

    /// Largest error of a residual at a pose, in the scales of the rows, by the rounding of its terms and of the
    /// coordinates. Below it no solver can tell poses apart.
    pub fn rounding(&self, given: &Given, q: &[f64], scalar: Scalar) -> f64 {
        let graph = &self.derived.pool.graph;
        let mut symbols = given.symbols(&self.derived, |number| number);
        let mut margins = vec![Margin::NONE; graph.symbol_count()];
        for (coordinate, value) in self.derived.system.coordinates.iter().zip(q) {
            symbols[coordinate.position.index()] = *value;
            margins[coordinate.position.index()] = scalar.rounding(*value);
        }
        let values = crate::magnitude::values(graph, &self.residual, &symbols);
        let node_errors = errors(graph, &self.residual, &values, &margins, scalar);
        let rows = self.derived.system.rows.iter();
        rows.map(|row| {
            node_errors[row.residual.index()].worst
                / self.derived.system.scale(row.quantity, &self.derived.pool)
        })
        .fold(0.0, f64::max)
    }

    /// Bounds on the error of q, q̇ and q̈ of the textbook formulation in a scalar. `length` is the scale of
    /// residuals in m.
    pub fn bounds(&self, given: &Given, exact: &Exact, length: f64, scalar: Scalar) -> Bounds {
        let graph = &self.derived.pool.graph;
        let mut symbols = given.symbols(&self.derived, Precise::from_f64);
        self.place(&mut symbols, 0, &exact.levels[0]);
        self.place(&mut symbols, 1, &exact.levels[1]);
        let mut nodes = Nodes::new(graph);
        nodes.evaluate(graph, &self.all, &symbols);
        self.bounds_at(&nodes.rounded, exact, length, scalar)
    }

    /// Bounds around a pose from [`Truth::around`], in f64, for each value.
    pub fn bounds_around(&self, given: &Given, exact: &Exact, length: f64) -> Levels<f64> {
        let graph = &self.derived.pool.graph;
        let mut symbols = given.symbols(&self.derived, |number| number);
        for (place, coordinate) in self.derived.system.coordinates.iter().enumerate() {
            let level_symbols = [coordinate.position, coordinate.rate];
            for (level, symbol) in level_symbols.into_iter().enumerate() {
                symbols[symbol.index()] = exact.levels[level][place].to_f64();
            }
        }
        let values = crate::magnitude::values(graph, &self.all, &symbols);
        let bounds = self.bounds_at(&values, exact, length, Scalar::F64);
        bounds
            .levels
            .map(|level| level.into_iter().map(|margin| margin.worst).collect())
    }

    /// Bounds with these values of the nodes.
    fn bounds_at(&self, values: &[f64], exact: &Exact, length: f64, scalar: Scalar) -> Bounds {
        let graph = &self.derived.pool.graph;
        let n = self.count();
        let rows = || self.derived.system.rows.iter();
        let mut jacobian = vec![vec![0.0; n]; n];
        for (row, entries) in rows().zip(&mut jacobian) {
            for entry in &row.jacobian {
                entries[entry.coordinate] = values[entry.value.index()];
            }
        }
        let dense = Dense {
            jacobian,
            inverse: exact.inverse.clone(),
            rows: rows()
                .map(|row| length.powi(row.quantity.power_of_length()))
                .collect(),
            columns: self.scales(length),
            levels: [0, 1, 2]
                .map(|level: usize| exact.levels[level].iter().map(Precise::to_f64).collect()),
        };
        let evaluate = |pose: &[Margin], rates: &[Margin]| {
            let mut margins = vec![Margin::NONE; graph.symbol_count()];
            let coordinates = self.derived.system.coordinates.iter();
            for ((coordinate, pose), rate) in coordinates.zip(pose).zip(rates) {
                margins[coordinate.position.index()] = *pose;
                margins[coordinate.rate.index()] = *rate;
            }
            let node_errors = errors(graph, &self.all, values, &margins, scalar);
            let of = |pick: fn(&Row) -> ExprId| -> Vec<Margin> {
                rows().map(|row| node_errors[pick(row).index()]).collect()
            };
            let mut jacobian = vec![vec![Margin::NONE; n]; n];
            for (row, entries) in rows().zip(&mut jacobian) {
                for entry in &row.jacobian {
                    entries[entry.coordinate] = node_errors[entry.value.index()];
                }
            }
            Evaluated {
                residuals: of(|row| row.residual),
                jacobian,
                drift: of(|row| row.time_derivative),
                gamma: of(|row| row.gamma),
            }
        };
        dense.bounds(scalar, &evaluate)
    }

    /// Largest scaled residual of an exact pose, in f64, as evaluated in 384 bits.
    pub fn residual(&self, given: &Given, q: &[Precise]) -> f64 {
        let mut symbols = given.symbols(&self.derived, Precise::from_f64);
        self.place(&mut symbols, 0, q);
        let values = values(&self.derived.pool.graph, &self.residual, &symbols);
        let rows = self.derived.system.rows.iter();
        rows.map(|row| values[row.residual.index()].to_f64().abs())
            .fold(0.0, f64::max)
    }
}
