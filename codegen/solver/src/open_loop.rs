//! Finds the pose of a mechanism that cannot be assembled in which all joints but one hold and the gap of that one is smallest.
//!
//! The open joint is a pin of the block that fails, or else a link without a body. The weight of its equations falls while the sum of
//! squares is minimized (Nocedal and Wright 2006, section 17.1), so that in the end the others hold to rounding.

use linkwright::Equations;
use linkwright_codegen::stages::emit::drawing;
use linkwright_codegen::stages::expr::{ExprId, SymbolId, Tape};
use linkwright_codegen::stages::joint::Feature;
use linkwright_codegen::stages::joint::geometry::{BodyId, Mark};
use linkwright_codegen::stages::model::Mechanism;
use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::system::System;
use nalgebra::{DMatrix, DVector};

use crate::condition::jacobian;
use crate::interpreted::Interpreted;
use crate::textbook::TextbookEquations;
use crate::view::View;

/// Weights of the open joint relative to the others, in order.
const WEIGHTS: [f64; 5] = [1.0, 1e-1, 1e-2, 1e-3, 1e-4];

/// Largest number of iterations per weight.
const ITERATIONS: usize = 200;

/// Step, in scales of coordinates, below which an iteration ends.
const SHORTEST_STEP: f64 = 1e-12;

/// Residual of the other joints, relative to their scales, above which more than one loop is open.
const HELD: f64 = 1e-5;

/// Initial damping, and its bounds.
const DAMPING: f64 = 1e-3;
const LEAST_DAMPING: f64 = 1e-15;
const MOST_DAMPING: f64 = 1e8;

/// Mechanism with one open loop.
#[derive(Clone, Debug)]
pub struct OpenLoop {
    /// Open joint: an index into the joints.
    pub joint: usize,
    /// Its two points, in m; of a link, its free end and the point that the end does not reach.
    pub ends: [[f64; 2]; 2],
    /// Values of the time, the inputs and the coordinates.
    values: Vec<(SymbolId, f64)>,
}

impl OpenLoop {
    /// Distance of the two points, in m.
    pub fn distance(&self) -> f64 {
        let [a, b] = self.ends;
        (b[0] - a[0]).hypot(b[1] - a[1])
    }

    /// Returns the pose for a drawing.
    pub fn pose(&self, pool: &Pool) -> drawing::Pose {
        drawing::Pose::new(pool, self.values.iter().copied())
    }
}

/// Opens the loop that cannot close at the time `t` (s).
///
/// `None` if the mechanism can be assembled as drawn, if its failing block has no pin, or if opening one joint is not enough.
pub fn open_loop(view: &Interpreted, t: f64) -> Option<OpenLoop> {
    let system = view.system();
    let joint = open_joint(view, t)?;
    let equations = TextbookEquations::new(view.pool(), system);
    let mut pose = equations.estimate().clone();
    for weight in WEIGHTS {
        pose = closest(system, &equations, joint, weight, pose, t)?;
    }
    let residual = weighted(system, &equations, joint, 0.0, &pose, t);
    if residual.amax().is_nan() || residual.amax() > HELD {
        return None;
    }
    let mechanism = &system.mechanism;
    let coordinates = system.coordinates.iter().zip(pose.iter());
    let mut values: Vec<(SymbolId, f64)> = vec![(mechanism.time, t)];
    let signals = view.input_laws().at(t);
    for (input, signal) in mechanism.inputs.iter().zip(&signals.0) {
        let values_of_signal = [signal.value, signal.rate, signal.acceleration];
        values.extend(input.symbols.into_iter().zip(values_of_signal));
    }
    values.extend(coordinates.map(|(it, value)| (it.position, *value)));
    Some(OpenLoop {
        joint,
        ends: ends(view.pool(), system, joint, &values)?,
        values,
    })
}

/// Returns the last pin of the block that fails, preferably between moving bodies, or else its last link without a body.
fn open_joint(view: &Interpreted, t: f64) -> Option<usize> {
    let failure = view.assembled_as_drawn(t).err()?;
    let block = view.plan().blocks.get(usize::from(failure.block))?;
    let mechanism = &view.system().mechanism;
    let joints = &mechanism.joints;
    let is_pin = |joint: &&usize| joints[**joint].kind.joins_points();
    let pin = block.joints.iter().filter(is_pin).max_by_key(|joint| {
        let marks = joints[**joint].operands.marks.iter();
        let moving = marks.filter(|it| it.frame.body != BodyId::GROUND).count();
        (moving, **joint)
    });
    let is_link = |joint: &&usize| link_length(mechanism, **joint, view.pool()).is_some();
    pin.or_else(|| block.joints.iter().rfind(is_link)).copied()
}

/// Length of a link without a body; `None` for other joints.
fn link_length(mechanism: &Mechanism, joint: usize, pool: &Pool) -> Option<ExprId> {
    let joint = &mechanism.joints[joint];
    let feature = joint
        .kind
        .feature(&joint.operands, &mut pool.graph.clone())?;
    joint.operands.value.filter(|_| feature == Feature::Link)
}

/// Returns Φ divided by the scales of its rows; the rows of the open joint have the weight `weight`.
fn weighted(
    system: &System,
    equations: &TextbookEquations,
    open: usize,
    weight: f64,
    q: &DVector<f64>,
    t: f64,
) -> DVector<f64> {
    let mut residual = DVector::zeros(q.len());
    equations.residual(q, t, &mut residual);
    for (row, value) in residual.iter_mut().enumerate() {
        *value *= factor(system, equations, open, weight, row);
    }
    residual
}

fn factor(
    system: &System,
    equations: &TextbookEquations,
    open: usize,
    weight: f64,
    row: usize,
) -> f64 {
    let factor = if system.rows[row].joint == open {
        weight
    } else {
        1.0
    };
    factor / equations.row_scale(row)
}

/// Minimizes the sum of squares from a pose (Levenberg 1944, Marquardt 1963).
fn closest(
    system: &System,
    equations: &TextbookEquations,
    open: usize,
    weight: f64,
    start: DVector<f64>,
    t: f64,
) -> Option<DVector<f64>> {
    let order = start.len();
    let scales = DVector::from_fn(order, |column, _| equations.coordinate_scale(column));
    let (mut q, mut damping) = (start, DAMPING);
    let mut residual = weighted(system, equations, open, weight, &q, t);
    if !residual.norm().is_finite() {
        return None;
    }
    for _ in 0..ITERATIONS {
        let mut stacked = DMatrix::zeros(2 * order, order);
        let matrix = jacobian(equations, &q, t);
        for row in 0..order {
            let factor = factor(system, equations, open, weight, row);
            for column in 0..order {
                stacked[(row, column)] = factor * matrix[(row, column)] * scales[column];
            }
        }
        let mut right = DVector::zeros(2 * order);
        right.rows_mut(0, order).copy_from(&-&residual);
        let mut step = None;
        while damping < MOST_DAMPING {
            for column in 0..order {
                stacked[(order + column, column)] = f64::sqrt(damping);
            }
            let decomposed = stacked.clone().svd(true, true);
            let solved = decomposed.solve(&right, 0.0).ok()?;
            let next = &q + solved.component_mul(&scales);
            let next_residual = weighted(system, equations, open, weight, &next, t);
            if next_residual.norm() < residual.norm() {
                step = Some((next, next_residual, solved.amax()));
                damping = (0.1 * damping).max(LEAST_DAMPING);
                break;
            }
            damping *= 10.0;
        }
        let Some((next, own, length)) = step else {
            break;
        };
        (q, residual) = (next, own);
        if length < SHORTEST_STEP {
            break;
        }
    }
    Some(q)
}

/// Returns the two points of a joint.
fn ends(
    pool: &Pool,
    system: &System,
    joint: usize,
    values: &[(SymbolId, f64)],
) -> Option<[[f64; 2]; 2]> {
    let mechanism = &system.mechanism;
    let mut graph = pool.graph.clone();
    let marks: &[Mark] = &mechanism.joints[joint].operands.marks;
    let [first, second, ..] = marks else {
        return None;
    };
    let places = [first, second].map(|mark| mark.position(&mut graph));
    let zero = graph.zero();
    let length = link_length(mechanism, joint, pool);
    let expressions = [places.as_flattened(), &[length.unwrap_or(zero)]].concat();
    let mut symbols = vec![0.0; graph.symbol_count()];
    graph.fill_nominal(&mut symbols);
    for (symbol, value) in values {
        symbols[symbol.index()] = *value;
    }
    let mut results = [0.0; 5];
    Tape::new(&graph, &expressions).evaluate(&symbols, &mut Vec::new(), &mut results);
    let [x, y, to_x, to_y, length_now] = results;
    if length.is_none() {
        return Some([[x, y], [to_x, to_y]]);
    }
    let part = length_now / (to_x - x).hypot(to_y - y);
    let end = [x + part * (to_x - x), y + part * (to_y - y)];
    part.is_finite().then_some([end, [to_x, to_y]])
}
