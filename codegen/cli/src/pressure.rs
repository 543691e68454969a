//! *Frames → the largest pressure angle of every contact over all of them.*

use linkwright::Frame;
use linkwright_codegen::system::System;
use nalgebra::Dyn;
use serde::Serialize;

use crate::interpreter::Interpreter;

/// The largest pressure angle of one contact over a motion.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LargestPressureAngle {
    /// The joint as the description writes it.
    pub joint: String,
    /// The angle between the common normal and the velocity of the follower's point, in rad; `None` where the follower rests
    /// all the time.
    pub angle: Option<f64>,
    /// When it is that large, in s.
    pub t: f64,
}

/// The largest pressure angle of every contact of the system, in its order.
pub fn largest(
    system: &System,
    interpreter: &Interpreter,
    frames: &[Frame<f64, Dyn>],
) -> Vec<LargestPressureAngle> {
    let joints = &system.mechanism.joints;
    let mut all: Vec<LargestPressureAngle> = system
        .pressures
        .iter()
        .map(|pressure| LargestPressureAngle {
            joint: joints[pressure.joint].label.clone(),
            angle: None,
            t: 0.0,
        })
        .collect();
    if all.is_empty() {
        return all;
    }
    for frame in frames {
        for (largest, angle) in all.iter_mut().zip(interpreter.pressure_angles(frame)) {
            if angle > largest.angle {
                (largest.angle, largest.t) = (angle, frame.t);
            }
        }
    }
    all
}
