//! The languages in which modules are written, and what becomes of a mechanism in each.

use super::scalar::Scalar;
use super::{c, rust};
use crate::model::Naming;
use crate::solved::Solved;

/// A language in which a mechanism becomes a module.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Language {
    /// A module that needs `linkwright` and nothing else.
    #[default]
    Rust,
    /// A header and a source of C99, and the runtime that they are compiled with.
    C,
}

/// A file that is to be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OutputFile {
    /// What it is called, in the folder of the first one.
    pub name: String,
    /// What it holds, ending in a line break.
    pub text: String,
}

impl Language {
    /// What the language asks of the names of a description.
    pub(crate) fn naming(self) -> &'static Naming {
        match self {
            Language::Rust => &rust::NAMING,
            Language::C => &c::NAMING,
        }
    }

    /// What the files are called that a mechanism becomes, the first one `stem` and what the language appends.
    pub fn file_names(self, stem: &str) -> Vec<String> {
        match self {
            Language::Rust => vec![format!("{stem}.rs")],
            Language::C => vec![
                format!("{stem}.c"),
                format!("{stem}.h"),
                "linkwright.c".to_string(),
                "linkwright.h".to_string(),
            ],
        }
    }

    /// The files of the motions of one mechanism, under the names that [`Language::file_names`] says.
    /// `math` is the path of a module with elementary functions, where the language has modules.
    pub(crate) fn files(
        self,
        motions: &[Solved],
        stem: &str,
        scalar: Scalar,
        math: Option<&str>,
    ) -> Vec<OutputFile> {
        let texts = match self {
            Language::Rust => vec![rust::file(motions, scalar, math)],
            Language::C => c::texts(motions, stem, scalar),
        };
        let names = self.file_names(stem).into_iter();
        let files = names.zip(texts);
        files
            .map(|(name, text)| OutputFile { name, text })
            .collect()
    }
}
