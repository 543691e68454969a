//! States the quantities of `measure` statements in terms of the vector form.

use super::{Carried, Component, System};
use crate::expr::{ExprId, Graph, Node, SymbolId};
use crate::model::{ForceTerm, MeasureTerm, ReactionPart};
use crate::pool::{Pool, SymbolRole};

/// Measures in terms of the vector form.
#[derive(Clone, Debug, Default)]
pub struct Measures {
    /// Value of each measure: a formula of unknowns, rates, accelerations, rotated vectors, t, inputs, parameters, forces, and symbols
    /// of definitions.
    pub values: Vec<ExprId>,
    /// Definitions, each behind those that it contains.
    pub definitions: Vec<Definition>,
    /// Symbols of forces in the values, each with the index of its column.
    pub forces: Vec<(SymbolId, usize)>,
}

/// Intermediate value of measures: a component of a vector, its length, or a rate of one of them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Definition {
    /// Symbol of the value.
    pub symbol: SymbolId,
    /// Value.
    pub value: ExprId,
    /// Order of differentiation: 0 for positions, 1 for rates, 2 for accelerations, 3 for forces.
    pub order: usize,
    /// Components of the vector whose length this is; `None` for other values.
    pub length_of: Option<Vec<ExprId>>,
}

/// Order of differentiation of forces.
const ORDER_OF_FORCES: usize = 3;

/// Suffixes of names of values, by order of differentiation.
const SUFFIXES: [&str; 3] = ["", "_rate", "_acceleration"];

impl Measures {
    /// Returns an expression without symbols of definitions.
    pub fn expanded(&self, expr: ExprId, graph: &mut Graph) -> ExprId {
        let definitions = self.definitions.iter().rev();
        definitions.fold(expr, |expr, it| {
            graph.substitute(expr, &[(it.symbol, it.value)])
        })
    }
}

/// Column of a requested force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ForceColumn {
    /// Force or torque of a driver: an index into the mechanism's joints.
    Effort(usize),
    /// Power of a driver: an index into the mechanism's joints.
    Power(usize),
    /// Component of the reaction of a joint: an index into the mechanism's joints.
    Reaction(usize, Component),
    /// Kinetic energy.
    KineticEnergy,
    /// Potential energy.
    PotentialEnergy,
    /// Power of dampers, forces and torques.
    AddedPower,
    /// Friction on the second body of a joint: an index into the mechanism's joints.
    Friction(usize),
    /// Power of all drivers without friction.
    FrictionlessPower,
    /// Power of all drivers with the friction of the motion in reverse.
    BackwardPower,
}

impl System {
    /// Returns the columns of requested forces: efforts with powers, then reactions, then energies, then friction.
    pub fn force_columns(&self, pool: &mut Pool) -> Vec<ForceColumn> {
        let requests = &self.mechanism.forces;
        let mut columns = Vec::new();
        if requests.efforts {
            let driven = self.driven();
            columns.extend(
                driven.flat_map(|(_, joint, _)| {
                    [ForceColumn::Effort(joint), ForceColumn::Power(joint)]
                }),
            );
        }
        for &joint in &requests.reactions {
            let passing = self.passing(joint, &self.vector_form.rows, pool);
            let components = passing.carried.components().iter();
            columns.extend(components.map(|it| ForceColumn::Reaction(joint, *it)));
        }
        if requests.energy {
            columns.extend([
                ForceColumn::KineticEnergy,
                ForceColumn::PotentialEnergy,
                ForceColumn::AddedPower,
            ]);
        }
        if !requests.frictions.is_empty() {
            let frictions = requests.frictions.iter();
            columns.extend(frictions.map(|it| ForceColumn::Friction(it.joint)));
            columns.extend([ForceColumn::FrictionlessPower, ForceColumn::BackwardPower]);
        }
        columns
    }
}

/// States all measures of a system.
pub(super) fn measures(system: &System, pool: &mut Pool) -> Measures {
    let mut measures = Measures::default();
    let mechanism = &system.mechanism;
    let mut forces = mechanism.measurements.iter().flat_map(|it| it.forces());
    let has_forces = forces.next().is_some();
    let columns = match has_forces {
        true => system.force_columns(pool),
        false => Vec::new(),
    };
    let mut earlier: Vec<(SymbolId, ExprId)> = Vec::new();
    for (place, measurement) in mechanism.measurements.iter().enumerate() {
        let is_still = mechanism.forces.at_rest && mechanism.motors.iter().any(|it| it.has(place));
        let mut replaced = earlier.clone();
        for (mark, symbols) in &measurement.marks {
            let mark = system
                .vector_form
                .mark_with_arm(mark, &mechanism.bodies, pool);
            if let Some(symbols) = symbols {
                replaced.extend(symbols.iter().copied().zip(mark.arm));
            }
        }
        for (symbol, term) in &measurement.terms {
            let value = match term {
                MeasureTerm::Force(force) => {
                    force_value(*force, &columns, &mut measures, system, pool)
                }
                MeasureTerm::Rate(_) if is_still => pool.graph.zero(),
                MeasureTerm::Rate(formula) => {
                    let formula = pool.graph.substitute(*formula, &replaced);
                    pool.rate(formula)
                }
                MeasureTerm::Length { name, components } => {
                    let graph = &mut pool.graph;
                    let components = components.iter();
                    let components = components.map(|it| graph.substitute(*it, &replaced));
                    let components = components.collect();
                    measures.length(name, components, pool)
                }
            };
            replaced.push((*symbol, value));
        }
        let value = pool.graph.substitute(measurement.value, &replaced);
        measures.values.push(value);
        earlier.push((measurement.symbol, value));
        if pool.is_beyond(measurement.span) {
            break;
        }
    }
    measures
}

impl Measures {
    /// Defines the length of a vector, with its components and their rates.
    fn length(&mut self, name: &str, components: Vec<ExprId>, pool: &mut Pool) -> ExprId {
        let orders = components.iter().map(|it| self.order(*it, pool));
        let order = orders.max().unwrap_or(0);
        let axes = ["x", "y", "z"].iter();
        let parts = components.into_iter().zip(axes);
        let parts: Vec<ExprId> = parts
            .map(|(part, axis)| self.component(&format!("{name}_{axis}"), part, order, pool))
            .collect();
        let graph = &mut pool.graph;
        let square = product(&parts, &parts, graph);
        let length = graph.sqrt(square);
        if graph.is_constant(length) || self.is_single(length, pool) {
            return length;
        }
        let defined = self.define(name, length, order, Some(parts.clone()), pool);
        let symbol = pool.graph.variable(defined);
        // d/dt |v| = v · v̇ / |v|, and |v| d²/dt² |v| = v̇ · v̇ + v · v̈ − (d/dt |v|)².
        let mut last = defined;
        let mut rates: Vec<Vec<ExprId>> = vec![parts];
        for (order, suffix) in SUFFIXES.iter().enumerate().skip(order + 1) {
            let next = rates.last().into_iter().flatten();
            let next: Vec<ExprId> = next.map(|it| pool.rate(*it)).collect();
            let graph = &mut pool.graph;
            let [first, ..] = &rates[..] else {
                break;
            };
            let value = match &rates[..] {
                [_, second] => {
                    let rate = graph.variable(last);
                    let terms = [product(second, second, graph), product(first, &next, graph)];
                    let sum = graph.sum(&terms);
                    let square = graph.multiply(rate, rate);
                    graph.subtract(sum, square)
                }
                _ => product(first, &next, graph),
            };
            let value = graph.divide(value, symbol);
            let defined = self.define(&format!("{name}{suffix}"), value, order, None, pool);
            let rate = pool.graph.variable(defined);
            pool.set_rate(last, rate);
            last = defined;
            rates.push(next);
        }
        symbol
    }

    /// Defines a component of a vector with its rates up to the second order. Symbols and constants need no definition.
    fn component(&mut self, name: &str, value: ExprId, order: usize, pool: &mut Pool) -> ExprId {
        if pool.graph.is_constant(value) || self.is_single(value, pool) {
            return value;
        }
        let known = self.definitions.iter().find(|it| it.value == value);
        if let Some(known) = known {
            return pool.graph.variable(known.symbol);
        }
        let symbol = self.define(name, value, order, None, pool);
        let (mut last, mut value) = (symbol, value);
        for (order, suffix) in SUFFIXES.iter().enumerate().skip(order + 1) {
            value = pool.rate(value);
            let symbol = self.define(&format!("{name}{suffix}"), value, order, None, pool);
            let rate = pool.graph.variable(symbol);
            pool.set_rate(last, rate);
            last = symbol;
        }
        pool.graph.variable(symbol)
    }

    /// True for a symbol, whose value has a name already.
    fn is_single(&self, value: ExprId, pool: &Pool) -> bool {
        matches!(pool.graph.node(value), Node::Symbol(_))
    }

    fn define(
        &mut self,
        name: &str,
        value: ExprId,
        order: usize,
        length_of: Option<Vec<ExprId>>,
        pool: &mut Pool,
    ) -> SymbolId {
        let symbol = pool.intermediate(name);
        self.definitions.push(Definition {
            symbol,
            value,
            order,
            length_of,
        });
        symbol
    }

    /// Returns the order of differentiation of an expression.
    fn order(&self, expr: ExprId, pool: &Pool) -> usize {
        let symbols = pool.graph.symbols(expr).iter();
        let orders = symbols.map(|&symbol| match pool.role(symbol) {
            SymbolRole::Rate(_) => 1,
            SymbolRole::Acceleration(_) => 2,
            SymbolRole::Input { level, .. } => level,
            _ if self.forces.iter().any(|it| it.0 == symbol) => ORDER_OF_FORCES,
            _ => {
                let definitions = self.definitions.iter();
                let mut definitions = definitions.filter(|it| it.symbol == symbol);
                definitions.next().map_or(0, |it| it.order)
            }
        });
        orders.max().unwrap_or(0)
    }
}

/// Returns the scalar product of two vectors.
fn product(one: &[ExprId], other: &[ExprId], graph: &mut Graph) -> ExprId {
    let products = one.iter().zip(other);
    let products: Vec<ExprId> = products.map(|(a, b)| graph.multiply(*a, *b)).collect();
    graph.sum(&products)
}

/// Returns a force in terms of symbols of columns.
fn force_value(
    force: ForceTerm,
    columns: &[ForceColumn],
    measures: &mut Measures,
    system: &System,
    pool: &mut Pool,
) -> ExprId {
    let mut column = |wanted: ForceColumn, pool: &mut Pool| {
        let Some(place) = columns.iter().position(|it| *it == wanted) else {
            return pool.graph.zero();
        };
        let known = measures.forces.iter().find(|it| it.1 == place);
        let symbol = match known {
            Some((symbol, _)) => *symbol,
            None => {
                let symbol = pool.intermediate("force");
                measures.forces.push((symbol, place));
                symbol
            }
        };
        pool.graph.variable(symbol)
    };
    let (joint, part) = match force {
        ForceTerm::Effort(joint) => return column(ForceColumn::Effort(joint), pool),
        ForceTerm::Power(joint) => return column(ForceColumn::Power(joint), pool),
        ForceTerm::Reaction(joint, part) => (joint, part),
        ForceTerm::KineticEnergy => return column(ForceColumn::KineticEnergy, pool),
        ForceTerm::PotentialEnergy => return column(ForceColumn::PotentialEnergy, pool),
    };
    let axis = match part {
        ReactionPart::X => 0,
        ReactionPart::Y => 1,
        ReactionPart::Moment => {
            return column(ForceColumn::Reaction(joint, Component::Moment), pool);
        }
    };
    let passing = system.passing(joint, &system.vector_form.rows, pool);
    let along = match passing.carried {
        Carried::NormalAndMoment(direction) | Carried::Normal(direction) => {
            (Component::Normal, direction)
        }
        Carried::Tension(direction) => (Component::Tension, direction),
        Carried::Tooth(direction) => (Component::Tooth, direction),
        Carried::Pressure(direction) => (Component::Pressure, direction),
        _ => {
            let component = [Component::X, Component::Y][axis];
            return column(ForceColumn::Reaction(joint, component), pool);
        }
    };
    let (component, direction) = along;
    let value = column(ForceColumn::Reaction(joint, component), pool);
    pool.graph.multiply(value, direction[axis])
}
