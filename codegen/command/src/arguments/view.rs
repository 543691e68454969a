//! Defines the arguments of `linkwright view`.

use std::path::PathBuf;

use clap::Args;

use super::described::Described;
use super::setting::Setting;
use super::units::ReportedIn;
use super::values::{step, time};

/// Makes one HTML file that shows the mechanism in motion, its equations, their solution block by block, its singular
/// poses, its assemblies and its curves.
///
/// The file is self-contained: it needs neither network nor other files. Pointing at an equation, a curve or a body
/// highlights the related items. The page prints as a worked solution.
#[derive(Args, Debug)]
#[command(after_help = VIEW_EXAMPLES)]
pub struct View {
    /// The description.
    #[command(flatten)]
    pub described: Described,
    /// Units of the report.
    #[command(flatten)]
    pub reported_in: ReportedIn,
    /// Output file of the page; `-` is stdout [default: NAME.html]
    #[arg(short, long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Start of the motion, in s or with a unit; the mechanism is assembled there
    #[arg(long, value_name = "T0", default_value = "0", value_parser = time, allow_hyphen_values = true)]
    pub from: f64,
    /// End of the motion, in s
    #[arg(long, value_name = "T1", default_value = "5", value_parser = time, allow_hyphen_values = true)]
    pub to: f64,
    /// Time between frames, in s, and that of the first Newton-Raphson step
    #[arg(long, value_name = "H", default_value = "0.01", value_parser = step, allow_hyphen_values = true)]
    pub step: f64,
    /// Departures from the description.
    #[command(flatten)]
    pub setting: Setting,
    /// Write a page that solves the mechanism itself: sliders change parameters and inputs, and the description can be edited. It needs
    /// no network; the file has two megabytes
    #[arg(long, conflicts_with = "watch")]
    pub live: bool,
    /// Replace a file that is not a page of this command
    #[arg(long)]
    pub force: bool,
    /// Serve the page to this machine without writing a file. The page is reloaded when the description is saved, and
    /// shows its errors
    #[arg(long, conflicts_with_all = ["out", "force"])]
    pub watch: bool,
    /// Port of the page; 0 takes a free one
    #[arg(long, value_name = "PORT", default_value = "7341", requires = "watch")]
    pub port: u16,
}

const VIEW_EXAMPLES: &str = "\
Examples:
  linkwright view mechanisms/two_body.mech                          two_body.html, five seconds
  linkwright view mechanisms/jansen.mech --to 2.1 --out walk.html
  linkwright view lift.mech --set L2=360mm --set 'lift=0.5 + 0.1*sin(2*t)'
  linkwright view mechanisms/four_bar.mech --live -o live.html      a hand-out: change a length, and see
  linkwright view mechanisms/four_bar.mech --watch                  edit, save, see

Exit codes: 0 written, 1 the mechanism cannot be assembled or its motion ends early, which the page reports, 2 bad input.";
