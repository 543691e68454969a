//! How far solutions of hard cases are off, beside what condition and rounding allow: `tests/reports/stability.md`.

use std::error::Error;
use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use linkwright_tests::files;
use linkwright_tests::stability::chart::draw;
use linkwright_tests::stability::families::families;
use linkwright_tests::stability::report::{Counts, judged};
use linkwright_tests::stability::texts;
use linkwright_tests::stability::truth::FACTOR;
use linkwright_tests::study::environment::Environment;

/// Solves hard cases in every way and writes a report
#[derive(Parser)]
struct Arguments {
    /// The commit that is measured [default: what git says]
    #[arg(long)]
    commit: Option<String>,
    /// Where the report is written [default: tests/reports]
    #[arg(long)]
    output: Option<PathBuf>,
}

const EXPLANATION: &str = "\
Each row is a motion (or one instant), each cell one way to solve it. `textbook` assembles with `assemble_from_afar` and moves
with `follow`; the other columns are the generated mechanism, `assemble_with` and `advance`. A cell `3e-16 of 4e-15, 0.12` says
that the worst coordinate of all instants is off by 3e-16 (lengths in the size of the mechanism, angles in rad), that 4e-15 was
predicted, and that the largest ratio of error to bound, over q, q̇, q̈ and all instants, is 0.12. A cell with a name is a typed
failure, `after 3` instants within their bounds; `no pose`: there is none. `no digits`: the answer is within its bound, but the
bound itself leaves less than three digits.

**The truth** is the solution of the description's equations with exactly the numbers that the scalar was given, by
Newton-Raphson in 384 bits (`tests/src/stability/truth.rs`).
**The bound** is condition × rounding: |Φ_q⁻¹| times the rounding errors of the rows by running error analysis at the pose, plus
4 ε of each row's scale, which Newton-Raphson lets pass as rounding; the velocity's contains the error of the pose, the
acceleration's both.
";

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(wrong) if wrong > 0 => {
            eprintln!("error: {wrong} wrong answers");
            ExitCode::FAILURE
        }
        Ok(_) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &Arguments) -> Result<usize, Box<dyn Error>> {
    let environment = Environment::here(arguments.commit.as_deref());
    let folder = arguments
        .output
        .clone()
        .unwrap_or_else(|| files::package("reports"));
    fs::create_dir_all(&folder)?;
    let mut counts = Counts::default();
    let mut body = String::new();
    for (index, family) in families().into_iter().enumerate() {
        let judged = judged(family, 1);
        eprintln!("{}", judged.family.title);
        for verdicts in &judged.verdicts {
            verdicts.iter().for_each(|verdict| counts.add(verdict));
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
        let (words, verdict) = texts::judged(&text);
        counts.add(&verdict);
        writeln!(body, "| {name} | {words} |")?;
    }
    let total = counts.solved + counts.failed + counts.impossible + counts.wrong;
    let summary = format!(
        "{total} cells: {} within the bound ({} of them where it leaves less than three digits, {} of which are off by more than 1e-3), {} typed failures where there is a \
         pose, {} where there is none or the description is refused, **{} wrong**.\n",
        counts.solved,
        counts.without_digits,
        counts.far_off,
        counts.failed,
        counts.impossible,
        counts.wrong
    );
    println!("{summary}");
    let profile = if cfg!(debug_assertions) {
        "dev profile"
    } else {
        "release profile"
    };
    let report = format!(
        "# Stability\n\nWritten by `cargo run --release -p linkwright-tests --bin stability`.\n\n{}\n{EXPLANATION}All of it is multiplied by {FACTOR}.\n\n{summary}{body}",
        environment.lines().replace("release profile", profile)
    );
    let file = folder.join("stability.md");
    fs::write(&file, report)?;
    println!("wrote {}", file.display());
    Ok(counts.wrong)
}
