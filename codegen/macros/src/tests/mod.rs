//! The descriptions of the repository as tokens: their meaning, the locations of their errors, and the effects of
//! mutations.

mod errors;
mod heads;
mod mutations;
mod texts;

use std::fs;
use std::path::{Path, PathBuf};

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::stages::files::attach_files;
use proc_macro2::{Group, Span, TokenStream, TokenTree};

use crate::head::Head;
use crate::tokens::{Token, flat};

/// Descriptions in a folder of the repository, in the order of their names.
fn descriptions(folder: &str) -> Vec<Source> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .join(folder);
    let entries = fs::read_dir(&folder).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let mut paths: Vec<PathBuf> = paths
        .filter(|path| path.extension().is_some_and(|it| it == "mech"))
        .collect();
    paths.sort();
    let read = |path: PathBuf| {
        let text = fs::read_to_string(&path).expect("a description");
        attach_files(Source::new(path.display().to_string(), text), &folder)
    };
    paths.into_iter().map(read).collect()
}

/// Tokens of a description; `None` if it is not made of tokens.
fn tokens(text: &str) -> Option<Vec<Token>> {
    let stream: TokenStream = text.parse().ok()?;
    Some(flat(Head::read(stream).description))
}

/// Tokens without locations, as a macro may pass them on.
fn displaced(stream: TokenStream) -> TokenStream {
    let trees = stream.into_iter().map(|tree| {
        let mut tree = match tree {
            TokenTree::Group(group) => {
                let inside = displaced(group.stream());
                TokenTree::Group(Group::new(group.delimiter(), inside))
            }
            other => other,
        };
        tree.set_span(Span::call_site());
        tree
    });
    trees.collect()
}

/// Pseudorandom numbers that are equal on every run: xorshift, after Marsaglia 2003.
struct Random(u64);

impl Random {
    /// Returns a number below `limit`, which is not 0.
    fn below(&mut self, limit: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % limit as u64) as usize
    }
}
