//! *Messages of a client → answers.* The documents that are open, and the order of things: changes are taken in at once, what was
//! asked is answered in its order, and of a document that is being typed only the newest text is checked.

use std::collections::{BTreeMap, VecDeque};
use std::io;
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use linkwright_codegen::diagnostic::internal::caught;
use lsp_server::{ErrorCode, Message, Notification, Request, RequestId, Response};
use lsp_types as lsp;
use serde::de::DeserializeOwned;
use serde_json::Value;

use super::checker::{Checker, Found};
use super::diagnostics::{Shown, diagnostics};
use super::document::Document;
use super::requests::{self, Refusal};
use super::text::Encoding;
use super::{capabilities, transport};

/// So long the findings of the text alone wait for those of its equations: both are shown together where these come soon.
const TOGETHER: Duration = Duration::from_millis(100);

/// What happens to a session.
pub enum Event {
    /// The client says something.
    Message(Message),
    /// The client says something that is no message.
    Unreadable(String),
    /// The client has ended its output.
    Gone,
    /// Something was found out about a document.
    Found(Found),
}

/// Where a session stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// Nothing has been agreed on.
    Fresh,
    /// Documents are served.
    Open,
    /// The client will end the session.
    ShutDown,
}

struct Session {
    state: State,
    documents: BTreeMap<String, Document>,
    encoding: Encoding,
    shown: Shown,
    checker: Checker,
    /// Every text that a document has had has another number.
    texts: u64,
    /// Findings that wait for more, and until when.
    waiting: BTreeMap<String, (Instant, Found)>,
}

/// Serves a client on stdin and stdout until it goes; whether it took its leave.
///
/// # Errors
/// Those of stdout.
pub fn serve() -> io::Result<bool> {
    let (sender, events) = channel();
    transport::listen(sender.clone());
    let mut session = Session {
        state: State::Fresh,
        documents: BTreeMap::new(),
        encoding: Encoding::default(),
        shown: Shown::default(),
        checker: Checker::start(sender),
        texts: 0,
        waiting: BTreeMap::new(),
    };
    session.run(&events)
}

/// Result of taking something in. An error of the server itself is shown to the client, and the session goes on.
fn survived(work: impl FnOnce() -> io::Result<()>) -> io::Result<()> {
    caught(work).unwrap_or_else(|error| {
        let params = lsp::ShowMessageParams {
            typ: lsp::MessageType::ERROR,
            message: error.to_string(),
        };
        let shown = Notification::new("window/showMessage".to_string(), params);
        transport::send(&shown.into())
    })
}

impl Session {
    fn run(&mut self, events: &Receiver<Event>) -> io::Result<bool> {
        let mut queue = VecDeque::new();
        loop {
            if queue.is_empty() {
                queue.extend(self.next(events)?);
            }
            queue.extend(events.try_iter());
            let cancelled: Vec<RequestId> = queue.iter().filter_map(cancelled).collect();
            let Some(event) = queue.pop_front() else {
                continue;
            };
            match event {
                Event::Gone => return Ok(false),
                Event::Unreadable(reason) => transport::refuse(&reason)?,
                Event::Found(found) => survived(|| self.take(found))?,
                Event::Message(Message::Notification(it)) if it.method == "exit" => {
                    return Ok(self.state == State::ShutDown);
                }
                Event::Message(Message::Notification(it)) => survived(|| self.note(it))?,
                Event::Message(Message::Request(it)) if cancelled.contains(&it.id) => {
                    let code = ErrorCode::RequestCanceled as i32;
                    let answer = Response::new_err(it.id, code, "cancelled".to_string());
                    transport::send(&answer.into())?;
                }
                Event::Message(Message::Request(it)) => {
                    let answer = self.answer(it);
                    transport::send(&answer.into())?;
                }
                // The server asks nothing.
                Event::Message(Message::Response(_)) => {}
            }
        }
    }

    /// The next event; findings that have waited long enough are shown meanwhile.
    fn next(&mut self, events: &Receiver<Event>) -> io::Result<Option<Event>> {
        let Some(until) = self.waiting.values().map(|(until, _)| *until).min() else {
            return Ok(Some(events.recv().unwrap_or(Event::Gone)));
        };
        let pause = until.saturating_duration_since(Instant::now());
        match events.recv_timeout(pause) {
            Ok(event) => Ok(Some(event)),
            Err(RecvTimeoutError::Disconnected) => Ok(Some(Event::Gone)),
            Err(RecvTimeoutError::Timeout) => {
                let now = Instant::now();
                let due = self.waiting.iter().filter(|(_, (until, _))| *until <= now);
                let due: Vec<String> = due.map(|(uri, _)| uri.clone()).collect();
                for uri in due {
                    if let Some((_, found)) = self.waiting.remove(&uri) {
                        self.publish(&found)?;
                    }
                }
                Ok(None)
            }
        }
    }

    fn answer(&mut self, request: Request) -> Response {
        let Request { id, method, params } = request;
        let result = match (self.state, method.as_str()) {
            (State::Fresh, "initialize") => self.initialize(params),
            (State::Fresh, _) => Err(Refusal::new(
                ErrorCode::ServerNotInitialized,
                "the first request is `initialize`",
            )),
            (State::ShutDown, _) | (State::Open, "initialize") => Err(Refusal::new(
                ErrorCode::InvalidRequest,
                "expected no `initialize` after the first one, and no request after `shutdown`",
            )),
            (State::Open, "shutdown") => {
                self.state = State::ShutDown;
                Ok(Value::Null)
            }
            // Whatever is wrong with one answer, the next question is answered.
            (State::Open, _) => caught(|| requests::answer(&method, params, &mut self.documents))
                .unwrap_or_else(|error| {
                    let text = format!("`{method}` failed: {error}");
                    Err(Refusal::new(ErrorCode::InternalError, &text))
                }),
        };
        match result {
            Ok(result) => Response::new_ok(id, result),
            Err(Refusal { code, message }) => Response::new_err(id, code as i32, message),
        }
    }

    fn initialize(&mut self, params: Value) -> Result<Value, Refusal> {
        let params: lsp::InitializeParams = requests::read(params)?;
        let general = params.capabilities.general;
        let offered = general.and_then(|it| it.position_encodings);
        self.encoding = Encoding::agreed(offered.as_deref());
        let documents = params.capabilities.text_document.unwrap_or_default();
        let published = documents.publish_diagnostics.unwrap_or_default();
        self.shown = Shown {
            related_places: published.related_information == Some(true),
            unused: published
                .tag_support
                .is_some_and(|it| it.value_set.contains(&lsp::DiagnosticTag::UNNECESSARY)),
        };
        self.state = State::Open;
        let result = lsp::InitializeResult {
            capabilities: capabilities::of(self.encoding),
            server_info: Some(lsp::ServerInfo {
                name: "linkwright".to_string(),
                version: Some(env!("CARGO_PKG_VERSION").to_string()),
            }),
        };
        requests::written(&result)
    }

    /// Takes in what a client says; what cannot be understood is passed, since nobody waits for an answer.
    fn note(&mut self, notification: Notification) -> io::Result<()> {
        if self.state != State::Open {
            return Ok(());
        }
        let Notification { method, params } = notification;
        match method.as_str() {
            "textDocument/didOpen" => {
                if let Some(lsp::DidOpenTextDocumentParams { text_document }) = given(params) {
                    let document = Document::new(text_document, self.encoding);
                    let name = document.uri.as_str().to_string();
                    self.documents.insert(name.clone(), document);
                    self.check(&name);
                }
            }
            "textDocument/didChange" => {
                let Some(params) = given::<lsp::DidChangeTextDocumentParams>(params) else {
                    return Ok(());
                };
                let name = params.text_document.uri.as_str().to_string();
                if let Some(document) = self.documents.get_mut(&name) {
                    document.change(params.text_document.version, &params.content_changes);
                    self.check(&name);
                }
            }
            // Tables beside the description may be others now.
            "textDocument/didSave" | "workspace/didChangeWatchedFiles" => {
                let names: Vec<String> = self.documents.keys().cloned().collect();
                names.iter().for_each(|name| self.check(name));
            }
            "textDocument/didClose" => {
                if let Some(lsp::DidCloseTextDocumentParams { text_document }) = given(params) {
                    let name = text_document.uri.as_str().to_string();
                    self.checker.forget(&name);
                    self.waiting.remove(&name);
                    self.documents.remove(&name);
                    return show(text_document.uri, Vec::new(), None);
                }
            }
            _ => {}
        }
        Ok(())
    }

    /// Has the newest text of a document checked.
    fn check(&mut self, name: &str) {
        if let Some(document) = self.documents.get_mut(name) {
            self.texts += 1;
            document.number = self.texts;
            self.waiting.remove(name);
            self.checker.check(name, self.texts, document.source());
        }
    }

    /// Takes in what was found about a text, if it is still the newest.
    fn take(&mut self, found: Found) -> io::Result<()> {
        let Some(document) = self.documents.get_mut(&found.name) else {
            return Ok(());
        };
        if document.number != found.number {
            return Ok(());
        }
        if found.equations.is_some() {
            document.equations.clone_from(&found.equations);
        }
        if found.is_final {
            self.waiting.remove(&found.name);
            return self.publish(&found);
        }
        let until = Instant::now() + TOGETHER;
        self.waiting.insert(found.name.clone(), (until, found));
        Ok(())
    }

    fn publish(&self, found: &Found) -> io::Result<()> {
        let Some(document) = self.documents.get(&found.name) else {
            return Ok(());
        };
        let found = diagnostics(&found.findings, &document.uri, &document.text, self.shown);
        show(document.uri.clone(), found, document.version)
    }
}

fn show(uri: lsp::Uri, found: Vec<lsp::Diagnostic>, version: Option<i32>) -> io::Result<()> {
    let params = lsp::PublishDiagnosticsParams::new(uri, found, version);
    let method = "textDocument/publishDiagnostics".to_string();
    transport::send(&Notification::new(method, params).into())
}

/// What a notification gives, where it can be understood.
fn given<T: DeserializeOwned>(params: Value) -> Option<T> {
    serde_json::from_value(params).ok()
}

/// The request that is taken back.
fn cancelled(event: &Event) -> Option<RequestId> {
    let Event::Message(Message::Notification(it)) = event else {
        return None;
    };
    let is_that = it.method == "$/cancelRequest";
    is_that.then(|| given(it.params.get("id")?.clone()))?
}
