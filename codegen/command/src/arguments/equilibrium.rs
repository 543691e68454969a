//! Defines the arguments of `linkwright equilibrium`.

use std::path::PathBuf;

use clap::Args;

use super::described::Described;
use super::units::ReportedIn;
use super::values::time;

/// Finds the equilibria of what is `free`, under gravity, springs and loads.
///
/// The mechanism is at rest: drivers and inputs stand at their values at one time, and dampers do nothing. The poses of one
/// free coordinate are followed along their curve, through dead centers; equilibria of several are sought from many
/// starts, so that more may exist. The Hessian of the energy on the constraints decides if an equilibrium is stable, and
/// gives the frequencies of small oscillations.
///
/// With a path, the equilibria are those at its first value. One of them is followed while the parameter changes,
/// through folds, at which the mechanism snaps, and through changes of stability.
#[derive(Args, Debug)]
#[command(after_help = EQUILIBRIUM_EXAMPLES)]
pub struct Equilibrium {
    /// Description.
    #[command(flatten)]
    pub described: Described,
    /// Units of the report.
    #[command(flatten)]
    pub reported_in: ReportedIn,
    /// Range of a parameter or an input over which an equilibrium is followed
    #[arg(long, value_name = "NAME=FIRST..LAST", allow_hyphen_values = true)]
    pub path: Option<String>,
    /// Number of the equilibrium that is followed, as listed [default: the stable one next to the design configuration]
    #[arg(long, value_name = "N", requires = "path", value_parser = clap::value_parser!(u32).range(1..))]
    pub of: Option<u32>,
    /// Folder for the picture of a path, `equilibrium.svg`
    #[arg(long, value_name = "DIR", requires = "path")]
    pub plot: Option<PathBuf>,
    /// Replace a picture that this command has not written
    #[arg(long)]
    pub force: bool,
    /// Number of poses besides the design configuration from which equilibria are sought
    #[arg(long, value_name = "N", default_value = "200", value_parser = clap::value_parser!(u32).range(0..=1_000_000))]
    pub starts: u32,
    /// Time of the values at which drivers and inputs stand, in s; the mechanism is assembled there
    #[arg(long, value_name = "T", default_value = "0", value_parser = time, allow_hyphen_values = true)]
    pub at: f64,
    /// Value of a parameter, or motion of an input as an expression of t, in SI units or with a unit; may be repeated
    #[arg(long, value_name = "NAME=VALUE", allow_hyphen_values = true)]
    pub set: Vec<String>,
    /// Print one JSON object instead of text
    #[arg(long)]
    pub json: bool,
}

const EQUILIBRIUM_EXAMPLES: &str = "\
Examples:
  linkwright equilibrium lamp.mech --units=mm,deg
  linkwright equilibrium lamp.mech --set stiffness=300N/m --json | jq '.equilibria[].stability'
  linkwright equilibrium truss.mech --path load=0N..120N --plot pictures    through both snaps
  linkwright equilibrium truss.mech --path load=0N..120N --of 3             another equilibrium of the list

Ctrl-C ends the search or the path with what is done so far; a second one ends the command.

Exit codes: 0 found, 1 nothing is in equilibrium, a path is lost or the mechanism cannot be assembled, 2 bad input.";
