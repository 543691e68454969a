//! Resolves indexed and qualified names, and evaluates whole-number formulas for indices.
//!
//! `rod[3]` resolves to `rod3`, `link2[3]` to `link2_3`, and `rod` of the part `stage[3]` to `stage3_rod`.

use proc_macro2::Delimiter;

use super::expression::{after_expression, expression};
use super::formula::{Expression, ExpressionKind, Name, Operation, Sign};
use super::reader::{Outcome, Reader};
use super::reference::identifier;
use super::scope::{Scope, inside};
use super::tokens::Tokens;
use crate::diagnostic::{Code, Diagnostic, Span};

/// Elements of a whole-number formula, for help lines.
const WHOLE: &str = "a whole number is made of digits, the indices of `repeat` statements and constants that are whole numbers, with `+ - * /`";

/// Resolves a name with its indices and, for a part, with the names after the dots.
pub(super) fn qualified(tokens: &mut Tokens<'_>, name: Name) -> Outcome<Name> {
    let name = indexed(tokens, name)?;
    let Some(part) = tokens.reader.known(|scope| scope.part(&name.text)) else {
        return Ok(name);
    };
    tokens.reader.learn(|scope| scope.mention(name.span, part));
    if tokens.mark('.').is_none() {
        let written = tokens.reader.spelled(&name.text);
        let message = format!("`{written}` is a part");
        let finding = Diagnostic::error(Code::WrongForm, name.span, message)
            .label("has bodies and points of its own")
            .help(format!("name one of them: `{written}.NAME`"));
        return Err(Box::new(finding));
    }
    let inner = identifier(tokens, "a name of the part")?;
    let called = Name {
        text: inside(&name.text, &inner.text),
        span: name.span.to(inner.span),
    };
    let reader = tokens.reader;
    let spelled = format!(
        "{}.{}",
        reader.spelled(&name.text),
        reader.spelled(&inner.text)
    );
    tokens.reader.spell(&called, spelled)?;
    // The next name may be a part of the part.
    match tokens
        .reader
        .known(|scope| scope.part(&called.text).is_some())
    {
        false => Ok(called),
        true => qualified(tokens, called),
    }
}

/// Resolves a name with its indices.
pub(super) fn indexed(tokens: &mut Tokens<'_>, mut name: Name) -> Outcome<Name> {
    while let Some((mut inner, brackets)) = tokens.group(Delimiter::Bracket) {
        let index = whole_number(&mut inner)?;
        if !inner.at_end() {
            return Err(after_expression(&inner, "an operation or `]`", WHOLE));
        }
        let span = name.span.to(brackets);
        if index < 0 {
            let message = format!("the index of `{}` is {index}", name.text);
            let finding = Diagnostic::error(Code::NameNotAllowed, brackets, message)
                .label("less than 0")
                .help("let the index begin at 0 or above");
            return Err(Box::new(finding));
        }
        let spelled = format!("{}[{index}]", tokens.reader.spelled(&name.text));
        let between = match name.text.ends_with(|it: char| it.is_ascii_digit()) {
            true => "_",
            false => "",
        };
        name = Name {
            text: format!("{}{between}{index}", name.text),
            span,
        };
        tokens.reader.spell(&name, spelled)?;
    }
    Ok(name)
}

/// Parses a formula that is a whole number.
pub(super) fn whole_number(tokens: &mut Tokens<'_>) -> Outcome<i64> {
    let formula = expression(tokens)?;
    value(&formula, tokens.reader).ok_or_else(|| not_whole(formula.span))
}

fn not_whole(span: Span) -> Box<Diagnostic> {
    let message = "this is not known to be a whole number";
    Box::new(Diagnostic::error(Code::NotConstant, span, message).help(WHOLE))
}

/// Evaluates a formula; `None` if it is not a whole number.
pub(super) fn value(formula: &Expression, reader: &Reader<'_>) -> Option<i64> {
    match &formula.kind {
        ExpressionKind::Number { digits, unit: None } => digits.parse().ok(),
        ExpressionKind::Reference(reference) if reference.body.is_none() => {
            reader.mentioned(&reference.name, Scope::whole_number)
        }
        ExpressionKind::Negative(of) => value(of, reader)?.checked_neg(),
        ExpressionKind::Sum(terms) => terms.iter().try_fold(0_i64, |sum, (sign, term)| {
            let term = value(term, reader)?;
            match sign {
                Sign::Plus => sum.checked_add(term),
                Sign::Minus => sum.checked_sub(term),
            }
        }),
        ExpressionKind::Product(factors) => {
            factors
                .iter()
                .try_fold(1_i64, |product, (operation, factor)| {
                    let factor = value(factor, reader)?;
                    match operation {
                        Operation::Times => product.checked_mul(factor),
                        Operation::Over if product.checked_rem(factor) == Some(0) => {
                            product.checked_div(factor)
                        }
                        Operation::Over => None,
                    }
                })
        }
        _ => None,
    }
}

/// Returns the value of an index as a formula.
pub(super) fn number(value: i64, span: Span) -> Expression {
    let digits = Expression {
        kind: ExpressionKind::Number {
            digits: value.unsigned_abs().to_string(),
            unit: None,
        },
        span,
    };
    match value < 0 {
        false => digits,
        true => Expression {
            kind: ExpressionKind::Negative(Box::new(digits)),
            span,
        },
    }
}
