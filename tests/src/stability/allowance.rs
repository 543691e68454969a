//! Bounds the error of any solution method around the exact motion, whatever operations it performs.
//!
//! To first order the bound is condition × rounding: |Φ_q⁻¹| times the running errors of the rows and the residual
//! that Newton-Raphson accepts as rounding. ε of the largest coordinate is added, as elimination and closed forms mix
//! the coordinates. A factor stands for unknown operations. For known ones, [`super::dense`] and [`super::blocks`]
//! are sharper.

use linkwright_codegen::stages::expr::ExprId;
use linkwright_codegen::stages::system::Row;

use super::bounded::{Margin, errors};
use super::precise::{Nodes, Precise};
use super::truth::{Exact, Given, Levels, Truth};
use super::verdict::Scalar;

/// Factor for unknown operations.
const FACTOR: f64 = 16.0;

/// Rounding level of a scaled residual in the solver, in ε.
const LEVEL: f64 = linkwright::generated::newton::ROUNDING;

impl Truth {
    /// Bounds on the error of q, q̇ and q̈ in a scalar. `length` is the scale of residuals in m.
    pub fn allowance(
        &self,
        given: &Given,
        exact: &Exact,
        length: f64,
        scalar: Scalar,
    ) -> Levels<f64> {
        let graph = &self.derived.pool.graph;
        let epsilon = scalar.epsilon();
        let n = self.count();
        let scales = self.scales(length);
        let values = exact
            .levels
            .each_ref()
            .map(|level| level.iter().map(Precise::to_f64).collect::<Vec<f64>>());
        let mut symbols = given.symbols(&self.derived, Precise::from_f64);
        for (place, coordinate) in self.derived.system.coordinates.iter().enumerate() {
            symbols[coordinate.position.index()] = exact.levels[0][place].clone();
            symbols[coordinate.rate.index()] = exact.levels[1][place].clone();
        }
        let mut nodes = Nodes::new(graph);
        nodes.evaluate(graph, &self.all, &symbols);
        let rows_at = |pose: &[f64], rates: &[f64]| {
            let mut margins = vec![Margin::NONE; graph.symbol_count()];
            let coordinates = self.derived.system.coordinates.iter();
            for ((coordinate, pose), rate) in coordinates.zip(pose).zip(rates) {
                margins[coordinate.position.index()] = Margin::even(*pose);
                margins[coordinate.rate.index()] = Margin::even(*rate);
            }
            errors(graph, &self.all, &nodes.rounded, &margins, scalar)
        };
        let spread = |rows: &[f64], own: &[f64]| -> Vec<f64> {
            let sums = exact.inverse.iter().map(|row| {
                let terms = row.iter().zip(rows).filter(|(_, error)| **error > 0.0);
                terms.map(|(entry, error)| entry.abs() * error).sum::<f64>()
            });
            let largest = own.iter().zip(&scales);
            let largest = largest
                .map(|(value, scale)| value.abs() / scale)
                .fold(0.0, f64::max);
            sums.zip(&scales)
                .map(|(sum, scale)| FACTOR * (sum + epsilon * scale * largest))
                .collect()
        };
        let still = vec![0.0; n];
        let row_errors = rows_at(&still, &still);
        let rows = || self.derived.system.rows.iter();
        let residuals: Vec<f64> = rows()
            .map(|row| {
                let scale = length.powi(row.quantity.power_of_length());
                2.0 * row_errors[row.residual.index()].worst + LEVEL * epsilon * scale
            })
            .collect();
        let pose = spread(&residuals, &values[0]);
        let linear =
            |row_errors: &[Margin], right: fn(&Row) -> ExprId, rates: &[f64]| -> Vec<f64> {
                let sums = rows().map(|row| {
                    let entries = row.jacobian.iter().map(|entry| {
                        let rounding =
                            n as f64 * epsilon * nodes.rounded[entry.value.index()].abs();
                        let off = 2.0 * row_errors[entry.value.index()].worst + rounding;
                        off * rates[entry.coordinate].abs()
                    });
                    entries.sum::<f64>() + 2.0 * row_errors[right(row).index()].worst
                });
                sums.collect()
            };
        let row_errors = rows_at(&pose, &still);
        let velocity = linear(&row_errors, |row| row.time_derivative, &values[1]);
        let velocity = spread(&velocity, &values[1]);
        let row_errors = rows_at(&pose, &velocity);
        let acceleration = linear(&row_errors, |row| row.gamma, &values[2]);
        let acceleration = spread(&acceleration, &values[2]);
        [pose, velocity, acceleration]
    }
}
