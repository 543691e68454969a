//! The outline of a description, and its layout.

use serde_json::{Value, json};

use crate::client::{Client, UNSAVED};
use crate::editing::{CRANK, opened};
use crate::renaming::edited;

/// Outline of a document in an editor.
pub fn outline(client: &mut Client) -> Value {
    let params = json!({ "textDocument": { "uri": UNSAVED } });
    client
        .ask("textDocument/documentSymbol", params)
        .expect("an answer")
}

/// Names in a part of an outline.
pub fn names(list: &Value) -> Vec<String> {
    let list = list.as_array().expect("a list").iter();
    list.map(|it| it["name"].as_str().expect("a name").to_string())
        .collect()
}

#[test]
fn the_outline_lists_the_statements() {
    let mut client = opened(CRANK);
    let answer = outline(&mut client);
    assert_eq!(names(&answer), ["mechanism crank"]);
    let statements = &answer[0]["children"];
    assert_eq!(
        names(statements),
        [
            "param r = 50mm",
            "const d = sqrt(2)*r",
            "const e = 2*30mm",
            "input angle = 30deg",
            "table lift = [(0, 0), (1, 1), (2, 0)]",
            "O",
            "S",
            "body 1 at O",
            "body rod at (0.1, 0)",
            "revolute O(ground, 1)",
            "revolute P(1, rod)",
            "absolute_y(rod.Q) = e - 60mm",
            "drive turn: phi(1) = angle + 2*t",
            "output P, phi(rod)",
        ]
    );
    assert_eq!(names(&statements[8]["children"]), ["P", "Q"]);
    client.finish();
}

#[test]
fn a_text_is_laid_out_as_by_the_formatter() {
    let loose = CRANK.replace("body 1 at O { O, P: (r, 0) }", "body 1 at O{O,P:(r,0)}");
    let mut client = opened(&loose);
    let params = json!({
        "textDocument": { "uri": UNSAVED },
        "options": { "tabSize": 4, "insertSpaces": true },
    });
    let edits = client.ask("textDocument/formatting", params.clone());
    let edits = edits.expect("an answer");
    assert_eq!(edited(&loose, &edits), CRANK);
    // Only the changed line is touched.
    assert_eq!(
        edits[0]["range"]["start"],
        json!({ "line": 10, "character": 0 })
    );
    assert_eq!(
        edits[0]["range"]["end"],
        json!({ "line": 11, "character": 0 })
    );
    client.change(UNSAVED, json!({ "text": CRANK }));
    let edits = client.ask("textDocument/formatting", params.clone());
    assert_eq!(edits, Ok(json!([])));
    // A text with errors stays unchanged.
    client.change(
        UNSAVED,
        json!({ "text": loose.replace("param r =", "param r") }),
    );
    assert_eq!(client.ask("textDocument/formatting", params), Ok(json!([])));
    client.finish();
}
