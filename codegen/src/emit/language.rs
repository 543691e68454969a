//! Languages of generated modules, and the files of a mechanism in each.

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

/// File to be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OutputFile {
    /// Name, in the folder of the first file.
    pub name: String,
    /// Contents, ending in a line break.
    pub text: String,
}

impl Language {
    /// Rules of the language for names of a description.
    pub(crate) fn naming(self) -> &'static Naming {
        match self {
            Language::Rust => &rust::NAMING,
            Language::C => &c::NAMING,
        }
    }

    /// Names of the files of a mechanism; the first is `stem` and the suffix of the language.
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

    /// Files of the motions of one mechanism, under the names of [`Language::file_names`]. `math` is the path of a
    /// module with elementary functions, if the language has modules.
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
