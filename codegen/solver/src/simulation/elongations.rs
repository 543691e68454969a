//! Lengths and relative angles that springs and dampers act on, and formulas whose rates other loads mention, with their derivatives.
//!
//! A strong damper holds one of these like a joint, and so does a load whose formula is that of one. A chart that has it as a coordinate
//! sees a stiff direction that does not turn.

use linkwright_codegen::stages::expr::ExprId;
use linkwright_codegen::stages::system::System;
use nalgebra::DMatrix;

use crate::instant::{Instant, Layout};
use crate::reader::Reader;

/// The elongations of a mechanism.
#[derive(Clone, Debug)]
pub(super) struct Elongations {
    /// Of each its value and the acceleration that rates alone give it, then the derivatives by coordinates.
    reader: Reader,
    entries: Vec<(usize, usize)>,
    /// What each is measured in.
    scales: Vec<f64>,
}

/// Elongations at an instant, in lengths of the mechanism.
pub(super) struct Elongated {
    /// Values.
    pub values: Vec<f64>,
    /// Accelerations for accelerations of the unknowns that are zero.
    pub bends: Vec<f64>,
    /// Derivatives by all unknowns in characteristic lengths, a row each.
    pub gradients: DMatrix<f64>,
}

impl Elongations {
    /// Those of a system that depend on its coordinates alone.
    pub fn of(system: &mut System, layout: &Layout) -> Elongations {
        let forces = system.forces.clone();
        let (lengths, rated) = forces.map(|it| (it.lengths, it.rated)).unwrap_or_default();
        let length = system.characteristic_length();
        let mut found: Vec<(ExprId, f64)> =
            lengths.into_iter().map(|(_, own)| (own, length)).collect();
        for load in system.mechanism.forces.loads.clone() {
            let marks = load.element.marks();
            let Some((first, others)) = marks.split_first() else {
                continue;
            };
            let others = others.iter().map(|it| it.frame);
            for other in others.filter(|it| it.body != first.frame.body) {
                let graph = &mut system.mechanism.graph;
                found.push((graph.subtract(other.angle, first.frame.angle), 1.0));
            }
        }
        // A coordinate is measured by its own gradient, so that the unit of a formula does not count.
        for it in rated {
            let formula = system.mechanism.graph.substitute(it.formula, &it.arms);
            found.push((formula, 1.0));
        }
        let coordinates = system.coordinates.to_vec();
        let mechanism = &mut system.mechanism;
        let graph = &mut mechanism.graph;
        let mut outside = vec![mechanism.time];
        outside.extend(mechanism.inputs.iter().flat_map(|it| it.symbols));
        let (mut values, mut bends, mut scales) = (Vec::new(), Vec::new(), Vec::new());
        let (mut entries, mut gradients) = (Vec::new(), Vec::new());
        for (own, scale) in found {
            let own = system.vector_form.written_out(own, graph);
            let zero = graph.zero();
            if outside.iter().any(|it| graph.derivative(own, *it) != zero) {
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
            let rate = along(own, graph);
            bends.push(along(rate, graph));
            for (column, it) in coordinates.iter().enumerate() {
                let by = graph.derivative(own, it.position);
                if by != zero {
                    entries.push((values.len(), column));
                    gradients.push(by);
                }
            }
            values.push(own);
            scales.push(scale);
        }
        values.extend(bends);
        values.extend(gradients);
        Elongations {
            reader: Reader::new(graph, layout, &values),
            entries,
            scales,
        }
    }

    /// True if there are none.
    pub fn is_empty(&self) -> bool {
        self.scales.is_empty()
    }

    /// Elongations at an instant; `scales` are what the unknowns are measured in.
    pub fn at(&self, instant: &Instant, scales: &[f64]) -> Elongated {
        let values = self.reader.values(instant);
        let count = self.scales.len();
        let part = |from: usize| {
            let own = values[from..from + count].iter().zip(&self.scales);
            own.map(|(it, scale)| it / scale).collect()
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
