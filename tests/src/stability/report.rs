//! *Families* → *verdicts of every sample in every way*, as tables in Markdown.

use std::fmt::Write as _;

use super::chart::Series;
use super::families::Family;
use super::truth::Truth;
use super::verdict::{Scalar, Verdict, exact, judge};
use crate::description;

/// A family with the verdicts of its samples: textbook and solved view in f64, then in f32.
pub struct Judged {
    /// The family.
    pub family: Family,
    /// Four verdicts for each sample.
    pub verdicts: Vec<[Verdict; 4]>,
}

/// How many cells ended how.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Solved within the bound.
    pub solved: usize,
    /// Of these, where the bound leaves less than three digits.
    pub without_digits: usize,
    /// Of these, those that are really off by more than that.
    pub far_off: usize,
    /// A typed failure where there is a pose.
    pub failed: usize,
    /// A typed failure where there is none.
    pub impossible: usize,
    /// Wrong answers.
    pub wrong: usize,
}

/// The bound of a pose beyond which it has less than three digits.
const NO_DIGITS: f64 = 1e-3;

impl Counts {
    /// Counts a cell.
    pub fn add(&mut self, verdict: &Verdict) {
        match verdict {
            Verdict::Solved { error, bound, .. } => {
                self.solved += 1;
                self.far_off += usize::from(*error > NO_DIGITS);
                self.without_digits += usize::from(*bound > NO_DIGITS);
            }
            Verdict::Failed { exists: true, .. } => self.failed += 1,
            Verdict::Failed { exists: false, .. } => self.impossible += 1,
            Verdict::Wrong { .. } => self.wrong += 1,
        }
    }
}

/// Solves every `stride`th sample of a family in every way.
pub fn judged(mut family: Family, stride: usize) -> Judged {
    family.samples = family.samples.into_iter().step_by(stride).collect();
    let system = description::system(family.compiled.name);
    let truth = Truth::new(&system);
    let characteristic = system.mechanism.characteristic_length;
    let verdicts = family.samples.iter().map(|sample| {
        let doubles = exact(&truth, sample, Scalar::F64);
        let singles = exact(&truth, sample, Scalar::F32);
        std::array::from_fn(|way| {
            let (scalar, exact) = if way < 2 {
                (Scalar::F64, &doubles)
            } else {
                (Scalar::F32, &singles)
            };
            // Residuals are judged against the drawing's length at the default values of the parameters; closed forms have none.
            let iterates = way % 2 == 0 || family.compiled.solved != "closed form";
            let length = if iterates {
                characteristic.max(sample.length)
            } else {
                sample.length
            };
            let runner = family.compiled.runners[way];
            judge(&truth, sample, exact, scalar, runner, length)
        })
    });
    let verdicts = verdicts.collect();
    Judged { family, verdicts }
}

fn cell(verdict: &Verdict) -> String {
    match verdict {
        Verdict::Solved {
            error,
            bound,
            ratio,
        } => {
            let remark = if *bound > NO_DIGITS {
                " (no digits)"
            } else {
                ""
            };
            format!("{error:.0e} of {bound:.0e}, {ratio:.2}{remark}")
        }
        Verdict::Failed {
            kind,
            solved,
            exists,
        } => {
            let after = if *solved > 0 {
                format!(" after {solved}")
            } else {
                String::new()
            };
            let remark = if *exists { "" } else { ", no pose" };
            format!("{kind}{after}{remark}")
        }
        Verdict::Wrong { why } => format!("**WRONG**: {why}"),
    }
}

impl Judged {
    /// The names of the four ways.
    pub fn ways(&self) -> [String; 4] {
        let solved = self.family.compiled.solved;
        [
            "textbook f64".to_string(),
            format!("{solved} f64"),
            "textbook f32".to_string(),
            format!("{solved} f32"),
        ]
    }

    /// The table of the family.
    pub fn table(&self) -> String {
        let mut text = format!("| {} |", self.family.varies);
        for way in self.ways() {
            let _ = write!(text, " {way} |");
        }
        text += "\n|---|---|---|---|---|\n";
        for (sample, verdicts) in self.family.samples.iter().zip(&self.verdicts) {
            let _ = write!(text, "| {:e} |", sample.x);
            for verdict in verdicts {
                let _ = write!(text, " {} |", cell(verdict));
            }
            text.push('\n');
        }
        text
    }

    /// What a chart shows.
    pub fn series(&self) -> Vec<Series> {
        let ways = self.ways().into_iter().enumerate();
        ways.map(|(way, label)| {
            let samples = self.family.samples.iter().zip(&self.verdicts);
            let points = samples.filter_map(|(sample, verdicts)| match &verdicts[way] {
                Verdict::Solved { error, bound, .. } => Some((sample.x, *error, *bound)),
                _ => None,
            });
            Series {
                label,
                points: points.collect(),
            }
        })
        .collect()
    }
}
