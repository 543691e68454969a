//! Serves the page that is kept in [`Shared`] to the browsers of this machine, each on its own thread.
//!
//! No browser can stop the server: a connection without an available thread is refused, and one that is too slow ends.

use std::io::{self, BufRead, BufReader, Read as _, Write as _};
use std::net::{TcpListener, TcpStream};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use linkwright_codegen::diagnostic::Source;
use linkwright_codegen::diagnostic::internal::caught;
use linkwright_page::{Question, Session};

use super::timed::Timed;

/// Time limit for the arrival of a request, and for the departure of an answer.
const PATIENCE: Duration = Duration::from_secs(5);

/// Time for which a connection is read that cannot be answered.
const IMPATIENCE: Duration = Duration::from_millis(100);

/// Interval between signs of life to a browser that waits.
const HEARTBEAT: Duration = Duration::from_secs(2);

/// Largest number of bytes of a request.
const MAX_REQUEST_BYTES: u64 = 16 << 10;

/// Largest number of open connections.
const CONNECTIONS: usize = 64;

/// Page of the current version, and its description, about which the page asks.
#[derive(Clone, Default)]
pub(super) struct Current {
    pub version: u64,
    pub html: String,
    /// `None` if the description cannot be read.
    pub source: Option<Source>,
}

/// Current page, and the signal of the next one.
#[derive(Default)]
pub(super) struct Shared {
    current: Mutex<Current>,
    changed: Condvar,
    session: Mutex<Session>,
    /// Motion of the page; `None` for the only one.
    motion: Option<String>,
}

impl Shared {
    /// Creates a server whose answers are about this motion, and begin with these values of parameters and inputs.
    pub fn new(motion: Option<String>, assignments: Vec<String>) -> Shared {
        Shared {
            session: Mutex::new(Session::new(assignments)),
            motion,
            ..Shared::default()
        }
    }

    /// Answers a question about the current description, in JSON.
    ///
    /// # Errors
    /// A sentence: the text is not a question, or the description cannot be read.
    fn answer(&self, question: &[u8]) -> Result<String, String> {
        let mut question: Question =
            serde_json::from_slice(question).map_err(|error| error.to_string())?;
        question.motion = self.motion.clone();
        let source = self.current().source.clone();
        let source = source.ok_or("the description cannot be read")?;
        // What a session keeps is replaced as a whole.
        let mut session = self.session.lock().unwrap_or_else(PoisonError::into_inner);
        let answer = caught(|| session.answer_about(source, &question));
        let answer = answer.map_err(|error| error.to_string())?;
        serde_json::to_string(&answer).map_err(|error| error.to_string())
    }

    pub fn current(&self) -> MutexGuard<'_, Current> {
        // A page is replaced as a whole: the state of a thread that panicked is complete.
        self.current.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Replaces the page.
    pub fn set(&self, current: Current) {
        *self.current() = current;
        self.changed.notify_all();
    }
}

/// Work of a thread.
pub(super) type Task = Box<dyn FnOnce() + Send>;

/// Runs a task on a new thread.
///
/// # Errors
/// The system cannot start a thread.
pub(super) fn on_thread(task: Task) -> io::Result<()> {
    thread::Builder::new().spawn(task).map(drop)
}

/// Answers all connections; `start` runs a task on a thread. `patience` limits the time of a request, and of an answer.
fn serve_with(
    listener: &TcpListener,
    port: u16,
    shared: &Arc<Shared>,
    patience: Duration,
    start: impl Fn(Task) -> io::Result<()>,
) {
    let open = Arc::new(());
    for stream in listener.incoming() {
        let Ok(stream) = stream.map(Arc::new) else {
            // The limit of open files may be reached; another connection closes in time.
            thread::sleep(IMPATIENCE);
            continue;
        };
        let task = {
            let (stream, shared, open) = (stream.clone(), shared.clone(), open.clone());
            Box::new(move || {
                // A browser that closes the connection does not cause an error.
                let _ = answer(&stream, port, &shared, patience);
                drop(open);
            })
        };
        let is_full = Arc::strong_count(&open) > CONNECTIONS + 1;
        if is_full || start(task).is_err() {
            let _ = refuse(&stream);
        }
    }
}

/// Answers all connections, each on its own thread.
pub(super) fn serve(listener: &TcpListener, port: u16, shared: &Arc<Shared>) {
    serve_with(listener, port, shared, PATIENCE, on_thread);
}

/// Asks a browser to retry. The request is read first, because unread bytes would end the connection before the answer arrives.
fn refuse(stream: &TcpStream) -> io::Result<()> {
    let mut request = [0; 4096];
    let _ = Timed::new(stream, IMPATIENCE).read(&mut request)?;
    let status = "503 Service Unavailable";
    plain(Timed::new(stream, IMPATIENCE), status, "try again")
}

/// Answers one request.
fn answer(stream: &TcpStream, port: u16, shared: &Shared, patience: Duration) -> io::Result<()> {
    let request = Timed::new(stream, patience).take(MAX_REQUEST_BYTES);
    let mut request = BufReader::new(request);
    let head = Head::read(&mut request)?;
    let reply_to = Timed::new(stream, patience);
    let path = match head.first.split(' ').collect::<Vec<_>>()[..] {
        ["GET", path, _] => path,
        ["POST", "/ask", _] if head.is_ours(port) => {
            let mut question = vec![0; head.length.min(MAX_REQUEST_BYTES as usize)];
            request.read_exact(&mut question)?;
            return match shared.answer(&question) {
                Ok(answer) => reply(reply_to, "200 OK", "application/json", &answer),
                Err(reason) => plain(reply_to, "400 Bad Request", &reason),
            };
        }
        ["POST", "/ask", _] => "",
        _ => {
            let text = "only GET is answered, and POST at /ask";
            return plain(reply_to, "405 Method Not Allowed", text);
        }
    };
    if !head.is_ours(port) {
        let text = "this page is for its own machine";
        return plain(reply_to, "403 Forbidden", text);
    }
    if let Some(after) = path.strip_prefix("/changes?after=") {
        return match after.parse() {
            Ok(after) => wait(stream, shared, after, patience),
            Err(_) => plain(reply_to, "400 Bad Request", "which version?"),
        };
    }
    if path != "/" {
        return plain(reply_to, "404 Not Found", "there is one page, at /");
    }
    let html = shared.current().html.clone();
    reply(reply_to, "200 OK", "text/html; charset=utf-8", &html)
}

/// First line of a request, and headers.
#[derive(Default)]
struct Head {
    first: String,
    host: String,
    /// Origin of the page that asks; empty if the browser does not say it.
    origin: String,
    /// Number of bytes behind the head.
    length: usize,
}

impl Head {
    fn read(request: &mut impl BufRead) -> io::Result<Head> {
        let mut lines = request.lines();
        let mut head = Head {
            first: lines.next().transpose()?.unwrap_or_default(),
            ..Head::default()
        };
        for line in lines {
            let line = line?;
            match line.split_once(':') {
                Some((name, value)) => match name.to_ascii_lowercase().as_str() {
                    "host" => head.host = value.trim().to_string(),
                    "origin" => head.origin = value.trim().to_string(),
                    "content-length" => head.length = value.trim().parse().unwrap_or_default(),
                    _ => {}
                },
                None if line.is_empty() => break,
                None => {}
            }
        }
        Ok(head)
    }

    /// True for a request of this server's page, under a name of the loopback address.
    fn is_ours(&self, port: u16) -> bool {
        let names = ["127.0.0.1", "localhost"];
        let is_host = |host: &str| {
            let mut names = names.iter();
            names.any(|name| host == format!("{name}:{port}") || (port == 80 && host == *name))
        };
        let origin = self.origin.strip_prefix("http://");
        is_host(&self.host) && (self.origin.is_empty() || origin.is_some_and(is_host))
    }
}

fn plain(stream: Timed<'_>, status: &str, text: &str) -> io::Result<()> {
    reply(stream, status, "text/plain; charset=utf-8", text)
}

fn reply(mut stream: Timed<'_>, status: &str, kind: &str, text: &str) -> io::Result<()> {
    let head = format!(
        "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {}\r\nCache-Control: no-store\r\n\
         X-Content-Type-Options: nosniff\r\nConnection: close\r\n\r\n",
        text.len()
    );
    stream.write_all(head.as_bytes())?;
    stream.write_all(text.as_bytes())?;
    stream.flush()
}

/// Reports the next version to a browser as soon as there is one.
fn wait(stream: &TcpStream, shared: &Shared, after: u64, patience: Duration) -> io::Result<()> {
    let say = |text: &str| Timed::new(stream, patience).write_all(text.as_bytes());
    say(
        "HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\nCache-Control: no-store\r\nConnection: close\r\n\r\n",
    )?;
    let mut current = shared.current();
    while current.version == after {
        let (next, waited) = shared
            .changed
            .wait_timeout(current, HEARTBEAT)
            .unwrap_or_else(PoisonError::into_inner);
        current = next;
        if waited.timed_out() {
            drop(current);
            // Writing detects a browser that has closed the connection.
            say(": still here\n\n")?;
            current = shared.current();
        }
    }
    let version = current.version;
    drop(current);
    say(&format!("data: {version}\n\n"))
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::time::Instant;

    use super::*;

    /// Starts a server whose threads `start` makes; returns its port.
    fn server(
        patience: Duration,
        start: impl Fn(Task) -> io::Result<()> + Send + 'static,
    ) -> (u16, Arc<Shared>) {
        let listener = TcpListener::bind("127.0.0.1:0").expect("a free port");
        let port = listener.local_addr().expect("it is bound").port();
        let shared = Arc::new(Shared::default());
        shared.set(Current {
            version: 1,
            html: "the page".to_string(),
            source: None,
        });
        let served = shared.clone();
        thread::spawn(move || serve_with(&listener, port, &served, patience, start));
        (port, shared)
    }

    fn asked(port: u16, path: &str) -> TcpStream {
        let mut stream = TcpStream::connect(("127.0.0.1", port)).expect("it is served");
        // All requests arrive at once, as from a browser.
        let request = format!("GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\n\r\n");
        stream.write_all(request.as_bytes()).expect("it is sent");
        stream
    }

    fn answered(mut stream: TcpStream) -> String {
        let mut text = String::new();
        stream.read_to_string(&mut text).expect("an answer");
        text
    }

    #[test]
    fn it_lives_on_without_threads() {
        let asked_for = AtomicUsize::new(0);
        let (port, _) = server(PATIENCE, move |task| {
            match asked_for.fetch_add(1, Ordering::Relaxed) {
                0..3 => Err(io::ErrorKind::WouldBlock.into()),
                _ => on_thread(task),
            }
        });
        for _ in 0..3 {
            let text = answered(asked(port, "/"));
            assert!(text.starts_with("HTTP/1.1 503 "), "{text}");
        }
        let text = answered(asked(port, "/"));
        assert!(text.starts_with("HTTP/1.1 200 OK\r\n"), "{text}");
        assert!(text.ends_with("\r\n\r\nthe page"), "{text}");
    }

    #[test]
    fn a_client_that_sends_byte_by_byte_is_dropped() {
        let patience = Duration::from_millis(300);
        let (port, _) = server(patience, on_thread);
        let mut slow = TcpStream::connect(("127.0.0.1", port)).expect("it is served");
        let begun = Instant::now();
        // Each byte arrives in time, but the request is never complete.
        while slow.write_all(b"G").is_ok() {
            thread::sleep(patience / 10);
            assert!(begun.elapsed() < patience * 20, "it is still heard");
        }
        assert!(begun.elapsed() >= patience);
    }

    #[test]
    fn more_than_so_many_connections_are_refused_until_one_ends() {
        let (port, shared) = server(PATIENCE, on_thread);
        let waiting: Vec<TcpStream> = (0..CONNECTIONS)
            .map(|_| {
                let mut stream = asked(port, "/changes?after=1");
                let mut first = [0; 15];
                stream.read_exact(&mut first).expect("it waits");
                assert_eq!(&first, b"HTTP/1.1 200 OK");
                stream
            })
            .collect();
        let text = answered(asked(port, "/"));
        assert!(text.starts_with("HTTP/1.1 503 "), "{text}");
        shared.set(Current {
            version: 2,
            html: "the next page".to_string(),
            source: None,
        });
        for stream in waiting {
            let text = answered(stream);
            assert!(text.ends_with("\r\n\r\ndata: 2\n\n"), "{text}");
        }
        let begun = Instant::now();
        while !answered(asked(port, "/")).ends_with("the next page") {
            assert!(begun.elapsed() < PATIENCE, "it is still refused");
        }
    }
}
