//! *A description that is being edited* → *its page, served on the loopback address, always as the file is now*.
//!
//! The file and the tables it names are read again several times a second; a browser that shows the page holds a connection on which
//! it hears that there is a newer version. What is wrong with the description stands in the page as it stands in the terminal.
//! Nobody but this machine is answered, and nothing but the page is served: a request under another name than the loopback address
//! comes from a page of somebody else, and is refused.

use std::io::{self, BufRead as _, BufReader, Read as _, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, SystemTime};

use linkwright_codegen::diagnostic::internal::caught;
use linkwright_codegen::stages::files;

use super::description::{is_stdin, source};
use super::view::made;
use super::{Outcome, Problem, print, say};
use crate::arguments::View;
use crate::page::{Live, problem};

/// How often files are looked at.
const PAUSE: Duration = Duration::from_millis(100);

/// How long a request may take to arrive.
const PATIENCE: Duration = Duration::from_secs(5);

/// How often a browser that waits hears that the server is still there.
const HEARTBEAT: Duration = Duration::from_secs(2);

/// How much of a request is read.
const LONGEST: u64 = 16 << 10;

/// The page as it is now.
#[derive(Default)]
struct Current {
    version: u64,
    html: String,
}

/// The page and whoever waits for the next one.
#[derive(Default)]
struct Shared {
    current: Mutex<Current>,
    changed: Condvar,
}

impl Shared {
    fn current(&self) -> MutexGuard<'_, Current> {
        // A page is replaced as a whole: what another thread left is complete.
        self.current.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Serves the page until it is interrupted.
///
/// # Errors
/// The address cannot be used, or there is no file to follow.
pub fn run(arguments: &View) -> Result<Outcome, Problem> {
    if is_stdin(&arguments.described.file) {
        return Err(Problem(
            "error: `--watch` follows a file, and `-` is stdin".to_string(),
        ));
    }
    let refused = |error: io::Error| {
        let port = arguments.port;
        let text = format!("error: cannot serve at port {port}: {error}");
        match port {
            0 => Problem(text),
            _ => Problem(format!("{text}\n  = help: `--port 0` takes a free one")),
        }
    };
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, arguments.port)).map_err(refused)?;
    let address = listener.local_addr().map_err(refused)?;
    let shared = Arc::new(Shared::default());
    let mut seen = renew(arguments, &shared);
    print(|output| {
        let name = arguments.described.file.display();
        writeln!(
            output,
            "{name} is at http://{address}/ until this is interrupted"
        )
    })?;
    let served = Arc::clone(&shared);
    let port = address.port();
    thread::spawn(move || {
        for stream in listener.incoming().flatten() {
            let shared = Arc::clone(&served);
            // A browser that goes away while it is answered is no error.
            thread::spawn(move || answer(stream, port, &shared).ok());
        }
    });
    loop {
        thread::sleep(PAUSE);
        if seen.iter().any(|(path, stamp)| stamp_of(path) != *stamp) {
            seen = renew(arguments, &shared);
        }
    }
}

/// What tells whether a file has changed.
type Stamp = Option<(SystemTime, u64)>;

fn stamp_of(path: &Path) -> Stamp {
    let found = std::fs::metadata(path).ok()?;
    Some((found.modified().ok()?, found.len()))
}

/// Result of some work, of which an error of Linkwright itself is a problem as any other: the server lives on.
fn survived<T>(work: impl FnOnce() -> Result<T, Problem>) -> Result<T, Problem> {
    caught(work).unwrap_or_else(|error| Err(Problem(error.to_string())))
}

/// Makes the page anew; the files that it is made of, as they were before they were read.
fn renew(arguments: &View, shared: &Shared) -> Vec<(PathBuf, Stamp)> {
    let version = shared.current().version + 1;
    let stamped = |path: PathBuf| {
        let stamp = stamp_of(&path);
        (path, stamp)
    };
    let mut seen = vec![stamped(arguments.described.file.clone())];
    let made = survived(|| {
        let source = source(&arguments.described.file)?;
        let folder = files::folder_of(&arguments.described.file);
        let tables = source.attachments.iter().map(|it| folder.join(&it.path));
        seen.extend(tables.map(stamped));
        made(arguments, &source, Live::Version(version))
    });
    let html = match made {
        Ok(made) => {
            if let Some(error) = &made.error {
                say(&format!("error: `{}` {error}", made.name));
            }
            made.html
        }
        Err(Problem(text)) => {
            say(&text);
            problem(
                &arguments.described.file.display().to_string(),
                &text,
                version,
            )
        }
    };
    *shared.current() = Current { version, html };
    shared.changed.notify_all();
    seen
}

/// Answers one request.
fn answer(stream: TcpStream, port: u16, shared: &Shared) -> io::Result<()> {
    stream.set_read_timeout(Some(PATIENCE))?;
    stream.set_write_timeout(Some(PATIENCE))?;
    let mut lines = BufReader::new(stream.try_clone()?.take(LONGEST)).lines();
    let first = lines.next().transpose()?.unwrap_or_default();
    let mut host = String::new();
    for line in lines {
        let line = line?;
        match line.split_once(':') {
            Some((name, value)) if name.eq_ignore_ascii_case("host") => {
                host = value.trim().to_string();
            }
            None if line.is_empty() => break,
            _ => {}
        }
    }
    let is_ours = ["127.0.0.1", "localhost"]
        .iter()
        .any(|name| host == format!("{name}:{port}") || (port == 80 && host == *name));
    let path = match first.split(' ').collect::<Vec<_>>()[..] {
        ["GET", path, _] => path,
        _ => return plain(stream, "405 Method Not Allowed", "only GET is answered"),
    };
    if !is_ours {
        return plain(stream, "403 Forbidden", "this page is for its own machine");
    }
    if let Some(after) = path.strip_prefix("/changes?after=") {
        return match after.parse() {
            Ok(after) => wait(stream, shared, after),
            Err(_) => plain(stream, "400 Bad Request", "which version?"),
        };
    }
    if path != "/" {
        return plain(stream, "404 Not Found", "there is one page, at /");
    }
    let html = shared.current().html.clone();
    reply(stream, "200 OK", "text/html; charset=utf-8", &html)
}

fn plain(stream: TcpStream, status: &str, text: &str) -> io::Result<()> {
    reply(stream, status, "text/plain; charset=utf-8", text)
}

fn reply(mut stream: TcpStream, status: &str, kind: &str, text: &str) -> io::Result<()> {
    write!(
        stream,
        "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {}\r\nCache-Control: no-store\r\n\
         X-Content-Type-Options: nosniff\r\nConnection: close\r\n\r\n{text}",
        text.len()
    )?;
    stream.flush()
}

/// Says once that there is another version than this, as soon as there is.
fn wait(mut stream: TcpStream, shared: &Shared, after: u64) -> io::Result<()> {
    stream.write_all(
        b"HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\nCache-Control: no-store\r\nConnection: close\r\n\r\n",
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
            // Whoever has gone away is noticed.
            stream.write_all(b": still here\n\n")?;
            current = shared.current();
        }
    }
    let version = current.version;
    drop(current);
    write!(stream, "data: {version}\n\n")?;
    stream.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_of_linkwright_itself_is_shown_and_survived() {
        let Err(Problem(text)) = survived::<()>(|| panic!("a defect")) else {
            unreachable!("it panics")
        };
        assert!(
            text.starts_with("error[K90]: internal error: a defect"),
            "{text}"
        );
        assert_eq!(survived(|| Ok(7)), Ok(7));
    }
}
