//! New names: everywhere and nowhere else, or a refusal.

use serde_json::{Value, json};

use crate::client::{Client, UNSAVED};
use crate::editing::{CRANK, opened, place};

/// Applies edits to a text, last first.
pub(super) fn edited(text: &str, edits: &Value) -> String {
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

pub(super) fn renamed(
    client: &mut Client,
    text: &str,
    part: &str,
    new: &str,
) -> Result<String, String> {
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
    assert_eq!(refused("e = ", "f /* */"), "`f /* */` is not a name");
    assert!(refused("Where the", "x").starts_with("expected a name that"));
    assert!(refused("sqrt", "x").starts_with("expected a name that"));
    client.finish();
}

#[test]
fn a_new_name_changes_no_meaning() {
    // `mm` behind a number with a unit is a unit unless a value has this name.
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
        refused.starts_with("the description has an error, correct it first: "),
        "{refused}"
    );
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
fn operands_of_a_joint_in_a_wrong_form_are_renamed() {
    let text = "mechanism m {\n    body 1 at (0, 0) { P: (1, 0) }\n    body 2 at (1, 0) { Q: (1, 0) }\n    revolute P(1, 2, ground);\n    slider (2, 1.P);\n}\n";
    let mut client = opened(text);
    let expected = text.replace("2 at", "3 at").replace("1, 2,", "1, 3,");
    let expected = expected.replace("(2, 1.P)", "(3, 1.P)");
    assert_eq!(renamed(&mut client, text, "2 at", "3"), Ok(expected));
    client.finish();
}

/// The generator reads no formula of a curve whose parameter has another meaning.
#[test]
fn a_name_that_a_statement_with_an_error_may_use_is_not_renamed() {
    let text = "mechanism m {\n    const r = 1m;\n    body rod at (0, 0) { P: (r, 0) }\n    curve rim(t) on rod = (r*cos(t), 0);\n}\n";
    let mut client = opened(text);
    let refused = renamed(&mut client, text, "r = 1m", "radius").expect_err("it may be used");
    let reason = "a statement with an error may use this name, correct it first: `t` has another meaning already";
    assert!(refused.starts_with(reason), "{refused}");
    let expected = text.replace("rod", "arm");
    assert_eq!(renamed(&mut client, text, "rod at", "arm"), Ok(expected));
    client.finish();
}

#[test]
fn measures_of_a_motor_are_renamed_with_its_driver() {
    let text = "mechanism hoist {
    point O = (0, 0);
    body arm at O { O, S: (20cm, 0) }
    revolute O(ground, arm);
    drive crank: phi(arm) = t;
    mass arm = 3kg at S;
    motor crank gear 50;
    measure twice = 2*crank_motor_torque;
    limit crank_motor_speed <= 60;
}
";
    let mut client = opened(text);
    for part in [
        "crank:",
        "crank gear",
        "crank_motor_torque",
        "crank_motor_speed",
    ] {
        let expected = text.replace("crank", "drum");
        assert_eq!(renamed(&mut client, text, part, "drum"), Ok(expected));
    }
    client.finish();
}

#[test]
fn friction_is_renamed_with_its_joint() {
    let text = "mechanism hoist {
    point O = (0, 0);
    body arm at O { O, S: (20cm, 0) }
    revolute O(ground, arm);
    drive crank: phi(arm) = t;
    mass arm = 3kg at S;
    friction O = 0.1 radius 5mm;
}
";
    let mut client = opened(text);
    for part in ["O = (0", "O(ground", "O = 0.1"] {
        let expected = text.replace('O', "pin");
        assert_eq!(renamed(&mut client, text, part, "pin"), Ok(expected));
    }
    client.finish();
}
