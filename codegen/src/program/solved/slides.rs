//! Steps with displacements: linear ones, a circle and a line, a line through a point, two lines.

use super::builder::{Builder, Stretch};
use super::two_rotations::Closing;
use super::{Action, Level};
use crate::expr::ExprId;
use crate::joint::geometry::Vector;

/// What the rates of a rotation and a slide need: Ω w φ̇ + d ℓ̇ = −v, with k = w · d.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slide {
    angle: usize,
    slide: usize,
    /// The turned link that the angle moves.
    w: Vector,
    /// The direction that the displacement moves along.
    d: Vector,
    /// w · d, minus the determinant.
    k: ExprId,
    /// The loop as a sum that moves by the rules of its symbols.
    chain: Vector,
    stretch: Option<Stretch>,
}

impl Slide {
    /// w · d, minus the determinant.
    pub(super) fn determinant(&self) -> ExprId {
        self.k
    }
}

impl Lines {
    /// d_a × d_b.
    pub(super) fn determinant(&self) -> ExprId {
        self.determinant
    }
}

impl Builder<'_> {
    /// coefficient · u + rest = 0.
    pub(super) fn linear(&mut self, unknown: usize, coefficient: ExprId, rest: ExprId) -> ExprId {
        let coefficient = self.value("coefficient", coefficient);
        if !self.system.mechanism.graph.is_constant(coefficient) {
            let scale = self.graph().one();
            self.actions.push(Action::Nonzero {
                value: coefficient,
                scale,
            });
        }
        let ratio = self.graph().divide(rest, coefficient);
        let value = self.graph().negate(ratio);
        let symbol = self.system.vector_form.unknowns[unknown].position;
        self.assign(symbol, value);
        self.explicit_angle(unknown);
        coefficient
    }

    /// The rate, the acceleration or a response of a linear step, from its equation.
    pub(super) fn linear_rates(
        &mut self,
        unknown: usize,
        coefficient: ExprId,
        equation: ExprId,
        level: Level,
    ) {
        let drift = self.drift_at(equation, unknown, level);
        let ratio = self.graph().divide(drift, coefficient);
        let value = self.graph().negate(ratio);
        self.find(unknown, level, value);
    }

    /// R(φ) p + ℓ d + c = 0 with a known direction d: a circle of radius |p| meets a line.
    ///
    /// Across the line w · n = −c · n with n = (−d_y, d_x); along it w · d = ±√(p² d² − (w · n)²), the assembly mode.
    pub(super) fn rotation_and_slide(
        &mut self,
        [angle, slide]: [usize; 2],
        p: Vector,
        d: Vector,
        closure: Vector,
    ) -> Slide {
        let name = self.system.unknown_name(angle).to_string();
        // A local value has no rule of motion, so the chain below holds the direction as it was written.
        let moving = d;
        let d = self.vector("line", d);
        let closing = self.vector("closing", closure);
        let offset = self.cross(closing, d);
        let offset = self.value("offset", offset);
        let d_square = self.dot(d, d);
        let d_square = self.value("line_square", d_square);
        let p_square = self.dot(p, p);
        let p_square = self.value("p_square", p_square);
        let graph = self.graph();
        let scale = graph.multiply(p_square, d_square);
        let offset_square = graph.multiply(offset, offset);
        let excess = graph.subtract(scale, offset_square);
        let excess = self.value("excess", excess);
        let graph = self.graph();
        let by_length = graph.divide(offset_square, d_square);
        let (distance, longest, shortest) =
            (graph.sqrt(by_length), graph.sqrt(p_square), graph.zero());
        self.actions.push(Action::Reach {
            excess,
            scale,
            distance,
            longest,
            shortest,
        });
        let drawn = {
            let w = self.drawn_turn(angle, p);
            let line = d.map(|component| self.drawn_local(component));
            w[0] * line[0] + w[1] * line[1]
        };
        let branch = self.branch(
            &name,
            "whether the link points along the line or against it".to_string(),
            drawn,
        );
        let root = self.graph().sqrt(excess);
        let k = self.graph().multiply(branch, root);
        let k = self.value("along", k);
        // w = (k d + (w · n) n)/d², with w · n = −c · n = c × d.
        let graph = self.graph();
        let [kx, ky] = d.map(|component| graph.multiply(k, component));
        let [hx, hy] = [graph.multiply(offset, d[1]), graph.multiply(offset, d[0])];
        let sums = [graph.subtract(kx, hx), graph.add(ky, hy)];
        let value = sums.map(|part| graph.divide(part, d_square));
        let w = self.link(angle, p, value, "link");
        let direction = self.direction(&name, p, w, p_square);
        self.angle(angle, direction);
        let stretch = self.moving_link(angle, p, w, direction);
        // ℓ d² = −(c · d + k).
        let along = self.dot(closing, d);
        let total = self.graph().add(along, k);
        let ratio = self.graph().divide(total, d_square);
        let length = self.graph().negate(ratio);
        let symbol = self.system.vector_form.unknowns[slide].position;
        self.assign(symbol, length);
        let position = self.position(slide);
        let chain = [0, 1].map(|axis| {
            let graph = self.graph();
            let slid = graph.multiply(position, moving[axis]);
            graph.sum(&[w[axis], slid, closure[axis]])
        });
        Slide {
            angle,
            slide,
            w,
            d,
            k,
            chain,
            stretch,
        }
    }

    /// R(φ) (p + ℓ u) + c = 0 with a unit vector u: a line that turns passes through a point.
    ///
    /// With a = p · u and b = u × p, m = −c has the length √((a + ℓ)² + b²), so k = a + ℓ = ±√(m² − b²), the assembly mode.
    pub(super) fn turning_slide(
        &mut self,
        [angle, slide]: [usize; 2],
        p: Vector,
        u: Vector,
        closure: Vector,
    ) -> Slide {
        let name = self.system.unknown_name(angle).to_string();
        let minus = self.negated(closure);
        let m = self.vector("reach", minus);
        let m_square = self.dot(m, m);
        let m_square = self.value("reach_square", m_square);
        let (a, b) = (self.dot(p, u), self.cross(u, p));
        let b_square = self.graph().multiply(b, b);
        let excess = self.graph().subtract(m_square, b_square);
        let excess = self.value("excess", excess);
        let graph = self.graph();
        let (distance, shortest) = (graph.sqrt(m_square), graph.sqrt(b_square));
        self.actions.push(Action::Reach {
            excess,
            scale: m_square,
            distance,
            longest: distance,
            shortest,
        });
        let drawn = {
            let position = self.system.vector_form.unknowns[slide].position;
            let length = self.drawn[position.index()];
            self.drawn_value(a) + length
        };
        let meaning = "whether the point lies ahead on the line or behind its foot".to_string();
        let branch = self.branch(&name, meaning, drawn);
        let root = self.graph().sqrt(excess);
        let k = self.graph().multiply(branch, root);
        let k = self.value("along", k);
        let length = self.graph().subtract(k, a);
        let symbol = self.system.vector_form.unknowns[slide].position;
        self.assign(symbol, length);
        // p + ℓ u = k u + b u⊥ in the body; the direction that turns it into m.
        let graph = self.graph();
        let [kx, ky] = u.map(|component| graph.multiply(k, component));
        let [bx, by] = [graph.multiply(b, u[1]), graph.multiply(b, u[0])];
        let local = [graph.subtract(kx, bx), graph.add(ky, by)];
        let local = self.vector("local", local);
        let direction = self.direction(&name, local, m, m_square);
        self.angle(angle, direction);
        let line_value = self.turn(direction, u);
        let d = self.link(angle, u, line_value, "line");
        let start_value = self.turn(direction, p);
        let zero = self.graph().zero();
        let start = if p == [zero, zero] {
            p
        } else {
            self.link(angle, p, start_value, "start")
        };
        // What changes these links beside the angle turns with it.
        self.arms(angle, direction);
        let position = self.position(slide);
        let chain = [0, 1].map(|axis| {
            let graph = self.graph();
            let slid = graph.multiply(position, d[axis]);
            graph.sum(&[start[axis], slid, closure[axis]])
        });
        Slide {
            angle,
            slide,
            w: m,
            d,
            k,
            chain,
            stretch: None,
        }
    }

    /// What the rates of a rotation and a slide need.
    pub(super) fn slide_motion(&mut self, slide: &Slide) -> SlideMotion {
        let one = self.graph().one();
        let inverse = self.graph().divide(one, slide.k);
        let inverse = self.value("inverse_along", inverse);
        let closing = self.closing_rates(
            &[slide.angle, slide.slide],
            &[],
            &[slide.stretch],
            slide.chain,
        );
        SlideMotion {
            slide: *slide,
            inverse,
            closing,
        }
    }

    /// The rates of a rotation and a slide, their accelerations or responses.
    pub(super) fn slide_rates(&mut self, motion: &SlideMotion, level: Level) {
        let SlideMotion {
            slide,
            inverse,
            closing,
        } = motion;
        let v = self.closing_vector(closing, level);
        let across = self.cross(v, slide.d);
        let turning = self.graph().multiply(across, *inverse);
        self.find(slide.angle, level, turning);
        let along = self.dot(slide.w, v);
        let sliding = self.graph().multiply(along, *inverse);
        let sliding = self.graph().negate(sliding);
        self.find(slide.slide, level, sliding);
    }

    /// ℓ_a d_a + ℓ_b d_b + c = 0: two lines meet. Returns the determinant.
    pub(super) fn two_slides(
        &mut self,
        unknowns: [usize; 2],
        directions: [Vector; 2],
        closure: Vector,
    ) -> Lines {
        let moving = directions;
        let directions = [
            self.vector("first", directions[0]),
            self.vector("second", directions[1]),
        ];
        let determinant = self.cross(directions[0], directions[1]);
        let determinant = self.value("determinant", determinant);
        let scale = self.graph().one();
        self.actions.push(Action::Nonzero {
            value: determinant,
            scale,
        });
        let values = self.meet(directions, closure, determinant);
        for (unknown, value) in unknowns.into_iter().zip(values) {
            let target = self.system.vector_form.unknowns[unknown].position;
            self.assign(target, value);
        }
        let lengths = unknowns.map(|unknown| self.position(unknown));
        let chain = [0, 1].map(|axis| {
            let graph = self.graph();
            let slid = [0, 1].map(|side| graph.multiply(lengths[side], moving[side][axis]));
            graph.sum(&[slid[0], slid[1], closure[axis]])
        });
        Lines {
            unknowns,
            directions,
            determinant,
            chain,
        }
    }

    /// What the rates of two slides need.
    pub(super) fn two_slide_motion(&mut self, lines: &Lines) -> (Lines, Closing) {
        (
            *lines,
            self.closing_rates(&lines.unknowns, &[], &[], lines.chain),
        )
    }

    /// The rates of two slides, their accelerations or responses.
    pub(super) fn two_slide_rates(&mut self, lines: &Lines, closing: &Closing, level: Level) {
        let v = self.closing_vector(closing, level);
        let values = self.meet(lines.directions, v, lines.determinant);
        for (unknown, value) in lines.unknowns.into_iter().zip(values) {
            self.find(unknown, level, value);
        }
    }

    /// u_a d_a + u_b d_b + v = 0 by Cramer's rule.
    fn meet(&mut self, d: [Vector; 2], v: Vector, determinant: ExprId) -> [ExprId; 2] {
        let (first, second) = (self.cross(d[1], v), self.cross(v, d[0]));
        [first, second].map(|numerator| self.graph().divide(numerator, determinant))
    }

    /// The value in the drawing of a local value or an expression of unknowns and arms.
    pub(super) fn drawn_local(&self, expr: ExprId) -> f64 {
        let graph = &self.system.mechanism.graph;
        let defined = self.actions.iter().rev().find_map(|action| match action {
            Action::Let { target, value } => match graph.node(expr) {
                crate::expr::Node::Symbol(symbol) if symbol == target => Some(*value),
                _ => None,
            },
            _ => None,
        });
        self.drawn_value(defined.unwrap_or(expr))
    }
}

/// What the rates of two slides need.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lines {
    unknowns: [usize; 2],
    directions: [Vector; 2],
    determinant: ExprId,
    chain: Vector,
}

/// What the rates of a rotation and a slide need.
#[derive(Clone, Debug)]
pub(super) struct SlideMotion {
    slide: Slide,
    /// 1/(w · d).
    inverse: ExprId,
    closing: Closing,
}
