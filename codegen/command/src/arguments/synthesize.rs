//! Defines the arguments of `linkwright synthesize`.

use std::path::PathBuf;

use clap::Args;

use super::described::Described;
use super::measured::Table;
use super::units::ReportedIn;
use super::values::{step, time};

/// Chooses parameters for which points, angles and measures pass the rows of a table.
///
/// Mechanisms are sampled evenly within the bounds, in all assembly modes. The nearest ones are starts of least squares with the derived
/// sensitivities. Limits of the description are kept, and the mechanism moves over the whole range. Each solution is written as a
/// description, checked, and proven to move.
///
/// A table without a column of times gives an order only: its rows are passed at any times in this order, within one turn of the drive.
#[derive(Args, Debug)]
#[command(after_help = SYNTHESIZE_EXAMPLES)]
pub struct Synthesize {
    /// Description.
    #[command(flatten)]
    pub described: Described,
    /// Units of the report.
    #[command(flatten)]
    pub reported_in: ReportedIn,
    /// Targets: values of points, angles and measures, row by row.
    #[command(flatten)]
    pub table: Table,
    /// Parameters to choose with their bounds, `a=1mm..2mm`; `a,b=1mm..2mm` gives both the same bounds. Without bounds, they are
    /// those of the parameter's range in the description
    #[arg(
        long,
        value_name = "PARAMETER[=LOW..HIGH]",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    pub param: Vec<String>,
    /// Permitted difference: `0.5mm` of columns in this unit, `K_x=2mm` of one. Columns are weighed by it [default: differences are
    /// weighed by the extent of the targets in their unit]
    #[arg(long, value_name = "[COLUMN=]VALUE[UNIT]", value_delimiter = ',')]
    pub tolerance: Vec<String>,
    /// Start of the motion, in s; the mechanism is assembled there [default: the first time of the table, 0 without times]
    #[arg(long, value_name = "T0", value_parser = time, allow_hyphen_values = true)]
    pub from: Option<f64>,
    /// End of the motion, in s [default: the last time of the table; without times, after one turn of the drive]
    #[arg(long, value_name = "T1", value_parser = time, allow_hyphen_values = true)]
    pub to: Option<f64>,
    /// Require a full turn of the drive
    #[arg(long, conflicts_with = "to")]
    pub turn: bool,
    /// Largest time between the frames of the check and of its proof, in s
    #[arg(long, value_name = "H", default_value = "0.01", value_parser = step, allow_hyphen_values = true)]
    pub step: f64,
    /// Number of sampled mechanisms
    #[arg(long, value_name = "N", default_value = "16384", value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    pub samples: u32,
    /// Number of these from which a fit begins
    #[arg(long, value_name = "N", default_value = "200", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub fits: u32,
    /// Seed of the samples
    #[arg(long, value_name = "SEED", default_value = "0")]
    pub seed: u64,
    /// Largest number of solutions that are listed
    #[arg(long, value_name = "N", default_value = "3", value_parser = clap::value_parser!(u32).range(1..=100))]
    pub solutions: u32,
    /// Folder for the solutions: of each a description, NAME_1.mech, and a picture with the paths of its points and the targets on them,
    /// NAME_1.svg
    #[arg(short, long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Print one JSON object instead of text
    #[arg(long)]
    pub json: bool,
    /// Number of threads [default: as many as the machine has]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
    /// Replace existing files
    #[arg(long)]
    pub force: bool,
}

const SYNTHESIZE_EXAMPLES: &str = "\
Examples:
  linkwright synthesize lift.mech path.csv --param L2,L3,L4=20mm..200mm --out solutions
  linkwright synthesize lift.mech path.csv --param L2=20mm..60mm,L3,L4=80mm..200mm --tolerance 0.2mm
  linkwright synthesize lift.mech timed.csv --param L2,L3,L4=20mm..200mm --turn --samples 100000 --fits 1000
  linkwright synthesize lift.mech path.csv --param L3=80mm..200mm --json | jq '.solutions[0].parameters'

Ctrl-C ends the search and lists the solutions so far; a second one ends the command.

Exit codes: 0 a solution is listed, and with `--tolerance` meets all targets, 1 none does, 2 bad input.";
