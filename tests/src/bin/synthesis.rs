//! Writes `tests/reports/synthesis.md`: published cases of path synthesis, with errors, times and certificates.

use std::error::Error;
use std::process::ExitCode;
use std::thread;
use std::time::Instant;

use clap::Parser;
use linkwright_calibrate::StartSampling;
use linkwright_tests::study::destination::{Destination, ended};
use linkwright_tests::synthesis::{CASES, Case, Solved};

/// Solves published cases of path synthesis and writes a report
#[derive(Parser)]
struct Arguments {
    /// Number of sampled mechanisms
    #[arg(long, default_value_t = 65_536)]
    samples: u32,
    /// Number of fits
    #[arg(long, default_value_t = 1000)]
    fits: usize,
    /// Number of seeds, from 0 on
    #[arg(long, default_value_t = 5)]
    seeds: u64,
    #[command(flatten)]
    destination: Destination,
}

/// Number of candidates that are brought to their minima.
const CANDIDATES: usize = 32;

/// Largest error of a case that can be solved exactly.
const ZERO_ERROR: f64 = 1e-12;

/// Excess over a published error that the rounding of printed designs explains.
const ROUNDED: f64 = 1e-6;

const EXPLANATION: &str = "\
The points are those of Cabrera, Simon and Prado 2002 (Optimal synthesis of mechanisms with genetic algorithms, Mech. Mach. Theory 37) and
Acharyya and Mandal 2009 (Performance of EAs for four-bar linkage synthesis, Mech. Mach. Theory 44). The error is the sum of the squared
distances. **Published** is the error of the best published design that could be found with its numbers: it was computed from these numbers
by the intersection of two circles, as **this** error was. Errors that are quoted without a design are not listed. The cranks of all designs turn
round. **Seeds** is the number of those of which each alone reaches the published error, and the time is the median of one. The certificate is
a proof that the mechanism moves on one smooth path over a full turn; the sine is that between coupler and rocker where they come closest to
being in line.

The designs are from W.-Y. Lin, from J. A. Cabrera, A. Ortiz, F. Nadal and J. J. Castillo 2011 (An evolutionary algorithm for path synthesis of
mechanisms, Mech. Mach. Theory 46), and from S. Nguyen-Van, Q. X. Lieu, N. Xuan-Mung and T. T. N. Nguyen 2022 (Symmetry 14, 381), beside whose program
they are reprinted. The first case has fifteen unknowns and twelve equations; others also report errors of rounding.
";

fn main() -> ExitCode {
    let outcome = run(&Arguments::parse()).and_then(|is_good| match is_good {
        true => Ok(()),
        false => Err("an error is larger than the published one, or a design is not proven".into()),
    });
    ended(outcome)
}

fn run(arguments: &Arguments) -> Result<bool, Box<dyn Error>> {
    let environment = arguments.destination.environment();
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let mut table = "| case | published | this | seeds | time (s) | certificate | smallest sine |\n|---|---|---|---|---|---|---|\n".to_string();
    let mut designs = String::new();
    let mut is_good = true;
    for case in &CASES {
        let mut best: Option<Solved> = None;
        let (mut reached, mut seconds) = (0, Vec::new());
        for seed in 0..arguments.seeds {
            let sampling = StartSampling {
                count: arguments.samples,
                fits: arguments.fits,
                seed,
            };
            let begin = Instant::now();
            let solved = case
                .solved(sampling, CANDIDATES, threads)
                .ok_or("no solution")?;
            seconds.push(begin.elapsed().as_secs_f64());
            reached += usize::from(solved.error <= largest(case));
            if best.as_ref().is_none_or(|it| solved.error < it.error) {
                best = Some(solved);
            }
        }
        let solved = best.ok_or("no seed")?;
        seconds.sort_by(f64::total_cmp);
        let seconds = seconds[seconds.len() / 2];
        let certificate = case.certificate(&solved);
        let is_proven = certificate.proof.proven.is_some();
        is_good &= is_proven && solved.error <= largest(case);
        let sine = certificate.check.smallest_measure();
        table += &format!(
            "| {} | {:.4e} | {:.4e} | {reached} | {seconds:.1} | {} | {:.4} |\n",
            case.name,
            case.published_error(),
            solved.error,
            match is_proven {
                true => format!("proven, {} windows", certificate.proof.windows),
                false => "not proven".to_string(),
            },
            sine.unwrap_or(f64::NAN),
        );
        let [r1, r2, r3, r4] = solved.design.links;
        let [cx, cy] = solved.design.point;
        let [x0, y0, tilt] = solved.design.ground;
        let first = solved.angles[0];
        designs += &format!(
            "| {} | {r1:.9} | {r2:.9} | {r3:.9} | {r4:.9} | {cx:.9} | {cy:.9} | {x0:.9} | {y0:.9} | {tilt:.9} | {first:.9} |\n",
            case.name
        );
        eprint!("{table}");
    }
    let sources: String = CASES
        .iter()
        .map(|it| format!("- {}: {}\n", it.name, it.published.source))
        .collect();
    let report = format!(
        "# Synthesis\n\nWritten by `cargo run --profile optimized -p linkwright-tests --bin synthesis`.\n\n{}- search: {} samples, {} fits, {threads} threads, \
         {} seeds\n\n{EXPLANATION}\n{table}\nPublished designs:\n\n{sources}\n## Designs\n\nr1 to r4 are ground link, crank, coupler and rocker; cx and cy are the coupler point along and across \
         the coupler; x0, y0 and the angle θ0 place the ground link; θ2 is the angle of the crank against it at the first point (rad).\n\n\
         | case | r1 | r2 | r3 | r4 | cx | cy | x0 | y0 | θ0 | θ2 |\n|---|---|---|---|---|---|---|---|---|---|---|\n{designs}",
        environment.lines(),
        arguments.samples,
        arguments.fits,
        arguments.seeds,
    );
    arguments.destination.write("synthesis.md", &report)?;
    Ok(is_good)
}

fn largest(case: &Case) -> f64 {
    match case.is_exact {
        true => ZERO_ERROR,
        false => case.published_error() * (1.0 + ROUNDED),
    }
}
