//! Writes `tests/reports/synthesis.md`: published cases of path synthesis, with errors, times and certificates.

use std::error::Error;
use std::process::ExitCode;
use std::time::Instant;

use clap::Parser;
use linkwright_calibrate::StartSampling;
use linkwright_tests::synthesis::CASES;

/// Solves published cases of path synthesis and writes a report
#[derive(Parser)]
struct Arguments {
    /// Number of sampled mechanisms
    #[arg(long, default_value_t = 65_536)]
    starts: u32,
    /// Number of fits
    #[arg(long, default_value_t = 400)]
    fits: usize,
    /// Seed
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Case
    #[arg(long)]
    case: Option<usize>,
}

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let arguments = Arguments::parse();
    for (place, case) in CASES.iter().enumerate() {
        if arguments.case.is_some_and(|it| it != place) {
            continue;
        }
        let begin = Instant::now();
        let sampling = StartSampling {
            count: arguments.starts,
            fits: arguments.fits,
            seed: arguments.seed,
        };
        let synthesis = case.synthesis(2);
        let (found, counts) = synthesis.search(
            sampling,
            8,
            &std::sync::atomic::AtomicBool::new(false),
            &|_| (),
        );
        println!("{}: {counts:?} in {:?}", case.name, begin.elapsed());
        for it in found {
            println!(
                "  {:.6e} {} {:?} {:?} {:?}",
                it.squares, it.is_converged, it.modes.closed, it.values, it.times
            );
        }
    }
    Ok(ExitCode::SUCCESS)
}
