//! Completion: candidates at a position, and the text that they replace.

use serde_json::Value;

use crate::client::{Client, UNSAVED, marked};

/// The labels that are offered where `|` stands.
pub(super) fn offered(text: &str) -> Vec<String> {
    let (text, at) = marked(text);
    let mut client = Client::start();
    client.open(UNSAVED, &text);
    let answer = client.ask_at("completion", UNSAVED, at).expect("an answer");
    let labels = answer.as_array().expect("a list").iter();
    let label = |it: &Value| it["label"].as_str().expect("a label").to_string();
    let labels = labels.map(label).collect();
    client.finish();
    labels
}

const BEGUN: &str = "mechanism m {\n    param L = 1m;\n    point A = (0, 0), B = (1, 0);\n    body 1 at A { A, P: (L, 0) }\n    body two at B { B }\n    curve rim(s) on two = (s, s);\n    HERE\n}\n";

fn offered_in(statement: &str) -> Vec<String> {
    offered(&BEGUN.replace("HERE", statement))
}

#[test]
fn completion_offers_what_can_stand_there() {
    let statements = offered_in("re|");
    for word in [
        "revolute",
        "redundant",
        "reaction",
        "output",
        "body",
        "weld",
    ] {
        assert!(
            statements.iter().any(|it| it == word),
            "{word}: {statements:?}"
        );
    }
    assert!(!statements.iter().any(|it| it == "L" || it == "sin"));
    assert_eq!(offered_in("absolute_x(1.|) = 0;"), ["A", "P", "x", "y"]);
    assert_eq!(offered_in("absolute_x(two.B|) = 0;"), ["B", "x", "y"]);
    assert_eq!(offered_in("absolute_x(ground.|"), ["A", "B"]);
    assert_eq!(offered_in("absolute_x(1.|"), ["A", "P", "x", "y"]);
    assert_eq!(offered_in("revolute A(|"), ["1", "two", "ground", "A", "B"]);
    assert_eq!(
        offered_in("translational (1, t|) along A -> B;"),
        ["1", "two", "ground"]
    );
    assert_eq!(offered_in("roller (1.P, |) = 5mm;"), ["rim"]);
    assert_eq!(offered_in("body 3 at A { | }"), ["A", "B"]);
    assert!(
        offered_in("redundant |")
            .iter()
            .any(|it| it == "translational")
    );
    let losses = |statement: &str| {
        offered_in(&format!(
            "revolute A(ground, 1);\n    translational rail(ground, two) along A -> B;\n    drive crank: phi(1) = 1;\n    {statement}"
        ))
    };
    assert_eq!(losses("motor |"), ["crank"]);
    let joints = losses("friction |");
    assert!(joints.iter().any(|it| it == "rail") && joints.iter().any(|it| it == "A"));
    assert!(!joints.iter().any(|it| it == "crank"), "{joints:?}");
    let clauses = losses("friction A = 0.1 |");
    assert!(clauses.iter().any(|it| it == "radius") && clauses.iter().any(|it| it == "over"));
    let driven = offered_in("drive |");
    assert_eq!(driven[0], "phi");
    assert!(driven.iter().any(|it| it == "length") && driven.iter().any(|it| it == "two"));
    let formula = offered_in("drive phi(1) = L*|;");
    for word in ["L", "sin", "cycloidal", "t", "pi", "distance", "if"] {
        assert!(formula.iter().any(|it| it == word), "{word}: {formula:?}");
    }
    let teeth = offered_in("external_gear (1, two) = 20/40 pre|");
    assert!(teeth.iter().any(|it| it == "pressure_angle"), "{teeth:?}");
    // The choice's braces hold a formula.
    let choice = offered_in("drive phi(1) = if t < 1 { |");
    assert!(choice.iter().any(|it| it == "sin") && !choice.iter().any(|it| it == "revolute"));
    let units = offered_in("drive length(A, B) = 50m|");
    assert!(units.iter().any(|it| it == "mm") && units.iter().any(|it| it == "rpm"));
    // What runs along a curve is known there alone.
    assert!(
        offered(&BEGUN.replace("(s, s)", "(s|, s)"))
            .iter()
            .any(|it| it == "s")
    );
    assert!(!formula.iter().any(|it| it == "s"));
    assert!(offered_in("// re|").is_empty());
    assert!(offered_in("/* re| */").is_empty());
    assert!(offered_in("table f = \"re|\";").is_empty());
    assert_eq!(offered("me|"), ["mechanism"]);
    assert_eq!(offered("|"), ["mechanism"]);
}

#[test]
fn completion_replaces_what_has_been_written() {
    let (text, at) = marked(&BEGUN.replace("HERE", "drive phi(1) = co|s(t);"));
    let mut client = Client::start();
    client.open(UNSAVED, &text);
    let answer = client.ask_at("completion", UNSAVED, at).expect("an answer");
    let items = answer.as_array().expect("a list");
    let item = items
        .iter()
        .find(|it| it["label"] == "cos")
        .expect("it is offered");
    let range = &item["textEdit"]["range"];
    assert_eq!(range["start"]["character"].as_u64(), Some(at.1 as u64 - 2));
    assert_eq!(range["end"]["character"].as_u64(), Some(at.1 as u64));
    client.finish();
}
