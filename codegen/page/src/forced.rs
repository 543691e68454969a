//! Records motions under forces, of mechanisms with free coordinates.

use std::ops::ControlFlow;

use linkwright::{Blocks as _, Settings, Shell, Signal};
use linkwright_solver::simulation::Effort;
use linkwright_solver::{
    Check, InputSignals, Instant, Interpreted, Method, Modes, Numbers, Schedule, SimulationOptions,
    Tolerances, View as _,
};

use crate::motion::{Followed, Listeners, Wanted};
use crate::recorded::{Kept, Track};

/// Relative tolerance of a step, which is that of the command `simulate` without options.
const RELATIVE: f64 = 1e-10;

/// Absolute tolerance of a step, which is that of the command `simulate` without options.
const ABSOLUTE: f64 = 1e-12;

/// Tolerances and method of a motion under forces.
pub const OPTIONS: SimulationOptions = SimulationOptions {
    tolerances: Tolerances {
        relative: RELATIVE,
        absolute: ABSOLUTE,
    },
    method: Method::Automatic,
};

/// Largest number of evaluations of a motion under forces.
const MAX_EVALUATIONS: u64 = 100_000;

/// True if forces move coordinates of the mechanism.
pub fn is_moved_by_forces(view: &Interpreted) -> bool {
    !view.system().mechanism.forces.free.is_empty()
}

/// Looks for assemblies, and for singular poses along a motion. Of a motion under forces only the start is checked: free coordinates do not
/// follow it with their first rates.
pub fn checked(view: &Interpreted, schedule: &Schedule) -> Check {
    let start = Schedule::range(schedule.start.t, schedule.start.t, 1.0);
    match (is_moved_by_forces(view), start) {
        (true, Ok(start)) => Check::new(view.clone(), &start, |_| {}),
        _ => Check::new(view.clone(), schedule, |_| {}),
    }
}

/// Returns the end of a motion that takes too many evaluations.
pub fn limited(effort: &Effort) -> ControlFlow<String> {
    match effort.evaluations > MAX_EVALUATIONS {
        false => ControlFlow::Continue(()),
        true => ControlFlow::Break(format!(
            "is followed no further on a page: its forces have been evaluated {MAX_EVALUATIONS} times; a simulation outside of a page goes on"
        )),
    }
}

/// Reports that a motion under forces does not begin at a time (s); `Ok` for t = 0.
///
/// # Errors
/// A sentence.
pub fn begins_at(t: f64) -> Result<(), String> {
    match t == 0.0 {
        true => Ok(()),
        false => Err(format!(
            "moves under forces from t = 0 s on, and not from t = {t} s: set the first time to 0 s"
        )),
    }
}

/// Follows the mechanism under forces, and keeps instants.
///
/// # Errors
/// A sentence: the motion does not begin.
pub fn followed(
    view: &Interpreted,
    schedule: &Schedule,
    chosen: Option<(Instant, Modes)>,
    mut kept: Kept,
) -> Result<Track, String> {
    begins_at(schedule.start.t)?;
    let selection = Wanted::default();
    let modes = match &chosen {
        Some((_, modes)) => modes.clone(),
        None => view.drawn_branches(),
    };
    let mut motion = Followed::moved_by_forces(view, selection, chosen.clone());
    let listeners = Listeners {
        reached: &mut |_| {},
        taken: &mut limited,
    };
    let ended = motion.simulate(
        (view, chosen),
        schedule,
        OPTIONS,
        &mut [&mut kept],
        listeners,
    );
    ended.map_err(|error| error.to_string())?;
    let mut kept = kept.all();
    if let Some((first, ..)) = kept.first_mut() {
        *first = solved_by_blocks(view, first, modes)?;
    }
    Ok(Track {
        kept,
        error: motion.error,
        warnings: motion.warnings,
    })
}

/// Returns the signals that an instant has, which are those of the free coordinates in the motion.
pub fn signals(view: &Interpreted, instant: &Instant) -> InputSignals {
    // Inputs precede all values in which formulations differ.
    let value = |symbol| {
        view.layout()
            .slot(symbol)
            .map(|slot| instant.values()[slot])
    };
    let inputs = view.system().mechanism.inputs.iter();
    InputSignals(
        inputs
            .map(|input| {
                let [value, rate, acceleration] =
                    input.symbols.map(|it| value(it).unwrap_or(f64::NAN));
                Signal::new(value, rate, acceleration)
            })
            .collect(),
    )
}

/// Returns the instant with everything that the blocks of a solution compute.
fn solved_by_blocks(
    view: &Interpreted,
    instant: &Instant,
    modes: Modes,
) -> Result<Instant, String> {
    let shell = Shell::assemble(
        view.clone(),
        &view.nominal_parameters(),
        &Numbers(instant.q().to_vec()),
        modes,
        instant.t(),
        &signals(view, instant),
        Settings::default(),
    );
    let shell = shell.map_err(|failure| view.not_assembled(&failure))?;
    Ok(shell.frame().clone())
}
