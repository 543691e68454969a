//! What the targets of `tests/fuzz/` do with their input, on all descriptions of the repository, on inputs that once failed, and on some
//! thousand mutations of them, or on as many as fit into `LINKWRIGHT_FUZZ_SECONDS`. `cargo fuzz` looks farther; see
//! `tests/fuzz/README.md`.

use std::fs;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use linkwright_tests::files;
use linkwright_tests::random::Random;

use crate::targets::{expressions, language, numbers};

/// The seed of all mutations, unless `LINKWRIGHT_FUZZ_SEED` is another one.
const SEED: u64 = 0x6675_7a7a;

/// Runs a check on inputs made from random bits: `count` of them, or as many as fit into the time that is given.
///
/// What fails is printed with its seed and number, from which it is made again.
fn repeat(count: usize, check: &mut dyn FnMut(&mut Random)) {
    let given = |name: &str| {
        let text = std::env::var(name).ok()?;
        let value = text.parse::<u64>();
        Some(value.unwrap_or_else(|_| panic!("{name} is a whole number, not `{text}`")))
    };
    let seed = given("LINKWRIGHT_FUZZ_SEED").unwrap_or(SEED);
    let duration = given("LINKWRIGHT_FUZZ_SECONDS").map(Duration::from_secs);
    let (begun, mut random, mut number) = (Instant::now(), Random::new(seed), 0);
    println!("seed {seed}");
    let goes_on = |number: usize| match duration {
        Some(duration) => begun.elapsed() < duration,
        None => number < count,
    };
    while goes_on(number) {
        let _input = Input(number);
        let next = Instant::now();
        check(&mut random);
        // A short input that takes long is a finding, too.
        let taken = next.elapsed();
        assert!(taken < LONGEST, "input {number} took {taken:?}");
        number += 1;
    }
    println!("{number} inputs");
}

/// Number of the input that is being looked at.
struct Input(usize);

impl Drop for Input {
    fn drop(&mut self) {
        if std::thread::panicking() {
            println!("input {} fails", self.0);
        }
    }
}

/// How long one input may take, on a machine that does other things at the same time.
const LONGEST: Duration = Duration::from_secs(20);

/// The files of a folder beside this package's, by name; none where there is no such folder.
fn inputs(folder: &str) -> Vec<Vec<u8>> {
    let Ok(entries) = fs::read_dir(files::package(folder)) else {
        return Vec::new();
    };
    let mut paths: Vec<PathBuf> = entries
        .map(|entry| entry.expect("a listed file").path())
        .collect();
    paths.sort();
    paths
        .iter()
        .map(|path| fs::read(path).expect("a readable file"))
        .collect()
}

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
    for seed in seeds.iter().chain(&inputs("fuzz/regressions/language")) {
        language::run(seed);
    }
    let short: Vec<&Vec<u8>> = seeds.iter().filter(|seed| seed.len() < 1500).collect();
    repeat(1000, &mut |random| {
        let seed = short[below(random, short.len())];
        let input = mutated(seed, &seeds, random);
        language::run(&input);
    });
}

fn noise(random: &mut Random, length: usize) -> Vec<u8> {
    (0..length).map(|_| random.bits() as u8).collect()
}

#[test]
fn numbers_are_solved_or_refused() {
    for input in inputs("fuzz/regressions/numbers") {
        numbers::run(&input);
    }
    repeat(1500, &mut |random| numbers::run(&noise(random, 96)));
}

#[test]
fn formulas_have_their_values_and_rates_or_are_refused() {
    for input in inputs("fuzz/regressions/expressions") {
        expressions::run(&input);
    }
    repeat(4000, &mut |random| expressions::run(&noise(random, 160)));
}
