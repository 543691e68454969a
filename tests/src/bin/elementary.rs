//! The errors of the elementary functions: `tests/reports/elementary.md`.
//!
//! f32: every finite number. f64: samples. Run it in release.

use std::error::Error;
use std::process::ExitCode;
use std::thread;

use clap::Parser;
use linkwright_tests::elementary::{
    Angles, Worst, angle, followed, sine_and_cosine, single_angle, single_sine_and_cosine, vector,
};
use linkwright_tests::random::Random;
use linkwright_tests::study::destination::{Destination, ended};

/// Measures the errors of the elementary functions and writes a report
#[derive(Parser)]
struct Arguments {
    /// Number of f64 of each kind
    #[arg(long, default_value_t = 200_000)]
    samples: u32,
    #[command(flatten)]
    destination: Destination,
}

const EXPLANATION: &str = "\
Largest errors in ulps, the distance of the two floats between which the exact result lies; half an ulp is the best there is. f64 is
compared with 384-bit arithmetic, f32 with the f64 of the C library. Angles that are followed are measured in ε of their magnitude, or
of π/4 where that is larger. What is negative has the same errors: sine is odd and cosine even to the last bit.
";

/// The numbers between which the sweep over all f32 is divided.
const BANDS: [(f32, &str); 3] = [
    (0.785, "up to π/4"),
    (8192.0, "up to 8192"),
    (f32::INFINITY, "beyond"),
];

fn main() -> ExitCode {
    ended(run(&Arguments::parse()))
}

fn run(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    let mut rows = Vec::new();
    let mut row = |function: &str, scalar: &str, arguments: &str, worst: Worst| {
        let [a, b] = worst.arguments;
        let at = if b == 0.0 {
            format!("{a:e}")
        } else {
            format!("{a:e}, {b:e}")
        };
        let error = worst.error;
        let line = format!(
            "| {function} | {scalar} | {arguments} | {} | {error:.4} | {at} |",
            worst.count
        );
        eprintln!("{line}");
        rows.push(line);
    };
    let mut from = 0;
    for (end, name) in BANDS {
        let worst = sweep(from, end.to_bits())?;
        from = end.to_bits();
        for (function, worst) in ["sine", "cosine"].into_iter().zip(worst) {
            row(function, "f32", &format!("all {name}"), worst);
        }
    }
    let mut random = Random::new(14);
    for (angles, name) in Angles::LIST {
        let mut worst = [Worst::default(); 2];
        for _ in 0..arguments.samples {
            sine_and_cosine(angles.next(&mut random), &mut worst);
        }
        for (function, worst) in ["sine", "cosine"].into_iter().zip(worst) {
            row(function, "f64", name, worst);
        }
    }
    let (mut wide, mut narrow, mut near) =
        (Worst::default(), Worst::default(), [Worst::default(); 2]);
    for _ in 0..arguments.samples {
        angle(vector(&mut random), &mut wide);
        followed(&mut random, &mut near);
        for _ in 0..100 {
            let bits = random.bits();
            let any = [bits as u32, (bits >> 32) as u32].map(f32::from_bits);
            let ordinary = vector(&mut random).map(|component| component as f32);
            for vector in [any, ordinary] {
                if vector.iter().all(|component| component.is_finite()) {
                    single_angle(vector, &mut narrow);
                }
            }
        }
    }
    row("angle of a vector", "f32", "ordinary, and any", narrow);
    row("angle of a vector", "f64", "ordinary, and any", wide);
    row("angle that is followed", "f32", "up to 1000", near[1]);
    row("angle that is followed", "f64", "up to 1000", near[0]);

    let environment = arguments.destination.environment();
    let report = format!(
        "# Errors of the elementary functions\n\nWritten by `cargo run --profile optimized -p linkwright-tests --bin elementary`.\n\n{}\n{EXPLANATION}\n| function | scalar | arguments | count | ulps | at |\n|---|---|---|--:|--:|---|\n{}\n",
        environment.lines(),
        rows.join("\n")
    );
    arguments.destination.write("elementary.md", &report)?;
    Ok(())
}

/// All f32 from one to before another, by their bits, on all cores.
fn sweep(from: u32, end: u32) -> Result<[Worst; 2], Box<dyn Error>> {
    let parts = thread::available_parallelism().map_or(1, usize::from) as u32;
    let part = (end - from).div_ceil(parts);
    let workers: Vec<_> = (0..parts)
        .map(|place| {
            let start = from + place * part;
            let stop = start.saturating_add(part).min(end);
            thread::spawn(move || {
                let mut worst = [Worst::default(); 2];
                for bits in start..stop {
                    single_sine_and_cosine(f32::from_bits(bits), &mut worst);
                }
                worst
            })
        })
        .collect();
    let mut all = [Worst::default(); 2];
    for worker in workers {
        let worst = worker.join().map_err(|_| "a sweep ended early")?;
        for (all, worst) in all.iter_mut().zip(worst) {
            all.merge(worst);
        }
    }
    Ok(all)
}
