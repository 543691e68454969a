//! Judges free motions of the gallery from random states: `tests/reports/free_motion.md`.

use std::error::Error;
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use clap::Parser;
use linkwright_tests::free_motion::{LEFT_OUT, MECHANISMS, TOLERANCES, Tally, report};
use linkwright_tests::study::destination::{Destination, ended, none_wrong};

/// Simulates mechanisms of the gallery with masses and free drivers, compares them with all coordinates integrated, and writes a report
#[derive(Parser)]
struct Arguments {
    /// Seed of the random numbers
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Number of states of each mechanism
    #[arg(long, default_value_t = 200)]
    states: u64,
    /// Minutes after which no other state begins
    #[arg(long)]
    limit: Option<f64>,
    /// Number of states that are judged at once
    #[arg(long, default_value_t = 1)]
    jobs: usize,
    /// Only this mechanism; each verdict is printed, and no report is written
    #[arg(long)]
    only: Option<String>,
    /// With --only: only the state of this number, with its description
    #[arg(long, requires = "only")]
    state: Option<u64>,
    #[command(flatten)]
    destination: Destination,
}

const EXPLANATION: &str = "\
Each mechanism of `mechanisms/` moves without its drivers, with random masses (0.3 to 2 kg), centers of mass, moments of inertia and
gravity. What a driver moved is free. Starts lie on rays from the drawing, up to the end of the poses: most rays end at a dead center of
what is free, and starts lie in that part of the ray beside it whose root is spread over 1 to 1e-8. Rates are random, up to 6 rad/s or
m/s. *Determinant*: of what is free at the start, with gradients of length 1 on an orthonormal basis of what the joints allow. Where no
dead center ends a ray, determinants keep to their few powers of ten.

Each state is simulated over 0.6 s with relative tolerances of 1e-7 and 1e-10: two motions a state. The reference integrates all
coordinates with multipliers, by extrapolation to 1e-13 a step (`tests/src/multipliers.rs`). Joints of `pantograph`, `peaucellier` and
`scissor` lose rank on the way: there it has others that hold the bodies on the smooth path (`tests/src/free_motion/gallery.rs`).

*Error*: the largest difference of all coordinates and rates at 12 instants, in tolerances × the largest coordinate or rate × the growth of
a small change by then, from the start or from an instant on the way. *Right*: the motion went to its end with an error of at most 100.
*Wrong*: it went to its end with a larger one. *No reference*: it went to its end, and the reference did not.
";

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let wrong = match &arguments.only {
        Some(file) => only(&arguments, file),
        None => all(&arguments),
    };
    ended(wrong.and_then(none_wrong))
}

/// One mechanism, with each verdict.
fn only(arguments: &Arguments, file: &str) -> Result<usize, Box<dyn Error>> {
    let freed = MECHANISMS.iter().find(|it| it.file == file);
    let freed = freed.ok_or_else(|| format!("no mechanism `{file}` in the list"))?;
    let states = match arguments.state {
        Some(state) => state..state + 1,
        None => 0..arguments.states,
    };
    if let Some(text) = arguments
        .state
        .and_then(|it| freed.text(arguments.seed, it))
    {
        println!("{text}");
    }
    let mut tally = Tally::default();
    for state in states {
        let verdicts = freed.judged(arguments.seed, state, &TOLERANCES);
        for verdict in &verdicts {
            println!("{verdict:?}");
        }
        tally.count(&verdicts);
    }
    println!("{}", report(&[(freed.file, tally.clone())]));
    Ok(tally.wrong())
}

fn all(arguments: &Arguments) -> Result<usize, Box<dyn Error>> {
    let start = Instant::now();
    let end = arguments.limit.map(|it| Duration::from_secs_f64(60.0 * it));
    let next = AtomicU64::new(0);
    let tallies = Mutex::new(vec![Tally::default(); MECHANISMS.len()]);
    // If time ends early, each mechanism has as many states as the others.
    let judge = || {
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            let count = MECHANISMS.len() as u64;
            let (state, place) = (number / count, (number % count) as usize);
            let is_late = end.is_some_and(|it| start.elapsed() > it);
            if state >= arguments.states || is_late {
                return;
            }
            let verdicts = MECHANISMS[place].judged(arguments.seed, state, &TOLERANCES);
            for verdict in verdicts.iter().filter(|it| it.is_wrong()) {
                eprintln!("wrong: {verdict:?}");
            }
            tallies.lock().expect("no panic")[place].count(&verdicts);
            if place == 0 && state % 10 == 9 {
                let seconds = start.elapsed().as_secs_f64();
                eprintln!("{} states of each, {seconds:.0} s", state + 1);
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..arguments.jobs.max(1) {
            scope.spawn(judge);
        }
    });
    let tallies = tallies.into_inner()?;
    let wrong = tallies.iter().map(Tally::wrong).sum();
    let least = tallies.iter().map(|it| it.states).min().unwrap_or_default();
    let files = MECHANISMS.iter().map(|it| it.file);
    let named: Vec<_> = files.zip(tallies).collect();
    let left_out = LEFT_OUT
        .map(|(file, reason)| format!("- `{file}`: {reason}\n"))
        .concat();
    let text = format!(
        "# Free motions of the gallery\n\nWritten by `cargo run --profile optimized -p linkwright-tests --bin free-motion`.\n\n{}- seed: {}\n\
         - states: {} of each mechanism asked for; the time of {:.0} min sufficed for {least}\n\n{EXPLANATION}\nLeft out:\n\n{left_out}\n## Motions\n\n{}",
        arguments.destination.environment().lines(),
        arguments.seed,
        arguments.states,
        start.elapsed().as_secs_f64() / 60.0,
        report(&named)
    );
    arguments.destination.write("free_motion.md", &text)?;
    Ok(wrong)
}
