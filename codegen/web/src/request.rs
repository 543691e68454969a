//! Defines the requests of a live page, and finds their replies.

use linkwright_codegen::{Read, Source};
use linkwright_editing::{
    Description, Edit, Handle, completions, handles, hover, moved, step, tokens,
};
use linkwright_page::{Message, Question, Session, skeleton};
use serde::Deserialize;
use serde_json::{Value, json};

use crate::code::{code, latex};

/// Request of a page.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
pub enum Request {
    /// Elements of a page without a mechanism.
    Skeleton,
    /// Motion, drawing and sections: the reply is an answer of `linkwright-page`.
    Ask(Question),
    /// Generated code: `rust` or `c`, as an option of the command line.
    Code {
        /// Description.
        question: Question,
        /// Language.
        language: String,
    },
    /// Solution in LaTeX, and findings.
    Latex(Question),
    /// Table of assemblies and singular poses, as the command `check` prints it.
    Check(Question),
    /// Motion as CSV.
    Csv(Question),
    /// Tokens of a text, for colors.
    Tokens(String),
    /// Proposed words at an offset.
    Complete {
        /// Text of the description.
        text: String,
        /// Offset in bytes.
        offset: usize,
    },
    /// Text beside the pointer.
    Hover {
        /// Description, with its tables.
        question: Question,
        /// Offset in bytes.
        offset: usize,
    },
    /// Points that can be dragged.
    Handles(Question),
    /// Changes of the text that move a point.
    Move {
        /// Description.
        question: Question,
        /// Index of its handle.
        handle: usize,
        /// New coordinates (m), in the frame of the handle.
        position: [f64; 2],
    },
}

/// Replies to requests, one after another.
#[derive(Default)]
pub struct Desk {
    session: Session,
    text: Option<ReadText>,
}

/// Text that was read last, for hover texts and handles.
struct ReadText {
    description: Description,
    /// Equations; `None` if the text has errors.
    read: Option<Read>,
    /// Points that can be dragged; none if the text has errors.
    handles: Vec<Handle>,
}

impl ReadText {
    fn of(source: Source) -> ReadText {
        let read = linkwright_codegen::read(&source).ok();
        let description = Description::of(source);
        let first = read.as_ref().and_then(|it| it.motions.first());
        let handles = first.map(|it| handles(&description, &it.system.mechanism));
        ReadText {
            handles: handles.unwrap_or_default(),
            read,
            description,
        }
    }
}

impl Desk {
    /// Returns the reply to a request, both as JSON. A text that is not a request has a reply with the key `refused`.
    pub fn reply(&mut self, request: &[u8]) -> Vec<u8> {
        let reply = match serde_json::from_slice(request) {
            Err(error) => Ok(json!({ "refused": error.to_string() })),
            // Numbers of an answer are written once, without a tree of values.
            Ok(Request::Ask(question)) => {
                return serde_json::to_vec(&self.session.answer(&question)).unwrap_or_default();
            }
            Ok(Request::Skeleton) => Ok(Value::from(skeleton())),
            Ok(Request::Code { question, language }) => {
                serde_json::to_value(code(&question.source(), &language))
            }
            Ok(Request::Latex(question)) => Ok(text_or(latex(&question))),
            Ok(Request::Check(question)) => Ok(text_or(self.session.check(&question))),
            Ok(Request::Csv(question)) => Ok(text_or(self.session.table(&question))),
            Ok(Request::Tokens(text)) => Ok(tokens(&text)
                .iter()
                .map(|it| json!([it.span.start, it.span.end, it.kind.name()]))
                .collect()),
            Ok(Request::Complete { text, offset }) => Ok(proposals(text, offset)),
            Ok(Request::Hover { question, offset }) => Ok(beside(self.read(&question), offset)),
            Ok(Request::Handles(question)) => Ok(all_handles(self.read(&question))),
            Ok(Request::Move {
                question,
                handle,
                position,
            }) => Ok(changes(self.read(&question), handle, position)),
        };
        serde_json::to_vec(&reply.unwrap_or_default()).unwrap_or_default()
    }
}

impl Desk {
    /// Returns the description of a question, read anew if it has changed.
    fn read(&mut self, question: &Question) -> &ReadText {
        let source = question.source();
        let last = self.text.take();
        let last = last.filter(|it| it.description.source == source);
        self.text
            .insert(last.unwrap_or_else(|| ReadText::of(source)))
    }
}

/// Returns a text, or the messages that take its place.
fn text_or(result: Result<String, Vec<Message>>) -> Value {
    match result {
        Ok(text) => json!({ "text": text, "messages": [] }),
        Err(messages) => json!({ "text": "", "messages": messages }),
    }
}

fn proposals(text: String, offset: usize) -> Value {
    let description = Description::of(Source::new("", text));
    let proposals = completions(&description, offset);
    let proposals = proposals.into_iter().map(|it| {
        json!({
            "label": it.label,
            "kind": it.kind.name(),
            "detail": it.detail,
            "documentation": it.documentation,
            "start": it.replaced.start,
            "end": it.replaced.end,
            "text": it.text,
        })
    });
    proposals.collect()
}

fn beside(text: &ReadText, offset: usize) -> Value {
    match hover(&text.description, text.read.as_ref(), offset) {
        Some(it) => json!({ "start": it.span.start, "end": it.span.end, "text": it.text }),
        None => Value::Null,
    }
}

fn all_handles(text: &ReadText) -> Value {
    let handles = text.handles.iter().map(|it| {
        let place = it.coordinates.as_ref().ok();
        json!({
            "point": it.point,
            "body": it.body,
            "start": it.declared.start,
            "end": it.declared.end,
            "position": place.map(|both| both.each_ref().map(|it| it.value)),
            "step": place.map(|both| both.each_ref().map(step)),
            "reason": it.coordinates.as_ref().err(),
        })
    });
    handles.collect()
}

fn changes(text: &ReadText, handle: usize, position: [f64; 2]) -> Value {
    let handle = text.handles.get(handle);
    let edits = handle.and_then(|it| moved(&text.description.source.text, it, position));
    let edits = edits
        .into_iter()
        .flatten()
        .map(|Edit { span, text }| json!({ "start": span.start, "end": span.end, "text": text }));
    edits.collect()
}
