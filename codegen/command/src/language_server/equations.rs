//! *A place of a description → the equations and values that belong to it*, in the words of the generator's own printer.

use linkwright_codegen::Read;
use linkwright_codegen::diagnostic::Span;
use linkwright_codegen::stages::emit::{Notation, text};
use linkwright_codegen::stages::expr::ExprId;
use linkwright_codegen::stages::system::System;

/// So many equations of a statement are shown.
const SHOWN: usize = 12;

/// The equations of the joints and drivers that a statement writes, a line each; those of the first motion that has them.
pub fn of_statement(read: &Read, statement: Span) -> Vec<String> {
    let all = read.motions.iter().map(|system| rows(system, statement));
    all.into_iter()
        .find(|rows| !rows.is_empty())
        .unwrap_or_default()
}

fn rows(system: &System, statement: Span) -> Vec<String> {
    let joints = &system.mechanism.joints;
    let rows = system.rows.iter().chain(&system.monitored);
    let own = rows.filter(|row| joints[row.joint].span == statement);
    own.take(SHOWN)
        .filter_map(|row| {
            let residual = text::readable(system, &row.bodies, Notation::Unicode, row.residual)?;
            Some(format!("{residual} = 0"))
        })
        .collect()
}

/// What a declared value is, in words: a constant, a parameter, an input. Nothing where there is none of the name at the place.
pub fn of_value(read: &Read, name: &str, place: Span) -> Option<String> {
    read.motions.iter().find_map(|it| value(it, name, place))
}

fn value(system: &System, name: &str, place: Span) -> Option<String> {
    let mechanism = &system.mechanism;
    let plain = |expr: ExprId| mechanism.graph.constant_value(expr);
    let is_own = |(own, span): (&str, Span)| own == name && span == place;
    let mut constants = mechanism.constants.iter();
    if let Some(own) = constants.find(|it| is_own((&it.name, it.span))) {
        let unit = own.dimension.unit();
        let formula = text::readable(system, &[], Notation::Unicode, own.value);
        return match (formula, plain(own.value)) {
            (Some(formula), Some(value)) if formula != value.to_string() => {
                Some(format!("= {formula} = {value} {unit}"))
            }
            (_, Some(value)) => Some(format!("= {value} {unit}")),
            (Some(formula), None) => Some(format!("= {formula}, in {unit}")),
            (None, None) => None,
        };
    }
    let mut parameters = mechanism.parameters.iter();
    if let Some(own) = parameters.find(|it| is_own((&it.name, it.span))) {
        let unit = own.dimension.unit();
        return Some(format!("= {} {unit} unless it is set", plain(own.nominal)?));
    }
    let mut inputs = mechanism.inputs.iter();
    let own = inputs.find(|it| is_own((&it.name, it.span)))?;
    let unit = own.dimension.unit();
    Some(format!(
        "= {} {unit}, constant unless it is supplied",
        plain(own.initial)?
    ))
}

/// The coordinates of a body, as the equations call them.
pub fn of_body(read: &Read, name: &str, place: Span) -> Option<Vec<String>> {
    let system = read.motions.first()?;
    let bodies = &system.mechanism.bodies;
    let body = bodies
        .iter()
        .find(|it| it.name == name && it.span == place)?;
    let own = &system.coordinates[body.places()];
    (!own.is_empty()).then(|| own.iter().map(|it| it.name.clone()).collect())
}
