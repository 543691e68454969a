//! How often calibration finds the lengths of mechanisms within what it says: `tests/reports/calibration.md`.

use std::error::Error;
use std::process::ExitCode;

use clap::Parser;
use linkwright_tests::calibration::{SEED, Study};
use linkwright_tests::study::destination::{Destination, ended};

/// Calibrates mechanisms from noisy points many times and writes a report
#[derive(Parser)]
struct Arguments {
    /// How many trials there are of each mechanism
    #[arg(long, default_value_t = 10_000)]
    trials: u32,
    #[command(flatten)]
    destination: Destination,
}

/// What the shares have to be: 68.3 % and 99.7 % of normal errors are.
const BOUNDS: [[f64; 2]; 2] = [[0.66, 0.70], [0.993, 0.999]];

const EXPLANATION: &str = "\
Points of each mechanism are solved with its own lengths and moved by normal noise; lengths that are off by up to 2 % are then fitted to
them. **Within 1 σ** and **within 3 σ**: how often an estimate is that near to the truth, by the standard deviation that the fit itself
says, which knows nothing of the noise but what is left. Of normal errors 68.27 % and 99.73 % are; of Student's distribution with as many
values left over about a tenth less. The errors are in m.
";

fn main() -> ExitCode {
    let found = run(&Arguments::parse()).and_then(|is_good| match is_good {
        true => Ok(()),
        false => Err("a share is out of its bounds".into()),
    });
    ended(found)
}

fn run(arguments: &Arguments) -> Result<bool, Box<dyn Error>> {
    let environment = arguments.destination.environment();
    let mut sections = String::new();
    let mut is_good = true;
    for study in [Study::four_bar(), Study::platform()] {
        let found = study.coverage(arguments.trials);
        for place in 0..found.names.len() {
            let shares = found.shares(place).into_iter().zip(BOUNDS);
            is_good &= shares
                .into_iter()
                .all(|(share, [low, high])| (low..=high).contains(&share));
        }
        is_good &= found.failed == 0;
        eprint!("{}\n{}", study.name, found.table());
        sections += &format!(
            "\n## {}\n\nMeasured: {}. {} of {} trials failed; one solved its motion {:.1} times on average.\n\n{}",
            study.name,
            study.measured,
            found.failed,
            found.trials,
            found.evaluations as f64 / f64::from(found.trials.max(1)),
            found.table()
        );
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
