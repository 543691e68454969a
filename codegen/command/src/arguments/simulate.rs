//! Defines the arguments of `linkwright simulate`.

use clap::{Args, ValueEnum};

use super::described::Described;
use super::reported::Reported;
use super::values::{step, time, tolerance};

/// Integrates the motion of a mechanism with `free` coordinates under forces, from the start in its description.
///
/// As many coordinates as are free are integrated with their rates, by a method of order 8 with steps of its own
/// (DOP853). The integrated ones follow the tangent of the constraints at a recent pose, so that dead centers of the
/// `free` coordinates do not matter. While the motion is stiff, as with strong dampers, an implicit method of order 9
/// (Radau IIA) takes the steps. All else follows from the equations of the joints, so that every frame satisfies them
/// to rounding. Frames between the steps are those of the dense output. A motion whose energy does not change by the
/// work done ends with an error.
#[derive(Args, Debug)]
#[command(after_help = SIMULATE_EXAMPLES)]
pub struct Simulate {
    /// The description.
    #[command(flatten)]
    pub described: Described,
    /// End of the motion, in s; it starts at 0
    #[arg(long, value_name = "T", default_value = "5", value_parser = time, allow_hyphen_values = true)]
    pub to: f64,
    /// Time between frames, in s; the steps of the integration do not depend on it
    #[arg(long, value_name = "H", default_value = "0.01", value_parser = step, allow_hyphen_values = true)]
    pub step: f64,
    /// Tolerance of a step, relative to each integrated coordinate, up to 1 rad or one characteristic length, and to
    /// each rate
    #[arg(long, value_name = "R", default_value = "1e-10", value_parser = tolerance, allow_hyphen_values = true)]
    pub rtol: f64,
    /// Absolute tolerance of a step, in rad or characteristic lengths of the mechanism, and the same per s
    #[arg(long, value_name = "A", default_value = "1e-12", value_parser = tolerance, allow_hyphen_values = true)]
    pub atol: f64,
    /// Method of all steps [default: explicit steps, and implicit ones while the motion is stiff]
    #[arg(long, value_enum)]
    pub method: Option<StepMethod>,
    /// Value of a parameter, motion of an input as an expression of t, or start of a free coordinate: `swing=0.3 +
    /// 1.5*t` begins at 0.3 with the rate 1.5; may be repeated
    #[arg(long, value_name = "NAME=VALUE", allow_hyphen_values = true)]
    pub set: Vec<String>,
    /// Assembly mode of a loop, as in `solve`; may be repeated
    #[arg(long, value_name = "LOOP=MODE")]
    pub branch: Vec<String>,
    /// Results.
    #[command(flatten)]
    pub reported: Reported,
}

/// Integration methods.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum StepMethod {
    /// DOP853: explicit, of order 8
    Dop853,
    /// Radau IIA: implicit, of order 9, for stiff motions
    Implicit,
}

const SIMULATE_EXAMPLES: &str = "\
Examples:
  linkwright simulate pendulum.mech --to 20                           summary, CSV and plots of twenty seconds
  linkwright simulate pendulum.mech --set swing=170deg --show phi1    from another start
  linkwright simulate pendulum.mech --rtol 1e-12 --csv - > motion.csv
  linkwright simulate damped.mech --method implicit                   no explicit steps, not even the first ones
  linkwright simulate pendulum.mech --json | jq '.simulation'         evaluations, steps, drift of the energy

Exit codes: 0 simulated, 1 the mechanism cannot be assembled or its motion ends early, 2 bad input.
Frames before the end of a motion that ends early are printed and written nevertheless.";
