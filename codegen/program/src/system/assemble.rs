//! Assembles the rows of every joint and differentiates them.

use std::collections::HashMap;
use std::ops::Range;

use super::direction::{directions, rate_jacobian};
use super::forces::forces;
use super::length::lengths;
use super::measures::{Measures, measures};
use super::pressure::pressures;
use super::row_name::RowNames;
use super::{Described, Entry, Output, Row, System, Unknown, VectorForm};
use crate::diagnostic::internal::work_at;
use crate::expr::{ExprId, Graph, SymbolId};
use crate::joint::{self, Quantity};
use crate::model::{Body, Mechanism};
use crate::pool::{Pool, SymbolRole};

/// Assembles a mechanism's Φ row by row in written order, with its derivatives. The pool is that of the mechanism.
pub fn assemble(pool: &mut Pool, mechanism: Mechanism) -> System {
    assemble_without(pool, mechanism, &[])
}

/// Assembles a mechanism with some rows monitored instead of solved: their numbers in written order, ascending.
pub fn assemble_without(pool: &mut Pool, mechanism: Mechanism, monitored_rows: &[usize]) -> System {
    let coordinates = coordinates(&mechanism, &mut pool.graph);
    set_roles(&mechanism, &coordinates, pool);
    let explicit = mechanism.explicit_rates(&mut pool.graph);
    // Poses come first, then the unknowns of single joints.
    let of_bodies: Vec<Range<usize>> = mechanism.bodies.iter().map(Body::places).collect();
    let of_body = |body: usize| of_bodies[body].clone();
    let mut contacts = HashMap::new();
    for (at, coordinate) in coordinates.iter().enumerate() {
        if let Described::Contact { joint } = coordinate.describes {
            contacts.insert(joint, at);
        }
    }
    let (mut rows, mut monitored, mut place) = (Vec::new(), Vec::new(), 0);
    // For each joint, true for each row that is not solved.
    let mut dropped: Vec<Vec<bool>> = Vec::with_capacity(mechanism.joints.len());
    let mut row_names = RowNames::default();
    for (index, joint) in mechanism.joints.iter().enumerate() {
        let _work = work_at(joint.span);
        let marks = joint.operands.marks.iter();
        let mut bodies: Vec<usize> = Vec::new();
        for body in marks.map(|mark| mark.frame.body.0) {
            if !bodies.contains(&body) {
                bodies.push(body);
            }
        }
        let mut involved: Vec<usize> = bodies
            .iter()
            .flat_map(|&body| of_body(body))
            .chain(contacts.get(&index).copied())
            .collect();
        involved.sort_unstable();
        involved.dedup();
        let involved: Vec<(usize, &Unknown)> =
            involved.iter().map(|&at| (at, &coordinates[at])).collect();
        let stated = joint.kind.rows(&joint.operands, &mut pool.graph);
        let names = row_names.of(joint, &stated);
        let mut dropped_of_joint = Vec::with_capacity(stated.len());
        for (stated, name) in stated.into_iter().zip(names) {
            let row = differentiate(
                stated,
                index,
                name,
                &bodies,
                &involved,
                &explicit,
                &mut pool.graph,
            );
            let is_dropped = monitored_rows.binary_search(&place).is_ok();
            if is_dropped {
                monitored.push(row);
            } else {
                rows.push(row);
            }
            dropped_of_joint.push(is_dropped);
            place += 1;
        }
        dropped.push(dropped_of_joint);
        if pool.is_beyond(joint.span) {
            break;
        }
    }
    let outputs = mechanism
        .points
        .iter()
        .map(|point| {
            pool.is_beyond(point.span);
            let graph = &mut pool.graph;
            let position = point.mark.position(graph);
            let moving: Vec<&Unknown> = of_body(point.mark.frame.body.0)
                .map(|at| &coordinates[at])
                .collect();
            let velocity = position.map(|component| rate(component, &moving, graph));
            let acceleration = velocity.map(|component| rate(component, &moving, graph));
            Output {
                name: point.name.clone(),
                position,
                velocity,
                acceleration,
            }
        })
        .collect();
    let directions = directions(&mechanism, &rows, &coordinates, pool);
    let rate_jacobian = rate_jacobian(&mechanism, &rows, &coordinates, &mut pool.graph);
    let pressures = pressures(&mechanism, &coordinates, &contacts, &mut pool.graph);
    let lengths = lengths(&mechanism, &rows, &mut pool.graph);
    let vector_form = VectorForm::new(&mechanism, &coordinates, &dropped, pool);
    let forces = forces(&mechanism, &vector_form, pool);
    pool.is_beyond(mechanism.span);
    let mut system = System {
        mechanism,
        coordinates,
        rows,
        monitored,
        outputs,
        directions,
        rate_jacobian,
        pressures,
        forces,
        measures: Measures::default(),
        vector_form,
        lengths,
    };
    if pool.exceeded().is_none() {
        system.measures = measures(&system, pool);
    }
    system
}

/// Records the roles of the coordinates, t, the parameters and the inputs.
fn set_roles(mechanism: &Mechanism, coordinates: &[Unknown], pool: &mut Pool) {
    for coordinate in coordinates {
        pool.take_name(&coordinate.name);
        pool.add_unknown(coordinate.symbols());
    }
    pool.set_role(mechanism.time, SymbolRole::Time);
    for (index, parameter) in mechanism.parameters.iter().enumerate() {
        pool.set_role(parameter.symbol, SymbolRole::Parameter(index));
    }
    for (input, own) in mechanism.inputs.iter().enumerate() {
        for (level, symbol) in own.symbols.iter().enumerate() {
            pool.set_role(*symbol, SymbolRole::Input { input, level });
        }
    }
}

fn coordinates(mechanism: &Mechanism, graph: &mut Graph) -> Vec<Unknown> {
    let Mechanism { bodies, joints, .. } = mechanism;
    let mut coordinates = Vec::with_capacity(3 * bodies.len());
    for (body, own) in bodies.iter().enumerate() {
        let estimate = own.estimate();
        for (axis, coordinate) in own.coordinates.iter().enumerate() {
            let Some(position) = coordinate.map(|it| it.symbol) else {
                continue;
            };
            let name = graph.symbol_name(position).to_string();
            coordinates.push(Unknown {
                rate: graph.symbol(&format!("{name}'")),
                acceleration: graph.symbol(&format!("{name}''")),
                name,
                position,
                describes: Described::Pose { body, axis },
                quantity: if axis == 2 {
                    Quantity::Angle
                } else {
                    Quantity::Length
                },
                estimate: estimate[axis],
            });
        }
    }
    for (joint, curve) in joints
        .iter()
        .enumerate()
        .filter_map(|(index, joint)| Some((index, joint.operands.curve?)))
    {
        let name = graph.symbol_name(curve.parameter).to_string();
        coordinates.push(Unknown {
            rate: graph.symbol(&format!("{name}'")),
            acceleration: graph.symbol(&format!("{name}''")),
            name,
            position: curve.parameter,
            describes: Described::Contact { joint },
            quantity: curve.quantity,
            estimate: curve.estimate,
        });
    }
    coordinates
}

/// Returns Φ_q, Φ_t and γ of one row, from its residual alone.
fn differentiate(
    stated: joint::Row,
    joint: usize,
    name: String,
    bodies: &[usize],
    involved: &[(usize, &Unknown)],
    explicit: &[(SymbolId, ExprId)],
    graph: &mut Graph,
) -> Row {
    let residual = stated.residual;
    let derivatives: Vec<ExprId> = involved
        .iter()
        .map(|(_, coordinate)| graph.derivative(residual, coordinate.position))
        .collect();
    let time_derivative = explicit_rate(residual, explicit, graph);
    // Φ_q q̇, whose derivative along q̇ is (Φ_q q̇)_q q̇ and whose partial derivative in t is Φ_qt q̇.
    let products: Vec<ExprId> = involved
        .iter()
        .zip(&derivatives)
        .map(|((_, coordinate), &derivative)| {
            let rate = graph.variable(coordinate.rate);
            graph.multiply(derivative, rate)
        })
        .collect();
    let constraint_rate = graph.sum(&products);
    let mut terms = Vec::with_capacity(involved.len() + 3);
    for (_, coordinate) in involved {
        let partial = graph.derivative(constraint_rate, coordinate.position);
        let rate = graph.variable(coordinate.rate);
        terms.push(graph.multiply(partial, rate));
    }
    let mixed = explicit_rate(constraint_rate, explicit, graph);
    terms.extend([
        mixed,
        mixed,
        explicit_rate(time_derivative, explicit, graph),
    ]);
    let total = graph.sum(&terms);
    let gamma = graph.negate(total);
    let zero = graph.zero();
    let jacobian = involved
        .iter()
        .zip(derivatives)
        .filter(|(_, value)| *value != zero)
        .map(|(&(coordinate, _), value)| Entry { coordinate, value })
        .collect();
    let quantity = stated.quantity;
    Row {
        joint,
        name,
        quantity,
        residual,
        jacobian,
        time_derivative,
        gamma,
        bodies: bodies.to_vec(),
    }
}

/// Returns d/dt of an expression at constant coordinates and rates, from t and the inputs.
fn explicit_rate(expr: ExprId, explicit: &[(SymbolId, ExprId)], graph: &mut Graph) -> ExprId {
    let terms: Vec<ExprId> = explicit
        .iter()
        .map(|&(symbol, rate)| {
            let partial = graph.derivative(expr, symbol);
            graph.multiply(partial, rate)
        })
        .collect();
    graph.sum(&terms)
}

/// Returns d/dt of an expression of the coordinates and rates in `moving`.
fn rate(expr: ExprId, moving: &[&Unknown], graph: &mut Graph) -> ExprId {
    let mut terms = Vec::with_capacity(2 * moving.len());
    for coordinate in moving {
        for (of, with) in [
            (coordinate.position, coordinate.rate),
            (coordinate.rate, coordinate.acceleration),
        ] {
            let partial = graph.derivative(expr, of);
            let with = graph.variable(with);
            terms.push(graph.multiply(partial, with));
        }
    }
    graph.sum(&terms)
}
