//! Errors of simulated motions beside their evaluations, with weak and strong dampers: `tests/reports/simulation.md`.

use std::error::Error;
use std::process::ExitCode;

use clap::Parser;
use linkwright_tests::damped_chain::Element;
use linkwright_tests::simulation_tables::{chain, damped_table, sleds};
use linkwright_tests::stiff::Damped;
use linkwright_tests::study::destination::{Destination, ended};

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
            report += &damped_table(damped, damper, arguments.to);
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
