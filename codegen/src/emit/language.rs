//! Languages of generated modules, and the files of a mechanism in each.
//!
//! [`Language`] is the list; the folder of a language states its [`Conventions`].

use super::scalar::Scalar;
use super::{c, rust};
use crate::model::Naming;
use crate::solved::Solved;

/// Language of a module.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Language {
    /// Module that requires only `linkwright`.
    #[default]
    Rust,
    /// Header and source of C99, and the runtime that they are compiled with.
    C,
}

/// Names and files of a language.
#[derive(Debug)]
pub struct Conventions {
    /// Name in options: `c`.
    pub option: &'static str,
    /// Name in sentences: `C`.
    pub name: &'static str,
    /// Description in help.
    pub about: &'static str,
    /// Noun for its files in messages: `generated C`.
    pub noun: &'static str,
    /// Returns true for the first line of its files.
    pub is_first_line: fn(&str) -> bool,
    /// Endings of the names of a mechanism's own files, the first file's first: `c`, `h`.
    pub extensions: &'static [&'static str],
    /// Files that all mechanisms of a folder share.
    pub shared_files: &'static [&'static str],
    /// Files beside the first one, in words; `None` if there are none.
    pub beside: Option<&'static str>,
    /// Returns the objection to names of files that begin so; `None` if there is none.
    pub objection: fn(stem: &str) -> Option<&'static str>,
    /// Rules for names of a description.
    pub(crate) naming: Naming,
    /// Returns the texts of all files, with the arguments of [`Language::files`].
    pub(crate) texts: fn(&[Solved], stem: &str, Form<'_>) -> Vec<String>,
}

/// Numbers and functions of a module.
#[derive(Clone, Copy, Debug, Default)]
pub struct Form<'a> {
    pub scalar: Scalar,
    /// Path of a type with elementary functions, in languages that have types with functions; `None` for those of the runtime.
    pub math: Option<&'a str>,
    /// True if the module solves several mechanisms at once as well.
    pub has_lanes: bool,
}

/// File to be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OutputFile {
    /// Name, in the folder of the first file.
    pub name: String,
    /// Contents, ending in a line break.
    pub text: String,
}

impl Language {
    /// All languages, the default first.
    pub const ALL: [Language; 2] = [Language::Rust, Language::C];

    /// Names and files of the language.
    #[doc(hidden)]
    pub fn conventions(self) -> &'static Conventions {
        match self {
            Language::Rust => &rust::CONVENTIONS,
            Language::C => &c::CONVENTIONS,
        }
    }

    /// Names of the files of a mechanism; the first is `stem` and the suffix of the language.
    pub fn file_names(self, stem: &str) -> Vec<String> {
        let conventions = self.conventions();
        let extensions = conventions.extensions.iter();
        let names = extensions.map(|extension| format!("{stem}.{extension}"));
        let shared = conventions.shared_files.iter().map(ToString::to_string);
        names.chain(shared).collect()
    }

    /// Files of the motions of one mechanism, under the names of [`Language::file_names`].
    pub(crate) fn files(self, motions: &[Solved], stem: &str, form: Form<'_>) -> Vec<OutputFile> {
        let texts = (self.conventions().texts)(motions, stem, form);
        let names = self.file_names(stem).into_iter();
        let files = names.zip(texts);
        files
            .map(|(name, text)| OutputFile { name, text })
            .collect()
    }
}
