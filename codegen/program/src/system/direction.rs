//! Derives the directions of motion besides time: values of drivers, and parameters.
//!
//! A driver says quantity = f(t). With f(t) + δ in its place, the pose depends on δ too. At δ = 0, Φ_q ∂q/∂δ = −∂Φ/∂δ gives the
//! response (implicit function theorem; Haug 1989, section 3.6, has this equation in t). Each direction has its symbol δ and its
//! column ∂Φ/∂δ; the rows of the textbook formulation do not mention δ.
//!
//! A parameter p is a symbol of the rows already. It changes the rates too, so (Φ_q q̇ + Φ_t) = 0 has a column of its own.

use std::collections::HashMap;

use super::{Entry, Row, System, Unknown, VectorRow};
use crate::expr::{ExprId, Graph, SymbolId};
use crate::joint::{Quantity, Resolved};
use crate::model::{Mechanism, Role, field_name};
use crate::pool::Pool;

/// Cost of an entry of a column, in terms, including what every block derives from it.
const COLUMN_ENTRY: usize = 50;

/// Direction in which the pose can be moved.
#[derive(Clone, Debug, PartialEq)]
pub struct Direction {
    /// Cause of the motion.
    pub cause: Cause,
    /// Shift of the driver's value, or the parameter itself.
    pub symbol: SymbolId,
    /// Name in generated code: `drive_phi_crank`, `l2`.
    pub name: String,
    /// ∂Φ/∂δ at δ = 0, or ∂Φ/∂p, one expression per row.
    pub column: Vec<ExprId>,
    /// (Φ_q q̇ + Φ_t)_p at constant rates, one expression per row; for parameters only.
    pub rate_column: Vec<ExprId>,
}

/// Cause of a motion besides time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// Value of a driver.
    Driver {
        /// Index into the mechanism's joints.
        joint: usize,
        /// Quantity that is driven.
        quantity: Quantity,
    },
    /// Parameter: an index into the mechanism's parameters.
    Parameter(usize),
}

/// Returns the requested directions: all drivers in written order if a transmission or an effort is requested, then the
/// parameters of sensitivities.
pub(super) fn directions(
    mechanism: &Mechanism,
    rows: &[Row],
    coordinates: &[Unknown],
    pool: &mut Pool,
) -> Vec<Direction> {
    let mut directions = drivers(mechanism, rows, pool);
    directions.extend(parameters(mechanism, rows, coordinates, pool));
    directions
}

/// Φ_q q̇ + Φ_t of a row.
fn rate(row: &Row, coordinates: &[Unknown], graph: &mut Graph) -> ExprId {
    let mut terms = vec![row.time_derivative];
    for entry in &row.jacobian {
        let rate = graph.variable(coordinates[entry.coordinate].rate);
        terms.push(graph.multiply(entry.value, rate));
    }
    graph.sum(&terms)
}

/// Returns (Φ_q q̇ + Φ_t)_q row by row, without entries that are identically zero; empty if no sensitivity is requested.
pub(super) fn rate_jacobian(
    mechanism: &Mechanism,
    rows: &[Row],
    coordinates: &[Unknown],
    graph: &mut Graph,
) -> Vec<Vec<Entry>> {
    if mechanism.sensitivities.is_empty() {
        return Vec::new();
    }
    let positions = coordinates.iter().enumerate();
    let places: HashMap<SymbolId, usize> = positions
        .map(|(place, own)| (own.position, place))
        .collect();
    let mut entries = Vec::with_capacity(rows.len());
    for row in rows {
        let rate = rate(row, coordinates, graph);
        let mentioned = graph.symbols(rate).iter();
        let mut mentioned: Vec<usize> = mentioned
            .filter_map(|symbol| places.get(symbol).copied())
            .collect();
        mentioned.sort_unstable();
        let slope = |coordinate: usize| Entry {
            coordinate,
            value: graph.derivative(rate, coordinates[coordinate].position),
        };
        let mut slopes: Vec<Entry> = mentioned.into_iter().map(slope).collect();
        let zero = graph.zero();
        slopes.retain(|entry| entry.value != zero);
        entries.push(slopes);
    }
    entries
}

/// Returns the directions of the parameters of all sensitivities.
fn parameters(
    mechanism: &Mechanism,
    rows: &[Row],
    coordinates: &[Unknown],
    pool: &mut Pool,
) -> Vec<Direction> {
    let mut directions = Vec::new();
    for parameter in mechanism.sensitivities.iter().copied() {
        let declared = &mechanism.parameters[parameter];
        let (symbol, name) = (declared.symbol, field_name(&declared.name));
        let mut column = Vec::with_capacity(rows.len());
        let mut rate_column = Vec::with_capacity(rows.len());
        let span = declared.span;
        pool.graph.spend(COLUMN_ENTRY * rows.len());
        if pool.is_beyond(span) {
            break;
        }
        for row in rows {
            let rate = rate(row, coordinates, &mut pool.graph);
            column.push(pool.graph.derivative(row.residual, symbol));
            rate_column.push(pool.graph.derivative(rate, symbol));
        }
        directions.push(Direction {
            cause: Cause::Parameter(parameter),
            symbol,
            name,
            column,
            rate_column,
        });
    }
    directions
}

/// Returns the directions of all drivers; empty without transmissions, efforts and coordinates that forces move.
fn drivers(mechanism: &Mechanism, rows: &[Row], pool: &mut Pool) -> Vec<Direction> {
    if mechanism.transmissions.is_empty() && !mechanism.forces.need_efforts() {
        return Vec::new();
    }
    let drivers = mechanism
        .joints
        .iter()
        .enumerate()
        .filter(|(_, joint)| joint.role == Role::Driver);
    let mut directions = Vec::new();
    for (index, joint) in drivers {
        let (Some(quantity), Some(value)) = (joint.kind.value().quantity(), joint.operands.value)
        else {
            continue;
        };
        let graph = &mut pool.graph;
        let symbol = graph.symbol(&format!("{} shift", joint.slug));
        let shift = graph.variable(symbol);
        let shifted = Resolved {
            value: Some(graph.add(value, shift)),
            ..joint.operands.clone()
        };
        // A column has the length of the system, whatever its entries.
        graph.spend(COLUMN_ENTRY * rows.len());
        if pool.is_beyond(joint.span) {
            break;
        }
        let graph = &mut pool.graph;
        let zero = graph.zero();
        let shifted_rows = joint.kind.rows(&shifted, graph);
        let mut pending = shifted_rows.iter();
        let mut column = Vec::with_capacity(rows.len());
        for row in rows {
            let shifted = if row.joint == index {
                pending.next()
            } else {
                None
            };
            column.push(match shifted {
                Some(shifted) => {
                    let slope = graph.derivative(shifted.residual, symbol);
                    graph.substitute(slope, &[(symbol, zero)])
                }
                None => zero,
            });
        }
        directions.push(Direction {
            cause: Cause::Driver {
                joint: index,
                quantity,
            },
            symbol,
            name: joint.slug.clone(),
            column,
            rate_column: Vec::new(),
        });
    }
    directions
}

impl Direction {
    /// True if the direction is a parameter.
    pub fn is_parameter(&self) -> bool {
        matches!(self.cause, Cause::Parameter(_))
    }
}

impl System {
    /// Returns joint and quantity of each driver among the directions, with the index of the direction.
    pub fn driven(&self) -> impl Iterator<Item = (usize, usize, Quantity)> {
        let directions = self.directions.iter().enumerate();
        directions.filter_map(|(place, direction)| match direction.cause {
            Cause::Driver { joint, quantity } => Some((place, joint, quantity)),
            Cause::Parameter(_) => None,
        })
    }

    /// Returns the rows of the vector form with δ added to the value of every driver that is a direction.
    pub fn shifted_rows(&self, pool: &mut Pool) -> Vec<VectorRow> {
        let mut rows = self.vector_form.rows.clone();
        for direction in &self.directions {
            if let Cause::Driver { joint, .. } = direction.cause {
                let (form, mechanism) = (&self.vector_form, &self.mechanism);
                form.shift_driver(joint, direction.symbol, mechanism, &mut rows, pool);
            }
        }
        rows
    }
}
