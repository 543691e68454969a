//! Corpora of the fuzz targets: each input is run again, and few inputs stand for all known outcomes.
//!
//! With `FUZZ_CORPUS_UPDATE=1` the shortest input of each outcome is written, with the FNV-1a hash of its content for
//! a name.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;

use linkwright_tests::files;

/// Largest number of inputs of one corpus.
const MAX_INPUTS: usize = 90;

/// Largest number of bytes of an input.
const MAX_INPUT_BYTES: usize = 1500;

/// Names of all targets.
const TARGETS: [&str; 3] = ["language", "numbers", "expressions"];

/// Label of the current input; printed if it fails.
pub struct Input(pub String);

impl Drop for Input {
    fn drop(&mut self) {
        if std::thread::panicking() {
            println!("{} fails", self.0);
        }
    }
}

/// Inputs of a target, and its answers to others.
pub struct Corpus {
    /// Inputs in the repository, by name.
    pub inputs: Vec<Vec<u8>>,
    target: &'static str,
    run: fn(&[u8]) -> String,
    /// The shortest input of each outcome.
    shortest: BTreeMap<String, Vec<u8>>,
}

impl Corpus {
    /// Corpus of a target, which has been run on all of it.
    pub fn replayed(target: &'static str, run: fn(&[u8]) -> String) -> Corpus {
        let mut corpus = Corpus {
            inputs: Vec::new(),
            shortest: BTreeMap::new(),
            target,
            run,
        };
        for (name, input) in stored(target) {
            let _input = Input(format!("corpus/{target}/{name}"));
            corpus.run(&input);
            corpus.inputs.push(input);
        }
        assert!(!corpus.inputs.is_empty(), "the corpus of {target} is empty");
        corpus
    }

    /// Runs the target on an input.
    pub fn run(&mut self, input: &[u8]) {
        let outcome = (self.run)(input);
        let known = self.shortest.get(&outcome);
        let is_shorter = known.is_none_or(|it| (input.len(), input) < (it.len(), it));
        if is_shorter && input.len() <= MAX_INPUT_BYTES {
            self.shortest.insert(outcome, input.to_vec());
        }
    }

    /// Writes the corpus again on request; of too many outcomes, those with the fewest words.
    pub fn renew(self) {
        if std::env::var_os("FUZZ_CORPUS_UPDATE").is_none() {
            return;
        }
        let folder = folder(self.target);
        for (name, _) in stored(self.target) {
            fs::remove_file(folder.join(name)).expect("a file of the corpus");
        }
        let mut outcomes: Vec<(String, Vec<u8>)> = self.shortest.into_iter().collect();
        outcomes.sort_by_key(|(outcome, _)| (outcome.split(' ').count(), outcome.clone()));
        for (_, input) in outcomes.iter().take(MAX_INPUTS) {
            fs::write(folder.join(name(input)), input).expect("it can be written");
        }
    }
}

fn folder(target: &str) -> PathBuf {
    files::package("fuzz/corpus").join(target)
}

/// Inputs in the repository with their names, by name.
fn stored(target: &str) -> Vec<(String, Vec<u8>)> {
    let entries = fs::read_dir(folder(target)).expect("a corpus");
    let mut inputs: Vec<(String, Vec<u8>)> = entries
        .map(|entry| {
            let entry = entry.expect("a listed file");
            let name = entry.file_name().to_string_lossy().into_owned();
            (name, fs::read(entry.path()).expect("a readable file"))
        })
        .collect();
    inputs.sort();
    inputs
}

/// Hash of an input by FNV-1a (Fowler, Noll and Vo), in hexadecimal digits.
fn name(input: &[u8]) -> String {
    let step = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3);
    let hash = input.iter().fold(0xcbf2_9ce4_8422_2325, step);
    format!("{hash:016x}")
}

#[test]
fn corpora_are_small_and_named_by_their_content() {
    // Hash of `a`, as the authors of the hash print it.
    assert_eq!(name(b"a"), "af63dc4c8601ec8c");
    for target in TARGETS {
        let inputs = stored(target);
        assert!((1..=MAX_INPUTS).contains(&inputs.len()), "{target}");
        for (given, input) in inputs {
            assert_eq!(given, name(&input), "{target}");
            assert!(input.len() <= MAX_INPUT_BYTES, "{target}: {given}");
        }
    }
}
