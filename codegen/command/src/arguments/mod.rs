//! Parses the command line into typed arguments. Numbers are finite and steps positive afterwards; files are not opened.

mod described;
mod equilibrium;
mod measured;
mod reported;
mod setting;
mod shell;
mod simulate;
mod solve;
mod sweep;
mod synthesize;
mod tolerance;
mod travel;
mod units;
mod values;
mod view;

pub use described::Described;
pub use equilibrium::Equilibrium;
pub use measured::{Calibrate, Compare, Mark, Separator, Table};
pub use reported::{Reported, TurnUnit};
pub use setting::Setting;
pub use shell::{Completions, Fmt, Lsp, Man, New};
pub use simulate::{Simulate, StepMethod};
pub use solve::{Formulation, Solve};
pub use sweep::Sweep;
pub use synthesize::Synthesize;
pub use tolerance::{SampleSequence, Tolerance};
pub use travel::Travel;
pub use units::{ReportedIn, units};
pub use view::View;

use std::path::PathBuf;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum};
use linkwright_codegen::Language;
use linkwright_codegen::stages::emit::Conventions;

use values::{size, step, time};

/// Reads descriptions of planar mechanisms: solves and draws them, shows their equations, derives their solution, and
/// writes them as Rust.
#[derive(Parser, Debug)]
#[command(name = "linkwright", after_help = EXAMPLES, arg_required_else_help = true, args_conflicts_with_subcommands = true)]
pub struct Arguments {
    /// Print the licenses of the fonts and packages in this command
    #[arg(long, exclusive = true)]
    pub licenses: bool,
    /// Command; `None` if licenses are to be printed.
    #[command(subcommand)]
    pub command: Option<Command>,
}

const EXAMPLES: &str = "\
Examples:
  linkwright solve mechanisms/excavator.mech
  linkwright solve mechanisms/two_body.mech --to 1 --step 0.1 --points Q
  linkwright sweep lift.mech --vary rod=100mm..200mm:101 --show phi_rocker
  linkwright tolerance press.mech --plot pictures
  linkwright draw mechanisms/excavator.mech
  linkwright view mechanisms/excavator.mech
  linkwright inspect mechanisms/two_body.mech --format unicode
  linkwright plan mechanisms/excavator.mech
  linkwright check mechanisms/two_body.mech
  linkwright travel mechanisms/two_body.mech --drive 'phi(1)'
  linkwright equilibrium lamp.mech --path load=0N..20N
  linkwright compare mechanisms/arm.mech measured.csv
  linkwright synthesize lift.mech path.csv --param L2,L3=20mm..200mm
  linkwright generate mechanisms/two_body.mech -o two_body.rs
  linkwright fmt mechanisms --check
  linkwright new walker

A description called `-` is read from stdin; its tables lie in the current folder.

Exit codes: 0 done, 1 the mechanism cannot be solved (or `generate --check` or `fmt --check` found a
difference, `check --deny-warnings` a warning, `compare` a difference beyond its
tolerance), 2 bad input, 70 an error of linkwright itself.";

/// Commands.
#[derive(Subcommand, Debug)]
pub enum Command {
    /// Solve the motion: print it, write CSV and plots
    Solve(Solve),
    /// Simulate the motion under forces: print it, write CSV and plots
    Simulate(Simulate),
    /// Solve the motion for many sets of parameters and inputs
    Sweep(Sweep),
    /// Add up tolerances of parameters: the spread of measures along the motion
    Tolerance(Tolerance),
    /// Draw the mechanism as an SVG, a PNG or a DXF, or its motion as an SVG or a GIF
    Draw(Draw),
    /// Make a page that moves the mechanism and shows its equations
    View(View),
    /// Write the mechanism as a Rust module, or as C99
    Generate(Generate),
    /// Show Φ, Φ_q, Φ_t and γ, and the blocks of the generated code
    Inspect(Inspect),
    /// Derive the solution block by block, in words and formulas
    Plan(Plan),
    /// List the assemblies and locate the poses closest to singular
    Check(Check),
    /// Find how far a drive can go each way, and what ends its travel
    Travel(Travel),
    /// Find the equilibria of free coordinates, and follow one over a parameter
    Equilibrium(Equilibrium),
    /// Compare measured data with the motion
    Compare(Compare),
    /// Fit parameters to measured data
    Calibrate(Calibrate),
    /// Choose parameters for which the motion meets a table of targets
    Synthesize(Synthesize),
    /// Format descriptions
    Fmt(Fmt),
    /// Write a crate with a mechanism, a loop and a test as a start
    New(New),
    /// Serve an editor: findings while typing, hover, definitions, completion, renaming
    Lsp(Lsp),
    /// Print a script that completes arguments in a shell
    Completions(Completions),
    /// Write manual pages
    Man(Man),
}

/// Draws the mechanism in one pose as a mechanical engineer does: bodies by their points, supports and guides
/// hatched, driven joints with an arrow.
///
/// The pose is solved by the blocks of a generated module. A mechanism whose equations do not determine its motion is
/// drawn with `--initial-estimate`, in the estimates of its description.
///
/// A DXF is in mm and at full scale. It has the distances between the points of each link as dimensions, and layers for
/// the ground, each body, pins, center lines, dimensions and names.
#[derive(Args, Debug)]
#[command(after_help = DRAW_EXAMPLES)]
pub struct Draw {
    /// The description.
    #[command(flatten)]
    pub described: Described,
    /// Units of the report.
    #[command(flatten)]
    pub reported_in: ReportedIn,
    /// File of the picture, `.svg`, `.png` or `.dxf`, with `--animate` `.svg` or `.gif`; `-` is stdout [default: NAME.svg,
    /// with `--links` NAME_links.svg, with `--animate` NAME_animated.svg]
    #[arg(short, long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Write a PNG under any file name [default file: NAME.png]
    #[arg(long)]
    pub png: bool,
    /// Draw the motion from T0 to T1, in real time and repeated: an `.svg` that moves in a browser, or a `.gif`
    #[arg(long, conflicts_with_all = ["at", "initial_estimate", "png"])]
    pub animate: bool,
    /// Show the distances between the points of each link; a DXF always does
    #[arg(long, conflicts_with = "animate")]
    pub dimensions: bool,
    /// Draw each link alone, with the distances between its points
    #[arg(long, conflicts_with_all = ["animate", "paths", "frame", "size"])]
    pub links: bool,
    /// Instant to draw, in s, followed from T0 by steps of H [default: T0]
    #[arg(long, value_name = "T", value_parser = time, allow_hyphen_values = true)]
    pub at: Option<f64>,
    /// Draw the estimates of the description instead of a solved pose
    #[arg(long, conflicts_with_all = ["at", "branch", "paths", "set"])]
    pub initial_estimate: bool,
    /// Draw the paths of these points from T0 to T1, with ticks at equal times
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    pub paths: Vec<String>,
    /// Start of the motion, in s or with a unit, `500ms`; the mechanism is assembled there
    #[arg(long, value_name = "T0", default_value = "0", value_parser = time, allow_hyphen_values = true)]
    pub from: f64,
    /// End of the paths and the animation, in s
    #[arg(long, value_name = "T1", default_value = "5", value_parser = time, allow_hyphen_values = true)]
    pub to: f64,
    /// Time between frames, in s
    #[arg(long, value_name = "H", default_value = "0.01", value_parser = step, allow_hyphen_values = true)]
    pub step: f64,
    /// Draw the frames of these bodies, `ground` among them
    #[arg(long, value_name = "BODY", value_delimiter = ',')]
    pub frame: Vec<String>,
    /// Width and height in pixels [default: the size that the drawing needs, up to 760x620]
    #[arg(long, value_name = "WxH", value_parser = size)]
    pub size: Option<[u32; 2]>,
    /// Departures from the description.
    #[command(flatten)]
    pub setting: Setting,
    /// Replace a file that this command has not written
    #[arg(long)]
    pub force: bool,
}

const DRAW_EXAMPLES: &str = "\
Examples:
  linkwright draw mechanisms/excavator.mech                         excavator.svg, at t = 0
  linkwright draw mechanisms/jansen.mech --paths T --to 2.1         with the path of a point
  linkwright draw mechanisms/two_body.mech --at 0.3 --frame 2       with the axes of a body's frame
  linkwright draw mechanisms/four_bar.mech --branch phi_coupler_phi_rocker=other --out other.svg
  linkwright draw mechanisms/disc_cam.mech --out cam.png --size 1200x900
  linkwright draw mechanisms/four_bar.mech --out four_bar.dxf       in mm, with dimensions, for a drawing program
  linkwright draw mechanisms/four_bar.mech --links                  four_bar_links.svg, each link with its distances
  linkwright draw mechanisms/four_bar.mech --animate --to 2         four_bar_animated.svg, which moves in a browser
  linkwright draw mechanisms/four_bar.mech --animate --to 2 --out four_bar.gif

Exit codes: 0 drawn, 1 the mechanism cannot be assembled or its motion ends before T, 2 bad input.";

/// Checks a mechanism: degrees of freedom, the determinant of each block and the poses in which it is zero, and the
/// assemblies at the start. Locates the time of a range at which each block comes closest to singular.
///
/// The measure is the determinant of the block divided by the lengths of its columns: the sine of the angle between
/// two links, or between a link and its slide. The smallest value is located between the frames too, to the last
/// digits of t.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  linkwright check mechanisms/two_body.mech
  linkwright check mechanisms/excavator.mech --to 20 --plot pictures    assemblies.svg shows all assemblies
  linkwright check mechanisms/four_bar.mech --json | jq '.blocks[].closest'
  linkwright check mechanisms/excavator.mech --prove --points K         statements about every instant

Exit codes: 0 checked, 1 the mechanism cannot be assembled or its motion ends early, with `--prove` also if the motion
cannot be proven, with `--deny-warnings` also if there are warnings, 2 bad input.")]
pub struct Check {
    /// Description.
    #[command(flatten)]
    pub described: Described,
    /// Units of the report.
    #[command(flatten)]
    pub reported_in: ReportedIn,
    /// Start of the motion, in s; the assemblies are those of this time
    #[arg(long, value_name = "T0", default_value = "0", value_parser = time, allow_hyphen_values = true)]
    pub from: f64,
    /// End of the motion, in s
    #[arg(long, value_name = "T1", default_value = "5", value_parser = time, allow_hyphen_values = true)]
    pub to: f64,
    /// Time between frames, in s; both ends and at least 64 frames between them are examined. Extremes between frames
    /// are located, unless they appear and vanish within one step
    #[arg(long, value_name = "H", default_value = "0.01", value_parser = step, allow_hyphen_values = true)]
    pub step: f64,
    /// Value of a parameter, or motion of an input as an expression of t, in SI units or with a unit; may be repeated
    #[arg(long, value_name = "NAME=VALUE", allow_hyphen_values = true)]
    pub set: Vec<String>,
    /// Prove for the whole range that the mechanism moves on one smooth path. Bounds the distance of each block from
    /// singular, and the range of coordinates and points
    #[arg(long)]
    pub prove: bool,
    /// Bounds of these points alone, separated by commas [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', requires = "prove")]
    pub points: Vec<String>,
    /// Folder for a picture of all assemblies, `assemblies.svg`
    #[arg(long, value_name = "DIR")]
    pub plot: Option<PathBuf>,
    /// Replace files that this command has not written
    #[arg(long)]
    pub force: bool,
    /// Print one JSON object instead of text
    #[arg(long)]
    pub json: bool,
    /// Exit with 1 if there are warnings
    #[arg(long)]
    pub deny_warnings: bool,
}

/// Writes the mechanism as a Rust module that needs only the crate `linkwright`, or as a source and a header of C99.
///
/// C is written to NAME.c and NAME.h, with the runtime linkwright.c and linkwright.h beside them, which need only the
/// C library. Both headers can be included from C++. The numbers have the same bits as those of the Rust module.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  linkwright generate mechanisms/two_body.mech                       the module on stdout
  linkwright generate mechanisms/two_body.mech -o src/two_body.rs    written only if it changes
  linkwright generate mechanisms/two_body.mech -o src/two_body.rs --check
  linkwright generate mechanisms/two_body.mech --scalar f32          in single precision
  linkwright generate mechanisms/two_body.mech --lanes 8             eight at once as well
  linkwright generate --lang c mechanisms/two_body.mech -o two_body.c
  linkwright generate --lang c mechanisms/two_body.mech -o two_body.c --lanes 8

The module holds two formulations of the mechanism: the solved one, which its type runs, with one function for each block,
and the textbook one, Φ, Φ_q, Φ_t and γ as functions. Above 150 coordinates the textbook formulation is left out.

Exit codes: 0 written or unchanged, 1 `--check` found a difference, 2 bad input.")]
pub struct Generate {
    /// Description, a `.mech` file; `-` is stdin
    pub file: PathBuf,
    /// Output file of the module; `-` is stdout [default: stdout]. The other files of C are written beside it
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Language of the module
    #[arg(long, default_value = "rust", value_parser = languages())]
    pub lang: Language,
    /// Replace a file that is not a generated module
    #[arg(long, conflicts_with = "check")]
    pub force: bool,
    /// Write nothing; exit with 1 if FILE differs from the module
    #[arg(long, requires = "output")]
    pub check: bool,
    /// Number type of the module
    #[arg(long, value_enum, default_value_t = Precision::F64)]
    pub scalar: Precision,
    /// Add functions that solve COUNT mechanisms at once: 8, or 16 in f32. All blocks must have closed forms
    #[arg(long, value_name = "COUNT")]
    pub lanes: Option<usize>,
}

/// Parser of a language by its name.
fn languages() -> impl TypedValueParser<Value = Language> {
    let names = Language::ALL.map(|language| {
        let Conventions { option, about, .. } = language.conventions();
        PossibleValue::new(option).help(about)
    });
    PossibleValuesParser::new(names).map(|name| {
        let named = |language: &Language| language.conventions().option == name;
        Language::ALL.into_iter().find(named).unwrap_or_default()
    })
}

/// Number types of generated code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Precision {
    /// Double precision
    F64,
    /// Single precision, for processors without hardware for double precision
    F32,
}

/// Shows the equations, also those of a mechanism whose motion they do not determine.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  linkwright inspect mechanisms/two_body.mech
  linkwright inspect mechanisms/excavator_tool.mech --format unicode
  linkwright inspect mechanisms/two_body.mech --format rust
  linkwright inspect mechanisms/two_body.mech --format latex --fragment > equations.tex

Equations are also shown if they do not determine the motion. In text and Unicode a last section lists the contents of the
generated code: its blocks in their order, values that no `output` needs, and the number of operations of each level.

Exit codes: 0 shown, 2 bad input, with `--format rust` also if the equations do not determine the motion.")]
pub struct Inspect {
    /// Description, a `.mech` file; `-` is stdin
    pub file: PathBuf,
    /// Motion to show if the mechanism has several
    #[arg(long, value_name = "NAME")]
    pub motion: Option<String>,
    /// Notation of formulas
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,
    /// Leave out the preamble with `--format latex`, so that a document of yours can read the output with `\input`
    #[arg(long)]
    pub fragment: bool,
}

/// Notations of formulas.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Typed: x1 + cos(phi1)
    Text,
    /// Printed: x₁ + cos φ₁
    Unicode,
    /// LaTeX document
    Latex,
    /// Generated module
    Rust,
}

/// Derives the solution block by block, as in a textbook: the unknowns that follow from each joint, their formulas,
/// and the parts without a closed form.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  linkwright plan mechanisms/two_body.mech
  linkwright plan mechanisms/excavator.mech --format unicode
  linkwright plan mechanisms/excavator.mech --format latex > excavator.tex
  linkwright plan mechanisms/two_body.mech --format latex --fragment > solution.tex

Exit codes: 0 derived, 2 bad input, also if the equations do not determine the motion.")]
pub struct Plan {
    /// The description.
    #[command(flatten)]
    pub described: Described,
    /// Notation of words and formulas
    #[arg(long, value_enum, default_value_t = Script::Text)]
    pub format: Script,
    /// Leave out the preamble with `--format latex`, so that a document of yours can read the output with `\input`
    #[arg(long)]
    pub fragment: bool,
}

/// Notation of words and formulas.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Script {
    /// Typed: x1 + cos(phi1)
    Text,
    /// Printed: x₁ + cos φ₁
    Unicode,
    /// LaTeX document
    Latex,
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    #[test]
    fn the_arguments_are_consistent() {
        super::Arguments::command().debug_assert();
    }
}
