//! Solves R(φ_a) p + R(φ_b) q + c = 0: the RRR dyad, the intersection of two circles.
//!
//! Let w_a = R(φ_a) p and w_b = R(φ_b) q be the rotated links, with the sum d = −c. The triangle gives k = w_a · w_b = (d² − p² −
//! q²)/2 and h = w_a × w_b = ±√(p² q² − k²), whose sign is the assembly mode. Both links follow from d without an angle. The
//! cross product is also the determinant of the block's Jacobian [Ω w_a, Ω w_b], so the rates cost one division.
//!
//! Precision is not lost if the links are nearly collinear: the radicand is a difference of squares of known values, and its
//! relative error is that of the known distance, amplified only by the geometry.

mod words;

use std::sync::Arc;

use super::closing::Closing;
use super::determinant::{crossed, sizes};
use super::{Candidate, Determinant, Form, Solved, Transposed};
use crate::expr::ExprId;
use crate::joint::geometry::Vector;
use crate::pool::Pool;
use crate::program::builder::{Builder, Direction};
use crate::program::function::Level;
use crate::program::two_links::TwoLinks;
use crate::words::{Piece, Singular, phrase};
use words::{TriangleNames, components, first_link};

/// Equation R(φ_a) p + R(φ_b) q + c = 0.
#[derive(Clone, Debug)]
struct TwoRotations {
    /// Angles φ_a and φ_b.
    angles: [usize; 2],
    /// Vectors p and q, constant in their bodies.
    links: [Vector; 2],
    /// Vector c, the known vector that closes the triangle.
    closure: Vector,
    /// Arrangement of the equations as components.
    arrangement: usize,
}

pub(super) fn recognize(candidate: &mut Candidate<'_>) -> Option<Arc<dyn Form>> {
    let (equations, angles) = candidate.pair_of([true, true])?;
    let arrangements = candidate.arrangements(equations).into_iter().enumerate();
    for (arrangement, arranged) in arrangements {
        let split =
            |pair, angle, candidate: &mut Candidate<'_>| candidate.pool.turned_vector(pair, angle);
        let Some((p, rest)) = split(arranged, angles[0], candidate) else {
            continue;
        };
        let Some((q, closure)) = split(rest, angles[1], candidate) else {
            continue;
        };
        let mut parts = [p, q, closure].into_iter().flatten();
        let known = |part| angles.iter().all(|&angle| !candidate.mentions(part, angle));
        if parts.all(known) {
            return Some(Arc::new(TwoRotations {
                angles,
                links: [p, q],
                closure,
                arrangement,
            }));
        }
    }
    None
}

impl Form for TwoRotations {
    fn name(&self) -> String {
        "RRR dyad".to_string()
    }

    fn unknowns(&self) -> Vec<usize> {
        self.angles.to_vec()
    }

    /// Returns the determinant of [Ω w_a, Ω w_b], which is w_a × w_b.
    fn determinant(&self, pool: &mut Pool) -> Determinant {
        let value = crossed(self.angles.map(Some), self.links, pool);
        let size = sizes(self.links, pool);
        Determinant::closed(value, size, pool)
    }

    fn singular(&self) -> Singular {
        Singular::Links {
            angles: self.angles,
            links: self.links,
        }
    }

    fn modes(&self) -> Option<usize> {
        Some(2)
    }

    fn position(&self, builder: &mut Builder<'_>) -> Box<dyn Solved> {
        let angles = self.angles;
        let triangle = builder
            .known
            .triangle(angles, self.links, builder.pool, builder.system);
        // The links are reversed if the triangle is read in the other direction.
        let is_backward = triangle.as_ref().is_some_and(|found| !found.forward);
        let [p, q, c] = [self.links[0], self.links[1], self.closure].map(|vector| {
            if is_backward {
                builder.negated(vector)
            } else {
                vector
            }
        });
        let names = self.open(triangle.as_ref(), [p, q], builder);
        self.close(&names, triangle.as_ref(), [p, q], c, builder);
        let drawn = {
            let [first, second] = [0, 1].map(|side| {
                builder
                    .system
                    .drawn_turn(angles[side], [p, q][side], builder.pool)
            });
            let lengths = first[0].hypot(first[1]) * second[0].hypot(second[1]);
            (first[0] * second[1] - first[1] * second[0]) / lengths
        };
        self.say_mode(triangle.as_ref(), drawn, builder);
        self.name_quantities(triangle.as_ref(), [p, q], &names, builder);
        let sides = Sides::of(&names, [p, q], c, builder);
        let k = sides.product(&names, builder);
        builder.note_links(TwoLinks {
            angles,
            links: [p, q],
            closure: c,
            product: k,
        });
        let h = self.height(&sides, k, drawn, &names, builder);
        let turned = self.turned_links(&sides, [p, q], [k, h], &names, builder);
        let directions = [0, 1].map(|side| {
            let (link, square) = ([p, q][side], sides.squares[side]);
            turning(
                angles[side],
                link,
                turned[side],
                square,
                &names.links[side],
                builder,
            )
        });
        for side in [0, 1] {
            builder.angle(angles[side], directions[side]);
        }
        let stretches = [0, 1].map(|side| {
            builder.moving_link(angles[side], [p, q][side], turned[side], directions[side])
        });
        Box::new(Found {
            angles,
            names: names.links,
            links: turned,
            arranged: (self.arrangement, is_backward),
            stretches,
            c,
            h,
            rates: None,
        })
    }
}

/// Sides of the triangle, as vectors and squares.
struct Sides {
    /// Vector d, the sum of both links.
    base: Vector,
    base_square: ExprId,
    /// Squares p² and q².
    squares: [ExprId; 2],
}

impl Sides {
    fn of(
        names: &TriangleNames,
        [p, q]: [Vector; 2],
        c: Vector,
        builder: &mut Builder<'_>,
    ) -> Sides {
        let minus = builder.negated(c);
        let base = builder.vector(&names.base, minus);
        let base_square = builder.dot(base, base);
        let base_square = builder.value(&format!("|{}|^2", names.base), base_square);
        let squares = [builder.dot(p, p), builder.dot(q, q)];
        let squares =
            [0, 1].map(|side| builder.value(&format!("|{}|^2", names.links[side]), squares[side]));
        Sides {
            base,
            base_square,
            squares,
        }
    }

    /// Returns k = w_a · w_b, by the law of cosines.
    fn product(&self, names: &TriangleNames, builder: &mut Builder<'_>) -> ExprId {
        let [first, second] = names.links.clone();
        builder.show(|_| {
            let squares = [&names.base, &first, &second].map(|name| Piece::Square(name.clone()));
            let [d, p, q] = squares;
            let half = phrase!["(", d, Piece::Minus, p, Piece::Minus, q, ")/2"];
            let product = Piece::Dot(first.clone(), second.clone());
            vec![[Piece::Local("k".to_string()).into(), half, product.into()]]
        });
        let [p_square, q_square] = self.squares;
        let links_square = builder.graph().add(p_square, q_square);
        let twice = builder.graph().subtract(self.base_square, links_square);
        let k = builder.half(twice);
        builder.value("k", k)
    }
}

impl TwoRotations {
    /// Returns h = w_a × w_b, with a check of the links' reach; its sign is the assembly mode.
    fn height(
        &self,
        sides: &Sides,
        k: ExprId,
        drawn: f64,
        names: &TriangleNames,
        builder: &mut Builder<'_>,
    ) -> ExprId {
        let [p_square, q_square] = sides.squares;
        let scale = builder.graph().multiply(p_square, q_square);
        let k_square = builder.graph().multiply(k, k);
        let excess = builder.graph().subtract(scale, k_square);
        let excess = builder.factor("excess", excess);
        let squares = [sides.base_square, p_square, q_square];
        let ends = {
            let [distance, p, q] = squares.map(|square| builder.graph().sqrt(square));
            let graph = builder.graph();
            [distance, graph.add(p, q), graph.subtract(p, q)]
        };
        builder.reach(excess, scale, ends);
        let names_of = self
            .angles
            .map(|angle| builder.system.unknown_name(angle).to_string());
        let meaning = {
            let [first, second] = &names.links;
            format!("the sign of the cross product of {first} and {second}")
        };
        let branch = builder.branch(names_of.join("_"), meaning, drawn);
        let root = builder.graph().sqrt(excess);
        let h = builder.graph().multiply(branch, root);
        let [first, second] = names.links.clone();
        let remark = phrase![Piece::Cross(first, second), ", twice the area"];
        builder.value_with("h", h, remark)
    }

    /// Returns w_a and w_b, from d by k and h.
    fn turned_links(
        &self,
        sides: &Sides,
        [p, q]: [Vector; 2],
        [k, h]: [ExprId; 2],
        names: &TriangleNames,
        builder: &mut Builder<'_>,
    ) -> [Vector; 2] {
        let d = sides.base;
        let [first, second] = &names.links;
        let one = builder.graph().one();
        let inverse = builder.graph().divide(one, sides.base_square);
        builder.comment(|builder| components(names, !builder.graph().is_constant(inverse)));
        let inverse = builder.factor("inverse", inverse);
        // d · w_a = p² + k and d × w_a = −h.
        let forward = builder.graph().add(sides.squares[0], k);
        let forward = builder.graph().multiply(forward, inverse);
        let forward = builder.factor("forward", forward);
        let sideways = builder.graph().multiply(h, inverse);
        let sideways = builder.factor("sideways", sideways);
        builder.show(|_| vec![first_link(names)]);
        let clockwise = [d[1], builder.graph().negate(d[0])];
        let value = builder.combined(forward, d, sideways, clockwise);
        let w = builder.link(self.angles[0], p, value, first, "");
        let value = [0, 1].map(|axis| builder.graph().subtract(d[axis], w[axis]));
        let u = builder.link(self.angles[1], q, value, second, "");
        [w, u]
    }
}

/// Returns the cosine and the sine of the angle that rotates p into w, which derivations print under this name.
pub(super) fn turning(
    angle: usize,
    p: Vector,
    w: Vector,
    p_square: ExprId,
    name: &str,
    builder: &mut Builder<'_>,
) -> Direction {
    let (along, across) = (builder.dot(p, w), builder.cross(p, w));
    let [cosine, sine] = [along, across].map(|part| builder.graph().divide(part, p_square));
    let remark = phrase![
        Piece::Vector(name.to_string()),
        " = ",
        Piece::Turned(angle, p)
    ];
    builder.direction(angle, cosine, sine, remark)
}

struct Found {
    angles: [usize; 2],
    names: [String; 2],
    links: [Vector; 2],
    /// Arrangement of the equations as components, and true if the loop was reversed.
    arranged: (usize, bool),
    stretches: [Option<crate::program::stretch::Stretch>; 2],
    c: Vector,
    h: ExprId,
    /// Inverse 1/h, and the derivatives of the loop at constant angles.
    rates: Option<(ExprId, Closing)>,
}

impl Solved for Found {
    fn determinant(&self) -> Option<ExprId> {
        Some(self.h)
    }

    fn transposed(&self, builder: &mut Builder<'_>) -> Option<Transposed> {
        let (arrangement, reversed) = self.arranged;
        Some(Transposed::Two {
            columns: self.links.map(|link| builder.across(link)),
            determinant: self.h,
            arrangement,
            reversed,
        })
    }

    fn prepare(&mut self, builder: &mut Builder<'_>) {
        let one = builder.graph().one();
        let inverse = builder.graph().divide(one, self.h);
        let inverse = builder.factor("inverse_h", inverse);
        let parts = [self.links[0], self.links[1], self.c];
        let stretches = self.stretches.iter().flatten().copied();
        let closing = Closing::new(self.angles, &parts, stretches, builder);
        let [first, second] = self.names.clone();
        let cross = Piece::Cross(first.clone(), second.clone());
        closing.say(phrase![cross, " = ", Piece::Formula(self.h)], builder);
        builder.show(|_| {
            let term = |angle, link| phrase![Piece::Rate(angle), Piece::Times, Piece::Across(link)];
            let [a, b] = self.angles;
            let left = phrase![term(a, first), " + ", term(b, second)];
            let right = phrase![Piece::Opposite, Piece::Vector("v".to_string())];
            vec![[left, right, "".into()]]
        });
        self.rates = Some((inverse, closing));
    }

    /// States the solution of [Ω w_a, Ω w_b] (φ̇_a, φ̇_b) = −v, by Cramer's rule.
    fn rates(&self, level: Level, builder: &mut Builder<'_>) {
        let Some((inverse, closing)) = &self.rates else {
            return;
        };
        let v = closing.drift(level, builder);
        let (with_second, with_first) =
            (builder.dot(v, self.links[1]), builder.dot(v, self.links[0]));
        let first = builder.graph().multiply(with_second, *inverse);
        let first = builder.graph().negate(first);
        let second = builder.graph().multiply(with_first, *inverse);
        builder.find(self.angles[0], level, first);
        builder.find(self.angles[1], level, second);
    }
}
