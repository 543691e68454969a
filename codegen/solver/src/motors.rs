//! Finds the worst points of motors: the largest torque, speed and power at their shafts, each with the other two.

use linkwright_codegen::stages::model::{Mechanism, Motor};

/// Torque, speed and power of a motor at a time, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotorPoint {
    /// Time (s).
    pub t: f64,
    /// Torque at the shaft (N·m).
    pub torque: f64,
    /// Speed of the shaft (rad/s).
    pub speed: f64,
    /// Power at the shaft (W).
    pub power: f64,
}

/// Worst points of a motor along a motion; without an instant, their values are NaN.
#[derive(Clone, Debug, PartialEq)]
pub struct MotorPeaks {
    /// Name of its driver.
    pub driver: String,
    /// Indices of torque, speed and power among the mechanism's measurements.
    pub measurements: [usize; 3],
    /// Point of the largest magnitude of the torque.
    pub torque: MotorPoint,
    /// Point of the largest magnitude of the speed.
    pub speed: MotorPoint,
    /// Point of the largest magnitude of the power.
    pub power: MotorPoint,
}

/// Point before any instant.
const NO_POINT: MotorPoint = MotorPoint {
    t: f64::NAN,
    torque: f64::NAN,
    speed: f64::NAN,
    power: f64::NAN,
};

impl MotorPeaks {
    /// Returns the peaks of all motors of a mechanism before any instant.
    pub fn of(mechanism: &Mechanism) -> Vec<MotorPeaks> {
        let name = |motor: &Motor| mechanism.joints[motor.joint].name.clone();
        let motors = mechanism.motors.iter().map(|motor| MotorPeaks {
            driver: name(motor).unwrap_or_default(),
            measurements: motor.measurements,
            torque: NO_POINT,
            speed: NO_POINT,
            power: NO_POINT,
        });
        motors.collect()
    }

    /// Adds a time with the values of all measures.
    pub fn see(&mut self, t: f64, measures: &[f64]) {
        let values = self.measurements.map(|it| measures.get(it).copied());
        let [Some(torque), Some(speed), Some(power)] = values else {
            return;
        };
        let point = MotorPoint {
            t,
            torque,
            speed,
            power,
        };
        // A comparison with NaN is false, so that the first point is taken.
        let is_below = |before: f64, now: f64| before.is_nan() || before.abs() < now.abs();
        if is_below(self.torque.torque, torque) {
            self.torque = point;
        }
        if is_below(self.speed.speed, speed) {
            self.speed = point;
        }
        if is_below(self.power.power, power) {
            self.power = point;
        }
    }
}
