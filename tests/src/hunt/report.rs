//! Writes tables in Markdown of a tally.

use std::fmt::Write as _;

use super::tally::{Counts, Tally};
use crate::study::table::aligned;

/// Command that repeats a number of a mechanism.
pub fn command(seed: u64, number: u64) -> String {
    format!("--seed {seed} --only {number} --print")
}

/// Outcomes of every call.
pub fn outcomes(tally: &Tally) -> String {
    let header = [
        "who",
        "call",
        "solves",
        "correct",
        "another pose",
        "pose, path ended",
        "failure, pose exists",
        "failure, path ended",
        "wrong",
    ];
    let mut rows = vec![header.map(str::to_string)];
    let row = |who: &str, call: &str, it: Counts| {
        let numbers = [
            it.total(),
            it.correct,
            it.other,
            it.beyond,
            it.failed,
            it.ended,
            it.wrong,
        ];
        let [a, b, c, d, e, f, g] = numbers.map(|it| it.to_string());
        [who.to_string(), call.to_string(), a, b, c, d, e, f, g]
    };
    for ((view, call), counts) in &tally.counts {
        rows.push(row(view.words(), call.words(), *counts));
    }
    rows.push(row("all", "", tally.total()));
    aligned(&rows, 2)
}

/// Typed failures at instants with a pose.
pub fn failures(tally: &Tally, seed: u64) -> String {
    let header = [
        "who",
        "call",
        "kind",
        "smallest example",
        "bodies",
        "instant",
        "solves",
        "mechanisms",
    ];
    let mut rows = vec![header.map(str::to_string)];
    for ((view, call, kind), group) in &tally.failures {
        let Some((specimen, instant)) = group.smallest else {
            continue;
        };
        rows.push([
            view.words().to_string(),
            call.words().to_string(),
            kind.clone(),
            format!("`{}`", command(seed, specimen.number)),
            specimen.bodies.to_string(),
            instant.to_string(),
            group.count.to_string(),
            group.mechanisms.len().to_string(),
        ]);
    }
    aligned(&rows, 4)
}

/// Mechanisms that were not hunted.
pub fn unused(tally: &Tally, seed: u64) -> String {
    let mut rows = vec![["why", "smallest example", "mechanisms"].map(str::to_string)];
    for (reason, group) in &tally.unused {
        let example = group.smallest.map_or(String::new(), |(it, _)| {
            format!("`{}`", command(seed, it.number))
        });
        rows.push([reason.clone(), example, group.count.to_string()]);
    }
    aligned(&rows, 2)
}

/// Wrong answers, at most `most` of them.
pub fn wrong(tally: &Tally, seed: u64, most: usize) -> String {
    let mut text = String::new();
    for it in tally.wrong.iter().take(most) {
        let _ = writeln!(
            text,
            "- {}, {}, instant {}: {}; `{}`",
            it.view.words(),
            it.call.words(),
            it.instant,
            it.why,
            command(seed, it.specimen.number)
        );
    }
    if tally.wrong.len() > most {
        let _ = writeln!(text, "- and {} more", tally.wrong.len() - most);
    }
    text
}

/// Summary of the run.
pub fn summary(tally: &Tally, constructed: u64, compiled: usize, seconds: f64) -> String {
    let total = tally.total();
    let unused: usize = tally.unused.values().map(|group| group.count).sum();
    format!(
        "{constructed} mechanisms were constructed, {} of them hunted ({} with a path that ends on the way, {compiled} also compiled), {unused} not. \
         {} solves in {seconds:.0} s: {} correct, {} another pose than that of the path where the call promises none in particular, {} poses after the end of a path, \
         {} typed failures where the path has a pose, {} where it has ended, **{} wrong**. The largest error is {:.2} of its bound.\n",
        tally.used[0],
        tally.used[1],
        total.total(),
        total.correct,
        total.other,
        total.beyond,
        total.failed,
        total.ended,
        total.wrong,
        tally.ratio
    )
}

const EXPLANATION: &str = "\
A mechanism grows from the ground by groups: driven cranks, sliders and bodies, dyads of every kind, bodies on a pin and a tie, triads,
platforms on driven legs, chains and links that are tied so that Newton-Raphson has to solve them, gears, belts, racks, welds, and joints at random. Platforms on
folded legs have drivers of every kind inside of their blocks. A driver follows a law of t, or a periodic table that begins anywhere; the value of
the table comes from a spline of its own. In one mechanism of five the drivers stand in one of several motions, with parameters of
its own, the same names with other values in the others. The pose at t = 0 is chosen first; all lengths, offsets, angles and points of the description are measured there, so the pose is a solution
by construction. Sizes go from 1 mm to 10 m, some 1e-6 m and 1e6 m, frames and places up to 1e5 sizes off. The description is text,
its statements in random order, and is read like any other.

**The truth** at the instants t = 0, 0.125, … 3 s: a tracker of its own with steps so short that the Taylor polynomial misses by less than 1e-4
follows the path from the constructed pose; Newton-Raphson in 384 bits makes each pose exact; and each exact pose is compared with
what the joints say in geometric terms, without the equations of the generator. A path ends at a singular pose, also where other
poses exist beyond it.

**An outcome** is *correct* if q, q̇ and q̈ are within condition × rounding of the exact motion on the path (the bound of `stability.md`; a rate may also be off by what elimination mixes into it, 3 n ε |A⁻¹| |L| |U| |x|). A pose
elsewhere must be within the bound of an exact pose of the same equations; it is *another pose* where the call does not promise which one, and wrong
otherwise. What is promised: by `follow`, by the motion of a generated mechanism: the path, in the latter case but for whole turns of an
angle that has moved by half a turn in one step; by `assemble_from_rough_estimate` on a branch: the sign of the determinant; by an assembly of a generated mechanism
all of whose blocks are in closed form: the modes of the drawing; by `assemble` and `advance` of the textbook view: a pose.
";

/// Causes of the groups of failures, by their examples.
const BEHIND: &str = "\
- *no digits*: the bound itself is more than 1 % of the size. In f32 a place 1e5 sizes off the origin is known to 0.6 % of the size and
  worse, so the Jacobian at any such pose cannot be told from a singular one, and Newton-Raphson does not settle.
- *poor estimate*: every coordinate of every body is off by up to half a size or half a radian, independently. `WrongBranch`: all
  attempts ended at poses of the other sign, which are exact poses, but not what was asked for. `Diverged`, `IterationLimit`: none of them
  ended anywhere. Such a start is refused and not answered by another assembly.
- `advance` of the textbook view: the motion begins, or comes, so near to a singular pose that rates and accelerations are large, and the Taylor
  polynomial over a whole step leaves the basin of the pose. `follow` and the motion of generated mechanisms go there in shorter
  steps from the same frame.

A description is refused where joints at random say too much of one body and too little of another (K32, K33), repeat one another in every
pose (K34) or can hold only at t = 0 (K36). Where the tracker gives up, or
calls the first pose singular, its own f64 does not suffice, as with places or frames 1e5 sizes off.
";

/// Report.
pub fn report(tally: &Tally, seed: u64, environment: &str, summary: &str) -> String {
    let mut text = format!(
        "# The hunt\n\nWritten by `cargo run --profile optimized -p linkwright-tests --bin hunt`, seed {seed}.\n\n{environment}\n{summary}\n{EXPLANATION}\n## Outcomes\n\n{}",
        outcomes(tally)
    );
    if !tally.wrong.is_empty() {
        let _ = write!(text, "\n## Wrong answers\n\n{}", wrong(tally, seed, 100));
    }
    let _ = write!(
        text,
        "\n## Typed failures where the path has a pose\n\nEach mechanism is repeated by `cargo run --profile optimized -p linkwright-tests --bin hunt --` and what stands in the column.\n\n{}",
        failures(tally, seed)
    );
    let _ = write!(text, "\n## What is behind them\n\n{BEHIND}");
    let _ = write!(
        text,
        "\n## Mechanisms that are not hunted\n\n{}",
        unused(tally, seed)
    );
    text
}
