//! Differentiates the pose of a block along a direction.
//!
//! The equations of the rates apply with δ in place of t: the same matrices with another right-hand side. A solved unknown has
//! its response, a rotated vector moves with its angle, δ has the derivative 1, and time is constant. Zero responses are known
//! symbolically and are not computed.

mod responses;

use std::collections::{HashMap, HashSet};

use crate::expr::{ExprId, SymbolId};
use crate::joint::geometry::Vector;
use crate::pool::{Pool, SymbolRole};
use crate::system::{Direction, System};

/// Responses of all solved values to each direction.
#[derive(Clone, Debug)]
pub(super) struct DirectionalDerivatives {
    directions: Vec<Along>,
    /// Rotated vectors of links with variable length: angle and other component, by component.
    turned: HashMap<SymbolId, Turned>,
    /// Values of locals that depend on parameters alone.
    fixed: HashMap<SymbolId, ExprId>,
    /// Components of the vectors whose lengths are named; only looked up.
    lengths: HashMap<SymbolId, Vec<ExprId>>,
    /// Names of all values that a frame could keep; only looked up.
    taken: HashSet<String>,
    /// Symbols of derivatives of unknowns and of their rates; only looked up.
    found: HashSet<SymbolId>,
}

/// Responses to one direction.
#[derive(Clone, Debug)]
struct Along {
    symbol: SymbolId,
    name: String,
    is_parameter: bool,
    /// Responses by unknown; `None` if the unknown is not solved yet.
    values: Vec<Option<ExprId>>,
    /// Rates of these responses by unknown, if the direction is a parameter.
    rates: Vec<Option<ExprId>>,
    /// Relative changes R ∂s/∂p of rotated vectors, by index.
    arms: HashMap<usize, Vector>,
    /// Relative changes of rotated vectors of variable length.
    stretches: HashMap<SymbolId, ExprId>,
}

/// Component of a vector w that rotates with an angle: its derivative is a multiple of the other component.
#[derive(Clone, Copy, Debug)]
struct Turned {
    angle: usize,
    /// Value −w_y for w_x, and w_x for w_y.
    across: ExprId,
}

impl DirectionalDerivatives {
    /// Returns the symbols by which drivers are shifted, all zero.
    pub fn shifts(&self) -> Vec<SymbolId> {
        let shifts = self.directions.iter().filter(|along| !along.is_parameter);
        shifts.map(|along| along.symbol).collect()
    }

    /// Returns the state before the first block.
    pub(super) fn new(pool: &mut Pool, system: &System) -> DirectionalDerivatives {
        let unknowns = system.vector_form.unknowns.len();
        let along = |direction: &Direction| Along {
            symbol: direction.symbol,
            name: direction.name.clone(),
            is_parameter: direction.is_parameter(),
            values: vec![None; unknowns],
            rates: vec![None; unknowns],
            arms: HashMap::new(),
            stretches: HashMap::new(),
        };
        let directions: Vec<Along> = system.directions.iter().map(along).collect();
        let mut derivatives = DirectionalDerivatives {
            directions,
            turned: HashMap::new(),
            fixed: HashMap::new(),
            lengths: HashMap::new(),
            taken: HashSet::new(),
            found: HashSet::new(),
        };
        for place in 0..pool.arms().len() {
            derivatives.change_arm(place, pool);
        }
        if !derivatives.directions.is_empty() {
            let form = &system.vector_form;
            let unknowns = form.unknowns.iter().map(|unknown| unknown.name.clone());
            derivatives.taken.extend(unknowns);
            let arms = pool.arms().iter().flat_map(|arm| arm.symbols);
            let names = arms.map(|symbol| pool.local_name(symbol).to_string());
            derivatives.taken.extend(names);
        }
        derivatives
    }

    /// Adds a direction for each of these unknowns, with derivative 1; unsolved unknowns count as constant. Returns the indices
    /// of the directions.
    pub(super) fn tear(
        &mut self,
        unknowns: &[usize],
        pool: &mut Pool,
        system: &System,
    ) -> Vec<usize> {
        let count = system.vector_form.unknowns.len();
        let mut places = Vec::with_capacity(unknowns.len());
        for &unknown in unknowns {
            let name = system.unknown_name(unknown).to_string();
            let mut values = vec![None; count];
            values[unknown] = Some(pool.graph.one());
            places.push(self.directions.len());
            self.directions.push(Along {
                symbol: pool.intermediate(&name),
                name,
                is_parameter: false,
                values,
                rates: vec![None; count],
                arms: HashMap::new(),
                stretches: HashMap::new(),
            });
        }
        places
    }

    /// Removes directions that were added.
    pub(super) fn mend(&mut self, places: &[usize]) {
        let left = self.directions.len() - places.len();
        self.directions.truncate(left);
    }

    /// Makes the rotated vectors R ∂s/∂p of a vector R s, which are defined like R s.
    pub(super) fn change_arm(&mut self, place: usize, pool: &mut Pool) {
        for along in self.directions.iter_mut().filter(|it| it.is_parameter) {
            let arm = &pool.arms()[place];
            let (angle, local, name) = (arm.angle, arm.local, &arm.name);
            let name = format!("{name}_by_{}", along.name);
            let graph = &mut pool.graph;
            let change = local.map(|part| graph.derivative(part, along.symbol));
            if change != [graph.zero(); 2] {
                let changed = pool.arm(angle, change, &name);
                along.arms.insert(place, changed);
            }
        }
    }

    /// Returns the derivative of an expression of unknowns and rotated vectors. Unsolved unknowns count as constant.
    pub(super) fn along(
        &self,
        expr: ExprId,
        direction: usize,
        pool: &mut Pool,
        system: &System,
    ) -> ExprId {
        let symbols = pool.graph.symbols(expr).to_vec();
        let mut terms = Vec::with_capacity(symbols.len());
        for symbol in symbols {
            let response = self.of_symbol(symbol, direction, pool, system);
            if response != pool.graph.zero() {
                let graph = &mut pool.graph;
                let partial = graph.derivative(expr, symbol);
                terms.push(graph.multiply(partial, response));
            }
        }
        pool.graph.sum(&terms)
    }

    fn of_symbol(
        &self,
        symbol: SymbolId,
        direction: usize,
        pool: &mut Pool,
        system: &System,
    ) -> ExprId {
        let along = &self.directions[direction];
        let zero = pool.graph.zero();
        match pool.role(symbol) {
            SymbolRole::Position(unknown) => along.values[unknown].unwrap_or(zero),
            SymbolRole::Rate(unknown) => along.rates[unknown].unwrap_or(zero),
            SymbolRole::Arm(place) => {
                let arm = pool.arms()[place].clone();
                let graph = &mut pool.graph;
                let turning = along.values[arm.angle].unwrap_or(zero);
                let [x, y] = arm.symbols.map(|component| graph.variable(component));
                let across = if symbol == arm.symbols[0] {
                    graph.negate(y)
                } else {
                    x
                };
                let turned = graph.multiply(turning, across);
                let component = usize::from(symbol != arm.symbols[0]);
                let changed = along.arms.get(&place).map_or(zero, |it| it[component]);
                graph.add(turned, changed)
            }
            _ if symbol == along.symbol => pool.graph.one(),
            SymbolRole::Time | SymbolRole::Parameter(_) | SymbolRole::Input { .. } => zero,
            _ if self.directions.iter().any(|other| other.symbol == symbol) => zero,
            _ => {
                if let Some(components) = self.lengths.get(&symbol) {
                    let mut terms = Vec::with_capacity(components.len());
                    for &component in components {
                        let along = self.along(component, direction, pool, system);
                        terms.push(pool.graph.multiply(component, along));
                    }
                    let graph = &mut pool.graph;
                    let sum = graph.sum(&terms);
                    let length = graph.variable(symbol);
                    return graph.divide(sum, length);
                }
                if let Some(&value) = self.fixed.get(&symbol) {
                    return self.along(value, direction, pool, system);
                }
                let graph = &mut pool.graph;
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

    /// Returns the response of a solved unknown; zero before.
    pub(super) fn of_unknown(&self, unknown: usize, direction: usize, pool: &Pool) -> ExprId {
        let value = self.directions[direction].values[unknown];
        value.unwrap_or(pool.graph.zero())
    }

    /// Returns the rate of this response.
    pub(super) fn rate_of_unknown(&self, unknown: usize, direction: usize, pool: &Pool) -> ExprId {
        let rate = self.directions[direction].rates[unknown];
        rate.unwrap_or(pool.graph.zero())
    }

    /// True if a symbol is the derivative of an unknown or of its rate.
    pub(super) fn is_response(&self, symbol: SymbolId) -> bool {
        self.found.contains(&symbol)
    }

    /// Records a symbol that is the length of a vector with these components.
    pub(super) fn fix_length(&mut self, symbol: SymbolId, components: Vec<ExprId>) {
        self.lengths.insert(symbol, components);
    }

    /// Records the value of a local value.
    pub(super) fn fix(&mut self, symbol: SymbolId, value: ExprId) {
        self.fixed.insert(symbol, value);
    }

    /// Returns the relative change of a rotated vector along a direction.
    pub(super) fn stretch_of(&self, symbol: SymbolId, direction: usize) -> Option<ExprId> {
        self.directions[direction].stretches.get(&symbol).copied()
    }

    /// Records the relative change of a rotated vector along a direction.
    pub(super) fn set_stretch(&mut self, symbol: SymbolId, direction: usize, value: ExprId) {
        self.directions[direction].stretches.insert(symbol, value);
    }

    /// Returns a unique name such as `phi_c1_by_drive_length_n_m`.
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
