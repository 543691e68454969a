//! How time and size grow with the length of a chain of dyads: `tests/reports/growth.md`.
//!
//! Run it in release, on an otherwise idle machine.

use std::error::Error;
use std::process::ExitCode;
use std::time::Duration;

use clap::Parser;
use linkwright_tests::study::destination::{Destination, ended};
use linkwright_tests::study::exponent::fitted;
use linkwright_tests::study::growth::{Cost, Scratch, generate};
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
    /// How long the compiler or a run may take before it is ended, in s
    #[arg(long, default_value_t = 300)]
    limit: u64,
    #[command(flatten)]
    destination: Destination,
}

const EXPLANATION: &str = "\
The chain is described in `tests/src/dyad_chain.rs`: a crank and n dyads of coupler and rocker, 3 + 6 n coordinates. Generator: from
the text to the Rust, in one process, the fastest of several runs. Compiler: `cargo build --release` of the module alone, its
dependencies built before. Frame: positions, velocities and accelerations at the next instant, as generated mechanisms do by
default. A dash is what was not measured, failed, or did not end within the limit. Exponents: the least-squares slope of the logarithms over
all sizes, and the slope between the two largest, where what does not depend on n weighs least.
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
        let (generator, code) = generate(dyads);
        let compiled = arguments.compile_up_to.is_none_or(|most| dyads <= most);
        let (compiler, frame) = match &scratch {
            Some(scratch) if compiled => {
                eprintln!("{dyads} dyads: compiling and running");
                scratch.measure(&code, limit)?
            }
            _ => (None, None),
        };
        costs.push(Cost {
            dyads,
            generator,
            bytes: code.len(),
            compiler,
            frame,
        });
    }
    let table = table(&costs);
    println!("\n{table}");
    let report = format!(
        "# Growth with the size of a mechanism\n\nWritten by `cargo run --profile optimized -p linkwright-tests --bin growth`.\n\n{}- limit: {} s\n\n{EXPLANATION}\n{table}",
        environment.lines(),
        arguments.limit
    );
    arguments.destination.write("growth.md", &report)?;
    Ok(())
}

/// A measured quantity by its name, how it is printed, and how it is read.
type Quantity = (&'static str, fn(f64) -> String, fn(&Cost) -> Option<f64>);

const QUANTITIES: [Quantity; 4] = [
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
    ("frame, ns", |it| format!("{it:.0}"), |it| it.frame),
];

fn table(costs: &[Cost]) -> String {
    let dash = || "–".to_string();
    let mut rows = vec![std::array::from_fn::<String, 5, _>(|column| {
        if column == 0 {
            "dyads".to_string()
        } else {
            QUANTITIES[column - 1].0.to_string()
        }
    })];
    for cost in costs {
        rows.push(std::array::from_fn(|column| {
            if column == 0 {
                return cost.dyads.to_string();
            }
            let (_, print, value) = QUANTITIES[column - 1];
            value(cost).map_or_else(dash, print)
        }));
    }
    for (name, last) in [("exponent", usize::MAX), ("exponent of the last two", 2)] {
        rows.push(std::array::from_fn(|column| {
            if column == 0 {
                return name.to_string();
            }
            let (_, _, value) = QUANTITIES[column - 1];
            let points: Vec<(f64, f64)> = costs
                .iter()
                .filter_map(|cost| Some((cost.dyads as f64, value(cost)?)))
                .collect();
            let from = points.len().saturating_sub(last);
            fitted(&points[from..]).map_or_else(dash, |exponent| format!("{exponent:.2}"))
        }));
    }
    aligned(&rows, 1)
}
