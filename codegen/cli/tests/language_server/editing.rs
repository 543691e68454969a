//! What an editor asks about a place: hover, declarations, uses, completion, new names, outline and layout.

use serde_json::{Value, json};

use crate::client::{Client, UNSAVED, marked, repository};

/// A crank and a rod, with names of every sort.
const CRANK: &str = "\
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

fn opened(text: &str) -> Client {
    let mut client = Client::start();
    client.open(UNSAVED, text);
    client.findings();
    client
}

/// The place of the `number`-th occurrence of a text, from 0, in the description.
fn place(text: &str, part: &str, number: usize) -> (usize, usize) {
    let (at, _) = text.match_indices(part).nth(number).expect("it is there");
    let before = &text[..at];
    let line = before.rsplit('\n').next().unwrap_or(before);
    (before.matches('\n').count(), line.encode_utf16().count())
}

fn hover(client: &mut Client, text: &str, part: &str, number: usize) -> String {
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
    let mut said = |part: &str, number| hover(&mut client, CRANK, part, number);
    assert_eq!(
        said("r = ", 0),
        "```mech\nparam r = 50mm;\n```\n\nparameter = 0.05 m by default\n\nHow far the pin is out."
    );
    assert_eq!(
        said("d = ", 0),
        "```mech\nconst d = sqrt(2)*r;\n```\n\nconstant = √2·r = 0.07071067811865477 m"
    );
    assert_eq!(
        said("e - ", 0),
        "```mech\nconst e = 2*30mm;\n```\n\nconstant = 0.06 m"
    );
    assert_eq!(
        said("O, ", 0),
        "```mech\npoint O = (0, 0)\n```\n\npoint of the drawing, carried by body `1`\n\nWhere the crank turns."
    );
    assert_eq!(
        said("1) = angle", 0),
        "```mech\nbody 1 at O { O, P: (r, 0) }\n```\n\nbody with the coordinates `x1`, `y1`, `phi1`\n\nIt turns."
    );
    // The name of a joint is that of its point on both bodies.
    assert_eq!(
        said("P(1, ", 0),
        "```mech\nP: (r, 0)\nP: (-d, 0)\n```\n\npoint of the bodies `1` and `rod`\n\n```text\nx₁ + r·cos φ₁ − x_rod + √2·r·cos φ_rod = 0\ny₁ + r·sin φ₁ − y_rod + √2·r·sin φ_rod = 0\n```"
    );
    assert_eq!(
        said("turn: ", 0),
        "```mech\ndrive turn: phi(1) = angle + 2*t;\n```\n\ndriver\n\n```text\nφ₁ − angle − 2·t = 0\n```"
    );
    assert!(said("angle + ", 0).contains("input = 0.5235987755982988 rad at rest"));
    assert!(said("lift", 0).contains("table"));
    // Words of the language.
    let kind = said("absolute_y", 0);
    assert!(kind.contains("`absolute_y(1) = 0;`"), "{kind}");
    assert!(
        kind.ends_with("```text\ny_rod + √2·r·sin φ_rod = 0\n```"),
        "{kind}"
    );
    assert_eq!(said("60mm", 0), "a length, 0.06 m");
    assert_eq!(said("30deg", 0), "an angle, 0.5235987755982988 rad");
    assert_eq!(said("t;", 0), "the time, in s");
    assert_eq!(said("mechanism", 0), "");
    client.finish();
}

#[test]
fn hover_answers_before_the_equations_are_known() {
    // The driver is missing, and so are equations; a name is what it is.
    let text = CRANK.replace("drive turn", "drive");
    let broken = text.replace("rod.Q", "rod.");
    let mut client = opened(&broken);
    let said = hover(&mut client, &broken, "d = ", 0);
    assert_eq!(said, "```mech\nconst d = sqrt(2)*r;\n```\n\nconstant");
    client.finish();
}

/// The places of an answer, as line and column.
fn places(answer: &Value) -> Vec<(u64, u64)> {
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

/// The labels that are offered where `|` stands.
fn offered(text: &str) -> Vec<String> {
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
    let driven = offered_in("drive |");
    assert_eq!(driven[0], "phi");
    assert!(driven.iter().any(|it| it == "length") && driven.iter().any(|it| it == "two"));
    let formula = offered_in("drive phi(1) = L*|;");
    for word in ["L", "sin", "cycloidal", "t", "pi", "distance", "if"] {
        assert!(formula.iter().any(|it| it == word), "{word}: {formula:?}");
    }
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

/// A text with edits carried out, last first.
fn edited(text: &str, edits: &Value) -> String {
    let offset = |place: &Value| {
        let number = |name: &str| place[name].as_u64().expect("a number") as usize;
        let lines = text.split_inclusive('\n').take(number("line"));
        lines.map(str::len).sum::<usize>() + number("character")
    };
    let mut edited = text.to_string();
    for edit in edits.as_array().expect("a list").iter().rev() {
        let range = offset(&edit["range"]["start"])..offset(&edit["range"]["end"]);
        edited.replace_range(range, edit["newText"].as_str().expect("a text"));
    }
    edited
}

fn renamed(client: &mut Client, text: &str, part: &str, new: &str) -> Result<String, String> {
    let at = place(text, part, 0);
    let answer = client.ask(
        "textDocument/rename",
        json!({
            "textDocument": { "uri": UNSAVED },
            "position": { "line": at.0, "character": at.1 },
            "newName": new,
        }),
    )?;
    Ok(edited(text, &answer["changes"][UNSAVED]))
}

#[test]
fn a_name_is_changed_everywhere_and_nothing_else_is() {
    let mut client = opened(CRANK);
    let place = client.ask_at("prepareRename", UNSAVED, place(CRANK, "P(1, ", 0));
    let place = place.expect("it has a name");
    assert_eq!(place["placeholder"], "P");
    let expected = CRANK
        .replace("P: ", "pin: ")
        .replace("P(1, ", "pin(1, ")
        .replace("output P", "output pin");
    assert_eq!(renamed(&mut client, CRANK, "P(1, ", "pin"), Ok(expected));
    let expected = CRANK
        .replace("r = 50mm", "radius = 50mm")
        .replace("*r;", "*radius;")
        .replace("(r, 0)", "(radius, 0)");
    assert_eq!(
        renamed(&mut client, CRANK, "r = 50mm", "radius"),
        Ok(expected)
    );
    let expected = CRANK
        .replace("body 1", "body crank")
        .replace("ground, 1", "ground, crank")
        .replace("P(1,", "P(crank,")
        .replace("phi(1)", "phi(crank)");
    assert_eq!(renamed(&mut client, CRANK, "1 at", "crank"), Ok(expected));
    client.finish();
}

#[test]
fn a_name_that_cannot_be_had_is_refused_in_the_words_of_the_diagnostic() {
    let mut client = opened(CRANK);
    let mut refused = |part: &str, new: &str| {
        let answer = renamed(&mut client, CRANK, part, new);
        answer.expect_err(new)
    };
    assert_eq!(
        refused("r = 50mm", "t"),
        "`t` has a fixed meaning\nhelp: `t`, `pi` cannot be declared; choose another name"
    );
    assert_eq!(
        refused("d = ", "e"),
        "the constant `e` is declared twice\ndeclared again here\nhelp: give one of them another name"
    );
    assert!(refused("Q: ", "P").contains("`P`"));
    assert!(refused("e = ", "2x").starts_with("expected the name of a constant, found `2x`"));
    assert!(
        refused("e = ", "ä").starts_with("the name `ä`"),
        "{}",
        refused("e = ", "ä")
    );
    assert!(!refused("e = ", "").is_empty());
    assert!(!refused("e = ", "a b").is_empty());
    assert!(!refused("e = ", "f = 1; const g").is_empty());
    assert_eq!(refused("e = ", "f /* */"), "`f /* */` is no name");
    assert!(refused("Where the", "x").starts_with("no name"));
    assert!(refused("sqrt", "x").starts_with("no name"));
    client.finish();
}

#[test]
fn a_new_name_changes_no_meaning() {
    // `mm` behind a number with a unit is a unit as long as no value is called so.
    let text = "mechanism m {\n    const k = 2;\n    body 1 at (0, 0) { P: (1, 0) }\n    mass 1 = 2kg;\n    gravity = (0, -9.81m/s^2);\n    absolute_x(1) = k;\n    absolute_y(1) = 0;\n    drive phi(1) = t;\n    effort;\n}\n";
    let mut client = opened(text);
    let refused = renamed(&mut client, text, "k = 2", "s");
    assert!(refused.is_err(), "{refused:?}");
    assert!(renamed(&mut client, text, "k = 2", "other").is_ok());
    client.finish();
}

#[test]
fn nothing_is_renamed_where_a_statement_cannot_be_read() {
    let text = CRANK.replace("output P", "output P P");
    let mut client = opened(&text);
    let refused = renamed(&mut client, &text, "P: ", "pin").expect_err("it has an error");
    assert!(
        refused.starts_with("the description cannot be read: "),
        "{refused}"
    );
    client.finish();
}

#[test]
fn the_outline_lists_the_statements() {
    let mut client = opened(CRANK);
    let params = json!({ "textDocument": { "uri": UNSAVED } });
    let answer = client
        .ask("textDocument/documentSymbol", params)
        .expect("an answer");
    let names = |list: &Value| -> Vec<String> {
        let list = list.as_array().expect("a list").iter();
        list.map(|it| it["name"].as_str().expect("a name").to_string())
            .collect()
    };
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
    // Only the line that changes is touched.
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
    // What cannot be read stays as it is.
    client.change(
        UNSAVED,
        json!({ "text": loose.replace("param r =", "param r") }),
    );
    assert_eq!(client.ask("textDocument/formatting", params), Ok(json!([])));
    client.finish();
}

#[test]
fn the_excavator_is_known_whole() {
    let text = std::fs::read_to_string(repository().join("mechanisms/excavator.mech"));
    let text = text.expect("a description");
    let mut client = opened(&text);
    let said = hover(&mut client, &text, "length(N, M)", 0);
    assert!(said.contains("= 0\n```"), "{said}");
    // The line of a driver is that of its joint: both points of the drawing.
    let answer = client.ask_at("references", UNSAVED, place(&text, "N, M", 0));
    let lines: Vec<u64> = places(&answer.expect("an answer"))
        .iter()
        .map(|it| it.0)
        .collect();
    assert_eq!(lines, [10, 20, 21, 21, 35, 38, 41, 41]);
    client.finish();
}

/// Repeated statements, and a mechanism as a part of another.
const WALKER: &str = "\
/// A crank.
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
    point P[0] = (1, 0);
    repeat k from 1 to n {
        point P[k] = (1, 0.1*k);
        body rod[k] at P[k] { P[k - 1], P[k] }
    }
    output leg[n].crank.B, rod[2].P[2];
}
";

#[test]
fn what_is_repeated_has_one_name() {
    let mut client = opened(WALKER);
    let mut ask = |method: &str, part: &str, number| {
        let answer = client.ask_at(method, UNSAVED, place(WALKER, part, number));
        places(&answer.expect("an answer"))
    };
    assert_eq!(ask("definition", "k - 1", 0), [(15, 11)]);
    assert_eq!(ask("references", "k from", 0).len(), 7);
    assert_eq!(
        ask("references", "n = 3", 0),
        [(9, 10), (10, 23), (15, 23), (19, 15)]
    );
    // One point by each statement that declares one.
    assert_eq!(ask("definition", "P[k - 1]", 0), [(14, 10), (16, 14)]);
    assert_eq!(
        ask("references", "P[2]", 0),
        [(14, 10), (16, 14), (17, 23), (17, 30), (17, 40), (19, 34)]
    );
    // What a part declares, the part, and what it is a part of.
    assert_eq!(ask("definition", "crank) = i", 0), [(4, 9)]);
    assert_eq!(
        ask("references", "crank at", 0),
        [(4, 9), (5, 23), (12, 25), (19, 18)]
    );
    assert_eq!(ask("definition", "leg[i].crank", 0), [(11, 13)]);
    assert_eq!(ask("definition", "leg(size", 0), [(1, 10)]);
    assert_eq!(
        ask("references", "size = 20mm", 0),
        [(2, 10), (3, 30), (11, 26)]
    );
    let said = hover(&mut client, WALKER, "crank.B", 0);
    assert!(
        said.starts_with("```mech\nbody crank at A { A, B }\n```\n\nbody"),
        "{said}"
    );
    assert!(said.contains("`phi_leg3_crank`"), "{said}");
    let said = hover(&mut client, WALKER, "crank at", 0);
    assert!(!said.contains("coordinates"), "{said}");
    let said = hover(&mut client, WALKER, "leg[n]", 0);
    assert!(said.contains("\n\npart"), "{said}");
    client.finish();
}

#[test]
fn what_is_repeated_is_renamed_as_one() {
    let mut client = opened(WALKER);
    let expected = WALKER
        .replace("body crank", "body arm")
        .replace("ground, crank", "ground, arm")
        .replace("].crank", "].arm");
    assert_eq!(
        renamed(&mut client, WALKER, "crank at", "arm"),
        Ok(expected)
    );
    let expected = WALKER
        .replace("point P[", "point pin[")
        .replace("at P[", "at pin[")
        .replace("{ P[", "{ pin[")
        .replace(", P[", ", pin[")
        .replace("].P[", "].pin[");
    assert_eq!(renamed(&mut client, WALKER, "P[0]", "pin"), Ok(expected));
    let expected = WALKER
        .replace("part leg[", "part foot[")
        .replace("(leg[", "(foot[")
        .replace("output leg[", "output foot[");
    assert_eq!(
        renamed(&mut client, WALKER, "leg[i] =", "foot"),
        Ok(expected)
    );
    let expected = WALKER
        .replace("repeat k", "repeat row")
        .replace("[k", "[row")
        .replace("*k", "*row");
    assert_eq!(renamed(&mut client, WALKER, "k from", "row"), Ok(expected));
    assert!(renamed(&mut client, WALKER, "k from", "n").is_err());
    client.finish();
}

#[test]
fn a_description_with_another_error_is_renamed() {
    let text =
        "mechanism m {\n    body rod at (0, 0) { P: (1, 0) }\n    absolute_x(rod.Q) = 0;\n}\n";
    let mut client = opened(text);
    let expected = text.replace("rod", "arm");
    assert_eq!(renamed(&mut client, text, "rod at", "arm"), Ok(expected));
    client.finish();
}

#[test]
fn parts_and_repetitions_are_completed() {
    let offered_in =
        |statement: &str| offered(&WALKER.replace("output", &format!("{statement}\n    output")));
    assert_eq!(
        offered_in("drive phi(leg[2].|) = t;"),
        ["size", "A", "B", "crank"]
    );
    assert_eq!(
        offered_in("drive near: leg[1].crank.|"),
        ["A", "B", "x", "y"]
    );
    let bodies = offered_in("absolute_angle(|) = 0;");
    assert!(bodies.iter().any(|it| it == "rod[2]"), "{bodies:?}");
    assert!(bodies.iter().any(|it| it == "leg[3].crank"), "{bodies:?}");
    let inside = offered_in("repeat j from 1 to 2 { absolute_angle(rod[j]) = | }");
    assert!(inside.iter().any(|it| it == "j"), "{inside:?}");
    assert!(!inside.iter().any(|it| it == "k"), "{inside:?}");
}

#[test]
fn the_outline_lists_mechanisms_and_what_is_repeated_once() {
    let mut client = opened(WALKER);
    let params = json!({ "textDocument": { "uri": UNSAVED } });
    let answer = client
        .ask("textDocument/documentSymbol", params)
        .expect("an answer");
    let names = |list: &Value| -> Vec<String> {
        let list = list.as_array().expect("a list").iter();
        list.map(|it| it["name"].as_str().expect("a name").to_string())
            .collect()
    };
    assert_eq!(names(&answer), ["mechanism leg", "mechanism walker"]);
    assert_eq!(
        names(&answer[0]["children"]),
        [
            "param size = 20mm",
            "A",
            "B",
            "body crank at A",
            "revolute A(ground, crank)"
        ]
    );
    assert_eq!(
        names(&answer[1]["children"]),
        [
            "const n = 3",
            "drive phi(leg[i].crank) = i*t",
            "P[0]",
            "P[k]",
            "body rod[k] at P[k]",
            "output leg[n].crank.B, rod[2].P[2]",
        ]
    );
    client.finish();
}
