//! Reads and writes messages. Input that is not a message becomes an [`Event`], and reading continues behind it.

use std::io::{self, BufRead, Read as _, Write as _};
use std::sync::mpsc::Sender;
use std::thread;

use lsp_server::Message;
use serde_json::json;

use super::session::Event;

/// Largest message in bytes: several times the largest description.
const LONGEST_MESSAGE: usize = 64 << 20;

/// Largest line of a header in bytes.
const LONGEST_HEADER: u64 = 4096;

/// Reads messages from stdin until the input ends or the receiver is gone.
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

/// Returns the next message, or the event of an unreadable one; `None` at the end.
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

/// Returns the length in the next header; `None` at the end. Unknown lines are ignored.
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
/// Errors of stdout, which the client has closed.
pub fn send(message: &Message) -> io::Result<()> {
    message.write(&mut io::stdout().lock())
}

/// Reports a message that could not be read. The report has no request id, since that is unknown.
///
/// # Errors
/// Errors of stdout.
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

    /// Returns the methods of messages in some bytes, and `?` for unreadable ones.
    fn all(bytes: &str) -> Vec<String> {
        let mut input = bytes.as_bytes();
        let mut methods = Vec::new();
        while let Some(event) = read(&mut input).expect("bytes can be read") {
            methods.push(match event {
                Event::Message(Message::Notification(it)) => it.method,
                _ => "?".to_string(),
            });
        }
        methods
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
