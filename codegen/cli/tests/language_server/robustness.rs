//! The server answers every request about incomplete text.

use serde_json::{Value, json};

use crate::client::{Client, UNSAVED, repository};

/// Requests about every text.
const QUESTIONS: [&str; 6] = [
    "hover",
    "definition",
    "references",
    "completion",
    "prepareRename",
    "documentHighlight",
];

fn description(name: &str) -> String {
    let path = repository().join("mechanisms").join(name);
    std::fs::read_to_string(path).expect("a description")
}

/// Line and column of an offset, in UTF-16.
fn place(text: &str, offset: usize) -> (usize, usize) {
    let before = &text[..offset];
    let line = before.rsplit('\n').next().unwrap_or(before);
    (before.matches('\n').count(), line.encode_utf16().count())
}

/// Sends the server a text and all requests about a position in it. A refusal is an answer, a failure of the server is
/// not.
fn ask_all(client: &mut Client, text: &str, offset: usize) {
    client.change(UNSAVED, json!({ "text": text }));
    let at = place(text, offset);
    let check = |answer: Result<Value, String>| {
        if let Err(reason) = answer {
            assert!(!reason.contains("internal error"), "{reason}\n{text}");
        }
    };
    for question in QUESTIONS {
        check(client.ask_at(question, UNSAVED, at));
    }
    let document = json!({ "uri": UNSAVED });
    check(client.ask(
        "textDocument/documentSymbol",
        json!({ "textDocument": document }),
    ));
    let options = json!({ "tabSize": 4, "insertSpaces": true });
    let params = json!({ "textDocument": document, "options": options });
    check(client.ask("textDocument/formatting", params));
    let params = json!({
        "textDocument": document,
        "position": { "line": at.0, "character": at.1 },
        "newName": "another",
    });
    check(client.ask("textDocument/rename", params));
}

fn started() -> Client {
    let mut client = Client::start();
    client.open(UNSAVED, "");
    client
}

/// Requires that the server responds, with the diagnostics of the last text.
fn still_answers(mut client: Client) {
    client.change(
        UNSAVED,
        json!({ "text": "mechanism m { body 1 at (0, 0); }" }),
    );
    client.findings_with("K32");
    assert_eq!(client.finish().code(), Some(0));
}

#[test]
fn every_third_beginning_of_the_excavator() {
    let text = description("excavator.mech");
    let mut client = started();
    for (offset, _) in text.char_indices().step_by(3) {
        ask_all(&mut client, &text[..offset], offset);
    }
    still_answers(client);
}

#[test]
fn the_excavator_without_each_of_its_lines() {
    let text = description("excavator.mech");
    let lines: Vec<&str> = text.split_inclusive('\n').collect();
    let mut client = started();
    for missing in 0..lines.len() {
        let before = lines[..missing].concat();
        let rest = lines[missing + 1..].concat();
        ask_all(&mut client, &format!("{before}{rest}"), before.len());
    }
    still_answers(client);
}

/// Pseudorandom numbers, equal on every run (Marsaglia, Xorshift RNGs, 2003).
struct Lot(u64);

impl Lot {
    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        usize::try_from(self.0 % bound as u64).expect("it is below the bound")
    }
}

/// Mechanism that is a part of another, several times.
const PARTS: &str = "\
mechanism leg {
    param size = 20mm;
    point A = (0, 0), B = (0, size);
    body crank at A { A, B }
    revolute A(ground, crank);
}
mechanism walker {
    const n = 3;
    repeat i from 1 to n {
        part leg[i] = leg(size = 18mm + 2mm*i) at (100mm*i, 0);
        drive phi(leg[i].crank) = i*t;
    }
    output leg[n].crank.B;
}
";

#[test]
fn every_beginning_of_parts() {
    let mut client = started();
    for (offset, _) in PARTS.char_indices() {
        ask_all(&mut client, &PARTS[..offset], offset);
    }
    still_answers(client);
}

#[test]
fn pieces_of_descriptions_in_any_order() {
    let texts = [
        description("excavator.mech"),
        description("cam_dwell.mech"),
        description("excavator_motions.mech"),
        description("andrews.mech"),
        description("scissor.mech"),
        PARTS.to_string(),
        "\u{e4}\u{1d54f}\r\n\t\"/*(1.{)}]\u{0}\u{feff}".to_string(),
    ];
    let mut lot = Lot(0x2545_f491_4f6c_dd1d);
    let mut client = started();
    let mut text = texts[0].clone();
    for round in 0..600 {
        if round % 30 == 0 {
            text.clone_from(&texts[lot.below(6)]);
        }
        let from = &texts[lot.below(texts.len())];
        let piece: String = from.chars().skip(lot.below(from.chars().count())).collect();
        let piece: String = piece.chars().take(lot.below(40)).collect();
        let start = lot.below(text.chars().count() + 1);
        let removed = lot.below(30);
        let before: String = text.chars().take(start).collect();
        let after: String = text.chars().skip(start + removed).collect();
        text = format!("{before}{piece}{after}");
        ask_all(&mut client, &text, before.len() + piece.len());
    }
    still_answers(client);
}

/// Changes of a part of the text, at any claimed position.
#[test]
fn any_range_can_be_changed() {
    let mut lot = Lot(0x9e37_79b9_7f4a_7c15);
    let mut client = started();
    client.change(UNSAVED, json!({ "text": description("two_body.mech") }));
    for _ in 0..500 {
        let mut place = || json!({ "line": lot.below(40), "character": lot.below(90) });
        let range = json!({ "start": place(), "end": place() });
        let text = ["", "x", "\n", "{ 1.", "\u{1d54f}"][lot.below(5)];
        client.change(UNSAVED, json!({ "range": range, "text": text }));
    }
    client.ask_at("hover", UNSAVED, (3, 3)).expect("an answer");
    still_answers(client);
}
