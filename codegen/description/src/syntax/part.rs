//! Expands mechanisms that are parts of another: `part leg[1] = leg(L2 = 41.5mm) at (0, 80mm) turned 10deg;`.
//!
//! The mechanisms above the last one of a file are its parts. For each use, the statements of a part are parsed again. Its
//! names are then [prefixed](super::renamed) and its geometry is [placed](super::placed).

use std::cell::Cell;
use std::collections::{HashMap, HashSet};

use proc_macro2::Delimiter;

use super::document::{Adjustable, Body, Constant, Member, Operands, Statement};
use super::expression::{after_expression, coordinates, expression};
use super::formula::{Expression, Name};
use super::indexed::{indexed, value};
use super::placed::Place;
use super::reader::{Outcome, Reader};
use super::recovery;
use super::reference::{check_word, identifier};
use super::renamed::Renaming;
use super::repeat::{check_work, write_out};
use super::statement::{equals, semicolon};
use super::tokens::Tokens;
use crate::diagnostic::{Code, Diagnostic, Span, nearest};

/// Form of the statement, for help lines.
const FORM: &str = "a part is written `part NAME = MECHANISM(L = 50mm) at (X, Y) turned ANGLE;`, where all but the name and the mechanism is optional";

/// A mechanism that may be used as a part below.
pub(super) struct Part<'a> {
    pub name: Name,
    /// Tokens in the braces.
    inner: Tokens<'a>,
    is_sound: Cell<bool>,
    is_used: Cell<bool>,
}

impl<'a> Part<'a> {
    pub(super) fn new(name: Name, inner: Tokens<'a>) -> Part<'a> {
        Part {
            name,
            inner,
            is_sound: Cell::new(true),
            is_used: Cell::new(false),
        }
    }

    /// Parses the mechanism once for its errors; `above` are the mechanisms above it.
    pub(super) fn check<'b>(&self, above: &'b [Part<'b>])
    where
        'a: 'b,
    {
        let reader = self.inner.reader;
        let before = reader.count_of_findings();
        reader.learn(|scope| scope.enter(HashMap::new()));
        let statements = self.statements(above);
        reader.learn(|scope| scope.leave_unused());
        for statement in &statements {
            if let Some(what) = of_the_whole(statement) {
                let span = statement.span();
                let message = format!("{what} inside a part");
                let finding = Diagnostic::error(Code::UnexpectedToken, span, message)
                    .also(self.name.span, "a mechanism above the last one is a part")
                    .help("move it into the mechanism that the file describes, the last one");
                reader.report(finding, span.start, span.end);
            }
        }
        self.is_sound.set(reader.count_of_findings() == before);
    }

    /// Returns the warning for an unused part; `None` if it is used.
    pub(super) fn idle(&self) -> Option<Diagnostic> {
        let name = &self.name;
        let is_idle = !self.is_used.get() && !name.text.is_empty();
        is_idle.then(|| {
            let message = format!("`{}` is not a part of anything", name.text);
            Diagnostic::warning(Code::UnusedName, name.span, message)
                .label("above the last mechanism")
                .help(format!(
                    "a file describes its last mechanism; write `part NAME = {};` there, or move this one to a file of its own",
                    name.text
                ))
        })
    }

    fn statements<'b>(&self, above: &'b [Part<'b>]) -> Vec<Statement>
    where
        'a: 'b,
    {
        recovery::statements(&mut self.inner.with_parts(above))
    }
}

/// Name of statements without operands of a part.
const WHOLE: &str = "a statement about the whole mechanism";

/// Returns the name of a statement that is allowed only in a whole mechanism; `None` for other statements.
fn of_the_whole(statement: &Statement) -> Option<&'static str> {
    match statement {
        Statement::Motion(_) => Some("a motion"),
        Statement::Gravity(_) => Some("gravity"),
        Statement::Units(_) => Some(WHOLE),
        Statement::Request(it) if it.operands == Operands::None => Some(WHOLE),
        _ => None,
    }
}

/// A use of a part, as written.
struct Used {
    name: Name,
    /// Arguments for its constants and parameters.
    given: Vec<(Name, Expression)>,
    place: Place,
}

/// Parses the statement after its first word, and appends the statements of the part.
pub(super) fn part(
    tokens: &mut Tokens<'_>,
    start: Span,
    statements: &mut Vec<Statement>,
) -> Outcome<()> {
    let (used, definition) = used(tokens, start)?;
    check_work(tokens, start)?;
    let (above, part) = tokens.parts.split_at(definition);
    let Some(part) = part.first() else {
        return Ok(());
    };
    let reader = tokens.reader;
    part.is_used.set(true);
    let whole_numbers: HashMap<String, Option<i64>> = used
        .given
        .iter()
        .map(|(name, argument)| (name.text.clone(), value(argument, reader)))
        .collect();
    reader.learn(|scope| scope.enter(whole_numbers));
    let mut expanded = reader.again(!part.is_sound.get(), || part.statements(above));
    let bodies: Vec<_> = expanded.iter().filter_map(points_of_body).collect();
    reader.learn(|scope| scope.leave(&used.name, bodies.clone()));
    let report = |finding: Box<Diagnostic>| {
        let span = finding.primary.span;
        reader.report(*finding, span.start, span.end);
    };
    check_given(&used, part, &expanded).unwrap_or_else(report);
    let mut renaming = Renaming::new(reader, &used.name.text, bodies, &expanded);
    for statement in &mut expanded {
        let argument = given_for(&used, statement, reader);
        let placed = renaming.statement(statement).and_then(|global| {
            if let Some(argument) = argument {
                replace(statement, argument);
            }
            used.place.take(statement, global)
        });
        placed.unwrap_or_else(report);
    }
    write_out(tokens, expanded, start, statements)
}

/// Parses the statement after its first word; returns the index of the mechanism as well.
fn used(tokens: &mut Tokens<'_>, start: Span) -> Outcome<(Used, usize)> {
    let Some(word) = tokens.word() else {
        return Err(tokens.unexpected("the name of the part", FORM));
    };
    let plain = check_word(word)?;
    let name = indexed(tokens, plain.clone())?;
    if let Some(first) = tokens.reader.known(|scope| scope.part(&name.text)) {
        let written = tokens.reader.spelled(&name.text);
        let message = format!("part `{written}` is declared twice");
        let finding = Diagnostic::error(Code::DuplicateName, name.span, message)
            .also(first, "first declared here")
            .help("give each part a name of its own");
        return Err(Box::new(finding));
    }
    equals(tokens)?;
    let mechanism = identifier(tokens, "the name of a mechanism above")?;
    let known = || tokens.parts.iter().map(|it| it.name.text.as_str());
    let Some(definition) = known().position(|it| it == mechanism.text) else {
        let message = format!("no mechanism above is named `{}`", mechanism.text);
        let finding = Diagnostic::error(Code::UnknownName, mechanism.span, message);
        let help = match (nearest(&mechanism.text, known()), known().next()) {
            (Some(meant), _) => format!("did you mean `{meant}`?"),
            (None, Some(_)) => format!(
                "the mechanisms above are {}",
                known()
                    .map(|it| format!("`{it}`"))
                    .collect::<Vec<_>>()
                    .join(", ")
            ),
            (None, None) => "write the mechanism that is a part above this one".to_string(),
        };
        return Err(Box::new(finding.help(help)));
    };
    let arguments = match tokens.group(Delimiter::Parenthesis) {
        Some((mut inner, _)) => given(&mut inner)?,
        None => Vec::new(),
    };
    let origin = match tokens.keyword("at") {
        Some(_) => Some(coordinates(tokens, 2)?.0),
        None => None,
    };
    let angle = match tokens.keyword("turned") {
        Some(_) => Some(expression(tokens)?),
        None => None,
    };
    let span = start.to(semicolon(tokens, start)?);
    tokens.reader.learn(|scope| {
        let text = plain.text;
        scope.declare_part(
            Name {
                text,
                ..name.clone()
            },
            span,
        );
        scope.mention(mechanism.span, tokens.parts[definition].name.span);
    });
    let used = Used {
        name,
        given: arguments,
        place: Place {
            origin,
            angle,
            span,
        },
    };
    Ok((used, definition))
}

/// Parses arguments: `L = 50mm, n = 3`.
fn given(inner: &mut Tokens<'_>) -> Outcome<Vec<(Name, Expression)>> {
    let mut arguments: Vec<(Name, Expression)> = Vec::new();
    while !inner.at_end() {
        let name = identifier(inner, "the name of a constant or a parameter")?;
        if let Some((first, _)) = arguments.iter().find(|it| it.0.text == name.text) {
            let message = format!("`{}` is given twice", name.text);
            let finding = Diagnostic::error(Code::DuplicateName, name.span, message)
                .also(first.span, "first given here");
            return Err(Box::new(finding.help("keep one of them")));
        }
        equals(inner)?;
        arguments.push((name, expression(inner)?));
        if inner.mark(',').is_none() && !inner.at_end() {
            return Err(after_expression(inner, "an operation, `,` or `)`", FORM));
        }
    }
    Ok(arguments)
}

/// Returns the name of a body and those of its points; `None` for other statements.
fn points_of_body(statement: &Statement) -> Option<(String, HashSet<String>)> {
    let Statement::Body(Body { name, members, .. }) = statement else {
        return None;
    };
    let points = members.iter().map(|it| match it {
        Member::Local { name, .. } | Member::Carried { name, .. } => name.text.clone(),
    });
    Some((name.text.clone(), points.collect()))
}

fn valued(statement: &Statement) -> Option<&Constant> {
    match statement {
        Statement::Constant(constant) => Some(constant),
        Statement::Parameter(parameter) => Some(&parameter.constant),
        _ => None,
    }
}

/// Checks that each argument sets a constant or a parameter of the part.
fn check_given(used: &Used, part: &Part<'_>, own: &[Statement]) -> Outcome<()> {
    let known = || {
        own.iter()
            .filter_map(|it| Some(valued(it)?.name.text.as_str()))
    };
    for (name, _) in &used.given {
        if known().any(|it| it == name.text) {
            continue;
        }
        let message = format!("`{}` has no parameter `{}`", part.name.text, name.text);
        let finding = Diagnostic::error(Code::UnknownName, name.span, message).also(
            part.name.span,
            "its `param` and `const` statements can be given other values",
        );
        let finding = match nearest(&name.text, known()) {
            Some(meant) => finding.help(format!("did you mean `{meant}`?")),
            None => finding.help(format!(
                "declare it in `{}`: `param {} = …;`, or leave it out",
                part.name.text, name.text
            )),
        };
        return Err(Box::new(finding));
    }
    Ok(())
}

fn given_for(used: &Used, statement: &Statement, reader: &Reader<'_>) -> Option<Expression> {
    let name = &valued(statement)?.name;
    let argument = used.given.iter().find(|it| it.0.text == name.text)?;
    reader.learn(|scope| scope.mention(argument.0.span, name.span));
    Some(argument.1.clone())
}

/// Replaces the value of a constant or a parameter, whose range still limits it.
fn replace(statement: &mut Statement, given: Expression) {
    let Some(constant) = valued(statement) else {
        return;
    };
    let constant = Constant {
        value: given,
        ..constant.clone()
    };
    *statement = match statement {
        Statement::Parameter(Adjustable {
            range: Some(range), ..
        }) => Statement::Given(Adjustable {
            constant,
            range: Some(range.clone()),
            tolerance: None,
        }),
        _ => Statement::Constant(constant),
    };
}
