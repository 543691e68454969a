//! Solves R(φ) (p + ℓ u) + c = 0 with a unit vector u: a rotating line passes through a known point (RPR dyad).
//!
//! With a = p · u and b = u × p, the known vector m = −c has the length √((a + ℓ)² + b²), so k = a + ℓ = ±√(m² − b²), whose sign
//! is the assembly mode. The determinant of the block's Jacobian [Ω m, R u] is −k.

use std::sync::Arc;

use super::determinant::sizes;
use super::rotation_and_slide::Found;
use super::two_rotations::turning;
use super::{Candidate, Determinant, Form, Solved};
use crate::expr::ExprId;
use crate::joint::geometry::{Vector, dot};
use crate::pool::Pool;
use crate::program::builder::Builder;
use crate::program::function::Level;
use crate::words::{Phrase, Piece, Singular, phrase};

/// Equation R(φ) (p + ℓ u) + c = 0.
#[derive(Clone, Debug)]
struct TurningSlide {
    angle: usize,
    slide: usize,
    /// Start p of the line, in the orientation of the angle.
    start: Vector,
    /// Direction u of the line, in the same orientation.
    direction: Vector,
    /// Vector c, the known vector that closes the loop.
    closure: Vector,
    /// Arrangement of the equations as components.
    arrangement: usize,
}

pub(super) fn recognize(candidate: &mut Candidate<'_>) -> Option<Arc<dyn Form>> {
    let (equations, [angle, slide]) = candidate.pair_of([true, false])?;
    let symbol = candidate.pool.position(slide);
    let zero = candidate.pool.graph.zero();
    let arrangements = candidate.arrangements(equations).into_iter().enumerate();
    for (arrangement, arranged) in arrangements {
        let pool = &mut *candidate.pool;
        let slope = arranged.map(|equation| pool.graph.derivative(equation, symbol));
        let without = arranged.map(|equation| pool.graph.substitute(equation, &[(symbol, zero)]));
        let Some((start, closure)) = pool.turned_vector(without, angle) else {
            continue;
        };
        let is_constant = |part: &ExprId| !pool.graph.depends_on(*part, symbol);
        if !slope.iter().all(is_constant) {
            return None;
        }
        let Some((direction, rest)) = pool.turned_vector(slope, angle) else {
            continue;
        };
        // A constant direction belongs to a rotation and a slide.
        if rest == [zero, zero] && direction != [zero, zero] {
            return Some(Arc::new(TurningSlide {
                angle,
                slide,
                start,
                direction,
                closure,
                arrangement,
            }));
        }
    }
    None
}

impl Form for TurningSlide {
    fn name(&self) -> String {
        "RPR dyad".to_string()
    }

    fn unknowns(&self) -> Vec<usize> {
        vec![self.angle, self.slide]
    }

    /// Returns the determinant of [Ω m, R u] with m = R (p + ℓ u), which is −(p + ℓ u) · u.
    fn determinant(&self, pool: &mut Pool) -> Determinant {
        let (p, u) = (self.start, self.direction);
        let along = pool.graph.variable(pool.position(self.slide));
        let reach = [0, 1].map(|axis| {
            let slid = pool.graph.multiply(along, u[axis]);
            pool.graph.add(p[axis], slid)
        });
        let (start, square) = (dot(p, u, &mut pool.graph), dot(u, u, &mut pool.graph));
        let slid = pool.graph.multiply(along, square);
        let value = pool.graph.add(start, slid);
        let size = sizes([reach, u], pool);
        Determinant::closed(value, size, pool)
    }

    fn singular(&self) -> Singular {
        Singular::TurningLine {
            angle: self.angle,
            slide: self.slide,
            start: self.start,
            direction: self.direction,
        }
    }

    fn modes(&self) -> Option<usize> {
        Some(2)
    }

    fn position(&self, builder: &mut Builder<'_>) -> Box<dyn Solved> {
        let (angle, slide) = (self.angle, self.slide);
        let (name, is_backward) = self.open(builder);
        // The vectors are reversed if the loop is read along the line.
        let [p, u, c] = [self.start, self.direction, self.closure].map(|vector| {
            if is_backward {
                builder.negated(vector)
            } else {
                vector
            }
        });
        self.close([p, u], c, &name, builder);
        let minus = builder.negated(c);
        let m = builder.vector(&name, minus);
        let m_square = builder.dot(m, m);
        let m_square = builder.value(&format!("|{name}|^2"), m_square);
        let (a, b) = (builder.dot(p, u), builder.cross(u, p));
        let b_square = builder.graph().multiply(b, b);
        let excess = builder.graph().subtract(m_square, b_square);
        let excess = builder.factor("excess", excess);
        let graph = builder.graph();
        let (distance, shortest) = (graph.sqrt(m_square), graph.sqrt(b_square));
        builder.reach(excess, m_square, [distance, distance, shortest]);
        let drawn = {
            let along = builder.system.drawn_value(a, builder.pool)
                + builder.system.drawn_unknown(slide, builder.pool);
            along / along.hypot(builder.system.drawn_value(b, builder.pool))
        };
        let meaning =
            "the side of the foot on which the point lies: positive ahead on the line".to_string();
        let branch_name = builder.system.unknown_name(angle).to_string();
        let branch = builder.branch(branch_name, meaning, drawn);
        let root = builder.graph().sqrt(excess);
        let k = builder.graph().multiply(branch, root);
        let k = builder.value_with("k", k, "with the sign of the design configuration");
        let length = builder.graph().subtract(k, a);
        builder.find(slide, Level::Position, length);
        // p + ℓ u = k u + b Ω u in the body; the direction rotates this vector into m.
        let across = builder.across(u);
        let local = builder.combined(k, u, b, across);
        let [x, y] = local;
        let local = [builder.factor("local_x", x), builder.factor("local_y", y)];
        let direction = turning(angle, local, m, m_square, &name, builder);
        builder.angle(angle, direction);
        let value = builder.turn(direction, u);
        let d = builder.link(
            angle,
            u,
            value,
            "u",
            phrase!["u = ", Piece::Turned(angle, u)],
        );
        let zero = builder.graph().zero();
        let start = match p == [zero, zero] {
            true => p,
            false => {
                let value = builder.turn(direction, p);
                builder.link(
                    angle,
                    p,
                    value,
                    "start",
                    phrase!["start = ", Piece::Turned(angle, p)],
                )
            }
        };
        // Relative velocities of these links rotate with the angle.
        builder.arms(angle, direction);
        // A line moves in the orientation of its angle if that differs from its body's by a driven angle.
        let stretches = [(u, d), (p, start)]
            .map(|(vector, turned)| builder.moving_link(angle, vector, turned, direction));
        builder.say(|_| {
            phrase![
                "The sign of ",
                Piece::Local("k".to_string()),
                " is the assembly mode: on which side of its foot the point lies on the line."
            ]
        });
        let length = builder.position(slide);
        let slid = d.map(|part| builder.graph().multiply(length, part));
        let chain = [start, slid, c];
        let arranged = (self.arrangement, is_backward);
        Box::new(Found::new(
            [angle, slide],
            m,
            d,
            k,
            arranged,
            &chain,
            stretches.into_iter().flatten(),
            builder,
        ))
    }
}

impl TurningSlide {
    /// Describes the two known points of the line. Returns the name of the vector between them, and true if the plan's vector is
    /// reversed.
    fn open(&self, builder: &mut Builder<'_>) -> (String, bool) {
        let known = builder.known.known_pins(self.angle, builder.system);
        let [angle, slide] = [self.angle, self.slide].map(Piece::Unknown);
        let [(first, first_end), (second, second_end)] = &known[..] else {
            let source = " from a line that turns and slides";
            builder.heading(phrase![angle, " and ", slide, source]);
            return ("m".to_string(), false);
        };
        let name = format!("{}{}", first.name, second.name);
        let [a, b] = [first, second].map(|pin| Piece::Name(pin.name.clone()));
        let length = Piece::Length(name.clone());
        builder.heading(phrase![
            angle.clone(),
            " and ",
            slide.clone(),
            " from the sliding line between ",
            a.clone(),
            " and ",
            b.clone(),
            " with ",
            length,
            " known"
        ]);
        builder.say(|builder| {
            let ends = [first_end, second_end];
            let [here, there] = ends.map(|mark| builder.known.whereabouts(mark, builder.system));
            phrase![
                a,
                ", ",
                here,
                ", and ",
                b,
                ", ",
                there,
                ", are known. Between them lies a line that turns by ",
                angle,
                " and on which ",
                slide,
                " is the part in use."
            ]
        });
        let ends =
            [first_end, second_end].map(|mark| builder.system.drawn_position(*mark, builder.pool));
        let drawn = self
            .closure
            .map(|part| -builder.system.drawn_value(part, builder.pool));
        let along = drawn[0] * (ends[1][0] - ends[0][0]) + drawn[1] * (ends[1][1] - ends[0][1]);
        (name, along < 0.0)
    }

    /// Returns the loop as vectors and by components.
    fn close(&self, [p, u]: [Vector; 2], c: Vector, name: &str, builder: &mut Builder<'_>) {
        builder.say(|_| "The loop closes, as vectors and by components:".into());
        builder.show(|builder| {
            let length = builder.position(self.slide);
            let local = [0, 1].map(|axis| {
                let slid = builder.graph().multiply(length, u[axis]);
                builder.graph().add(p[axis], slid)
            });
            let minus = builder.negated(c);
            let turned = builder.turned_by(self.angle, local);
            let whole = [0, 1].map(|axis| builder.graph().add(turned[axis], c[axis]));
            let mut equations = builder.closed_loop(Phrase::default(), whole);
            equations[0] = [
                Piece::Turned(self.angle, local).into(),
                Piece::Sum(minus).into(),
                Piece::Vector(name.to_string()).into(),
            ];
            equations
        });
        builder.say(|_| {
            phrase![
                "Both sides have the same length, and what lies across the turning line does not change; so the part ",
                Piece::Local("k".to_string()),
                " along it is a square root (Pythagoras):"
            ]
        });
    }
}
