//! Finds the equations and values that belong to a place of a description, as text.

use linkwright_codegen::Read;
use linkwright_codegen::diagnostic::Span;
use linkwright_codegen::stages::emit::{Notation, text};
use linkwright_codegen::stages::expr::ExprId;
use linkwright_codegen::stages::model::{Dimension, range_text};
use linkwright_codegen::stages::system::Derived;
use linkwright_codegen::stages::units::OutputUnits;

/// Largest number of equations of a statement.
const MAX_EQUATIONS: usize = 12;

/// Returns the equations of the joints and drivers of a statement, one per line, from the first motion that has them.
pub fn of_statement(read: &Read, statement: Span) -> Vec<String> {
    let all = read.motions.iter().map(|derived| rows(derived, statement));
    all.into_iter()
        .find(|rows| !rows.is_empty())
        .unwrap_or_default()
}

fn rows(derived: &Derived, statement: Span) -> Vec<String> {
    let Derived { pool, system } = derived;
    let joints = &system.mechanism.joints;
    let rows = system.rows.iter().chain(&system.monitored);
    let of_joint = rows.filter(|row| joints[row.joint].span == statement);
    of_joint
        .take(MAX_EQUATIONS)
        .filter_map(|row| {
            let residual =
                text::readable(pool, system, &row.bodies, Notation::Unicode, row.residual)?;
            Some(format!("{residual} = 0"))
        })
        .collect()
}

/// Describes a constant, a parameter or an input; `None` if none of this name is declared at the place.
pub fn of_value(read: &Read, name: &str, place: Span) -> Option<String> {
    read.motions.iter().find_map(|it| value(it, name, place))
}

fn value(derived: &Derived, name: &str, place: Span) -> Option<String> {
    let Derived { pool, system } = derived;
    let mechanism = &system.mechanism;
    let plain = |expr: ExprId| pool.graph.constant_value(expr);
    let is_own = |(own, span): (&str, Span)| own == name && span == place;
    let mut constants = mechanism.constants.iter();
    if let Some(own) = constants.find(|it| is_own((&it.name, it.span))) {
        let unit = own.dimension.unit();
        let formula = text::readable(pool, system, &[], Notation::Unicode, own.value);
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
        let value = plain(own.nominal)?;
        let range = range(own.range, own.dimension);
        let tolerance = own.tolerance.map_or(String::new(), |it| {
            format!("; {}", it.text(own.dimension, &OutputUnits::default()))
        });
        return Some(format!(
            "= {value} {unit} unless it is set{range}{tolerance}"
        ));
    }
    let mut inputs = mechanism.inputs.iter();
    let input = inputs.find(|it| is_own((&it.name, it.span)))?;
    let unit = input.dimension.unit();
    let value = plain(input.initial)?;
    let range = range(input.range, input.dimension);
    Some(format!(
        "= {value} {unit}, constant unless it is supplied{range}"
    ))
}

/// Describes a range in SI units; empty without one.
fn range(ends: Option<[f64; 2]>, dimension: Dimension) -> String {
    let units = OutputUnits::default();
    ends.map_or(String::new(), |ends| {
        format!("; {}", range_text(ends, dimension, &units))
    })
}

/// Returns the names of a body's coordinates in the equations; `None` if no body of this name is declared at the place.
pub fn of_body(read: &Read, name: &str, place: Span) -> Option<Vec<String>> {
    let system = &read.motions.first()?.system;
    let bodies = &system.mechanism.bodies;
    let body = bodies
        .iter()
        .find(|it| it.name == name && it.span == place)?;
    let coordinates = &system.coordinates[body.places()];
    (!coordinates.is_empty()).then(|| coordinates.iter().map(|it| it.name.clone()).collect())
}
