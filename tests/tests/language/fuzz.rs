//! Runs the targets of `tests/fuzz/` on a stable compiler: all inputs of the corpus, all descriptions of the
//! repository, and mutations of them and random bytes, some thousand or as many as fit into
//! `LINKWRIGHT_FUZZ_SECONDS`. `cargo fuzz` searches farther; see `tests/fuzz/README.md`.

use std::fs;
use std::time::{Duration, Instant};

use linkwright_tests::files;
use linkwright_tests::random::Random;

use crate::corpora::{Corpus, Input};
use crate::targets::{expressions, language, numbers};

/// Seed of all mutations, unless `LINKWRIGHT_FUZZ_SEED` gives another one.
const SEED: u64 = 0x6675_7a7a;

/// Runs a check on inputs made from random bits: `count` of them, or as many as fit into the time limit.
///
/// A failure is printed with its seed and number, which reproduce it.
fn repeat(count: usize, check: &mut dyn FnMut(&mut Random)) {
    let variable = |name: &str| {
        let text = std::env::var(name).ok()?;
        let value = text.parse::<u64>();
        Some(value.unwrap_or_else(|_| panic!("{name} is a whole number, not `{text}`")))
    };
    let seed = variable("LINKWRIGHT_FUZZ_SEED").unwrap_or(SEED);
    let duration = variable("LINKWRIGHT_FUZZ_SECONDS").map(Duration::from_secs);
    let (begun, mut random, mut number) = (Instant::now(), Random::new(seed), 0);
    println!("seed {seed}");
    let goes_on = |number: usize| match duration {
        Some(duration) => begun.elapsed() < duration,
        None => number < count,
    };
    while goes_on(number) {
        let _input = Input(format!("input {number}"));
        let next = Instant::now();
        check(&mut random);
        // A short input that takes long is a finding, too.
        let taken = next.elapsed();
        assert!(taken < INPUT_TIME_LIMIT, "input {number} took {taken:?}");
        number += 1;
    }
    println!("{number} inputs");
}

/// Time limit for one input, on a machine with other work.
const INPUT_TIME_LIMIT: Duration = Duration::from_secs(20);

fn below(random: &mut Random, end: usize) -> usize {
    (random.bits() % end.max(1) as u64) as usize
}

/// Words that a description is made of, and characters that it is not.
const PIECES: [&str; 40] = [
    "{",
    "}",
    "(",
    ")",
    "[",
    "]",
    ";",
    ",",
    ".",
    ":",
    "=",
    "->",
    "+",
    "-",
    "*",
    "/",
    "^",
    "<",
    "if",
    "else",
    "t",
    "pi",
    "1e400",
    "1e-400",
    "0",
    "-1",
    "1e308mm",
    "sqrt(",
    "body",
    "ground",
    "drive",
    "motion",
    "param",
    "table",
    "redundant",
    "along",
    "é",
    "\u{202e}",
    "\"",
    "/*",
];

/// A text with some parts of it removed, doubled, moved or replaced.
fn mutated(bytes: &[u8], others: &[Vec<u8>], random: &mut Random) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for _ in 0..1 + below(random, 4) {
        let start = below(random, bytes.len());
        let end = (start + below(random, 40)).min(bytes.len());
        match below(random, 6) {
            0 => drop(bytes.drain(start..end)),
            1 => {
                let part = bytes[start..end].to_vec();
                let place = below(random, bytes.len());
                bytes.splice(place..place, part);
            }
            2 => {
                let piece = PIECES[below(random, PIECES.len())];
                bytes.splice(start..start, piece.bytes());
            }
            3 => {
                if let Some(byte) = bytes.get_mut(start) {
                    *byte = random.bits() as u8;
                }
            }
            4 => {
                let other = &others[below(random, others.len())];
                let from = below(random, other.len());
                let to = (from + below(random, 80)).min(other.len());
                bytes.splice(start..end, other[from..to].iter().copied());
            }
            _ => bytes.truncate(start),
        }
    }
    bytes
}

#[test]
fn descriptions_are_read_or_refused() {
    let folders = ["../mechanisms", "descriptions", "cases/errors"];
    let texts = folders.map(|folder| files::with_extension(&files::package(folder), "mech"));
    let seeds: Vec<Vec<u8>> = texts
        .iter()
        .flatten()
        .map(|path| fs::read(path).expect("a readable file"))
        .collect();
    let mut corpus = Corpus::replayed("language", language::run);
    for seed in &seeds {
        corpus.run(seed);
    }
    let short: Vec<Vec<u8>> = seeds
        .iter()
        .chain(&corpus.inputs)
        .filter(|it| it.len() < 1500)
        .cloned()
        .collect();
    repeat(1000, &mut |random| {
        let seed = &short[below(random, short.len())];
        corpus.run(&mutated(seed, &seeds, random));
    });
    corpus.renew();
}

/// Runs a target on random bytes and on mutations of its corpus in turn.
fn on_bytes(target: &'static str, count: usize, length: usize, run: fn(&[u8]) -> String) {
    let mut corpus = Corpus::replayed(target, run);
    let known = corpus.inputs.clone();
    repeat(count, &mut |random| {
        let input = match random.bits() % 2 {
            0 => (0..length).map(|_| random.bits() as u8).collect(),
            _ => mutated(&known[below(random, known.len())], &known, random),
        };
        corpus.run(&input);
    });
    corpus.renew();
}

#[test]
fn numbers_are_solved_or_refused() {
    on_bytes("numbers", 1500, 96, numbers::run);
}

#[test]
fn formulas_have_their_values_and_rates_or_are_refused() {
    on_bytes("expressions", 4000, 160, expressions::run);
}
