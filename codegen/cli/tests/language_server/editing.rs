//! Requests of an editor about a position: hover, declarations and uses.

use serde_json::Value;

use crate::client::{Client, UNSAVED, repository};

/// Crank and rod, with names of every kind.
pub(super) const CRANK: &str = "\
mechanism crank {
    /// How far the pin is out.
    param r = 50mm;
    const d = sqrt(2)*r;
    const e = 2*30mm;
    input angle = 30deg;
    table lift = [(0, 0), (1, 1), (2, 0)];
    /// Where the crank turns.
    point O = (0, 0), S = (0.2, 0);
    /// It turns.
    body 1 at O { O, P: (r, 0) }
    body rod at (0.1, 0) { P: (-d, 0), Q: (d, 0) }
    revolute O(ground, 1);
    /// The crank pin.
    revolute P(1, rod);
    absolute_y(rod.Q) = e - 60mm;
    drive turn: phi(1) = angle + 2*t;
    output P, phi(rod);
}
";

pub(super) fn opened(text: &str) -> Client {
    let mut client = Client::start();
    client.open(UNSAVED, text);
    client.findings();
    client
}

/// The place of the `number`-th occurrence of a text, from 0, in the description.
pub(super) fn place(text: &str, part: &str, number: usize) -> (usize, usize) {
    let (at, _) = text.match_indices(part).nth(number).expect("it is there");
    let before = &text[..at];
    let line = before.rsplit('\n').next().unwrap_or(before);
    (before.matches('\n').count(), line.encode_utf16().count())
}

pub(super) fn hover(client: &mut Client, text: &str, part: &str, number: usize) -> String {
    let answer = client.ask_at("hover", UNSAVED, place(text, part, number));
    let answer = answer.expect("an answer");
    answer["contents"]["value"]
        .as_str()
        .unwrap_or("")
        .to_string()
}

#[test]
fn hover_says_what_a_name_is() {
    let mut client = opened(CRANK);
    let mut hover_text = |part: &str, number| hover(&mut client, CRANK, part, number);
    assert_eq!(
        hover_text("r = ", 0),
        "```mech\nparam r = 50mm;\n```\n\nparameter = 0.05 m unless it is set\n\nHow far the pin is out."
    );
    assert_eq!(
        hover_text("d = ", 0),
        "```mech\nconst d = sqrt(2)*r;\n```\n\nconstant = √2·r = 0.07071067811865477 m"
    );
    assert_eq!(
        hover_text("e - ", 0),
        "```mech\nconst e = 2*30mm;\n```\n\nconstant = 0.06 m"
    );
    assert_eq!(
        hover_text("O, ", 0),
        "```mech\npoint O = (0, 0)\n```\n\npoint in global coordinates, carried by body `1`\n\nWhere the crank turns."
    );
    assert_eq!(
        hover_text("1) = angle", 0),
        "```mech\nbody 1 at O { O, P: (r, 0) }\n```\n\nbody with the coordinates `x1`, `y1`, `phi1`\n\nIt turns."
    );
    // The name of a joint is that of its point on both bodies.
    assert_eq!(
        hover_text("P(1, ", 0),
        "```mech\nP: (r, 0)\nP: (-d, 0)\n```\n\npoint of the bodies `1` and `rod`\n\n```text\nx₁ + r·cos φ₁ − x_rod + √2·r·cos φ_rod = 0\ny₁ + r·sin φ₁ − y_rod + √2·r·sin φ_rod = 0\n```"
    );
    assert_eq!(
        hover_text("turn: ", 0),
        "```mech\ndrive turn: phi(1) = angle + 2*t;\n```\n\ndriver\n\n```text\nφ₁ − angle − 2·t = 0\n```"
    );
    assert!(
        hover_text("angle + ", 0)
            .contains("input = 0.5235987755982988 rad, constant unless it is supplied")
    );
    assert!(hover_text("lift", 0).contains("table"));
    // Words of the language.
    let kind = hover_text("absolute_y", 0);
    assert!(kind.contains("`absolute_y(1) = 0;`"), "{kind}");
    assert!(
        kind.ends_with("```text\ny_rod + √2·r·sin φ_rod = 0\n```"),
        "{kind}"
    );
    assert_eq!(hover_text("60mm", 0), "a length, 0.06 m");
    assert_eq!(hover_text("30deg", 0), "an angle, 0.5235987755982988 rad");
    assert_eq!(hover_text("t;", 0), "the time, in s");
    assert_eq!(hover_text("mechanism", 0), "");
    client.finish();
}

#[test]
fn hover_says_what_a_pressure_angle_is() {
    let text = "mechanism m {\n    param slope = 20deg;\n    point A = (0, 0), B = (1, 0);\n    body 1 at A { A }\n    body 2 at B { B }\n    revolute A(ground, 1);\n    revolute B(ground, 2);\n    external_gear (1, 2) = 1/2 pressure_angle slope + 1deg;\n    drive phi(1) = t;\n}\n";
    let mut client = opened(text);
    let mut hover_text = |part: &str, number| hover(&mut client, text, part, number);
    assert!(hover_text("pressure_angle", 0).starts_with("the angle between the line of action"));
    assert!(hover_text("external_gear", 0).contains("pressure_angle 20deg"));
    // A mention of the parameter.
    assert!(hover_text("slope + ", 0).contains("= 0.3490658503988659 rad unless it is set"));
    assert_eq!(hover_text("1deg", 0), "an angle, 0.017453292519943295 rad");
    client.finish();
}

#[test]
fn hover_explains_friction_and_motors() {
    let text = "mechanism m {\n    point A = (0, 0);\n    body 1 at A { A, S: (1, 0) }\n    revolute A(ground, 1);\n    drive crank: phi(1) = 2;\n    mass 1 = 1kg at S;\n    friction A = 0.1 radius 5mm;\n    motor crank gear 50 efficiency 0.8;\n}\n";
    let mut client = opened(text);
    let mut hover_text = |part: &str| hover(&mut client, text, part, 0);
    assert!(hover_text("friction").starts_with("Coulomb friction in a joint"));
    assert!(hover_text("radius").starts_with("the radius of a pin"));
    assert!(hover_text("motor").starts_with("a motor at a driver"));
    assert!(hover_text("gear").starts_with("the rotation of the shaft"));
    assert!(hover_text("efficiency").starts_with("the part of the power"));
    assert!(hover_text("crank gear").contains("drive crank: phi(1) = 2;"));
    client.finish();
}

#[test]
fn hover_answers_before_the_equations_are_known() {
    // The driver is missing, and so are equations; a name is what it is.
    let text = CRANK.replace("drive turn", "drive");
    let broken = text.replace("rod.Q", "rod.");
    let mut client = opened(&broken);
    let hover_text = hover(&mut client, &broken, "d = ", 0);
    assert_eq!(hover_text, "```mech\nconst d = sqrt(2)*r;\n```\n\nconstant");
    client.finish();
}

/// The places of an answer, as line and column.
pub(super) fn places(answer: &Value) -> Vec<(u64, u64)> {
    let place = |it: &Value| {
        let start = &it["range"]["start"];
        let number = |name: &str| start[name].as_u64().expect("a number");
        (number("line"), number("character"))
    };
    answer
        .as_array()
        .expect("a list")
        .iter()
        .map(place)
        .collect()
}

#[test]
fn declarations_and_uses_are_found() {
    let mut client = opened(CRANK);
    let mut ask = |method: &str, part: &str, number| {
        let answer = client.ask_at(method, UNSAVED, place(CRANK, part, number));
        places(&answer.expect("an answer"))
    };
    assert_eq!(ask("definition", "r, 0)", 0), [(2, 10)]);
    assert_eq!(ask("references", "r, 0)", 0), [(2, 10), (3, 22), (10, 25)]);
    assert_eq!(
        ask("documentHighlight", "r, 0)", 0),
        [(2, 10), (3, 22), (10, 25)]
    );
    // A point that a body lists is drawn elsewhere.
    assert_eq!(ask("definition", "O, P", 0), [(8, 10)]);
    // The joint's point is declared on both bodies.
    assert_eq!(ask("definition", "P(1, ", 0), [(10, 21), (11, 27)]);
    assert_eq!(
        ask("references", "P(1, ", 0),
        [(10, 21), (11, 27), (14, 13), (17, 11)]
    );
    // A body that is named by an integer.
    assert_eq!(
        ask("references", "1 at", 0),
        [(10, 9), (12, 23), (14, 15), (16, 20)]
    );
    assert_eq!(ask("definition", "Q) =", 0), [(11, 39)]);
    assert_eq!(ask("definition", "sqrt", 0), []);
    assert_eq!(ask("definition", "Where the", 0), []);
    client.finish();
}

#[test]
fn names_of_one_motion_are_its_own() {
    let text = "mechanism m {\n    const w = 1;\n    body 1 at (0, 0);\n    absolute_x(1) = 0;\n    absolute_y(1) = 0;\n    motion a { const v = w; drive phi(1) = v*t; }\n    motion b { const v = 2; drive phi(1) = v*t; }\n}\n";
    let mut client = opened(text);
    let answer = client.ask_at("references", UNSAVED, place(text, "v*t", 1));
    assert_eq!(places(&answer.expect("an answer")), [(6, 21), (6, 43)]);
    let answer = client.ask_at("references", UNSAVED, place(text, "w = 1", 0));
    assert_eq!(places(&answer.expect("an answer")), [(1, 10), (5, 25)]);
    client.finish();
}

#[test]
fn the_excavator_is_known_whole() {
    let text = std::fs::read_to_string(repository().join("mechanisms/excavator.mech"));
    let text = text.expect("a description");
    let mut client = opened(&text);
    let hover_text = hover(&mut client, &text, "length(N, M)", 0);
    assert!(hover_text.contains("= 0\n```"), "{hover_text}");
    // The line of a driver is that of its joint: both points of the drawing.
    let answer = client.ask_at("references", UNSAVED, place(&text, "N, M", 0));
    let lines: Vec<u64> = places(&answer.expect("an answer"))
        .iter()
        .map(|it| it.0)
        .collect();
    assert_eq!(lines, [10, 20, 21, 21, 35, 38, 41, 41]);
    client.finish();
}
