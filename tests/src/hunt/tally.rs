//! Counts outcomes of each kind, and keeps the smallest mechanism and the first seed of every group.

use std::collections::{BTreeMap, BTreeSet};

use super::judge::Outcome;
use super::ways::Call;

/// Solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum View {
    /// The interpreters, in f64.
    Interpreted,
    /// Generated code in f64.
    Double,
    /// Generated code in f32.
    Single,
}

impl View {
    /// Label in reports.
    pub fn words(self) -> &'static str {
        match self {
            View::Interpreted => "interpreted, f64",
            View::Double => "generated, f64",
            View::Single => "generated, f32",
        }
    }
}

/// Mechanism of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Specimen {
    /// Number of the mechanism.
    pub number: u64,
    /// Number of bodies.
    pub bodies: usize,
}

/// Occurrences of an event.
#[derive(Clone, Debug, Default)]
pub struct Group {
    /// Instants.
    pub count: usize,
    /// Numbers of the mechanisms.
    pub mechanisms: BTreeSet<u64>,
    /// Smallest of them, and the first instant there.
    pub smallest: Option<(Specimen, usize)>,
}

impl Group {
    fn add(&mut self, specimen: Specimen, instant: usize) {
        self.count += 1;
        self.mechanisms.insert(specimen.number);
        let is_smaller = |(best, _): &(Specimen, usize)| {
            (specimen.bodies, specimen.number) < (best.bodies, best.number)
        };
        if self.smallest.as_ref().is_none_or(is_smaller) {
            self.smallest = Some((specimen, instant));
        }
    }
}

/// Numbers of instants by outcome.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// On the path and within the bound.
    pub correct: usize,
    /// Another pose, where the path has one but the call does not promise it.
    pub other: usize,
    /// A pose where the path has ended.
    pub beyond: usize,
    /// A typed failure where the path has a pose.
    pub failed: usize,
    /// A typed failure where the path has ended.
    pub ended: usize,
    /// Wrong answers.
    pub wrong: usize,
}

impl Counts {
    /// Sum of all.
    pub fn total(&self) -> usize {
        self.correct + self.other + self.beyond + self.failed + self.ended + self.wrong
    }

    /// Sum of both.
    #[must_use]
    pub fn plus(self, other: Counts) -> Counts {
        Counts {
            correct: self.correct + other.correct,
            other: self.other + other.other,
            beyond: self.beyond + other.beyond,
            failed: self.failed + other.failed,
            ended: self.ended + other.ended,
            wrong: self.wrong + other.wrong,
        }
    }
}

/// A wrong answer.
#[derive(Clone, Debug)]
pub struct Wrong {
    /// Mechanism.
    pub specimen: Specimen,
    /// Solver.
    pub view: View,
    /// Call.
    pub call: Call,
    /// Index of the instant.
    pub instant: usize,
    /// Description of the error.
    pub why: String,
}

/// All counts of a run.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// By view and call.
    pub counts: BTreeMap<(View, Call), Counts>,
    /// Typed failures where the path has a pose, by view, call and kind.
    pub failures: BTreeMap<(View, Call, String), Group>,
    /// Wrong answers.
    pub wrong: Vec<Wrong>,
    /// Mechanisms that were not hunted, by reason.
    pub unused: BTreeMap<String, Group>,
    /// Numbers of hunted mechanisms, and of those whose path ends.
    pub used: [usize; 2],
    /// The largest ratio of error to bound.
    pub ratio: f64,
}

impl Tally {
    /// Counts an outcome.
    pub fn add(
        &mut self,
        specimen: Specimen,
        view: View,
        call: Call,
        instant: usize,
        outcome: Outcome,
    ) {
        let counts = self.counts.entry((view, call)).or_default();
        match outcome {
            Outcome::Correct { ratio } => {
                counts.correct += 1;
                self.ratio = self.ratio.max(ratio);
            }
            Outcome::Other => counts.other += 1,
            Outcome::Beyond => counts.beyond += 1,
            Outcome::Failed(kind) => {
                counts.failed += 1;
                let group = self.failures.entry((view, call, kind)).or_default();
                group.add(specimen, instant);
            }
            Outcome::Ended(_) => counts.ended += 1,
            Outcome::Wrong(why) => {
                counts.wrong += 1;
                self.wrong.push(Wrong {
                    specimen,
                    view,
                    call,
                    instant,
                    why,
                });
            }
        }
    }

    /// Counts a mechanism that is not hunted.
    pub fn skip(&mut self, specimen: Specimen, reason: String) {
        self.unused.entry(reason).or_default().add(specimen, 0);
    }

    /// All solves.
    pub fn total(&self) -> Counts {
        let all = self.counts.values().copied();
        all.fold(Counts::default(), Counts::plus)
    }
}
