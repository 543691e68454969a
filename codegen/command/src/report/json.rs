//! *A motion* → *one JSON object*.
//!
//! | key | value |
//! |---|---|
//! | `mechanism` | its name |
//! | `motion` | the name of the motion, where the mechanism has several |
//! | `coordinates` | their names, in the order of `q`, `qd`, `qdd` |
//! | `units` | those of `t`, of each coordinate in `q`, `qd` and `qdd`, and of `position`, `velocity` and `acceleration` |
//! | `degrees_of_freedom` | before drivers |
//! | `det`, `rcond` | determinant and reciprocal condition (1-norm) of Φ_q at the start, in SI units |
//! | `rcond_dimensionless` | the latter with lengths divided by the characteristic length |
//! | `derivatives` | the names of what `transmission` and `sensitivity` statements ask for, if any |
//! | `forces` | the names of what `effort`, `reaction` and `energy` statements ask for, each with its unit, if any |
//! | `frames` | `{t, q, qd, qdd, points: {NAME: {position, velocity, acceleration}}}` each; pairs are (x, y); and `derivatives` and `forces`, null where Φ_q is singular |
//! | `residuals` | the largest over all frames: `position`, `scaled`, `velocity`, `acceleration`, and `monitored` where equations are redundant |
//! | `pressure_angles` | where bodies touch along curves: `{joint, angle, t}` each, the largest angle in rad and when; null at rest |
//! | `newton_steps` | how many were taken in all |
//! | `simulation` | of a simulated motion: `evaluations`, `steps`, `implicit_steps` among them, `rejected`, `energy_drift` in J, and `kinetic_energy`, the largest |
//! | `warnings` | sentences |
//! | `error` | only if the motion ends early: why; `frames` then holds what could be solved |

use std::io::{self, Write};

use linkwright::PointMotion;
use linkwright_codegen::stages::model::Role;
use linkwright_codegen::stages::system::System;
use linkwright_solver::check::equation_count;
use linkwright_solver::pressure::LargestPressureAngle;
use linkwright_solver::residuals::Residuals;
use linkwright_solver::view::View;
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

use super::units::Units;
use crate::arguments::TurnUnit;
use crate::motion::{Followed, Shown, Simulated, Sink};

/// What is known before the motion is followed.
#[derive(Serialize)]
struct Head<'a> {
    mechanism: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    motion: Option<&'a str>,
    coordinates: Vec<&'a str>,
    units: UnitNames,
    degrees_of_freedom: usize,
    det: f64,
    rcond: f64,
    rcond_dimensionless: f64,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    derivatives: &'a [String],
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    forces: &'a [(String, &'static str)],
}

#[derive(Serialize)]
struct UnitNames {
    t: &'static str,
    q: Vec<&'static str>,
    qd: Vec<&'static str>,
    qdd: Vec<&'static str>,
    position: &'static str,
    velocity: &'static str,
    acceleration: &'static str,
}

impl UnitNames {
    fn of(system: &System) -> UnitNames {
        let level = |level: usize| {
            let coordinates = 0..system.coordinates.len();
            let units = coordinates.map(|it| Units::of(system, it, TurnUnit::Rad).levels[level]);
            units.collect()
        };
        UnitNames {
            t: "s",
            q: level(0),
            qd: level(1),
            qdd: level(2),
            position: "m",
            velocity: "m/s",
            acceleration: "m/s²",
        }
    }
}

/// What is known afterwards.
#[derive(Serialize)]
struct Tail<'a> {
    residuals: Largest,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pressure_angles: Vec<Pressure<'a>>,
    newton_steps: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    simulation: Option<Integration>,
    warnings: &'a [String],
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<&'a str>,
}

#[derive(Serialize)]
struct Largest {
    position: f64,
    scaled: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    monitored: Option<f64>,
    velocity: f64,
    acceleration: f64,
}

#[derive(Serialize)]
struct Integration {
    evaluations: u64,
    steps: u64,
    implicit_steps: u64,
    rejected: u64,
    energy_drift: f64,
    kinetic_energy: f64,
}

impl From<&Simulated> for Integration {
    fn from(it: &Simulated) -> Self {
        Integration {
            evaluations: it.effort.evaluations,
            steps: it.effort.steps,
            implicit_steps: it.effort.implicit,
            rejected: it.effort.rejected,
            energy_drift: it.drift.0,
            kinetic_energy: it.kinetic,
        }
    }
}

#[derive(Serialize)]
struct Pressure<'a> {
    joint: &'a str,
    angle: Option<f64>,
    t: f64,
}

impl<'a> From<&'a LargestPressureAngle> for Pressure<'a> {
    fn from(it: &'a LargestPressureAngle) -> Self {
        Pressure {
            joint: &it.joint,
            angle: it.angle,
            t: it.t,
        }
    }
}

#[derive(Serialize)]
struct Frame<'a> {
    t: f64,
    q: &'a [f64],
    qd: &'a [f64],
    qdd: &'a [f64],
    points: Points<'a>,
    /// None where nothing is asked for; the inner one where there is no answer.
    #[serde(skip_serializing_if = "Option::is_none")]
    derivatives: Option<Option<&'a [f64]>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    forces: Option<Option<&'a [f64]>>,
}

struct Points<'a>(&'a [String], &'a [PointMotion]);

impl Serialize for Points<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (name, motion) in self.0.iter().zip(self.1) {
            map.serialize_entry(name, &MotionValues::from(*motion))?;
        }
        map.end()
    }
}

#[derive(Serialize)]
struct MotionValues {
    position: [f64; 2],
    velocity: [f64; 2],
    acceleration: [f64; 2],
}

impl From<PointMotion> for MotionValues {
    fn from(motion: PointMotion) -> Self {
        MotionValues {
            position: motion.position,
            velocity: motion.velocity,
            acceleration: motion.acceleration,
        }
    }
}

/// The object of a motion, to which frames are added one by one, so that the whole text is never held.
pub struct Object<'a> {
    output: &'a mut dyn Write,
    points: Vec<String>,
    has_derivatives: bool,
    has_forces: bool,
    is_first: bool,
}

impl<'a> Object<'a> {
    /// Begins the object.
    ///
    /// # Errors
    /// Those of `output`.
    pub fn new<V: View>(motion: &Followed<V>, output: &'a mut dyn Write) -> io::Result<Object<'a>> {
        let coordinates = &motion.system().coordinates;
        let constrained = equation_count(motion.system(), Role::Constraint);
        let head = serde_json::to_string(&Head {
            mechanism: motion.name(),
            motion: motion.motion(),
            coordinates: coordinates.iter().map(|it| it.name.as_str()).collect(),
            units: UnitNames::of(motion.system()),
            degrees_of_freedom: coordinates.len().saturating_sub(constrained),
            det: motion.condition.determinant,
            rcond: motion.condition.reciprocal,
            rcond_dimensionless: motion.dimensionless_condition.reciprocal,
            derivatives: &motion.derivative_names,
            forces: &motion.force_names,
        })?;
        // The object goes on.
        write!(output, "{},\"frames\":[", head.trim_end_matches('}'))?;
        Ok(Object {
            output,
            points: motion.point_names().map(str::to_string).collect(),
            has_derivatives: !motion.derivative_names.is_empty(),
            has_forces: !motion.force_names.is_empty(),
            is_first: true,
        })
    }

    /// Ends the object.
    ///
    /// # Errors
    /// Those of the output.
    pub fn finish<V: View>(self, motion: &Followed<V>) -> io::Result<()> {
        let Residuals {
            position,
            scaled,
            monitored,
            velocity,
            acceleration,
            ..
        } = motion.residuals.largest;
        let [newton_steps, _] = motion.view.newton_steps();
        let tail = serde_json::to_string(&Tail {
            residuals: Largest {
                position,
                scaled,
                monitored,
                velocity,
                acceleration,
            },
            pressure_angles: motion.pressure.largest.iter().map(Pressure::from).collect(),
            newton_steps,
            simulation: motion.simulated.as_ref().map(Integration::from),
            warnings: &motion.warnings,
            error: motion.error.as_deref(),
        })?;
        writeln!(self.output, "],{}", tail.trim_start_matches('{'))
    }
}

impl Sink for Object<'_> {
    fn take(&mut self, shown: &Shown<'_>) -> io::Result<()> {
        if !std::mem::take(&mut self.is_first) {
            self.output.write_all(b",")?;
        }
        let frame = Frame {
            t: shown.instant.t(),
            q: shown.instant.q(),
            qd: shown.instant.qd(),
            qdd: shown.instant.qdd(),
            points: Points(&self.points, shown.motions),
            derivatives: self.has_derivatives.then_some(shown.derivatives),
            forces: self.has_forces.then_some(shown.forces),
        };
        Ok(serde_json::to_writer(&mut *self.output, &frame)?)
    }
}
