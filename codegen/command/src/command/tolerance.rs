//! Adds up tolerances of parameters, and samples mechanisms: the spread of measures along a motion.

use std::sync::atomic::Ordering;

use linkwright_codegen::diagnostic::Diagnostics;
use linkwright_solver::sets::MAX_DIMENSIONS;
use linkwright_solver::stack_up::{
    MAX_SAMPLED_VALUES, Prepared, SampledSpread, Sampling, StackUp, ToleranceSamples, Unprepared,
    prepared,
};
use linkwright_solver::{Schedule, View as _};

use super::description::{outputs, source, unopened, warn};
use super::{Outcome, Problem, in_folder, print, say, threads};
use crate::arguments::{SampleSequence, Tolerance};
use crate::interruption;
use crate::output::Output;
use crate::progress::Progress;
use crate::report::picture;
use crate::report::stack_up::{Report, write_linear, write_sampled};
use crate::report::{stack_up_json, stack_up_plot};

/// Reports the spreads of all measures.
///
/// # Errors
/// The description has errors, tolerances or measures are missing, an option cannot be used, or a picture cannot be written. An
/// [`Outcome`] reports a mechanism that cannot be solved.
pub fn run(arguments: &Tolerance) -> Result<Outcome, Problem> {
    let source =
        source(&arguments.described.file)?.reported_in(arguments.reported_in.units.clone());
    let schedule = Schedule::range(arguments.from, arguments.to, arguments.step)
        .map_err(|text| Problem(format!("error: {text}")))?;
    let visits = schedule.forward.visits().map(|it| it.t);
    let times: Vec<f64> = std::iter::once(schedule.start.t).chain(visits).collect();
    let mut warnings = Diagnostics::new();
    let motion = arguments.described.motion.as_deref();
    let prepared = prepared(&source, motion, "--set", &arguments.set, &mut warnings);
    warn(&warnings, &source);
    let prepared = prepared.map_err(|reason| match reason {
        Unprepared::Unopened(reason) => unopened(&reason, &source),
        Unprepared::Assignment(text) => Problem(text),
        reason => refused(&reason),
    })?;
    let mechanism = &prepared.blocks.system().mechanism;
    check_count(arguments, times.len() * mechanism.measurements.len())?;
    let mut pictures: Vec<Output> = Vec::new();
    if let Some(folder) = &arguments.plot {
        let mut outputs = outputs(&arguments.described.file, &source, arguments.force);
        for measurement in &mechanism.measurements {
            let path = in_folder(folder, &format!("{}_spread.svg", measurement.name))?;
            pictures.push(outputs.file(&path, picture::SIGNATURE)?);
        }
    }
    let threads = threads(arguments.threads);
    let spread = match StackUp::new(&prepared, &times, threads) {
        Ok(spread) => spread,
        Err(failure) => {
            let reason = prepared.blocks.not_assembled(&failure);
            say(&format!("error: `{}` {reason}", mechanism.title()));
            return Ok(Outcome::Failed);
        }
    };
    let samples = samples(arguments, &spread)?;
    let mut report = Report {
        blocks: &prepared.blocks,
        spread: &spread,
        sampled: None,
        sequence: match arguments.sampling {
            SampleSequence::Sobol => "Sobol's sequence",
            SampleSequence::Random => "random numbers",
        },
        seed: arguments.seed,
    };
    if !arguments.json {
        // An interrupted run has printed the first order.
        print(|output| write_linear(&report, output))?;
    }
    let sampled = sampled(arguments, &prepared, &spread, &samples, threads);
    report.sampled = sampled.as_ref();
    print(|output| match arguments.json {
        true => stack_up_json::write(&report, output),
        false => write_sampled(&report, output),
    })?;
    let drawn = match pictures.is_empty() {
        true => Vec::new(),
        false => {
            stack_up_plot::pictures(&report).map_err(|text| Problem(format!("error: {text}")))?
        }
    };
    for (output, picture) in pictures.into_iter().zip(drawn) {
        let Some(picture) = picture else { continue };
        let path = output.path().to_path_buf();
        output.write(|output| output.write_all(picture.as_bytes()))?;
        if !arguments.json {
            print(|output| writeln!(output, "wrote {}", path.display()))?;
        }
    }
    Ok(match &spread.ended {
        None => Outcome::Done,
        Some(reason) => {
            say(&format!("error: `{}` {reason}", mechanism.title()));
            Outcome::Failed
        }
    })
}

fn refused(reason: &Unprepared) -> Problem {
    let (message, help) = match reason {
        Unprepared::NoTolerance => (
            "no parameter has a tolerance, and no pin a clearance",
            "write a tolerance behind a value, `param rod = 120mm tolerance 0.1mm;`, or `clearance P = 0.05mm;`",
        ),
        Unprepared::NoMeasure => (
            "nothing is measured",
            "name a quantity of the motion: `measure stroke = distance(O, B);`",
        ),
        _ => (
            "forces move coordinates of this mechanism, so its spread does not follow from its parameters at each instant",
            "name a motion without `free` coordinates with `--motion`, or write `drive` instead",
        ),
    };
    Problem(format!("error: {message}\n  = help: {help}"))
}

/// Checks that the values of all samples can be kept.
fn check_count(arguments: &Tolerance, of_sample: usize) -> Result<(), Problem> {
    let count = arguments.samples as usize;
    match count.saturating_mul(of_sample) > MAX_SAMPLED_VALUES {
        true => Err(Problem(format!(
            "error: {count} samples of {of_sample} values each are more than {MAX_SAMPLED_VALUES} values\n  = help: pass fewer with `--samples`, or a longer `--step`"
        ))),
        false => Ok(()),
    }
}

/// Returns the samples that the options describe.
fn samples<'a>(
    arguments: &Tolerance,
    spread: &'a StackUp,
) -> Result<ToleranceSamples<'a>, Problem> {
    let sampling = match arguments.sampling {
        SampleSequence::Sobol => Sampling::Sobol,
        SampleSequence::Random => Sampling::Random,
    };
    let samples = ToleranceSamples::new(&spread.toleranced, sampling, arguments.seed);
    samples.ok_or_else(|| {
        Problem(format!(
            "error: the tolerances vary {} numbers, and Sobol's sequence has {} dimensions\n  = help: pass `--sampling random`",
            spread.toleranced.len(),
            MAX_DIMENSIONS
        ))
    })
}

/// Solves the sampled mechanisms; `None` without samples.
fn sampled(
    arguments: &Tolerance,
    prepared: &Prepared,
    spread: &StackUp,
    samples: &ToleranceSamples<'_>,
    threads: usize,
) -> Option<SampledSpread> {
    let count = Some(arguments.samples).filter(|it| *it > 0)?;
    let mut progress = Progress::of_sets(u64::from(count));
    let stop = interruption::flag();
    let reached = |count| {
        progress.reached(count);
        !stop.load(Ordering::Relaxed)
    };
    let sampled = SampledSpread::new(prepared, spread, samples, count, threads, reached);
    progress.finish();
    Some(sampled)
}
