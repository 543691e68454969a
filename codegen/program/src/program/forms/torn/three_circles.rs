//! Solves two loops with a common link: three circles through one point, two of whose differences are linear.
//!
//! Let u = R(φ_a) p_a. The loops u + R(φ_b) p_b + c = 0 and u + R(φ_c) p_c + d = 0 mean that u has the length of p_a, u + c that
//! of p_b, and u + d that of p_c. The differences 2 c · u = p_b² − p_a² − c² and 2 d · u = p_c² − p_a² − d² give u by Cramer's
//! rule, without a root and without a sign; (u · u − p_a · p_a)/2 remains. If c and d are nearly parallel, u is ill-conditioned
//! although the circles may not be.

use super::turned_link::TurnedLink;
use crate::expr::ExprId;
use crate::joint::Quantity;
use crate::joint::geometry::Vector;
use crate::pool::Pool;
use crate::program::builder::Builder;
use crate::program::forms::Candidate;
use crate::program::function::Level;
use crate::system::System;

/// Two loops with a common link.
#[derive(Clone, Debug)]
pub(in crate::program::forms) struct ThreeCircles {
    /// Angles φ_a, φ_b and φ_c.
    pub angles: [usize; 3],
    /// Vectors p_a, p_b and p_c.
    pub links: [Vector; 3],
    /// Vectors c and d.
    pub closures: [Vector; 2],
}

impl ThreeCircles {
    /// Returns the loops of two pairs of equations of a subsystem, in these unknowns each; `None` if they do not share a link.
    pub fn of(
        equations: [[usize; 2]; 2],
        unknowns: [[usize; 2]; 2],
        candidate: &mut Candidate<'_>,
    ) -> Option<ThreeCircles> {
        let shared = *unknowns[0].iter().find(|it| unknowns[1].contains(it))?;
        let others = unknowns.map(|pair| pair.into_iter().find(|&it| it != shared));
        let [Some(b), Some(c)] = others else {
            return None;
        };
        let angles = [shared, b, c];
        let form = candidate.form;
        let pool = &mut *candidate.pool;
        if b == c
            || angles
                .iter()
                .any(|&it| form.unknowns[it].quantity != Quantity::Angle)
        {
            return None;
        }
        let mut parts = Vec::new();
        for (pair, other) in equations.into_iter().zip([b, c]) {
            let pair = pair.map(|it| candidate.equations[it]);
            let (first, rest) = pool.turned_vector(pair, shared)?;
            let (second, closure) = pool.turned_vector(rest, other)?;
            parts.push([first, second, closure]);
        }
        let mut all = parts.iter().flatten().flatten();
        if all.any(|&part| angles.iter().any(|&it| pool.mentions(part, it))) {
            return None;
        }
        let [[p, q, c], [again, r, d]] = parts[..] else {
            return None;
        };
        let zero = pool.graph.zero();
        let negated = again.map(|part| pool.graph.negate(part));
        let [r, d] = match (again == p, negated == p) {
            (true, _) => [r, d],
            (_, true) => [r, d].map(|vector| vector.map(|part| pool.graph.negate(part))),
            _ => return None,
        };
        let links = [p, q, r];
        (!links.contains(&[zero, zero])).then_some(ThreeCircles {
            angles,
            links,
            closures: [c, d],
        })
    }

    /// Returns the sine of the angle between c and d in the design configuration.
    pub fn drawn_sine(&self, pool: &Pool, system: &System) -> f64 {
        let [c, d] = self
            .closures
            .map(|vector| vector.map(|part| system.drawn_value(part, pool)));
        (c[0] * d[1] - c[1] * d[0]) / (c[0].hypot(c[1]) * d[0].hypot(d[1]))
    }

    /// Returns the tearing residual times the squared determinant of both linear equations, and its derivative in the angle from
    /// which both loops follow. The product is zero wherever the links can be assembled, even if the linear equations are
    /// singular.
    pub(super) fn proof(&self, tear: usize, builder: &mut Builder<'_>) -> [ExprId; 2] {
        let [c, d] = self.closures;
        let squares = self.links.map(|link| builder.dot(link, link));
        let right = [(1, c), (2, d)].map(|(side, closure)| {
            let size = builder.dot(closure, closure);
            let sum = builder.graph().add(squares[0], size);
            let twice = builder.graph().subtract(squares[side], sum);
            builder.half(twice)
        });
        let u = [
            builder.cross([right[0], right[1]], [c[1], d[1]]),
            builder.cross([c[0], d[0]], [right[0], right[1]]),
        ];
        let determinant = builder.cross(c, d);
        let [found, given] = [builder.dot(u, u), {
            let square = builder.graph().multiply(determinant, determinant);
            builder.graph().multiply(square, squares[0])
        }];
        let whole = builder.graph().subtract(found, given);
        let whole = builder.pool.written_out(whole);
        let angle = builder.pool.position(tear);
        let slope = builder.graph().derivative(whole, angle);
        [whole, slope]
    }

    /// States the links.
    pub(super) fn position(&self, builder: &mut Builder<'_>) -> Circles {
        let [c, d] = [("c", 0), ("d", 1)].map(|(name, at)| builder.vector(name, self.closures[at]));
        let squares = self.links.map(|link| {
            let square = builder.dot(link, link);
            builder.value("p^2", square)
        });
        let sizes = [c, d].map(|vector| builder.dot(vector, vector));
        let sizes =
            [("c^2", sizes[0]), ("d^2", sizes[1])].map(|(name, it)| builder.value(name, it));
        let right = [0, 1].map(|side| {
            let graph = builder.graph();
            let sum = graph.add(squares[0], sizes[side]);
            let twice = graph.subtract(squares[side + 1], sum);
            let half = builder.half(twice);
            builder.value("k", half)
        });
        let determinant = builder.cross(c, d);
        let determinant = builder.value("determinant", determinant);
        let square = builder.graph().multiply(determinant, determinant);
        let scale = builder.graph().multiply(sizes[0], sizes[1]);
        let zero = builder.graph().zero();
        builder.reach(square, scale, [zero; 3]);
        let one = builder.graph().one();
        let inverse = builder.graph().divide(one, determinant);
        if !builder.graph().is_constant(inverse) {
            builder.comment(|_| "Cramer's rule for two unknowns: inverse = 1/determinant".into());
        }
        let inverse = builder.factor("inverse", inverse);
        let mut circles = Circles {
            form: self.clone(),
            closures: [c, d],
            inverse,
            links: Vec::new(),
            rates: None,
        };
        let u = circles.solved(right, builder);
        let u = builder.vector("u", u);
        let ends = [c, d].map(|closure| {
            let sum = [0, 1].map(|axis| builder.graph().add(u[axis], closure[axis]));
            builder.negated(sum)
        });
        let ends = [builder.vector("w", ends[0]), builder.vector("w", ends[1])];
        for (place, w) in [u, ends[0], ends[1]].into_iter().enumerate() {
            let link = TurnedLink::new(
                self.angles[place],
                [self.links[place], w],
                squares[place],
                builder,
            );
            circles.links.push(link);
        }
        circles
    }
}

/// Three circles whose point has been stated.
#[derive(Clone, Debug)]
pub(super) struct Circles {
    form: ThreeCircles,
    closures: [Vector; 2],
    inverse: ExprId,
    /// Links; empty until they have been stated.
    links: Vec<TurnedLink>,
    /// Rates ċ, ḋ and u̇.
    rates: Option<([Vector; 2], Vector)>,
}

impl Circles {
    /// Returns the vector with these scalar products with c and d.
    fn solved(&self, [first, second]: [ExprId; 2], builder: &mut Builder<'_>) -> Vector {
        let [c, d] = self.closures;
        let part = |i: usize, builder: &mut Builder<'_>| {
            let graph = builder.graph();
            let (forward, backward) = (graph.multiply(first, d[i]), graph.multiply(second, c[i]));
            let difference = match i {
                1 => graph.subtract(forward, backward),
                _ => graph.subtract(backward, forward),
            };
            graph.multiply(difference, self.inverse)
        };
        [part(1, builder), part(0, builder)]
    }

    /// Returns the link whose length gives a residual.
    pub fn first(&self) -> Option<&TurnedLink> {
        self.links.first()
    }

    /// States the results of a level.
    pub fn rates(&mut self, level: Level, builder: &mut Builder<'_>) {
        let closures = self.form.closures;
        let moved = closures.map(|closure| closure.map(|part| builder.rate_at(part, level)));
        let moved = [("v", 0), ("v", 1)].map(|(name, at)| builder.vector(name, moved[at]));
        let first_rate = self.links[0].square_rate(level, builder);
        let right = [0, 1].map(|side| {
            // c · u̇ = (p_b · p_b)'/2 − (p_a · p_a)'/2 − (u + c) · ċ, where −(u + c) is the other link.
            let other = self.links[side + 1].square_rate(level, builder);
            let squares = builder.graph().subtract(other, first_rate);
            let w = self.links[side + 1].vector();
            let along = builder.dot(w, moved[side]);
            let mut right = builder.graph().add(squares, along);
            if let (Level::Acceleration, Some((closures, u))) = (level, self.rates) {
                let square = builder.dot(closures[side], closures[side]);
                let product = builder.dot(closures[side], u);
                let graph = builder.graph();
                let twice = graph.add(product, product);
                let both = graph.add(square, twice);
                right = graph.subtract(right, both);
            }
            builder.value("k", right)
        });
        let u = self.solved(right, builder);
        let u = builder.vector("u", u);
        if level == Level::Velocity {
            self.rates = Some((moved, u));
        }
        self.links[0].turn(level, u, builder);
        for side in [0, 1] {
            let sum = [0, 1].map(|axis| builder.graph().add(u[axis], moved[side][axis]));
            let end = builder.negated(sum);
            let end = builder.vector("w", end);
            self.links[side + 1].turn(level, end, builder);
        }
    }
}
