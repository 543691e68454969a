//! A turned link that changes its length while it turns: what moves it beside its angle.
//!
//! w = R(φ) p moves by φ̇ Ω w + R ṗ. The second part, R ṗ, and its own rate, R p̈, are values of their own, found with the rates.

use super::builder::{Builder, Direction};
use super::function::Level;
use crate::expr::{ExprId, Node, SymbolId};
use crate::joint::geometry::Vector;

/// The parts of a turned vector's motion that come from its own change.
#[derive(Clone, Copy, Debug)]
pub struct Stretch {
    /// The unknown that turns it.
    angle: usize,
    /// The vector in the orientation that turns.
    p: Vector,
    /// The turned vector.
    w: Vector,
    /// What turns it.
    direction: Direction,
    /// R ṗ and R p̈: the symbols, and their values.
    changes: [([SymbolId; 2], Vector); 2],
}

impl Builder<'_> {
    /// States that the symbols of a turned vector move as R(φ) p does. Nothing where p does not move: then an arm says so.
    pub fn moving_link(
        &mut self,
        angle: usize,
        p: Vector,
        w: Vector,
        direction: Direction,
    ) -> Option<Stretch> {
        let graph = &self.system.mechanism.graph;
        if p.iter().all(|&part| graph.is_fixed(part)) {
            return None;
        }
        let turning = self.rate_of(angle);
        let first = p.map(|part| self.rate(part));
        let second = first.map(|part| self.rate(part));
        // All of a block are needed at once, so their names must be told apart.
        self.stretched += 1;
        let number = match self.stretched {
            1 => String::new(),
            number => format!("_{number}"),
        };
        let mut vector = |name| {
            ["x", "y"].map(|axis| self.system.intermediate(&format!("{name}{number}_{axis}")))
        };
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

    /// d(w)/dt = φ̇ Ω w + extra.
    fn turn_rule(&mut self, w: Vector, turning: ExprId, extra: [SymbolId; 2]) {
        let extra = extra.map(|symbol| self.graph().variable(symbol));
        self.rate_rule(w, w, turning, extra);
    }

    /// d(v)/dt = φ̇ Ω w + extra.
    fn rate_rule(&mut self, v: Vector, w: Vector, turning: ExprId, extra: Vector) {
        let graph = self.graph();
        let [forward, backward] = [graph.multiply(turning, w[0]), graph.multiply(turning, w[1])];
        let rates = [
            graph.subtract(extra[0], backward),
            graph.add(extra[1], forward),
        ];
        for (component, rate) in v.into_iter().zip(rates) {
            if let Node::Symbol(symbol) = *self.system.mechanism.graph.node(component) {
                self.system.vector_form.set_rate(symbol, rate);
            }
        }
    }
}

impl Stretch {
    /// States what a level needs of it.
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

    /// What changes the vector along a direction beside its angle, as local values: R ∂p/∂δ.
    fn respond(&self, direction: usize, builder: &mut Builder<'_>) {
        let change = self.p.map(|part| builder.along(part, direction));
        if change == [builder.graph().zero(); 2] {
            return;
        }
        let turned = builder.turn(self.direction, change);
        // What changes the vector with time may be needed beside it, so the names must be told apart.
        let name = builder.derivatives.name("relative_change", direction);
        let values = builder.vector(&name, turned);
        for (component, value) in self.w.into_iter().zip(values) {
            if let Node::Symbol(symbol) = *builder.system.mechanism.graph.node(component) {
                builder.derivatives.set_stretch(symbol, direction, value);
            }
        }
    }

    /// How the same moves with time: the rate of R ∂p/∂δ is φ̇ Ω R ∂p/∂δ + R d(∂p/∂δ)/dt.
    fn respond_rate(&self, direction: usize, builder: &mut Builder<'_>) {
        let found = self.w.map(
            |component| match *builder.system.mechanism.graph.node(component) {
                Node::Symbol(symbol) => builder.derivatives.stretch_of(symbol, direction),
                _ => None,
            },
        );
        let [Some(x), Some(y)] = found else {
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
