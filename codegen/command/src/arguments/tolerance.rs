//! Defines the arguments of `linkwright tolerance`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::described::Described;
use super::units::ReportedIn;
use super::values::{step, time};

/// Adds up the tolerances of parameters: the spread of every measure along the motion.
///
/// Parameters have tolerances in the description: `param rod = 120mm tolerance 0.1mm;` is even within a distance, and `sigma
/// 0.03mm` normal with a standard deviation. In first order, the worst case is the sum of derivatives times tolerances, with
/// three standard deviations of a normal parameter, and the standard deviation the root of the sum of squares. Derivatives
/// are exact for measures of positions and rates, and differences for accelerations and forces. Sampled mechanisms show where
/// the first order is not enough.
#[derive(Args, Debug)]
#[command(after_help = TOLERANCE_EXAMPLES)]
pub struct Tolerance {
    /// Description.
    #[command(flatten)]
    pub described: Described,
    /// Units of the report.
    #[command(flatten)]
    pub reported_in: ReportedIn,
    /// Number of sampled mechanisms; 0 for the first order alone
    #[arg(long, value_name = "N", default_value = "10000", value_parser = clap::value_parser!(u32).range(0..=1_000_000))]
    pub samples: u32,
    /// Sequence from which mechanisms are drawn
    #[arg(long, value_enum, value_name = "SEQUENCE", default_value = "sobol")]
    pub sampling: SampleSequence,
    /// Seed of the samples
    #[arg(long, value_name = "SEED", default_value = "0")]
    pub seed: u64,
    /// Start of the motion, in s; each mechanism is assembled there
    #[arg(long, value_name = "T0", default_value = "0", value_parser = time, allow_hyphen_values = true)]
    pub from: f64,
    /// End of the motion, in s
    #[arg(long, value_name = "T1", default_value = "5", value_parser = time, allow_hyphen_values = true)]
    pub to: f64,
    /// Time between frames, in s; the last frame is the last whole step up to T1
    #[arg(long, value_name = "H", default_value = "0.01", value_parser = step, allow_hyphen_values = true)]
    pub step: f64,
    /// Value of a parameter, about which its tolerance then lies, or motion of an input as an expression of t; may be
    /// repeated
    #[arg(long, value_name = "NAME=VALUE", allow_hyphen_values = true)]
    pub set: Vec<String>,
    /// Folder for the pictures: each measure over time, with its worst case and the band of sampled mechanisms
    #[arg(long, value_name = "DIR")]
    pub plot: Option<PathBuf>,
    /// Print one JSON object, with the spread at every instant
    #[arg(long)]
    pub json: bool,
    /// Number of threads [default: as many as the machine has]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
    /// Replace files that this command has not written
    #[arg(long)]
    pub force: bool,
}

/// Sequences of samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SampleSequence {
    /// Sobol's sequence, scrambled by the seed: more even than random numbers
    Sobol,
    /// Independent random numbers
    Random,
}

const TOLERANCE_EXAMPLES: &str = "\
Examples:
  linkwright tolerance press.mech                           worst case, standard deviation and 10000 mechanisms
  linkwright tolerance press.mech --samples 0               the first order alone
  linkwright tolerance press.mech --plot pictures --to 2    a picture of each measure
  linkwright tolerance press.mech --set rod=130mm --json    about another value, all numbers

The first order is not enough where the mean or the standard deviation of the sampled mechanisms
differs from it by more than four standard errors and one percent of the largest standard deviation.

Ctrl-C ends the sampling with the mechanisms so far; a second one ends the command.

Exit codes: 0 done, also if sampled mechanisms fail, 1 the mechanism cannot be solved, 2 bad input.";
