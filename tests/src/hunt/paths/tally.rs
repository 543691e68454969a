//! *Outcomes of steps* → *counts by family*, refusals by size of step, and what is wrong.

use std::collections::BTreeMap;

/// The sizes of steps, in shortest periods, up to which refusals are counted together.
pub const SIZES: [f64; 8] = [0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.1, f64::INFINITY];

/// Who solves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum View {
    /// The interpreter, in f64.
    Interpreted,
    /// Generated code in f64.
    Double,
    /// The same with an output of positions alone, whose frames hold no coordinates.
    Limited,
    /// Generated code in f32.
    Single,
}

impl View {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            View::Interpreted => "interpreted, f64",
            View::Double => "generated, f64",
            View::Limited => "generated, f64, positions alone",
            View::Single => "generated, f32",
        }
    }
}

/// What became of a step.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// On the path.
    Correct,
    /// Another pose than that of the path.
    Another(String),
    /// A pose where the path has ended.
    Beyond(String),
    /// A failure where the path goes on: its kind.
    Refused(String),
    /// A failure where the path ends: whether its time is that of the end.
    Ended {
        /// Whether the failure names the time at which the path ends.
        is_named: bool,
    },
    /// Not judged: the truth is not known well enough there, or the step before was wrong.
    Unjudged,
}

/// Counts of outcomes.
#[derive(Clone, Copy, Debug, Default)]
pub struct Counts {
    /// Steps that were asked for.
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
    /// Of those, failures that name another time.
    pub misnamed: usize,
    /// See [`Outcome`].
    pub unjudged: usize,
}

impl Counts {
    /// Answers that must not be.
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

/// Steps of one size: how many on the path, and how many that were refused although it goes on.
#[derive(Clone, Copy, Debug, Default)]
pub struct Refusals {
    /// Steps within the path, in one call.
    pub all: usize,
    /// Of these the refused ones.
    pub refused: usize,
}

/// A step that is wrong, or refused, for whoever wants to repeat it.
#[derive(Clone, Debug)]
pub struct Example {
    /// The family and the number.
    pub course: (usize, u64),
    /// Who.
    pub view: View,
    /// What is wrong.
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
    /// What is wrong.
    pub wrong: Vec<Example>,
    /// Failures at an end whose time is another one.
    pub misnamed: Vec<Example>,
    /// Mechanisms that were made, by family; of these the ones that were judged, the ones whose path ends, and the ones that go
    /// through a singular pose.
    pub courses: BTreeMap<usize, [usize; 4]>,
    /// Why mechanisms were not judged.
    pub unused: BTreeMap<(usize, String), (usize, u64)>,
}

impl Tally {
    /// Counts a step of `size` shortest periods; `None` where it is none.
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

    /// The sum of both.
    pub fn merge(&mut self, other: Tally) {
        for (key, counts) in other.counts {
            self.counts.entry(key).or_default().add(&counts);
        }
        for (key, groups) in other.refusals {
            let own = self.refusals.entry(key).or_default();
            for (own, group) in own.iter_mut().zip(groups) {
                own.all += group.all;
                own.refused += group.refused;
            }
        }
        for (key, (count, example)) in other.kinds {
            self.kinds.entry(key).or_insert_with(|| (0, example)).0 += count;
        }
        self.wrong.extend(other.wrong);
        self.misnamed.extend(other.misnamed);
        for (key, counts) in other.courses {
            let own = self.courses.entry(key).or_default();
            own.iter_mut()
                .zip(counts)
                .for_each(|(own, count)| *own += count);
        }
        for (key, (count, number)) in other.unused {
            self.unused.entry(key).or_insert((0, number)).0 += count;
        }
    }
}
