//! Prints the equations of a description and the blocks that generated code solves.

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::emit::derivation::{self, Script, SingularPose};
use linkwright_codegen::stages::emit::{self, Notation};
use linkwright_codegen::stages::program::Kept;
use linkwright_codegen::stages::solved::Solved;
use linkwright_codegen::stages::structure::{Freedom, Shift};
use linkwright_codegen::stages::system::Derived;
use linkwright_codegen::{Options, OutputFile};
use linkwright_solver::number::counted;

use super::description::{motions, rendered, source, warn};
use super::{Outcome, Problem, print};
use crate::arguments::{Format, Inspect};
use crate::terminal;

/// Prints Φ, Φ_q, Φ_t and γ in the selected format; as text, also the blocks that generated code solves.
///
/// # Errors
/// The description has errors; for Rust, also if its equations do not determine the motion.
pub fn run(arguments: &Inspect) -> Result<Outcome, Problem> {
    if arguments.fragment && arguments.format != Format::Latex {
        return Err(no_fragment());
    }
    let source = source(&arguments.file)?;
    let motion = arguments.motion.as_deref();
    let text = match (arguments.format, motion) {
        (Format::Rust, None) => {
            let module = written(&source, &Options::default())?;
            module.into_iter().map(|file| file.text).collect()
        }
        (Format::Rust, Some(_)) => {
            return Err(Problem(
                "error: the generated file holds all motions\n  = help: leave out `--motion`"
                    .to_string(),
            ));
        }
        (format, _) => {
            let motions = motions(&source, motion)?;
            // Each page begins with the name of its motion.
            let pages = |notation| {
                let pages = motions.iter().map(|derived| equations(derived, notation));
                pages.collect::<Vec<_>>().join("\n")
            };
            match format {
                Format::Unicode => pages(Notation::Unicode),
                Format::Latex => {
                    let with_poses = motions
                        .iter()
                        .map(|derived| (derived, poses(derived, Script::Latex)));
                    let with_poses: Vec<_> = with_poses.collect();
                    match arguments.fragment {
                        true => emit::latex::inspect_fragment(&with_poses),
                        false => emit::latex::inspect(&with_poses),
                    }
                }
                Format::Text | Format::Rust => pages(Notation::Ascii),
            }
        }
    };
    let text = match arguments.format {
        Format::Text | Format::Unicode => terminal::fitted(text),
        Format::Latex | Format::Rust => text,
    };
    print(|output| {
        output.write_all(text.as_bytes())?;
        match text.ends_with('\n') {
            true => Ok(()),
            false => output.write_all(b"\n"),
        }
    })?;
    Ok(Outcome::Done)
}

/// Returns the error of a fragment in a format other than LaTeX.
pub(super) fn no_fragment() -> Problem {
    Problem(
        "error: only LaTeX has a preamble that `--fragment` leaves out\n  = help: add `--format latex`"
            .to_string(),
    )
}

/// Returns the equations and, if they determine the motion, what the solved formulation computes and omits.
fn equations(derived: &Derived, notation: Notation) -> String {
    let page = emit::text::inspect(derived, notation);
    let system = &derived.system;
    // The counts by rank are below the counts by number.
    let (first, rest) = page.split_once('\n').unwrap_or((&page, ""));
    let mut text = format!("{first}\n{}\n{rest}", freedom(derived));
    let Ok(solved) = Solved::of(derived.clone(), Shift::Directions, Kept::Requested) else {
        return text;
    };
    if let Some(report) = solved.report() {
        if !text.ends_with('\n') {
            text.push('\n');
        }
        text.push_str("\nwhat the generated code solves\n");
        for line in emit::report::lines(report) {
            text.push_str(&format!("  {line}\n"));
        }
    }
    let script = Script::Text(notation);
    let is_same = Shift::Directions.applies(system) == Shift::Efforts.applies(system);
    let poses = match is_same {
        true => poses_of(&solved, script),
        false => poses(derived, script),
    };
    text.push_str(&determinants(poses));
    text
}

/// Describes the determinant of each block up to its sign, and the poses in which it is zero; empty without such blocks.
fn determinants(poses: Vec<SingularPose>) -> String {
    if poses.is_empty() {
        return String::new();
    }
    let mut text = "\ndet of each block, up to its sign\n".to_string();
    for pose in poses {
        text.push_str(&format!(
            "  block {}, {}: {}\n",
            pose.block + 1,
            pose.unknowns,
            pose.sentence()
        ));
    }
    text
}

/// Returns the singular poses of each block; empty if the equations do not determine the motion.
///
/// Solves the motion without the shifts of drivers, which would appear in the formulas. Nothing but solution methods is lowered.
fn poses(derived: &Derived, script: Script) -> Vec<SingularPose> {
    let solved = Solved::of(derived.clone(), Shift::Efforts, Kept::Methods);
    solved.map_or_else(|_| Vec::new(), |solved| poses_of(&solved, script))
}

fn poses_of(solved: &Solved, script: Script) -> Vec<SingularPose> {
    let (pool, system, plan) = (solved.pool(), solved.system(), solved.plan());
    derivation::singular_poses(pool, system, plan, &solved.program().forms, script)
}

/// Describes the degrees of freedom by the rank of the equations.
fn freedom(derived: &Derived) -> String {
    let freedom = Freedom::of(&derived.pool, &derived.system);
    let redundant = match freedom.redundant {
        0 => String::new(),
        number => format!(", {}", counted(number, "redundant equation")),
    };
    format!(
        "KDOF = {}, NDOF = {}{redundant}",
        freedom.kinematic, freedom.net
    )
}

/// Returns the files of the generated module; prints warnings on stderr.
///
/// # Errors
/// All errors of the description.
pub fn written(source: &Source, options: &Options) -> Result<Vec<OutputFile>, Problem> {
    let generated =
        linkwright_codegen::generate(source, options).map_err(|it| rendered(&it, source))?;
    warn(&generated.warnings, source);
    Ok(generated.files)
}
