//! Writes `tests/reports/starts.md`: assemblies of every mechanism from estimates that are off by half a radian and
//! half a link.

use std::error::Error;
use std::process::ExitCode;

use clap::Parser;
use linkwright_tests::description;
use linkwright_tests::starts::measure::{Measured, Outcomes, measure};
use linkwright_tests::starts::perturbation::SEED;
use linkwright_tests::starts::report::{table, work};
use linkwright_tests::study::destination::{Destination, ended, none_wrong};

/// Assembles every mechanism from many poor estimates and writes a report
#[derive(Parser)]
struct Arguments {
    /// Number of estimates of each mechanism
    #[arg(long, default_value_t = 10_000)]
    starts: u32,
    #[command(flatten)]
    destination: Destination,
}

const EXPLANATION: &str = "\
Every coordinate of the drawing is moved at random, evenly up to half a radian or half a link to either side. The length of a link
is the longest distance between two points of a body, for the median of the bodies; the place where a curve is touched moves by half
a radian of its parameter. The truth is the pose to which the drawing itself leads, angles but for whole turns.

**Drawing's pose**: the same within 1e-9. **Another pose**: the equations hold and the determinant of Φ_q has the drawing's sign,
but blocks are assembled in other modes, an even number of them, or a block has several poses in one mode. **Other branch**: the
determinant has the other sign, where none was asked for. **Wrong**: reported as solved, but the residual is above 1e-11 or the
sign is not that which was asked for.
";

fn main() -> ExitCode {
    ended(run(&Arguments::parse()).and_then(|wrong| none_wrong(wrong as usize)))
}

fn run(arguments: &Arguments) -> Result<u32, Box<dyn Error>> {
    let environment = arguments.destination.environment();
    let mut measured: Vec<Measured> = Vec::new();
    for name in description::names() {
        for derived in description::motions(&name) {
            let measurement = measure(&derived, arguments.starts);
            let generated = measurement.generated.as_ref().map(Outcomes::success);
            eprintln!(
                "{}: textbook {:.2} %, from afar {:.2} %, generated {generated:.2?} %",
                measurement.name,
                measurement.plain.success(),
                measurement.afar.success()
            );
            measured.push(measurement);
        }
    }
    let rows = |pick: fn(&Measured) -> Option<&Outcomes>| {
        let rows = measured
            .iter()
            .filter_map(|it| Some((it.name.as_str(), pick(it)?)));
        rows.collect::<Vec<_>>()
    };
    let (plain, afar, generated) = (
        rows(|it| Some(&it.plain)),
        rows(|it| Some(&it.afar)),
        rows(|it| it.generated.as_ref()),
    );
    let all = plain.iter().chain(&afar).chain(&generated);
    let wrong: u32 = all.map(|(_, outcomes)| outcomes.wrong).sum();
    let report = format!(
        "# Poor estimates\n\nWritten by `cargo run --profile optimized -p linkwright-tests --bin starts`.\n\n{}- starts: {} of each mechanism, \
         seed {SEED:#x}\n\n{EXPLANATION}\n**{wrong} wrong.**\n\n\
         ## The generated mechanism, `assemble_from`\n\nBlock by block in the modes of the drawing. Not listed: mechanisms with motions \
         or outputs.\n\n{}\n\
         ## The textbook view, `assemble_from_rough_estimate`\n\nAll equations at once, on the branch of the drawing: one sign.\n\n{}\n\
         ## The textbook view, `assemble`\n\nNewton-Raphson alone, which is for good estimates.\n\n{}\n\
         ## Work of `assemble_from_rough_estimate`\n\nEvaluations of Φ_q and Φ of one start. At most 204 and 395 with the default \
         settings.\n\n{}",
        environment.lines(),
        arguments.starts,
        table(&generated),
        table(&afar),
        table(&plain),
        work(&measured),
    );
    arguments.destination.write("starts.md", &report)?;
    Ok(wrong)
}
