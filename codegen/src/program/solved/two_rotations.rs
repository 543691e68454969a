//! R(φ_a) p + R(φ_b) q + c = 0: the dyad with three revolute joints.
//!
//! With the turned links w_a = R(φ_a) p and w_b = R(φ_b) q and their sum b = −c, the triangle gives
//! w_a · w_b = (b² − p² − q²)/2 and w_a × w_b = ±√(p² q² − (w_a · w_b)²), the sign being the assembly mode; both links
//! follow from b without an angle. The cross product is also the determinant of the block's Jacobian [Ω w_a, Ω w_b], so
//! the rates cost one division. Nothing here loses digits where the links are nearly in line: the radicand is a difference
//! of squares of what is given, and its relative error is that of the given distance, magnified as geometry magnifies it.

use super::builder::{Builder, Direction, Stretch};
use super::{Action, Level};
use crate::expr::{ExprId, SymbolId};
use crate::joint::geometry::Vector;

/// What the rates need of the position.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    angles: [usize; 2],
    links: [Vector; 2],
    stretches: [Option<Stretch>; 2],
    closure: Vector,
    /// w_a × w_b.
    cross: ExprId,
}

impl Triangle {
    /// w_a × w_b.
    pub(super) fn determinant(&self) -> ExprId {
        self.cross
    }
}

impl Builder<'_> {
    /// The position of the dyad.
    pub(super) fn two_rotations(
        &mut self,
        angles: [usize; 2],
        p: Vector,
        q: Vector,
        closure: Vector,
    ) -> Triangle {
        let names = angles.map(|angle| self.system.unknown_name(angle).to_string());
        let minus = self.negated(closure);
        let base = self.vector("base", minus);
        let base_square = self.dot(base, base);
        let base_square = self.value("base_square", base_square);
        let (p_square, q_square) = (self.dot(p, p), self.dot(q, q));
        let [p_square, q_square] = [
            self.value("p_square", p_square),
            self.value("q_square", q_square),
        ];
        let links_square = self.graph().add(p_square, q_square);
        let twice = self.graph().subtract(base_square, links_square);
        let overlap = self.half(twice);
        let overlap = self.value("overlap", overlap);
        let scale = self.graph().multiply(p_square, q_square);
        let overlap_square = self.graph().multiply(overlap, overlap);
        let excess = self.graph().subtract(scale, overlap_square);
        let excess = self.value("excess", excess);
        self.reach(excess, scale, base_square, p_square, q_square);
        let meaning = format!(
            "whether {} is found ahead of {} or behind it",
            names[1], names[0]
        );
        let drawn = {
            let w = self.drawn_turn(angles[0], p);
            let b = minus.map(|component| self.drawn_value(component));
            w[0] * b[1] - w[1] * b[0]
        };
        let branch = self.branch(&format!("{}_{}", names[0], names[1]), meaning, drawn);
        let root = self.graph().sqrt(excess);
        let cross = self.graph().multiply(branch, root);
        let cross = self.value("cross", cross);
        let one = self.graph().one();
        let inverse = self.graph().divide(one, base_square);
        let inverse = self.value("inverse", inverse);
        // b · w_a = p² + w_a · w_b and b × w_a = −w_a × w_b.
        let forward = self.graph().add(p_square, overlap);
        let forward = self.graph().multiply(forward, inverse);
        let forward = self.value("forward", forward);
        let sideways = self.graph().multiply(cross, inverse);
        let sideways = self.value("sideways", sideways);
        let graph = self.graph();
        let first_value = [
            {
                let [along, across] = [
                    graph.multiply(forward, base[0]),
                    graph.multiply(sideways, base[1]),
                ];
                graph.add(along, across)
            },
            {
                let [along, across] = [
                    graph.multiply(forward, base[1]),
                    graph.multiply(sideways, base[0]),
                ];
                graph.subtract(along, across)
            },
        ];
        let first = self.link(angles[0], p, first_value, "first");
        let second_value = [0, 1].map(|axis| self.graph().subtract(base[axis], first[axis]));
        let second = self.link(angles[1], q, second_value, "second");
        let directions = [
            self.direction(&names[0], p, first, p_square),
            self.direction(&names[1], q, second, q_square),
        ];
        self.angle(angles[0], directions[0]);
        self.angle(angles[1], directions[1]);
        let stretches = [
            self.moving_link(angles[0], p, first, directions[0]),
            self.moving_link(angles[1], q, second, directions[1]),
        ];
        Triangle {
            angles,
            links: [first, second],
            stretches,
            closure,
            cross,
        }
    }

    /// The cosine and the sine of the angle that turns p into w.
    pub(super) fn direction(
        &mut self,
        name: &str,
        p: Vector,
        w: Vector,
        p_square: ExprId,
    ) -> Direction {
        let (along, across) = (self.dot(p, w), self.cross(p, w));
        let [cosine, sine] = [along, across].map(|part| self.graph().divide(part, p_square));
        Direction {
            cosine: self.value(&format!("cos_{name}"), cosine),
            sine: self.value(&format!("sin_{name}"), sine),
        }
    }

    /// Fails where two links do not span the distance whose square is given.
    fn reach(
        &mut self,
        excess: ExprId,
        scale: ExprId,
        base_square: ExprId,
        p_square: ExprId,
        q_square: ExprId,
    ) {
        let graph = self.graph();
        let [distance, p, q] = [base_square, p_square, q_square].map(|square| graph.sqrt(square));
        let (longest, shortest) = (graph.add(p, q), graph.subtract(p, q));
        self.actions.push(Action::Reach {
            excess,
            scale,
            distance,
            longest,
            shortest,
        });
    }

    /// What the rates of the dyad's angles need.
    pub(super) fn two_rotation_motion(&mut self, triangle: &Triangle) -> DyadMotion {
        let one = self.graph().one();
        let inverse = self.graph().divide(one, triangle.cross);
        let inverse = self.value("inverse_cross", inverse);
        let closing = self.closing_rates(
            &triangle.angles,
            &triangle.links,
            &triangle.stretches,
            triangle.closure,
        );
        DyadMotion {
            triangle: *triangle,
            inverse,
            closing,
        }
    }

    /// The rates of the dyad's angles, their accelerations or responses: [Ω w_a, Ω w_b] (φ̇_a, φ̇_b) = −v, by Cramer's rule.
    pub(super) fn two_rotation_rates(&mut self, motion: &DyadMotion, level: Level) {
        let DyadMotion {
            triangle,
            inverse,
            closing,
        } = motion;
        let v = self.closing_vector(closing, level);
        let (with_second, with_first) = (
            self.dot(v, triangle.links[1]),
            self.dot(v, triangle.links[0]),
        );
        let first = self.graph().multiply(with_second, *inverse);
        let first = self.graph().negate(first);
        let second = self.graph().multiply(with_first, *inverse);
        self.find(triangle.angles[0], level, first);
        self.find(triangle.angles[1], level, second);
    }

    /// The rate and the second rate of a closed chain of links and its closure, with the unknowns' own rates, or only their
    /// accelerations, taken as zero.
    pub(super) fn closing_rates(
        &mut self,
        angles: &[usize],
        links: &[Vector],
        stretches: &[Option<Stretch>],
        closure: Vector,
    ) -> Closing {
        let rates: Vec<(SymbolId, SymbolId)> =
            angles.iter().map(|&angle| self.rates_of(angle)).collect();
        let (held, steady): (Vec<SymbolId>, Vec<SymbolId>) = rates.into_iter().unzip();
        let [x, y] = [0, 1].map(|axis| {
            let parts: Vec<ExprId> = links
                .iter()
                .map(|link| link[axis])
                .chain([closure[axis]])
                .collect();
            let whole = self.graph().sum(&parts);
            let first = self.rate(whole);
            let second = self.rate(first);
            let levels = [self.without(first, &held), self.without(second, &steady)];
            (whole, levels)
        });
        Closing {
            whole: [x.0, y.0],
            levels: [[x.1[0], y.1[0]], [x.1[1], y.1[1]]],
            stretches: stretches.iter().flatten().copied().collect(),
        }
    }

    /// The vector of one level as local values, after what it needs.
    pub(super) fn closing_vector(&mut self, closing: &Closing, level: Level) -> Vector {
        for stretch in &closing.stretches {
            let (targets, values) = match level {
                Level::Response(direction) => {
                    self.stretch_response(stretch, direction);
                    continue;
                }
                Level::ResponseRate(direction) => {
                    self.stretch_response_rate(stretch, direction);
                    continue;
                }
                Level::Velocity => (stretch.stretch, stretch.first),
                _ => (stretch.pull, stretch.second),
            };
            for (target, value) in targets.into_iter().zip(values) {
                self.assign(target, value);
            }
        }
        let (name, vector) = match level {
            Level::Response(direction) => {
                let response = closing.whole.map(|part| self.along(part, direction));
                ("drift", response)
            }
            Level::ResponseRate(_) => {
                let response = closing.whole.map(|part| self.rate_at(part, level));
                ("drift_rate", response)
            }
            Level::Velocity => ("drift", closing.levels[0]),
            _ => ("drift_rate", closing.levels[1]),
        };
        self.vector(name, vector)
    }
}

/// What a closed chain does with its unknowns held.
#[derive(Clone, Debug)]
pub(super) struct Closing {
    /// The chain itself.
    whole: Vector,
    levels: [Vector; 2],
    stretches: Vec<Stretch>,
}

/// What the rates of a dyad's angles need.
#[derive(Clone, Debug)]
pub(super) struct DyadMotion {
    triangle: Triangle,
    /// 1/(w_a × w_b).
    inverse: ExprId,
    closing: Closing,
}
