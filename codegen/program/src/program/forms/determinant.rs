//! Derives the determinant of a solution method's Jacobian, factored, in terms of unknowns.
//!
//! Rates and accelerations exist exactly if the determinant is nonzero, and its sign is the assembly mode of a closed form.
//! Rotated vectors are expanded, so that expressions have only unknowns and inputs. The sign depends on the order of equations
//! and has no meaning by itself.
//!
//! Φ_q becomes block triangular in solve order (Duff, Erisman and Reid, Direct Methods for Sparse Matrices). So its determinant
//! is the product of those of all subsystems, up to a nonzero factor.

use crate::expr::{ExprId, Graph};
use crate::joint::geometry::{Vector, dot};
use crate::pool::Pool;

/// Largest number of unknowns of a Newton-Raphson with an explicit determinant.
pub const LARGEST_WRITTEN_OUT: usize = 3;

/// Determinant of one solution method.
#[derive(Clone, Debug, PartialEq)]
pub struct Determinant {
    /// Determinant, up to its sign. `None` for a Newton-Raphson of more than `LARGEST_WRITTEN_OUT` unknowns, and if its constants
    /// overflow.
    pub value: Option<ExprId>,
    /// Determinant divided by the lengths of the Jacobian's columns, or for one angle by the length of the rotated vector. This
    /// is the sine of the angle between them: dimensionless, at most 1 in magnitude. `None` if `jacobian` has to be evaluated
    /// instead, or if a coefficient has no bound.
    pub normalized: Option<ExprId>,
    /// Divisor of `normalized`, in terms of unknowns and rotated vectors; `None` if `normalized` is.
    pub size: Option<ExprId>,
    /// Derivatives ∂residual/∂unknown of a Newton-Raphson, row by row; empty for closed forms.
    pub jacobian: Vec<Vec<ExprId>>,
}

impl Determinant {
    /// Returns the determinant of a closed form with the magnitude of its columns.
    pub(super) fn closed(value: ExprId, size: ExprId, pool: &mut Pool) -> Determinant {
        let ratio = pool.graph.divide(value, size);
        let [value, ratio] = [value, ratio].map(|it| pool.written_out(it));
        let finite = |expr: ExprId| pool.graph.is_finite(expr).then_some(expr);
        Determinant {
            value: finite(value),
            size: finite(size),
            normalized: finite(ratio),
            jacobian: Vec::new(),
        }
    }
}

/// Returns s cos φ − c sin φ, the derivative of c cos φ + s sin φ.
pub(super) fn of_one_angle(unknown: usize, [c, s]: [ExprId; 2], pool: &mut Pool) -> ExprId {
    // The vector (c, s) may be rotated by another angle, or be the mirror image of such a vector.
    let minus = pool.graph.negate(s);
    if let (Some(leader), [u, v]) = orientation([c, s], pool) {
        let difference = difference([Some(unknown), Some(leader)], pool);
        return wave(u, v, difference, &mut pool.graph);
    }
    if let (Some(leader), [u, v]) = orientation([c, minus], pool) {
        let [own, other] = [unknown, leader].map(|angle| pool.graph.variable(pool.position(angle)));
        let sum = pool.graph.add(own, other);
        let value = wave(u, v, sum, &mut pool.graph);
        return pool.graph.negate(value);
    }
    let angle = pool.graph.variable(pool.position(unknown));
    let minus = pool.graph.negate(c);
    wave(minus, s, angle, &mut pool.graph)
}

/// Returns R(φ_a) p × R(φ_b) q = (p · q) sin(φ_b − φ_a) + (p × q) cos(φ_b − φ_a); a vector without an angle is constant.
pub(super) fn crossed(angles: [Option<usize>; 2], [p, q]: [Vector; 2], pool: &mut Pool) -> ExprId {
    let along = dot(p, q, &mut pool.graph);
    let [forward, backward] = [
        pool.graph.multiply(p[0], q[1]),
        pool.graph.multiply(p[1], q[0]),
    ];
    let across = pool.graph.subtract(forward, backward);
    match angles {
        [None, None] => across,
        _ => {
            let difference = difference(angles, pool);
            wave(along, across, difference, &mut pool.graph)
        }
    }
}

/// Returns φ_b − φ_a.
fn difference(angles: [Option<usize>; 2], pool: &mut Pool) -> ExprId {
    let [first, second] = angles.map(|angle| match angle {
        Some(angle) => pool.graph.variable(pool.position(angle)),
        None => pool.graph.zero(),
    });
    pool.graph.subtract(second, first)
}

/// Returns a sin δ + b cos δ as one factor and one function of δ.
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

/// Returns the known angle that rotates a vector, and the vector in its orientation; otherwise `None` and the vector as it is.
pub(super) fn orientation(vector: Vector, pool: &mut Pool) -> (Option<usize>, Vector) {
    let zero = pool.graph.zero();
    let symbols = vector.iter().flat_map(|&part| pool.graph.symbols(part));
    let turning = symbols.filter_map(|&symbol| pool.place_of_symbol(symbol));
    if let Some(angle) = turning.min().map(|place| pool.arms()[place].angle)
        && let Some((local, rest)) = pool.turned_vector(vector, angle)
        && rest == [zero, zero]
    {
        return (Some(angle), local);
    }
    (None, vector)
}

/// Returns |v|.
pub(super) fn length(v: Vector, pool: &mut Pool) -> ExprId {
    let (_, v) = orientation(v, pool);
    let square = dot(v, v, &mut pool.graph);
    pool.graph.sqrt(square)
}

/// Returns |p| |q|.
pub(super) fn sizes([p, q]: [Vector; 2], pool: &mut Pool) -> ExprId {
    let (p, q) = (length(p, pool), length(q, pool));
    pool.graph.multiply(p, q)
}
