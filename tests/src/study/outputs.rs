//! Operations and time per frame of the excavator with all outputs and with its tool alone.

use std::fmt::Write as _;
use std::hint::black_box;
use std::time::Instant;

use linkwright_codegen::stages::program::Operations;
use linkwright_mechanisms::{excavator, excavator_tool};

use super::measurement::{Effort, median};
use crate::description;

/// The frames of a sweep.
const FRAMES: usize = 501;

macro_rules! sweep {
    ($module:ident::$mechanism:ident) => {
        || {
            let mut mechanism =
                $module::$mechanism::assemble(0.0).unwrap_or_else(|failure| panic!("{failure}"));
            for frame in 1..FRAMES {
                if let Err(failure) = mechanism.advance(frame as f64 / 100.0) {
                    panic!("{failure}");
                }
                black_box(mechanism.frame());
            }
        }
    };
}

/// Section of the report. The repeats alternate, so that other work of the machine affects both alike.
pub fn section(effort: Effort) -> String {
    let sweeps: [fn(); 2] = [
        sweep!(excavator::Excavator),
        sweep!(excavator_tool::ExcavatorTool),
    ];
    let mut times: [Vec<f64>; 2] = [const { Vec::new() }; 2];
    for _ in 0..effort.repeats {
        for (sweep, times) in sweeps.iter().zip(&mut times) {
            let start = Instant::now();
            let mut sweeps = 0;
            while sweeps == 0 || start.elapsed().as_secs_f64() < effort.shortest {
                sweep();
                sweeps += 1;
            }
            times.push(start.elapsed().as_secs_f64() * 1e9 / (sweeps * FRAMES) as f64);
        }
    }
    let times = times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        median(&times)
    });
    let report = crate::plan::report(&description::system("excavator_tool"));
    let total = |levels: [Operations; 3]| levels.iter().map(Operations::total).sum::<usize>();
    let operations = [total(report.all_operations), total(report.operations)];
    let arctangents = [
        report.all_operations[0].arctangents,
        report.operations[0].arctangents,
    ];
    let mut text = String::from(
        "\n## Only what is asked for\n\nThe excavator with all coordinates, and with `output K` alone. An operation is an addition, multiplication,\n\
         division, root, sine or arctangent; an arctangent takes the time of many others.\n\n\
         | asked for | operations | of them arctangents | ns per frame |\n|---|---:|---:|---:|\n",
    );
    for (name, place) in [("everything", 0), ("the tool K", 1)] {
        // Writing into a string cannot fail.
        let _ = writeln!(
            text,
            "| {name} | {} | {} | {:.0} |",
            operations[place], arctangents[place], times[place]
        );
    }
    let _ = writeln!(
        text,
        "| ratio | {:.2} | | {:.2} |",
        operations[1] as f64 / operations[0] as f64,
        times[1] / times[0]
    );
    text
}
