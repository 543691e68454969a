//! Counts of verdicts, and the tables of the report.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::{ALLOWED, Outcome, Verdict};
use crate::multipliers::larger;
use crate::study::table::aligned;

/// Number of powers of ten of determinants; the last column holds all smaller ones.
const DECADES: usize = 9;

/// The column of a determinant: 1 to 0.1 in the first one.
fn column(determinant: f64) -> usize {
    let digits = (-determinant.log10()).floor();
    digits.clamp(0.0, (DECADES - 1) as f64) as usize
}

/// The verdicts of one mechanism.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// Number of states that were tried.
    pub states: u64,
    /// Those without a start.
    without: u64,
    right: u64,
    wrong: Vec<Verdict>,
    /// By name of the error, and by reason.
    ended: BTreeMap<String, u64>,
    not_compared: BTreeMap<&'static str, u64>,
    /// The largest error by the power of ten of the determinant.
    largest: [Option<f64>; DECADES],
}

impl Tally {
    /// Counts the verdicts of a state.
    pub fn count(&mut self, verdicts: &[Verdict]) {
        self.states += 1;
        self.without += u64::from(verdicts.is_empty());
        for verdict in verdicts {
            match &verdict.outcome {
                Outcome::Went(missed) => {
                    match verdict.is_wrong() {
                        true => self.wrong.push(verdict.clone()),
                        false => self.right += 1,
                    }
                    let largest = &mut self.largest[column(verdict.determinant)];
                    *largest = Some(larger(largest.unwrap_or(0.0), *missed));
                }
                Outcome::Ended(stop) => {
                    let name = stop.split([' ', '(']).next().unwrap_or_default();
                    *self.ended.entry(name.to_string()).or_default() += 1;
                }
                Outcome::NotCompared(reason) => {
                    *self.not_compared.entry(reason).or_default() += 1;
                }
            }
        }
    }

    fn counts(&self) -> [u64; 6] {
        [
            self.states,
            self.without,
            self.right,
            self.wrong.len() as u64,
            self.ended.values().sum(),
            self.not_compared.values().sum(),
        ]
    }

    /// Number of motions that went to their end with a wrong result.
    pub fn wrong(&self) -> usize {
        self.wrong.len()
    }
}

/// The tables of all mechanisms.
pub fn report(tallies: &[(&str, Tally)]) -> String {
    let mut rows = vec![
        [
            "mechanism",
            "states",
            "without a start",
            "right",
            "wrong",
            "ended with an error",
            "no reference",
        ]
        .map(str::to_string)
        .to_vec(),
    ];
    let mut sums = [0; 6];
    for (file, tally) in tallies {
        let counts = tally.counts();
        for (sum, count) in sums.iter_mut().zip(counts) {
            *sum += count;
        }
        let cells = counts.iter().map(u64::to_string);
        rows.push(std::iter::once(file.to_string()).chain(cells).collect());
    }
    let cells = sums.iter().map(u64::to_string);
    rows.push(std::iter::once("all".to_string()).chain(cells).collect());
    let mut text = format!(
        "{}\n## Largest errors by determinant\n\n",
        aligned(&rows, 1)
    );
    let mut titles = vec!["mechanism".to_string()];
    titles.extend((0..DECADES).map(|digits| match digits + 1 == DECADES {
        true => format!("below 1e-{digits}"),
        false => format!("1e-{digits}"),
    }));
    let mut rows = vec![titles];
    for (file, tally) in tallies {
        let cells = tally.largest.iter();
        let cells = cells.map(|it| it.map_or("–".to_string(), |missed| format!("{missed:.1e}")));
        rows.push(std::iter::once(file.to_string()).chain(cells).collect());
    }
    text += &aligned(&rows, 1);
    text += "\n## Errors that ended motions, and reasons of those that were not compared\n\n";
    let mut rows = vec![["mechanism", "why", "motions"].map(str::to_string).to_vec()];
    for (file, tally) in tallies {
        let ended = tally
            .ended
            .iter()
            .map(|(name, count)| (format!("`{name}`"), count));
        let reasons = tally.not_compared.iter();
        let reasons = reasons.map(|(reason, count)| (reason.to_string(), count));
        for (why, count) in ended.chain(reasons) {
            rows.push(vec![file.to_string(), why, count.to_string()]);
        }
    }
    text += &aligned(&rows, 2);
    let wrong = tallies.iter().flat_map(|(_, tally)| &tally.wrong);
    let mut wrong: Vec<&Verdict> = wrong.collect();
    wrong.sort_by_key(|it| (it.file, it.state));
    let _ = write!(text, "\n## Wrong motions: errors above {ALLOWED}\n\n");
    let mut rows = vec![
        ["mechanism", "state", "determinant", "`--rtol`", "error"]
            .map(str::to_string)
            .to_vec(),
    ];
    for verdict in wrong {
        if let Outcome::Went(missed) = verdict.outcome {
            rows.push(vec![
                verdict.file.to_string(),
                verdict.state.to_string(),
                format!("{:.1e}", verdict.determinant),
                format!("{:.0e}", verdict.relative),
                format!("{missed:.1e}"),
            ]);
        }
    }
    match rows.len() {
        1 => text += "None.\n",
        _ => text += &aligned(&rows, 1),
    }
    text
}
