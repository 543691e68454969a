//! Defines the arguments of `linkwright sweep`.

use std::path::PathBuf;

use clap::Args;

use super::described::Described;
use super::units::ReportedIn;
use super::values::{step, time};

/// Solves the motion for many sets of parameters and inputs, and writes a table of their extremes.
///
/// Sets are all combinations of evenly spaced values, the rows of a file, or samples of Sobol's sequence. All threads
/// solve, sixteen sets at once each; the numbers do not depend on it. A set that cannot be solved has a row with the
/// reason.
#[derive(Args, Debug)]
#[command(after_help = SWEEP_EXAMPLES)]
pub struct Sweep {
    /// Description.
    #[command(flatten)]
    pub described: Described,
    /// Units of the report.
    #[command(flatten)]
    pub reported_in: ReportedIn,
    /// Range of a parameter or an input, with its number of values; both ends are among them. Without ends, `NAME:COUNT`,
    /// they are those of its range in the description. May be repeated: the last range varies fastest. An input is
    /// constant during a motion
    #[arg(
        long,
        value_name = "NAME=FIRST..LAST:COUNT",
        allow_hyphen_values = true
    )]
    pub vary: Vec<String>,
    /// Table with a column for each parameter or input, and a row for each set; headers may hold units, `rod (mm)`
    #[arg(long, value_name = "FILE")]
    pub rows: Option<PathBuf>,
    /// Number of samples of Sobol's sequence within the ranges, which then have no COUNT
    #[arg(long, value_name = "N", requires = "vary")]
    pub samples: Option<u64>,
    /// Seed that scrambles the samples as Owen does [default: the sequence itself]
    #[arg(long, value_name = "SEED", requires = "samples")]
    pub seed: Option<u64>,
    /// Start of the motion, in s; each set is assembled there
    #[arg(long, value_name = "T0", default_value = "0", value_parser = time, allow_hyphen_values = true)]
    pub from: f64,
    /// End of the motion, in s
    #[arg(long, value_name = "T1", default_value = "5", value_parser = time, allow_hyphen_values = true)]
    pub to: f64,
    /// Time between frames, in s; the last frame is the last whole step up to T1
    #[arg(long, value_name = "H", default_value = "0.01", value_parser = step, allow_hyphen_values = true)]
    pub step: f64,
    /// Value of a parameter, or motion of an input as an expression of t, in all sets; may be repeated
    #[arg(long, value_name = "NAME=VALUE", allow_hyphen_values = true)]
    pub set: Vec<String>,
    /// Assembly mode of a loop in all sets, as in `solve`; may be repeated
    #[arg(long, value_name = "LOOP=MODE")]
    pub branch: Vec<String>,
    /// Quantities, separated by commas: coordinates, rates, points, their components and forces, as in `solve`: `phi(1)`,
    /// `phi2_d`, `K`, `K_vx`, `effort_crank` [default: all angles]
    #[arg(long, value_name = "phi(1),x2,K_x", value_delimiter = ',')]
    pub show: Vec<String>,
    /// Write the values at every instant, a row for each, instead of their extremes
    #[arg(long)]
    pub instants: bool,
    /// Output file of the table, as CSV or Parquet by its ending: `.csv` or `.parquet` [default: sweep.csv in the folder
    /// of `solve`]
    #[arg(short, long, value_name = "FILE", conflicts_with = "csv")]
    pub output: Option<PathBuf>,
    /// Output file of the table as CSV, with any ending; `-` is stdout, and the summary then goes to stderr
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// Folder for the pictures of one or two varied values: an SVG for each quantity [default: the folder of the
    /// default table]
    #[arg(long, value_name = "DIR")]
    pub plot: Option<PathBuf>,
    /// Continue a table of CSV that an interrupted run has left
    #[arg(long)]
    pub resume: bool,
    /// Number of threads [default: as many as the machine has]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
    /// Replace files that this command has not written, and what an interrupted run has left
    #[arg(long, conflicts_with = "resume")]
    pub force: bool,
}

const SWEEP_EXAMPLES: &str = "\
Examples:
  linkwright sweep lift.mech --vary L3=100mm..140mm:41 --show phi_rocker    41 couplers: a table and a picture
  linkwright sweep lift.mech --vary L3=100mm..140mm:41 --vary L4=60mm..100mm:41 --show P_y
  linkwright sweep lift.mech --vary L3:41                                   L3 from end to end of its range
  linkwright sweep lift.mech --rows sets.csv --instants --csv - > frames.csv
  linkwright sweep lift.mech --rows sets.csv --instants -o frames.parquet
  linkwright sweep lift.mech --vary L3=100mm..140mm --vary L4=60mm..100mm --samples 10000 --seed 7
  linkwright sweep lift.mech --vary L3=100mm..140mm:1000001 --resume        continues after an interruption

The table grows in FILE.part, which becomes FILE at the end. A part that is a Parquet file cannot be continued.

Exit codes: 0 solved, also if sets fail, 2 bad input.";
