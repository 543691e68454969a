//! Defines the argument that selects the units of a report.

use clap::Args;
use linkwright_codegen::stages::units::OutputUnits;

/// Units of the report.
#[derive(Args, Debug)]
pub struct ReportedIn {
    /// Units of tables, files, pictures and messages [default: those of the statement `units`; without it SI units in
    /// tables and files, and in messages and pages the units used most in the description]
    #[arg(long, value_name = "mm,deg", require_equals = true, value_parser = units)]
    pub units: Option<OutputUnits>,
}

/// Reads a list of units, `mm,deg`.
pub fn units(text: &str) -> Result<OutputUnits, String> {
    OutputUnits::listed(text).map_err(|[message, help]| format!("{message}: {help}"))
}

/// Reads a list of units; an empty list stands for units named in headers.
pub fn units_or_names(text: &str) -> Result<OutputUnits, String> {
    match text {
        "" => Ok(OutputUnits::default()),
        list => units(list),
    }
}
