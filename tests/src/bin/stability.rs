//! Writes `tests/reports/stability.md`: errors on hard cases, beside those that condition and rounding allow.

use std::error::Error;
use std::fmt::Write as _;
use std::process::ExitCode;

use clap::Parser;
use linkwright_tests::stability::chart::draw;
use linkwright_tests::stability::families::families;
use linkwright_tests::stability::report::{Counts, WAYS, cell, judged};
use linkwright_tests::stability::texts;
use linkwright_tests::stability::verdict::Scalar;
use linkwright_tests::study::destination::{Destination, ended, none_wrong};

/// Solves hard cases in every way and writes a report
#[derive(Parser)]
struct Arguments {
    #[command(flatten)]
    destination: Destination,
}

const EXPLANATION: &str = "\
Each row is a motion (or one instant), each cell one way to solve it. `followed` is the textbook view assembled with
`assemble_from_rough_estimate` and moved with `follow`, which promise the path and its branch; `plain` is `assemble` and `advance`, which
promise a pose but not which; the third column is the generated mechanism, `assemble_with` and `advance`.

A cell `3e-16 (2e-16) ≤ 4e-15, 0.12` says that the worst coordinate of all instants is off by 3e-16 (lengths in the size of the
mechanism, angles in rad), that 2e-16 was expected, that it cannot be off by more than 4e-15, and that the largest ratio of an
error to its bound, over q, q̇, q̈ and all instants, is 0.12. `no digits`: the bound leaves less than three. A cell with a name is a
typed failure, `after 3` instants within their bounds, with its cause in parentheses; `no pose`: there is none.

**The truth** is the solution of the description's equations with exactly the numbers that the scalar was given, by
Newton-Raphson in 384 bits (`tests/src/stability/truth.rs`).
**The bound** is made of nothing that was measured. Of the textbook view it is |Φ_q⁻¹| times what each row may be off: its own
rounding by running error analysis, and what the solver lets pass as rounding; component by component, with the change of Φ_q
within the error, and for the rates the roundings of the elimination (`tests/src/stability/dense.rs`). Of the generated view
it follows statement by statement from the operations that its blocks perform (`tests/src/stability/blocks.rs`); that the
same statements in 384 bits lead to the exact motion is checked on the way. **What was expected** is the standard deviation
of the same roundings, independent and evenly distributed; what the solver lets pass is not counted in it.
";

fn main() -> ExitCode {
    ended(run(&Arguments::parse()).and_then(none_wrong))
}

fn run(arguments: &Arguments) -> Result<usize, Box<dyn Error>> {
    let environment = arguments.destination.environment();
    let folder = arguments.destination.folder()?;
    let mut counts = Counts::default();
    let mut body = String::new();
    for (index, family) in families().into_iter().enumerate() {
        let judged = judged(family, 1);
        eprintln!("{}", judged.family.title);
        for verdicts in &judged.verdicts {
            for (way, verdict) in verdicts.iter().enumerate() {
                let scalar = [Scalar::F64, Scalar::F32][way / (WAYS / 2)];
                counts.add(verdict, scalar);
            }
        }
        let family = &judged.family;
        let wrong = judged.verdicts.iter().flatten().filter(|it| it.is_wrong());
        for verdict in wrong.take(3) {
            eprintln!("  {verdict:?}");
        }
        write!(body, "\n## {}\n\n{}", family.title, judged.table())?;
        let file = format!("stability-{:02}.svg", index + 1);
        if draw(
            &folder.join(&file),
            family.title,
            family.varies,
            &judged.series(),
        )? {
            write!(body, "\n![{}]({file})\n", family.title)?;
        }
    }
    write!(
        body,
        "\n## Numbers in the text of a description\n\nThe textbook view in f64, interpreted.\n\n| case | outcome |\n|---|---|\n"
    )?;
    for (name, text) in texts::cases() {
        let (verdict, refused) = texts::judged(&text);
        counts.add(&verdict, Scalar::F64);
        let words = refused.unwrap_or_else(|| cell(&verdict));
        writeln!(body, "| {name} | {words} |")?;
    }
    let summary = counts.summary();
    println!("{summary}");
    let report = format!(
        "# Stability\n\nWritten by `cargo run --profile optimized -p linkwright-tests --bin stability`.\n\n{}\n{summary}\n## How to read the tables\n\n{EXPLANATION}{body}",
        environment.lines()
    );
    arguments.destination.write("stability.md", &report)?;
    Ok(counts.wrong)
}
