//! Counts outcomes of steps by family, refusals by step size, and wrong answers.

use std::collections::BTreeMap;

/// Upper limits of step sizes, in shortest periods, for which refusals are counted together.
pub const SIZES: [f64; 8] = [0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.1, f64::INFINITY];

/// Solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum View {
    /// The interpreter, in f64.
    Interpreted,
    /// Generated code in f64.
    Double,
    /// Generated code in f64 that outputs positions alone, whose frames hold no coordinates.
    Limited,
    /// Generated code in f32.
    Single,
}

impl View {
    /// Label in reports.
    pub fn words(self) -> &'static str {
        match self {
            View::Interpreted => "interpreted, f64",
            View::Double => "generated, f64",
            View::Limited => "generated, f64, positions alone",
            View::Single => "generated, f32",
        }
    }
}

/// Outcome of a step.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// On the path.
    Correct,
    /// Another pose than that of the path.
    Another(String),
    /// A pose where the path has ended.
    Beyond(String),
    /// A failure although the path continues: its kind.
    Refused(String),
    /// A failure where the path ends.
    Ended {
        /// True if the failure names the time at which the path ends.
        is_named: bool,
    },
    /// Not judged: the truth is not known well enough there, or the step before was wrong.
    Unjudged,
}

/// Counts of outcomes.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counts {
    /// Steps requested.
    pub solves: usize,
    /// See [`Outcome`].
    pub correct: usize,
    /// See [`Outcome`].
    pub another: usize,
    /// See [`Outcome`].
    pub beyond: usize,
    /// See [`Outcome`].
    pub refused: usize,
    /// See [`Outcome`].
    pub ended: usize,
    /// Of the ended ones, failures that name another time.
    pub misnamed: usize,
    /// See [`Outcome`].
    pub unjudged: usize,
}

impl Counts {
    /// Number of answers that must not occur.
    pub fn wrong(&self) -> usize {
        self.another + self.beyond
    }

    fn add(&mut self, other: &Counts) {
        self.solves += other.solves;
        self.correct += other.correct;
        self.another += other.another;
        self.beyond += other.beyond;
        self.refused += other.refused;
        self.ended += other.ended;
        self.misnamed += other.misnamed;
        self.unjudged += other.unjudged;
    }
}

/// Steps of one size: all, and those that were refused although the path continues.
#[derive(Clone, Copy, Debug, Default)]
pub struct Refusals {
    /// Steps within the path, in one call.
    pub all: usize,
    /// Refused steps.
    pub refused: usize,
}

/// A wrong or refused step, with what is needed to repeat it.
#[derive(Clone, Debug)]
pub struct Example {
    /// Family and number.
    pub course: (usize, u64),
    /// Solver.
    pub view: View,
    /// Description of the error.
    pub why: String,
}

/// All counts of a run.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// By view and family.
    pub counts: BTreeMap<(View, usize), Counts>,
    /// By family and by size of the step, of the interpreter.
    pub refusals: BTreeMap<usize, [Refusals; SIZES.len()]>,
    /// Refusals by family and kind.
    pub kinds: BTreeMap<(usize, String), (usize, Example)>,
    /// Wrong answers.
    pub wrong: Vec<Example>,
    /// Failures at an end that name another time.
    pub misnamed: Vec<Example>,
    /// Numbers of mechanisms by family: constructed, judged, with a path that ends, with a path through a singular
    /// pose.
    pub courses: BTreeMap<usize, [usize; 4]>,
    /// Reasons why mechanisms were not judged.
    pub unused: BTreeMap<(usize, String), (usize, u64)>,
}

impl Tally {
    /// Counts a step of `size` shortest periods; `None` if the outcome is not that of a step.
    pub fn add(
        &mut self,
        course: (usize, u64),
        view: View,
        size: Option<f64>,
        outcome: Outcome,
        what: &str,
    ) {
        let counts = self.counts.entry((view, course.0)).or_default();
        counts.solves += 1;
        let example = |why: &str| Example {
            course,
            view,
            why: format!("{what}: {why}"),
        };
        match &outcome {
            Outcome::Correct => counts.correct += 1,
            Outcome::Another(why) => {
                counts.another += 1;
                self.wrong.push(example(&format!("another pose, {why}")));
            }
            Outcome::Beyond(why) => {
                counts.beyond += 1;
                self.wrong
                    .push(example(&format!("pose, path ended, {why}")));
            }
            Outcome::Refused(kind) => {
                counts.refused += 1;
                let group = self.kinds.entry((course.0, kind.clone()));
                group.or_insert_with(|| (0, example(kind))).0 += 1;
            }
            Outcome::Ended { is_named } => {
                counts.ended += 1;
                if !is_named {
                    counts.misnamed += 1;
                    self.misnamed.push(example("another time"));
                }
            }
            Outcome::Unjudged => counts.unjudged += 1,
        }
        let is_refused = matches!(outcome, Outcome::Refused(_));
        if let (Some(size), true) = (size, is_refused || outcome == Outcome::Correct)
            && view == View::Interpreted
        {
            let place = SIZES
                .iter()
                .position(|largest| size <= *largest)
                .unwrap_or(SIZES.len() - 1);
            let group = &mut self.refusals.entry(course.0).or_default()[place];
            group.all += 1;
            group.refused += usize::from(is_refused);
        }
    }

    /// Counts a mechanism that is not judged.
    pub fn skip(&mut self, course: (usize, u64), why: String) {
        self.courses.entry(course.0).or_default()[0] += 1;
        let group = self.unused.entry((course.0, why)).or_insert((0, course.1));
        group.0 += 1;
    }

    /// All views and families together.
    pub fn total(&self) -> Counts {
        let mut total = Counts::default();
        self.counts.values().for_each(|it| total.add(it));
        total
    }

    /// Sum of both.
    pub fn merge(&mut self, other: Tally) {
        for (key, counts) in other.counts {
            self.counts.entry(key).or_default().add(&counts);
        }
        for (key, groups) in other.refusals {
            let sums = self.refusals.entry(key).or_default();
            for (sums, group) in sums.iter_mut().zip(groups) {
                sums.all += group.all;
                sums.refused += group.refused;
            }
        }
        for (key, (count, example)) in other.kinds {
            self.kinds.entry(key).or_insert_with(|| (0, example)).0 += count;
        }
        self.wrong.extend(other.wrong);
        self.misnamed.extend(other.misnamed);
        for (key, counts) in other.courses {
            let sums = self.courses.entry(key).or_default();
            sums.iter_mut()
                .zip(counts)
                .for_each(|(sums, count)| *sums += count);
        }
        for (key, (count, number)) in other.unused {
            self.unused.entry(key).or_insert((0, number)).0 += count;
        }
    }
}
