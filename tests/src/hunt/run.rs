//! *A seed and a range of numbers* → *a tally*: constructs, solves and judges.

use std::io;

use super::judge::{Outcome, judge};
use super::known::{Known, Unused, known};
use super::mechanism::Mechanism;
use super::tally::{Specimen, Tally, View};
use super::ways::{Answered, Task};
use super::{compiled, interpreted, mechanism, seed_of};
use crate::stability::verdict::Scalar;

/// The largest number of bodies.
pub const LARGEST: usize = 8;

/// A mechanism that is hunted.
pub struct Hunted {
    /// Which it is.
    pub specimen: Specimen,
    /// How it was constructed.
    pub mechanism: Mechanism,
    /// What is true of it.
    pub known: Known,
}

/// Constructs a mechanism of a run; `None`, counted, where there is nothing to hunt.
pub fn prepare(seed: u64, number: u64, tally: &mut Tally) -> Option<Hunted> {
    prepare_this(mechanism(seed, number, LARGEST), seed, number, tally)
}

/// The same for a mechanism that has been made of that one.
fn prepare_this(mechanism: Mechanism, seed: u64, number: u64, tally: &mut Tally) -> Option<Hunted> {
    let specimen = Specimen {
        number,
        bodies: mechanism.body_order.len(),
    };
    match known(&mechanism, seed_of(seed, number)) {
        Ok(known) => {
            tally.used[0] += 1;
            tally.used[1] += usize::from(known.end == super::track::End::Singular);
            Some(Hunted {
                specimen,
                mechanism,
                known,
            })
        }
        Err(unused) => {
            let reason = match unused {
                Unused::Refused(codes, _) => format!("refused: {codes}"),
                Unused::Singular => "singular at t = 0".to_string(),
                Unused::Undecided => "the tracker gives up".to_string(),
                Unused::Contradiction(why) => format!("CONTRADICTION: {why}"),
            };
            tally.skip(specimen, reason);
            None
        }
    }
}

/// Judges answers and counts the outcomes.
pub fn count(hunted: &Hunted, view: View, answers: &[Answered], tally: &mut Tally) {
    let scalar = match view {
        View::Single => Scalar::F32,
        View::Interpreted | View::Double => Scalar::F64,
    };
    let outcomes = judge(&hunted.known, answers, scalar);
    for (answered, outcome) in answers.iter().zip(outcomes) {
        let (call, instant) = (answered.call, answered.instant);
        tally.add(hunted.specimen, view, call, instant, outcome);
    }
}

/// What interpreted views make of a mechanism.
pub fn interpret(hunted: &Hunted, tally: &mut Tally) {
    for answers in interpreted::answers(&hunted.known) {
        count(hunted, View::Interpreted, &answers, tally);
    }
}

/// What generated code makes of mechanisms.
///
/// # Errors
/// Those of [`compiled::answers`].
pub fn compile(hunted: &[Hunted], tally: &mut Tally) -> io::Result<()> {
    let mechanisms: Vec<&Mechanism> = hunted.iter().map(|it| &it.mechanism).collect();
    let tasks: Vec<&Task> = hunted.iter().map(|it| &it.known.task).collect();
    let all = compiled::answers(&compiled::folder()?, &mechanisms, &tasks)?;
    for (hunted, [double, single]) in hunted.iter().zip(all) {
        count(hunted, View::Double, &double, tally);
        count(hunted, View::Single, &single, tally);
    }
    Ok(())
}

/// What a person may want to look at, line by line: answers that are not those of the path, where it has a pose, and wrong ones.
pub fn findings(hunted: &Hunted, view: View, answers: &[Answered]) -> Vec<String> {
    let scalar = match view {
        View::Single => Scalar::F32,
        View::Interpreted | View::Double => Scalar::F64,
    };
    let outcomes = judge(&hunted.known, answers, scalar);
    let mut lines = Vec::new();
    for (answered, outcome) in answers.iter().zip(outcomes) {
        let expected = matches!(
            outcome,
            Outcome::Correct { .. } | Outcome::Ended(_) | Outcome::Beyond
        );
        if !expected {
            lines.push(format!(
                "{}, {}, instant {}: {outcome:?}",
                view.words(),
                answered.call.words(),
                answered.instant
            ));
        }
    }
    lines
}

/// A smaller mechanism of which an interpreted view makes the same: a wrong answer if there is one, or else the typed failure, where
/// the path has a pose, that comes first; `None` where there is neither.
pub fn shrink(seed: u64, number: u64) -> Option<Mechanism> {
    let found = |mechanism: &Mechanism| {
        let mut tally = Tally::default();
        if let Some(hunted) = prepare_this(mechanism.clone(), seed, number, &mut tally) {
            interpret(&hunted, &mut tally);
        }
        tally
    };
    let whole = mechanism(seed, number, LARGEST);
    let first = found(&whole);
    let stays: Box<dyn Fn(&Mechanism) -> bool> = if let Some(wrong) = first.wrong.first() {
        let call = wrong.call;
        Box::new(move |it| found(it).wrong.iter().any(|it| it.call == call))
    } else {
        let key = first.failures.keys().next()?.clone();
        Box::new(move |it| found(it).failures.contains_key(&key))
    };
    Some(super::shrink::shrunk(&whole, stays))
}
