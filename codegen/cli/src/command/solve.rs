//! *A description and times → its motion: printed, and written as CSV and plots.*

use std::io;
use std::path::{Path, PathBuf};

use linkwright_codegen::model::set;

use super::description::{determined, source};
use super::{Outcome, Problem, print, say};
use crate::arguments::Solve;
use crate::branches;
use crate::file::replace;
use crate::number::counted;
use crate::progress::{PATIENCE, Progress};
use crate::report::{comma_separated, json, plot, summary};
use crate::schedule::Schedule;
use crate::solution::{Solution, select};
use crate::solved_interpreter::SolvedInterpreter;

/// How many numbers the frames of a motion may consist of: two gigabytes.
const LARGEST: usize = 250_000_000;

/// Solves the motion and reports it.
///
/// # Errors
/// The description has errors, its equations do not determine the motion, an option cannot be used, or a file cannot
/// be written. That the mechanism cannot be solved is an outcome.
pub fn run(arguments: &Solve) -> Result<Outcome, Problem> {
    let to_stdout = arguments.csv.as_deref() == Some(Path::new("-"));
    if to_stdout && arguments.json {
        return Err(Problem(
            "error: `--json` and `--csv -` both want stdout".to_string(),
        ));
    }
    let source = source(&arguments.file)?;
    let mut system = determined(&source, arguments.motion.as_deref())?;
    for assignment in &arguments.set {
        set(&mut system.mechanism, assignment).map_err(Problem)?;
    }
    let points =
        select(&system, &arguments.points).map_err(|text| Problem(format!("error: {text}")))?;
    let schedule = schedule(arguments)?;
    let numbers = (1 + 3 * system.coordinates.len()).saturating_mul(schedule.wanted());
    if numbers > LARGEST {
        return Err(Problem(format!(
            "error: {} of {} do not fit into memory: use a larger `--step`",
            counted(schedule.wanted(), "frame"),
            counted(system.coordinates.len(), "coordinate")
        )));
    }
    let solved = SolvedInterpreter::new(&system);
    let chosen_pose = match arguments.branch.as_slice() {
        [] => None,
        wishes => {
            let pose = solved
                .as_ref()
                .ok_or_else(|| "the mechanism is not solved loop by loop".to_string())
                .and_then(|solved| branches::assembled(solved, schedule.start.t, wishes));
            Some(pose.map_err(|text| Problem(format!("error: {text}")))?)
        }
    };
    let mut progress = Progress::new(schedule.visits());
    let solution = Solution::new(system, solved, points, &schedule, chosen_pose, |count| {
        progress.reached(count)
    });
    let solution = match arguments.monitor {
        true => solution.monitored(),
        false => solution,
    };
    let elapsed = progress.finish();

    let chosen = !arguments.points.is_empty();
    if arguments.json {
        print(|output| json::write(&solution, output))?;
    } else if to_stdout {
        print(|output| comma_separated::write(&solution, output))?;
        // If stderr is closed there is nobody to tell.
        let _ = summary::write(&solution, chosen, &mut io::stderr());
    } else {
        print(|output| {
            summary::write(&solution, chosen, output)?;
            match elapsed > PATIENCE {
                true => writeln!(output, "solved in {:.1} s", elapsed.as_secs_f64()),
                false => Ok(()),
            }
        })?;
    }
    if !arguments.json {
        for warning in &solution.warnings {
            say(&format!("warning: {warning}"));
        }
    }
    if let Some(error) = &solution.error {
        say(&format!("error: `{}` {error}", solution.title()));
    }
    let written = write_files(arguments, &solution)?;
    if !arguments.json && !to_stdout {
        print(|output| {
            written
                .iter()
                .try_for_each(|line| writeln!(output, "wrote {line}"))
        })?;
    }
    Ok(match solution.error {
        None => Outcome::Done,
        Some(_) => Outcome::Failed,
    })
}

fn schedule(arguments: &Solve) -> Result<Schedule, Problem> {
    let Solve {
        from, to, step, at, ..
    } = arguments;
    match at.is_empty() {
        true => Schedule::range(*from, *to, *step),
        false => Schedule::instants(*from, at, *step),
    }
    .map_err(|text| Problem(format!("error: {text}")))
}

/// Writes the frames and plots, where they are wanted and there are any; a line about each.
fn write_files(arguments: &Solve, solution: &Solution) -> Result<Vec<String>, Problem> {
    let mut written = Vec::new();
    if solution.frames().is_empty() {
        return Ok(written);
    }
    let unasked = !arguments.json && arguments.at.is_empty();
    let folder = || Path::new("target/linkwright").join(solution.folder());
    let wanted = |asked: &Option<PathBuf>, default: &dyn Fn() -> PathBuf| match asked {
        None if unasked => Some(default()),
        asked => asked.clone(),
    };
    let csv = wanted(&arguments.csv, &|| folder().join("motion.csv"));
    if let Some(path) = csv.filter(|path| path != Path::new("-")) {
        replace(&path, |output| comma_separated::write(solution, output))?;
        written.push(path.display().to_string());
    }
    if let Some(folder) = wanted(&arguments.plot, &folder) {
        let pictures = plot::draw(solution).map_err(|text| Problem(format!("error: {text}")))?;
        let names: Vec<String> = distinct(pictures.iter().map(|(name, _)| name.as_str()));
        for (name, (_, picture)) in names.iter().zip(&pictures) {
            let path = folder.join(format!("{name}.svg"));
            replace(&path, |output| output.write_all(picture.as_bytes()))?;
        }
        match names.as_slice() {
            [] => {}
            [name] => written.push(folder.join(format!("{name}.svg")).display().to_string()),
            names => written.push(format!(
                "{} ({})",
                folder.join("*.svg").display(),
                names.join(", ")
            )),
        }
    }
    Ok(written)
}

/// File names for points: where two differ in case only, the later one gets a number, since some file systems cannot
/// tell them apart.
fn distinct<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut taken: Vec<String> = Vec::new();
    names
        .map(|name| {
            let mut file = name.to_string();
            let mut number = 2;
            while taken.contains(&file.to_lowercase()) {
                file = format!("{name}-{number}");
                number += 1;
            }
            taken.push(file.to_lowercase());
            file
        })
        .collect()
}

#[cfg(test)]
mod tests {
    #[test]
    fn file_names_differ_in_more_than_case() {
        let names = super::distinct(["a", "A", "b", "A2"].into_iter());
        assert_eq!(names, ["a", "A-2", "b", "A2"]);
    }
}
