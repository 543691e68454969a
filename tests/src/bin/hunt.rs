//! Hunts for wrong answers among random mechanisms with known truth: `tests/reports/hunt.md`.

use std::error::Error;
use std::process::ExitCode;
use std::time::Instant;

use clap::Parser;
use linkwright_tests::hunt::known::{Unused, known};
use linkwright_tests::hunt::run::{self, Hunted, MAX_BODIES};
use linkwright_tests::hunt::tally::{Tally, View};
use linkwright_tests::hunt::{compiled, interpreted, mechanism, report, seed_of};
use linkwright_tests::study::destination::{Destination, ended, none_wrong};

/// Solves random mechanisms with known truth in every way and writes a report
#[derive(Parser)]
struct Arguments {
    /// Seed of the random numbers
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Number of constructed mechanisms
    #[arg(long, default_value_t = 540)]
    count: u64,
    /// Number of the hunted mechanisms that are also compiled, in f64 and in f32
    #[arg(long, default_value_t = 20)]
    compile: usize,
    /// Only this mechanism, compiled too unless --compile is 0; no report is written
    #[arg(long)]
    only: Option<u64>,
    /// With --only: print its description
    #[arg(long, requires = "only")]
    print: bool,
    /// With --only: print the smallest mechanism with the same fault in an interpreted formulation
    #[arg(long, requires = "only")]
    shrink: bool,
    #[command(flatten)]
    destination: Destination,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let wrong = match arguments.only {
        Some(number) => only(&arguments, number),
        None => all(&arguments),
    };
    ended(wrong.and_then(none_wrong))
}

/// Hunts one mechanism and prints every answer that is not simply correct.
fn only(arguments: &Arguments, number: u64) -> Result<usize, Box<dyn Error>> {
    let constructed = mechanism(arguments.seed, number, MAX_BODIES);
    if arguments.print {
        print!("{}", constructed.text());
    }
    if arguments.shrink {
        match run::shrink(arguments.seed, number) {
            Some(small) => print!("{}", small.text()),
            None => println!("nothing to look at"),
        }
        return Ok(0);
    }
    eprintln!("groups: {}", constructed.groups.join(", "));
    if let Err(unused) = known(&constructed, seed_of(arguments.seed, number)) {
        match unused {
            Unused::Refused(_, rendered) => println!("{rendered}"),
            other => println!("{other:?}"),
        }
        return Ok(0);
    }
    let mut tally = Tally::default();
    let Some(hunted) = run::prepare(arguments.seed, number, &mut tally) else {
        return Ok(0);
    };
    println!(
        "{} of {} instants on the path",
        hunted.known.instants.len(),
        hunted.known.task.times.len()
    );
    let views = interpreted::answers(&hunted.known).map(|it| (View::Interpreted, it));
    let answers = if arguments.compile > 0 {
        compiled::answers(
            &compiled::folder()?,
            &[&hunted.mechanism],
            &[&hunted.known.task],
        )?
    } else {
        Vec::new()
    };
    let generated = answers
        .into_iter()
        .flat_map(|[double, single]| [(View::Double, double), (View::Single, single)]);
    for (view, answers) in views.into_iter().chain(generated) {
        run::count(&hunted, view, &answers, &mut tally);
        for line in run::findings(&hunted, view, &answers) {
            println!("{line}");
        }
    }
    print!("{}", report::outcomes(&tally));
    Ok(tally.total().wrong)
}

fn all(arguments: &Arguments) -> Result<usize, Box<dyn Error>> {
    let start = Instant::now();
    let mut tally = Tally::default();
    let mut hunted: Vec<Hunted> = Vec::new();
    for number in 0..arguments.count {
        if let Some(found) = run::prepare(arguments.seed, number, &mut tally) {
            run::interpret(&found, &mut tally);
            if hunted.len() < arguments.compile {
                hunted.push(found);
            }
        }
        if number % 50 == 49 {
            let solves = tally.total().total();
            eprintln!(
                "{} mechanisms, {solves} solves, {} wrong, {:.0} s",
                number + 1,
                tally.total().wrong,
                start.elapsed().as_secs_f64()
            );
        }
    }
    if !hunted.is_empty() {
        eprintln!("compiling {} mechanisms twice", hunted.len());
        run::compile(&hunted, &mut tally)?;
    }
    let total = tally.total();
    let contradictions = tally
        .unused
        .keys()
        .filter(|it| it.starts_with("CONTRADICTION"))
        .count();
    let seconds = start.elapsed().as_secs_f64();
    let summary = report::summary(&tally, arguments.count, hunted.len(), seconds);
    println!("{summary}");
    print!("{}", report::wrong(&tally, arguments.seed, 40));
    let environment = arguments.destination.environment();
    let report = report::report(&tally, arguments.seed, &environment.lines(), &summary);
    arguments.destination.write("hunt.md", &report)?;
    Ok(total.wrong + contradictions)
}
