//! Hunts for frames off the path among mechanisms that are hard to follow: `tests/reports/paths.md`.

use std::error::Error;
use std::process::ExitCode;
use std::time::Instant;

use clap::Parser;
use linkwright_tests::hunt::paths::families::{FAMILIES, course};
use linkwright_tests::hunt::paths::report;
use linkwright_tests::hunt::paths::run::prepare;
use linkwright_tests::hunt::paths::tally::Tally;
use linkwright_tests::study::destination::{Destination, ended, none_wrong};

/// Moves mechanisms that are hard to follow in steps of every size, and writes a report
#[derive(Parser)]
struct Arguments {
    /// Seed of the random numbers
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Number of mechanisms of each family
    #[arg(long, default_value_t = 50)]
    count: u64,
    /// Only this family, by its number; no report is written
    #[arg(long)]
    family: Option<usize>,
    /// Only this mechanism of the family, which is printed
    #[arg(long, requires = "family")]
    only: Option<u64>,
    #[command(flatten)]
    destination: Destination,
}

fn main() -> ExitCode {
    ended(hunt(&Arguments::parse()).and_then(none_wrong))
}

fn hunt(arguments: &Arguments) -> Result<usize, Box<dyn Error>> {
    let start = Instant::now();
    let mut tally = Tally::default();
    let numbers = match arguments.only {
        Some(number) => number..number + 1,
        None => 0..arguments.count,
    };
    let families = (0..FAMILIES.len()).filter(|it| arguments.family.is_none_or(|only| only == *it));
    for family in families {
        for number in numbers.clone() {
            if arguments.only.is_some() {
                print!("{}", course(family, arguments.seed, number).text);
            }
            if let Some(hunted) = prepare(family, arguments.seed, number, 1.0, &mut tally) {
                hunted.interpret(&mut tally);
            }
        }
        let total = tally.total();
        eprintln!(
            "{}: {} solves so far, {} wrong, {:.0} s",
            FAMILIES[family].0,
            total.solves,
            total.wrong(),
            start.elapsed().as_secs_f64()
        );
    }
    let summary = report::summary(&tally, start.elapsed().as_secs_f64());
    println!("{summary}");
    print!("{}", report::wrong(&tally, arguments.seed, 40));
    if arguments.family.is_some() {
        print!("{}\n{}", report::outcomes(&tally), report::refusals(&tally));
        return Ok(tally.total().wrong());
    }
    let command = format!(
        "cargo run --profile optimized -p linkwright-tests --bin hunt-paths -- --seed {} --count {}",
        arguments.seed, arguments.count
    );
    let environment = arguments.destination.environment().lines();
    let report = report::report(&tally, arguments.seed, &command, &environment, &summary);
    arguments.destination.write("paths.md", &report)?;
    Ok(tally.total().wrong())
}
