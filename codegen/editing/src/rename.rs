//! Renames an object in all its mentions.
//!
//! The generator reads the changed text and decides if the new name is available. Afterwards every name means the same object as before.

use linkwright_codegen::diagnostic::{Code, Diagnostic, Diagnostics, Severity, Source, Span};
use linkwright_codegen::read;
use linkwright_codegen::stages::syntax::{Kind, Lexeme, lexemes, parse};

use crate::description::Description;
use crate::edit::Edit;
use crate::names::{Mention, Names, SymbolId};

/// Returns the place of the name at an offset, and the name.
///
/// # Errors
/// No name at the offset can be changed, or the text has errors; the message is for the user.
pub fn renamable(description: &Description, offset: usize) -> Result<(Span, &str), String> {
    let mention = mention(description, offset)?;
    let name = &description.names.symbols[mention.symbol].name;
    Ok((mention.span, name))
}

fn mention(description: &Description, offset: usize) -> Result<Mention, String> {
    // In a statement with errors, a mention would be missed.
    if !description.is_whole {
        let mut diagnostics = Diagnostics::new();
        let _ = parse(&description.source, &mut diagnostics);
        let first = errors(diagnostics).into_iter().next();
        let why = first.map_or(String::new(), |it| format!(": {}", it.words()));
        return Err(format!(
            "the description has an error, correct it first{why}"
        ));
    }
    description
        .names
        .mention_at(offset)
        .ok_or_else(|| "expected a name that the description declares".to_string())
}

/// Returns the edits that change the name at an offset everywhere. The text has no errors if `is_sound`; otherwise they are searched.
///
/// # Errors
/// The new name is not available; the message is that of a diagnostic.
pub fn rename(
    description: &Description,
    is_sound: bool,
    offset: usize,
    new: &str,
) -> Result<Vec<Edit>, String> {
    let mention = mention(description, offset)?;
    let names = &description.names;
    let places = names.mentions_of(mention.symbol);
    let source = &description.source;
    let renamed = Source {
        text: replaced(&source.text, &places, new),
        ..source.clone()
    };
    let before = match is_sound {
        true => Vec::new(),
        false => errors(findings(source)),
    };
    if let Some(finding) = hidden(description, &places, &before) {
        return Err(format!(
            "a statement with an error may use this name, correct it first: {}",
            finding.words()
        ));
    }
    let after = errors(findings(&renamed));
    let mut known: Vec<(Code, String)> = before.iter().map(sentence).collect();
    let is_new = |it: &&Diagnostic| match known.iter().position(|old| *old == sentence(it)) {
        Some(place) => {
            known.swap_remove(place);
            false
        }
        None => true,
    };
    if let Some(finding) = after.iter().find(is_new) {
        return Err(finding.words());
    }
    if !is_one_name(new) {
        return Err(format!("`{new}` is not a name"));
    }
    let meant = Description::of(renamed);
    if let Some(other) = other_meaning(names, &meant.names) {
        return Err(match other {
            Some(symbol) => format!(
                "`{new}` is already the name of a {}",
                names.symbols[symbol].sort.noun()
            ),
            None => format!("`{new}` already has a meaning there; choose another name"),
        });
    }
    let edits = places.iter().map(|&span| Edit {
        span,
        text: new.to_string(),
    });
    Ok(edits.collect())
}

/// Returns the error of a statement that may use the name at these places without a mention: the generator resolves a statement only up
/// to its error. `None` if there is none.
fn hidden<'a>(
    description: &Description,
    places: &[Span],
    errors: &'a [Diagnostic],
) -> Option<&'a Diagnostic> {
    let text = &description.source.text;
    let name = &text[places.first()?.range()];
    let is_hidden = |lexeme: &&Lexeme| {
        let span = Span::new(lexeme.start, lexeme.end);
        description.written(**lexeme) == name && !places.contains(&span)
    };
    let hidden: Vec<&Lexeme> = description.lexemes.iter().filter(is_hidden).collect();
    // Of a text with too many errors, the last statements are not resolved.
    let is_cut = errors.len() >= Diagnostics::MAX_FINDINGS
        || errors.iter().any(|it| it.code == Code::TooMuchWork);
    errors.iter().find(|error| {
        let around = description.statement_around(error.primary.span);
        let has = |it: &&Lexeme| around.is_some_and(|span| span.range().contains(&it.start));
        hidden.iter().any(|it| is_cut || has(it))
    })
}

/// Returns the text with `by` at these places.
fn replaced(text: &str, places: &[Span], by: &str) -> String {
    let mut renamed = text.to_string();
    for place in places.iter().rev() {
        renamed.replace_range(place.range(), by);
    }
    renamed
}

fn findings(source: &Source) -> Diagnostics {
    match read(source) {
        Ok(read) => read.warnings,
        Err(found) => found,
    }
}

fn errors(found: Diagnostics) -> Vec<Diagnostic> {
    let errors = found
        .into_iter()
        .filter(|it| it.severity == Severity::Error);
    errors.collect()
}

/// Returns the message of a finding without its place.
fn sentence(finding: &Diagnostic) -> (Code, String) {
    let outside = finding.message.split('`').step_by(2);
    (finding.code, outside.collect())
}

/// True if a text is one identifier or one integer.
fn is_one_name(text: &str) -> bool {
    let [only] = lexemes(text)[..] else {
        return false;
    };
    let is_name = only.kind == Kind::Word || text.bytes().all(|it| it.is_ascii_digit());
    is_name && (only.start, only.end) == (0, text.len())
}

/// Finds a name that means something else after a change: outer `None` if there is none, inner `None` if its meaning is unknown.
fn other_meaning(before: &Names, after: &Names) -> Option<Option<SymbolId>> {
    let mut pairs = before.mentions.iter().zip(&after.mentions);
    let same = |one: &Mention, other: &Mention| before.are_same(one.symbol, other.symbol);
    if let Some((_, other)) = pairs.find(|(one, other)| {
        one.symbol >= after.symbols.len()
            || other.symbol >= before.symbols.len()
            || !same(one, other)
    }) {
        return Some((other.symbol < before.symbols.len()).then_some(other.symbol));
    }
    let count = |names: &Names| (names.mentions.len(), names.symbols.len());
    (count(before) != count(after)).then_some(None)
}
