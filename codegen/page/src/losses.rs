//! Writes what friction takes along a motion, as text and for JSON.

use std::io::{self, Write};

use linkwright_solver::losses::Losses;
use linkwright_solver::number::{scientific, time};
use serde::Serialize;

use crate::measured::time_of_extreme;

/// Decimals of a printed efficiency.
const DECIMALS: usize = 4;

/// Digits behind the point of printed work.
const WORK_DIGITS: usize = 3;

/// Losses by friction.
#[derive(Serialize)]
pub struct Friction {
    efficiency: Option<f64>,
    work: f64,
    frictionless_work: f64,
    efficiency_of_load: Option<f64>,
    work_of_load: f64,
    frictionless_work_of_load: f64,
    lowest: Option<Lowest>,
    self_locking: Vec<[f64; 2]>,
}

/// Lowest efficiency.
#[derive(Serialize)]
struct Lowest {
    efficiency: f64,
    t: f64,
}

/// Returns the losses for JSON; `None` without friction.
pub fn object(losses: Option<&Losses>) -> Option<Friction> {
    let losses = losses.filter(|it| !it.is_empty())?;
    let [work, frictionless_work] = losses.driving;
    let [work_of_load, frictionless_work_of_load] = losses.driven;
    Some(Friction {
        efficiency: ratio(frictionless_work, work),
        work,
        frictionless_work,
        efficiency_of_load: ratio(work_of_load, frictionless_work_of_load),
        work_of_load,
        frictionless_work_of_load,
        lowest: losses.lowest.map(|it| Lowest {
            efficiency: it.efficiency,
            t: it.t,
        }),
        self_locking: losses.locked(),
    })
}

/// Writes the losses; nothing without friction.
///
/// # Errors
/// Errors of `output`.
pub fn write(losses: Option<&Losses>, output: &mut dyn Write) -> io::Result<()> {
    let Some(losses) = losses.filter(|it| !it.is_empty()) else {
        return Ok(());
    };
    writeln!(output, "\nfriction")?;
    let joules = |work: f64| scientific(work, WORK_DIGITS);
    let [work, without] = losses.driving;
    if let Some(efficiency) = ratio(without, work) {
        writeln!(
            output,
            "  efficiency {efficiency:.DECIMALS$} while drivers drive the load: {} J of {} J",
            joules(without),
            joules(work)
        )?;
    }
    if let Some(lowest) = losses.lowest {
        writeln!(
            output,
            "  lowest efficiency {:.DECIMALS$} at t = {} s",
            lowest.efficiency,
            time(lowest.t)
        )?;
    }
    let [work, without] = losses.driven;
    if let Some(efficiency) = ratio(work, without) {
        writeln!(
            output,
            "  efficiency {efficiency:.DECIMALS$} while the load drives: {} J of {} J",
            joules(work),
            joules(without)
        )?;
    }
    let locked = losses.locked();
    if locked.is_empty() {
        return writeln!(output, "  never self-locking");
    }
    for [from, to] in locked {
        let [from, to] = [from, to].map(time_of_extreme);
        writeln!(output, "  self-locking from t = {from} s to {to} s")?;
    }
    Ok(())
}

/// Returns a quotient of work; `None` if nothing is done.
fn ratio(part: f64, whole: f64) -> Option<f64> {
    (whole > 0.0).then_some(part / whole)
}
