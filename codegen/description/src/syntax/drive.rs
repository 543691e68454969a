//! Parses drivers and free coordinates: `drive phi(1) = 2*t;`, `drive lift: K.x = 0.1*t;`, `free swing: phi(1) = 0.2 rate
//! 1.5;`.
//!
//! Any word is accepted as a quantity.

use proc_macro2::Delimiter;

use super::document::{Drive, DrivenForm, Free, Statement};
use super::expression::expression;
use super::formula::{Name, Reference};
use super::reader::Outcome;
use super::reference::{driven_coordinate, identifier, operands};
use super::statement::{equals, semicolon};
use super::tokens::Tokens;
use crate::diagnostic::Span;

/// A driven or free quantity.
struct Driven {
    quantity: Name,
    operands: Vec<Reference>,
    form: DrivenForm,
}

/// Parses a `drive` statement after its first word.
pub(super) fn drive(tokens: &mut Tokens<'_>, docs: Vec<String>, start: Span) -> Outcome<Statement> {
    let name = name(tokens, "the name of a driver")?;
    let help = "a driver is written `drive phi(BODY) = FORMULA;`";
    let Driven {
        quantity,
        operands,
        form,
    } = driven(tokens, "the driven quantity", help)?;
    equals(tokens)?;
    let value = expression(tokens)?;
    let span = start.to(semicolon(tokens, start)?);
    Ok(Statement::Drive(Drive {
        docs,
        name,
        quantity,
        operands,
        form,
        value,
        placed: None,
        span,
    }))
}

/// Parses a `free` statement after its first word.
pub(super) fn free(tokens: &mut Tokens<'_>, docs: Vec<String>, start: Span) -> Outcome<Statement> {
    let help = "a free coordinate is written `free NAME: phi(BODY) = START rate RATE;`";
    let Some(name) = name(tokens, "the name of the free coordinate")? else {
        return Err(tokens.unexpected("a name and `:`", help));
    };
    let Driven {
        quantity,
        operands,
        form,
    } = driven(tokens, "the free quantity", help)?;
    equals(tokens)?;
    let value = expression(tokens)?;
    let rate = match tokens.keyword("rate") {
        Some(_) => Some(expression(tokens)?),
        None => None,
    };
    let span = start.to(semicolon(tokens, start)?);
    Ok(Statement::Free(Free {
        name: name.clone(),
        drive: Drive {
            docs,
            name: Some(name),
            quantity,
            operands,
            form,
            value,
            placed: None,
            span,
        },
        rate,
    }))
}

/// Parses `NAME:`; `None` if no name is written.
fn name(tokens: &mut Tokens<'_>, wanted: &str) -> Outcome<Option<Name>> {
    let mut ahead = *tokens;
    let is_word = ahead.word().is_some();
    ahead.skip_indices();
    match is_word && ahead.peek_mark(':') {
        true => {
            let name = identifier(tokens, wanted)?;
            tokens.mark(':');
            Ok(Some(name))
        }
        false => Ok(None),
    }
}

/// Parses `QUANTITY(OPERANDS)`, `POINT.COORDINATE` or `ANGLE`.
fn driven(tokens: &mut Tokens<'_>, wanted: &str, help: &str) -> Outcome<Driven> {
    if let Some((of, quantity)) = driven_coordinate(tokens)? {
        return Ok(Driven {
            quantity,
            operands: vec![of],
            form: DrivenForm::Dotted,
        });
    }
    let quantity = identifier(tokens, wanted)?;
    if tokens.peek_mark('=') {
        let span = quantity.span;
        let phi = Name {
            text: "phi".to_string(),
            span,
        };
        let angle = Reference {
            body: None,
            name: quantity,
            span,
        };
        return Ok(Driven {
            quantity: phi,
            operands: vec![angle],
            form: DrivenForm::Bare,
        });
    }
    if !tokens.peek_group(Delimiter::Parenthesis) {
        return Err(tokens.unexpected("`(`", help));
    }
    Ok(Driven {
        quantity,
        operands: operands(tokens)?,
        form: DrivenForm::Called,
    })
}
