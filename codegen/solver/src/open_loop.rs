//! A mechanism that cannot be assembled → the pose in which all joints but one hold and the ends of that one are closest.
//!
//! The open joint is a pin of the block that fails, or else a link without a body. Its equations count less and less while the sum of squares is minimized
//! (Nocedal and Wright 2006, section 17.1), so that in the end the others hold to rounding.

use linkwright::Equations;
use linkwright_codegen::stages::emit::drawing;
use linkwright_codegen::stages::expr::{ExprId, SymbolId, Tape};
use linkwright_codegen::stages::joint::Feature;
use linkwright_codegen::stages::joint::geometry::{BodyId, Mark};
use linkwright_codegen::stages::model::Mechanism;
use linkwright_codegen::stages::system::System;
use nalgebra::{DMatrix, DVector};

use crate::condition::jacobian;
use crate::interpreted::Interpreted;
use crate::textbook::TextbookEquations;
use crate::view::View;

/// Weights of the open joint beside the others, one after another.
const WEIGHTS: [f64; 5] = [1.0, 1e-1, 1e-2, 1e-3, 1e-4];

/// Iterations for each weight at most.
const ITERATIONS: usize = 200;

/// Steps shorter than this, in scales of coordinates, end an iteration.
const SHORTEST_STEP: f64 = 1e-12;

/// Residual of the other joints, beside their scales, above which more than one loop is open.
const HELD: f64 = 1e-5;

/// Damping at the beginning, and the bounds between which it is tried.
const DAMPING: f64 = 1e-3;
const LEAST_DAMPING: f64 = 1e-15;
const MOST_DAMPING: f64 = 1e8;

/// A mechanism with one loop open.
#[derive(Clone, Debug)]
pub struct OpenLoop {
    /// Joint that is open: an index into the joints.
    pub joint: usize,
    /// Its two points, in m; of a link the end that does not arrive, and the point at which it should.
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

    /// Pose for a drawing.
    pub fn pose(&self, system: &System) -> drawing::Pose {
        drawing::Pose::new(system, self.values.iter().copied())
    }
}

/// Opens the loop that cannot close at the time `t`; `None` if the mechanism can be assembled as drawn, if its failing block has no pin, or
/// if opening one joint is not enough.
pub fn open_loop(view: &Interpreted, t: f64) -> Option<OpenLoop> {
    let system = view.system();
    let joint = open_joint(view, t)?;
    let equations = TextbookEquations::new(system);
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
        let own = [signal.value, signal.rate, signal.acceleration];
        values.extend(input.symbols.into_iter().zip(own));
    }
    values.extend(coordinates.map(|(it, value)| (it.position, *value)));
    Some(OpenLoop {
        joint,
        ends: ends(system, joint, &values)?,
        values,
    })
}

/// The last pin of the block that fails, rather one between bodies that move, or else its last link without a body.
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
    let is_link = |joint: &&usize| link_length(mechanism, **joint).is_some();
    pin.or_else(|| block.joints.iter().rfind(is_link)).copied()
}

/// The length of a link without a body; `None` for other joints.
fn link_length(mechanism: &Mechanism, joint: usize) -> Option<ExprId> {
    let joint = &mechanism.joints[joint];
    let feature = joint
        .kind
        .feature(&joint.operands, &mut mechanism.graph.clone())?;
    joint.operands.value.filter(|_| feature == Feature::Link)
}

/// Φ divided by the scales of its rows; the rows of the open joint count by `weight`.
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
    let own = if system.rows[row].joint == open {
        weight
    } else {
        1.0
    };
    own / equations.row_scale(row)
}

/// The pose with the least sum of squares that is found from a pose (Levenberg 1944, Marquardt 1963).
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
            let own = weighted(system, equations, open, weight, &next, t);
            if own.norm() < residual.norm() {
                step = Some((next, own, solved.amax()));
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

/// Places of the two points of a joint.
fn ends(system: &System, joint: usize, values: &[(SymbolId, f64)]) -> Option<[[f64; 2]; 2]> {
    let mechanism = &system.mechanism;
    let mut graph = mechanism.graph.clone();
    let marks: &[Mark] = &mechanism.joints[joint].operands.marks;
    let [first, second, ..] = marks else {
        return None;
    };
    let places = [first, second].map(|mark| mark.position(&mut graph));
    let zero = graph.zero();
    let length = link_length(mechanism, joint);
    let wanted = [places.as_flattened(), &[length.unwrap_or(zero)]].concat();
    let mut symbols = vec![0.0; graph.symbol_count()];
    graph.fill_nominal(&mut symbols);
    for (symbol, value) in values {
        symbols[symbol.index()] = *value;
    }
    let mut found = [0.0; 5];
    Tape::new(&graph, &wanted).evaluate(&symbols, &mut Vec::new(), &mut found);
    let [x, y, to_x, to_y, length_now] = found;
    if length.is_none() {
        return Some([[x, y], [to_x, to_y]]);
    }
    let part = length_now / (to_x - x).hypot(to_y - y);
    let end = [x + part * (to_x - x), y + part * (to_y - y)];
    part.is_finite().then_some([end, [to_x, to_y]])
}
