//! Tables of simulated motions: errors beside evaluations.
//!
//! Every cell is a count or an error; none depends on the machine.

use std::ops::RangeInclusive;

use linkwright_solver::{Method, SimulationOptions};

use crate::damped_chain::{DampedChain, Element};
use crate::sled::Sled;
use crate::stiff::{Damped, Found, options};
use crate::study::table::aligned;

/// Drags of sleds (N·s/m).
const DRAGS: [f64; 3] = [1e4, 1e6, 1e8];

/// Table of errors and evaluations of one mechanism with one damper (N·s/m) up to the time `end` (s), for each tolerance and method.
pub fn damped_table(damped: Damped, damper: f64, end: f64) -> String {
    let motion = damped.motion(damper, end);
    let methods = [Method::Explicit, Method::Implicit, Method::Automatic];
    let titles = [
        "`--rtol`",
        "dop853: error",
        "evaluations",
        "implicit: error",
        "evaluations",
        "automatic: error",
        "evaluations",
    ];
    let mut rows = vec![titles.map(str::to_string)];
    for digits in 4..=12 {
        let relative = 10_f64.powi(-digits);
        let mut cells = vec![format!("{relative:.0e}")];
        for method in methods {
            // The strong damper needs as many explicit steps whatever the tolerance.
            let is_first = digits == 6 && damped == Damped::Slider;
            if method == Method::Explicit && damper > 1e3 && !is_first {
                cells.extend(["–".to_string(), "–".to_string()]);
                continue;
            }
            let comparison = damped.compared(damper, &motion, end, options(method, relative));
            match comparison {
                Ok(comparison) => {
                    cells.push(format!("{:.1e}", comparison.error));
                    cells.push(comparison.effort.evaluations.to_string());
                }
                Err(_) => cells.extend(["ends".to_string(), "–".to_string()]),
            }
        }
        rows.push(std::array::from_fn(|column| cells[column].clone()));
    }
    aligned(&rows, 0)
}

/// Errors in tolerances and evaluations, a row for each tolerance of so many digits and two columns for each damper.
fn by_tolerance<E>(
    digits: RangeInclusive<i32>,
    dampers: &[f64],
    compared: impl Fn(usize, SimulationOptions) -> Result<Found, E>,
) -> String {
    let mut titles = vec!["`--rtol`".to_string()];
    for damper in dampers {
        titles.extend([format!("{damper:.0e}: error"), "evaluations".to_string()]);
    }
    let mut rows = vec![titles];
    for digits in digits {
        let relative = 10_f64.powi(-digits);
        let mut cells = vec![format!("{relative:.0e}")];
        for place in 0..dampers.len() {
            match compared(place, options(Method::Automatic, relative)) {
                Ok(found) => {
                    cells.push(format!("{:.1}", found.error / relative));
                    cells.push(found.effort.evaluations.to_string());
                }
                Err(_) => cells.extend(["ends".to_string(), "–".to_string()]),
            }
        }
        rows.push(cells);
    }
    aligned(&rows, 0)
}

/// Table of chains of `count` pendulums that move from rest up to the time `end` (s), two columns for each damper.
pub fn chain(count: usize, element: Element, dampers: &[f64], end: f64) -> String {
    let chains = dampers.iter().map(|&damper| DampedChain {
        count,
        damper,
        element,
    });
    let chains: Vec<_> = chains.map(|it| (it, it.motion(end))).collect();
    by_tolerance(4..=12, dampers, |place, options| {
        let (chain, motion) = &chains[place];
        chain.compared(motion, end, options)
    })
}

/// Table of sleds with a drag whose direction turns, up to the time `end` (s).
pub fn sleds(end: f64) -> String {
    by_tolerance(4..=10, &DRAGS, |place, options| {
        let drag = DRAGS[place];
        Sled { drag }.compared(end, options)
    })
}
