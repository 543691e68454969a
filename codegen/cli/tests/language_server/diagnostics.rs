//! Diagnostics while typing equal those of the command line, at the same positions.

use linkwright_codegen::diagnostic::{Diagnostics, Severity, Source};
use linkwright_codegen::stages::files;
use linkwright_codegen::stages::files::attach_files;
use linkwright_codegen::{Options, generate};
use serde_json::{Value, json};

use crate::client::{Client, UNSAVED, address, descriptions};

/// Diagnostics of the generator for a description.
fn said(source: &Source) -> Diagnostics {
    match generate(source, &Options::default()) {
        Ok(generated) => generated.warnings,
        Err(found) => found,
    }
}

/// Line and column, in UTF-16 from 0, of an offset.
fn place(text: &str, offset: u32) -> Value {
    let before = &text[..(offset as usize).min(text.len())];
    let line = before.rsplit('\n').next().unwrap_or(before);
    json!({ "line": before.matches('\n').count(), "character": line.encode_utf16().count() })
}

/// All diagnostics of a description are published, and nothing else.
#[test]
fn findings_are_those_of_the_command_line() {
    let mut client = Client::start();
    let mut compared = 0;
    for folder in ["tests/cases/errors", "mechanisms"] {
        for (path, text) in descriptions(folder) {
            let source = Source::new(path.display().to_string(), text.as_str());
            let source = attach_files(source, files::folder_of(&path));
            client.open(&address(&path), &text);
            let expected = said(&source).into_sorted();
            let findings = client.findings_when(|found| found.len() == expected.len());
            for (findings, expected) in findings.iter().zip(&expected) {
                let name = path.display();
                let severity = match expected.severity {
                    Severity::Error => 1,
                    Severity::Warning => 2,
                };
                assert_eq!(findings["severity"], severity, "{name}");
                assert_eq!(findings["code"], expected.code.to_string(), "{name}");
                let span = expected.primary.span;
                let [start, end] = [span.start, span.end.max(span.start)];
                assert_eq!(findings["range"]["start"], place(&text, start), "{name}");
                assert_eq!(findings["range"]["end"], place(&text, end), "{name}");
                let message = findings["message"].as_str().expect("a text");
                let mut words = vec![&expected.message, &expected.primary.text];
                words.extend(&expected.notes);
                words.extend(&expected.help);
                for words in words {
                    assert!(message.contains(words.as_str()), "{name}: {message}");
                }
                let related = findings["relatedInformation"].as_array();
                let related = related.map_or(&[][..], Vec::as_slice);
                assert_eq!(related.len(), expected.secondary.len(), "{name}");
                for (findings, expected) in related.iter().zip(&expected.secondary) {
                    let start = &findings["location"]["range"]["start"];
                    assert_eq!(*start, place(&text, expected.span.start), "{name}");
                }
                compared += 1;
            }
        }
    }
    assert!(compared > 200, "only {compared} findings were compared");
    client.finish();
}

/// Text with characters of one, two, three and four bytes before an error.
const WIDE: &str = "mechanism m {\n    /* \u{e4}\u{20ac}\u{1d54f} */ point A = (sine(1), 0);\n    body 1 at A;\n}\n";

#[test]
fn columns_are_counted_as_agreed() {
    for (offered, agreed, column) in [
        (json!(["utf-8", "utf-16"]), "utf-8", 31),
        (json!(["utf-16"]), "utf-16", 26),
        (json!(null), "utf-16", 26),
    ] {
        let mut client = Client::with(json!({ "general": { "positionEncodings": offered } }));
        assert_eq!(client.offered["positionEncoding"], agreed);
        client.open(UNSAVED, WIDE);
        let findings = client.findings();
        assert_eq!(findings[0]["code"], "K13");
        assert_eq!(
            findings[0]["range"]["start"],
            json!({ "line": 1, "character": column })
        );
        // The error is mended, in the columns that were negotiated.
        let range = json!({
            "start": { "line": 1, "character": column },
            "end": { "line": 1, "character": column + 4 },
        });
        client.change(UNSAVED, json!({ "range": range, "text": "sin" }));
        client.findings_with("K32");
        client.finish();
    }
}

#[test]
fn a_client_without_related_places_is_told_the_lines() {
    let mut client = Client::with(json!({}));
    client.open(
        UNSAVED,
        "mechanism m {\n    point A = (0, 0);\n    point A = (1, 0);\n}\n",
    );
    let findings = client.findings();
    let message = findings[0]["message"].as_str().expect("a text");
    assert!(
        message.ends_with("line 2: first declared here"),
        "{message}"
    );
    assert!(findings[0].get("relatedInformation").is_none());
    client.finish();
}

#[test]
fn tables_are_read_from_the_folder_of_the_document() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("language server tables");
    std::fs::create_dir_all(&folder).expect("a folder");
    let path = folder.join("cam.mech");
    let text = "mechanism m {\n    table lift = \"lift.csv\";\n    body 1 at (0, 0);\n    absolute_x(1) = 0;\n    absolute_y(1) = 0;\n    drive phi(1) = lift(t);\n}\n";
    std::fs::write(&path, "not what is edited").expect("written");
    std::fs::write(folder.join("lift.csv"), "0,0\n1,1\n2,0\n").expect("written");
    let uri = address(&path).replace(' ', "%20");
    let mut client = Client::start();
    client.open(&uri, text);
    client.findings_when(<[Value]>::is_empty);
    std::fs::write(folder.join("lift.csv"), "0,0\n1,1\n1,0\n").expect("written");
    client.note(
        "textDocument/didSave",
        json!({ "textDocument": { "uri": uri } }),
    );
    client.findings_with("K27");
    // A description that is not saved has no folder.
    client.open(UNSAVED, text);
    let findings = client.findings_with("K29");
    let message = findings[0]["message"].as_str().expect("a text");
    assert!(
        message.contains("the description is not saved yet"),
        "{message}"
    );
    client.finish();
}

/// An outdated text has no diagnostics; the newest text has all.
#[test]
fn only_the_newest_text_is_reported() {
    let mut client = Client::start();
    client.open(UNSAVED, "mechanism m {");
    for number in 0..200 {
        let text = format!("mechanism m {{ const c{number} = d; body 1 at (0, 0); }}");
        client.change(UNSAVED, json!({ "text": text }));
    }
    let findings = client.findings();
    assert_eq!(
        findings[0]["message"].as_str().map(|it| it.lines().next()),
        Some(Some("no constant is named `d`"))
    );
    client.finish();
}
