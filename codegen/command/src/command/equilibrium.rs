//! Finds the equilibria of free coordinates, and follows one over a parameter.

use std::sync::atomic::Ordering;

use linkwright_codegen::stages::system::{Derived, System};
use linkwright_solver::View as _;
use linkwright_solver::equilibrium::{Equilibria, EquilibriumPath, PathEnd, Unbalanced, Varied};
use linkwright_solver::number::time;

use super::description::{determined, interpreted, outputs, set_all, source};
use super::simulate::missing_statement;
use super::{Outcome, Problem, in_folder, print, say};
use crate::arguments::Equilibrium as Arguments;
use crate::interruption;
use crate::progress::Progress;
use crate::report::equilibrium_path::{self, Followed};
use crate::report::{equilibrium_json, equilibrium_plot, equilibrium_text, picture};
use crate::sweep::{Place, Range};
use crate::terminal;

/// Number of points of a path that the progress bar expects.
const EXPECTED_POINTS: usize = 300;

/// Name of the option in messages.
const OPTION: &str = "--path";

/// Range of a parameter over which an equilibrium is followed.
struct Varying {
    name: String,
    unit: String,
    place: Varied,
    ends: [f64; 2],
}

/// Reports the equilibria, and the path of one.
///
/// # Errors
/// The description has errors or no free coordinate, an option cannot be used, or a picture cannot be written. An [`Outcome`] reports a
/// mechanism without an equilibrium.
pub fn run(arguments: &Arguments) -> Result<Outcome, Problem> {
    let source =
        source(&arguments.described.file)?.reported_in(arguments.reported_in.units.clone());
    let derived = determined(&source, arguments.described.motion.as_deref())?;
    let mut derived = set_all(derived, &arguments.set)?;
    if derived.system.mechanism.forces.free.is_empty() {
        return Err(Problem(format!(
            "error: no coordinate of `{}` is free, so forces move nothing\n  = help: {}",
            arguments.described.file.display(),
            missing_statement(&derived.system, "")
        )));
    }
    let mut varying = None;
    if let Some(text) = &arguments.path {
        let (range, first) = range(&derived, text)?;
        derived = set_all(derived, &[first])?;
        varying = Some(range);
    }
    let mut picture = None;
    if let Some(folder) = &arguments.plot {
        let mut files = outputs(&arguments.described.file, &source, arguments.force);
        let path = in_folder(folder, "equilibrium.svg")?;
        picture = Some(files.file(&path, picture::SIGNATURE)?);
    }
    let view = interpreted(&derived, &source)?;
    let system = view.system();
    let stop = interruption::flag();
    let mut progress = Progress::of_starts(arguments.starts);
    let equilibria = Equilibria::new(
        &derived,
        &view,
        arguments.at,
        arguments.starts,
        |count, _| {
            progress.reached(count);
            !stop.load(Ordering::Relaxed)
        },
    );
    progress.finish();
    let equilibria = match equilibria {
        Ok(equilibria) => equilibria,
        Err(reason) => return unbalanced(&reason, system, arguments.at),
    };
    if !arguments.json {
        // An interrupted run has printed the equilibria.
        print(|output| {
            let mut text = Vec::new();
            equilibrium_text::write(&equilibria, system, arguments.at, &mut text)?;
            let text = String::from_utf8_lossy(&text).into_owned();
            output.write_all(terminal::fitted(text).as_bytes())
        })?;
    }
    let followed = match &varying {
        Some(varying) if !equilibria.all.is_empty() => {
            Some(follow(arguments, &equilibria, varying)?)
        }
        Some(varying) => {
            say(&format!(
                "error: the list has nothing to follow over `{}`",
                varying.name
            ));
            None
        }
        None => None,
    };
    print(|output| match (arguments.json, &followed) {
        (true, _) => {
            equilibrium_json::write(&equilibria, followed.as_ref(), system, arguments.at, output)
        }
        (false, Some(followed)) => equilibrium_path::write(followed, system, output),
        (false, None) => Ok(()),
    })?;
    if let (Some(output), Some(followed)) = (picture, &followed) {
        let drawn = equilibrium_plot::picture(followed, system);
        let drawn = drawn.map_err(|text| Problem(format!("error: {text}")))?;
        let path = output.path().to_path_buf();
        output.write(|output| output.write_all(drawn.as_bytes()))?;
        if !arguments.json {
            print(|output| writeln!(output, "wrote {}", path.display()))?;
        }
    }
    let is_lost = match &followed {
        Some(followed) => matches!(
            followed.path.end,
            PathEnd::Lost | PathEnd::Long | PathEnd::Interrupted
        ),
        None => varying.is_some(),
    };
    let is_any = equilibria.is_everywhere || !equilibria.all.is_empty();
    Ok(match is_any && !is_lost {
        true => Outcome::Done,
        false => Outcome::Failed,
    })
}

/// Follows the chosen equilibrium.
///
/// # Errors
/// The list has no such number, or the path has no direction.
fn follow(
    arguments: &Arguments,
    equilibria: &Equilibria,
    varying: &Varying,
) -> Result<Followed, Problem> {
    let count = equilibria.all.len();
    let chosen = match arguments.of {
        Some(number) => number as usize - 1,
        None => equilibria.nearest.unwrap_or(0),
    };
    if chosen >= count {
        return Err(Problem(format!(
            "error: `--of {}` is not in the list of {count} equilibria\n  = help: the numbers are those of `{OPTION} {}` without `--of`",
            chosen + 1,
            arguments.path.as_deref().unwrap_or_default()
        )));
    }
    let mut progress = Progress::new(EXPECTED_POINTS);
    let stop = interruption::flag();
    let path = EquilibriumPath::new(equilibria, chosen, varying.place, varying.ends, |count| {
        progress.reached(count);
        !stop.load(Ordering::Relaxed)
    });
    progress.finish();
    let path = path.map_err(|_| {
        Problem(format!(
            "error: the path of equilibrium {} has no direction at the first value of `{}`: it turns back there, or another path crosses\n  = help: begin at another value",
            chosen + 1,
            varying.name
        ))
    })?;
    Ok(Followed {
        name: varying.name.clone(),
        unit: varying.unit.clone(),
        of: chosen,
        ends: varying.ends,
        path,
    })
}

/// Reads the range of a path, and the assignment of its first value.
///
/// # Errors
/// The text is not a range of a parameter or an input that is not free.
fn range(derived: &Derived, text: &str) -> Result<(Varying, String), Problem> {
    let range = Range::read(derived, OPTION, text).map_err(Problem)?;
    let mechanism = &derived.system.mechanism;
    if range.count.is_some() || !text.contains('=') {
        return Err(Problem(format!(
            "error: `{OPTION} {text}` is not a range without a number of values\n  = help: write it as in `{OPTION} load=0N..20N`; steps follow the path"
        )));
    }
    let (place, dimension) = match range.varied.place {
        Place::Parameter(at) => {
            let parameter = &mechanism.parameters[at];
            (Varied::Parameter(at, parameter.symbol), parameter.dimension)
        }
        Place::Input(at) => (Varied::Input(at), mechanism.inputs[at].dimension),
    };
    let is_free = |input: usize| mechanism.forces.free.iter().any(|it| it.input == input);
    if matches!(place, Varied::Input(at) if is_free(at)) {
        return Err(Problem(format!(
            "error: `{}` is free, so forces determine it\n  = help: name a parameter or an input",
            range.varied.name
        )));
    }
    let first = text.split("..").next().unwrap_or_default();
    let varying = Varying {
        name: range.varied.name.clone(),
        unit: linkwright_codegen::stages::model::si_unit(dimension),
        place,
        ends: range.ends.map(|end| range.varied.si(end)),
    };
    Ok((varying, first.to_string()))
}

/// Reports a mechanism whose equilibria cannot be sought.
///
/// # Errors
/// No coordinate is free.
fn unbalanced(reason: &Unbalanced, system: &System, t: f64) -> Result<Outcome, Problem> {
    let title = system.mechanism.title();
    let words = match reason {
        Unbalanced::NothingFree => {
            return Err(Problem(format!("error: forces of `{title}` are undetermined")));
        }
        Unbalanced::NotAssembled(reason) => format!(
            "cannot be assembled in the design modes at t = {} s: {reason}",
            time(t)
        ),
        Unbalanced::Singular => {
            "cannot be followed from its design configuration: its constraints lose rank there, or a load is undefined\n  = help: begin in another pose".to_string()
        }
    };
    say(&format!("error: `{title}` {words}"));
    Ok(Outcome::Failed)
}
