//! Writes what is measured as tables.

use std::collections::BTreeMap;

use super::modules::Table;
use super::python::Peers;
use super::{Measured, batches, by_hand, sweeps};
use crate::study::table::aligned;

/// Times of generated modules and of C for an instruction set.
#[derive(Clone, Debug)]
pub struct OfSet {
    /// Name of the set.
    pub name: &'static str,
    /// Generated modules.
    pub generated: Table,
    /// Closed forms in C, or the reason why they are missing.
    pub by_hand: Result<by_hand::Times, String>,
}

/// Names of the mechanisms with lanes, in order.
fn names(all: &[Measured]) -> impl Iterator<Item = &str> {
    let with_lanes = all.iter().filter(|it| it.has_lanes);
    with_lanes.map(|it| it.name.as_str())
}

fn head<const N: usize>(columns: [&str; N]) -> Vec<String> {
    columns.map(str::to_string).to_vec()
}

/// Times of generated modules: for each instruction set alone, in lanes with their ratio, and on two threads.
pub fn generated(all: &[Measured], sets: &[OfSet], scalar: &str, kind: &str) -> String {
    let mut first = head(["mechanism"]);
    for set in sets {
        let alone = format!("{}, alone", set.name);
        first.extend(head([&alone, "lanes", "ratio", "two threads"]));
    }
    let mut rows = vec![first];
    for name in names(all) {
        let mut row = vec![name.to_string()];
        for set in sets {
            let times = set.generated[&format!("{name}_{scalar}_{kind}")];
            row.extend([
                format!("{:.1}", times.alone),
                format!("{:.1}", times.lanes),
                format!("{:.2}", times.alone / times.lanes),
                format!("{:.1}", times.on_two_threads),
            ]);
        }
        rows.push(row);
    }
    aligned(&rows, 1)
}

/// Times of closed forms in C, and ratios of generated lanes to them.
pub fn limit(all: &[Measured], sets: &[OfSet]) -> String {
    let mut rows = vec![head([
        "mechanism",
        "instructions",
        "C by hand",
        "unguarded",
        "ratio",
        "guarded",
        "ratio",
    ])];
    let mut missing = String::new();
    for name in names(all) {
        for set in sets {
            let limit = match &set.by_hand {
                Ok(times) => times.poses.get(name),
                Err(error) => {
                    missing = format!("\nC is missing: {error}\n");
                    None
                }
            };
            let Some(limit) = limit else { continue };
            let mut row = head([name, set.name]);
            row.push(format!("{limit:.1}"));
            for kind in ["unguarded", "guarded"] {
                let lanes = set.generated[&format!("{name}_f64_{kind}")].lanes;
                row.extend([format!("{lanes:.1}"), format!("{:.2}", lanes / limit)]);
            }
            rows.push(row);
        }
    }
    aligned(&rows, 2) + &missing
}

/// Times of the interpreter, with ratios to one mechanism at a time and to one thread.
pub fn interpreted(all: &[Measured], times: &BTreeMap<String, batches::Times>) -> String {
    let columns = [
        "mechanism",
        "alone",
        "batch",
        "ratio",
        "two threads",
        "ratio to one",
    ];
    let mut rows = vec![head(columns)];
    for it in all {
        let times = times[&it.name];
        let [one, two] = times.batches;
        rows.push(vec![
            it.name.clone(),
            format!("{:.1}", times.alone),
            format!("{one:.1}"),
            format!("{:.2}", times.alone / one),
            format!("{two:.1}"),
            format!("{:.2}", one / two),
        ]);
    }
    aligned(&rows, 1)
}

/// Times of NumPy and pylinkage, and their ratios to batches of the interpreter and to generated lanes.
pub fn peers(peers: &Peers, batches: &BTreeMap<String, batches::Times>, widest: &OfSet) -> String {
    let lanes = format!("lanes, {}", widest.name);
    let columns = [
        "mechanism",
        "program",
        "quantities",
        "ns a pose",
        "our batch",
        "ratio",
        &lanes,
        "ratio",
    ];
    let mut rows = vec![head(columns)];
    let methods = [
        (&peers.numpy, "closed", "NumPy, closed form", "all levels"),
        (
            &peers.numpy,
            "product",
            "NumPy, products of matrices",
            "positions",
        ),
        (
            &peers.numpy,
            "elementwise",
            "NumPy, components",
            "positions",
        ),
        (
            &peers.pylinkage,
            "step_fast",
            "pylinkage, `step_fast`",
            "positions",
        ),
    ];
    for name in ["four_bar", "dyads_1", "dyads_7", "dyads_17"] {
        for (lines, method, program, quantities) in methods {
            // Short runs have fewer mechanisms.
            let (Ok(time), Some(batch), Some(lanes)) = (
                lines.number("time", &format!("{method} {name}")),
                batches.get(name).map(|it| it.batches[0]),
                widest.generated.get(&format!("{name}_f64_guarded")),
            ) else {
                continue;
            };
            let mut row = head([name, program, quantities]);
            row.extend([
                format!("{time:.1}"),
                format!("{batch:.1}"),
                format!("{:.1}", time / batch),
                format!("{:.1}", lanes.lanes),
                format!("{:.1}", time / lanes.lanes),
            ]);
            rows.push(row);
        }
    }
    aligned(&rows, 3)
}

/// Times until the first result (ms): of the interpreter by mechanism, and of others by what they do.
pub fn first(
    all: &[Measured],
    batches: &BTreeMap<String, batches::Times>,
    others: &[(String, f64)],
) -> String {
    let mut rows = vec![head(["program", "ms"])];
    for it in all {
        let name = format!("interpreter, {}, eight sets", it.name);
        rows.push(vec![name, format!("{:.2}", batches[&it.name].first)]);
    }
    for (name, time) in others {
        rows.push(vec![name.clone(), format!("{time:.0}")]);
    }
    aligned(&rows, 1)
}

/// Times of the command `sweep` beside those of batches alone.
pub fn swept(times: &[sweeps::Times; 2]) -> String {
    let columns = [
        "threads",
        "command, s",
        "batches alone, s",
        "ratio",
        "one thread to this",
    ];
    let mut rows = vec![head(columns)];
    for it in times {
        rows.push(vec![
            it.threads.to_string(),
            format!("{:.2}", it.command),
            format!("{:.2}", it.batch),
            format!("{:.2}", it.command / it.batch),
            format!("{:.2}", times[0].command / it.command),
        ]);
    }
    aligned(&rows, 0)
}
