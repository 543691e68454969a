//! Writes `tests/reports/lanes.md`: times of mechanisms alone, in lanes and in batches.
//!
//! Run it in release, on an otherwise idle machine.

use std::error::Error;
use std::process::ExitCode;

use clap::Parser;
use linkwright_tests::lanes::modules::{Package, SETS, Table};
use linkwright_tests::lanes::{Measured, batches, measured};
use linkwright_tests::study::destination::{Destination, ended};
use linkwright_tests::study::table::aligned;

/// Times mechanisms in lanes and writes a report
#[derive(Parser)]
struct Arguments {
    /// Only the four-bar
    #[arg(long)]
    short: bool,
    #[command(flatten)]
    destination: Destination,
}

const EXPLANATION: &str = "\
Times are ns a pose, with velocities and accelerations. All figures are of one run on one thread; each is the fastest of several sweeps. A
sweep goes forth and back over 500 instants. `dyads_n` is the chain of n dyads in `tests/src/dyad_chain.rs`.

Generated modules are compiled once for each instruction set, by `-C target-cpu`; `alone` is one mechanism that is advanced with the same
compiler options. Lanes are 8 in f64 and 16 in f32. Guarded poses are proven to lie on the path, as generated mechanisms do by default. With the
feature `simd` of the runtime the widest set is chosen at run time, with registers of 512 bits, where compilers for `x86-64-v4` use 256.
";

fn main() -> ExitCode {
    ended(run(&Arguments::parse()))
}

fn run(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    if cfg!(debug_assertions) {
        eprintln!("warning: not a release build; the times mean nothing");
    }
    let mut all = measured();
    if arguments.short {
        all.retain(|it| it.name == "four_bar");
    }
    let environment = arguments.destination.environment();
    print!("{}", environment.lines());
    let package = Package::new(&all)?;
    let mut sets = Vec::new();
    for (name, processor) in SETS {
        eprintln!("{name}: compiling and running");
        match package.measure(processor)? {
            Some(table) => sets.push((name, table)),
            None => eprintln!("{name}: this machine has other instructions"),
        }
    }
    let mut report = format!(
        "# Lanes\n\nWritten by `cargo run --profile optimized -p linkwright-tests --bin lanes`.\n\n{}\n{EXPLANATION}",
        environment.lines()
    );
    for scalar in ["f64", "f32"] {
        for kind in ["guarded", "unguarded"] {
            let table = generated(&all, &sets, scalar, kind);
            println!("\n{scalar}, {kind}\n{table}");
            report += &format!("\n## Generated, {scalar}, {kind}\n\n{table}");
        }
    }
    let table = interpreted(&all);
    println!("\n{table}");
    report += &format!(
        "\n## Interpreter, f64, guarded\n\nBatches have 512 sets of 200 instants. The first result is that of eight sets, from the text of the description.\n\n{table}"
    );
    arguments.destination.write("lanes.md", &report)?;
    Ok(())
}

/// Times of generated modules: for each instruction set alone and in lanes, with their ratio.
fn generated(all: &[Measured], sets: &[(&str, Table)], scalar: &str, kind: &str) -> String {
    let mut head = vec!["mechanism".to_string()];
    for (set, _) in sets {
        head.extend([
            format!("{set}, alone"),
            "lanes".to_string(),
            "ratio".to_string(),
        ]);
    }
    let mut rows = vec![head];
    for it in all {
        let mut row = vec![it.name.clone()];
        for (_, table) in sets {
            let times = table[&format!("{}_{scalar}_{kind}", it.name)];
            row.extend([
                format!("{:.1}", times.alone),
                format!("{:.1}", times.lanes),
                format!("{:.2}", times.alone / times.lanes),
            ]);
        }
        rows.push(row);
    }
    aligned(&rows, 1)
}

/// Times of the interpreter, with ratios to one mechanism at a time and to one thread.
fn interpreted(all: &[Measured]) -> String {
    let head = [
        "mechanism",
        "alone",
        "batch",
        "ratio",
        "two threads",
        "ratio to one",
        "first result, ms",
    ];
    let mut rows = vec![head.map(str::to_string)];
    for it in all {
        eprintln!("{}: interpreting", it.name);
        let times = batches::measure(&it.guarded, it.step);
        let [one, two] = times.batches;
        rows.push([
            it.name.clone(),
            format!("{:.1}", times.alone),
            format!("{one:.1}"),
            format!("{:.2}", times.alone / one),
            format!("{two:.1}"),
            format!("{:.2}", one / two),
            format!("{:.2}", times.first),
        ]);
    }
    aligned(&rows, 1)
}
