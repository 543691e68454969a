//! Writes the worst points of motors, as text and for JSON.

use std::io::{self, Write};

use linkwright_codegen::stages::units::{OutputUnit, OutputUnits};
use linkwright_solver::motors::{MotorPeaks, MotorPoint};
use serde::Serialize;

use crate::measured::time_of_extreme;

/// Digits of a printed value.
const DIGITS: usize = 6;

/// Worst points of a motor.
#[derive(Serialize)]
pub struct Motor<'a> {
    driver: &'a str,
    units: [String; 3],
    torque: Point,
    speed: Point,
    power: Point,
    #[serde(skip_serializing_if = "Option::is_none")]
    rms_torque: Option<f64>,
}

/// Point at the shaft of a motor.
#[derive(Serialize)]
struct Point {
    t: f64,
    torque: f64,
    speed: f64,
    power: f64,
}

/// Returns the worst points of motors in units of output, with the root mean squares of their torques if they are known.
pub fn objects<'a>(
    peaks: &'a [MotorPeaks],
    rms: impl Fn(&MotorPeaks) -> Option<f64>,
    units: &OutputUnits,
) -> Vec<Motor<'a>> {
    let all = own_units(units);
    let point = |it: &MotorPoint| {
        let [torque, speed, power] = &all;
        Point {
            t: it.t,
            torque: torque.of_si(it.torque),
            speed: speed.of_si(it.speed),
            power: power.of_si(it.power),
        }
    };
    let motors = peaks.iter().filter(|it| it.torque.t.is_finite());
    let motors = motors.map(|it| Motor {
        driver: &it.driver,
        units: all.each_ref().map(|it| it.name.clone()),
        torque: point(&it.torque),
        speed: point(&it.speed),
        power: point(&it.power),
        rms_torque: rms(it).map(|rms| all[0].of_si(rms)),
    });
    motors.collect()
}

/// Writes the worst points of motors, with the root mean squares of their torques if they are known; nothing without motors.
///
/// # Errors
/// Errors of `output`.
pub fn write(
    peaks: &[MotorPeaks],
    rms: impl Fn(&MotorPeaks) -> Option<f64>,
    units: &OutputUnits,
    output: &mut dyn Write,
) -> io::Result<()> {
    let peaks = || peaks.iter().filter(|it| it.torque.t.is_finite());
    if peaks().next().is_none() {
        return Ok(());
    }
    let all = own_units(units);
    let text = |place: usize, value: f64| all[place].labeled(all[place].rounded(value, DIGITS));
    writeln!(output, "\nmotors, at their shafts")?;
    let width = peaks().map(|it| it.driver.len()).max().unwrap_or(0);
    for motor in peaks() {
        let points = [
            ("torque", motor.torque),
            ("speed", motor.speed),
            ("power", motor.power),
        ];
        for (own, (name, point)) in points.into_iter().enumerate() {
            let driver = if own == 0 { &motor.driver } else { "" };
            let values = [point.torque, point.speed, point.power];
            let others = (0..3).filter(|it| *it != own);
            let others: Vec<String> = others.map(|it| text(it, values[it])).collect();
            let t = time_of_extreme(point.t);
            let rms = match rms(motor).filter(|_| own == 0) {
                Some(rms) => format!("; rms {}", text(0, rms)),
                None => String::new(),
            };
            writeln!(
                output,
                "  {driver:width$}  largest {name} {} at t = {t} s, there {}{rms}",
                text(own, values[own]),
                others.join(" and ")
            )?;
        }
    }
    Ok(())
}

/// Returns the units of torques, speeds and powers.
fn own_units(units: &OutputUnits) -> [OutputUnit; 3] {
    ["N*m", "rad/s", "W"].map(|si| units.of(si))
}
