//! Runs NumPy and pylinkage in a virtual environment of their own, and checks what they compute.

use std::error::Error;
use std::f64::consts::FRAC_PI_2;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::lines::{self, Lines};
use super::{Measured, by_hand};
use crate::dyad_chain;

/// Packages, of whose interface the program is written.
const PACKAGES: [&str; 3] = ["numpy", "numba", "pylinkage==1.3.0"];

/// Program of both.
const PROGRAM: &str = include_str!("peers.py");

/// Largest error of a position (m), or of an angle (rad) and its derivatives.
const TOLERANCE: f64 = 1e-9;

/// Lines that the programs with NumPy and with pylinkage print.
#[derive(Clone, Debug)]
pub struct Peers {
    /// Chains, and the four-bar with its rates.
    pub numpy: Lines,
    /// Positions alone.
    pub pylinkage: Lines,
}

impl Peers {
    /// Makes the environment in a folder unless it is there, runs both, and compares their last positions with the interpreter.
    ///
    /// # Errors
    /// Python is missing, a package cannot be installed, a program fails, or a position is wrong.
    pub fn measure(folder: &Path, all: &[Measured]) -> Result<Peers, Box<dyn Error>> {
        let python = environment(folder)?;
        let program = folder.join("peers.py");
        fs::write(&program, PROGRAM)?;
        let cache = folder.join("compiled");
        if cache.exists() {
            // The first result includes compiling.
            fs::remove_dir_all(&cache)?;
        }
        let run = |argument: &str| {
            let mut command = Command::new(&python);
            command.arg(&program).arg(argument);
            command.env("NUMBA_CACHE_DIR", &cache);
            for threads in ["OMP", "OPENBLAS", "NUMBA"] {
                command.env(format!("{threads}_NUM_THREADS"), "1");
            }
            lines::of(&mut command)
        };
        let peers = Peers {
            numpy: run("numpy")?,
            pylinkage: run("pylinkage")?,
        };
        for lines in [&peers.numpy, &peers.pylinkage] {
            for (name, _) in lines.all("time") {
                let values = lines.all("value").find(|(other, _)| *other == name);
                let (_, values) = values.ok_or_else(|| format!("expected a value of {name}"))?;
                compare(name, values, all).map_err(|error| format!("{name}: {error}"))?;
            }
        }
        Ok(peers)
    }

    /// Returns the versions of all packages.
    pub fn versions(&self) -> String {
        let all = self
            .numpy
            .all("version")
            .chain(self.pylinkage.all("version"));
        let names: Vec<&str> = all.map(|(name, _)| name).collect();
        names.join(", ")
    }
}

/// Returns the program of a virtual environment that has the packages.
fn environment(folder: &Path) -> Result<PathBuf, Box<dyn Error>> {
    let python = folder.join("bin/python");
    let run = |command: &mut Command| -> Result<(), Box<dyn Error>> {
        let program = command.get_program().display().to_string();
        let output = command
            .output()
            .map_err(|error| format!("{program}: {error}"))?;
        match output.status.success() {
            true => Ok(()),
            false => {
                let text = String::from_utf8_lossy(&output.stderr);
                let last = text.trim_end().lines().last().unwrap_or("no message");
                Err(format!("{program} fails: {last}").into())
            }
        }
    };
    if !python.exists() {
        run(Command::new("python3").args(["-m", "venv"]).arg(folder))?;
    }
    let mut install = Command::new(&python);
    install.args(["-m", "pip", "install", "--quiet"]);
    run(install.args(PACKAGES))?;
    Ok(python)
}

/// Compares what a line has computed last with the interpreter.
fn compare(name: &str, values: &[f64], all: &[Measured]) -> Result<(), Box<dyn Error>> {
    let (method, mechanism) = name.split_once(' ').ok_or("expected a method")?;
    let measured = all.iter().find(|it| it.name == mechanism);
    let Some(measured) = measured else {
        return Ok(());
    };
    // NumPy ends one step before 2 s. The crank of pylinkage turns uniformly: that of the four-bar for 2 s, that of a chain by 0.3 rad, which
    // is the amplitude of the description's.
    let (instant, step) = match (method, mechanism) {
        ("step_fast", "four_bar") => (200, measured.step),
        ("step_fast", _) => (200, FRAC_PI_2 / 200.0),
        _ => (199, measured.step),
    };
    let [q, qd, qdd] = by_hand::at(measured, instant, step)?;
    let last = |level: &[f64]| level.last().copied().unwrap_or(f64::NAN);
    let angle = last(&q);
    let tip = |[x, y]: [f64; 2], [along, across]: [f64; 2]| {
        let (sine, cosine) = angle.sin_cos();
        vec![
            x + along * cosine - across * sine,
            y + along * sine + across * cosine,
        ]
    };
    let expected = match (method, mechanism.strip_prefix("dyads_")) {
        ("closed", _) => vec![angle, last(&qd), last(&qdd)],
        (_, None) => tip([0.1, 0.0], [0.08, 0.0]),
        (_, Some(dyads)) => {
            let [pin, drawn] = dyad_chain::places(dyads.parse()?);
            tip(pin, [drawn[0] - pin[0], drawn[1] - pin[1]])
        }
    };
    let is_near = |(one, other): (&f64, &f64)| (one - other).abs() <= TOLERANCE;
    match expected.len() == values.len() && expected.iter().zip(values).all(is_near) {
        true => Ok(()),
        false => Err(format!("expected {expected:?}, found {values:?}").into()),
    }
}
