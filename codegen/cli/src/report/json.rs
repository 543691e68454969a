//! *Solution → one JSON object.*
//!
//! | key | value |
//! |---|---|
//! | `mechanism` | its name |
//! | `motion` | the name of the motion, where the mechanism has several |
//! | `coordinates` | their names, in the order of `q`, `qd`, `qdd` |
//! | `degrees_of_freedom` | before drivers |
//! | `det`, `rcond` | determinant and reciprocal condition (1-norm) of Φ_q at the start, in SI units |
//! | `rcond_dimensionless` | the latter with lengths divided by the characteristic length |
//! | `derivatives` | the names of what `transmission` and `sensitivity` statements ask for, if any |
//! | `frames` | `{t, q, qd, qdd, points: {NAME: {position, velocity, acceleration}}}` each; pairs are (x, y); and `derivatives`, null where Φ_q is singular |
//! | `residuals` | the largest over all frames: `position`, `scaled`, `velocity`, `acceleration`, and `monitored` where equations are redundant |
//! | `pressure_angles` | where bodies touch along curves: `{joint, angle, t}` each, the largest angle in rad and when; null at rest |
//! | `newton_steps` | how many were taken in all |
//! | `warnings` | sentences |
//! | `error` | only if the motion ends early: why; `frames` then holds what could be solved |

use std::io::{self, Write};

use linkwright::{Frame, Motion};
use linkwright_codegen::model::Role;
use nalgebra::Dyn;
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

use crate::pressure::LargestPressureAngle;
use crate::residuals::Residuals;
use crate::solution::Solution;

#[derive(Serialize)]
struct Object<'a> {
    mechanism: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    motion: Option<&'a str>,
    coordinates: Vec<&'a str>,
    degrees_of_freedom: usize,
    det: f64,
    rcond: f64,
    rcond_dimensionless: f64,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    derivatives: &'a [String],
    frames: Frames<'a>,
    residuals: &'a Residuals,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    pressure_angles: &'a [LargestPressureAngle],
    newton_steps: u64,
    warnings: &'a [String],
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<&'a str>,
}

/// The frames one by one, so that the whole text is never held.
struct Frames<'a>(&'a Solution);

impl Serialize for Frames<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let frames = self.0.frames().iter().enumerate();
        serializer.collect_seq(frames.map(|(index, frame)| Instant {
            t: frame.t,
            q: frame.q.as_slice(),
            qd: frame.qd.as_slice(),
            qdd: frame.qdd.as_slice(),
            points: Points(self.0, frame),
            derivatives: self.0.derivatives.values.get(index).map(Option::as_deref),
        }))
    }
}

#[derive(Serialize)]
struct Instant<'a> {
    t: f64,
    q: &'a [f64],
    qd: &'a [f64],
    qdd: &'a [f64],
    points: Points<'a>,
    /// None where nothing is asked for; the inner one where there is no answer.
    #[serde(skip_serializing_if = "Option::is_none")]
    derivatives: Option<Option<&'a [f64]>>,
}

struct Points<'a>(&'a Solution, &'a Frame<f64, Dyn>);

impl Serialize for Points<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.points.len()))?;
        for (name, motion) in self.0.motions(self.1) {
            map.serialize_entry(name, &PointMotion::from(motion))?;
        }
        map.end()
    }
}

#[derive(Serialize)]
struct PointMotion {
    position: [f64; 2],
    velocity: [f64; 2],
    acceleration: [f64; 2],
}

impl From<Motion<f64>> for PointMotion {
    fn from(motion: Motion<f64>) -> Self {
        PointMotion {
            position: motion.position,
            velocity: motion.velocity,
            acceleration: motion.acceleration,
        }
    }
}

/// Writes the object and a line break.
///
/// # Errors
/// Those of `output`.
pub fn write(solution: &Solution, output: &mut dyn Write) -> io::Result<()> {
    let coordinates = &solution.system.coordinates;
    let object = Object {
        mechanism: solution.name(),
        motion: solution.motion(),
        coordinates: coordinates.iter().map(|it| it.name.as_str()).collect(),
        degrees_of_freedom: coordinates
            .len()
            .saturating_sub(solution.equation_count(Role::Constraint)),
        det: solution.condition.determinant,
        rcond: solution.condition.reciprocal,
        rcond_dimensionless: solution.dimensionless_condition.reciprocal,
        derivatives: &solution.derivatives.names,
        frames: Frames(solution),
        residuals: &solution.residuals,
        pressure_angles: &solution.pressure_angles,
        newton_steps: solution.trajectory.newton_steps,
        warnings: &solution.warnings,
        error: solution.error.as_deref(),
    };
    serde_json::to_writer(&mut *output, &object)?;
    output.write_all(b"\n")
}
