//! Writes `tests/reports/calibration.md`: how often calibration finds lengths within their intervals.

use std::error::Error;
use std::process::ExitCode;

use clap::Parser;
use linkwright_tests::calibration::{SEED, Study};
use linkwright_tests::study::destination::{Destination, ended};

/// Calibrates mechanisms from noisy points many times and writes a report
#[derive(Parser)]
struct Arguments {
    /// Number of trials of each mechanism
    #[arg(long, default_value_t = 10_000)]
    trials: u32,
    #[command(flatten)]
    destination: Destination,
}

/// Allowed shares within one and three deviations: normal errors have 68.3 % and 99.7 %.
const BOUNDS: [[f64; 2]; 2] = [[0.66, 0.70], [0.993, 0.999]];

/// Allowed shares of intervals of 95 %.
const HELD: [f64; 2] = [0.93, 0.97];

/// Steps to which values are rounded, in standard deviations of the noise.
const STEPS: [f64; 4] = [0.0, 0.3, 1.0, 3.0];

/// Steps for slow motion, in standard deviations of the noise.
const SLOW_STEPS: [f64; 3] = [1.0, 3.0, 10.0];

/// Divisor of the number of trials of slow motion, which take longer.
const SLOWER: u32 = 5;

const EXPLANATION: &str = "\
Points of each mechanism are solved with its own lengths, moved by normal noise and rounded to steps; lengths that are off by up to 2 % are
then fitted to them. **In 95 % interval**: how often the interval that the fit gives holds the truth. **Within 1 σ** and **within 3 σ**: how
often an estimate is that near to the truth, by the standard deviation that the fit gives, which knows nothing of the noise but what is
left. Of normal errors 68.27 % and 99.73 % are; of Student's distribution with as many values left over about a tenth less. **Trusted**:
how many fits noise explains, where neighboring rows alone tell the noise. The errors are in m. Of slow motion there is a fifth of the
trials, and lengths differ from trial to trial: with lengths that stay, errors of rounding would, too.
";

fn main() -> ExitCode {
    let outcome = run(&Arguments::parse()).and_then(|is_good| match is_good {
        true => Ok(()),
        false => Err("a share is out of its bounds".into()),
    });
    ended(outcome)
}

fn run(arguments: &Arguments) -> Result<bool, Box<dyn Error>> {
    let environment = arguments.destination.environment();
    let mut sections = String::new();
    let mut is_good = true;
    let studies = [
        (Study::four_bar(), &STEPS[..], 1),
        (Study::platform(), &STEPS, 1),
        (Study::slow(), &SLOW_STEPS, SLOWER),
    ];
    for (study, all_steps, slower) in studies {
        sections += &format!("\n## {}\n\nMeasured: {}.\n", study.name, study.measured);
        for &steps in all_steps {
            let coverage = study.coverage(arguments.trials / slower, steps);
            for place in 0..coverage.names.len() {
                is_good &= (HELD[0]..=HELD[1]).contains(&coverage.held(place));
                // Deviations by rounding are not those of normal errors.
                let shares = coverage.shares(place).into_iter().zip(BOUNDS);
                is_good &= shares
                    .into_iter()
                    .all(|(share, [low, high])| steps > 0.0 || (low..=high).contains(&share));
            }
            is_good &= coverage.failed == 0;
            let rounding = match steps > 0.0 {
                true => format!("Rounded to steps of {steps} σ"),
                false => "Not rounded".to_string(),
            };
            eprint!("{}, {rounding}\n{}", study.name, coverage.table());
            sections += &format!(
                "\n{rounding}: {} of {} trials failed, {} were trusted; one solved its motion {:.1} times on average.\n\n{}",
                coverage.failed,
                coverage.trials,
                coverage.trusted,
                coverage.evaluations as f64 / f64::from(coverage.trials.max(1)),
                coverage.table()
            );
        }
    }
    let report = format!(
        "# Calibration\n\nWritten by `cargo run --profile optimized -p linkwright-tests --bin calibration`.\n\n{}- trials: {} of each mechanism, \
         seeds from {SEED:#x} on\n\n{EXPLANATION}{sections}",
        environment.lines(),
        arguments.trials,
    );
    arguments.destination.write("calibration.md", &report)?;
    Ok(is_good)
}
