//! Compiles and runs closed forms in C, the limit of what lanes can reach.

use std::collections::BTreeMap;
use std::error::Error;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

use linkwright::Settings;
use linkwright_solver::{InputSignals, Interpreted};

use super::processor::InstructionSet;
use super::{Measured, lines};
use crate::values::{assembled_with, levels};

/// Program in C.
const PROGRAM: &str = include_str!("by_hand.c");

/// Flags of the compiler besides those of the instruction set.
pub const FLAGS: &str =
    "-std=gnu11 -O3 -fno-math-errno -fno-trapping-math -mprefer-vector-width=512";

/// Largest difference of a number from that of the interpreter, relative to the largest number of its kind in the frame.
const TOLERANCE: f64 = 1e-9;

/// Times of the mechanisms (ns a pose) by name.
#[derive(Clone, Debug)]
pub struct Times {
    /// Times by name.
    pub poses: BTreeMap<String, f64>,
    /// From the text to the first result (ms): compiling and starting.
    pub first: f64,
}

/// Compiles the program for an instruction set, runs it, and compares its frames with those of the interpreter.
///
/// # Errors
/// The compiler is missing or refuses the program, or a frame differs.
pub fn measure(
    folder: &Path,
    set: &InstructionSet,
    all: &[Measured],
) -> Result<Times, Box<dyn Error>> {
    fs::create_dir_all(folder)?;
    let (source, program) = (folder.join("by_hand.c"), folder.join(set.processor));
    fs::write(&source, PROGRAM)?;
    let begun = Instant::now();
    let compiled = Command::new("cc")
        .args(FLAGS.split(' '))
        .arg(format!("-march={}", set.processor))
        .arg("-o")
        .arg(&program)
        .arg(&source)
        .arg("-lm")
        .output()?;
    let first = 1e3 * begun.elapsed().as_secs_f64();
    if !compiled.status.success() {
        return Err(String::from_utf8_lossy(&compiled.stderr).into());
    }
    let mut times = Times {
        poses: BTreeMap::new(),
        first,
    };
    let printed = lines::of(&mut Command::new(&program))?;
    for (name, time) in printed.all("time") {
        let [time] = time[..] else {
            return Err("expected a time".into());
        };
        times.poses.insert(name.to_string(), time);
    }
    for it in all.iter().filter(|it| times.poses.contains_key(&it.name)) {
        let mut frames = printed
            .all("frame")
            .filter(|(name, _)| *name == it.name)
            .peekable();
        if frames.peek().is_none() {
            return Err(format!("expected frames of {}", it.name).into());
        }
        for (_, frame) in frames {
            compare(it, frame).map_err(|error| format!("{}: {error}", it.name))?;
        }
    }
    Ok(times)
}

/// Compares a frame, which begins with the number of its instant, with that of the interpreter.
fn compare(it: &Measured, frame: &[f64]) -> Result<(), Box<dyn Error>> {
    let [instant, frame @ ..] = frame else {
        return Err("expected a frame".into());
    };
    let expected = at(it, *instant as usize, it.step)?.concat();
    if expected.len() != frame.len() {
        return Err(format!("expected {} numbers, found {}", expected.len(), frame.len()).into());
    }
    let count = expected.len() / 3;
    for (expected, numbers) in expected.chunks(count).zip(frame.chunks(count)) {
        let scale = expected.iter().fold(0.0_f64, |most, it| most.max(it.abs()));
        for (expected, number) in expected.iter().zip(numbers) {
            // False for NaN.
            let is_near = (expected - number).abs() <= TOLERANCE * scale;
            if !is_near {
                return Err(
                    format!("instant {instant}: expected {expected}, found {number}").into(),
                );
            }
        }
    }
    Ok(())
}

/// Returns the coordinates, rates and accelerations at an instant, which the interpreter reaches in steps (s).
///
/// # Errors
/// The description has errors, or a pose is missing.
pub fn at(it: &Measured, instant: usize, step: f64) -> Result<[Vec<f64>; 3], Box<dyn Error>> {
    let read =
        linkwright_codegen::read(&it.guarded).map_err(|errors| errors.render(&it.guarded))?;
    let derived = read.only().ok_or("expected one motion")?;
    let blocks = Interpreted::new(&derived).ok_or("the motion is not determined")?;
    let none = InputSignals::default();
    let failed = |failure: linkwright::Failure| format!("no pose: {:?}", failure.kind);
    let shell = assembled_with(blocks.clone(), &[], 0.0, &none, Settings::default());
    let mut shell = shell.map_err(failed)?;
    for instant in 1..=instant {
        shell
            .advance(step * instant as f64, &none)
            .map_err(failed)?;
    }
    Ok(levels(&blocks, shell.frame()))
}
