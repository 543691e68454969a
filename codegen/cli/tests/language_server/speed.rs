//! Duration of a keystroke: from the change of the text to its diagnostics.
//!
//! `cargo test --profile optimized -p linkwright-cli --test language_server -- --ignored --nocapture speed`

use std::time::{Duration, Instant};

use serde_json::json;

use crate::client::{Client, UNSAVED, repository};

/// Limit for the median duration of a keystroke.
const MEDIAN: Duration = Duration::from_millis(50);

fn description(name: &str) -> String {
    let path = repository().join("mechanisms").join(name);
    std::fs::read_to_string(path).expect("a description")
}

/// Types a text before another, one letter after the other; returns the durations, sorted.
fn typed(before: &str, text: &str, after: &str) -> Vec<Duration> {
    let mut client = Client::start();
    client.open(UNSAVED, &format!("{before}{after}"));
    client.findings();
    let mut line = before.matches('\n').count();
    let mut column = before
        .rsplit('\n')
        .next()
        .map_or(0, |it| it.encode_utf16().count());
    let mut times = Vec::new();
    for letter in text.chars() {
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

/// Types the last lines of a description.
fn last_lines(name: &str, lines: usize) -> Vec<Duration> {
    let text = description(name);
    let body = text.trim_end().strip_suffix('}').expect("a closing brace");
    let body = body.trim_end();
    let mut starts = body.match_indices('\n').rev();
    let (start, _) = starts.nth(lines - 1).expect("so many lines");
    typed(&body[..start], &body[start..], "\n}\n")
}

/// Types a comment into a description: every intermediate text is complete, so that all of its equations are derived
/// every time.
fn comment(name: &str) -> Vec<Duration> {
    let text = description(name);
    let (before, after) = text.split_at(text.rfind('}').expect("a closing brace"));
    typed(
        before,
        "// A comment of several words.",
        &format!("\n{after}"),
    )
}

fn report(name: &str, what: &str, times: &[Duration]) {
    let (median, worst) = (times[times.len() / 2], times[times.len() - 1]);
    let count = times.len();
    println!("{name}, {what}: {count} keystrokes, median {median:.1?}, worst {worst:.1?}");
    assert!(median < MEDIAN, "{name}: {median:?}");
}

#[test]
#[ignore = "measures, in release"]
fn a_keystroke_is_answered_in_time() {
    for name in [
        "excavator.mech",
        "two_body.mech",
        "andrews.mech",
        "scissor.mech",
        "excavator_motions.mech",
    ] {
        report(name, "its last line", &last_lines(name, 1));
        report(name, "its last four lines", &last_lines(name, 4));
        report(name, "a comment", &comment(name));
    }
}
