//! Evaluates many expressions for given values of symbols at once.

use super::plane::Point;
use crate::expr::{ExprId, Graph, SymbolId, Tape};
use crate::joint::geometry::Vector;
use crate::system::System;

/// Number of points of a curve.
const SAMPLES: usize = 180;

/// Points of a curve at even steps of its parameter.
pub(super) fn sampled(
    graph: &Graph,
    point: Vector,
    parameter: SymbolId,
    [from, to]: [f64; 2],
    values: &[f64],
) -> Vec<Point> {
    let tape = Tape::new(graph, &point);
    let mut values = values.to_vec();
    let mut workspace = Vec::new();
    let sample = |place: usize| {
        values[parameter.index()] = from + (to - from) * place as f64 / SAMPLES as f64;
        let mut point = [0.0; 2];
        tape.evaluate(&values, &mut workspace, &mut point);
        point
    };
    (0..=SAMPLES).map(sample).collect()
}

/// Expressions that are evaluated together.
#[derive(Debug, Default)]
pub(super) struct Numbers {
    roots: Vec<ExprId>,
}

impl Numbers {
    /// Adds an expression and returns its index.
    pub fn one(&mut self, root: ExprId) -> usize {
        self.roots.push(root);
        self.roots.len() - 1
    }

    pub fn pair(&mut self, vector: Vector) -> [usize; 2] {
        vector.map(|part| self.one(part))
    }

    /// Adds the x, y and φ of every body and returns their indices.
    pub fn places(&mut self, system: &System) -> Vec<[usize; 3]> {
        let frames = system.mechanism.bodies.iter().map(|body| body.frame);
        frames
            .map(|frame| {
                let [x, y] = self.pair(frame.origin);
                [x, y, self.one(frame.angle)]
            })
            .collect()
    }

    /// All values for those of the symbols.
    pub fn evaluate(&self, graph: &Graph, values: &[f64]) -> Vec<f64> {
        let mut values = values.to_vec();
        values.resize(graph.symbol_count(), 0.0);
        let mut numbers = vec![0.0; self.roots.len()];
        Tape::new(graph, &self.roots).evaluate(&values, &mut Vec::new(), &mut numbers);
        numbers
    }
}
