//! Relative velocity and acceleration in a link of variable length.
//!
//! The rotated vector w = R(φ) p has the rate φ̇ Ω w + R ṗ. The relative term R ṗ and its counterpart R p̈ are local values,
//! computed with the rates.

use super::builder::{Builder, Direction};
use super::function::Level;
use crate::expr::{ExprId, Node, SymbolId};
use crate::joint::geometry::Vector;

/// Relative motion of a rotated vector.
#[derive(Clone, Copy, Debug)]
pub struct Stretch {
    /// Unknown angle that rotates the vector.
    angle: usize,
    /// Vector in the rotating orientation.
    p: Vector,
    /// Rotated vector.
    w: Vector,
    /// Direction of the angle.
    direction: Direction,
    /// Symbols and values of R ṗ and R p̈.
    changes: [([SymbolId; 2], Vector); 2],
}

impl Builder<'_> {
    /// Records the rates of the symbols of R(φ) p. Returns `None` if p is constant: a rotated vector of the vector form then has
    /// them.
    pub fn moving_link(
        &mut self,
        angle: usize,
        p: Vector,
        w: Vector,
        direction: Direction,
    ) -> Option<Stretch> {
        let graph = &self.pool.graph;
        if p.iter().all(|&part| graph.is_fixed(part)) {
            return None;
        }
        let turning = self.rate_of(angle);
        let first = p.map(|part| self.rate(part));
        let second = first.map(|part| self.rate(part));
        // A block needs all of them at once, so their names must differ.
        self.stretched += 1;
        let number = match self.stretched {
            1 => String::new(),
            number => format!("_{number}"),
        };
        let mut vector =
            |name| ["x", "y"].map(|axis| self.pool.intermediate(&format!("{name}{number}_{axis}")));
        let (stretch, pull) = (vector("relative_velocity"), vector("relative_acceleration"));
        self.turn_rule(w, turning, stretch);
        let moved = stretch.map(|symbol| self.graph().variable(symbol));
        self.turn_rule(moved, turning, pull);
        self.turn_response(angle, w);
        let values = [first, second].map(|change| self.turn(direction, change));
        Some(Stretch {
            angle,
            p,
            w,
            direction,
            changes: [(stretch, values[0]), (pull, values[1])],
        })
    }

    /// Records d(w)/dt = φ̇ Ω w + extra.
    fn turn_rule(&mut self, w: Vector, turning: ExprId, extra: [SymbolId; 2]) {
        let extra = extra.map(|symbol| self.graph().variable(symbol));
        self.rate_rule(w, w, turning, extra);
    }

    /// Records d(v)/dt = φ̇ Ω w + extra.
    fn rate_rule(&mut self, v: Vector, w: Vector, turning: ExprId, extra: Vector) {
        let graph = self.graph();
        let [forward, backward] = [graph.multiply(turning, w[0]), graph.multiply(turning, w[1])];
        let rates = [
            graph.subtract(extra[0], backward),
            graph.add(extra[1], forward),
        ];
        for (component, rate) in v.into_iter().zip(rates) {
            if let Node::Symbol(symbol) = *self.pool.graph.node(component) {
                self.pool.set_rate(symbol, rate);
            }
        }
    }
}

impl Stretch {
    /// States the values that a level needs.
    pub(super) fn at(&self, level: Level, builder: &mut Builder<'_>) {
        match level {
            Level::Position | Level::Forces => {}
            Level::Velocity => self.assign(0, builder),
            Level::Acceleration => self.assign(1, builder),
            Level::Response(direction) => self.respond(direction, builder),
            Level::ResponseRate(direction) => self.respond_rate(direction, builder),
        }
    }

    fn assign(&self, order: usize, builder: &mut Builder<'_>) {
        let (targets, values) = self.changes[order];
        let remark = ["the link's own rate", "its own acceleration"][order];
        for ((target, value), remark) in targets.into_iter().zip(values).zip([remark, ""]) {
            builder.assign_with(target, value, remark);
        }
    }

    /// States the relative change R ∂p/∂δ along a direction, as local values.
    fn respond(&self, direction: usize, builder: &mut Builder<'_>) {
        let change = self.p.map(|part| builder.along(part, direction));
        if change == [builder.graph().zero(); 2] {
            return;
        }
        let turned = builder.turn(self.direction, change);
        // Relative velocities may be needed at the same time, so the names must differ.
        let name = builder.derivatives.name("relative_change", direction);
        let values = builder.vector(&name, turned);
        for (component, value) in self.w.into_iter().zip(values) {
            if let Node::Symbol(symbol) = *builder.pool.graph.node(component) {
                builder.derivatives.set_stretch(symbol, direction, value);
            }
        }
    }

    /// States the rate of R ∂p/∂δ, which is φ̇ Ω R ∂p/∂δ + R d(∂p/∂δ)/dt.
    fn respond_rate(&self, direction: usize, builder: &mut Builder<'_>) {
        let responses = self
            .w
            .map(|component| match *builder.pool.graph.node(component) {
                Node::Symbol(symbol) => builder.derivatives.stretch_of(symbol, direction),
                _ => None,
            });
        let [Some(x), Some(y)] = responses else {
            return;
        };
        let change = self.p.map(|part| builder.along(part, direction));
        let change = change.map(|part| builder.rate(part));
        let turned = builder.turn(self.direction, change);
        let name = builder.derivatives.name("relative_change_rate", direction);
        let values = builder.vector(&name, turned);
        let turning = builder.rate_of(self.angle);
        builder.rate_rule([x, y], [x, y], turning, values);
    }
}
