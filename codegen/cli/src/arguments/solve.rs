//! What `linkwright solve` is asked.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::values::{step, time};

/// Solves the motion of a mechanism without a compile step.
///
/// The mechanism is assembled at the start in the mode in which each of its loops is drawn, and advanced step by step, so that
/// it stays in this mode. All quantities are in m, rad and s.
///
/// It runs the same blocks as a generated module, so that it takes the same path and fails with the same words.
#[derive(Args, Debug)]
#[command(after_help = SOLVE_EXAMPLES)]
pub struct Solve {
    /// The description, a `.mech` file; `-` is stdin
    pub file: PathBuf,
    /// Which motion, where the mechanism has several
    #[arg(long, value_name = "NAME")]
    pub motion: Option<String>,
    /// When the motion starts, in s; the mechanism is assembled there
    #[arg(long, value_name = "T0", default_value = "0", value_parser = time, allow_hyphen_values = true)]
    pub from: f64,
    /// When the motion ends, in s
    #[arg(long, value_name = "T1", default_value = "5", value_parser = time, allow_hyphen_values = true)]
    pub to: f64,
    /// The time between frames, in s; the last frame is the last whole step up to T1
    #[arg(long, value_name = "H", default_value = "0.01", value_parser = step, allow_hyphen_values = true)]
    pub step: f64,
    /// Only this instant, in s, followed from T0 by steps of H; may be repeated. Files are then written only on request
    #[arg(long, value_name = "T", value_delimiter = ',', value_parser = time, allow_hyphen_values = true, conflicts_with_all = ["to", "plot"])]
    pub at: Vec<f64>,
    /// Another value of a parameter, or the motion of an input as an expression of t, in SI units or with a unit; may be repeated
    #[arg(long, value_name = "NAME=VALUE", allow_hyphen_values = true)]
    pub set: Vec<String>,
    /// The assembly mode of a loop: `positive` or `negative`, `other` than drawn, or of a loop without a closed form the letter of a
    /// pose that `check` lists; may be repeated. A wrong name lists the loops
    #[arg(long, value_name = "LOOP=MODE")]
    pub branch: Vec<String>,
    /// Only these points, separated by commas, `3.P` for the point P of body 3 [default: all, with tables of six]
    #[arg(long, value_name = "A,3.P", value_delimiter = ',')]
    pub points: Vec<String>,
    /// Only these coordinates, separated by commas, with their rates and accelerations [default: a table of all angles]
    #[arg(long, value_name = "phi1,x2", value_delimiter = ',')]
    pub show: Vec<String>,
    /// How angles are printed and drawn; files of numbers hold rad
    #[arg(long, value_enum, default_value_t = TurnUnit::Rad)]
    pub angles: TurnUnit,
    /// Print the first Newton-Raphson step from the drawing: Φ_q, -Φ and what they give
    #[arg(long, conflicts_with = "json")]
    pub first_step: bool,
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
    /// Which equations are solved
    #[arg(long, value_enum, default_value_t = Equations::Blocks, conflicts_with_all = ["branch", "monitor"])]
    pub view: Equations,
    /// Efforts and reactions of a mechanism that rests at every instant: its rates and accelerations count as zero for them
    #[arg(long = "static")]
    pub at_rest: bool,
    /// Add columns to the frames that say how close each block is to a singular pose, from 0, singular, to 1, and the smallest
    /// value to the summary; `linkwright check` locates it between frames
    #[arg(long, conflicts_with = "json")]
    pub monitor: bool,
}

/// A unit of angles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum TurnUnit {
    /// Radians
    Rad,
    /// Degrees
    Deg,
}

/// Which equations are solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Equations {
    /// Block by block, as a generated module does
    Blocks,
    /// All together as one dense system, by Newton-Raphson, from the drawing as it is
    Textbook,
}

const SOLVE_EXAMPLES: &str = "\
Examples:
  linkwright solve mechanisms/excavator.mech                        summary, CSV and plots of five seconds
  linkwright solve mechanisms/excavator.mech --at 2.5 --points K    one instant of one point
  linkwright solve mechanisms/two_body.mech --show phi2 --angles deg --at 500ms
  linkwright solve mechanisms/two_body.mech --first-step --no-files
  linkwright solve mechanisms/two_body.mech --csv - > motion.csv
  linkwright solve lift.mech --set L2=360mm --set 'lift=0.5 + 0.1*sin(2*t)'
  linkwright solve mechanisms/two_body.mech --branch phi2=other     the mirror image of what is drawn
  linkwright solve mechanisms/two_body.mech --json | jq '.frames[-1].points.Q'
  linkwright solve mechanisms/excavator.mech --step 5e-6 --no-files a million frames, checked and not kept

Exit codes: 0 solved, 1 the mechanism cannot be assembled or its motion ends early, 2 bad input.
Frames before the end of a motion that ends early are printed and written all the same.";
