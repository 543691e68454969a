//! Writes all reports of `tests/reports` again, one after another.
//!
//! Run it on an otherwise idle machine: times are among the figures, and all together take some hours.

use std::error::Error;
use std::process::{Command, ExitCode};
use std::time::Instant;

use clap::Parser;
use linkwright_tests::files;
use linkwright_tests::study::destination::ended;

/// Writes all reports again
#[derive(Parser)]
struct Arguments {
    /// Only these, separated by commas, by their binaries: `growth,starts`
    #[arg(long, value_delimiter = ',', value_name = "NAMES")]
    only: Vec<String>,
    /// Print the commands and run none
    #[arg(long)]
    list: bool,
    /// The commit that is measured [default: what git says]
    #[arg(long)]
    commit: Option<String>,
}

/// A study that writes a report.
struct Study {
    /// Its binary.
    name: &'static str,
    /// Options of cargo before `--`.
    build: &'static [&'static str],
    /// Arguments of the binary.
    arguments: &'static [&'static str],
    /// True if the binary takes `--commit`.
    names_commit: bool,
}

const OPTIMIZED: &[&str] = &["--profile", "optimized"];

const fn study(name: &'static str) -> Study {
    Study {
        name,
        build: OPTIMIZED,
        arguments: &[],
        names_commit: true,
    }
}

/// All studies, quick ones first.
const STUDIES: [Study; 15] = [
    study("elementary"),
    study("ankle"),
    study("proofs"),
    // Firmware is built by its own profile.
    Study {
        build: &[],
        arguments: &["--write"],
        names_commit: false,
        ..study("embedded")
    },
    study("growth"),
    study("lanes"),
    study("simulation"),
    study("work-precision"),
    study("starts"),
    study("stability"),
    Study {
        build: &["--profile", "optimized", "--features", "long_chains"],
        ..study("chains")
    },
    study("calibration"),
    study("free-motion"),
    study("hunt"),
    Study {
        arguments: &["--seed", "11", "--count", "36"],
        ..study("hunt-paths")
    },
];

impl Study {
    /// Arguments of cargo that run the study.
    fn words(&self, commit: Option<&str>) -> Vec<String> {
        let fixed = ["run", "--package", "linkwright-tests", "--bin", self.name];
        let mut words: Vec<String> = fixed.map(str::to_string).to_vec();
        words.extend(self.build.iter().map(|it| it.to_string()));
        let commit = commit.filter(|_| self.names_commit);
        if commit.is_some() || !self.arguments.is_empty() {
            words.push("--".to_string());
        }
        words.extend(self.arguments.iter().map(|it| it.to_string()));
        words.extend(
            commit
                .iter()
                .flat_map(|it| ["--commit".to_string(), it.to_string()]),
        );
        words
    }
}

fn main() -> ExitCode {
    ended(run(&Arguments::parse()))
}

fn run(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    let unknown = |name: &&String| STUDIES.iter().all(|it| it.name != *name);
    if let Some(name) = arguments.only.iter().find(unknown) {
        let names = STUDIES.map(|it| it.name).join(", ");
        return Err(format!("no study is called `{name}`; the studies are {names}").into());
    }
    let is_chosen =
        |it: &&Study| arguments.only.is_empty() || arguments.only.iter().any(|own| own == it.name);
    let chosen: Vec<&Study> = STUDIES.iter().filter(is_chosen).collect();
    let mut failed = Vec::new();
    for (place, study) in chosen.iter().enumerate() {
        let words = study.words(arguments.commit.as_deref());
        println!(
            "{} of {}: cargo {}",
            place + 1,
            chosen.len(),
            words.join(" ")
        );
        if arguments.list {
            continue;
        }
        let start = Instant::now();
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let status = Command::new(cargo)
            .args(&words)
            .current_dir(files::repository())
            .status()?;
        println!("{} took {:.0} s", study.name, start.elapsed().as_secs_f64());
        if !status.success() {
            failed.push(study.name);
        }
    }
    match failed.is_empty() {
        true => Ok(()),
        false => Err(format!("these studies failed: {}", failed.join(", ")).into()),
    }
}
