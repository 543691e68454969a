//! Defines the requests of a live page, and finds their replies.

use linkwright_codegen::{Language, Options, Source, generate};
use linkwright_page::{Message, Question, Session, messages};
use serde::{Deserialize, Serialize};

/// Request of a page.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
pub enum Request {
    /// Motion, drawing and sections.
    Ask(Question),
    /// Generated code.
    Code {
        /// Description.
        question: Question,
        /// `rust` or `c`, as an option of the command line.
        language: String,
    },
}

/// Files of generated code.
#[derive(Debug, Serialize)]
struct Code {
    files: Vec<[String; 2]>,
    messages: Vec<Message>,
}

/// Replies to requests, one after another.
#[derive(Debug, Default)]
pub struct Desk {
    session: Session,
}

impl Desk {
    /// Returns the reply to a request, both as JSON. A text that is not a request has a reply with the key `refused`.
    pub fn reply(&mut self, request: &[u8]) -> Vec<u8> {
        let reply = match serde_json::from_slice(request) {
            Err(error) => serde_json::to_vec(&serde_json::json!({ "refused": error.to_string() })),
            Ok(Request::Ask(question)) => serde_json::to_vec(&self.session.answer(&question)),
            Ok(Request::Code { question, language }) => {
                serde_json::to_vec(&code(&question.source(), &language))
            }
        };
        reply.unwrap_or_default()
    }
}

/// Returns the code of a description.
fn code(source: &Source, language: &str) -> Code {
    let language = Language::ALL
        .into_iter()
        .find(|it| it.conventions().option == language);
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
