//! Parses statements with their semicolons.
//!
//! Bodies and drivers are in [`super::body`] and [`super::drive`]. Any `word name? ( … )` is a joint: kinds are not checked
//! here.

use proc_macro2::Delimiter;

use super::KEYWORDS;
use super::adjustable::{adjustable, at_tolerance, no_tolerance};
use super::body::body;
use super::curve::curve;
use super::document::{Constant, DrawnPoint, Joint, Points, REQUESTS, Statement};
use super::drive::{drive, free};
use super::equation::equation;
use super::expression::{after_expression, coordinates, expression};
use super::forces::{self, ElementKind, valued};
use super::formula::{Expression, Name};
use super::friction::friction;
use super::indexed;
use super::limit::limit;
use super::motion::motion;
use super::motor::motor;
use super::output::request;
use super::reader::Outcome;
use super::reference::{body_name, direction, identifier, operands, separator};
use super::table::table;
use super::tokens::Tokens;
use super::units::units;
use crate::diagnostic::{Code, Diagnostic, Span, nearest};

/// Parses one statement with its terminator; repetitions are [expanded](super::repeat) elsewhere.
pub(super) fn statement(tokens: &mut Tokens<'_>) -> Outcome<Statement> {
    let docs = tokens.reader.docs(tokens.next_span().start, false);
    let Some(first) = tokens.word() else {
        return Err(tokens.unexpected(
            "a statement",
            "a statement starts with a word, such as `point`, `body` or `revolute`, and ends in `;` or `}`",
        ));
    };
    match first.text.as_str() {
        "const" => {
            let constant = constant(tokens, docs, first.span, "a constant")?;
            let whole = indexed::value(&constant.value, tokens.reader);
            tokens
                .reader
                .learn(|scope| scope.add_constant(&constant.name, whole));
            Ok(Statement::Constant(constant))
        }
        "param" => adjustable(tokens, docs, first.span, true).map(Statement::Parameter),
        "input" => adjustable(tokens, docs, first.span, false).map(Statement::Input),
        "table" => table(tokens, docs, first.span),
        "point" => points(tokens, docs, first.span),
        "body" => body(tokens, docs, first.span).map(Statement::Body),
        "angle" => constant(tokens, docs, first.span, "an angle").map(Statement::Angle),
        "curve" => curve(tokens, docs, first.span),
        "drive" => drive(tokens, docs, first.span),
        "free" => free(tokens, docs, first.span),
        "equation" => equation(tokens, docs, None, first.span),
        "redundant" => redundant(tokens, docs, first.span),
        "mass" => forces::mass(tokens, docs, first.span),
        "gravity" => forces::gravity(tokens, docs, first.span),
        "spring" => forces::element(tokens, docs, ElementKind::Spring, first.span),
        "damper" => forces::element(tokens, docs, ElementKind::Damper, first.span),
        "force" => forces::force(tokens, docs, first.span),
        "torque" => forces::torque(tokens, docs, first.span),
        "measure" => constant(tokens, docs, first.span, "a measure").map(Statement::Measure),
        "clearance" => constant(tokens, docs, first.span, "a clearance").map(Statement::Clearance),
        "limit" => limit(tokens, docs, first.span),
        "friction" => friction(tokens, docs, first.span),
        "motor" => motor(tokens, docs, first.span),
        "units" => units(tokens, docs, first.span),
        "motion" => motion(tokens, docs, first.span),
        word => match REQUESTS.into_iter().find(|it| it.0 == word) {
            Some(row) => request(tokens, docs, row, first.span),
            None => joint(tokens, docs, None, first),
        },
    }
}

/// Parses `NAME = EXPRESSION;` after the first word; `what` names the declaration in messages.
fn constant(
    tokens: &mut Tokens<'_>,
    docs: Vec<String>,
    start: Span,
    what: &str,
) -> Outcome<Constant> {
    let name = identifier(tokens, &format!("the name of {what}"))?;
    equals(tokens)?;
    let value = expression(tokens)?;
    if tokens.peek_word() == Some("from") {
        let message = format!("{what} has no range");
        let finding = Diagnostic::error(Code::UnexpectedToken, tokens.next_span(), message)
            .label("expected `;`")
            .help("write a range behind the value of a `param` or an `input`");
        return Err(Box::new(finding));
    }
    if at_tolerance(tokens) {
        return Err(no_tolerance(tokens, what));
    }
    completed(tokens, docs, start, name, value)
}

/// Parses the end of a declaration.
pub(super) fn completed(
    tokens: &mut Tokens<'_>,
    docs: Vec<String>,
    start: Span,
    name: Name,
    value: Expression,
) -> Outcome<Constant> {
    let span = start.to(semicolon(tokens, start)?);
    if tokens
        .reader
        .known(|scope| scope.index(&name.text).is_some())
    {
        let message = format!("`{}` is the index of a repetition", name.text);
        let finding = Diagnostic::error(Code::DuplicateName, name.span, message);
        return Err(Box::new(finding.help("choose another name")));
    }
    Ok(Constant {
        docs,
        name,
        value,
        span,
    })
}

fn points(tokens: &mut Tokens<'_>, docs: Vec<String>, start: Span) -> Outcome<Statement> {
    let mut points = Vec::new();
    loop {
        let name = identifier(tokens, "the name of a point")?;
        equals(tokens)?;
        let (position, _) = coordinates(tokens, 2)?;
        points.push(DrawnPoint { name, position });
        if tokens.mark(',').is_some() {
            if tokens.peek_mark(';') {
                break;
            }
            continue;
        }
        let mut ahead = *tokens;
        let named = ahead.word().is_some();
        ahead.skip_indices();
        if !tokens.at_statement() && named && ahead.peek_mark('=') {
            // In `A = (1, 2) B = (3, 4)`, the second point is still read.
            let failure = separator(tokens, "`,` or `;`", "points are separated with `,`");
            tokens
                .reader
                .report(*failure, start.start, tokens.previous().end);
            continue;
        }
        break;
    }
    let span = start.to(semicolon(tokens, start)?);
    Ok(Statement::Points(Points { docs, points, span }))
}

/// Parses the joint or equation after the word `redundant`.
fn redundant(tokens: &mut Tokens<'_>, docs: Vec<String>, mark: Span) -> Outcome<Statement> {
    let help = "`redundant` stands before a joint or an equation: `redundant revolute P(1, 2);`";
    match tokens.peek_word() {
        Some(word) if word == "equation" || !KEYWORDS.contains(&word) => {}
        _ => return Err(tokens.unexpected("a joint or an equation", help)),
    }
    let Some(first) = tokens.word() else {
        return Err(tokens.unexpected("a joint or an equation", help));
    };
    if first.text == "equation" {
        equation(tokens, docs, Some(mark), mark)
    } else {
        joint(tokens, docs, Some(mark), first)
    }
}

fn joint(
    tokens: &mut Tokens<'_>,
    docs: Vec<String>,
    redundant: Option<Span>,
    kind: Name,
) -> Outcome<Statement> {
    let mut ahead = *tokens;
    let named = ahead.word().is_some() || ahead.number().is_some();
    ahead.skip_indices();
    if !ahead.peek_group(Delimiter::Parenthesis) {
        return Err(unknown_statement(&kind));
    }
    let name = if named {
        Some(body_name(tokens, "the name of a joint")?)
    } else {
        None
    };
    let start = redundant.unwrap_or(kind.span);
    let operands = operands(tokens)?;
    let along = match tokens.keyword("along") {
        Some(_) => Some(direction(tokens)?),
        None => None,
    };
    let value = match tokens.mark('=') {
        Some(_) => Some(expression(tokens)?),
        None => None,
    };
    if value.is_some() && tokens.peek_word() == Some("along") {
        let finding = Diagnostic::error(
            Code::WrongForm,
            tokens.next_span(),
            "`along` stands behind the value",
        )
        .help("write `along A -> B` before the `=`");
        return Err(Box::new(finding));
    }
    let pressure_angle = valued(tokens, "pressure_angle")?;
    if pressure_angle.is_some() && value.is_none() && tokens.peek_mark('=') {
        let finding = Diagnostic::error(
            Code::WrongForm,
            tokens.next_span(),
            "`pressure_angle` stands behind the value",
        )
        .help("write the ratio first: `= 20/40 pressure_angle 20deg`");
        return Err(Box::new(finding));
    }
    let end = if value.is_some() || pressure_angle.is_some() {
        semicolon(tokens, start)?
    } else {
        semicolon_after_operands(tokens, start)?
    };
    Ok(Statement::Joint(Joint {
        docs,
        redundant,
        kind,
        name,
        operands,
        along,
        value,
        pressure_angle,
        placed: None,
        span: start.to(end),
    }))
}

fn unknown_statement(word: &Name) -> Box<Diagnostic> {
    let message = format!("unknown statement `{}`", word.text);
    let finding = Diagnostic::error(Code::UnknownStatement, word.span, message)
        .label("not a statement of this language");
    let list: Vec<String> = KEYWORDS
        .iter()
        .map(|keyword| format!("`{keyword}`"))
        .collect();
    let note = format!(
        "a statement starts with {}, or is a joint such as `revolute P(a, b);`",
        list.join(", ")
    );
    Box::new(match nearest(&word.text, KEYWORDS) {
        Some(meant) => finding.help(format!("did you mean `{meant}`?")),
        None => finding.help(note),
    })
}

pub(super) fn equals(tokens: &mut Tokens<'_>) -> Outcome<()> {
    tokens
        .mark('=')
        .map(|_| ())
        .ok_or_else(|| tokens.unexpected("`=`", "the value stands behind `=`"))
}

/// Parses the semicolon after a formula. A missing one is reported, and the statement kept if its end is clear.
pub(super) fn semicolon(tokens: &mut Tokens<'_>, start: Span) -> Outcome<Span> {
    missing_semicolon(tokens, start).ok_or_else(|| {
        after_expression(tokens, "an operation or `;`", "end the statement with `;`")
    })
}

/// Parses items separated by commas up to the semicolon; a comma may follow the last one.
pub(super) fn listed<T>(
    tokens: &mut Tokens<'_>,
    item: impl Fn(&mut Tokens<'_>) -> Outcome<T>,
) -> Outcome<Vec<T>> {
    let mut items = vec![item(tokens)?];
    while tokens.mark(',').is_some() && !tokens.peek_mark(';') {
        items.push(item(tokens)?);
    }
    Ok(items)
}

/// Parses the semicolon after a joint without a value.
pub(super) fn semicolon_after_operands(tokens: &mut Tokens<'_>, start: Span) -> Outcome<Span> {
    missing_semicolon(tokens, start)
        .ok_or_else(|| tokens.unexpected("`;`", "end the statement with `;`"))
}

fn missing_semicolon(tokens: &mut Tokens<'_>, start: Span) -> Option<Span> {
    if let Some(semicolon) = tokens.mark(';') {
        return Some(semicolon);
    }
    let keyword = tokens
        .peek_word()
        .is_some_and(|word| KEYWORDS.contains(&word));
    let next_is_word = tokens.at_line_start() && (tokens.at_end() || tokens.peek_word().is_some());
    if !(tokens.at_statement() || keyword || next_is_word) {
        return None;
    }
    let end = tokens.previous().end;
    let finding = Diagnostic::error(
        Code::MissingSemicolon,
        Span { start: end, end },
        "missing `;`",
    )
    .label("expected `;`")
    .help("end the statement with `;`");
    tokens.reader.report(finding, start.start, end);
    Some(tokens.previous())
}
