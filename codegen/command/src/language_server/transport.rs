//! *Bytes of a client ↔ messages.* What cannot be read as a message is an [`Event`] of its own, and reading goes on behind it.

use std::io::{self, BufRead, Read as _, Write as _};
use std::sync::mpsc::Sender;
use std::thread;

use lsp_server::Message;
use serde_json::json;

use super::session::Event;

/// The longest message that is read, in bytes: several times the largest description.
const LONGEST_MESSAGE: usize = 64 << 20;

/// The longest line of a header that is read, in bytes.
const LONGEST_HEADER: u64 = 4096;

/// Reads messages from stdin until it ends or nobody listens.
pub fn listen(events: Sender<Event>) {
    thread::spawn(move || {
        let mut input = io::stdin().lock();
        loop {
            let event = match read(&mut input) {
                Ok(Some(event)) => event,
                Ok(None) | Err(_) => Event::Gone,
            };
            let is_last = matches!(event, Event::Gone);
            if events.send(event).is_err() || is_last {
                return;
            }
        }
    });
}

/// The next message, or that there is none which can be read; `None` at the end.
fn read(input: &mut impl BufRead) -> io::Result<Option<Event>> {
    let Some(length) = length(input)? else {
        return Ok(None);
    };
    if length > LONGEST_MESSAGE {
        io::copy(&mut input.take(length as u64), &mut io::sink())?;
        let text = format!("the message is longer than {} MiB", LONGEST_MESSAGE >> 20);
        return Ok(Some(Event::Unreadable(text)));
    }
    let mut bytes = Vec::new();
    input.take(length as u64).read_to_end(&mut bytes)?;
    if bytes.len() < length {
        return Ok(None);
    }
    Ok(Some(match serde_json::from_slice(&bytes) {
        Ok(message) => Event::Message(message),
        Err(error) => Event::Unreadable(error.to_string()),
    }))
}

/// The length that the next header gives. Lines that are none of a header are passed.
fn length(input: &mut impl BufRead) -> io::Result<Option<usize>> {
    let mut length = None;
    loop {
        let mut line = Vec::new();
        input.take(LONGEST_HEADER).read_until(b'\n', &mut line)?;
        if line.is_empty() {
            return Ok(None);
        }
        let line = String::from_utf8_lossy(&line);
        let line = line.trim();
        match (line.is_empty(), length) {
            (true, Some(length)) => return Ok(Some(length)),
            (true, None) => {}
            (false, _) => {
                let (name, value) = line.split_once(':').unwrap_or_default();
                if name.trim().eq_ignore_ascii_case("Content-Length") {
                    length = value.trim().parse().ok();
                }
            }
        }
    }
}

/// Sends a message to the client.
///
/// # Errors
/// Those of stdout: the client is gone.
pub fn send(message: &Message) -> io::Result<()> {
    message.write(&mut io::stdout().lock())
}

/// Says that a message could not be read; whose answer that is is not known.
///
/// # Errors
/// Those of stdout.
pub fn refuse(reason: &str) -> io::Result<()> {
    let code = lsp_server::ErrorCode::ParseError as i32;
    let answer = json!({
        "jsonrpc": "2.0",
        "id": null,
        "error": { "code": code, "message": reason },
    });
    let text = answer.to_string();
    let mut output = io::stdout().lock();
    write!(output, "Content-Length: {}\r\n\r\n{text}", text.len())?;
    output.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is read from some bytes: the methods of messages, and `?` for what cannot be read.
    fn all(bytes: &str) -> Vec<String> {
        let mut input = bytes.as_bytes();
        let mut found = Vec::new();
        while let Some(event) = read(&mut input).expect("bytes can be read") {
            found.push(match event {
                Event::Message(Message::Notification(it)) => it.method,
                _ => "?".to_string(),
            });
        }
        found
    }

    fn framed(text: &str) -> String {
        format!("Content-Length: {}\r\n\r\n{text}", text.len())
    }

    #[test]
    fn reading_goes_on_behind_what_is_no_message() {
        let good = framed(r#"{"jsonrpc":"2.0","method":"m"}"#);
        let bytes = [
            framed("{"),
            good.clone(),
            "rubbish\r\n\r\nContent-Length: many\r\n\r\n".to_string(),
            good.clone(),
            framed("[]"),
            "content-length:30\r\nContent-Type: x\r\n\r\n".to_string(),
            r#"{"jsonrpc":"2.0","method":"n"}"#.to_string(),
            "Content-Length: 99\r\n\r\n{".to_string(),
        ];
        assert_eq!(all(&bytes.concat()), ["?", "m", "m", "?", "n"]);
    }
}
