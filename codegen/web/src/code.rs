//! Generates code for a live page.

use linkwright_codegen::{Language, Options, Source, generate};
use linkwright_page::{Message, messages};
use serde::Serialize;

/// Files of generated code, the mechanism's own first, each with its name; and findings.
#[derive(Debug, Serialize)]
pub struct Code {
    files: Vec<[String; 2]>,
    messages: Vec<Message>,
}

/// Returns the code of a description in a language, named as an option of the command line.
pub fn code(source: &Source, language: &str) -> Code {
    let mut languages = Language::ALL.into_iter();
    let language = languages.find(|it| it.conventions().option == language);
    let options = Options {
        language: language.unwrap_or_default(),
        ..Options::default()
    };
    match generate(source, &options) {
        Ok(generated) => Code {
            messages: messages(&generated.warnings),
            files: generated
                .files
                .into_iter()
                .map(|file| [file.name, file.text])
                .collect(),
        },
        Err(findings) => Code {
            files: Vec::new(),
            messages: messages(&findings),
        },
    }
}
