//! Editor for tests: the client end of the protocol, with the real command as the server.

use std::collections::VecDeque;
use std::io::{BufRead, BufReader, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread;
use std::time::{Duration, Instant};

use lsp_server::{Message, Notification, Request, Response};
use serde_json::{Value, json};

/// Longest time for an answer.
const PATIENCE: Duration = Duration::from_secs(120);

/// Number of answers to unreadable messages.
pub const UNREADABLE: i32 = -1;

/// Address of documents that are not files.
pub const UNSAVED: &str = "untitled:arm";

/// Editor and its server.
pub struct Client {
    child: Child,
    input: Option<ChildStdin>,
    messages: Receiver<Message>,
    /// Notifications of the server.
    notes: VecDeque<Notification>,
    requests: i32,
    version: i32,
    /// Capabilities of the server.
    pub offered: Value,
}

impl Client {
    /// Starts a server without a message.
    pub fn silent() -> Client {
        Client::started_with(&["lsp"])
    }

    /// Starts a server with these arguments.
    pub fn started_with(arguments: &[&str]) -> Client {
        let mut child = Command::new(env!("CARGO_BIN_EXE_linkwright"))
            .args(arguments)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("the command starts");
        let output = child.stdout.take().expect("a pipe");
        let (sender, messages) = channel();
        thread::spawn(move || {
            let mut output = BufReader::new(output);
            while let Some(message) = read(&mut output) {
                if sender.send(message).is_err() {
                    break;
                }
            }
        });
        Client {
            input: child.stdin.take(),
            child,
            messages,
            notes: VecDeque::new(),
            requests: 0,
            version: 0,
            offered: Value::Null,
        }
    }

    /// Starts a server that counts columns in UTF-16.
    pub fn start() -> Client {
        Client::with(json!({
            "textDocument": { "publishDiagnostics": {
                "relatedInformation": true,
                "tagSupport": { "valueSet": [1] },
            } },
        }))
    }

    /// Starts a server for a client with these capabilities.
    pub fn with(capabilities: Value) -> Client {
        let mut client = Client::silent();
        let params = json!({ "processId": null, "rootUri": null, "capabilities": capabilities });
        let answer = client.ask("initialize", params).expect("it begins");
        client.offered = answer["capabilities"].clone();
        client.note("initialized", json!({}));
        client
    }

    /// Sends bytes unchanged.
    pub fn send(&mut self, bytes: &[u8]) {
        let input = self.input.as_mut().expect("the session is open");
        input.write_all(bytes).expect("the server reads");
        input.flush().expect("the server reads");
    }

    fn say(&mut self, message: Message) {
        let mut bytes = Vec::new();
        message.write(&mut bytes).expect("it can be written");
        self.send(&bytes);
    }

    pub fn note(&mut self, method: &str, params: Value) {
        self.say(Notification::new(method.to_string(), params).into());
    }

    /// Next message that is not a notification.
    pub fn next_answer(&mut self) -> Response {
        loop {
            match self.messages.recv_timeout(PATIENCE) {
                Ok(Message::Response(response)) => return response,
                Ok(Message::Notification(note)) => self.notes.push_back(note),
                Ok(Message::Request(request)) => panic!("the server asks: {request:?}"),
                Err(error) => panic!("no answer: {error}"),
            }
        }
    }

    /// Answer to a request, or its error.
    pub fn ask(&mut self, method: &str, params: Value) -> Result<Value, String> {
        self.requests += 1;
        let id = self.requests;
        self.say(Request::new(id.into(), method.to_string(), params).into());
        let response = self.next_answer();
        assert_eq!(response.id, id.into(), "{method}");
        response.response_result.map_err(|error| error.message)
    }

    /// Answer to a request about a position in a document.
    pub fn ask_at(&mut self, method: &str, uri: &str, at: (usize, usize)) -> Result<Value, String> {
        self.ask(
            &format!("textDocument/{method}"),
            json!({
                "textDocument": { "uri": uri },
                "position": { "line": at.0, "character": at.1 },
                "context": { "includeDeclaration": true, "triggerKind": 1 },
            }),
        )
    }

    /// Opens a document.
    pub fn open(&mut self, uri: &str, text: &str) {
        self.version += 1;
        let document = json!({
            "uri": uri,
            "languageId": "mech",
            "version": self.version,
            "text": text,
        });
        self.note("textDocument/didOpen", json!({ "textDocument": document }));
    }

    /// Replaces a document's text, or a part of it.
    pub fn change(&mut self, uri: &str, change: Value) {
        self.version += 1;
        self.note(
            "textDocument/didChange",
            json!({
                "textDocument": { "uri": uri, "version": self.version },
                "contentChanges": [change],
            }),
        );
    }

    /// Diagnostics of the newest text.
    pub fn findings(&mut self) -> Vec<Value> {
        let until = Instant::now() + PATIENCE;
        loop {
            let note = match self.notes.pop_front() {
                Some(note) => note,
                None => match self.messages.recv_timeout(until - Instant::now()) {
                    Ok(Message::Notification(note)) => note,
                    other => panic!("no findings: {other:?}"),
                },
            };
            if note.params["version"] == self.version {
                let diagnostics = note.params["diagnostics"].as_array();
                return diagnostics.expect("a list").clone();
            }
        }
    }

    /// Diagnostics of the newest text once they satisfy a condition: those of its equations may follow those of the
    /// text alone.
    pub fn findings_when(&mut self, is_so: impl Fn(&[Value]) -> bool) -> Vec<Value> {
        loop {
            let findings = self.findings();
            if is_so(&findings) {
                return findings;
            }
        }
    }

    /// Diagnostics of the newest text, of which the first has this code.
    pub fn findings_with(&mut self, code: &str) -> Vec<Value> {
        self.findings_when(|found| found.first().is_some_and(|it| it["code"] == code))
    }

    /// Closes the server's input.
    pub fn hang_up(&mut self) {
        self.input = None;
    }

    /// Shuts the server down; returns its exit.
    pub fn finish(mut self) -> ExitStatus {
        self.ask("shutdown", Value::Null).expect("it ends");
        self.note("exit", Value::Null);
        self.ended()
    }

    /// Exit of the server.
    pub fn ended(mut self) -> ExitStatus {
        let until = Instant::now() + PATIENCE;
        loop {
            match self.child.try_wait().expect("the server can be waited for") {
                Some(status) => return status,
                None if Instant::now() > until => panic!("the server does not end"),
                None => thread::sleep(Duration::from_millis(5)),
            }
        }
    }
}

impl Drop for Client {
    fn drop(&mut self) {
        // A failed test leaves no server behind.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Next message. The answer to an unreadable message has no number: it gets one.
fn read(output: &mut impl BufRead) -> Option<Message> {
    let mut length = None;
    loop {
        let mut line = String::new();
        if output.read_line(&mut line).ok()? == 0 {
            return None;
        }
        if let Some(value) = line.strip_prefix("Content-Length: ") {
            length = value.trim().parse().ok();
        } else if line == "\r\n" {
            break;
        }
    }
    let mut bytes = vec![0; length?];
    output.read_exact(&mut bytes).ok()?;
    let mut message: Value = serde_json::from_slice(&bytes).expect("the server writes JSON");
    if message.get("id") == Some(&Value::Null) {
        message["id"] = UNREADABLE.into();
    }
    Some(serde_json::from_value(message).expect("the server writes messages"))
}

/// Folder of the repository.
pub fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Descriptions in a folder of the repository, by name.
pub fn descriptions(folder: &str) -> Vec<(PathBuf, String)> {
    let entries = std::fs::read_dir(repository().join(folder)).expect("a folder");
    let mut paths: Vec<PathBuf> = entries
        .map(|it| it.expect("it can be read").path())
        .collect();
    paths.retain(|path| path.extension().is_some_and(|it| it == "mech"));
    paths.sort();
    assert!(!paths.is_empty(), "{folder}");
    let read = |path: PathBuf| {
        let text = std::fs::read(&path).expect("a file");
        let text = String::from_utf8(text).ok()?;
        Some((path, text))
    };
    paths.into_iter().filter_map(read).collect()
}

/// Address of a file.
pub fn address(path: &Path) -> String {
    let path = path.canonicalize().expect("the file exists");
    format!("file://{}", path.display())
}

/// Line and column of a mark `|` in a text, and the text without it.
pub fn marked(text: &str) -> (String, (usize, usize)) {
    let (before, after) = text.split_once('|').expect("a mark");
    let line = before.matches('\n').count();
    let column = before.rsplit('\n').next().unwrap_or(before);
    (
        format!("{before}{after}"),
        (line, column.encode_utf16().count()),
    )
}
