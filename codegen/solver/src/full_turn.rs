//! Finds the time in which the only moving drive turns once.

use std::f64::consts::TAU;

use linkwright_codegen::stages::joint::Quantity;
use linkwright_codegen::stages::system::Derived;

use crate::travel::Drive;

/// Full turn of a drive.
#[derive(Clone, Debug, PartialEq)]
pub struct FullTurn {
    /// Name of the drive.
    pub drive: String,
    /// Time (s).
    pub period: f64,
}

impl FullTurn {
    /// Returns the turn if one drive turns at a constant rate while the others stand still; `None` for every other motion.
    pub fn of(derived: &Derived) -> Option<FullTurn> {
        let mechanism = &derived.system.mechanism;
        let mut graph = derived.pool.graph.clone();
        let mut turn = None;
        for drive in Drive::all(mechanism) {
            let joint = &mechanism.joints[drive.joint];
            let rate = graph.derivative(joint.operands.value?, mechanism.time);
            // A rate that depends on t or an input has no constant value.
            let rate = graph.constant_value(rate)?;
            if rate == 0.0 {
                continue;
            }
            let is_angle = joint.kind.value.quantity() == Some(Quantity::Angle);
            if turn.is_some() || !is_angle || !rate.is_finite() {
                return None;
            }
            turn = Some(FullTurn {
                drive: drive.name,
                period: TAU / rate.abs(),
            });
        }
        turn
    }
}
