//! What the steps of all kinds are written with.

use super::responses::Responses;
use super::{Action, Branch, Level};
use crate::expr::{ExprId, Graph, Node, Number, Rational, SymbolId, Tape};
use crate::joint::geometry::{Vector, dot, turned};
use crate::system::System;

/// The actions of one block in the making.
pub(super) struct Builder<'a> {
    pub system: &'a mut System,
    pub actions: Vec<Action>,
    pub branches: &'a mut Vec<Branch>,
    /// The values of unknowns and arms in the drawing, by symbol.
    pub drawn: &'a [f64],
    /// Arms that are defined already.
    pub defined: Vec<SymbolId>,
    /// What has been found along the directions.
    pub responses: &'a mut Responses,
    /// How many links of the block change their length.
    pub stretched: usize,
}

/// The cosine and the sine of an angle that was found.
#[derive(Clone, Copy, Debug)]
pub(super) struct Direction {
    pub cosine: ExprId,
    pub sine: ExprId,
}

impl Builder<'_> {
    pub(super) fn graph(&mut self) -> &mut Graph {
        &mut self.system.mechanism.graph
    }

    pub(super) fn comment(&mut self, text: impl Into<String>) {
        self.actions.push(Action::Comment(text.into()));
    }

    /// A named local value; what is a symbol or a constant already needs no name.
    pub(super) fn value(&mut self, name: &str, value: ExprId) -> ExprId {
        let graph = &self.system.mechanism.graph;
        if graph.is_constant(value) || matches!(graph.node(value), Node::Symbol(_)) {
            return value;
        }
        let is_fixed = graph.is_fixed(value);
        let target = self.system.intermediate(name);
        if is_fixed {
            let zero = self.system.mechanism.graph.zero();
            self.system.vector_form.set_rate(target, zero);
            self.fix(target, value);
        }
        self.actions.push(Action::Let { target, value });
        self.graph().variable(target)
    }

    /// Both components of a vector as local values `name_x`, `name_y`.
    pub(super) fn vector(&mut self, name: &str, vector: Vector) -> Vector {
        [
            self.value(&format!("{name}_x"), vector[0]),
            self.value(&format!("{name}_y"), vector[1]),
        ]
    }

    pub(super) fn assign(&mut self, target: SymbolId, value: ExprId) {
        self.actions.push(Action::Let { target, value });
    }

    pub(super) fn dot(&mut self, a: Vector, b: Vector) -> ExprId {
        dot(a, b, self.graph())
    }

    /// a_x b_y − a_y b_x.
    pub(super) fn cross(&mut self, a: Vector, b: Vector) -> ExprId {
        let graph = self.graph();
        let [forward, backward] = [graph.multiply(a[0], b[1]), graph.multiply(a[1], b[0])];
        graph.subtract(forward, backward)
    }

    pub(super) fn half(&mut self, value: ExprId) -> ExprId {
        self.graph().scale(Number::rational(Rational::HALF), value)
    }

    pub(super) fn negated(&mut self, vector: Vector) -> Vector {
        vector.map(|component| self.graph().negate(component))
    }

    /// d/dt of an expression.
    pub(super) fn rate(&mut self, expr: ExprId) -> ExprId {
        self.system
            .vector_form
            .rate(expr, &mut self.system.mechanism.graph)
    }

    /// The first or the second rate of an expression, or its derivative along a direction, or the rate of that.
    pub(super) fn rate_at(&mut self, expr: ExprId, level: Level) -> ExprId {
        if let Level::Response(direction) = level {
            return self.along(expr, direction);
        }
        if let Level::ResponseRate(direction) = level {
            let response = self.along(expr, direction);
            return self.rate(response);
        }
        let first = self.rate(expr);
        if level == Level::Velocity {
            first
        } else {
            self.rate(first)
        }
    }

    /// The same with the unknown that the level finds taken as zero.
    pub(super) fn drift_at(&mut self, expr: ExprId, unknown: usize, level: Level) -> ExprId {
        let whole = self.rate_at(expr, level);
        match level {
            // What has not been found is held.
            Level::Response(_) | Level::ResponseRate(_) => whole,
            _ => {
                let target = self.target(unknown, level);
                self.without(whole, &[target])
            }
        }
    }

    /// States what a level finds for an unknown.
    pub(super) fn find(&mut self, unknown: usize, level: Level, value: ExprId) {
        match level {
            Level::Response(direction) => self.respond(unknown, direction, value),
            Level::ResponseRate(direction) => self.respond_rate(unknown, direction, value),
            _ => {
                let target = self.target(unknown, level);
                self.assign(target, value);
            }
        }
    }

    /// The rate or the acceleration of an unknown.
    fn target(&self, unknown: usize, level: Level) -> SymbolId {
        let (rate, acceleration) = self.rates_of(unknown);
        if level == Level::Velocity {
            rate
        } else {
            acceleration
        }
    }

    /// The rate and the acceleration of an unknown.
    pub(super) fn rates_of(&self, unknown: usize) -> (SymbolId, SymbolId) {
        let unknown = &self.system.vector_form.unknowns[unknown];
        (unknown.rate, unknown.acceleration)
    }

    /// An expression with the rates or accelerations of these unknowns set to zero.
    pub(super) fn without(&mut self, expr: ExprId, symbols: &[SymbolId]) -> ExprId {
        let zero = self.system.mechanism.graph.zero();
        let replacements: Vec<_> = symbols.iter().map(|&symbol| (symbol, zero)).collect();
        self.graph().substitute(expr, &replacements)
    }

    /// The angle of a direction, and the arms that turn with it.
    pub(super) fn angle(&mut self, unknown: usize, direction: Direction) {
        self.actions.push(Action::Angle {
            unknown,
            sine: direction.sine,
            cosine: direction.cosine,
        });
        self.arms(unknown, direction);
    }

    /// The arms that turn with an angle.
    pub(super) fn arms(&mut self, unknown: usize, direction: Direction) {
        let arms: Vec<_> = self
            .system
            .vector_form
            .arms_of(unknown)
            .map(|arm| (arm.symbols, arm.local))
            .collect();
        for (symbols, local) in arms {
            if self.defined.contains(&symbols[0]) {
                continue;
            }
            self.defined.push(symbols[0]);
            let turned = self.turn(direction, local);
            self.assign(symbols[0], turned[0]);
            self.assign(symbols[1], turned[1]);
        }
    }

    /// R(φ) v.
    pub(super) fn turn(&mut self, direction: Direction, v: Vector) -> Vector {
        turned(direction.cosine, direction.sine, v, self.graph())
    }

    /// Sine and cosine of an angle that is known explicitly, where an arm turns with it.
    pub(super) fn explicit_angle(&mut self, unknown: usize) {
        if self.system.vector_form.arms_of(unknown).next().is_none() {
            return;
        }
        let name = self.system.unknown_name(unknown).to_string();
        let angle = self.position(unknown);
        let [sine, cosine] =
            ["sin", "cos"].map(|function| self.system.intermediate(&format!("{function}_{name}")));
        self.actions.push(Action::SineCosine {
            sine,
            cosine,
            angle,
        });
        let direction = Direction {
            sine: self.graph().variable(sine),
            cosine: self.graph().variable(cosine),
        };
        self.arms(unknown, direction);
    }

    pub(super) fn position(&mut self, unknown: usize) -> ExprId {
        let symbol = self.system.vector_form.unknowns[unknown].position;
        self.graph().variable(symbol)
    }

    /// The turned vector R(φ) p of a step as symbols that move with the angle: an arm where p does not move.
    pub(super) fn link(&mut self, angle: usize, p: Vector, value: Vector, name: &str) -> Vector {
        let fixed = p
            .iter()
            .all(|&part| self.system.mechanism.graph.is_fixed(part));
        if !fixed {
            return self.vector(name, value);
        }
        let System {
            vector_form,
            mechanism,
            ..
        } = self.system;
        let arm = vector_form.arm(angle, p, name, &mut mechanism.graph);
        let place = vector_form
            .arms
            .iter()
            .position(|found| found.angle == angle && found.local == p);
        if let Some(place) = place {
            let symbols = vector_form.arms[place].symbols;
            for symbol in symbols {
                if self.system.roles.len() <= symbol.index() {
                    self.system
                        .roles
                        .resize(symbol.index() + 1, crate::system::SymbolRole::Intermediate);
                }
                self.system.roles[symbol.index()] = crate::system::SymbolRole::Arm(place);
            }
            if !self.defined.contains(&symbols[0]) {
                self.defined.push(symbols[0]);
                self.assign(symbols[0], value[0]);
                self.assign(symbols[1], value[1]);
            }
            self.responses.change_arm(place, self.system);
        }
        arm
    }

    /// States that the symbols of a turned vector move as R(φ) p does: φ̇ Ω w + R(φ) ṗ. The second part and its own rate are new
    /// symbols, defined when the rates are; they are returned; there are none where p does not move.
    pub(super) fn moving_link(
        &mut self,
        angle: usize,
        p: Vector,
        w: Vector,
        direction: Direction,
    ) -> Option<Stretch> {
        let fixed = p
            .iter()
            .all(|&part| self.system.mechanism.graph.is_fixed(part));
        if fixed {
            return None;
        }
        let turning = self.rates_of(angle).0;
        let turning = self.graph().variable(turning);
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
        let (stretch, pull) = (vector("stretch"), vector("pull"));
        self.turn_rule(w, turning, stretch);
        let stretch_variables = stretch.map(|symbol| self.graph().variable(symbol));
        self.turn_rule(stretch_variables, turning, pull);
        self.turn_response(angle, w);
        Some(Stretch {
            angle,
            p,
            w,
            direction,
            stretch,
            pull,
            first: self.turn(direction, first),
            second: self.turn(direction, second),
        })
    }

    /// d(w)/dt = φ̇ Ω w + extra.
    fn turn_rule(&mut self, w: Vector, turning: ExprId, extra: [SymbolId; 2]) {
        let [extra_x, extra_y] = extra.map(|symbol| self.graph().variable(symbol));
        let graph = &mut self.system.mechanism.graph;
        let [forward, backward] = [graph.multiply(turning, w[0]), graph.multiply(turning, w[1])];
        let rates = [
            graph.subtract(extra_x, backward),
            graph.add(extra_y, forward),
        ];
        for (component, rate) in w.into_iter().zip(rates) {
            if let Node::Symbol(symbol) = *self.system.mechanism.graph.node(component) {
                self.system.vector_form.set_rate(symbol, rate);
            }
        }
    }

    /// The value of an expression of unknowns and arms in the drawing.
    pub(super) fn drawn_value(&self, expr: ExprId) -> f64 {
        // Most do not move, and need no table of all symbols.
        if let Some(value) = self.system.mechanism.graph.constant_value(expr) {
            return value;
        }
        let mut symbols = self.drawn.to_vec();
        symbols.resize(self.system.mechanism.graph.symbol_count(), 0.0);
        let (mut workspace, mut result) = (Vec::new(), [0.0]);
        Tape::new(&self.system.mechanism.graph, &[expr]).evaluate(
            &symbols,
            &mut workspace,
            &mut result,
        );
        result[0]
    }

    /// R(φ) v with the angle of the drawing.
    pub(super) fn drawn_turn(&self, angle: usize, v: Vector) -> [f64; 2] {
        let symbol = self.system.vector_form.unknowns[angle].position;
        let (sine, cosine) = self.drawn[symbol.index()].sin_cos();
        let [x, y] = v.map(|component| self.drawn_value(component));
        [cosine * x - sine * y, sine * x + cosine * y]
    }

    /// A new assembly mode, positive or negative as in the drawing.
    pub(super) fn branch(&mut self, name: &str, meaning: String, drawn: f64) -> ExprId {
        let symbol = self.system.intermediate("branch");
        self.branches.push(Branch {
            name: name.to_string(),
            symbol,
            positive: drawn >= 0.0,
            meaning,
        });
        self.graph().variable(symbol)
    }
}

/// The parts of a turned vector's motion that come from its own change: R ṗ and R p̈.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    /// The unknown that turns it.
    pub angle: usize,
    /// The vector in the orientation that turns.
    pub p: Vector,
    /// The turned vector.
    pub w: Vector,
    /// What turns it.
    pub direction: Direction,
    pub stretch: [SymbolId; 2],
    pub pull: [SymbolId; 2],
    pub first: Vector,
    pub second: Vector,
}
