//! Finds the largest pressure angle of every contact over a motion.

use linkwright::generated::pressure_angle;
use linkwright_codegen::stages::expr::ExprId;
use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::system::System;

use crate::instant::{Instant, Layout};
use crate::reader::Reader;

/// Largest pressure angle of one contact over a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct LargestPressureAngle {
    /// Joint as the description writes it.
    pub joint: String,
    /// Angle between the common normal and the velocity of the follower's point, in rad; `None` if the follower always rests.
    pub angle: Option<f64>,
    /// Time of the largest angle, in s.
    pub t: f64,
}

/// Observer of pressure angles.
#[derive(Clone, Debug)]
pub struct PressureCheck {
    /// Evaluator, for each contact, of the velocity of the follower along and across the normal, and of the square of the sliding speed.
    reader: Reader,
    /// Largest angles so far, in the order of [`System::pressures`].
    pub largest: Vec<LargestPressureAngle>,
}

impl PressureCheck {
    /// Creates an observer before the first instant.
    ///
    /// # Panics
    /// If instants of this layout do not store what the equations mention.
    pub fn new(pool: &Pool, system: &System, layout: &Layout) -> PressureCheck {
        let pressures = system.pressures.iter();
        let roots: Vec<ExprId> = pressures
            .clone()
            .flat_map(|it| [it.along, it.across, it.sliding])
            .collect();
        let joints = &system.mechanism.joints;
        let largest = pressures.map(|it| LargestPressureAngle {
            joint: joints[it.joint].label.clone(),
            angle: None,
            t: 0.0,
        });
        PressureCheck {
            reader: Reader::new(&pool.graph, layout, &roots),
            largest: largest.collect(),
        }
    }

    /// Observes an instant.
    pub fn see(&mut self, instant: &Instant) {
        if self.largest.is_empty() {
            return;
        }
        let values = self.reader.values(instant);
        for (largest, it) in self.largest.iter_mut().zip(values.chunks_exact(3)) {
            let angle = pressure_angle(it[0], it[1], it[2]);
            if angle > largest.angle {
                (largest.angle, largest.t) = (angle, instant.t());
            }
        }
    }
}
