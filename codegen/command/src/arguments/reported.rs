//! Defines the arguments that select what a command prints and writes of a motion.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use linkwright_codegen::stages::units::OutputUnits;

use super::units::units_or_names;

/// Printed and written results of a motion.
#[derive(Args, Debug)]
pub struct Reported {
    /// Only these points, separated by commas, `3.P` for the point P of body 3 [default: all, with tables of six]
    #[arg(long, value_name = "A,3.P", value_delimiter = ',')]
    pub points: Vec<String>,
    /// Only these coordinates and points, separated by commas, with their rates and accelerations, as the description writes them,
    /// `phi(2)`, or the frames, `phi2`, `K_x`, `1.K` [default: a table of all angles]
    #[arg(long, value_name = "phi(1),x2,K", value_delimiter = ',')]
    pub show: Vec<String>,
    /// Unit of angles in text and pictures; files of numbers keep theirs [default: that of `--units`, else rad]
    #[arg(long, value_enum)]
    pub angles: Option<TurnUnit>,
    /// Folder for the frames and the plots [default: target/linkwright/NAME beside a Cargo.toml, else NAME]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Output file of the frames; `-` is stdout, and the summary then goes to stderr [default: motion.csv in the
    /// folder]
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// Units of tables, files, pictures and messages, as `--units=mm,deg`; headers name them. Without a list headers
    /// name the units in use: `phi1_d (rad/s)` [default: those of the statement `units`, else SI units]
    #[arg(long, value_name = "mm,deg", num_args = 0..=1, require_equals = true, default_missing_value = "", value_parser = units_or_names)]
    pub units: Option<OutputUnits>,
    /// Folder for the plots: an SVG for each moving point and each chosen coordinate, and the paths of the points
    #[arg(long, value_name = "DIR")]
    pub plot: Option<PathBuf>,
    /// Plot one column of the frames against another, as `X,Y`: `stroke,torque`, `K_x,K_vy`; may be repeated
    #[arg(long, value_name = "X,Y", value_parser = pair)]
    pub curve: Vec<[String; 2]>,
    /// Replace files that this command has not written
    #[arg(long)]
    pub force: bool,
    /// Write only the files that are requested
    #[arg(long)]
    pub no_files: bool,
    /// Print one JSON object instead of the summary; files are then written only on request
    #[arg(long)]
    pub json: bool,
}

impl Reported {
    /// Returns the requested units; `None` if only their names in headers are requested, or nothing is.
    pub fn units(&self) -> Option<OutputUnits> {
        let requested = self.units.clone();
        requested.filter(|it| *it != OutputUnits::default())
    }

    /// Returns the units of printed text and pictures; `units` are those of files of numbers.
    pub fn printed(&self, units: OutputUnits) -> OutputUnits {
        match self.angles {
            None => units,
            Some(TurnUnit::Rad) => units.with_angles_in("rad"),
            Some(TurnUnit::Deg) => units.with_angles_in("deg"),
        }
    }
}

/// Unit of angles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum TurnUnit {
    /// Radians
    Rad,
    /// Degrees
    Deg,
}

/// Reads two names of columns.
fn pair(text: &str) -> Result<[String; 2], String> {
    let names: Vec<&str> = text.split(',').map(str::trim).collect();
    match names[..] {
        [x, y] if !x.is_empty() && !y.is_empty() => Ok([x.to_string(), y.to_string()]),
        _ => Err("write two columns, as in `stroke,torque`".to_string()),
    }
}
