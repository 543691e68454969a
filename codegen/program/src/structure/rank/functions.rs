//! Evaluates residuals and Jacobians of selected rows and coordinates.
//!
//! All values are dimensionless: lengths in characteristic lengths, angles in radians. Rows are divided by the magnitude of their
//! gradients in the pose from which a search starts.

use crate::expr::{ExprId, SymbolId, Tape};
use crate::joint::Quantity;
use crate::model::Role;
use crate::pool::Pool;
use crate::system::System;

/// Values of all symbols, by their index, with shifted drivers.
#[derive(Clone, Debug)]
pub(super) struct Pose {
    /// Values of the symbols of the graph.
    pub symbols: Vec<f64>,
    /// Shift of each driver's residual, in its own scale.
    pub shift: f64,
}

/// Residuals and gradients of selected rows in selected coordinates.
#[derive(Debug)]
pub(super) struct Functions<'a> {
    system: &'a System,
    /// Rows: indices into `rows` and then `monitored` of the system.
    pub rows: Vec<usize>,
    /// Coordinates, the columns of the Jacobian.
    pub columns: Vec<usize>,
    residual: Tape,
    jacobian: Tape,
    places: Vec<[usize; 2]>,
    /// Unit of lengths, in m.
    length: f64,
}

impl<'a> Functions<'a> {
    pub fn new(
        pool: &Pool,
        system: &'a System,
        rows: Vec<usize>,
        columns: Vec<usize>,
    ) -> Functions<'a> {
        Functions::measured_in(
            system.characteristic_length(pool),
            pool,
            system,
            rows,
            columns,
        )
    }

    /// Selects rows and coordinates with a known characteristic length, which saves its repeated computation.
    pub fn measured_in(
        length: f64,
        pool: &Pool,
        system: &'a System,
        rows: Vec<usize>,
        columns: Vec<usize>,
    ) -> Functions<'a> {
        let graph = &pool.graph;
        let residuals: Vec<ExprId> = rows.iter().map(|&at| system.row(at).residual).collect();
        let (mut entries, mut places) = (Vec::new(), Vec::new());
        for (place, &at) in rows.iter().enumerate() {
            for entry in &system.row(at).jacobian {
                if let Ok(column) = columns.binary_search(&entry.coordinate) {
                    entries.push(entry.value);
                    places.push([place, column]);
                }
            }
        }
        Functions {
            system,
            residual: Tape::new(graph, &residuals),
            jacobian: Tape::new(graph, &entries),
            places,
            rows,
            columns,
            length,
        }
    }

    /// Returns the residuals, in the scale of each row.
    pub fn residuals(&self, pose: &Pose) -> Vec<f64> {
        let mut values = vec![0.0; self.rows.len()];
        self.residual
            .evaluate(&pose.symbols, &mut Vec::new(), &mut values);
        for (value, &at) in values.iter_mut().zip(&self.rows) {
            let row = self.system.row(at);
            *value /= self.scale(row.quantity);
            if self.system.mechanism.joints[row.joint].role == Role::Driver {
                // Different shifts of the drivers prevent accidental consistency.
                *value -= pose.shift * (1.0 + 0.3 * spread(at, 0));
            }
        }
        values
    }

    /// Returns the gradients of the residuals, one row each.
    pub fn jacobian(&self, pose: &Pose) -> Vec<Vec<f64>> {
        let mut entries = vec![0.0; self.places.len()];
        self.jacobian
            .evaluate(&pose.symbols, &mut Vec::new(), &mut entries);
        let mut matrix = vec![vec![0.0; self.columns.len()]; self.rows.len()];
        for (&[place, column], entry) in self.places.iter().zip(entries) {
            let of = self.system.row(self.rows[place]).quantity;
            let by = self.column_scale(column);
            matrix[place][column] = entry * by / self.scale(of);
        }
        matrix
    }

    /// Returns the unit of a dimensionless coordinate.
    pub fn column_scale(&self, column: usize) -> f64 {
        let coordinate = &self.system.coordinates[self.columns[column]];
        self.scale(coordinate.quantity)
    }

    /// Returns [`System::scale`] with the known characteristic length.
    fn scale(&self, quantity: Quantity) -> f64 {
        self.length.powi(quantity.power_of_length())
    }

    /// Returns the coordinates of a pose.
    pub fn coordinates(&self, pose: &Pose) -> Vec<f64> {
        let symbols = self.symbols();
        symbols.map(|symbol| pose.symbols[symbol.index()]).collect()
    }

    /// Sets coordinates of a pose, moved by a dimensionless step. A pose has the coordinates of all blocks, so it is not copied.
    pub fn place(&self, pose: &mut Pose, coordinates: &[f64], step: &[f64]) {
        for (column, symbol) in self.symbols().enumerate() {
            let by = step[column] * self.column_scale(column);
            pose.symbols[symbol.index()] = coordinates[column] + by;
        }
    }

    fn symbols(&self) -> impl Iterator<Item = SymbolId> {
        let columns = self.columns.iter();
        columns.map(|&column| self.system.coordinates[column].position)
    }
}

/// Returns numbers between −1 and 1 without a pattern: fractional parts of multiples of irrational numbers (Weyl).
pub(super) fn spread(index: usize, series: usize) -> f64 {
    let golden = 0.618_033_988_749_894_8 * (index as f64 + 1.0);
    let plastic = 0.754_877_666_246_692_7 * (series as f64 + 1.0);
    2.0 * (golden + plastic + golden * plastic).fract() - 1.0
}
