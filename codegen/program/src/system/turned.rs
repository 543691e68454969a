//! Writes residuals as functions of one angle: a cos φ + b sin φ + rest, or a rotated vector.

use super::{Arm, VectorForm};
use crate::expr::{Circle, ExprId, Factor, Graph, Node, Rational, Term};
use crate::joint::geometry::{Vector, dot, perpendicular, turned};

/// Function α cos φ + β sin φ + rest.
#[derive(Clone, Copy, Debug)]
pub struct Turned {
    /// Coefficient α.
    pub cosine: ExprId,
    /// Coefficient β.
    pub sine: ExprId,
    /// Terms that do not depend on the angle.
    pub rest: ExprId,
}

impl VectorForm {
    /// True if an equation mentions an unknown, directly or through a vector that the unknown rotates.
    pub fn mentions(&self, residual: ExprId, unknown: usize, graph: &Graph) -> bool {
        graph.depends_on(residual, self.unknowns[unknown].position)
            || self.is_turned_by(residual, unknown, graph)
    }

    /// True if an equation mentions a vector that the unknown rotates.
    pub fn is_turned_by(&self, residual: ExprId, unknown: usize, graph: &Graph) -> bool {
        !self.arms_in(residual, unknown, graph).is_empty()
    }

    /// Returns the indices of vectors in an equation that an unknown rotates, ascending.
    fn arms_in(&self, residual: ExprId, unknown: usize, graph: &Graph) -> Vec<usize> {
        let mut arms = self.arms_mentioned(residual, graph);
        arms.retain(|&place| self.arms[place].angle == unknown);
        arms
    }

    /// Splits a residual by the rotated vectors of one angle, with squares that the angle does not change expanded. `None` if the
    /// result is not linear in these vectors or mentions the angle otherwise.
    pub fn split(&self, residual: ExprId, unknown: usize, graph: &mut Graph) -> Option<Turned> {
        self.split_linear(residual, unknown, graph)
            .or_else(|| self.split_squares(residual, unknown, graph))
    }

    fn split_linear(&self, residual: ExprId, unknown: usize, graph: &mut Graph) -> Option<Turned> {
        let zero = graph.zero();
        let (mut cosine, mut sine, mut rest) = (Vec::new(), Vec::new(), residual);
        for place in self.arms_in(residual, unknown, graph) {
            let Arm {
                symbols: [ax, ay],
                local: [sx, sy],
                ..
            } = self.arms[place];
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
            .all(|&part| !self.mentions(part, unknown, graph));
        linear.then_some(turned)
    }

    /// Splits squares of α cos φ + β sin φ + ρ whose α² cos² φ + β² sin² φ + 2 α β sin φ cos φ sum to a constant: rotation
    /// preserves the length of a vector.
    fn split_squares(&self, residual: ExprId, unknown: usize, graph: &mut Graph) -> Option<Turned> {
        let Node::Sum(terms) = graph.node(residual).clone() else {
            return None;
        };
        let two = graph.integer(2);
        let (mut cosine, mut sine, mut rest) = (Vec::new(), Vec::new(), Vec::new());
        let (mut of_cosine, mut of_sine, mut mixed) = (Vec::new(), Vec::new(), Vec::new());
        for term in terms.iter() {
            let Some((factor, base)) = self.squared(term, unknown, graph) else {
                let whole = graph.scale(term.coefficient, term.expr);
                let linear = self.split_linear(whole, unknown, graph)?;
                cosine.push(linear.cosine);
                sine.push(linear.sine);
                rest.push(linear.rest);
                continue;
            };
            let linear = self.split_linear(base, unknown, graph)?;
            let twice = graph.multiply(two, linear.rest);
            for (parts, function) in [(&mut cosine, linear.cosine), (&mut sine, linear.sine)] {
                parts.push(graph.product(&[factor, function, twice]));
            }
            rest.push(graph.product(&[factor, linear.rest, linear.rest]));
            of_cosine.push(graph.product(&[factor, linear.cosine, linear.cosine]));
            of_sine.push(graph.product(&[factor, linear.sine, linear.sine]));
            mixed.push(graph.product(&[factor, linear.cosine, linear.sine]));
        }
        let [of_cosine, of_sine, mixed] =
            [of_cosine, of_sine, mixed].map(|parts| graph.sum(&parts));
        let difference = graph.subtract(of_cosine, of_sine);
        let zero = graph.zero();
        for part in [difference, mixed] {
            if self.on_circles(part, graph)? != zero {
                return None;
            }
        }
        // Chooses the shorter expression; a constant, if one is constant.
        let normal = self.on_circles(of_cosine, graph)?;
        let is_shorter = graph.written_length(normal) <= graph.written_length(of_cosine);
        rest.push(match is_shorter || graph.is_fixed(normal) {
            true => normal,
            false => of_cosine,
        });
        let [cosine, sine, rest] = [cosine, sine, rest].map(|parts| graph.sum(&parts));
        Some(Turned { cosine, sine, rest })
    }

    /// Returns `(factor, base)` of a term factor · base² in which the angle rotates only the base.
    fn squared(&self, term: &Term, unknown: usize, graph: &mut Graph) -> Option<(ExprId, ExprId)> {
        let Node::Product(factors) = graph.node(term.expr).clone() else {
            return None;
        };
        let is_turned = |it: &Factor| self.mentions(it.base, unknown, graph);
        let (turned, others): (Vec<Factor>, Vec<Factor>) =
            factors.iter().copied().partition(is_turned);
        let [Factor { base, exponent }] = turned[..] else {
            return None;
        };
        if exponent != Rational::integer(2) {
            return None;
        }
        let others: Vec<ExprId> = others
            .into_iter()
            .map(|it| graph.power(it.base, it.exponent))
            .collect();
        let others = graph.product(&others);
        Some((graph.scale(term.coefficient, others), base))
    }

    /// Returns an expression in normal form, with all rotated vectors of an angle in terms of the first one.
    fn on_circles(&self, expr: ExprId, graph: &mut Graph) -> Option<ExprId> {
        let mut circles: Vec<(usize, Circle)> = Vec::new();
        let mut replacements = Vec::new();
        for place in self.arms_mentioned(expr, graph) {
            let arm = &self.arms[place];
            let known = circles.iter().find(|(angle, _)| *angle == arm.angle);
            let Some(&(_, first)) = known else {
                let [cosine, sine] = arm.symbols;
                let square = dot(arm.local, arm.local, graph);
                let square = graph.tidied(square);
                circles.push((
                    arm.angle,
                    Circle {
                        cosine,
                        sine,
                        square,
                    },
                ));
                continue;
            };
            // The other vector is the first one rotated by a constant angle and scaled.
            let symbols = [first.cosine, first.sine];
            let along = self.arms[self.place_of_symbol(first.cosine)?].local;
            let left = perpendicular(along, graph);
            let [ahead, aside] = [along, left].map(|axis| {
                let part = dot(arm.local, axis, graph);
                graph.divide(part, first.square)
            });
            let arm_first = symbols.map(|it| graph.variable(it));
            let written = turned(ahead, aside, arm_first, graph);
            replacements.extend(arm.symbols.into_iter().zip(written));
        }
        let expr = graph.substitute(expr, &replacements);
        let circles: Vec<Circle> = circles.into_iter().map(|it| it.1).collect();
        graph.on_circles(expr, &circles)
    }

    /// Returns `(p, rest)` of R(φ) p + rest; `None` if the residuals are not the components of such a vector.
    pub fn turned_vector(
        &self,
        residuals: [ExprId; 2],
        unknown: usize,
        graph: &mut Graph,
    ) -> Option<(Vector, Vector)> {
        let x = self.split(residuals[0], unknown, graph)?;
        let y = self.split(residuals[1], unknown, graph)?;
        let is_rotation = y.sine == x.cosine && graph.negate(y.cosine) == x.sine;
        is_rotation.then_some(([x.cosine, y.cosine], [x.rest, y.rest]))
    }
}
