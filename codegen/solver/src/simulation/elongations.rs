//! Evaluates lengths and relative angles of springs and dampers, and formulas whose rates other loads mention, with derivatives.
//!
//! A strong damper acts on one of these like a joint, and so does a load with such a formula. If the elongation is a coordinate of a
//! chart, the stiff direction does not turn.

use linkwright_codegen::stages::expr::ExprId;
use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::system::System;
use nalgebra::DMatrix;

use crate::instant::{Instant, Layout};
use crate::reader::Reader;

/// Elongations of a mechanism.
#[derive(Clone, Debug)]
pub(super) struct Elongations {
    /// Evaluator, for each elongation, of its value and its acceleration without accelerations of the unknowns; then of derivatives.
    reader: Reader,
    entries: Vec<(usize, usize)>,
    /// Unit of each elongation.
    scales: Vec<f64>,
}

/// Elongations at an instant, in lengths of the mechanism.
pub(super) struct Elongated {
    /// Values.
    pub values: Vec<f64>,
    /// Accelerations if those of the unknowns are zero.
    pub bends: Vec<f64>,
    /// Derivatives by all unknowns in characteristic lengths, one row per elongation.
    pub gradients: DMatrix<f64>,
}

impl Elongations {
    /// Returns the elongations of a system that depend on its coordinates alone.
    pub fn of(pool: &mut Pool, system: &System, layout: &Layout) -> Elongations {
        let forces = system.forces.clone();
        let (lengths, rated) = forces.map(|it| (it.lengths, it.rated)).unwrap_or_default();
        let length = system.characteristic_length(pool);
        let mut elongations: Vec<(ExprId, f64)> =
            lengths.into_iter().map(|(_, own)| (own, length)).collect();
        for load in system.mechanism.forces.loads.clone() {
            let marks = load.element.marks();
            let Some((first, others)) = marks.split_first() else {
                continue;
            };
            let others = others.iter().map(|it| it.frame);
            for other in others.filter(|it| it.body != first.frame.body) {
                let graph = &mut pool.graph;
                elongations.push((graph.subtract(other.angle, first.frame.angle), 1.0));
            }
        }
        // The gradient of a formula scales it, so that its unit does not matter.
        for it in rated {
            let formula = pool.graph.substitute(it.formula, &it.arms);
            elongations.push((formula, 1.0));
        }
        let coordinates = system.coordinates.to_vec();
        let mechanism = &system.mechanism;
        let mut outside = vec![mechanism.time];
        outside.extend(mechanism.inputs.iter().flat_map(|it| it.symbols));
        let (mut values, mut bends, mut scales) = (Vec::new(), Vec::new(), Vec::new());
        let (mut entries, mut gradients) = (Vec::new(), Vec::new());
        for (formula, scale) in elongations {
            let expression = pool.written_out(formula);
            let graph = &mut pool.graph;
            let zero = graph.zero();
            if outside
                .iter()
                .any(|it| graph.derivative(expression, *it) != zero)
            {
                continue;
            }
            let along = |of: ExprId, graph: &mut linkwright_codegen::stages::expr::Graph| {
                let parts = coordinates.iter().map(|it| {
                    let by = graph.derivative(of, it.position);
                    let rate = graph.variable(it.rate);
                    graph.multiply(by, rate)
                });
                let parts: Vec<ExprId> = parts.collect();
                graph.sum(&parts)
            };
            let rate = along(expression, graph);
            bends.push(along(rate, graph));
            for (column, it) in coordinates.iter().enumerate() {
                let by = graph.derivative(expression, it.position);
                if by != zero {
                    entries.push((values.len(), column));
                    gradients.push(by);
                }
            }
            values.push(expression);
            scales.push(scale);
        }
        values.extend(bends);
        values.extend(gradients);
        Elongations {
            reader: Reader::new(&pool.graph, layout, &values),
            entries,
            scales,
        }
    }

    /// True without elongations.
    pub fn is_empty(&self) -> bool {
        self.scales.is_empty()
    }

    /// Returns the elongations at an instant; `scales` are the units of the unknowns.
    pub fn at(&self, instant: &Instant, scales: &[f64]) -> Elongated {
        let values = self.reader.values(instant);
        let count = self.scales.len();
        let part = |from: usize| {
            let scaled = values[from..from + count].iter().zip(&self.scales);
            scaled.map(|(it, scale)| it / scale).collect()
        };
        let mut gradients = DMatrix::zeros(count, scales.len());
        for (&(row, column), value) in self.entries.iter().zip(&values[2 * count..]) {
            gradients[(row, column)] = value * scales[column] / self.scales[row];
        }
        Elongated {
            values: part(0),
            bends: part(count),
            gradients,
        }
    }
}
