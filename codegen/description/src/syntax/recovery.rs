//! *Tokens of a mechanism → its statements, whatever is wrong with some of them.* A statement that fails is reported and left out;
//! reading goes on after its semicolon or braces, or where a line starts the next statement.

use proc_macro2::Delimiter;

use super::body;
use super::document::Statement;
use super::part::part;
use super::repeat::repeat;
use super::statement::statement;
use super::tokens::Tokens;

/// All statements up to the end of the group.
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

/// Passes a statement that could not be read. The members of a body are looked at all the same.
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
            // Where braces do not belong, the statement still ends in a semicolon; `if … { … } else { … }` has two of them.
            if tokens.mark(';').is_some() || tokens.peek_word() != Some("else") {
                return;
            }
        }
        tokens.skip();
    }
}
