//! Prepares solved instants for drawings: paths of points, and the sheet of all assemblies.

use linkwright_codegen::stages::emit::drawing::{self, Panel, Traced};
use linkwright_solver::drawn::pose;
use linkwright_solver::{Assembly, View};

use super::picture::signed;

/// Largest number of ticks of a path.
const TICKS: f64 = 24.0;

/// Relative amount by which an interval may fall short of the least: powers of ten are rounded.
const ROUND_TO: f64 = 1e-9;

/// Largest number of assemblies that are drawn.
const DRAWN: usize = 64;

/// Returns the number of steps between two ticks of a path. Their time is one, two or five times a power of ten.
pub fn tick_steps(length: f64, step: f64) -> usize {
    let least = length / TICKS;
    let power = 10.0_f64.powf(least.log10().floor());
    let round = [1.0, 2.0, 5.0, 10.0].map(|digit| digit * power);
    let interval = round.into_iter().find(|it| *it >= least * (1.0 - ROUND_TO));
    ((interval.unwrap_or(least) / step).round() as usize).max(1)
}

/// Returns the path of a point, with a tick at every `ticks`-th position.
pub fn traced(name: &str, places: &[[f64; 2]], ticks: usize) -> Traced {
    Traced {
        name: name.to_string(),
        points: places.to_vec(),
        ticks: places.iter().step_by(ticks).copied().collect(),
    }
}

/// Draws all assemblies, that of the design configuration first, each above its signs and letters; empty if there are none.
pub fn assemblies<V: View>(view: &V, found: &[Assembly]) -> String {
    let system = view.system();
    let panels = found.iter().take(DRAWN).map(|assembly| {
        let drawn = if assembly.drawn { " as drawn" } else { "" };
        Panel {
            title: format!("{}{drawn}", assembly.label().replace('-', "−")),
            pose: pose(view, &assembly.instant),
        }
    });
    let panels: Vec<Panel> = panels.collect();
    match panels.is_empty() {
        true => String::new(),
        false => signed(&drawing::sheet(system, &panels)),
    }
}

#[cfg(test)]
mod tests {
    use super::tick_steps;

    #[test]
    fn ticks_are_round_times_apart() {
        assert_eq!(tick_steps(5.0, 0.01), 50);
        assert_eq!(tick_steps(2.0, 0.01), 10);
        assert_eq!(tick_steps(1e-3, 1e-5), 5);
        assert_eq!(tick_steps(0.1, 1.0), 1);
    }
}
