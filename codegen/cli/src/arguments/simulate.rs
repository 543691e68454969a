//! What `linkwright simulate` is asked.

use std::path::PathBuf;

use clap::Args;

use super::solve::{Equations, Solve, TurnUnit};
use super::values::{step, time, tolerance};

/// Integrates the motion that forces give a mechanism with `free` coordinates, from where its description says that it starts.
///
/// Only the free coordinates and their rates are integrated, by a method of order 8 with steps of its own (DOP853); everything else
/// follows from them by the blocks that a generated module runs, so that every frame lies on the constraints to rounding. Frames
/// between the steps are those of its dense output.
#[derive(Args, Debug)]
#[command(after_help = SIMULATE_EXAMPLES)]
pub struct Simulate {
    /// The description, a `.mech` file with at least one `free` statement
    pub file: PathBuf,
    /// Which motion, where the mechanism has several
    #[arg(long, value_name = "NAME")]
    pub motion: Option<String>,
    /// When the motion ends, in s; it starts at 0
    #[arg(long, value_name = "T", default_value = "5", value_parser = time, allow_hyphen_values = true)]
    pub to: f64,
    /// The time between frames, in s; the steps of the integration do not depend on it
    #[arg(long, value_name = "H", default_value = "0.01", value_parser = step, allow_hyphen_values = true)]
    pub step: f64,
    /// The error of a step that is allowed, relative to each free coordinate and to each of their rates
    #[arg(long, value_name = "R", default_value = "1e-10", value_parser = tolerance, allow_hyphen_values = true)]
    pub rtol: f64,
    /// What is allowed besides, in m or rad, and m/s or rad/s
    #[arg(long, value_name = "A", default_value = "1e-12", value_parser = tolerance, allow_hyphen_values = true)]
    pub atol: f64,
    /// Go straight on through poses in which several loops are singular at once, where the motion otherwise ends
    #[arg(long)]
    pub through_singular: bool,
    /// Another value of a parameter, the motion of an input as an expression of t, or of a free coordinate the start: `swing=0.3 + 1.5*t`
    /// begins at 0.3 with the rate 1.5; may be repeated
    #[arg(long, value_name = "NAME=VALUE", allow_hyphen_values = true)]
    pub set: Vec<String>,
    /// The assembly mode of a loop, as `solve` takes it; may be repeated
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

impl Simulate {
    /// What is reported and written of the motion, as of one that is solved.
    pub fn reported(&self) -> Solve {
        Solve {
            file: self.file.clone(),
            motion: self.motion.clone(),
            from: 0.0,
            to: self.to,
            step: self.step,
            at: Vec::new(),
            set: self.set.clone(),
            branch: self.branch.clone(),
            points: self.points.clone(),
            show: self.show.clone(),
            angles: self.angles,
            first_step: false,
            out: self.out.clone(),
            csv: self.csv.clone(),
            units: self.units,
            plot: self.plot.clone(),
            force: self.force,
            no_files: self.no_files,
            json: self.json,
            view: Equations::Blocks,
            at_rest: false,
            monitor: false,
        }
    }
}

const SIMULATE_EXAMPLES: &str = "\
Examples:
  linkwright simulate pendulum.mech --to 20                           summary, CSV and plots of twenty seconds
  linkwright simulate pendulum.mech --set swing=170deg --show phi1    from another start
  linkwright simulate pendulum.mech --rtol 1e-12 --csv - > motion.csv
  linkwright simulate pendulum.mech --json | jq '.simulation'         evaluations, steps, drift of the energy

Exit codes: 0 simulated, 1 the mechanism cannot be assembled or its motion ends early, 2 bad input.
Frames before the end of a motion that ends early are printed and written all the same.";
