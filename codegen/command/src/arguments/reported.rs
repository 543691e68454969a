//! What is printed and written of a motion.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

/// What is printed and written of a motion.
#[derive(Args, Debug)]
pub struct Reported {
    /// Only these points, separated by commas, `3.P` for the point P of body 3 [default: all, with tables of six]
    #[arg(long, value_name = "A,3.P", value_delimiter = ',')]
    pub points: Vec<String>,
    /// Only these coordinates and points, separated by commas, with their rates and accelerations, as the description writes them,
    /// `phi(2)`, or the frames, `phi2`, `K_x`, `1.K` [default: a table of all angles]
    #[arg(long, value_name = "phi(1),x2,K", value_delimiter = ',')]
    pub show: Vec<String>,
    /// How angles are printed and drawn; files of numbers hold rad
    #[arg(long, value_enum, default_value_t = TurnUnit::Rad)]
    pub angles: TurnUnit,
    /// The folder for the frames and the plots [default: target/linkwright/NAME where there is a Cargo.toml, else NAME]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Where to write the frames; `-` is stdout, and the summary then goes to stderr [default: motion.csv in the folder]
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// Write units into the header of the frames: `phi1_d (rad/s)`
    #[arg(long)]
    pub units: bool,
    /// The folder for the plots: an SVG for each point that moves and each chosen coordinate, and the paths of the points
    #[arg(long, value_name = "DIR")]
    pub plot: Option<PathBuf>,
    /// Replace files that are not what this command has written
    #[arg(long)]
    pub force: bool,
    /// Write no files but those that are asked for
    #[arg(long)]
    pub no_files: bool,
    /// Print one JSON object instead of the summary; files are then written only on request
    #[arg(long)]
    pub json: bool,
}

/// A unit of angles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum TurnUnit {
    /// Radians
    Rad,
    /// Degrees
    Deg,
}
