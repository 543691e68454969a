//! The derivative of a block's pose along a direction.
//!
//! The same equations as for the rates, differentiated once along δ in place of t: what the block's rates are solved with serves
//! again, with another right-hand side. An unknown responds with what was found for it, an arm turns with its angle, δ itself
//! grows by one, and time stands still. What does not respond at all is known to be zero, so that nothing is computed for it.

use std::collections::{HashMap, HashSet};

use super::builder::{Builder, Stretch};
use super::{Action, Level, NewtonBlock};
use crate::expr::{ExprId, Node, SymbolId};
use crate::system::{SymbolRole, System};

/// How everything found so far responds to each direction.
#[derive(Clone, Debug)]
pub(super) struct Responses {
    directions: Vec<Along>,
    /// The turned vectors of links that change their length: which angle turns them, and the other component, by component.
    turned: HashMap<SymbolId, Turned>,
    /// What local values are that depend on parameters alone.
    fixed: HashMap<SymbolId, ExprId>,
    /// The names of all values that a frame could hold; only looked up.
    taken: HashSet<String>,
}

/// The responses to one direction.
#[derive(Clone, Debug)]
struct Along {
    symbol: SymbolId,
    name: String,
    /// By unknown; none while it has not been found.
    values: Vec<Option<ExprId>>,
    /// What changes a turned vector beside its angle.
    stretches: HashMap<SymbolId, ExprId>,
}

/// A component of a vector w that turns with an angle: its derivative is a multiple of the other component.
#[derive(Clone, Copy, Debug)]
struct Turned {
    angle: usize,
    /// −w_y for w_x, w_x for w_y.
    across: ExprId,
}

impl Responses {
    /// Nothing has been found yet.
    pub(super) fn new(system: &System) -> Responses {
        let unknowns = system.vector_form.unknowns.len();
        let along = |direction: &crate::system::Direction| Along {
            symbol: direction.symbol,
            name: direction.name.clone(),
            values: vec![None; unknowns],
            stretches: HashMap::new(),
        };
        let directions: Vec<Along> = system.directions.iter().map(along).collect();
        let mut taken = HashSet::new();
        if !directions.is_empty() {
            let form = &system.vector_form;
            taken.extend(form.unknowns.iter().map(|unknown| unknown.name.clone()));
            let arms = form.arms.iter().flat_map(|arm| arm.symbols);
            taken.extend(arms.map(|symbol| system.local_name(symbol).to_string()));
        }
        Responses {
            directions,
            turned: HashMap::new(),
            fixed: HashMap::new(),
            taken,
        }
    }

    /// The derivative of an expression of unknowns, arms and turned vectors. Unknowns that have not been found are held.
    pub(super) fn along(&self, expr: ExprId, direction: usize, system: &mut System) -> ExprId {
        let symbols = system.mechanism.graph.symbols(expr).to_vec();
        let mut terms = Vec::with_capacity(symbols.len());
        for symbol in symbols {
            let response = self.of_symbol(symbol, direction, system);
            if response != system.mechanism.graph.zero() {
                let graph = &mut system.mechanism.graph;
                let partial = graph.derivative(expr, symbol);
                terms.push(graph.multiply(partial, response));
            }
        }
        system.mechanism.graph.sum(&terms)
    }

    fn of_symbol(&self, symbol: SymbolId, direction: usize, system: &mut System) -> ExprId {
        let along = &self.directions[direction];
        let form = &system.vector_form;
        let graph = &mut system.mechanism.graph;
        let zero = graph.zero();
        match system.roles[symbol.index()] {
            SymbolRole::Position(unknown) => along.values[unknown].unwrap_or(zero),
            SymbolRole::Arm(place) => {
                let arm = &form.arms[place];
                let turning = along.values[arm.angle].unwrap_or(zero);
                let [x, y] = arm.symbols.map(|component| graph.variable(component));
                let across = if symbol == arm.symbols[0] {
                    graph.negate(y)
                } else {
                    x
                };
                graph.multiply(turning, across)
            }
            SymbolRole::Time | SymbolRole::Parameter(_) | SymbolRole::Input { .. } => zero,
            _ if symbol == along.symbol => graph.one(),
            _ if self.directions.iter().any(|other| other.symbol == symbol) => zero,
            _ => {
                if let Some(&value) = self.fixed.get(&symbol) {
                    return self.along(value, direction, system);
                }
                let Some(turned) = self.turned.get(&symbol) else {
                    unreachable!("`{}` has no rule of response", graph.symbol_name(symbol))
                };
                let turning = along.values[turned.angle].unwrap_or(zero);
                let turned = graph.multiply(turning, turned.across);
                let stretch = along.stretches.get(&symbol).copied().unwrap_or(zero);
                graph.add(turned, stretch)
            }
        }
    }

    /// The response of an unknown that has been found; zero before.
    pub(super) fn of_unknown(&self, unknown: usize, direction: usize, system: &System) -> ExprId {
        let value = self.directions[direction].values[unknown];
        value.unwrap_or(system.mechanism.graph.zero())
    }

    /// A name that nothing else has: `phi_c1_by_drive_length_n_m`.
    pub(super) fn name(&mut self, what: &str, direction: usize) -> String {
        let base = format!("{what}_by_{}", self.directions[direction].name);
        let numbered = (2..).map(|number| format!("{base}_{number}"));
        let name = std::iter::once(base.clone())
            .chain(numbered)
            .find(|name| !self.taken.contains(name))
            .unwrap_or(base);
        self.taken.insert(name.clone());
        name
    }
}

impl Builder<'_> {
    /// The derivative of an expression along a direction.
    pub(super) fn along(&mut self, expr: ExprId, direction: usize) -> ExprId {
        self.responses.along(expr, direction, self.system)
    }

    /// States the response of an unknown. A constant needs no name, and what it multiplies may vanish.
    pub(super) fn respond(&mut self, unknown: usize, direction: usize, value: ExprId) {
        let value = if self.system.mechanism.graph.is_constant(value) {
            value
        } else {
            let target = self.response_symbol(unknown, direction);
            self.assign(target, value);
            self.graph().variable(target)
        };
        self.responses.directions[direction].values[unknown] = Some(value);
    }

    fn response_symbol(&mut self, unknown: usize, direction: usize) -> SymbolId {
        let name = self.system.unknown_name(unknown).to_string();
        let name = self.responses.name(&name, direction);
        self.system.intermediate(&name)
    }

    /// States what a local value is that depends on parameters alone.
    pub(super) fn fix(&mut self, symbol: SymbolId, value: ExprId) {
        self.responses.fixed.insert(symbol, value);
    }

    /// States that the symbols of a turned vector respond as R(φ) p does.
    pub(super) fn turn_response(&mut self, angle: usize, w: [ExprId; 2]) {
        if self.responses.directions.is_empty() {
            return;
        }
        let back = self.graph().negate(w[1]);
        for (component, across) in w.into_iter().zip([back, w[0]]) {
            if let Node::Symbol(symbol) = *self.system.mechanism.graph.node(component) {
                self.responses
                    .turned
                    .insert(symbol, Turned { angle, across });
            }
        }
    }

    /// What changes a turned vector along a direction beside its angle, as local values: R ∂p/∂δ.
    pub(super) fn stretch_response(&mut self, stretch: &Stretch, direction: usize) {
        let zero = self.graph().zero();
        let change = stretch.p.map(|part| self.along(part, direction));
        if change == [zero, zero] {
            return;
        }
        let turned = self.turn(stretch.direction, change);
        let values = self.vector("stretch", turned);
        for (component, value) in stretch.w.into_iter().zip(values) {
            if let Node::Symbol(symbol) = *self.system.mechanism.graph.node(component) {
                self.responses.directions[direction]
                    .stretches
                    .insert(symbol, value);
            }
        }
    }

    /// The responses of the tears: one solve with the Jacobian that Newton-Raphson ended with, factorized at the first of them.
    pub(super) fn newton_response(&mut self, newton: &NewtonBlock, direction: usize) {
        let zero = self.graph().zero();
        let mut right_hand_side = Vec::with_capacity(newton.residuals.len());
        for &residual in &newton.residuals {
            let slope = self.along(residual, direction);
            right_hand_side.push(self.graph().negate(slope));
        }
        if right_hand_side.iter().all(|&value| value == zero) {
            for &unknown in &newton.unknowns {
                self.respond(unknown, direction, zero);
            }
            return;
        }
        let mut targets = Vec::with_capacity(newton.unknowns.len());
        for &unknown in &newton.unknowns {
            let target = self.response_symbol(unknown, direction);
            targets.push(Some(target));
            let value = self.graph().variable(target);
            self.responses.directions[direction].values[unknown] = Some(value);
        }
        if !self.actions.contains(&Action::Factorize) {
            self.actions.push(Action::Factorize);
        }
        self.actions.push(Action::Solve {
            targets,
            right_hand_side,
        });
    }

    /// The actions, and the equations of Newton-Raphson, at δ = 0.
    pub(super) fn without_shifts(&mut self, newton: Option<&mut NewtonBlock>) {
        if self.responses.directions.is_empty() {
            return;
        }
        let shifts: Vec<SymbolId> = self
            .responses
            .directions
            .iter()
            .map(|along| along.symbol)
            .collect();
        let mut actions = std::mem::take(&mut self.actions);
        let mut at_zero = |expr: ExprId| self.without(expr, &shifts);
        for action in &mut actions {
            action.change_values(&mut at_zero);
        }
        if let Some(newton) = newton {
            for action in &mut newton.geometry {
                action.change_values(&mut at_zero);
            }
            let lists = [
                &mut newton.residuals,
                &mut newton.jacobian,
                &mut newton.time_derivative,
                &mut newton.gamma,
            ];
            for value in lists.into_iter().flatten() {
                *value = at_zero(*value);
            }
        }
        self.actions = actions;
    }

    /// The levels of a block after its pose, in their order.
    pub(super) fn levels(&self) -> Vec<Level> {
        let responses = (0..self.responses.directions.len()).map(Level::Response);
        [Level::Velocity, Level::Acceleration]
            .into_iter()
            .chain(responses)
            .collect()
    }
}
