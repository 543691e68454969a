//! The hunt for wrong answers: random mechanisms whose truth is known by construction, solved by every call.
//!
//! [`builder`] and [`groups`] make a [`mod@mechanism`] from a seed: poses first, then all numbers of the description
//! from them. [`known`] reads its text, follows it with [`track`] and makes it exact in 384 bits. [`judge`] judges
//! the answers of [`interpreted`] and [`compiled`].

pub mod builder;
pub mod compiled;
pub mod groups;
pub mod interpreted;
pub mod joint;
pub mod judge;
pub mod known;
pub mod law;
pub mod legs;
pub mod mechanism;
pub mod mixing;
pub mod motion;
pub mod paths;
pub mod periodic;
pub mod program;
pub mod report;
pub mod run;
pub mod shrink;
pub mod statement;
pub mod tally;
pub mod track;
pub mod ways;

use crate::random::Random;
use builder::Builder;
use mechanism::Mechanism;

/// The seed of one mechanism of a run.
pub fn seed_of(seed: u64, number: u64) -> u64 {
    Random::new(seed.wrapping_add(number.wrapping_mul(0x9e6c_63d0_876a_3f6b))).bits()
}

/// A mechanism of a run, of at most `largest` bodies.
pub fn mechanism(seed: u64, number: u64, largest: usize) -> Mechanism {
    let mut builder = Builder::new(Random::new(seed_of(seed, number)));
    groups::grow(&mut builder, largest);
    builder.finish()
}
