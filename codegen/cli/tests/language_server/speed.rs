//! How long a keystroke takes: from the change of the text to what is said about it.
//!
//! `cargo test --release -p linkwright-cli --test language_server -- --ignored --nocapture speed`

use std::time::{Duration, Instant};

use serde_json::json;

use crate::client::{Client, UNSAVED, repository};

/// What a keystroke may take, half of them less.
const MEDIAN: Duration = Duration::from_millis(50);

/// Types the last lines of a description, one letter after the other; the times, sorted.
fn typed(name: &str, lines: usize) -> Vec<Duration> {
    let path = repository().join("mechanisms").join(name);
    let text = std::fs::read_to_string(path).expect("a description");
    let body = text.trim_end().strip_suffix('}').expect("a closing brace");
    let body = body.trim_end();
    let start = body
        .match_indices('\n')
        .rev()
        .nth(lines - 1)
        .expect("so many lines")
        .0;
    let mut client = Client::start();
    client.open(UNSAVED, &format!("{}\n}}\n", &body[..start]));
    client.findings();
    let (mut line, mut column) = (body[..start].matches('\n').count(), 0);
    column += body[..start].rsplit('\n').next().map_or(0, str::len);
    let mut times = Vec::new();
    for letter in body[start..].chars() {
        let at = json!({ "line": line, "character": column });
        let begun = Instant::now();
        client.change(
            UNSAVED,
            json!({ "range": { "start": at, "end": at }, "text": letter.to_string() }),
        );
        client.findings();
        times.push(begun.elapsed());
        match letter {
            '\n' => (line, column) = (line + 1, 0),
            _ => column += letter.len_utf16(),
        }
    }
    client.finish();
    times.sort();
    times
}

#[test]
#[ignore = "measures, in release"]
fn a_keystroke_is_answered_in_time() {
    for (name, lines) in [
        ("excavator.mech", 1),
        ("excavator.mech", 4),
        ("two_body.mech", 2),
        ("andrews.mech", 2),
        ("scissor.mech", 2),
        ("excavator_motions.mech", 3),
    ] {
        let times = typed(name, lines);
        let (median, worst) = (times[times.len() / 2], times[times.len() - 1]);
        println!(
            "{name}: {} keystrokes, median {median:.1?}, worst {worst:.1?}",
            times.len()
        );
        assert!(median < MEDIAN, "{name}: {median:?}");
    }
}
