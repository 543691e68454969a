//! Simulates a mechanism with free coordinates under its forces.

use std::ops::ControlFlow;

use linkwright_page::motion::{Columns, Followed, Listeners};
use linkwright_solver::{Method, SimulationOptions, Tolerances, View as _};
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;

use crate::findings::refused;
use crate::frames::Frames;
use crate::interrupt::Interrupt;
use crate::mechanism::Mechanism;
use crate::motion::{Solved, ended, everything, instants, schedule};

#[pymethods]
impl Mechanism {
    /// Simulates the motion from t = 0 to these times (s), none of them negative.
    fn simulate(
        &self,
        py: Python<'_>,
        times: PyReadonlyArray1<'_, f64>,
        relative: f64,
        absolute: f64,
        method: &str,
    ) -> PyResult<Solved> {
        let times = instants(&times)?;
        if let Some(t) = times.iter().find(|t| **t < 0.0) {
            return Err(refused(format!(
                "t = {t} s lies before the start of the motion, 0 s"
            )));
        }
        let view = self.view();
        if view.system().mechanism.forces.free.is_empty() {
            return Err(refused(format!(
                "no coordinate of `{}` is free, so forces move nothing",
                view.system().mechanism.title()
            )));
        }
        let schedule = schedule(0.0, &times, None)?;
        let options = SimulationOptions {
            tolerances: Tolerances { relative, absolute },
            method: match method {
                "auto" => Method::Automatic,
                "dop853" => Method::Explicit,
                "implicit" => Method::Implicit,
                _ => {
                    return Err(refused(format!(
                        "the methods are \"auto\", \"dop853\" and \"implicit\", not \"{method}\""
                    )));
                }
            },
        };
        let chosen = self.chosen(&view, 0.0)?;
        let (motion, frames) = py.detach(move || {
            let selection = everything(&view);
            let mut motion = Followed::moved_by_forces(&view, selection, chosen.clone());
            let mut frames = Frames::new(Columns::of(&motion));
            let (mut interrupt, mut interrupted) = (Interrupt::new(), None);
            let listeners = Listeners {
                reached: &mut |_| {},
                // There may be many steps before the next instant.
                taken: &mut |_| match interrupt.check() {
                    Ok(()) => ControlFlow::Continue(()),
                    Err(error) => {
                        interrupted = Some(error);
                        ControlFlow::Break(String::new())
                    }
                },
            };
            let started = (&view, chosen);
            let simulated =
                motion.simulate(started, &schedule, options, &mut [&mut frames], listeners);
            match interrupted {
                Some(error) => Err(error),
                None => simulated.map(|()| (motion, frames)).map_err(ended),
            }
        })?;
        Solved::of(py, motion, &frames, &times)
    }
}
