//! Proofs of whole motions beside exact solutions at random instants: `tests/reports/proofs.md`.

use std::error::Error;
use std::fmt::Write;
use std::process::ExitCode;

use clap::Parser;
use linkwright_tests::study::destination::{Destination, ended};
use linkwright_tests::study::table::aligned;
use linkwright_tests::{description, proofs, reference};

/// Compares the proven bounds of the gallery's motions with exact solutions and writes a report
#[derive(Parser)]
struct Arguments {
    /// Number of random instants for each mechanism
    #[arg(long, default_value_t = 1000)]
    instants: usize,
    /// End of the motions (s)
    #[arg(long, default_value_t = 5.0)]
    to: f64,
    #[command(flatten)]
    destination: Destination,
}

const EXPLANATION: &str = "\
`linkwright check --prove` of every mechanism with a reference and without tables, all points. At random instants the textbook equations
are solved by Newton-Raphson in 384 bits, and every coordinate and both components of every point are compared with their proven bounds
to 1e-60; normalized determinants in f64. Determinant: the smallest ratio of a proven bound to the minimum that was located.
Wider: by which part of what frames sweep the loosest range is wider than that.
";

fn main() -> ExitCode {
    let outcome = run(&Arguments::parse()).and_then(|is_good| match is_good {
        true => Ok(()),
        false => Err("a number is out of its bounds".into()),
    });
    ended(outcome)
}

/// True if all values are within their bounds.
fn run(arguments: &Arguments) -> Result<bool, Box<dyn Error>> {
    let environment = arguments.destination.environment();
    let mut rows = vec![proofs::TITLES.map(str::to_string)];
    let mut notes = String::new();
    let mut is_good = true;
    for (name, _) in reference::REFERENCES {
        let derived = description::system(name);
        if derived.pool.graph.splines().next().is_some() {
            continue;
        }
        let verdict = proofs::judged(&derived, [0.0, arguments.to], arguments.instants);
        let proof = &verdict.proof;
        if let Some(unproven) = &proof.unproven {
            writeln!(
                notes,
                "- {name} is not proven: from t = {} s: {}",
                unproven.window[0], unproven.reason
            )?;
        }
        for outside in &verdict.outside {
            writeln!(notes, "- {name}, outside: {outside}")?;
        }
        is_good &= verdict.outside.is_empty();
        rows.push(verdict.row(name));
        println!("{name}: {:?}", rows.last());
    }
    let report = format!(
        "# Proofs of whole motions\n\nWritten by `cargo run --profile optimized -p linkwright-tests --bin proofs`.\n\n{}- instants: {} each, \
         up to {} s\n\n{EXPLANATION}\n{}\n{notes}",
        environment.lines(),
        arguments.instants,
        arguments.to,
        aligned(&rows, 1),
    );
    arguments.destination.write("proofs.md", &report)?;
    Ok(is_good)
}
