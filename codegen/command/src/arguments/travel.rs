//! Defines the arguments of `linkwright travel`.

use std::path::PathBuf;

use clap::Args;

use super::described::Described;
use super::units::ReportedIn;
use super::values::time;

/// Finds how far a drive can go each way from the design configuration, and what ends its travel.
///
/// The other drivers and all inputs keep their values. An end is the last value at which a loop can be closed, a dead
/// point, a change point where branches meet, or a `limit`. Its decimals are verified from both sides: a pose exists
/// at the value, and none within the travel at the next decimal.
///
/// Of two drives, it follows the border of the region that is connected with the design configuration.
#[derive(Args, Debug)]
#[command(after_help = TRAVEL_EXAMPLES)]
pub struct Travel {
    /// Description.
    #[command(flatten)]
    pub described: Described,
    /// Units of the report.
    #[command(flatten)]
    pub reported_in: ReportedIn,
    /// Driver to move, by its name or its quantity, as in `phi(crank)`; a wrong name lists the drivers. Given twice: the
    /// region of two drives
    #[arg(long, value_name = "NAME", required = true)]
    pub drive: Vec<String>,
    /// Point whose workspace two drives span
    #[arg(long, value_name = "POINT")]
    pub point: Option<String>,
    /// Folder for pictures of two drives: `region.svg`, and with a point `workspace.svg`
    #[arg(long, value_name = "DIR")]
    pub plot: Option<PathBuf>,
    /// Replace files that this command has not written
    #[arg(long)]
    pub force: bool,
    /// Time of the values at which drivers and inputs stand, in s; the mechanism is assembled there
    #[arg(long, value_name = "T", default_value = "0", value_parser = time, allow_hyphen_values = true)]
    pub at: f64,
    /// Value of a parameter, or motion of an input as an expression of t, in SI units or with a unit; may be repeated
    #[arg(long, value_name = "NAME=VALUE", allow_hyphen_values = true)]
    pub set: Vec<String>,
    /// Prove that the mechanism moves on one smooth path from the design configuration to each end
    #[arg(long)]
    pub prove: bool,
    /// Print one JSON object instead of text
    #[arg(long)]
    pub json: bool,
}

const TRAVEL_EXAMPLES: &str = "\
Examples:
  linkwright travel mechanisms/two_body.mech --drive 'phi(1)'
  linkwright travel mechanisms/excavator.mech --drive 'length(N, M)' --units=mm,deg
  linkwright travel mechanisms/excavator.mech --drive 'length(N, M)' --at 2.5 --prove
  linkwright travel mechanisms/four_bar.mech --drive 'phi(crank)' --json | jq '.ends[].end'
  linkwright travel mechanisms/excavator.mech --drive 'length(N, M)' --drive 'length(H, G)' --point K --plot pictures

Exit codes: 0 followed, 1 the mechanism cannot be assembled, or with `--prove` a path cannot be proven, 2 bad input.";
