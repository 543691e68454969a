//! What the pose can be moved along besides time: the value of each driver.
//!
//! A driver says quantity = f(t). With f(t) + δ in its place the pose depends on δ too, and Φ_q ∂q/∂δ = −∂Φ/∂δ at δ = 0 says how
//! (implicit function theorem; Haug 1989, section 3.6, has the same with t in place of δ). Afterwards every direction has its
//! symbol δ and its column ∂Φ/∂δ. The textbook's rows themselves do not mention δ.

use super::{Row, System};
use crate::expr::{ExprId, SymbolId};
use crate::joint::{Quantity, Resolved};
use crate::model::{Mechanism, Role};

/// A direction in which the pose can be moved.
#[derive(Clone, Debug, PartialEq)]
pub struct Direction {
    /// What is moved.
    pub cause: Cause,
    /// What is added to the driver's value.
    pub symbol: SymbolId,
    /// What it is called in generated code: `drive_phi_crank`.
    pub name: String,
    /// What the driven quantity is measured in.
    pub quantity: Quantity,
    /// ∂Φ/∂δ at δ = 0: one expression a row.
    pub column: Vec<ExprId>,
}

/// What moves the pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// The value of a driver: an index into the mechanism's joints.
    Driver(usize),
}

/// The directions that the mechanism's statements ask for: those of all drivers in written order, where there is a transmission.
pub(super) fn directions(mechanism: &mut Mechanism, rows: &[Row]) -> Vec<Direction> {
    if mechanism.transmissions.is_empty() {
        return Vec::new();
    }
    let Mechanism { graph, joints, .. } = mechanism;
    let drivers = joints
        .iter()
        .enumerate()
        .filter(|(_, joint)| joint.role == Role::Driver);
    let mut directions = Vec::new();
    for (index, joint) in drivers {
        let (Some(quantity), Some(value)) = (joint.kind.value().quantity(), joint.operands.value)
        else {
            continue;
        };
        let symbol = graph.symbol(&format!("{} shift", joint.slug));
        let shift = graph.variable(symbol);
        let shifted = Resolved {
            value: Some(graph.add(value, shift)),
            ..joint.operands.clone()
        };
        let zero = graph.zero();
        let shifted_rows = joint.kind.rows(&shifted, graph);
        let mut own = shifted_rows.iter();
        let mut column = Vec::with_capacity(rows.len());
        for row in rows {
            let shifted = if row.joint == index { own.next() } else { None };
            column.push(match shifted {
                Some(shifted) => {
                    let slope = graph.derivative(shifted.residual, symbol);
                    graph.substitute(slope, &[(symbol, zero)])
                }
                None => zero,
            });
        }
        directions.push(Direction {
            cause: Cause::Driver(index),
            symbol,
            name: joint.slug.clone(),
            quantity,
            column,
        });
    }
    directions
}

impl System {
    /// Adds δ to the value of every driver that the pose is to be moved along, in the vector form.
    pub fn shift_drivers(&mut self) {
        let System {
            mechanism,
            vector_form,
            directions,
            ..
        } = self;
        for direction in directions.iter() {
            let Cause::Driver(joint) = direction.cause;
            vector_form.shift_driver(joint, direction.symbol, mechanism);
        }
    }
}
