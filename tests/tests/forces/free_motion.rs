//! Free motions of the gallery from random states, against all coordinates integrated with multipliers.

use linkwright_tests::free_motion::{ANYWHERE, DEAD_CENTERS, Freed, Outcome};
use linkwright_tests::random::Random;

/// Largest error of a motion, in tolerances of the start as they grow.
const ALLOWED: f64 = 100.0;

/// Judges mechanisms; none goes to its end with a larger error, and so many are compared.
fn judge(mechanisms: &[Freed], states: usize, seed: u64, least: usize) {
    let mut random = Random::new(seed);
    let mut compared = 0;
    for mechanism in mechanisms {
        for verdict in mechanism.judged(states, &mut random) {
            println!("{verdict:?}");
            if let Outcome::Went(missed) = verdict.outcome {
                assert!(missed <= ALLOWED, "{verdict:?}");
                compared += 1;
            }
        }
    }
    assert!(compared >= least, "{compared}");
}

#[test]
fn beside_dead_centers_motions_are_right() {
    judge(&DEAD_CENTERS[..4], 2, 32, 14);
}

#[test]
fn around_drawings_motions_are_right() {
    judge(&ANYWHERE[..3], 1, 33, 2);
}
