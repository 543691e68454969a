//! Tables in Markdown of the verdicts on every sample of a family by every procedure.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::blocks::Blocks;
use super::cause::{Cause, NO_DIGITS};
use super::chart::Series;
use super::families::Family;
use super::truth::Truth;
use super::verdict::{Judge, Scalar, Verdict, Way, exact};
use crate::description;

/// Number of solves of each sample: three procedures in each scalar.
pub const WAYS: usize = 6;

/// Family with the verdicts on its samples.
pub struct Judged {
    /// The family.
    pub family: Family,
    /// Verdict for each sample and procedure, those in f64 first.
    pub verdicts: Vec<[Verdict; WAYS]>,
}

/// Numbers of cells by outcome.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Counts {
    /// Solved within the bound.
    pub solved: usize,
    /// Of these, at another pose than the one on the path, by the procedure that does not promise the path.
    pub elsewhere: usize,
    /// Of these, with a bound that leaves less than three digits: in f64 and in f32.
    pub without_digits: [usize; 2],
    /// Of these, with an actual error that large.
    pub far_off: [usize; 2],
    /// A typed failure at an instant that has a pose, by its cause, in f64 and in f32.
    pub failed: BTreeMap<Cause, [usize; 2]>,
    /// A typed failure at an instant without a pose.
    pub impossible: usize,
    /// Wrong answers.
    pub wrong: usize,
    /// Largest ratios of error to bound and of error to expected error, for every solved cell.
    pub ratios: Vec<[f64; 2]>,
}

impl Counts {
    /// Counts a cell.
    pub fn add(&mut self, verdict: &Verdict, scalar: Scalar) {
        let side = usize::from(scalar == Scalar::F32);
        match verdict {
            Verdict::Solved(answer) => {
                self.solved += 1;
                self.elsewhere += usize::from(answer.elsewhere);
                self.far_off[side] += usize::from(answer.error > NO_DIGITS);
                self.without_digits[side] += usize::from(answer.bound > NO_DIGITS);
                self.ratios.push([answer.ratio, answer.deviations]);
            }
            Verdict::Failed {
                cause: Some(cause), ..
            } => self.failed.entry(*cause).or_default()[side] += 1,
            Verdict::Failed { cause: None, .. } => self.impossible += 1,
            Verdict::Wrong { .. } => self.wrong += 1,
        }
    }

    /// Number of failures at instants that have a pose.
    pub fn failures(&self) -> usize {
        self.failed.values().flatten().sum()
    }

    /// Number of cells.
    pub fn total(&self) -> usize {
        self.solved + self.failures() + self.impossible + self.wrong
    }

    /// Summary: numbers of cells by outcome, causes of failures, and tightness of the bounds.
    pub fn summary(&self) -> String {
        let mut text = format!(
            "{} cells:\n\n| outcome | f64 and f32 |\n|---|---|\n| within the bound | {} |\n| a typed failure where there is a pose | {} |\n| a typed failure where there is none, or the description is refused | {} |\n| **wrong** | **{}** |\n",
            self.total(),
            self.solved,
            self.failures(),
            self.impossible,
            self.wrong
        );
        let _ = write!(
            text,
            "\nOf the answers {} are another pose than the one on the path, all of plain `assemble` and `advance`, which promise no more. \
             The bound leaves less than three digits in {} answers in f64 and {} in f32; {} and {} are really off by more than 1e-3.\n",
            self.elsewhere,
            self.without_digits[0],
            self.without_digits[1],
            self.far_off[0],
            self.far_off[1]
        );
        text += "\n| cause of a failure although there is a pose | f64 | f32 |\n|---|---|---|\n";
        for cause in Cause::ALL {
            let [double, single] = self.failed.get(&cause).copied().unwrap_or_default();
            let _ = writeln!(text, "| {} | {double} | {single} |", cause.words());
        }
        text += "\n| largest error of a cell, as a part of | under 0.001 | to 0.01 | to 0.05 | to 0.2 | to 1 | to 3 | above |\n|---|---|---|---|---|---|---|---|\n";
        for (name, place) in [("its bound", 0), ("what was expected", 1)] {
            let limits = [0.001, 0.01, 0.05, 0.2, 1.0, 3.0, f64::INFINITY];
            let _ = write!(text, "| {name} |");
            let mut below = 0.0;
            for limit in limits {
                let within =
                    |it: &&[f64; 2]| (it[place] > below || below == 0.0) && it[place] <= limit;
                let _ = write!(text, " {} |", self.ratios.iter().filter(within).count());
                below = limit;
            }
            text.push('\n');
        }
        text
    }
}

/// Solves every `stride`th sample of a family by every procedure.
pub fn judged(mut family: Family, stride: usize) -> Judged {
    family.samples = family.samples.into_iter().step_by(stride).collect();
    let derived = description::system(family.compiled.name);
    let truth = Truth::new(&derived);
    let blocks = Blocks::new(&derived).expect("the study's mechanisms have a plan");
    let verdicts = family.samples.iter().map(|sample| {
        let exact = [Scalar::F64, Scalar::F32].map(|scalar| exact(&truth, sample, scalar));
        std::array::from_fn(|way| {
            let side = way / Way::ALL.len();
            let judge = Judge {
                truth: &truth,
                blocks: &blocks,
                scalar: [Scalar::F64, Scalar::F32][side],
            };
            let way = Way::ALL[way % Way::ALL.len()];
            let solve = |is_negative| family.compiled.run(side, way, sample, is_negative);
            judge.judge(sample, &exact[side], way, solve)
        })
    });
    let verdicts = verdicts.collect();
    Judged { family, verdicts }
}

/// Text of a cell.
pub fn cell(verdict: &Verdict) -> String {
    match verdict {
        Verdict::Solved(answer) => {
            let mut text = format!(
                "{:.0e} ({:.0e}) ≤ {:.0e}, {:.2}",
                answer.error, answer.expected, answer.bound, answer.ratio
            );
            if answer.bound > NO_DIGITS {
                text += " no digits";
            }
            if answer.elsewhere {
                text += ", another pose";
            }
            text
        }
        Verdict::Failed {
            kind,
            solved,
            cause,
        } => {
            let after = if *solved > 0 {
                format!(" after {solved}")
            } else {
                String::new()
            };
            let remark = match cause {
                None => ", no pose".to_string(),
                Some(Cause::Other) => " **(other)**".to_string(),
                Some(cause) => format!(" ({cause:?})").to_lowercase(),
            };
            format!("{kind}{after}{remark}")
        }
        Verdict::Wrong { why } => format!("**WRONG**: {why}"),
    }
}

impl Judged {
    /// Names of the procedures.
    pub fn ways(&self) -> [String; WAYS] {
        let solved = self.family.compiled.solved;
        let name =
            |scalar: &str| ["followed", "plain", solved].map(|way| format!("{way} {scalar}"));
        let [a, b, c] = name("f64");
        let [d, e, f] = name("f32");
        [a, b, c, d, e, f]
    }

    /// Table of the family.
    pub fn table(&self) -> String {
        let mut text = format!("| {} |", self.family.varies);
        for way in self.ways() {
            let _ = write!(text, " {way} |");
        }
        text += "\n|---|---|---|---|---|---|---|\n";
        for (sample, verdicts) in self.family.samples.iter().zip(&self.verdicts) {
            let _ = write!(text, "| {:e} |", sample.x);
            for verdict in verdicts {
                let _ = write!(text, " {} |", cell(verdict));
            }
            text.push('\n');
        }
        text
    }

    /// Series of the chart.
    pub fn series(&self) -> Vec<Series> {
        let ways = self.ways().into_iter().enumerate();
        // The curves of the two textbook procedures would cover one another.
        let ways = ways.filter(|(way, _)| Way::ALL[way % Way::ALL.len()] != Way::Plain);
        ways.map(|(way, label)| {
            let samples = self.family.samples.iter().zip(&self.verdicts);
            let points = samples.filter_map(|(sample, verdicts)| match &verdicts[way] {
                Verdict::Solved(answer) => Some((sample.x, answer.error, answer.bound)),
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
