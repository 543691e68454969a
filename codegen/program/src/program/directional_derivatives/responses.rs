//! States the responses of a block's unknowns along a direction, and their rates.

use super::Turned;
use crate::expr::{ExprId, Node, SymbolId};
use crate::program::block::NewtonBlock;
use crate::program::builder::Builder;
use crate::program::function::{Level, Statement};
use crate::system::Cause;

impl Builder<'_> {
    /// Returns the derivative of an expression along a direction.
    pub(in crate::program) fn along(&mut self, expr: ExprId, direction: usize) -> ExprId {
        self.derivatives
            .along(expr, direction, self.pool, self.system)
    }

    /// Assigns the response of an unknown. A constant needs no name, and its products may vanish.
    pub(in crate::program) fn respond(&mut self, unknown: usize, direction: usize, value: ExprId) {
        let value = if self.pool.graph.is_constant(value) {
            value
        } else {
            let target = self.response_symbol(unknown, direction);
            self.assign(target, value);
            self.graph().variable(target)
        };
        self.derivatives.directions[direction].values[unknown] = Some(value);
    }

    /// Assigns the rate of a response; that of a constant is zero whatever `value` is.
    pub(in crate::program) fn respond_rate(
        &mut self,
        unknown: usize,
        direction: usize,
        value: ExprId,
    ) {
        let graph = &self.pool.graph;
        if self.response(unknown, direction).is_none() || value == graph.zero() {
            return;
        }
        let target = self.response_rate_symbol(unknown, direction);
        self.assign(target, value);
        self.found_rate(unknown, direction, target);
    }

    /// Returns the symbol of a response; `None` if the response is constant.
    fn response(&self, unknown: usize, direction: usize) -> Option<SymbolId> {
        let value = self.derivatives.directions[direction].values[unknown]?;
        match *self.pool.graph.node(value) {
            Node::Symbol(symbol) => Some(symbol),
            _ => None,
        }
    }

    fn found_rate(&mut self, unknown: usize, direction: usize, target: SymbolId) {
        let rate = self.graph().variable(target);
        if let Some(symbol) = self.response(unknown, direction) {
            self.pool.set_rate(symbol, rate);
        }
        self.derivatives.directions[direction].rates[unknown] = Some(rate);
    }

    fn response_symbol(&mut self, unknown: usize, direction: usize) -> SymbolId {
        let name = self.system.unknown_name(unknown).to_string();
        let name = self.derivatives.name(&name, direction);
        let symbol = self.pool.intermediate(&name);
        self.derivatives.found.insert(symbol);
        // Unsolved unknowns count as constant.
        let zero = self.graph().zero();
        self.pool.set_rate(symbol, zero);
        symbol
    }

    fn response_rate_symbol(&mut self, unknown: usize, direction: usize) -> SymbolId {
        let name = format!("{}_rate", self.system.unknown_name(unknown));
        let name = self.derivatives.name(&name, direction);
        let symbol = self.pool.intermediate(&name);
        self.derivatives.found.insert(symbol);
        symbol
    }

    /// Records the responses of the symbols of R(φ) p.
    pub(in crate::program) fn turn_response(&mut self, angle: usize, w: [ExprId; 2]) {
        if self.derivatives.directions.is_empty() {
            return;
        }
        let back = self.graph().negate(w[1]);
        for (component, across) in w.into_iter().zip([back, w[0]]) {
            if let Node::Symbol(symbol) = *self.pool.graph.node(component) {
                self.derivatives
                    .turned
                    .insert(symbol, Turned { angle, across });
            }
        }
    }

    /// Solves for the responses of the tearing variables, or their rates, with the Jacobian of the last Newton-Raphson step,
    /// which the first solve factorizes.
    pub(in crate::program) fn newton_response(
        &mut self,
        unknowns: &[usize],
        residuals: &[ExprId],
        level: Level,
    ) {
        let (direction, is_rate) = match level {
            Level::Response(direction) => (direction, false),
            Level::ResponseRate(direction) => (direction, true),
            _ => return,
        };
        let zero = self.graph().zero();
        let mut right_hand_side = Vec::with_capacity(residuals.len());
        for &residual in residuals {
            let slope = self.rate_at(residual, level);
            right_hand_side.push(self.graph().negate(slope));
        }
        if right_hand_side.iter().all(|&value| value == zero) {
            for &unknown in unknowns {
                self.find(unknown, level, zero);
            }
            return;
        }
        let mut targets = Vec::with_capacity(unknowns.len());
        for &unknown in unknowns {
            if is_rate {
                let target = self.response_rate_symbol(unknown, direction);
                targets.push(Some(target));
                self.found_rate(unknown, direction, target);
            } else {
                let target = self.response_symbol(unknown, direction);
                targets.push(Some(target));
                let value = self.graph().variable(target);
                self.derivatives.directions[direction].values[unknown] = Some(value);
            }
        }
        if !self.statements.contains(&Statement::Factorize) {
            self.state(Statement::Factorize);
        }
        self.state(Statement::Solve {
            targets,
            right_hand_side,
        });
    }

    /// Sets δ = 0 in the statements and in the equations of Newton-Raphson.
    pub(in crate::program) fn without_shifts(&mut self, newton: Option<&mut NewtonBlock>) {
        let shifts = self.derivatives.shifts();
        if shifts.is_empty() {
            return;
        }
        let mut statements = std::mem::take(&mut self.statements);
        let mut at_zero = |expr: ExprId| self.without(expr, &shifts);
        for statement in &mut statements {
            statement.change_values(&mut at_zero);
        }
        let functions = newton.into_iter().flat_map(NewtonBlock::functions_mut);
        for function in functions {
            function.change_values(&mut at_zero);
        }
        self.statements = statements;
    }

    /// Returns the levels of a block after its pose, in their order.
    pub(in crate::program) fn levels(&self) -> Vec<Level> {
        // Efforts shift drivers but need no responses; the reduced mass needs those of free coordinates.
        let mechanism = &self.system.mechanism;
        let transmits = !mechanism.transmissions.is_empty();
        let is_free = |place: usize| match self.system.directions.get(place).map(|it| it.cause) {
            Some(Cause::Driver { joint, .. }) => {
                mechanism.forces.free.iter().any(|it| it.joint == joint)
            }
            _ => false,
        };
        let directions = self.derivatives.directions.iter().enumerate();
        let directions =
            directions.filter(|&(place, along)| along.is_parameter || transmits || is_free(place));
        let derivatives = directions.flat_map(|(place, along)| {
            let rate = along.is_parameter.then_some(Level::ResponseRate(place));
            [Some(Level::Response(place)), rate].into_iter().flatten()
        });
        [Level::Velocity, Level::Acceleration]
            .into_iter()
            .chain(derivatives)
            .collect()
    }
}
