//! Draws a mechanism and writes its page, for notebooks.

use linkwright_codegen::stages::emit::drawing::{Options, Pose, draw};
use linkwright_page::{Live, Page, Range, at_start, checked, page};
use linkwright_solver::drawn::pose;
use linkwright_solver::{Movable as _, Schedule, View as _};
use pyo3::prelude::*;

use crate::findings::refused;
use crate::mechanism::Mechanism;

#[pymethods]
impl Mechanism {
    /// Draws the mechanism as SVG in its assembly at `t` (s); in its design configuration if it cannot be assembled.
    fn drawing(&self, py: Python<'_>, t: f64) -> PyResult<String> {
        let view = self.view();
        let chosen = self.chosen(&view, t)?;
        Ok(py.detach(move || {
            let drawn = match at_start(&view, chosen, t) {
                Ok(moved) => pose(&view, moved.instant()),
                Err(_) => Pose::drawn(view.pool(), view.system()),
            };
            let options = Options {
                caption: view.system().mechanism.title(),
                ..Options::default()
            };
            draw(view.pool(), view.system(), &drawn, &[], &[], &options)
        }))
    }

    /// Writes the page of a motion between two times (s), as one file that loads nothing.
    fn page(&self, py: Python<'_>, from: f64, to: f64, step: f64) -> PyResult<String> {
        let view = self.view();
        let schedule = Schedule::range(from, to, step).map_err(refused)?;
        let chosen = self.chosen(&view, from)?;
        let label = chosen
            .as_ref()
            .and(self.assembly_label())
            .map(str::to_string);
        Ok(py.detach(move || {
            let check = checked(&view, &schedule);
            let contents = Page {
                check: &check,
                schedule: &schedule,
                range: Range { from, to, step },
                requested: Vec::new(),
                chosen,
                label: label.as_deref(),
                findings: "",
            };
            page(&contents, Live::No).0
        }))
    }
}
