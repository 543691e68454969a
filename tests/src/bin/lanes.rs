//! Writes `tests/reports/lanes.md`: times of mechanisms alone, in lanes and in batches, beside those of C and of Python.
//!
//! Run it in release, on an otherwise idle machine. C needs `cc`; Python needs `python3` with `venv`, and the network when it runs first.

use std::collections::BTreeMap;
use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

use clap::Parser;
use linkwright_tests::lanes::modules::Package;
use linkwright_tests::lanes::processor::SETS;
use linkwright_tests::lanes::python::Peers;
use linkwright_tests::lanes::report::{self, OfSet};
use linkwright_tests::lanes::{Measured, batches, by_hand, measured, sweeps};
use linkwright_tests::study::destination::{Destination, ended};

/// Times mechanisms in lanes and writes a report
#[derive(Parser)]
struct Arguments {
    /// Only the four-bar and the shortest chains, into another folder
    #[arg(long, requires = "output")]
    short: bool,
    #[command(flatten)]
    destination: Destination,
}

const EXPLANATION: &str = "\
Times are ns a pose, with velocities and accelerations. All figures are of one run; each is the fastest of several sweeps. A sweep goes forth
and back over 500 instants. `dyads_n` is the chain of n dyads in `tests/src/dyad_chain.rs`.

Generated modules are compiled once for each instruction set, by `-C target-cpu`; `alone` is one mechanism that is advanced with the same
compiler options. Lanes are 8 in f64 and 16 in f32. Guarded poses are proven to lie on the path, as generated mechanisms do by default. On two
threads, each thread moves a group of its own. AVX-512 is `x86-64-v4` with registers of 512 bits, `-C target-feature=-prefer-256-bit`, as the
feature `simd` of the runtime uses them; by default, compilers for `x86-64-v4` use 256.
";

const LIMIT: &str = "\
`tests/src/lanes/by_hand.c` has closed forms of three mechanisms, eight instants side by side: polynomials for sines and arctangents, no branch,
no check, no path. Its frames are compared with the interpreter's. Beside them are generated lanes in f64, and their ratios to C.

Generated lanes have the bits of every other machine: products and sums are not fused, as they are in C. They also look for lengths out of reach
and for numbers that are not finite, and guarded ones prove the path. C computes arctangents afresh, generated lanes from the angles before.
";

const INTERPRETED: &str = "\
Batches have 512 sets of 200 instants; `platform_3rpr` has no closed form, and its batches solve one set after another.
";

const PEERS: &str = "\
One thread. NumPy solves dyad by dyad, each for all mechanisms and 200 instants at once, as LInK does: by the law of cosines, an arccosine and a
rotation. It is measured with the products of matrices that LInK takes, and component by component. Batches have 32 or 512 mechanisms, of which
the faster counts. pylinkage moves one mechanism. Positions are compared with the interpreter's. Our batches and lanes compute velocities and
accelerations too, and prove the path.
";

const FIRST: &str = "\
From the text of the description to solved poses. Generated: writing the module of the four-bar and compiling it with the runtime, and again
with only the program changed. C: compiling the three mechanisms. NumPy and pylinkage: from the start of the program; pylinkage compiles with
numba.
";

const SWEPT: &str = "\
`linkwright sweep` on 10⁵ four-bars with 200 frames each, extremes of one angle, from the start of the command to its end, with its
table. Batches alone solve the same sets and take their extremes in the process of this program.
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
        all.retain(|it| ["four_bar", "dyads_1", "platform_3rpr"].contains(&&*it.name));
    }
    let environment = arguments.destination.environment();
    print!("{}", environment.lines());
    let work = work()?;
    let sets = of_sets(&all, &work)?;
    let mut report = format!(
        "# Lanes\n\nWritten by `cargo run --profile optimized -p linkwright-tests --bin lanes`.\n\n{}\n{EXPLANATION}",
        environment.lines()
    );
    let mut section = |title: &str, text: &str| {
        println!("\n{title}\n{text}");
        report += &format!("\n## {title}\n\n{text}");
    };
    for scalar in ["f64", "f32"] {
        for kind in ["guarded", "unguarded"] {
            let table = report::generated(&all, &sets, scalar, kind);
            section(&format!("Generated, {scalar}, {kind}"), &table);
        }
    }
    let table = report::limit(&all, &sets);
    section("The limit in C, f64", &format!("{LIMIT}\n{table}"));
    let mut batches = BTreeMap::new();
    for it in &all {
        eprintln!("{}: interpreting", it.name);
        batches.insert(it.name.clone(), batches::measure(&it.guarded, it.step));
    }
    let table = report::interpreted(&all, &batches);
    let text = format!("{INTERPRETED}\n{table}");
    section("Interpreter, f64, guarded", &text);
    let mut first = first(&all)?;
    if let Some(Ok(times)) = sets.last().map(|set| &set.by_hand) {
        first.push(("C by hand".to_string(), times.first));
    }
    eprintln!("NumPy and pylinkage: installing and running");
    let text = match (Peers::measure(&work.join("python"), &all), sets.last()) {
        (Err(error), _) => format!("Not measured: {error}\n"),
        (_, None) => "Not measured: no instruction set is known.\n".to_string(),
        (Ok(peers), Some(widest)) => {
            for (lines, name) in [(&peers.numpy, "dyads_1"), (&peers.pylinkage, "four_bar")] {
                let program = lines.all("version").next().map_or("", |(name, _)| name);
                first.push((format!("{program}, {name}"), lines.number("first", name)?));
            }
            let table = report::peers(&peers, &batches, widest);
            format!("{}.\n\n{PEERS}\n{table}", peers.versions())
        }
    };
    section("NumPy and pylinkage, f64", &text);
    let table = report::first(&all, &batches, &first);
    section("First result", &format!("{FIRST}\n{table}"));
    eprintln!("sweep: building the command and running");
    let table = report::swept(&sweeps::measure(&work.join("sweep"))?);
    section("The command `sweep`", &format!("{SWEPT}\n{table}"));
    arguments.destination.write("lanes.md", &report)?;
    Ok(())
}

/// Folder for programs in C and in Python, beside those of cargo.
fn work() -> Result<PathBuf, Box<dyn Error>> {
    let program = std::env::current_exe()?;
    let target = program.parent().and_then(|it| it.parent());
    Ok(target.ok_or("the program has no folder")?.join("lanes"))
}

/// Times of generated modules and of C for the instruction sets of this machine.
fn of_sets(all: &[Measured], work: &std::path::Path) -> Result<Vec<OfSet>, Box<dyn Error>> {
    let package = Package::new("all", all)?;
    let mut sets = Vec::new();
    for set in SETS {
        if !set.is_present() {
            eprintln!("{}: this machine has other instructions", set.name);
            continue;
        }
        eprintln!("{}: compiling and running", set.name);
        let by_hand = by_hand::measure(&work.join("by_hand"), &set, all);
        let by_hand = by_hand.map_err(|error| error.to_string());
        if let Err(error) = &by_hand {
            eprintln!("{}, C: {error}", set.name);
        }
        sets.push(OfSet {
            name: set.name,
            generated: package.measure(&set)?,
            by_hand,
        });
    }
    Ok(sets)
}

/// Times (ms) until the module of the four-bar is compiled: at first, and after a change of the program.
fn first(all: &[Measured]) -> Result<Vec<(String, f64)>, Box<dyn Error>> {
    let Some(set) = SETS.iter().find(|set| set.is_present()) else {
        return Ok(Vec::new());
    };
    eprintln!("four_bar: compiling alone");
    let begun = Instant::now();
    let package = Package::new("first", all.iter().filter(|it| it.name == "four_bar"))?;
    package.build(set)?;
    let once = 1e3 * begun.elapsed().as_secs_f64();
    package.touch()?;
    let begun = Instant::now();
    package.build(set)?;
    let again = 1e3 * begun.elapsed().as_secs_f64();
    Ok(vec![
        ("generated, four_bar".to_string(), once),
        ("generated, four_bar, again".to_string(), again),
    ])
}
