//! A step of the plan → the determinant of its Jacobian, factored, in terms of unknowns.
//!
//! Rates and accelerations of a step exist exactly where this determinant is not zero, and its sign is the assembly mode of a
//! closed form. Afterwards arms are written out, so that the expressions hold unknowns and what is given only. The sign
//! depends on the order in which equations are written and says nothing by itself. Since Φ_q becomes block triangular in solve
//! order (Duff, Erisman and Reid, Direct Methods for Sparse Matrices), its determinant is the product of those of all steps up
//! to a factor that does not vanish. The module does not know pins, nor how formulas are printed.

use super::plan::Step;
use super::recognition::turned_vector;
use crate::expr::{ExprId, Graph};
use crate::joint::geometry::{Vector, dot};
use crate::system::VectorForm;

/// The largest Newton step whose determinant is written out.
pub const LARGEST_WRITTEN_OUT: usize = 3;

/// The determinant of one step.
#[derive(Clone, Debug, PartialEq)]
pub struct Determinant {
    /// The determinant, up to its sign; `None` for a Newton step of more than [`LARGEST_WRITTEN_OUT`] unknowns.
    pub value: Option<ExprId>,
    /// The same divided by the lengths of the Jacobian's columns, or for one angle by the length of the vector that it turns:
    /// the sine of the angle between them, dimensionless, at most 1 in size. `None` where `jacobian` has to be evaluated
    /// instead, or where nothing says how large a coefficient is at most.
    pub normalized: Option<ExprId>,
    /// What it is divided by for that, in unknowns and arms; `None` where it is not.
    pub size: Option<ExprId>,
    /// ∂residual/∂unknown of a Newton step, row by row; empty for closed forms.
    pub jacobian: Vec<Vec<ExprId>>,
}

/// The determinant of a step.
pub fn determinant(step: &Step, form: &VectorForm, graph: &mut Graph) -> Determinant {
    let closed = |value: ExprId, size: ExprId, graph: &mut Graph| {
        let ratio = graph.divide(value, size);
        Determinant {
            value: Some(form.written_out(value, graph)),
            size: Some(size),
            normalized: Some(form.written_out(ratio, graph)),
            jacobian: Vec::new(),
        }
    };
    match step {
        Step::Linear { coefficient, .. } => {
            let value = form.written_out(*coefficient, graph);
            let one = graph.one();
            Determinant {
                value: Some(value),
                size: None,
                normalized: graph.is_fixed(value).then_some(one),
                jacobian: Vec::new(),
            }
        }
        Step::OneAngle {
            unknown,
            cosine,
            sine,
            ..
        } => {
            let value = one_angle(*unknown, [*cosine, *sine], form, graph);
            let size = length([*cosine, *sine], form, graph);
            closed(value, size, graph)
        }
        // [Ω w_a, Ω w_b] has the determinant w_a × w_b.
        Step::TwoRotations {
            first,
            second,
            p,
            q,
            ..
        } => {
            let value = crossed([Some(*first), Some(*second)], [*p, *q], form, graph);
            let size = sizes([*p, *q], form, graph);
            closed(value, size, graph)
        }
        // [Ω w, d] has the determinant −w · d, which is Ω w × d.
        Step::RotationAndSlide {
            angle,
            p,
            direction,
            ..
        } => {
            let turned = quarter(*p, graph);
            let (turning, d) = orientation(*direction, form, graph);
            let value = crossed([Some(*angle), turning], [turned, d], form, graph);
            let size = sizes([*p, d], form, graph);
            closed(value, size, graph)
        }
        // [Ω m, R u] with m = R (p + ℓ u) has the determinant −(p + ℓ u) · u.
        Step::TurningSlide { slide, p, u, .. } => {
            let along = graph.variable(form.unknowns[*slide].position);
            let reach = [0, 1].map(|axis| {
                let slid = graph.multiply(along, u[axis]);
                graph.add(p[axis], slid)
            });
            let (start, square) = (dot(*p, *u, graph), dot(*u, *u, graph));
            let slid = graph.multiply(along, square);
            let value = graph.add(start, slid);
            let size = sizes([reach, *u], form, graph);
            closed(value, size, graph)
        }
        Step::TwoSlides { directions, .. } => {
            let [(first, d), (second, e)] =
                directions.map(|direction| orientation(direction, form, graph));
            let value = crossed([first, second], [d, e], form, graph);
            let size = sizes([d, e], form, graph);
            closed(value, size, graph)
        }
        Step::Newton {
            unknowns,
            residuals,
            ..
        } => newton(unknowns, residuals, form, graph),
    }
}

/// c cos φ + s sin φ has the derivative s cos φ − c sin φ.
fn one_angle(unknown: usize, [c, s]: [ExprId; 2], form: &VectorForm, graph: &mut Graph) -> ExprId {
    // (c, s) as a vector that another angle turns, or its mirror image.
    let minus = graph.negate(s);
    if let (Some(leader), [u, v]) = orientation([c, s], form, graph) {
        let difference = difference([Some(unknown), Some(leader)], form, graph);
        return wave(u, v, difference, graph);
    }
    if let (Some(leader), [u, v]) = orientation([c, minus], form, graph) {
        let [own, other] =
            [unknown, leader].map(|angle| graph.variable(form.unknowns[angle].position));
        let sum = graph.add(own, other);
        let value = wave(u, v, sum, graph);
        return graph.negate(value);
    }
    let angle = graph.variable(form.unknowns[unknown].position);
    let minus = graph.negate(c);
    wave(minus, s, angle, graph)
}

/// R(φ_a) p × R(φ_b) q = (p · q) sin(φ_b − φ_a) + (p × q) cos(φ_b − φ_a); a vector without an angle does not turn.
fn crossed(
    angles: [Option<usize>; 2],
    [p, q]: [Vector; 2],
    form: &VectorForm,
    graph: &mut Graph,
) -> ExprId {
    let along = dot(p, q, graph);
    let [forward, backward] = [graph.multiply(p[0], q[1]), graph.multiply(p[1], q[0])];
    let across = graph.subtract(forward, backward);
    match angles {
        [None, None] => across,
        _ => {
            let difference = difference(angles, form, graph);
            wave(along, across, difference, graph)
        }
    }
}

/// φ_b − φ_a.
fn difference(angles: [Option<usize>; 2], form: &VectorForm, graph: &mut Graph) -> ExprId {
    let [first, second] = angles.map(|angle| match angle {
        Some(angle) => graph.variable(form.unknowns[angle].position),
        None => graph.zero(),
    });
    graph.subtract(second, first)
}

/// a sin δ + b cos δ as one factor and one function of δ.
fn wave(a: ExprId, b: ExprId, delta: ExprId, graph: &mut Graph) -> ExprId {
    let zero = graph.zero();
    if b == zero {
        let sine = graph.sin(delta);
        return graph.multiply(a, sine);
    }
    if a == zero {
        let cosine = graph.cos(delta);
        return graph.multiply(b, cosine);
    }
    // A displacement that is a factor of both stays outside the root.
    let ratio = graph.divide(b, a);
    if graph.is_constant(ratio) && !graph.is_constant(a) {
        let one = graph.one();
        let shifted = wave(one, ratio, delta, graph);
        return graph.multiply(a, shifted);
    }
    let squares = [graph.multiply(a, a), graph.multiply(b, b)];
    let square = graph.sum(&squares);
    let size = graph.sqrt(square);
    let ahead = graph.atan2(b, a);
    let shifted = graph.add(delta, ahead);
    let sine = graph.sin(shifted);
    graph.multiply(size, sine)
}

/// The known angle that turns a vector with the vector in its orientation; the vector as it is where there is none.
fn orientation(vector: Vector, form: &VectorForm, graph: &mut Graph) -> (Option<usize>, Vector) {
    let zero = graph.zero();
    let turning = form.arms.iter().find(|arm| {
        let mut symbols = arm.symbols.iter();
        symbols.any(|&symbol| vector.iter().any(|&part| graph.depends_on(part, symbol)))
    });
    if let Some(angle) = turning.map(|arm| arm.angle)
        && let Some((local, rest)) = turned_vector(vector, angle, form, graph)
        && rest == [zero, zero]
    {
        return (Some(angle), local);
    }
    (None, vector)
}

/// Ω v.
fn quarter(v: Vector, graph: &mut Graph) -> Vector {
    crate::joint::geometry::perpendicular(v, graph)
}

/// |v|.
fn length(v: Vector, form: &VectorForm, graph: &mut Graph) -> ExprId {
    let (_, v) = orientation(v, form, graph);
    let square = dot(v, v, graph);
    graph.sqrt(square)
}

/// |p| |q|.
fn sizes([p, q]: [Vector; 2], form: &VectorForm, graph: &mut Graph) -> ExprId {
    let (p, q) = (length(p, form, graph), length(q, form, graph));
    graph.multiply(p, q)
}

fn newton(
    unknowns: &[usize],
    residuals: &[ExprId],
    form: &VectorForm,
    graph: &mut Graph,
) -> Determinant {
    let jacobian: Vec<Vec<ExprId>> = residuals
        .iter()
        .map(|&residual| {
            let residual = form.written_out(residual, graph);
            let slope =
                |&unknown: &usize| graph.derivative(residual, form.unknowns[unknown].position);
            unknowns.iter().map(slope).collect()
        })
        .collect();
    let written = jacobian.len() <= LARGEST_WRITTEN_OUT && unknowns.len() == jacobian.len();
    Determinant {
        value: written.then(|| expanded(&jacobian, graph)),
        size: None,
        normalized: None,
        jacobian,
    }
}

/// The determinant by cofactors of the first row.
fn expanded(rows: &[Vec<ExprId>], graph: &mut Graph) -> ExprId {
    let Some((first, others)) = rows.split_first() else {
        return graph.one();
    };
    let zero = graph.zero();
    let mut terms = Vec::with_capacity(first.len());
    for (column, &entry) in first.iter().enumerate() {
        if entry == zero {
            continue;
        }
        let minor: Vec<Vec<ExprId>> = others
            .iter()
            .map(|row| {
                let kept = row.iter().enumerate().filter(|(place, _)| *place != column);
                kept.map(|(_, &entry)| entry).collect()
            })
            .collect();
        let cofactor = expanded(&minor, graph);
        let term = graph.multiply(entry, cofactor);
        terms.push(if column % 2 == 0 {
            term
        } else {
            graph.negate(term)
        });
    }
    graph.sum(&terms)
}
