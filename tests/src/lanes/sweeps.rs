//! Times the command `sweep`, and beside it the batches alone that it solves.

use std::error::Error;
use std::fs;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use linkwright::Blocks;
use linkwright_codegen::diagnostic::Source;
use linkwright_solver::{Batch, Interpreted, Observable};

use crate::description;
use crate::files;
use crate::values::numbers;

/// Numbers of values of the two lengths that vary: 10⁵ sets.
const COUNTS: [usize; 2] = [400, 250];

/// Ranges of the lengths (m), in which the crank turns without limit.
const RANGES: [[f64; 2]; 2] = [[0.11, 0.13], [0.07, 0.09]];

/// Number of instants, and the time between them (s).
const INSTANTS: usize = 200;
const STEP: f64 = 0.01;

/// Number of sets that are solved at once.
const CHUNK: usize = 4096;

/// Number of runs, of which the fastest counts.
const RUNS: usize = 3;

/// Times (s) of all sets.
#[derive(Clone, Copy, Debug)]
pub struct Times {
    /// Number of threads.
    pub threads: usize,
    /// Command, from its start to its end.
    pub command: f64,
    /// Batches and extremes alone.
    pub batch: f64,
}

/// Number of sets.
pub const SETS: usize = COUNTS[0] * COUNTS[1];

/// Returns the description: a four-bar with its lengths as parameters, whose crank turns.
fn source() -> Source {
    let described = description::source("four_bar_given");
    let turning = described
        .text
        .replace("input crank_angle = 40deg;", "")
        .replace("phi(crank) = crank_angle", "phi(crank) = 40deg + 3*t");
    Source::new("turning.mech", turning)
}

/// Builds the command, and times it on one thread and on two; both runs write into the folder.
///
/// # Errors
/// The command cannot be built or fails, or a set has no pose.
pub fn measure(folder: &Path) -> Result<[Times; 2], Box<dyn Error>> {
    let command = built()?;
    fs::create_dir_all(folder)?;
    let source = source();
    let path = folder.join("turning.mech");
    fs::write(&path, &source.text)?;
    let mut all = [1, 2].map(|threads| Times {
        threads,
        command: f64::INFINITY,
        batch: f64::INFINITY,
    });
    for _ in 0..RUNS {
        for times in &mut all {
            let mut sweep = Command::new(&command);
            sweep.arg("sweep").arg(&path).current_dir(folder);
            for ((name, [from, to]), count) in ["L2", "L3"].iter().zip(RANGES).zip(COUNTS) {
                sweep.args(["--vary", &format!("{name}={from}..{to}:{count}")]);
            }
            let end = STEP * (INSTANTS - 1) as f64;
            sweep.args(["--show", "phi_rocker", "--to", &format!("{end}")]);
            sweep.args(["--step", &format!("{STEP}"), "--force"]);
            sweep.args(["--csv", "sweep.csv"]);
            sweep.args(["--threads", &format!("{}", times.threads)]);
            let begun = Instant::now();
            let output = sweep.output()?;
            times.command = times.command.min(begun.elapsed().as_secs_f64());
            let text = String::from_utf8_lossy(&output.stdout).into_owned();
            if !text.contains(&format!("{SETS} of {SETS} sets solved")) {
                let errors = String::from_utf8_lossy(&output.stderr);
                return Err(format!("sweep: {text}{errors}").into());
            }
            times.batch = times.batch.min(batch(&source, times.threads)?);
        }
    }
    Ok(all)
}

/// Builds the command in the profile of this program; returns its path.
fn built() -> Result<PathBuf, Box<dyn Error>> {
    let this = std::env::current_exe()?;
    let folder = this.parent().ok_or("the program has no folder")?;
    let profile = folder.file_name().and_then(|it| it.to_str());
    let profile = match profile {
        Some("debug") | None => "dev",
        Some(profile) => profile,
    };
    let status = Command::new("cargo")
        .args([
            "build",
            "--quiet",
            "-p",
            "linkwright-cli",
            "--profile",
            profile,
        ])
        .current_dir(files::repository())
        .status()?;
    match status.success() {
        true => Ok(folder.join("linkwright")),
        false => Err("the command does not build".into()),
    }
}

/// Solves all sets in this process and takes the extremes of each; returns the time (s), description included.
fn batch(source: &Source, threads: usize) -> Result<f64, Box<dyn Error>> {
    let begun = Instant::now();
    let read = linkwright_codegen::read(source).map_err(|errors| errors.render(source))?;
    let derived = read.only().ok_or("expected one motion")?;
    let blocks = Interpreted::new(&derived).ok_or("the motion is not determined")?;
    let observable = Observable::named(&derived, "phi_rocker").ok_or("no angle of the rocker")?;
    let observables = [observable];
    let instants: Vec<f64> = (0..INSTANTS).map(|it| STEP * it as f64).collect();
    let names = &derived.system.mechanism.parameters;
    let place = |name: &str| names.iter().position(|it| it.name == name);
    let places = ["L2", "L3"].map(place);
    let [Some(coupler), Some(rocker)] = places else {
        return Err("expected two lengths".into());
    };
    let nominal = numbers(&blocks.nominal_parameters());
    let mut solver = Batch::new(&blocks, &instants, &observables);
    solver.threads = threads;
    let mut values = vec![0.0; CHUNK * INSTANTS];
    let mut parameters = Vec::with_capacity(CHUNK * nominal.len());
    let mut extremes = Vec::with_capacity(SETS);
    for first in (0..SETS).step_by(CHUNK) {
        let sets = first..(first + CHUNK).min(SETS);
        let values = &mut values[..sets.len() * INSTANTS];
        parameters.clear();
        for set in sets {
            let mut lengths = nominal.clone();
            let indices = [set / COUNTS[1], set % COUNTS[1]];
            for (place, axis) in [(coupler, 0), (rocker, 1)] {
                let [from, to] = RANGES[axis];
                lengths[place] =
                    from + (to - from) * indices[axis] as f64 / (COUNTS[axis] - 1) as f64;
            }
            parameters.extend(lengths);
        }
        let outcomes = solver.solve(&parameters, &[], values)?;
        if let Some(outcome) = outcomes.iter().find(|it| it.failure.is_some()) {
            return Err(format!("a set fails: {:?}", outcome.failure).into());
        }
        for values in values.chunks(INSTANTS) {
            let least = values.iter().copied().fold(f64::INFINITY, f64::min);
            let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            extremes.push([least, most]);
        }
    }
    black_box(&extremes);
    Ok(begun.elapsed().as_secs_f64())
}
