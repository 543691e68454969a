//! Evaluates many expressions for given values of symbols at once.

use super::plane::{Point, distance_to_segment};
use crate::expr::{ExprId, Graph, SymbolId, Tape};
use crate::joint::geometry::Vector;
use crate::system::System;

/// Number of points of a curve.
const SAMPLES: usize = 180;

/// Number of times that a piece of a curve is halved at most.
const HALVINGS: usize = 12;

/// Points of a curve at even steps of its parameter. Pieces are halved until the curve lies within `deviation` (m) of the chords, if
/// there is one.
pub(super) fn sampled(
    graph: &Graph,
    point: Vector,
    parameter: SymbolId,
    [from, to]: [f64; 2],
    values: &[f64],
    deviation: Option<f64>,
) -> Vec<Point> {
    let tape = Tape::new(graph, &point);
    let mut values = values.to_vec();
    let mut workspace = Vec::new();
    let mut at = |value: f64| {
        values[parameter.index()] = value;
        let mut point = [0.0; 2];
        tape.evaluate(&values, &mut workspace, &mut point);
        point
    };
    let value = |place: usize| from + (to - from) * place as f64 / SAMPLES as f64;
    let Some(deviation) = deviation else {
        return (0..=SAMPLES).map(|place| at(value(place))).collect();
    };
    let mut points = vec![at(from)];
    for place in 0..SAMPLES {
        let ends = [place, place + 1].map(value);
        halve(&mut at, ends, deviation, HALVINGS, &mut points);
    }
    points
}

/// Adds the points of a piece of a curve behind its first one.
fn halve(
    at: &mut impl FnMut(f64) -> Point,
    [from, to]: [f64; 2],
    deviation: f64,
    halvings: usize,
    points: &mut Vec<Point>,
) {
    let middle = 0.5 * (from + to);
    let [first, last] = [from, to].map(&mut *at);
    // Three points, since an inflection may lie on the chord.
    let inside = [0.5 * (from + middle), middle, 0.5 * (middle + to)].map(&mut *at);
    let is_close = |it: &Point| distance_to_segment(*it, [first, last]) <= deviation;
    if halvings == 0 || inside.iter().all(is_close) {
        points.push(last);
        return;
    }
    halve(at, [from, middle], deviation, halvings - 1, points);
    halve(at, [middle, to], deviation, halvings - 1, points);
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
