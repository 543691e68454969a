//! Writes `tests/reports/growth.md`: growth of time and size with the length of a chain of dyads.
//!
//! Run it in release, on an otherwise idle machine.

use std::error::Error;
use std::process::ExitCode;
use std::time::Duration;

use clap::Parser;
use linkwright_tests::dyad_chain;
use linkwright_tests::study::destination::{Destination, ended};
use linkwright_tests::study::exponent::fitted;
use linkwright_tests::study::growth::{Cost, Frames, Scratch, generate};
use linkwright_tests::study::table::aligned;

/// Measures how a chain of dyads grows and writes a report
#[derive(Parser)]
struct Arguments {
    /// Only up to 10 dyads and without the compiler
    #[arg(long)]
    short: bool,
    /// The largest number of dyads that is compiled and run [default: all]
    #[arg(long)]
    compile_up_to: Option<usize>,
    /// Seconds after which the compiler or a run is ended
    #[arg(long, default_value_t = 300)]
    limit: u64,
    #[command(flatten)]
    destination: Destination,
}

const EXPLANATION: &str = "\
The chain is described in `tests/src/dyad_chain.rs`: a crank and n dyads of coupler and rocker, 3 + 6 n coordinates. Generator: from
the text to the Rust, in one process, the fastest of several runs. Compiler: `cargo build --release` of the module alone, its
dependencies built before. Frames: positions, velocities and accelerations at the next instant, over 5 s in steps of 1 ms and of 10 ms, as
generated mechanisms do by default, guarded, and with `unguarded`; of each frame the fastest of three runs counts. The worst frame is one
in which the path guard looks ahead anew. A dash is what was not measured, failed, or did not end within the limit. Exponents: the
least-squares slope of the logarithms over all sizes, and the slope between the two largest, where what does not depend on n weighs least.
";

fn main() -> ExitCode {
    ended(run(&Arguments::parse()))
}

fn run(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    if cfg!(debug_assertions) {
        eprintln!("warning: not a release build; the times mean nothing");
    }
    let sizes: &[usize] = if arguments.short {
        &[1, 10]
    } else {
        &[1, 10, 100, 1000]
    };
    let limit = Duration::from_secs(arguments.limit);
    let environment = arguments.destination.environment();
    print!("{}", environment.lines());
    let scratch = if arguments.short {
        None
    } else {
        eprintln!("building the dependencies");
        Some(Scratch::new()?)
    };
    let mut costs = Vec::new();
    for &dyads in sizes {
        eprintln!("{dyads} dyads: generating");
        let (generator, code) = generate(dyad_chain::description(dyads));
        let compiled = arguments.compile_up_to.is_none_or(|most| dyads <= most);
        let (compiler, guarded, unguarded) = match &scratch {
            Some(scratch) if compiled => {
                eprintln!("{dyads} dyads: compiling and running");
                let (compiler, guarded) = scratch.measure(&code, limit)?;
                let (_, unguarded) = generate(dyad_chain::unguarded(dyads));
                (compiler, guarded, scratch.measure(&unguarded, limit)?.1)
            }
            _ => (None, None, None),
        };
        costs.push(Cost {
            dyads,
            generator,
            bytes: code.len(),
            compiler,
            guarded,
            unguarded,
        });
    }
    let [costs, frames] = [table(&costs, &COSTS), table(&costs, &FRAMES)];
    println!("\n{costs}\n{frames}");
    let report = format!(
        "# Growth with the size of a mechanism\n\nWritten by `cargo run --profile optimized -p linkwright-tests --bin growth`.\n\n{}- limit: {} s\n\n{EXPLANATION}\n{costs}\nFrames, ns:\n\n{frames}",
        environment.lines(),
        arguments.limit
    );
    arguments.destination.write("growth.md", &report)?;
    Ok(())
}

/// A measured quantity by its name, how it is printed, and how it is read.
type Quantity = (&'static str, fn(f64) -> String, fn(&Cost) -> Option<f64>);

/// The first column of both tables.
const DYADS: Quantity = ("dyads", whole, |it| Some(it.dyads as f64));

const COSTS: [Quantity; 4] = [
    DYADS,
    (
        "generator, ms",
        |it| format!("{:.2}", it * 1e3),
        |it| Some(it.generator),
    ),
    (
        "Rust, bytes",
        |it| format!("{it:.0}"),
        |it| Some(it.bytes as f64),
    ),
    ("compiler, s", |it| format!("{it:.2}"), |it| it.compiler),
];

/// Frames of a chain at the step of this index.
fn at(place: usize, frames: Option<[Frames; 2]>) -> Option<Frames> {
    frames.map(|frames| frames[place])
}

const FRAMES: [Quantity; 7] = [
    DYADS,
    ("guarded, 1 ms", whole, |it| Some(at(0, it.guarded)?.mean)),
    ("worst", whole, |it| Some(at(0, it.guarded)?.worst)),
    ("unguarded", whole, |it| Some(at(0, it.unguarded)?.mean)),
    ("guarded, 10 ms", whole, |it| Some(at(1, it.guarded)?.mean)),
    ("worst", whole, |it| Some(at(1, it.guarded)?.worst)),
    ("unguarded", whole, |it| Some(at(1, it.unguarded)?.mean)),
];

fn whole(value: f64) -> String {
    format!("{value:.0}")
}

fn table<const COLUMNS: usize>(costs: &[Cost], quantities: &[Quantity; COLUMNS]) -> String {
    let dash = || "–".to_string();
    let mut rows = vec![quantities.map(|(name, ..)| name.to_string())];
    for cost in costs {
        rows.push(quantities.map(|(_, print, value)| value(cost).map_or_else(dash, print)));
    }
    for (name, last) in [("exponent", usize::MAX), ("exponent of the last two", 2)] {
        let mut row = quantities.map(|(_, _, value)| {
            let points: Vec<(f64, f64)> = costs
                .iter()
                .filter_map(|cost| Some((cost.dyads as f64, value(cost)?)))
                .collect();
            let from = points.len().saturating_sub(last);
            fitted(&points[from..]).map_or_else(dash, |exponent| format!("{exponent:.2}"))
        });
        row[0] = name.to_string();
        rows.push(row);
    }
    aligned(&rows, 1)
}
