//! Writes `tests/reports/chains.md`: loss of accuracy by tearing along chains, in f64 and f32.

use std::error::Error;
use std::process::ExitCode;

use clap::Parser;
use linkwright_tests::chains::compiled::CHAINS;
use linkwright_tests::chains::measure::{COARSE, FINE, Measured, measure};
use linkwright_tests::chains::report::{errors, name, sweeps};
use linkwright_tests::stability::verdict::Scalar;
use linkwright_tests::study::destination::{Destination, ended};

/// Follows chains by way of their tears and by all equations at once and writes a report
#[derive(Parser)]
struct Arguments {
    #[command(flatten)]
    destination: Destination,
}

const EXPLANATION: &str = "\
The chain is a pantograph (`tests/src/pantograph.rs`): its first cell stands on the ground, its last one is driven. The
difference of both drivers turns its bar v, and all other angles are one block. That block is solved by way of one tear, and, where the
description says `monitor;`, by all equations at once. Both are `unguarded`, which changes no frame. Growth: how many times as large as
the one before it each cell is, to three digits, so that every number of the description is one of f32 and nothing but the solution is rounded. The truth is a closed form in 384 bits
(`tests/src/chains/truth.rs`) at the instants that the scalar was given.

**Mean**: the root of the mean square over all bars and frames, which says how much a way loses. **Largest**: the worst of them, which
depends on a single frame. Angles in rad, places in the length of the chain, and both per s and per s². **By tears**: the frames that
the torn chain found without all equations at once.

In f32 both ways leave an estimate from the last frame as it is wherever its residuals are below 4 ε in the length of the chain, which
counts as rounding, and drift within that band: there errors depend on the step more than on the way.
";

fn main() -> ExitCode {
    ended(run(&Arguments::parse()))
}

fn run(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    if !cfg!(feature = "long_chains") {
        return Err("the long chains are left out; run `cargo run --profile optimized -p linkwright-tests --features long_chains --bin chains`".into());
    }
    let environment = arguments.destination.environment();
    let (mut all, mut tables): (Vec<Measured>, String) = Default::default();
    for scalar in [Scalar::F64, Scalar::F32] {
        for sweep in [FINE, COARSE] {
            let chains = CHAINS.iter().map(|chain| measure(chain, scalar, sweep));
            let measured: Vec<Measured> = chains.collect();
            let title = format!("{}, steps of {} s", name(scalar), sweep.step);
            tables += &format!("## {title}\n\n{}\n", errors(measured.iter()));
            eprintln!("{title}");
            all.extend(measured);
        }
    }
    let counts = sweeps(&all);
    println!("{counts}");
    let largest = all.iter().map(Measured::largest_ratios);
    let [mean, largest] = largest.fold([0.0_f64; 2], |[mean, largest], [a, b]| {
        [mean.max(a), largest.max(b)]
    });
    let report = format!(
        "# Tears along chains\n\nWritten by `cargo run --profile optimized -p linkwright-tests --features long_chains --bin chains`.\n\n{}\n{EXPLANATION}\n\
         **By way of the tears errors are at most {mean:.2} times as large in the mean, and the largest at most {largest:.2} times.**\n\n\
         ## All sweeps\n\n{counts}\n{}\n",
        environment.lines(),
        tables.trim_end()
    );
    arguments.destination.write("chains.md", &report)?;
    Ok(())
}
