//! *The exact motion* → *how far any way to solve the equations may be off*, whatever operations it performs.
//!
//! To first order condition × rounding: |Φ_q⁻¹| times the running errors of the rows and what Newton-Raphson lets pass as
//! rounding, and ε of the largest coordinate, as elimination and closed forms mix the coordinates. A factor stands for the
//! operations that are not known. Where they are known, [`super::dense`] and [`super::blocks`] say more.

use linkwright_codegen::stages::expr::ExprId;
use linkwright_codegen::stages::system::Row;

use super::bounded::{Margin, errors};
use super::precise::{Nodes, Precise};
use super::truth::{Exact, Given, Levels, Truth};
use super::verdict::Scalar;

/// For the operations that are not known.
const FACTOR: f64 = 16.0;

/// What the solver takes for rounding in a scaled residual, in ε.
const LEVEL: f64 = linkwright::newton::ROUNDING;

impl Truth {
    /// By how much q, q̇ and q̈ may be off in a scalar. `length` is what residuals in m are judged against.
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
        let found = rows_at(&still, &still);
        let rows = || self.derived.system.rows.iter();
        let residuals: Vec<f64> = rows()
            .map(|row| {
                let scale = length.powi(row.quantity.power_of_length());
                2.0 * found[row.residual.index()].worst + LEVEL * epsilon * scale
            })
            .collect();
        let pose = spread(&residuals, &values[0]);
        let linear = |found: &[Margin], right: fn(&Row) -> ExprId, rates: &[f64]| -> Vec<f64> {
            let sums = rows().map(|row| {
                let entries = row.jacobian.iter().map(|entry| {
                    let rounding = n as f64 * epsilon * nodes.rounded[entry.value.index()].abs();
                    let off = 2.0 * found[entry.value.index()].worst + rounding;
                    off * rates[entry.coordinate].abs()
                });
                entries.sum::<f64>() + 2.0 * found[right(row).index()].worst
            });
            sums.collect()
        };
        let found = rows_at(&pose, &still);
        let velocity = linear(&found, |row| row.time_derivative, &values[1]);
        let velocity = spread(&velocity, &values[1]);
        let found = rows_at(&pose, &velocity);
        let acceleration = linear(&found, |row| row.gamma, &values[2]);
        let acceleration = spread(&acceleration, &values[2]);
        [pose, velocity, acceleration]
    }
}
