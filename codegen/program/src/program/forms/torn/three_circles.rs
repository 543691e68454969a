//! Two loops that share a link: three circles through one point, of which two differences are linear.
//!
//! With u = R(φ_a) p_a, the loops u + R(φ_b) p_b + c = 0 and u + R(φ_c) p_c + d = 0 say that u has the length of p_a, u + c that of p_b
//! and u + d that of p_c. Subtracted pairwise, 2 c · u = p_b² − p_a² − c² and 2 d · u = p_c² − p_a² − d² give u by Cramer's rule, without
//! a root and without a sign, and (u · u − p_a · p_a)/2 remains. Where c and d are nearly parallel, that says little about u although
//! the circles may say enough.

use super::turned_link::TurnedLink;
use crate::expr::ExprId;
use crate::joint::Quantity;
use crate::joint::geometry::Vector;
use crate::program::builder::Builder;
use crate::program::forms::Candidate;
use crate::program::function::Level;
use crate::system::System;

/// The two loops.
#[derive(Clone, Debug)]
pub(in crate::program::forms) struct ThreeCircles {
    /// φ_a, φ_b and φ_c.
    pub angles: [usize; 3],
    /// p_a, p_b and p_c.
    pub links: [Vector; 3],
    /// c and d.
    pub closures: [Vector; 2],
}

impl ThreeCircles {
    /// Two pairs of equations of a part, in these unknowns each.
    pub fn of(
        equations: [[usize; 2]; 2],
        unknowns: [[usize; 2]; 2],
        candidate: &mut Candidate<'_>,
    ) -> Option<ThreeCircles> {
        let shared = *unknowns[0].iter().find(|it| unknowns[1].contains(it))?;
        let own = unknowns.map(|pair| pair.into_iter().find(|&it| it != shared));
        let [Some(b), Some(c)] = own else {
            return None;
        };
        let angles = [shared, b, c];
        let Candidate { form, graph, .. } = candidate;
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
            let (first, rest) = form.turned_vector(pair, shared, graph)?;
            let (second, closure) = form.turned_vector(rest, other, graph)?;
            parts.push([first, second, closure]);
        }
        let mut all = parts.iter().flatten().flatten();
        if all.any(|&part| angles.iter().any(|&it| form.mentions(part, it, graph))) {
            return None;
        }
        let [[p, q, c], [again, r, d]] = parts[..] else {
            return None;
        };
        let zero = graph.zero();
        let negated = again.map(|part| graph.negate(part));
        let [r, d] = match (again == p, negated == p) {
            (true, _) => [r, d],
            (_, true) => [r, d].map(|vector| vector.map(|part| graph.negate(part))),
            _ => return None,
        };
        let links = [p, q, r];
        (!links.contains(&[zero, zero])).then_some(ThreeCircles {
            angles,
            links,
            closures: [c, d],
        })
    }

    /// The sine of the angle between c and d in the drawing.
    pub fn drawn_sine(&self, system: &System) -> f64 {
        let [c, d] = self
            .closures
            .map(|vector| vector.map(|part| system.drawn_value(part)));
        (c[0] * d[1] - c[1] * d[0]) / (c[0].hypot(c[1]) * d[0].hypot(d[1]))
    }

    /// What remains, times the square of the determinant of both linear equations: zero wherever the links can be assembled, also where
    /// these say nothing; and its derivative by the angle that both loops follow from.
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
        let system = &mut *builder.system;
        let graph = &mut system.mechanism.graph;
        let whole = system.vector_form.written_out(whole, graph);
        let angle = system.vector_form.unknowns[tear].position;
        let slope = graph.derivative(whole, angle);
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

/// Three circles whose point is stated.
#[derive(Clone, Debug)]
pub(super) struct Circles {
    form: ThreeCircles,
    closures: [Vector; 2],
    inverse: ExprId,
    /// Three of them, but before they are stated.
    links: Vec<TurnedLink>,
    /// ċ, ḋ and u̇.
    rates: Option<([Vector; 2], Vector)>,
}

impl Circles {
    /// The vector whose products with c and d are these.
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

    /// The link whose length remains.
    pub fn first(&self) -> Option<&TurnedLink> {
        self.links.first()
    }

    /// States what a level finds.
    pub fn rates(&mut self, level: Level, builder: &mut Builder<'_>) {
        let closures = self.form.closures;
        let moved = closures.map(|closure| closure.map(|part| builder.rate_at(part, level)));
        let moved = [("v", 0), ("v", 1)].map(|(name, at)| builder.vector(name, moved[at]));
        let own = self.links[0].square_rate(level, builder);
        let right = [0, 1].map(|side| {
            // c · u̇ = (p_b · p_b)'/2 − (p_a · p_a)'/2 − (u + c) · ċ, where −(u + c) is the other link.
            let other = self.links[side + 1].square_rate(level, builder);
            let squares = builder.graph().subtract(other, own);
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
