//! Constructs, solves and judges a range of mechanisms of a seed.

use std::io;

use super::judge::{Outcome, judge};
use super::known::{Known, Unused, known};
use super::mechanism::Mechanism;
use super::tally::{Specimen, Tally, View};
use super::ways::{Answered, Task};
use super::{compiled, interpreted, mechanism, seed_of};
use crate::stability::verdict::Scalar;

/// Largest number of bodies.
pub const MAX_BODIES: usize = 8;

/// Mechanism to hunt.
pub struct Hunted {
    /// Seed and number.
    pub specimen: Specimen,
    /// Construction.
    pub mechanism: Mechanism,
    /// Exact motion and bounds.
    pub known: Known,
}

/// Constructs a mechanism of a run; `None` if it cannot be hunted, which is counted.
pub fn prepare(seed: u64, number: u64, tally: &mut Tally) -> Option<Hunted> {
    prepare_this(mechanism(seed, number, MAX_BODIES), seed, number, tally)
}

/// Prepares a given mechanism.
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

/// Solves a mechanism with the interpreter in every formulation and counts the outcomes.
pub fn interpret(hunted: &Hunted, tally: &mut Tally) {
    for answers in interpreted::answers(&hunted.known) {
        count(hunted, View::Interpreted, &answers, tally);
    }
}

/// Solves mechanisms with generated code and counts the outcomes.
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

/// Lines about answers off the path although it has a pose, and about wrong ones.
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

/// Smaller mechanism with the same fault in an interpreted formulation: a wrong answer, or else the first typed
/// failure where the path has a pose; `None` if the mechanism has neither.
pub fn shrink(seed: u64, number: u64) -> Option<Mechanism> {
    let tally_of = |mechanism: &Mechanism| {
        let mut tally = Tally::default();
        if let Some(hunted) = prepare_this(mechanism.clone(), seed, number, &mut tally) {
            interpret(&hunted, &mut tally);
        }
        tally
    };
    let whole = mechanism(seed, number, MAX_BODIES);
    let first = tally_of(&whole);
    let stays: Box<dyn Fn(&Mechanism) -> bool> = if let Some(wrong) = first.wrong.first() {
        let call = wrong.call;
        Box::new(move |it| tally_of(it).wrong.iter().any(|it| it.call == call))
    } else {
        let key = first.failures.keys().next()?.clone();
        Box::new(move |it| tally_of(it).failures.contains_key(&key))
    };
    Some(super::shrink::shrunk(&whole, stays))
}
