//! Errors of simulated motions beside their evaluations, with weak and strong dampers: `tests/reports/simulation.md`.

use std::error::Error;
use std::ops::RangeInclusive;
use std::process::ExitCode;

use clap::Parser;
use linkwright_solver::{Method, SimulationOptions};
use linkwright_tests::damped_chain::{DampedChain, Element};
use linkwright_tests::sled::Sled;
use linkwright_tests::stiff::{Damped, Found, options};
use linkwright_tests::study::destination::{Destination, ended};
use linkwright_tests::study::table::aligned;

/// Counts what the methods of `linkwright simulate` take for which error and writes a report
#[derive(Parser)]
struct Arguments {
    /// When the motions end (s)
    #[arg(long, default_value_t = 2.0)]
    to: f64,
    #[command(flatten)]
    destination: Destination,
}

const EXPLANATION: &str = "\
Two mechanisms, each with a damper of 10 and of 1e6 N·s/m. *Slider*: 2 kg between a spring of 50 N/m and the damper, pushed by 3 N · sin 2t;
its motion has a closed form. *Cart*: the same mass without that force carries a pendulum of 1 kg and 0.5 m that starts at 1 rad. Its
Lagrange equations, written out, are integrated in steps of at most 1 ms and 2 s divided by the damper.

Error: the largest of all coordinates (m, rad) and rates (m/s, rad/s) at 40 instants, which lie between steps. Evaluations: how often the
mechanism was solved for an acceleration, those for frames between steps and for derivatives of the implicit method among them. *dop853* and
*implicit* are forced by `--method`; *automatic* is the default. Absolute tolerances are a thousandth of the relative ones. A dash is what
was left out: explicit steps with the strong damper are about as many at every tolerance, and of the cart.
*Ends*: with a typed error, since the energy is out of balance.

*Chain*: two or three pendulums of 0.5, 0.4 and 0.3 m from rest, with a damper in each joint between them (N·m·s) or between points 0.3 m
beside it (*struts*, N·s/m), or with torques and forces *by hand* whose formulas are those of such dampers. Strong dampers let the chain
turn as one body; its motion then follows from its angular momentum and what the joints carry, to the square of 1/damper, which is larger
than the smallest tolerances for a damper of 1e5. With weak ones Lagrange's equations are integrated in steps shorter than any decay.
Errors are in tolerances, with the default method. What a damper of 1e10 exerts is known to 1e-6 N·m, since rates of the bodies are known to
rounding: steps shorter than that allows take many evaluations and average it.

*Sled*: 2 kg with a drag of so many N·s/m across its runner, written as a force of rates, starts with 1.5 m/s and 1.2 rad/s. The direction of
the drag is that of no coordinate. The motion has a closed form.
";

const DAMPERS: [f64; 2] = [10.0, 1e6];

/// Dampers of chains.
const ABOUT: [f64; 5] = [10.0, 1e3, 1e6, 1e8, 1e10];
const STRUTS: [f64; 3] = [1e3, 1e8, 1e10];
const TORQUES: [f64; 4] = [1e5, 1e6, 1e7, 1e8];
const FORCES: [f64; 2] = [1e7, 1e8];

/// Drags of sleds.
const DRAGS: [f64; 3] = [1e4, 1e6, 1e8];

fn main() -> ExitCode {
    ended(run(&Arguments::parse()))
}

fn run(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    let environment = arguments.destination.environment();
    let mut report = format!(
        "# Simulated motions: error beside evaluations\n\nWritten by `cargo run --profile optimized -p linkwright-tests --bin simulation`.\n\n{}- \
         motions: up to {} s\n\n{EXPLANATION}",
        environment.lines(),
        arguments.to,
    );
    for damped in [Damped::Slider, Damped::Cart] {
        for damper in DAMPERS {
            report += &format!("\n## {damped:?}, {damper:e} N·s/m\n\n");
            report += &table(damped, damper, arguments.to);
        }
    }
    eprintln!("slider and cart");
    for count in [2, 3] {
        for (element, dampers, kind) in [
            (Element::Joint, &ABOUT[..], ""),
            (Element::Strut, &STRUTS, ", struts"),
            (Element::Torques, &TORQUES, ", torques by hand"),
            (Element::Forces, &FORCES, ", forces by hand"),
        ] {
            eprintln!("chain of {count}: {element:?}");
            report += &format!("\n## Chain of {count} pendulums{kind}\n\n");
            report += &chain(count, element, dampers, arguments.to);
        }
    }
    report += "\n## Sled\n\n";
    report += &sleds(arguments.to);
    arguments.destination.write("simulation.md", &report)?;
    Ok(())
}

/// Errors and evaluations of one mechanism with one damper.
fn table(damped: Damped, damper: f64, end: f64) -> String {
    let motion = damped.motion(damper, end);
    let methods = [Method::Explicit, Method::Implicit, Method::Automatic];
    let titles = [
        "`--rtol`",
        "dop853: error",
        "evaluations",
        "implicit: error",
        "evaluations",
        "automatic: error",
        "evaluations",
    ];
    let mut rows = vec![titles.map(str::to_string)];
    for digits in 4..=12 {
        let relative = 10_f64.powi(-digits);
        let mut cells = vec![format!("{relative:.0e}")];
        for method in methods {
            // The strong damper needs as many explicit steps whatever the tolerance.
            let is_first = digits == 6 && damped == Damped::Slider;
            if method == Method::Explicit && damper > 1e3 && !is_first {
                cells.extend(["–".to_string(), "–".to_string()]);
                continue;
            }
            let found = damped.compared(damper, &motion, end, options(method, relative));
            match found {
                Ok(found) => {
                    cells.push(format!("{:.1e}", found.error));
                    cells.push(found.effort.evaluations.to_string());
                }
                Err(_) => cells.extend(["ends".to_string(), "–".to_string()]),
            }
        }
        rows.push(std::array::from_fn(|column| cells[column].clone()));
    }
    aligned(&rows, 0)
}

/// Errors in tolerances and evaluations, a row for each tolerance of so many digits and two columns for each damper.
fn by_tolerance<E>(
    digits: RangeInclusive<i32>,
    dampers: &[f64],
    compared: impl Fn(usize, SimulationOptions) -> Result<Found, E>,
) -> String {
    let mut titles = vec!["`--rtol`".to_string()];
    for damper in dampers {
        titles.extend([format!("{damper:.0e}: error"), "evaluations".to_string()]);
    }
    let mut rows = vec![titles];
    for digits in digits {
        let relative = 10_f64.powi(-digits);
        let mut cells = vec![format!("{relative:.0e}")];
        for place in 0..dampers.len() {
            match compared(place, options(Method::Automatic, relative)) {
                Ok(found) => {
                    cells.push(format!("{:.1}", found.error / relative));
                    cells.push(found.effort.evaluations.to_string());
                }
                Err(_) => cells.extend(["ends".to_string(), "–".to_string()]),
            }
        }
        rows.push(cells);
    }
    aligned(&rows, 0)
}

/// Chains of pendulums from rest.
fn chain(count: usize, element: Element, dampers: &[f64], end: f64) -> String {
    let chains = dampers.iter().map(|&damper| DampedChain {
        count,
        damper,
        element,
    });
    let chains: Vec<_> = chains.map(|it| (it, it.motion(end))).collect();
    by_tolerance(4..=12, dampers, |place, options| {
        let (chain, motion) = &chains[place];
        chain.compared(motion, end, options)
    })
}

/// Sleds with a drag whose direction turns.
fn sleds(end: f64) -> String {
    by_tolerance(4..=10, &DRAGS, |place, options| {
        let drag = DRAGS[place];
        Sled { drag }.compared(end, options)
    })
}
