//! Defines the arguments of `linkwright compare` and `linkwright calibrate`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use linkwright_codegen::stages::columns::{Decimal, Delimiter, Known};
use linkwright_solver::data::{ArgumentNames, Reading};

use super::described::Described;
use super::setting::Setting;
use super::units::ReportedIn;
use super::values::{step, time};

/// Table of measured values, with its dialect.
#[derive(Args, Debug)]
pub struct Table {
    /// Table: CSV and the like, from ADAMS, MATLAB, a spreadsheet or a data logger
    #[arg(value_name = "DATA")]
    pub data: PathBuf,
    /// Quantity of a column, `COLUMN=QUANTITY`: `phi2`, `phi2_d`, `phi2_dd`, `K_x`, `K_vx`, `K_ax` [default: by its
    /// name]
    #[arg(long, value_name = "COLUMN=QUANTITY", value_delimiter = ',')]
    pub column: Vec<String>,
    /// Leave out these columns
    #[arg(long, value_name = "COLUMN", value_delimiter = ',')]
    pub skip: Vec<String>,
    /// Column of times [default: the one named t or time]
    #[arg(long, value_name = "COLUMN")]
    pub time: Option<String>,
    /// Time added to all times of the table, in s or with a unit
    #[arg(long, value_name = "T", default_value = "0", value_parser = time, allow_hyphen_values = true)]
    pub shift: f64,
    /// Unit of a column, `K_x=mm`, or of all columns without one in the header, `mm`, `deg` [default: SI]
    #[arg(long, value_name = "[COLUMN=]UNIT", value_delimiter = ',')]
    pub unit: Vec<String>,
    /// Separator of cells [default: the one that gives a table of numbers]
    #[arg(long, value_enum)]
    pub delimiter: Option<Separator>,
    /// Decimal mark [default: the one that gives a table of numbers]
    #[arg(long, value_enum)]
    pub decimal: Option<Mark>,
}

impl Table {
    /// Returns the requested reading of a table, which may do without times if `needs_times` is false.
    pub fn reading(&self, needs_times: bool) -> Reading {
        Reading {
            column: self.column.clone(),
            skip: self.skip.clone(),
            time: self.time.clone(),
            needs_times,
            shift: self.shift,
            unit: self.unit.clone(),
            dialect: Known {
                delimiter: self.delimiter.map(|it| match it {
                    Separator::Comma => Delimiter::Comma,
                    Separator::Semicolon => Delimiter::Semicolon,
                    Separator::Tab => Delimiter::Tab,
                    Separator::Bar => Delimiter::Bar,
                    Separator::Spaces => Delimiter::Spaces,
                }),
                decimal: self.decimal.map(|it| match it {
                    Mark::Point => Decimal::Point,
                    Mark::Comma => Decimal::Comma,
                }),
                may_be_single: !needs_times,
            },
            names: ArgumentNames {
                column: "--column",
                quantity: "--column COLUMN=QUANTITY",
                unit: "--unit",
                skip: "--skip",
                time: "--time",
            },
        }
    }
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

/// Compares measured values with the motion: prints the root mean square of the differences of every column, the
/// largest one, and its time.
///
/// The motion is solved at the times of the table. The dialect of the file and the quantity and unit of each column
/// are printed; angles are compared up to whole turns.
#[derive(Args, Debug)]
#[command(after_help = COMPARE_EXAMPLES)]
pub struct Compare {
    /// The description.
    #[command(flatten)]
    pub described: Described,
    /// Units of the report.
    #[command(flatten)]
    pub reported_in: ReportedIn,
    /// Measured values.
    #[command(flatten)]
    pub table: Table,
    /// Time at which the mechanism is assembled, in s [default: the first time of the table]
    #[arg(long, value_name = "T0", value_parser = time, allow_hyphen_values = true)]
    pub from: Option<f64>,
    /// Largest time between frames, in s
    #[arg(long, value_name = "H", default_value = "0.01", value_parser = step, allow_hyphen_values = true)]
    pub step: f64,
    /// Departures from the description.
    #[command(flatten)]
    pub setting: Setting,
    /// Tolerance of differences: `1e-6` of every column in SI units, `0.5mm` of those in this unit, `K_x=2mm` of one
    #[arg(long, value_name = "[COLUMN=]VALUE[UNIT]", value_delimiter = ',')]
    pub tolerance: Vec<String>,
    /// Folder for the plots: an SVG for each column, with both curves and their difference
    #[arg(long, value_name = "DIR")]
    pub plot: Option<PathBuf>,
    /// Replace files that this command has not written
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

/// Fits parameters to measured motion: least squares with the derived sensitivities.
///
/// Prints each parameter with its standard deviation and 95 % interval, their correlations, and the residuals of each
/// column before and after. Names the parameters that this motion cannot distinguish. Columns of accelerations and
/// forces are ignored. Quantities of several units are weighted by their residuals, unless `--deviation` gives their
/// accuracy.
#[derive(Args, Debug)]
#[command(after_help = CALIBRATE_EXAMPLES)]
pub struct Calibrate {
    /// The description.
    #[command(flatten)]
    pub described: Described,
    /// Units of the report.
    #[command(flatten)]
    pub reported_in: ReportedIn,
    /// Measured values.
    #[command(flatten)]
    pub table: Table,
    /// Parameters to fit, separated by commas, from their values in the description or of `--set`
    #[arg(long, value_name = "L1,L2", value_delimiter = ',')]
    pub param: Vec<String>,
    /// Largest time between frames, in s
    #[arg(long, value_name = "H", default_value = "0.01", value_parser = step, allow_hyphen_values = true)]
    pub step: f64,
    /// Departures from the description.
    #[command(flatten)]
    pub setting: Setting,
    /// Standard deviation of measured values: `0.1mm` of columns in this unit, `K_x=2mm` of one [default: that of the
    /// residuals]
    #[arg(long, value_name = "[COLUMN=]VALUE[UNIT]", value_delimiter = ',')]
    pub deviation: Vec<String>,
    /// Folder for the plots: an SVG for each column, with both curves and the residuals
    #[arg(long, value_name = "DIR")]
    pub plot: Option<PathBuf>,
    /// Bounds of a parameter, `L2=1mm..2mm`, `L2=0..` or `L2=..` within its range [default: its range; without one, lengths keep their signs]
    #[arg(
        long,
        value_name = "PARAMETER=LOW..HIGH",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    pub bound: Vec<String>,
    /// Write the description with the new values into this file; the rest of the text stays
    #[arg(short, long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Replace existing files, and write the description even if the fit is not to be trusted
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

Fitted values are `param` statements of the description. A parameter that the motion does not determine keeps its value. If the
fit is not to be trusted, nothing is written without `--force`.

Exit codes: 0 fitted, 1 the fit is not to be trusted (a parameter is undetermined or at its bound, or the residuals exceed the noise), or the
mechanism does not move through all times of the table, 2 bad input.";
