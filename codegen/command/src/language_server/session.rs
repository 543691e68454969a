//! Holds the open documents of a session and orders its work.
//!
//! Changes are applied at once, requests are answered in their order, and only the newest text of a document is checked.

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

/// Time for which findings about the text wait for those about equations, so that both are shown together.
const TOGETHER: Duration = Duration::from_millis(100);

/// Event of a session.
pub enum Event {
    /// A message of the client.
    Message(Message),
    /// Input of the client that is not a message.
    Unreadable(String),
    /// The end of the client's output.
    Gone,
    /// Findings about a document.
    Found(Found),
}

/// State of a session.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// Not initialized.
    Fresh,
    /// Serving documents.
    Open,
    /// Shutting down.
    ShutDown,
}

struct Session {
    state: State,
    documents: BTreeMap<String, Document>,
    encoding: Encoding,
    shown: Shown,
    checker: Checker,
    /// Number of texts so far, which numbers the next text of any document.
    texts: u64,
    /// Findings that wait for more, and the ends of their waiting times.
    waiting: BTreeMap<String, (Instant, Found)>,
}

/// Serves a client on stdin and stdout until its output ends; returns true if the client has shut the session down.
///
/// # Errors
/// Errors of stdout.
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

/// Handles an event. An internal error is shown to the client, and the session continues.
fn survived(work: impl FnOnce() -> io::Result<()>) -> io::Result<()> {
    caught(work).unwrap_or_else(|error| {
        let params = lsp::ShowMessageParams {
            typ: lsp::MessageType::ERROR,
            message: error.to_string(),
        };
        let notification = Notification::new("window/showMessage".to_string(), params);
        transport::send(&notification.into())
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
                // The server sends no requests.
                Event::Message(Message::Response(_)) => {}
            }
        }
    }

    /// Returns the next event; shows findings whose waiting time ends meanwhile.
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
            // An error in one answer does not affect the next request.
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

    /// Handles a notification. An unknown one is ignored, since notifications have no answer.
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
            // Tables beside the description may have changed.
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

    /// Queues the newest text of a document for the checker.
    fn check(&mut self, name: &str) {
        if let Some(document) = self.documents.get_mut(name) {
            self.texts += 1;
            document.number = self.texts;
            self.waiting.remove(name);
            self.checker.check(name, self.texts, document.source());
        }
    }

    /// Handles the findings about a text if it is still the newest.
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
        let to_show = diagnostics(&found.findings, &document.uri, &document.text, self.shown);
        show(document.uri.clone(), to_show, document.version)
    }
}

fn show(uri: lsp::Uri, found: Vec<lsp::Diagnostic>, version: Option<i32>) -> io::Result<()> {
    let params = lsp::PublishDiagnosticsParams::new(uri, found, version);
    let method = "textDocument/publishDiagnostics".to_string();
    transport::send(&Notification::new(method, params).into())
}

/// Reads the parameters of a notification; `None` if they do not follow the protocol.
fn given<T: DeserializeOwned>(params: Value) -> Option<T> {
    serde_json::from_value(params).ok()
}

/// Returns the request that the client cancels; `None` for other events.
fn cancelled(event: &Event) -> Option<RequestId> {
    let Event::Message(Message::Notification(it)) = event else {
        return None;
    };
    let is_that = it.method == "$/cancelRequest";
    is_that.then(|| given(it.params.get("id")?.clone()))?
}
