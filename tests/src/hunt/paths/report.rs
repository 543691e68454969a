//! Writes tables in Markdown of a tally.

use std::fmt::Write as _;

use super::families::FAMILIES;
use super::tally::{Counts, Example, SIZES, Tally};
use crate::study::table::aligned;

const EXPLANATION: &str = "\
Families of mechanisms that are hard to follow are moved by `advance` in steps of 1e-3 to 3 of the shortest period of what drives them, exact
parts and multiples of it and others, there and back, and in random steps. A target that is refused is tried again in 32 smaller steps.

**The truth** is a tracker of its own on the dense textbook equations, in steps so short that the Taylor polynomial misses by less than
1e-4 and no rate jumps by more than 3 %; it goes straight on through singular poses at which rates stay finite, by extrapolation, and says
where a path ends. Inputs go by the documented polynomial of the fifth degree, and straight while time stands still.

An `Ok` must lie within 1e-6 of its scale of that path (more near a singular pose, as rounding has it), angles counted with all their turns: otherwise it is
*another pose*, and *beyond* where the path has ended; both are wrong. *refused*: a failure although the path goes on. *ended*: a failure
because it has ended; *other time*: of these, failures whose time is off the end by more than 1/64 of the step. *unjudged*: starts, what
follows a wrong answer, and where the tracker is undecided: beyond the change point of links that differ by less than 5e-11 of them.
";

fn command(example: &Example, seed: u64) -> String {
    let (family, number) = example.course;
    format!("--seed {seed} --family {family} --only {number}")
}

fn row(who: &str, family: &str, it: &Counts) -> [String; 10] {
    let numbers = [
        it.solves,
        it.correct,
        it.another,
        it.beyond,
        it.refused,
        it.ended,
        it.misnamed,
        it.unjudged,
    ];
    let [a, b, c, d, e, f, g, h] = numbers.map(|it| it.to_string());
    [who.to_string(), family.to_string(), a, b, c, d, e, f, g, h]
}

/// Outcomes by family.
pub fn outcomes(tally: &Tally) -> String {
    let header = [
        "who",
        "family",
        "solves",
        "correct",
        "another pose",
        "beyond",
        "refused",
        "ended",
        "other time",
        "unjudged",
    ];
    let mut rows = vec![header.map(str::to_string)];
    for ((view, family), counts) in &tally.counts {
        rows.push(row(view.words(), FAMILIES[*family].0, counts));
    }
    rows.push(row("all", "", &tally.total()));
    aligned(&rows, 2)
}

/// Refused steps of all steps within the path, by family and size.
pub fn refusals(tally: &Tally) -> String {
    let mut header = vec!["family".to_string()];
    header.extend(
        SIZES[..SIZES.len() - 1]
            .iter()
            .map(|size| format!("to {size}")),
    );
    let mut rows: Vec<[String; SIZES.len()]> = vec![header.try_into().expect("as many")];
    for (family, groups) in &tally.refusals {
        let words = groups[..SIZES.len() - 1]
            .iter()
            .map(|it| match (it.refused, it.all) {
                (0, all) => format!("0 of {all}"),
                (refused, all) => format!(
                    "{refused} of {all} ({:.1} %)",
                    100.0 * refused as f64 / all as f64
                ),
            });
        let all: Vec<String> = std::iter::once(FAMILIES[*family].0.to_string())
            .chain(words)
            .collect();
        rows.push(all.try_into().expect("as many"));
    }
    aligned(&rows, 1)
}

/// Kinds of refusals with an example of each.
pub fn kinds(tally: &Tally, seed: u64) -> String {
    let mut rows = vec![["family", "kind", "example", "steps"].map(str::to_string)];
    for ((family, kind), (count, example)) in &tally.kinds {
        rows.push([
            FAMILIES[*family].0.to_string(),
            kind.clone(),
            format!("`{}`", command(example, seed)),
            count.to_string(),
        ]);
    }
    aligned(&rows, 3)
}

/// Mechanisms by family.
pub fn courses(tally: &Tally) -> String {
    let header = [
        "family",
        "made",
        "moved",
        "path ends",
        "path goes through a singular pose",
    ];
    let mut rows = vec![header.map(str::to_string)];
    for (family, [made, moved, ends, crosses]) in &tally.courses {
        rows.push([
            FAMILIES[*family].0.to_string(),
            made.to_string(),
            moved.to_string(),
            ends.to_string(),
            crosses.to_string(),
        ]);
    }
    aligned(&rows, 1)
}

/// Mechanisms that were not moved.
pub fn unused(tally: &Tally) -> String {
    let mut rows = vec![["family", "why", "mechanisms"].map(str::to_string)];
    for ((family, why), (count, _)) in &tally.unused {
        rows.push([
            FAMILIES[*family].0.to_string(),
            why.clone(),
            count.to_string(),
        ]);
    }
    aligned(&rows, 2)
}

/// Wrong answers, at most `most` of them.
pub fn wrong(tally: &Tally, seed: u64, most: usize) -> String {
    let mut text = String::new();
    for it in tally.wrong.iter().take(most) {
        let _ = writeln!(
            text,
            "- {}, {}: {}; `{}`",
            FAMILIES[it.course.0].0,
            it.view.words(),
            it.why,
            command(it, seed)
        );
    }
    if tally.wrong.len() > most {
        let _ = writeln!(text, "- and {} more", tally.wrong.len() - most);
    }
    text
}

/// Summary of the run.
pub fn summary(tally: &Tally, seconds: f64) -> String {
    let total = tally.total();
    let [made, moved] =
        [0, 1].map(|place| tally.courses.values().map(|it| it[place]).sum::<usize>());
    format!(
        "{made} mechanisms were made and {moved} of them moved: {} solves in {seconds:.0} s, {} correct, {} refused although the path goes on, {} failures where it ends, {} unjudged, **{} wrong**.\n",
        total.solves,
        total.correct,
        total.refused,
        total.ended,
        total.unjudged,
        total.wrong()
    )
}

/// Report.
pub fn report(tally: &Tally, seed: u64, command: &str, environment: &str, summary: &str) -> String {
    let mut text = format!(
        "# The hunt for frames off the path\n\nWritten by `{command}`.\n\n{environment}\n{summary}\n{EXPLANATION}\n## Outcomes\n\n{}",
        outcomes(tally)
    );
    if !tally.wrong.is_empty() {
        let _ = write!(text, "\n## Wrong answers\n\n{}", wrong(tally, seed, 100));
    }
    let _ = write!(
        text,
        "\n## Steps that are refused although the path goes on\n\nBy the size of the step in shortest periods, one call each, of the interpreter.\n\n{}\n{}",
        refusals(tally),
        kinds(tally, seed)
    );
    let _ = write!(
        text,
        "\n## The mechanisms\n\n{}\n{}",
        courses(tally),
        unused(tally)
    );
    text
}
