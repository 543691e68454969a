//! Defines the arguments of `linkwright compare` and `linkwright calibrate`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::described::Described;
use super::setting::Setting;
use super::units::ReportedIn;
use super::values::{step, time};

/// A table of measured values, and how it is read.
#[derive(Args, Debug)]
pub struct Table {
    /// The table: CSV and the like, from ADAMS, MATLAB, a spreadsheet or a data logger
    #[arg(value_name = "DATA")]
    pub data: PathBuf,
    /// What a column measures, `COLUMN=QUANTITY`: `phi2`, `phi2_d`, `phi2_dd`, `K_x`, `K_vx`, `K_ax` [default: by its name]
    #[arg(long, value_name = "COLUMN=QUANTITY", value_delimiter = ',')]
    pub column: Vec<String>,
    /// Leave out these columns
    #[arg(long, value_name = "COLUMN", value_delimiter = ',')]
    pub skip: Vec<String>,
    /// The column of times [default: the one that is called t or time]
    #[arg(long, value_name = "COLUMN")]
    pub time: Option<String>,
    /// What is added to all times of the table, in s or with a unit
    #[arg(long, value_name = "T", default_value = "0", value_parser = time, allow_hyphen_values = true)]
    pub shift: f64,
    /// The unit of a column, `K_x=mm`, or of all columns that have none in the header, `mm`, `deg` [default: SI]
    #[arg(long, value_name = "[COLUMN=]UNIT", value_delimiter = ',')]
    pub unit: Vec<String>,
    /// What separates cells [default: what makes a table of numbers]
    #[arg(long, value_enum)]
    pub delimiter: Option<Separator>,
    /// What separates decimals [default: what makes a table of numbers]
    #[arg(long, value_enum)]
    pub decimal: Option<Mark>,
}

/// Separator of cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Separator {
    /// `,`
    Comma,
    /// `;`
    Semicolon,
    /// A tab
    Tab,
    /// `|`
    Bar,
    /// Spaces or tabs, as many as there are
    Spaces,
}

/// Decimal separator.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Mark {
    /// `0.5`
    Point,
    /// `0,5`
    Comma,
}

/// Holds measured values against the motion: for every column the root of the mean square of the differences, the largest one, and
/// when.
///
/// The motion is solved at the very times of the table. How the file was read, what each column was taken for and in which unit is
/// printed; angles are compared up to whole turns.
#[derive(Args, Debug)]
#[command(after_help = COMPARE_EXAMPLES)]
pub struct Compare {
    /// The description.
    #[command(flatten)]
    pub described: Described,
    /// Units of what is reported.
    #[command(flatten)]
    pub reported_in: ReportedIn,
    /// The measured values.
    #[command(flatten)]
    pub table: Table,
    /// When the mechanism is assembled, in s [default: the first time of the table]
    #[arg(long, value_name = "T0", value_parser = time, allow_hyphen_values = true)]
    pub from: Option<f64>,
    /// The largest time between frames, in s
    #[arg(long, value_name = "H", default_value = "0.01", value_parser = step, allow_hyphen_values = true)]
    pub step: f64,
    /// Where the motion departs from it.
    #[command(flatten)]
    pub setting: Setting,
    /// How large differences may be: `1e-6` of every column in SI units, `0.5mm` of those in this unit, `K_x=2mm` of one
    #[arg(long, value_name = "[COLUMN=]VALUE[UNIT]", value_delimiter = ',')]
    pub tolerance: Vec<String>,
    /// The folder for the plots: an SVG for each column, with both curves and their difference
    #[arg(long, value_name = "DIR")]
    pub plot: Option<PathBuf>,
    /// Replace files that are not what this command has written
    #[arg(long)]
    pub force: bool,
    /// Print one JSON object instead of text
    #[arg(long)]
    pub json: bool,
}

const COMPARE_EXAMPLES: &str = "\
Examples:
  linkwright compare mechanisms/arm.mech arm_adams.csv --tolerance 6e-7
  linkwright compare lift.mech log.csv --column 'Sensor 3=phi_rocker' --unit deg --plot pictures
  linkwright compare lift.mech log.txt --time 1 --column 2=K_x --unit mm --tolerance 0.5mm
  linkwright compare lift.mech export.csv --json | jq '.columns[].rms'

A header may hold units, `K_x (mm)`. Columns without a name are called by their numbers, 1, 2, …

Exit codes: 0 compared, 1 a difference is beyond its tolerance, or the mechanism cannot be assembled or its motion ends before the
table does, 2 bad input.";

/// Fits parameters so that the mechanism moves as measured: least squares with the derived sensitivities.
///
/// Prints each parameter with its standard deviation and 95 % interval, their correlations, what is left of each column before and after, and which
/// parameters this motion cannot tell apart. Columns of accelerations and forces take no part. Where quantities of several units are
/// measured, each counts by what is left of it, unless `--deviation` says how well it is measured.
#[derive(Args, Debug)]
#[command(after_help = CALIBRATE_EXAMPLES)]
pub struct Calibrate {
    /// The description.
    #[command(flatten)]
    pub described: Described,
    /// Units of what is reported.
    #[command(flatten)]
    pub reported_in: ReportedIn,
    /// The measured values.
    #[command(flatten)]
    pub table: Table,
    /// The parameters that are fitted, separated by commas, from their values in the description or of `--set`
    #[arg(long, value_name = "L1,L2", value_delimiter = ',')]
    pub param: Vec<String>,
    /// The largest time between frames, in s
    #[arg(long, value_name = "H", default_value = "0.01", value_parser = step, allow_hyphen_values = true)]
    pub step: f64,
    /// Where the motion departs from it.
    #[command(flatten)]
    pub setting: Setting,
    /// The standard deviation of measured values: `0.1mm` of columns in this unit, `K_x=2mm` of one [default: what is left of them]
    #[arg(long, value_name = "[COLUMN=]VALUE[UNIT]", value_delimiter = ',')]
    pub deviation: Vec<String>,
    /// The folder for the plots: an SVG for each column, with both curves and what is left
    #[arg(long, value_name = "DIR")]
    pub plot: Option<PathBuf>,
    /// The values that a parameter may have, `L2=1mm..2mm`, `L2=0..` or `L2=..` [default: lengths keep their signs]
    #[arg(
        long,
        value_name = "PARAMETER=LOW..HIGH",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    pub bound: Vec<String>,
    /// Write the description with the new values into this file; all else in it stays as it is
    #[arg(short, long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Write files also where they exist, and the description also where the fit is not to be trusted
    #[arg(long)]
    pub force: bool,
    /// Print one JSON object instead of text
    #[arg(long)]
    pub json: bool,
}

const CALIBRATE_EXAMPLES: &str = "\
Examples:
  linkwright calibrate lift.mech log.csv --param L2,L3,L4
  linkwright calibrate lift.mech log.csv --param L2,L3 --deviation 0.1mm,0.05deg --out fitted.mech
  linkwright calibrate lift.mech log.csv --param L2,L3 --json | jq '.parameters[].value'

What is to be fitted is a `param` of the description. A parameter that the motion does not determine keeps its value. Nothing is written
where the fit is not to be trusted, unless `--force` says so.

Exit codes: 0 fitted, 1 the fit is not to be trusted (a parameter is undetermined or at its bound, or more is left than noise), or the
mechanism does not move through all times of the table, 2 bad input.";
