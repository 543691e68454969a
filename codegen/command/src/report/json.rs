//! Writes a motion as one JSON object.
//!
//! | key | value |
//! |---|---|
//! | `mechanism` | name of the mechanism |
//! | `motion` | name of the motion, if there are several |
//! | `coordinates` | names in the order of `q`, `qd`, `qdd` |
//! | `units` | units of `t`, of each coordinate in `q`, `qd` and `qdd`, and of `position`, `velocity` and `acceleration` |
//! | `degrees_of_freedom` | without drivers |
//! | `det`, `rcond` | determinant and reciprocal condition (1-norm) of Φ_q at the start, in SI units |
//! | `rcond_dimensionless` | `rcond` with lengths divided by the characteristic length |
//! | `derivatives`, `derivative_units` | names and units of the requested transmissions and sensitivities, if any |
//! | `forces` | names of the quantities that `effort`, `reaction` and `energy` statements request, each with its unit, if any |
//! | `measures` | names of the `measure` statements, each with its unit, if any |
//! | `frames` | `{t, q, qd, qdd, points: {NAME: {position, velocity, acceleration}}}` each; pairs are (x, y); and `derivatives`, `forces` and `measures`, null where Φ_q is singular |
//! | `residuals` | the largest over all frames, in SI units: `position`, `scaled`, `velocity`, `acceleration`, and `monitored` if equations are redundant |
//! | `extremes` | of measures: `{measure, smallest: {value, t}, largest: {value, t}, rms}` each, over all frames |
//! | `motors` | `{driver, units, torque, speed, power, rms_torque}` each, if there are any: of the largest torque, speed and power, `{t, torque, speed, power}`, over all frames |
//! | `friction` | if joints have friction: `{efficiency, work, frictionless_work, efficiency_of_load, work_of_load, frictionless_work_of_load, lowest: {efficiency, t}, self_locking}`, work in J while drivers drive the load and while the load drives, and the first and the last time of each interval in which the load cannot drive the mechanism |
//! | `pressure_angles` | of bodies that touch along curves: `{joint, angle, t}` each, the largest angle, in rad or the requested unit, and its time; null at rest |
//! | `newton_steps` | total number of Newton-Raphson steps |
//! | `simulation` | of a simulated motion: `evaluations`, `steps`, `implicit_steps` among them, `rejected`, `energy_drift` in J, and `kinetic_energy`, the largest |
//! | `warnings` | sentences |
//! | `error` | only if the motion ends early: the reason; `frames` then holds the solved part |
//! | `failure` | then also `{kind, t, block}`: the name of its kind, the time that cannot be reached, and the index of the block, null for a simulated motion |

use std::io::{self, Write};

use linkwright::PointMotion;
use linkwright_codegen::stages::model::Role;
use linkwright_codegen::stages::units::OutputUnit;
use linkwright_solver::View;
use linkwright_solver::check::equation_count;
use linkwright_solver::pressure::LargestPressureAngle;
use linkwright_solver::residuals::Residuals;
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

use linkwright_page::losses::{self, Friction};
use linkwright_page::motion::{EarlyEnd, Followed, Shown, Simulated, Sink};
use linkwright_page::motors::{Motor, objects};
use linkwright_page::units::{ColumnUnits, UnitNames};

/// Values that are known before the motion is followed.
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
    #[serde(skip_serializing_if = "Vec::is_empty")]
    derivatives: Vec<&'a str>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    derivative_units: Vec<&'a str>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    forces: Vec<(&'a str, &'a str)>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    measures: Vec<(&'a str, &'a str)>,
}

/// Values that are known after the motion.
#[derive(Serialize)]
struct Tail<'a> {
    residuals: Largest,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    extremes: Vec<Extremes<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    motors: Vec<Motor<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    friction: Option<Friction>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pressure_angles: Vec<Pressure<'a>>,
    newton_steps: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    simulation: Option<Integration>,
    warnings: &'a [String],
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    failure: Option<EarlyEnd>,
}

#[derive(Serialize)]
struct Extremes<'a> {
    measure: &'a str,
    smallest: Extreme,
    largest: Extreme,
    rms: f64,
}

#[derive(Serialize)]
struct Extreme {
    value: f64,
    t: f64,
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

impl<'a> Pressure<'a> {
    fn new(it: &'a LargestPressureAngle, unit: &OutputUnit) -> Pressure<'a> {
        Pressure {
            joint: &it.joint,
            angle: it.angle.map(|it| unit.of_si(it)),
            t: it.t,
        }
    }
}

#[derive(Serialize)]
struct Frame<'a> {
    t: f64,
    q: Vec<f64>,
    qd: Vec<f64>,
    qdd: Vec<f64>,
    points: Points<'a>,
    /// Outer `None` if nothing is requested, inner `None` if Φ_q is singular.
    #[serde(skip_serializing_if = "Option::is_none")]
    derivatives: Option<Option<Vec<f64>>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    forces: Option<Option<Vec<f64>>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    measures: Option<Option<Vec<f64>>>,
}

struct Points<'a>(&'a [String], &'a [PointMotion], &'a [OutputUnit; 3]);

impl Serialize for Points<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (name, motion) in self.0.iter().zip(self.1) {
            map.serialize_entry(name, &MotionValues::new(motion, self.2))?;
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

impl MotionValues {
    fn new(motion: &PointMotion, units: &[OutputUnit; 3]) -> MotionValues {
        let [position, velocity, acceleration] = [0, 1, 2].map(|level| {
            let values = [motion.position, motion.velocity, motion.acceleration][level];
            values.map(|it| units[level].of_si(it))
        });
        MotionValues {
            position,
            velocity,
            acceleration,
        }
    }
}

/// Converts values from SI units.
fn scaled<'a>(values: &[f64], units: impl IntoIterator<Item = &'a OutputUnit>) -> Vec<f64> {
    let pairs = values.iter().zip(units);
    pairs.map(|(value, unit)| unit.of_si(*value)).collect()
}

/// JSON object of a motion, written frame by frame: the whole text is never in memory.
pub struct Object<'a> {
    output: &'a mut dyn Write,
    points: Vec<String>,
    has_derivatives: bool,
    /// Number of forces, which precede measures.
    forces: usize,
    units: ColumnUnits,
    is_first: bool,
}

impl<'a> Object<'a> {
    /// Begins the object.
    ///
    /// # Errors
    /// Errors of `output`.
    pub fn new<V: View>(motion: &Followed<V>, output: &'a mut dyn Write) -> io::Result<Object<'a>> {
        let coordinates = &motion.system().coordinates;
        let units = ColumnUnits::of(motion);
        let derivatives = motion.derivative_names.iter();
        let reported = motion.reported_names.iter().zip(&units.reported);
        let reported = reported.map(|(it, unit)| (it.0.as_str(), unit.name.as_str()));
        let mut forces: Vec<_> = reported.collect();
        let measures = forces.split_off(motion.force_count());
        let constrained = equation_count(motion.system(), Role::Constraint);
        let head = serde_json::to_string(&Head {
            mechanism: motion.name(),
            motion: motion.motion(),
            coordinates: coordinates.iter().map(|it| it.name.as_str()).collect(),
            units: units.names(),
            degrees_of_freedom: coordinates.len().saturating_sub(constrained),
            det: motion.condition.determinant,
            rcond: motion.condition.reciprocal,
            rcond_dimensionless: motion.dimensionless_condition.reciprocal,
            derivatives: derivatives.map(|it| it.0.as_str()).collect(),
            derivative_units: units
                .derivatives
                .iter()
                .map(|it| it.name.as_str())
                .collect(),
            forces,
            measures,
        })?;
        // The object is continued.
        write!(output, "{},\"frames\":[", head.trim_end_matches('}'))?;
        Ok(Object {
            output,
            points: motion.point_names().map(str::to_string).collect(),
            has_derivatives: !motion.derivative_names.is_empty(),
            forces: motion.force_count(),
            units,
            is_first: true,
        })
    }

    /// Ends the object.
    ///
    /// # Errors
    /// Errors of the output.
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
        let units = motion.system().mechanism.units.of_tables();
        let unit = units.of("rad");
        let angles = motion.pressure.largest.iter();
        let angles = angles.map(|it| Pressure::new(it, &unit));
        let first = motion.force_count();
        let measures = motion.reported_names.iter().zip(&motion.extremes);
        let measures = measures.zip(&motion.squares).zip(&self.units.reported);
        let extremes = measures
            .skip(first)
            .map(|((((name, _), [low, high]), square), unit)| {
                let [smallest, largest] = [low, high].map(|&(value, t)| Extreme {
                    value: unit.of_si(value),
                    t,
                });
                Extremes {
                    measure: name,
                    smallest,
                    largest,
                    rms: unit.of_si(square.root()),
                }
            });
        let tail = serde_json::to_string(&Tail {
            extremes: extremes.collect(),
            motors: objects(&motion.motors, |it| motion.rms_torque(it), &units),
            friction: losses::object(motion.losses.as_ref()),
            residuals: Largest {
                position,
                scaled,
                monitored,
                velocity,
                acceleration,
            },
            pressure_angles: angles.collect(),
            newton_steps,
            simulation: motion.simulated.as_ref().map(Integration::from),
            warnings: &motion.warnings,
            error: motion.error.as_deref(),
            failure: motion.failure,
        })?;
        writeln!(self.output, "],{}", tail.trim_start_matches('{'))
    }
}

impl Sink for Object<'_> {
    fn take(&mut self, shown: &Shown<'_>) -> io::Result<()> {
        if !std::mem::take(&mut self.is_first) {
            self.output.write_all(b",")?;
        }
        let units = &self.units;
        let level = |level: usize, values: &[f64]| {
            scaled(values, units.coordinates.iter().map(|it| &it[level]))
        };
        let derivatives = shown.derivatives.map(|it| scaled(it, &units.derivatives));
        let reported = shown.reported.map(|it| scaled(it, &units.reported));
        let has_measures = units.reported.len() > self.forces;
        let measures = has_measures.then(|| Some(reported.as_ref()?.get(self.forces..)?.to_vec()));
        let forces = reported.map(|mut it| {
            it.truncate(self.forces);
            it
        });
        let frame = Frame {
            t: shown.instant.t(),
            q: level(0, shown.instant.q()),
            qd: level(1, shown.instant.qd()),
            qdd: level(2, shown.instant.qdd()),
            points: Points(&self.points, shown.motions, &units.points),
            derivatives: self.has_derivatives.then_some(derivatives),
            forces: (self.forces > 0).then_some(forces),
            measures,
        };
        Ok(serde_json::to_writer(&mut *self.output, &frame)?)
    }
}
