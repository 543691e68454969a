//! Expands repetitions: `repeat i from 1 to 5 { revolute K[i](rod[i], rod[i + 1]); }`.
//!
//! The statements are parsed once per value of the index. Later stages therefore see handwritten statements, with the locations
//! of the repeated ones.

use proc_macro2::Delimiter;

use super::document::Statement;
use super::formula::Name;
use super::indexed::whole_number;
use super::reader::Outcome;
use super::recovery;
use super::scope::{ExpandedSort, MAX_EXPANDED};
use super::tokens::Tokens;
use super::{BUILT_IN, KEYWORDS};
use crate::diagnostic::{Code, Diagnostic, Span};

/// Form of the statement, for help lines.
const FORM: &str = "a repetition is written `repeat i from 1 to 5 { … }`";

/// Expands a repetition after its first word.
pub(super) fn repeat(
    tokens: &mut Tokens<'_>,
    start: Span,
    statements: &mut Vec<Statement>,
) -> Outcome<()> {
    let reader = tokens.reader;
    let index = index(tokens)?;
    if tokens.keyword("from").is_none() {
        return Err(tokens.unexpected("`from`", FORM));
    }
    let first = whole_number(tokens)?;
    if tokens.keyword("to").is_none() {
        return Err(tokens.unexpected("an operation or `to`", FORM));
    }
    let last = whole_number(tokens)?;
    let head = start.to(tokens.previous());
    let Some((inner, _)) = tokens.group(Delimiter::Brace) else {
        return Err(tokens.unexpected("an operation or `{`", FORM));
    };
    reader.learn(|scope| scope.declare(ExpandedSort::Index, index.clone(), head));
    // The statements of an empty repetition are read for their errors.
    let is_empty = last < first;
    let last = last.max(first);
    let before = reader.count_of_findings();
    for value in first..=last {
        let mut inner = inner;
        reader.learn(|scope| scope.set_index(&index, Some(value)));
        // Each expansion has the same errors.
        let is_known = reader.count_of_findings() > before;
        let expanded = reader.again(is_known, || recovery::statements(&mut inner));
        reader.learn(|scope| scope.set_index(&index, None));
        if is_empty {
            continue;
        }
        write_out(tokens, expanded, start, statements)?;
    }
    Ok(())
}

fn index(tokens: &mut Tokens<'_>) -> Outcome<Name> {
    let taken = |it: &str| BUILT_IN.contains(&it) || KEYWORDS.contains(&it) || it == "from";
    match tokens.peek_word() {
        Some(word) if !taken(word) => {}
        _ => return Err(tokens.unexpected("the name of an index", FORM)),
    }
    let index = tokens.word();
    let index = index.ok_or_else(|| tokens.unexpected("the name of an index", FORM))?;
    let known = tokens.reader.known(|scope| scope.whole_number(&index.text));
    if known.is_some() {
        let message = format!("`{}` has a value already", index.text);
        let finding = Diagnostic::error(Code::DuplicateName, index.span, message)
            .label("an index or a constant")
            .help("choose another name for this index");
        return Err(Box::new(finding));
    }
    Ok(index)
}

/// Adds statements to the expanded ones.
///
/// # Errors
/// Returns an error if there are too many statements.
pub(super) fn write_out(
    tokens: &Tokens<'_>,
    own: Vec<Statement>,
    start: Span,
    statements: &mut Vec<Statement>,
) -> Outcome<()> {
    tokens
        .reader
        .learn(|scope| scope.written_out += own.len() + 1);
    check_work(tokens, start)?;
    statements.extend(own);
    Ok(())
}

/// Checks the bound on expanded statements and repetitions.
///
/// # Errors
/// Returns an error if the bound is exceeded.
pub(super) fn check_work(tokens: &Tokens<'_>, start: Span) -> Outcome<()> {
    if tokens.reader.known(|scope| scope.written_out) > MAX_EXPANDED {
        let message = "this writes out more statements than one description may have";
        let finding = Diagnostic::error(Code::TooMuchWork, start, message)
            .label(format!("beyond {MAX_EXPANDED} statements and repetitions"))
            .help("repeat less often");
        return Err(Box::new(finding));
    }
    Ok(())
}
