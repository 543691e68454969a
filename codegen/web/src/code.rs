//! Generates code for a live page.

use linkwright_codegen::stages::emit::derivation::Derivation;
use linkwright_codegen::stages::finiteness::of_unplanned;
use linkwright_codegen::stages::structure::Shift;
use linkwright_codegen::{Diagnostics, Language, Options, Source, generate};
use linkwright_page::{Message, Question, messages, refused};
use linkwright_solver::Unopened;
use linkwright_solver::opened::determined;
use serde::Serialize;

/// Files of generated code, the mechanism's own first, each with its name; and findings.
#[derive(Debug, Serialize)]
pub struct Code {
    files: Vec<[String; 2]>,
    messages: Vec<Message>,
}

/// Returns the solution of a description as a document of LaTeX.
///
/// # Errors
/// The messages of a description that cannot be solved.
pub fn latex(question: &Question) -> Result<String, Vec<Message>> {
    let source = question.source();
    let motion = question.motion.as_deref();
    let read = |motion: Option<&str>| determined(&source, motion, &mut Diagnostics::new());
    let derived = read(motion).or_else(|reason| match &reason {
        Unopened::Several(names) => read(names.first().map(String::as_str)),
        _ => Err(reason),
    });
    let derived = derived.map_err(|reason| refused(&reason, &source.name))?;
    let derivation = Derivation::of(derived, Shift::Efforts);
    derivation
        .map(|it| it.latex())
        .map_err(|unplanned| messages(&of_unplanned(unplanned)))
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
