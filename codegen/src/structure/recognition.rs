//! The equations that remain for the tears → how a person solves them.
//!
//! The forms are recognised from the equations alone, whatever mechanism they come from: the coefficients of the cosine and the
//! sine of each angle tell whether a vector is turned, and a displacement occurs linearly or not at all.

use super::elimination::Measured;
use super::plan::Step;
use crate::expr::{ExprId, Graph};
use crate::joint::geometry::Vector;
use crate::system::VectorForm;

/// α cos φ + β sin φ + rest.
#[derive(Clone, Copy, Debug)]
struct Turned {
    cosine: ExprId,
    sine: ExprId,
    rest: ExprId,
}

/// The step that solves these equations for these unknowns.
pub(super) fn recognize(
    equations: &[Measured],
    unknowns: &[usize],
    form: &VectorForm,
    graph: &mut Graph,
) -> Step {
    let found = match (equations, unknowns) {
        (&[equation], &[unknown]) => single(equation.residual, unknown, form, graph),
        (&[first, second], &[a, b]) => pair([first.residual, second.residual], [a, b], form, graph),
        _ => None,
    };
    found.unwrap_or_else(|| newton(equations, unknowns.to_vec()))
}

/// Newton-Raphson on these equations.
pub(super) fn newton(equations: &[Measured], unknowns: Vec<usize>) -> Step {
    Step::Newton {
        unknowns,
        residuals: equations.iter().map(|it| it.residual).collect(),
        quantities: equations.iter().map(|it| it.quantity).collect(),
    }
}

fn is_angle(unknown: usize, form: &VectorForm) -> bool {
    form.unknowns[unknown].quantity == crate::joint::Quantity::Angle
}

fn single(residual: ExprId, unknown: usize, form: &VectorForm, graph: &mut Graph) -> Option<Step> {
    let symbol = form.unknowns[unknown].position;
    if !super::elimination::turned_by(residual, unknown, form, graph) {
        let coefficient = graph.derivative(residual, symbol);
        if graph.depends_on(coefficient, symbol) {
            return None;
        }
        let zero = graph.zero();
        let rest = graph.substitute(residual, &[(symbol, zero)]);
        return Some(Step::Linear {
            unknown,
            coefficient,
            rest,
        });
    }
    let turned = split(residual, unknown, form, graph)?;
    Some(Step::OneAngle {
        unknown,
        cosine: turned.cosine,
        sine: turned.sine,
        rest: turned.rest,
        equation: residual,
    })
}

/// A residual by the arms of one angle; `None` where it is not linear in them or mentions the angle otherwise.
fn split(residual: ExprId, unknown: usize, form: &VectorForm, graph: &mut Graph) -> Option<Turned> {
    let zero = graph.zero();
    let (mut cosine, mut sine, mut rest) = (Vec::new(), Vec::new(), residual);
    let arms: Vec<_> = form
        .arms_of(unknown)
        .map(|arm| (arm.symbols, arm.local))
        .collect();
    for ([ax, ay], [sx, sy]) in arms {
        let slopes = [ax, ay].map(|symbol| graph.derivative(residual, symbol));
        if slopes == [zero, zero] {
            continue;
        }
        // a_x = cos φ s_x − sin φ s_y and a_y = sin φ s_x + cos φ s_y.
        let [nx, ny] = slopes;
        cosine.extend([graph.multiply(nx, sx), graph.multiply(ny, sy)]);
        let backward = graph.multiply(nx, sy);
        sine.extend([graph.multiply(ny, sx), graph.negate(backward)]);
        rest = graph.substitute(rest, &[(ax, zero), (ay, zero)]);
    }
    let turned = Turned {
        cosine: graph.sum(&cosine),
        sine: graph.sum(&sine),
        rest,
    };
    let parts = [turned.cosine, turned.sine, turned.rest];
    let linear = parts
        .iter()
        .all(|&part| !super::elimination::mentions(part, unknown, form, graph));
    linear.then_some(turned)
}

fn pair(
    residuals: [ExprId; 2],
    unknowns: [usize; 2],
    form: &VectorForm,
    graph: &mut Graph,
) -> Option<Step> {
    match unknowns.map(|unknown| is_angle(unknown, form)) {
        [true, true] => two_rotations(residuals, unknowns, form, graph),
        [true, false] => rotation_and_slide(residuals, unknowns, form, graph),
        [false, true] => rotation_and_slide(residuals, [unknowns[1], unknowns[0]], form, graph),
        [false, false] => two_slides(residuals, unknowns, form, graph),
    }
}

/// The two equations as the x and the y component of a vector equation: as they are, exchanged, or with one sign changed.
fn arrangements(residuals: [ExprId; 2], graph: &mut Graph) -> [[ExprId; 2]; 4] {
    let [first, second] = residuals;
    let minus_second = graph.negate(second);
    [
        [first, second],
        [first, minus_second],
        [second, first],
        [minus_second, first],
    ]
}

/// `(p, rest)` of R(φ) p + rest, where the two residuals are the components of such a vector.
pub(super) fn turned_vector(
    residuals: [ExprId; 2],
    unknown: usize,
    form: &VectorForm,
    graph: &mut Graph,
) -> Option<(Vector, Vector)> {
    let x = split(residuals[0], unknown, form, graph)?;
    let y = split(residuals[1], unknown, form, graph)?;
    let is_rotation = y.sine == x.cosine && graph.negate(y.cosine) == x.sine;
    is_rotation.then_some(([x.cosine, y.cosine], [x.rest, y.rest]))
}

/// R(φ_a) p + R(φ_b) q + c = 0: two circles that meet.
fn two_rotations(
    residuals: [ExprId; 2],
    unknowns: [usize; 2],
    form: &VectorForm,
    graph: &mut Graph,
) -> Option<Step> {
    let [first, second] = unknowns;
    for arranged in arrangements(residuals, graph) {
        let Some((p, rest)) = turned_vector(arranged, first, form, graph) else {
            continue;
        };
        let Some((q, closure)) = turned_vector(rest, second, form, graph) else {
            continue;
        };
        let tears = [first, second];
        let known = |part: ExprId| {
            tears
                .iter()
                .all(|&tear| !super::elimination::mentions(part, tear, form, graph))
        };
        if [p, q, closure].concat().into_iter().all(known) {
            return Some(Step::TwoRotations {
                first,
                second,
                p,
                q,
                closure,
            });
        }
    }
    None
}

/// R(φ) p + ℓ d + c = 0 with a known d, or R(φ) (p + ℓ u) + c = 0.
fn rotation_and_slide(
    residuals: [ExprId; 2],
    unknowns: [usize; 2],
    form: &VectorForm,
    graph: &mut Graph,
) -> Option<Step> {
    let [angle, slide] = unknowns;
    let symbol = form.unknowns[slide].position;
    let zero = graph.zero();
    for arranged in arrangements(residuals, graph) {
        let direction = arranged.map(|residual| graph.derivative(residual, symbol));
        if direction.iter().any(|&part| graph.depends_on(part, symbol)) {
            return None;
        }
        let without = arranged.map(|residual| graph.substitute(residual, &[(symbol, zero)]));
        let Some((p, closure)) = turned_vector(without, angle, form, graph) else {
            continue;
        };
        let known = |part: ExprId| !super::elimination::mentions(part, angle, form, graph);
        if direction.iter().all(|&part| known(part)) {
            return Some(Step::RotationAndSlide {
                angle,
                slide,
                p,
                direction,
                closure,
            });
        }
        let Some((u, rest)) = turned_vector(direction, angle, form, graph) else {
            continue;
        };
        if rest == [zero, zero] {
            return Some(Step::TurningSlide {
                angle,
                slide,
                p,
                u,
                closure,
            });
        }
    }
    None
}

/// ℓ_a d + ℓ_b e + c = 0 with known directions.
fn two_slides(
    residuals: [ExprId; 2],
    unknowns: [usize; 2],
    form: &VectorForm,
    graph: &mut Graph,
) -> Option<Step> {
    let symbols = unknowns.map(|unknown| form.unknowns[unknown].position);
    let zero = graph.zero();
    let columns =
        symbols.map(|symbol| residuals.map(|residual| graph.derivative(residual, symbol)));
    let linear = columns.iter().flatten().all(|&part| {
        symbols
            .iter()
            .all(|&symbol| !graph.depends_on(part, symbol))
    });
    if !linear {
        return None;
    }
    let closure = residuals
        .map(|residual| graph.substitute(residual, &[(symbols[0], zero), (symbols[1], zero)]));
    let [first, second] = unknowns;
    Some(Step::TwoSlides {
        first,
        second,
        directions: columns,
        closure,
    })
}
