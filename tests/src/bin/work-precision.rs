//! Error against run time of every mechanism with a reference and every method: `tests/reports/work-precision.md` with charts.
//!
//! Run it in release, on an otherwise idle machine.

use std::error::Error;
use std::fmt::Write as _;
use std::process::ExitCode;

use clap::Parser;
use linkwright_tests::method::studied;
use linkwright_tests::reference;
use linkwright_tests::study::destination::{Destination, ended};
use linkwright_tests::study::measurement::{Effort, measure};
use linkwright_tests::study::{chart, outputs, table};

/// Measures error against run time and writes a report with charts
#[derive(Parser)]
struct Arguments {
    /// Measure briefly: the numbers are rough, everything else is as always
    #[arg(long)]
    short: bool,
    #[command(flatten)]
    destination: Destination,
    /// Only these mechanisms, separated by commas [default: all with a reference]
    #[arg(long, value_delimiter = ',')]
    only: Vec<String>,
}

const EXPLANATION: &str = "\
A frame is one step of 0.01 s of a sweep over 0 to 5 s: positions, velocities and accelerations of all bodies. Errors are the
largest over the reference's times (every 0.5 s) and all coordinates, each in the largest magnitude of its column. Times are
medians; repeats go round the methods. The baseline is the dense solver in `tests/src/baseline`: a `Vec` of joint objects that
fills a `DMatrix`, nalgebra's LU, a predictor, stop at max |Φ| ≤ 1e-12. The textbook solves all
equations as one dense system; the closed form is the solved view, and block Newton is the solved view where a block has no closed
form. A setting is the tolerance of scaled residuals; polishing is one more step after that.
";

fn main() -> ExitCode {
    ended(run(&Arguments::parse()))
}

fn run(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    if cfg!(debug_assertions) {
        eprintln!("warning: not a release build; the times mean nothing");
    }
    let known = |name: &String| studied().any(|it| it == name);
    if let Some(unknown) = arguments.only.iter().find(|name| !known(name)) {
        return Err(format!("`{unknown}` is not compared with the baseline").into());
    }
    let effort = if arguments.short {
        Effort {
            repeats: 3,
            shortest: 0.0,
        }
    } else {
        Effort {
            repeats: 21,
            shortest: 0.01,
        }
    };
    let folder = arguments.destination.folder()?;
    let environment = arguments.destination.environment();
    let mut report = format!(
        "# Error against run time\n\nWritten by `cargo run --profile optimized -p linkwright-tests --bin work-precision`.\n\n{}- repeats: {}\n\n{EXPLANATION}",
        environment.lines(),
        effort.repeats
    );
    print!("{}", environment.lines());
    for name in studied() {
        if !arguments.only.is_empty() && !arguments.only.iter().any(|it| it == name) {
            continue;
        }
        let file = reference::file(name);
        let measurements = measure(name, effort, |message| eprintln!("{name}: {message}"));
        let baseline = measurements[0].time;
        let table = table::markdown(&measurements, baseline);
        println!("\n{name}\n{table}");
        let image = format!("work-precision-{name}.svg");
        chart::draw(&folder.join(&image), name, &measurements)?;
        write!(
            report,
            "\n## {name}\n\nReference: `tests/data/{file}`.\n\n{table}\n![{name}]({image})\n"
        )?;
    }
    if arguments.only.is_empty() {
        let section = outputs::section(effort);
        println!("{section}");
        report.push_str(&section);
    }
    arguments.destination.write("work-precision.md", &report)?;
    Ok(())
}
