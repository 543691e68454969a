//! Beginning and end of a session, and the errors that it survives.

use serde_json::{Value, json};

use crate::client::{Client, UNREADABLE, UNSAVED};

#[test]
fn a_session_begins_and_ends() {
    let mut client = Client::start();
    assert_eq!(client.offered["positionEncoding"], "utf-16");
    assert_eq!(client.offered["hoverProvider"], true);
    client.open(UNSAVED, "mechanism m { body 1 at (0, 0); }");
    client.findings();
    assert_eq!(client.finish().code(), Some(0));
}

#[test]
fn the_order_of_a_session_is_kept() {
    // Some editors name their transport.
    let mut client = Client::started_with(&["lsp", "--stdio"]);
    let early = client.ask_at("hover", UNSAVED, (0, 0));
    assert_eq!(early, Err("the first request is `initialize`".to_string()));
    let params = json!({ "capabilities": {} });
    client.ask("initialize", params.clone()).expect("it begins");
    assert!(client.ask("initialize", params).is_err());
    assert!(client.ask("textDocument/nothing", json!({})).is_err());
    assert!(
        client
            .ask("textDocument/hover", json!({ "at": 3 }))
            .is_err()
    );
    assert!(
        client
            .ask_at("hover", "file:///not/open.mech", (0, 0))
            .is_err()
    );
    client.ask("shutdown", Value::Null).expect("it ends");
    assert!(client.ask("shutdown", Value::Null).is_err());
    client.note("exit", Value::Null);
    assert_eq!(client.ended().code(), Some(0));
}

#[test]
fn a_client_that_goes_without_leave_ends_the_server() {
    let mut client = Client::start();
    client.open(UNSAVED, "mechanism m {");
    client.hang_up();
    assert_eq!(client.ended().code(), Some(1));
    let mut client = Client::silent();
    client.send(b"Content-Length: 100\r\n\r\n{");
    client.hang_up();
    assert_eq!(client.ended().code(), Some(1));
    let mut client = Client::start();
    client.note("exit", Value::Null);
    assert_eq!(client.ended().code(), Some(1));
}

#[test]
fn invalid_message_is_refused_and_the_next_one_answered() {
    let mut client = Client::start();
    for rubbish in [
        "{",
        "[]",
        "\u{0}\u{1}",
        "{\"jsonrpc\":\"2.0\",\"method\":3}",
    ] {
        client.send(format!("Content-Length: {}\r\n\r\n{rubbish}", rubbish.len()).as_bytes());
    }
    client.send(b"no header\r\n\r\nContent-Length: many\r\n\r\n");
    client.send(b"Content-Length: 2\r\n\r\n\xff\xfe");
    for _ in 0..5 {
        let refused = client.next_answer();
        assert_eq!(refused.id, UNREADABLE.into());
        let error = refused.response_result.expect_err("it could not be read");
        assert_eq!(error.code, -32700);
    }
    client.note("textDocument/didChange", json!({ "nothing": "of it" }));
    client.note("textDocument/didChange", Value::Null);
    client.note("$/unknown", json!([1, 2]));
    client.open(UNSAVED, "mechanism m {");
    assert_eq!(client.findings().len(), 1);
    assert_eq!(client.finish().code(), Some(0));
}

#[test]
fn a_closed_document_has_no_findings() {
    let mut client = Client::start();
    client.open(UNSAVED, "mechanism m {");
    assert!(!client.findings().is_empty());
    let document = json!({ "textDocument": { "uri": UNSAVED } });
    client.note("textDocument/didClose", document);
    assert!(client.ask_at("hover", UNSAVED, (0, 0)).is_err());
    assert_eq!(client.finish().code(), Some(0));
}
