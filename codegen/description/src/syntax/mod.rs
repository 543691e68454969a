//! Parses source text into a document.
//!
//! ```text
//! text ── scan ──> lexemes ── brackets ──> edits ── repair ──> text for syn ── tokens, statement, … ──> Document
//! ```
//! If tokenizing fails, `syn` gives no details. A scan therefore first finds unreadable characters and unbalanced brackets, and
//! hides them from `syn`. The rest of the file is parsed without them, so all errors of a file are reported at once. `syn`
//! lexes, pairs the brackets and holds the tokens. The grammar is in the submodules, one per kind of node.
//!
//! In a document, every node has its span in the source text, and tokens are as written. Nothing nests deeper than [`MAX_DEPTH`].
//! Names, joint kinds, quantities, functions and units are not resolved.

mod adjustable;
mod body;
mod brackets;
mod curve;
mod document;
mod drive;
mod equation;
mod expression;
mod files;
mod forces;
mod formula;
mod friction;
mod indexed;
mod limit;
mod literal;
mod motion;
mod motor;
mod output;
mod part;
mod placed;
mod reader;
mod recovery;
mod reference;
mod renamed;
mod repair;
mod repeat;
mod scan;
mod scope;
mod statement;
mod statement_shapes;
mod table;
#[cfg(test)]
mod tests;
mod tokens;
mod units;
mod unreadable;

pub use document::*;
pub use files::named_files;
pub(crate) use files::{is_relative, leaves_folder};
pub use forces::{Center, Element, ElementKind, Force, Gravity, Mass, Torque};
pub use formula::*;
pub use friction::Friction;
pub use limit::Limit;
pub use motor::Motor;
pub use output::LEVELS;
pub(crate) use scan::block_comment_length;
pub use scan::{Comment, Kind, Lexeme, lexemes, lexemes_and_comments};
pub use scope::{Expanded, ExpandedSort, Expansion, Spellings};

use std::sync::Arc;

use proc_macro2::Delimiter;
use syn::buffer::TokenBuffer;

use self::part::Part;
use self::reader::Reader;
use self::tokens::Tokens;
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Source, Span, nearest};

/// Maximum nesting of brackets, signs, powers and calls.
pub const MAX_DEPTH: usize = 128;

/// Words that start a statement. A statement that starts with any other word is a joint.
pub const KEYWORDS: [&str; 37] = [
    "const",
    "param",
    "input",
    "table",
    "point",
    "body",
    "angle",
    "curve",
    "drive",
    "free",
    "equation",
    "redundant",
    "output",
    "transmission",
    "sensitivity",
    "monitor",
    "unguarded",
    "mass",
    "gravity",
    "spring",
    "damper",
    "force",
    "torque",
    "effort",
    "reaction",
    "reactions",
    "least_norm",
    "energy",
    "measure",
    "limit",
    "clearance",
    "friction",
    "motor",
    "units",
    "motion",
    "repeat",
    "part",
];

/// Predefined names in formulas.
pub const BUILT_IN: &[&str] = &["t", "pi"];

/// Coordinates of a body in `output` and in equations.
pub const AXES: [&str; 3] = ["x", "y", "phi"];

/// Words within statements; each is special only in its position.
pub const CLAUSES: [&str; 25] = [
    "at",
    "turned",
    "facing",
    "along",
    "about",
    "in",
    "on",
    "free",
    "preload",
    "inertia",
    "gear",
    "efficiency",
    "radius",
    "over",
    "from",
    "to",
    "tolerance",
    "sigma",
    "rate",
    "columns",
    "polar",
    "if",
    "else",
    "pressure_angle",
    "stop",
];

/// Parses a description. Never panics and never overflows the stack, whatever the text.
///
/// Returns the readable statements even if there are errors in `diagnostics`; `None` if the text contains no mechanism.
pub fn parse(source: &Source, diagnostics: &mut Diagnostics) -> Option<Document> {
    let text = source.text.as_str();
    if text.len() > Source::MAX_BYTES {
        let message = format!("the file is larger than {} MiB", Source::MAX_BYTES >> 20);
        diagnostics.push(
            Diagnostic::error(Code::UnreadableFile, Span::empty(0), message)
                .label(format!("it begins here and has {} bytes", text.len()))
                .help("a description is written by hand and far smaller: is this another file?"),
        );
        return None;
    }
    let mut scan = scan::scan(text);
    let starts = brackets::balance(text, &mut scan);
    scan.damage.sort_unstable();
    diagnostics.extend(scan.findings);
    let repaired = repair::repair(text, scan.edits);
    let stream = match repaired.text.parse::<proc_macro2::TokenStream>() {
        Ok(stream) => stream,
        Err(error) => {
            let span = repaired.span(error.span().byte_range());
            diagnostics.push(
                Diagnostic::error(Code::UnreadableCharacter, span, "unreadable text")
                    .help("write it as `mechanisms/README.md` describes, or remove it"),
            );
            return None;
        }
    };
    let buffer = TokenBuffer::new2(stream);
    let reader = Reader::new(text, &repaired, &starts, &scan.documentation, &scan.damage);
    let mut idle_parts = Vec::new();
    let document = file(Tokens::all(&reader, buffer.begin()), &mut idle_parts);
    let idle = reader.idle_documentation();
    let (findings, spellings, expansion) = reader.into_parts();
    diagnostics.extend(findings);
    let document = document.map(|document| Document {
        attachments: source.attachments.clone(),
        units: source.units.clone(),
        spellings: Arc::new(spellings),
        expansion,
        ..document
    });
    // After errors, documentation of a malformed statement would be reported as misplaced.
    if !diagnostics.has_errors() {
        diagnostics.extend(idle_parts);
        diagnostics.extend(idle.into_iter().map(|span| {
            Diagnostic::warning(
                Code::UnexpectedToken,
                span,
                "this comment documents nothing",
            )
            .help("write `//` for a comment that is not documentation")
        }));
    }
    document
}

/// Parses `mechanism NAME { … }`, preceded only by mechanisms that are its parts; `None` if there is none.
fn file(mut tokens: Tokens<'_>, idle: &mut Vec<Diagnostic>) -> Option<Document> {
    let reader = tokens.reader;
    let mut start = tokens.next_span();
    if tokens.at_end() {
        // Inner documentation alone describes nothing.
        let finding = Diagnostic::error(
            Code::EmptyFile,
            Span::empty(0),
            "the file describes no mechanism",
        )
        .help("write `mechanism NAME { … }`");
        reader.report(finding, 0, start.end);
        return None;
    }
    let file_docs = reader.docs(start.start, true);
    let mut docs = reader.docs(start.start, false);
    let mut above: Vec<Part<'_>> = Vec::new();
    let name = loop {
        let name = opening(&mut tokens);
        let mut ahead = tokens;
        match (&name, ahead.group(Delimiter::Brace)) {
            (Some(name), Some((inner, _))) if ahead.peek_word() == Some("mechanism") => {
                // This mechanism is a part of the next one; its documentation is consumed with it.
                reader.docs(inner.next_span().start, true);
                let head = start.to(name.span);
                reader.learn(|scope| scope.declare(ExpandedSort::Mechanism, name.clone(), head));
                above.push(Part::new(name.clone(), inner));
                start = ahead.next_span();
                docs = reader.docs(start.start, false);
                tokens = ahead;
            }
            _ => break name,
        }
    };
    for (number, part) in above.iter().enumerate() {
        part.check(&above[..number]);
    }
    let mut tokens = tokens.with_parts(&above);
    let Some(name) = name else {
        // Statements without a mechanism around them are read for their errors; other text is not.
        if tokens.at_statement() {
            recovery::statements(&mut tokens);
        }
        return None;
    };
    let (statements, span) = match tokens.group(Delimiter::Brace) {
        Some((mut inner, braces)) => {
            docs.extend(reader.docs(inner.next_span().start, true));
            let statements = recovery::statements(&mut inner);
            (statements, start.to(braces))
        }
        // The file ends instead of the name, which is already reported.
        None if tokens.at_end() && name.text.is_empty() => return None,
        None => {
            let finding = tokens.unexpected("`{`", "a file is `mechanism NAME { … }`");
            reader.report(*finding, start.start, tokens.next_span().end);
            let statements = recovery::statements(&mut tokens);
            (statements, start.to(tokens.previous()))
        }
    };
    if !tokens.at_end() && !reader.is_full() {
        let next = tokens.next_span();
        let finding = Diagnostic::error(Code::UnexpectedToken, next, "text after the mechanism")
            .label("expected the end of the file")
            .help("statements stand inside the braces of the mechanism");
        reader.report(finding, next.start, reader.end_of_text().end);
    }
    idle.extend(above.iter().filter_map(Part::idle));
    let mechanism = MechanismItem {
        docs,
        name,
        statements,
        span,
    };
    Some(Document {
        docs: file_docs,
        attachments: Vec::new(),
        units: None,
        mechanism,
        spellings: Arc::default(),
        expansion: Expansion::default(),
    })
}

/// Parses `mechanism NAME` and reports its errors.
fn opening(tokens: &mut Tokens<'_>) -> Option<Name> {
    let (reader, start) = (tokens.reader, tokens.next_span());
    if tokens.keyword("mechanism").is_none() {
        let mut ahead = *tokens;
        let finding = match ahead.word() {
            Some(word) if nearest(&word.text, ["mechanism"]).is_some() => {
                let message = format!("unknown word `{}`", word.text);
                tokens.skip();
                Diagnostic::error(Code::UnknownStatement, word.span, message)
                    .help("did you mean `mechanism`?")
            }
            _ => *tokens.unexpected(
                "`mechanism`",
                "a file is `mechanism NAME { … }`, with the statements inside the braces",
            ),
        };
        reader.report(finding, start.start, start.end);
        if tokens.next_span() == start {
            return None;
        }
    }
    match reference::identifier(tokens, "the name of the mechanism") {
        Ok(name) => Some(name),
        Err(failure) => {
            reader.report(*failure, start.start, tokens.next_span().end);
            if tokens.peek_number() {
                tokens.skip();
            }
            // The statements are read for their errors; the missing name stops the pipeline after this stage.
            Some(Name {
                text: String::new(),
                span: Span {
                    start: start.end,
                    end: start.end,
                },
            })
        }
    }
}
