//! Parses the statements of a mechanism, whatever errors some of them have. A malformed statement is reported and skipped.
//! Parsing continues after its semicolon or braces, or at a line that starts the next statement.

use proc_macro2::Delimiter;

use super::body;
use super::document::Statement;
use super::part::part;
use super::repeat::repeat;
use super::statement::statement;
use super::tokens::Tokens;

/// Parses all statements up to the end of the group.
pub(super) fn statements(tokens: &mut Tokens<'_>) -> Vec<Statement> {
    let mut statements = Vec::new();
    while !tokens.at_end() && !tokens.reader.is_full() {
        let start = *tokens;
        let first = tokens.next_span();
        let read = match tokens.peek_word() {
            Some("repeat") => {
                tokens.skip();
                repeat(tokens, first, &mut statements)
            }
            Some("part") => {
                tokens.skip();
                part(tokens, first, &mut statements)
            }
            _ => statement(tokens).map(|it| statements.push(it)),
        };
        match read {
            Ok(()) => {}
            Err(failure) => {
                *tokens = start;
                pass(tokens);
                let from = start.next_span().start;
                tokens.reader.report(*failure, from, tokens.previous().end);
            }
        }
    }
    statements
}

/// Skips a malformed statement. The members of a body are still checked.
fn pass(tokens: &mut Tokens<'_>) {
    let is_body = tokens.peek_word() == Some("body");
    let mut first = true;
    while !tokens.at_end() && (first || !tokens.at_statement()) {
        first = false;
        if tokens.mark(';').is_some() {
            return;
        }
        if let Some((inner, _)) = tokens.group(Delimiter::Brace) {
            if is_body {
                body::members(inner);
            }
            // A statement with misplaced braces still ends in a semicolon; `if … { … } else { … }` has two pairs.
            if tokens.mark(';').is_some() || tokens.peek_word() != Some("else") {
                return;
            }
        }
        tokens.skip();
    }
}
