//! Parses formulas. Operators from weak to strong: `+ -`, `* /`, the sign, `^` (grouped from the right), and brackets.
//!
//! Rust's own expressions are unsuitable: their `^` is weaker than `+`, and their grammar is far wider. A chain of operators of
//! equal precedence becomes one node. Nesting is bounded, so neither this parser nor recursive walks of its tree overflow the
//! stack.

mod choice;
mod components;

pub(super) use components::coordinates;

use proc_macro2::Delimiter;

use super::brackets::too_deep;
use super::formula::{Component, Expression, ExpressionKind, Name, Operation, Reference, Sign};
use super::reader::Outcome;
use super::reference::reference_or_component;
use super::scope::Scope;
use super::tokens::Tokens;
use super::{MAX_DEPTH, indexed, literal};
use crate::diagnostic::{Code, Diagnostic};
use choice::choice;
use components::argument;

/// Help for a missing formula.
const FORMULA: &str =
    "a formula is made of numbers, names, `( )`, `+ - * / ^` and functions such as `sin(t)`";

/// Keywords of programming languages that users may try here.
const CONTROL: [&str; 5] = ["else", "match", "for", "while", "let"];

/// Parses a formula up to the first token that cannot continue it. The caller checks that token.
pub(super) fn expression(tokens: &mut Tokens<'_>) -> Outcome<Expression> {
    sum(tokens, 0)
}

fn sum(tokens: &mut Tokens<'_>, depth: usize) -> Outcome<Expression> {
    let first = product(tokens, depth)?;
    let mut terms = vec![(Sign::Plus, first)];
    loop {
        let sign = if tokens.mark('+').is_some() {
            Sign::Plus
        } else if tokens.peek_mark('-') && tokens.clone().arrow().is_none() {
            tokens.skip();
            Sign::Minus
        } else {
            break;
        };
        terms.push((sign, product(tokens, depth)?));
    }
    Ok(chain(terms, ExpressionKind::Sum))
}

fn product(tokens: &mut Tokens<'_>, depth: usize) -> Outcome<Expression> {
    let first = signed(tokens, depth)?;
    let mut factors = vec![(Operation::Times, first)];
    loop {
        let operation = if let Some(star) = tokens.mark('*') {
            if let Some(second) = tokens.mark('*') {
                let finding = Diagnostic::error(
                    Code::OutsideGrammar,
                    star.to(second),
                    "`**` is not an operation",
                )
                .help("write a power with `^`, as in `x^2`");
                return Err(Box::new(finding));
            }
            Operation::Times
        } else if tokens.mark('/').is_some() {
            Operation::Over
        } else {
            break;
        };
        factors.push((operation, signed(tokens, depth)?));
    }
    Ok(chain(factors, ExpressionKind::Product))
}

/// Returns a chain as one node; a single operand remains itself.
fn chain<T>(
    mut parts: Vec<(T, Expression)>,
    node: fn(Vec<(T, Expression)>) -> ExpressionKind,
) -> Expression {
    if parts.len() == 1
        && let Some((_, only)) = parts.pop()
    {
        return only;
    }
    let span = parts
        .iter()
        .map(|(_, part)| part.span)
        .reduce(|one, other| one.to(other))
        .unwrap_or_default();
    Expression {
        kind: node(parts),
        span,
    }
}

/// Parses `-x` and `+x`, which are weaker than a power.
fn signed(tokens: &mut Tokens<'_>, depth: usize) -> Outcome<Expression> {
    let mut start = None;
    let mut signs = 0;
    let mut negative = Vec::new();
    loop {
        if let Some(minus) = tokens.mark('-') {
            negative.push(minus);
        } else if let Some(plus) = tokens.mark('+') {
            start.get_or_insert(plus);
        } else {
            break;
        }
        signs += 1;
        if depth + signs > MAX_DEPTH {
            return Err(Box::new(too_deep(tokens.previous())));
        }
    }
    let mut result = power(tokens, depth + signs)?;
    while let Some(minus) = negative.pop() {
        let span = minus.to(result.span);
        result = Expression {
            kind: ExpressionKind::Negative(Box::new(result)),
            span,
        };
    }
    if let Some(plus) = start {
        result.span = plus.to(result.span);
    }
    Ok(result)
}

/// Parses `base ^ exponent`; the exponent may have a sign, and includes further powers.
fn power(tokens: &mut Tokens<'_>, depth: usize) -> Outcome<Expression> {
    let base = atom(tokens, depth)?;
    let Some(caret) = tokens.mark('^') else {
        return Ok(base);
    };
    if depth + 1 > MAX_DEPTH {
        return Err(Box::new(too_deep(caret)));
    }
    let exponent = signed(tokens, depth + 1)?;
    let span = base.span.to(exponent.span);
    Ok(Expression {
        kind: ExpressionKind::Power(Box::new(base), Box::new(exponent)),
        span,
    })
}

fn atom(tokens: &mut Tokens<'_>, depth: usize) -> Outcome<Expression> {
    if depth >= MAX_DEPTH {
        return Err(Box::new(too_deep(tokens.next_span())));
    }
    if let Some((mut inner, span)) = tokens.group(Delimiter::Parenthesis) {
        let mut inside = sum(&mut inner, depth + 1)?;
        if inner.peek_mark(',') {
            let finding = Diagnostic::error(
                Code::OutsideGrammar,
                span,
                "expected a scalar, found a pair",
            )
            .label("expected one value")
            .help("write each component in a formula of its own");
            return Err(Box::new(finding));
        }
        if !inner.at_end() {
            return Err(after_expression(&inner, "an operation or `)`", FORMULA));
        }
        inside.span = span;
        return Ok(inside);
    }
    if tokens.peek_number() {
        return number(tokens);
    }
    if tokens.peek_word().is_some() {
        return named(tokens, depth);
    }
    if tokens.peek_group(Delimiter::Bracket) || tokens.peek_group(Delimiter::Brace) {
        let help = "group parts of a formula with `(` and `)`";
        return Err(tokens.unexpected_with_code(Code::OutsideGrammar, "a formula", help));
    }
    let help = if tokens.peek_mark('=') {
        "write a single `=`"
    } else {
        FORMULA
    };
    Err(tokens.unexpected("a formula", help))
}

fn number(tokens: &mut Tokens<'_>) -> Outcome<Expression> {
    let mut ahead = *tokens;
    let Some(written) = ahead.number() else {
        return Err(tokens.unexpected("a number", FORMULA));
    };
    let is_body =
        ahead.peek_mark('.') || written.text.ends_with('.') && ahead.peek_word().is_some();
    if is_body {
        let (point, axis) = reference_or_component(tokens, "a point")?;
        return Ok(named_value(point, axis));
    }
    *tokens = ahead;
    Ok(Expression {
        kind: literal::number(&written)?,
        span: written.span,
    })
}

/// Returns the expression for one, two or three names separated by dots.
fn named_value(reference: Reference, axis: Option<Name>) -> Expression {
    let span = reference.span;
    match axis {
        Some(axis) => Expression {
            span: span.to(axis.span),
            kind: ExpressionKind::Component(Box::new(Component {
                point: reference,
                axis,
            })),
        },
        None => Expression {
            kind: ExpressionKind::Reference(reference),
            span,
        },
    }
}

/// Parses a constant, a point of a body or its component, or a call.
fn named(tokens: &mut Tokens<'_>, depth: usize) -> Outcome<Expression> {
    if tokens.peek_word() == Some("if") {
        return choice(tokens, depth);
    }
    if let Some(word) = tokens.peek_word().filter(|word| CONTROL.contains(word)) {
        let message = format!("`{word}` is not a part of a formula");
        let finding = Diagnostic::error(Code::OutsideGrammar, tokens.next_span(), message)
            .label("not a formula of this language")
            .help("write a choice as `if t < 2s { … } else { … }`; a formula has no loops");
        return Err(Box::new(finding));
    }
    let (reference, axis) = reference_or_component(tokens, "a formula")?;
    if let (None, None) = (&reference.body, &axis)
        && let Some(value) = tokens.reader.mentioned(&reference.name, Scope::index)
    {
        return Ok(indexed::number(value, reference.span));
    }
    // A bracket on the next line starts something else, as a semicolon is missing.
    if axis.is_some() || !tokens.peek_group(Delimiter::Parenthesis) || tokens.at_line_start() {
        return Ok(named_value(reference, axis));
    }
    if let Some(body) = &reference.body {
        let message = format!("`{}` is called like a method", reference.name.text);
        let finding = Diagnostic::error(Code::OutsideGrammar, reference.span, message)
            .help(format!("write `{}({})`", reference.name.text, body.text));
        return Err(Box::new(finding));
    }
    let Some((mut inner, brackets)) = tokens.group(Delimiter::Parenthesis) else {
        return Err(tokens.unexpected("`(`", FORMULA));
    };
    let mut arguments = Vec::new();
    while !inner.at_end() {
        arguments.push(argument(&mut inner, depth + 1)?);
        if inner.mark(',').is_none() && !inner.at_end() {
            return Err(after_expression(
                &inner,
                "an operation, `,` or `)`",
                "values are separated with `,`",
            ));
        }
    }
    let span = reference.span.to(brackets);
    Ok(Expression {
        kind: ExpressionKind::Call {
            function: reference.name,
            arguments,
        },
        span,
    })
}

/// Returns the finding for a token that does not continue a formula. `wanted` lists the permitted tokens, and `help` is the
/// default help.
pub(super) fn after_expression(tokens: &Tokens<'_>, wanted: &str, help: &str) -> Box<Diagnostic> {
    let previous = tokens.reader.written(tokens.previous());
    let value_follows = tokens.peek_word().is_some()
        || tokens.peek_number()
        || tokens.peek_group(Delimiter::Parenthesis);
    if value_follows && !tokens.at_line_start() {
        let after_number = previous.starts_with(|it: char| it.is_ascii_digit());
        let help = match tokens.peek_word().filter(|_| after_number) {
            Some(word) => format!(
                "a product is written `{previous}*{word}`; only a unit follows its number, without a blank"
            ),
            None if wanted.contains(',') => {
                "values are separated with `,`, and a product is written with `*`".to_string()
            }
            None => "a product is written with `*`".to_string(),
        };
        return tokens.unexpected_with_code(Code::OutsideGrammar, wanted, &help);
    }
    if ['=', '<', '>']
        .into_iter()
        .any(|mark| tokens.peek_mark(mark))
    {
        let help = "two values are compared only between `if` and `{`";
        return tokens.unexpected_with_code(Code::OutsideGrammar, wanted, help);
    }
    if tokens.peek_group(Delimiter::Bracket) || tokens.peek_group(Delimiter::Brace) {
        let help = "group parts of a formula with `(` and `)`";
        return tokens.unexpected_with_code(Code::OutsideGrammar, wanted, help);
    }
    tokens.unexpected(wanted, help)
}
