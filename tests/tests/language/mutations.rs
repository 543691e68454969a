//! Whatever the bytes of a description are, the generator answers with code or diagnostics and never panics.
//!
//! The inputs are the good descriptions after random edits, so that most of them reach the later stages. A failing case is
//! printed by proptest, shrunk, with the seed that repeats it.

use std::fs;

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::check;
use linkwright_codegen::stages::emit;
use linkwright_codegen::{Options, generate, read};
use linkwright_tests::{description, files};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

/// Enough for every edit to meet every statement; more where code is fast.
const CASES: u32 = if cfg!(debug_assertions) { 500 } else { 2000 };

/// Pieces of the language, of Rust and of trouble.
const TOKENS: &[&str] = &[
    "mechanism",
    "body",
    "point",
    "const",
    "drive",
    "revolute",
    "translational",
    "absolute_x",
    "absolute_angle",
    "absolute_distance",
    "relative_x",
    "relative_angle",
    "revolute_revolute",
    "revolute_translational",
    "point_on_line",
    "weld",
    "external_gear",
    "crossed_belt",
    "rack",
    "along",
    "facing",
    "turned",
    "at",
    "ground",
    "phi",
    "length",
    "distance",
    "sqrt",
    "atan2",
    "exp",
    "ln",
    "sin",
    "t",
    "pi",
    "{",
    "}",
    "(",
    ")",
    "[",
    "]",
    "->",
    "=",
    ";",
    ",",
    ":",
    ".",
    "+",
    "-",
    "*",
    "/",
    "^",
    "**",
    "'",
    "\"",
    "/*",
    "*/",
    "//",
    "///",
    "//!",
    "#",
    "r#",
    "0",
    "1",
    "2.5",
    "1e999",
    "1e-999",
    "99999999999999999999999999999999999999999",
    "0x1F",
    "1_0",
    "30deg",
    "5mm",
    "2parsec",
    "°",
    "π",
    "µ",
    "\u{0}",
    "\u{feff}",
    "\u{202e}",
    "\n",
    "\r",
    "\t",
    " ",
    "self",
    "Self",
    "_",
    "1.P",
    "^1e9",
    "^(1/3)",
    "^0.5",
    "^-1",
    "/0",
    "sqrt(-1)",
    "distance(A, A)",
    "sin(t)",
    "t^t",
];

/// One change of a text; places are fractions of its length.
#[derive(Clone, Debug)]
enum Edit {
    Flip(f64, u8),
    Delete(f64, usize),
    Duplicate(f64, usize),
    Insert(f64, usize),
    DeleteLine(f64),
    DuplicateLine(f64),
    Truncate(f64),
    Splice(f64, usize, f64),
    Swap(f64, f64, usize),
    Bytes(f64, Vec<u8>),
}

fn edit() -> impl Strategy<Value = Edit> {
    let at = || 0.0..1.0;
    prop_oneof![
        1 => (at(), any::<u8>()).prop_map(|(at, mask)| Edit::Flip(at, mask)),
        1 => (at(), 1_usize..80).prop_map(|(at, count)| Edit::Delete(at, count)),
        1 => (at(), 1_usize..200).prop_map(|(at, count)| Edit::Duplicate(at, count)),
        4 => (at(), 0..TOKENS.len()).prop_map(|(at, token)| Edit::Insert(at, token)),
        3 => at().prop_map(Edit::DeleteLine),
        2 => at().prop_map(Edit::DuplicateLine),
        1 => at().prop_map(Edit::Truncate),
        1 => (at(), any::<usize>(), at()).prop_map(|(at, other, from)| Edit::Splice(at, other, from)),
        1 => (at(), at(), 1_usize..40).prop_map(|(one, other, count)| Edit::Swap(one, other, count)),
        1 => (at(), prop::collection::vec(any::<u8>(), 1..20)).prop_map(|(at, bytes)| Edit::Bytes(at, bytes)),
    ]
}

fn place(bytes: &[u8], at: f64) -> usize {
    (at * bytes.len() as f64) as usize
}

/// The line at a place, with its line break.
fn line(bytes: &[u8], at: f64) -> std::ops::Range<usize> {
    let (before, after) = bytes.split_at(place(bytes, at));
    let start = before
        .iter()
        .rposition(|byte| *byte == b'\n')
        .map_or(0, |at| at + 1);
    let end = after
        .iter()
        .position(|byte| *byte == b'\n')
        .map_or(bytes.len(), |at| before.len() + at + 1);
    start..end
}

impl Edit {
    fn apply(&self, bytes: &mut Vec<u8>, good: &[Vec<u8>]) {
        let range = |bytes: &[u8], at: f64, count: usize| {
            let from = place(bytes, at);
            from..(from + count).min(bytes.len())
        };
        match self {
            Edit::Flip(at, mask) => {
                let at = place(bytes, *at);
                if let Some(byte) = bytes.get_mut(at) {
                    *byte ^= mask;
                }
            }
            Edit::Delete(at, count) => drop(bytes.drain(range(bytes, *at, *count))),
            Edit::Duplicate(at, count) => {
                let range = range(bytes, *at, *count);
                let copy = bytes[range.clone()].to_vec();
                bytes.splice(range.end..range.end, copy);
            }
            Edit::Insert(at, token) => {
                let at = place(bytes, *at);
                bytes.splice(at..at, TOKENS[*token].bytes());
            }
            Edit::DeleteLine(at) => drop(bytes.drain(line(bytes, *at))),
            Edit::DuplicateLine(at) => {
                let range = line(bytes, *at);
                let copy = bytes[range.clone()].to_vec();
                bytes.splice(range.end..range.end, copy);
            }
            Edit::Truncate(at) => bytes.truncate(place(bytes, *at)),
            Edit::Splice(at, other, from) => {
                let other = &good[other % good.len()];
                bytes.truncate(place(bytes, *at));
                bytes.extend(&other[place(other, *from)..]);
            }
            Edit::Swap(one, other, count) => {
                for offset in 0..*count {
                    let (one, other) = (place(bytes, *one) + offset, place(bytes, *other) + offset);
                    if one < bytes.len() && other < bytes.len() {
                        bytes.swap(one, other);
                    }
                }
            }
            Edit::Bytes(at, inserted) => {
                let at = place(bytes, *at);
                bytes.splice(at..at, inserted.iter().copied());
            }
        }
    }
}

/// All that is done with a description, the printing of its findings included. Says how far it came.
fn digest(bytes: &[u8]) -> Outcome {
    let source = match Source::from_bytes("mutated.mech", bytes) {
        Ok(source) => source,
        Err(unreadable) => {
            let (source, found) = *unreadable;
            assert!(!found.render(&source).is_empty());
            return Outcome::Unreadable;
        }
    };
    let errors = match generate(&source, &Options::default()) {
        Ok(generated) => {
            assert!(generated.code().ends_with('\n'));
            let parsed = syn::parse_file(generated.code());
            assert!(parsed.is_ok(), "the module is not Rust: {:?}", parsed.err());
            return Outcome::Generated;
        }
        Err(errors) => errors,
    };
    assert!(errors.has_errors(), "a refusal needs an error");
    assert!(!errors.render(&source).is_empty());
    for finding in errors.iter() {
        assert!(!finding.help.is_empty(), "{}", finding.render(&source));
    }
    let Ok(read) = read(&source) else {
        return Outcome::Refused;
    };
    // Readable, but not determined, or without values: it can still be inspected.
    assert!(read.motions.iter().any(|derived| check(derived).is_err()));
    for derived in &read.motions {
        let printed = emit::text::inspect(derived, emit::Notation::Unicode);
        assert!(!printed.is_empty() && !emit::latex::inspect(&[(derived, Vec::new())]).is_empty());
    }
    Outcome::Undetermined
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Outcome {
    Unreadable,
    Refused,
    Undetermined,
    Generated,
}

/// The descriptions to start from: those that are right, then those of the diagnostics.
fn originals() -> [Vec<Vec<u8>>; 2] {
    let right = [description::names(), description::small()].concat();
    let right = right
        .iter()
        .map(|name| description::source(name).text.into_bytes());
    let wrong = files::with_extension(&files::package("cases/errors"), "mech");
    let wrong = wrong
        .iter()
        .map(|path| fs::read(path).expect("a case file"));
    [right.collect(), wrong.collect()]
}

/// Runner with equal cases on every machine and run; a failure can be repeated.
fn runner() -> TestRunner {
    let config = Config {
        cases: CASES,
        failure_persistence: None,
        ..Config::default()
    };
    TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha))
}

#[test]
fn edited_descriptions_never_panic_the_generator() {
    let originals = originals();
    let all = originals.concat();
    let strategy = (
        0_usize..2,
        any::<usize>(),
        prop::collection::vec(edit(), 1..5),
    );
    let outcomes = std::cell::RefCell::new(Vec::new());
    let result = runner().run(&strategy, |(kind, index, edits)| {
        let mut bytes = originals[kind][index % originals[kind].len()].clone();
        for edit in &edits {
            edit.apply(&mut bytes, &all);
        }
        outcomes.borrow_mut().push(digest(&bytes));
        Ok(())
    });
    if let Err(failure) = result {
        panic!("{failure}");
    }
    // Edits that only ever met the lexer would prove little.
    let outcomes = outcomes.into_inner();
    for outcome in [
        Outcome::Unreadable,
        Outcome::Refused,
        Outcome::Undetermined,
        Outcome::Generated,
    ] {
        let count = outcomes.iter().filter(|it| **it == outcome).count();
        println!("{outcome:?}: {count} of {}", outcomes.len());
        assert!(count > 0, "no case was {outcome:?}");
    }
}

#[test]
fn random_bytes_and_random_tokens_never_panic_the_generator() {
    let token = (0..TOKENS.len()).prop_map(|index| TOKENS[index].as_bytes().to_vec());
    let tokens = prop::collection::vec(token, 0..60).prop_map(|tokens| tokens.join(&b' '));
    let inside = tokens.clone().prop_map(|mut tokens| {
        tokens.splice(
            0..0,
            *b"mechanism m { body 1 at (0, 0) { P: (1, 0) } drive phi(1) = ",
        );
        tokens.push(b'}');
        tokens
    });
    let strategy = prop_oneof![prop::collection::vec(any::<u8>(), 0..200), tokens, inside];
    let result = runner().run(&strategy, |bytes| {
        digest(&bytes);
        Ok(())
    });
    if let Err(failure) = result {
        panic!("{failure}");
    }
}
