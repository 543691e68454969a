//! Writes residuals as functions of one angle: a cos φ + b sin φ + rest, or a rotated vector.

use super::{Arm, Pool};
use crate::expr::{Circle, ExprId, Factor, Node, Rational, Term};
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

impl Pool {
    /// True if an equation mentions an unknown, directly or through a vector that the unknown rotates.
    pub fn mentions(&self, residual: ExprId, unknown: usize) -> bool {
        self.graph.depends_on(residual, self.unknowns[unknown][0])
            || self.is_turned_by(residual, unknown)
    }

    /// True if an equation mentions a vector that the unknown rotates.
    pub fn is_turned_by(&self, residual: ExprId, unknown: usize) -> bool {
        !self.arms_in(residual, unknown).is_empty()
    }

    /// Returns the indices of vectors in an equation that an unknown rotates, ascending.
    fn arms_in(&self, residual: ExprId, unknown: usize) -> Vec<usize> {
        let mut arms = self.arms_mentioned(residual);
        arms.retain(|&place| self.arms[place].angle == unknown);
        arms
    }

    /// Splits a residual by the rotated vectors of one angle, with squares that the angle does not change expanded. `None` if the
    /// result is not linear in these vectors or mentions the angle otherwise.
    pub fn split(&mut self, residual: ExprId, unknown: usize) -> Option<Turned> {
        self.split_linear(residual, unknown)
            .or_else(|| self.split_squares(residual, unknown))
    }

    fn split_linear(&mut self, residual: ExprId, unknown: usize) -> Option<Turned> {
        let zero = self.graph.zero();
        let (mut cosine, mut sine, mut rest) = (Vec::new(), Vec::new(), residual);
        for place in self.arms_in(residual, unknown) {
            let Arm {
                symbols: [ax, ay],
                local: [sx, sy],
                ..
            } = self.arms[place];
            let slopes = [ax, ay].map(|symbol| self.graph.derivative(residual, symbol));
            if slopes == [zero, zero] {
                continue;
            }
            // a_x = cos φ s_x − sin φ s_y and a_y = sin φ s_x + cos φ s_y.
            let [nx, ny] = slopes;
            cosine.extend([self.graph.multiply(nx, sx), self.graph.multiply(ny, sy)]);
            let backward = self.graph.multiply(nx, sy);
            sine.extend([self.graph.multiply(ny, sx), self.graph.negate(backward)]);
            rest = self.graph.substitute(rest, &[(ax, zero), (ay, zero)]);
        }
        let turned = Turned {
            cosine: self.graph.sum(&cosine),
            sine: self.graph.sum(&sine),
            rest,
        };
        let parts = [turned.cosine, turned.sine, turned.rest];
        let linear = parts.iter().all(|&part| !self.mentions(part, unknown));
        linear.then_some(turned)
    }

    /// Splits squares of α cos φ + β sin φ + ρ whose α² cos² φ + β² sin² φ + 2 α β sin φ cos φ sum to a constant: rotation
    /// preserves the length of a vector.
    fn split_squares(&mut self, residual: ExprId, unknown: usize) -> Option<Turned> {
        let Node::Sum(terms) = self.graph.node(residual).clone() else {
            return None;
        };
        let two = self.graph.integer(2);
        let (mut cosine, mut sine, mut rest) = (Vec::new(), Vec::new(), Vec::new());
        let (mut of_cosine, mut of_sine, mut mixed) = (Vec::new(), Vec::new(), Vec::new());
        for term in terms.iter() {
            let Some((factor, base)) = self.squared(term, unknown) else {
                let whole = self.graph.scale(term.coefficient, term.expr);
                let linear = self.split_linear(whole, unknown)?;
                cosine.push(linear.cosine);
                sine.push(linear.sine);
                rest.push(linear.rest);
                continue;
            };
            let linear = self.split_linear(base, unknown)?;
            let twice = self.graph.multiply(two, linear.rest);
            for (parts, function) in [(&mut cosine, linear.cosine), (&mut sine, linear.sine)] {
                parts.push(self.graph.product(&[factor, function, twice]));
            }
            rest.push(self.graph.product(&[factor, linear.rest, linear.rest]));
            of_cosine.push(self.graph.product(&[factor, linear.cosine, linear.cosine]));
            of_sine.push(self.graph.product(&[factor, linear.sine, linear.sine]));
            mixed.push(self.graph.product(&[factor, linear.cosine, linear.sine]));
        }
        let [of_cosine, of_sine, mixed] =
            [of_cosine, of_sine, mixed].map(|parts| self.graph.sum(&parts));
        let difference = self.graph.subtract(of_cosine, of_sine);
        let zero = self.graph.zero();
        for part in [difference, mixed] {
            if self.on_circles(part)? != zero {
                return None;
            }
        }
        // Chooses the shorter expression; a constant, if one is constant.
        let normal = self.on_circles(of_cosine)?;
        let is_shorter = self.graph.written_length(normal) <= self.graph.written_length(of_cosine);
        rest.push(match is_shorter || self.graph.is_fixed(normal) {
            true => normal,
            false => of_cosine,
        });
        let [cosine, sine, rest] = [cosine, sine, rest].map(|parts| self.graph.sum(&parts));
        Some(Turned { cosine, sine, rest })
    }

    /// Returns `(factor, base)` of a term factor · base² in which the angle rotates only the base.
    fn squared(&mut self, term: &Term, unknown: usize) -> Option<(ExprId, ExprId)> {
        let Node::Product(factors) = self.graph.node(term.expr).clone() else {
            return None;
        };
        let is_turned = |it: &Factor| self.mentions(it.base, unknown);
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
            .map(|it| self.graph.power(it.base, it.exponent))
            .collect();
        let others = self.graph.product(&others);
        Some((self.graph.scale(term.coefficient, others), base))
    }

    /// Returns an expression in normal form, with all rotated vectors of an angle in terms of the first one.
    fn on_circles(&mut self, expr: ExprId) -> Option<ExprId> {
        let mut circles: Vec<(usize, Circle)> = Vec::new();
        let mut replacements = Vec::new();
        for place in self.arms_mentioned(expr) {
            let arm = &self.arms[place];
            let known = circles.iter().find(|(angle, _)| *angle == arm.angle);
            let Some(&(_, first)) = known else {
                let [cosine, sine] = arm.symbols;
                let square = dot(arm.local, arm.local, &mut self.graph);
                let square = self.graph.tidied(square);
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
            let left = perpendicular(along, &mut self.graph);
            let [ahead, aside] = [along, left].map(|axis| {
                let part = dot(arm.local, axis, &mut self.graph);
                self.graph.divide(part, first.square)
            });
            let arm_first = symbols.map(|it| self.graph.variable(it));
            let written = turned(ahead, aside, arm_first, &mut self.graph);
            replacements.extend(arm.symbols.into_iter().zip(written));
        }
        let expr = self.graph.substitute(expr, &replacements);
        let circles: Vec<Circle> = circles.into_iter().map(|it| it.1).collect();
        self.graph.on_circles(expr, &circles)
    }

    /// Returns `(p, rest)` of R(φ) p + rest; `None` if the residuals are not the components of such a vector.
    pub fn turned_vector(
        &mut self,
        residuals: [ExprId; 2],
        unknown: usize,
    ) -> Option<(Vector, Vector)> {
        let x = self.split(residuals[0], unknown)?;
        let y = self.split(residuals[1], unknown)?;
        let is_rotation = y.sine == x.cosine && self.graph.negate(y.cosine) == x.sine;
        is_rotation.then_some(([x.cosine, y.cosine], [x.rest, y.rest]))
    }
}
