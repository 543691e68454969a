//! Sums up the sets of a sweep: how many are solved, why others fail, and the extremes over all sets.

use std::collections::BTreeMap;
use std::io::{self, Write};

use linkwright::Blocks as _;
use linkwright_solver::Interpreted;
use linkwright_solver::number::{counted, time};

use linkwright_solver::sets::Extremes;

use super::run::Solved;
use super::shown::Quantity;
use super::table::words;
use super::varied::Varied;

/// Number of significant digits.
const DIGITS: usize = 6;

/// Value with the set in which it occurs, and what is varied there.
type Found = (f64, u64, Vec<f64>);

/// Summary of the sets that are taken.
pub struct Summary<'a> {
    blocks: &'a Interpreted,
    varied: &'a [Varied],
    quantities: &'a [Quantity],
    solved: u64,
    /// Number of failed sets by kind and block, with the first one and its time.
    failures: BTreeMap<(&'static str, String), (u64, u64, f64)>,
    /// Minimum and maximum of each quantity.
    extremes: Vec<Option<[Found; 2]>>,
}

impl<'a> Summary<'a> {
    /// Creates the summary of no sets.
    pub fn new(
        blocks: &'a Interpreted,
        varied: &'a [Varied],
        quantities: &'a [Quantity],
    ) -> Summary<'a> {
        Summary {
            blocks,
            varied,
            quantities,
            solved: 0,
            failures: BTreeMap::new(),
            extremes: vec![None; quantities.len()],
        }
    }

    /// Takes a set.
    pub fn take(&mut self, solved: &Solved<'_>, extremes: &[Option<Extremes>]) {
        if let Some(failure) = solved.outcome.failure {
            let block = self.blocks.explained(&failure).block;
            let block = block.map_or(String::new(), |it| it.name.to_string());
            let first = (0, solved.set, failure.time);
            let failures = self
                .failures
                .entry((words(&failure), block))
                .or_insert(first);
            failures.0 += 1;
            return;
        }
        self.solved += 1;
        for (all, extremes) in self.extremes.iter_mut().zip(extremes) {
            let Some(Extremes { minimum, maximum }) = extremes else {
                continue;
            };
            let at = |value: f64| (value, solved.set, solved.given.to_vec());
            let all = all.get_or_insert_with(|| [at(minimum[0]), at(maximum[0])]);
            if minimum[0] < all[0].0 {
                all[0] = at(minimum[0]);
            }
            if maximum[0] > all[1].0 {
                all[1] = at(maximum[0]);
            }
        }
    }

    /// Writes the summary.
    ///
    /// # Errors
    /// Errors of `output`.
    pub fn write(&self, output: &mut dyn Write) -> io::Result<()> {
        let failed: u64 = self.failures.values().map(|it| it.0).sum();
        writeln!(
            output,
            "{} of {} solved",
            self.solved,
            sets(self.solved + failed)
        )?;
        for ((words, block), (count, set, t)) in &self.failures {
            let of = if block.is_empty() { "" } else { ": " };
            let (count, t) = (sets(*count), time(*t));
            writeln!(
                output,
                "  {count} failed: {block}{of}{words}, first set {set} at t = {t} s"
            )?;
        }
        for (quantity, found) in self.quantities.iter().zip(&self.extremes) {
            let Some([minimum, maximum]) = found else {
                continue;
            };
            writeln!(output, "{}", quantity.header())?;
            for (word, (value, set, given)) in [("min", minimum), ("max", maximum)] {
                let varied = self.varied.iter().zip(given).map(|(varied, given)| {
                    let unit = match varied.unit.as_str() {
                        "" => String::new(),
                        unit => format!(" {unit}"),
                    };
                    format!("{} = {}{unit}", varied.name, short(varied.written(*given)))
                });
                let varied: Vec<String> = varied.collect();
                let value = short(*value);
                writeln!(output, "  {word} {value}, set {set}: {}", varied.join(", "))?;
            }
        }
        Ok(())
    }
}

/// Returns a number of sets with its noun.
pub fn sets(count: u64) -> String {
    counted(usize::try_from(count).unwrap_or(usize::MAX), "set")
}

/// Returns a number with a few digits.
fn short(value: f64) -> f64 {
    let text = format!("{value:.*e}", DIGITS - 1);
    text.parse().unwrap_or(value)
}
