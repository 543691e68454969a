//! Defines the arguments of `linkwright solve`.

use clap::{Args, ValueEnum};

use super::described::Described;
use super::reported::Reported;
use super::setting::Setting;
use super::values::{step, time};

/// Solves the motion of a mechanism without a compile step.
///
/// The mechanism is assembled at the start in the mode of its design configuration, and advanced step by step, so
/// that it stays in this mode. Quantities are in m, rad and s unless other units are chosen.
///
/// It runs the blocks of a generated module, so that it takes the same path and fails with the same words.
#[derive(Args, Debug)]
#[command(after_help = SOLVE_EXAMPLES)]
pub struct Solve {
    /// The description.
    #[command(flatten)]
    pub described: Described,
    /// Start of the motion, in s; the mechanism is assembled there
    #[arg(long, value_name = "T0", default_value = "0", value_parser = time, allow_hyphen_values = true)]
    pub from: f64,
    /// End of the motion, in s
    #[arg(long, value_name = "T1", default_value = "5", value_parser = time, allow_hyphen_values = true)]
    pub to: f64,
    /// Time between frames, in s; the last frame is the last whole step up to T1
    #[arg(long, value_name = "H", default_value = "0.01", value_parser = step, allow_hyphen_values = true)]
    pub step: f64,
    /// Only this instant, in s, followed from T0 by steps of H; may be repeated. Files are then written only on request
    #[arg(long, value_name = "T", value_delimiter = ',', value_parser = time, allow_hyphen_values = true, conflicts_with_all = ["to", "plot"])]
    pub at: Vec<f64>,
    /// Departures from the description.
    #[command(flatten)]
    pub setting: Setting,
    /// Results.
    #[command(flatten)]
    pub reported: Reported,
    /// Print the first Newton-Raphson step from the design configuration at the start, or at each T of --at: Φ_q, -Φ
    /// and Δq
    #[arg(long, conflicts_with = "json")]
    pub first_step: bool,
    /// Formulation of the equations
    #[arg(long, value_enum, default_value_t = Formulation::Solved, conflicts_with_all = ["branch", "monitor"])]
    pub formulation: Formulation,
    /// Compute efforts and reactions of a mechanism at rest at every instant: rates and accelerations count as zero
    #[arg(long = "static")]
    pub at_rest: bool,
    /// Add columns with the distance of each block from a singular pose, from 0, singular, to 1, and the smallest
    /// value to the summary; `linkwright check` locates it between frames
    #[arg(long, conflicts_with = "json")]
    pub monitor: bool,
}

/// Formulation of the equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Formulation {
    /// Block by block, as a generated module does
    Solved,
    /// All together as one dense system, by Newton-Raphson, from the estimates of the description
    Textbook,
}

const SOLVE_EXAMPLES: &str = "\
Examples:
  linkwright solve mechanisms/excavator.mech                        summary, CSV and plots of five seconds
  linkwright solve mechanisms/excavator.mech --at 2.5 --points K    one instant of one point
  linkwright solve mechanisms/two_body.mech --show phi2 --angles deg --at 500ms
  linkwright solve mechanisms/two_body.mech --first-step --no-files
  linkwright solve mechanisms/two_body.mech --csv - > motion.csv
  linkwright solve lift.mech --set L2=360mm --set 'lift=0.5 + 0.1*sin(2*t)'
  linkwright solve mechanisms/two_body.mech --branch phi2=other     the mirror image of the design configuration
  linkwright solve mechanisms/two_body.mech --json | jq '.frames[-1].points.Q'
  linkwright solve mechanisms/excavator.mech --step 5e-6 --no-files a million frames, checked and not kept

Exit codes: 0 solved, 1 the mechanism cannot be assembled or its motion ends early, 2 bad input.
Frames before the end of a motion that ends early are printed and written nevertheless.";
