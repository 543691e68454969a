//! Sets a parameter, or the motion of an input, by `NAME = EXPRESSION` from outside a description.
//!
//! The expression may contain numbers, units, functions and t, but no names of the description. It replaces the parameter's
//! nominal value or the input's signal. Rows and derivatives are unchanged, since they contain the parameter or the input as a
//! symbol.

use super::Mechanism;
use super::dimension::Dimension;
use super::ranges::{range_text, value_text};
use super::resolve::Resolver;
use super::table::{Ends, spline};
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Source, Span, nearest};
use crate::pool::Pool;
use crate::syntax::{self, Constant, Statement};
use crate::units::OutputUnits;

/// Number of points of the polynomial that gives the slope at an end of a measured input.
const SLOPE_POINT_COUNT: usize = 4;

/// Text before an assignment that makes it a description.
const BEFORE: &str = "mechanism set { const\n";
const AFTER: &str = "\n;}";

/// Resolves one assignment of an option and applies it.
///
/// # Errors
/// Returns the rendered findings; the mechanism and its values are then unchanged.
pub fn set(
    pool: &mut Pool,
    mechanism: &mut Mechanism,
    option: &str,
    assignment: &str,
) -> Result<(), String> {
    if assignment.contains(';') {
        return Err(form(option));
    }
    if let Some(joined) = joined(mechanism, option, assignment) {
        return Err(joined);
    }
    let source = Source::new(option, format!("{BEFORE}{assignment}{AFTER}"));
    let mut diagnostics = Diagnostics::new();
    let document = syntax::parse(&source, &mut diagnostics);
    let statements = document.map_or(Vec::new(), |document| document.mechanism.statements);
    if !diagnostics.has_errors() {
        match statements.as_slice() {
            [Statement::Constant(written)] => carry_out(pool, mechanism, written, &mut diagnostics),
            _ => return Err(form(option)),
        }
    }
    if diagnostics.has_errors() {
        return Err(rendered(diagnostics, option, assignment));
    }
    Ok(())
}

/// Returns the message with the form of an assignment.
fn form(option: &str) -> String {
    format!("error: `{option}` takes one assignment, such as `{option} L2=0.36m`\n")
}

/// Returns the error for `part.name = …` with a parameter or an input of a part; `None` for other assignments.
fn joined(mechanism: &Mechanism, option: &str, assignment: &str) -> Option<String> {
    let (name, value) = assignment.split_once('=')?;
    let (name, value) = (name.trim(), value.trim());
    let joined = name.replace('.', "_").replace(['[', ']'], "");
    let parameters = mechanism.parameters.iter().map(|own| &own.name);
    let inputs = mechanism.inputs.iter().map(|own| &own.name);
    let is_known = parameters.chain(inputs).any(|own| *own == joined);
    (name.contains('.') && is_known).then(|| {
        format!(
            "error: `{name}` is not the name of a parameter or an input\n  = help: those of a part are joined by `_`: `{option} {joined}={value}`\n"
        )
    })
}

/// Phrases about a description, and their equivalents for an assignment.
const WORDS: &[(&str, &str)] = &[
    ("found `;`", "found the end"),
    ("expected `;`", "expected the end"),
    ("an operation or `;`", "an operation or the end"),
    ("missing `;`", "this does not end here"),
    ("end the statement with `;`", "write one formula behind `=`"),
    (
        "the name of a constant",
        "the name of a parameter or an input",
    ),
    (
        "the mechanism would end here, but more follows",
        "closes nothing",
    ),
];

/// Renders the findings as findings about the assignment alone.
fn rendered(diagnostics: Diagnostics, option: &str, assignment: &str) -> String {
    let end = assignment.len();
    let place = |offset: u32| (offset as usize).saturating_sub(BEFORE.len()).min(end);
    let moved = |span: Span| Span::new(place(span.start), place(span.end));
    let mut findings_of_assignment = Diagnostics::new();
    for mut finding in diagnostics {
        // The text around the assignment must not be shown.
        let is_own =
            |span: Span| (BEFORE.len()..=BEFORE.len() + end).contains(&(span.start as usize));
        finding.secondary.retain(|label| is_own(label.span));
        finding.primary.span = moved(finding.primary.span);
        let texts = [&mut finding.message, &mut finding.primary.text];
        for text in texts.into_iter().chain(&mut finding.help) {
            for (written, meant) in WORDS {
                *text = text.replace(written, meant);
            }
        }
        for label in &mut finding.secondary {
            label.span = moved(label.span);
        }
        findings_of_assignment.push(finding);
    }
    findings_of_assignment.render(&Source::new(option, assignment))
}

fn carry_out(
    pool: &mut Pool,
    mechanism: &mut Mechanism,
    written: &Constant,
    diagnostics: &mut Diagnostics,
) {
    let name = written.name.text.as_str();
    let parameter = mechanism.parameters.iter().position(|own| own.name == name);
    let input = mechanism.inputs.iter().position(|own| own.name == name);
    let dimension = match (parameter, input) {
        (Some(at), _) => mechanism.parameters[at].dimension,
        (_, Some(at)) => mechanism.inputs[at].dimension,
        (None, None) => {
            diagnostics.push(unknown(mechanism, written));
            return;
        }
    };
    let graph = std::mem::take(&mut pool.graph);
    let mut resolver = Resolver::new(graph, mechanism.time, mechanism.naming, diagnostics);
    let value = resolver.quantity(&written.value, dimension);
    let graph = resolver.graph;
    pool.graph = graph;
    let Some(value) = value else { return };
    let units = mechanism.units.of_messages();
    if let Some(at) = parameter {
        let parameter = &mechanism.parameters[at];
        let Some(number) = pool.graph.constant_value(value) else {
            diagnostics.push(
                Diagnostic::error(
                    Code::NotConstant,
                    written.value.span,
                    format!("the parameter `{name}` cannot depend on `t`"),
                )
                .label("changes with time")
                .help("only an input may be a function of time"),
            );
            return;
        };
        if let Some(outside) = outside(written, number, parameter.range, dimension, units) {
            diagnostics.push(outside);
            return;
        }
        pool.graph.set_nominal(parameter.symbol, number);
    } else if let Some(at) = input {
        let (graph, time) = (&mut pool.graph, mechanism.time);
        // A law is checked at every frame.
        let constant = graph.constant_value(value);
        let range = mechanism.inputs[at].range;
        if let Some(outside) =
            constant.and_then(|number| outside(written, number, range, dimension, units))
        {
            diagnostics.push(outside);
            return;
        }
        let rate = graph.derivative(value, time);
        let acceleration = graph.derivative(rate, time);
        mechanism.inputs[at].signal = [value, rate, acceleration];
    }
}

/// Makes an input follow the C² spline through points (t, value), at least two with increasing t. The slope at each end is that
/// of the polynomial through the nearest points, of degree 3 at most. Returns false if a coefficient is not finite.
pub fn follow_points(
    pool: &mut Pool,
    mechanism: &mut Mechanism,
    input: usize,
    points: &[[f64; 2]],
) -> bool {
    let near = points.len().min(SLOPE_POINT_COUNT);
    let last = points.len() - near;
    let slopes = [
        slope_at(&points[..near], 0),
        slope_at(&points[last..], near - 1),
    ];
    let name = &mechanism.inputs[input].name;
    let spline = spline(name, points, Ends::Clamped(slopes));
    if !spline.pieces.iter().flatten().all(|it| it.is_finite()) {
        return false;
    }
    let graph = &mut pool.graph;
    let time = graph.variable(mechanism.time);
    let spline = graph.add_spline(spline);
    mechanism.inputs[input].signal = [0, 1, 2].map(|order| graph.spline(spline, order, time));
    true
}

/// Returns the slope, at one of the points, of the polynomial through all points.
fn slope_at(points: &[[f64; 2]], at: usize) -> f64 {
    let t = points[at][0];
    let others = || (0..points.len()).filter(|it| *it != at);
    let sum_of_inverses: f64 = others().map(|it| 1.0 / (t - points[it][0])).sum();
    let rest = others().map(|it| {
        let [place, value] = points[it];
        let factors = others().filter(|other| *other != it);
        let factors = factors.map(|other| (t - points[other][0]) / (place - points[other][0]));
        value * factors.product::<f64>() / (place - t)
    });
    sum_of_inverses * points[at][1] + rest.sum::<f64>()
}

/// Returns the error for a value outside of its range; `None` for other values.
fn outside(
    written: &Constant,
    value: f64,
    range: Option<[f64; 2]>,
    dimension: Dimension,
    units: &OutputUnits,
) -> Option<Diagnostic> {
    let [low, high] = range.filter(|[low, high]| !(*low..=*high).contains(&value))?;
    let name = &written.name.text;
    let range = range_text([low, high], dimension, units);
    let value = value_text(value, dimension, units);
    let message = format!("{value} is outside of the range of `{name}`");
    let finding = Diagnostic::error(Code::ValueNotAllowed, written.value.span, message)
        .label(format!("`{name}` is {range}"))
        .help("set a value in the range, or extend the range in the description");
    Some(finding)
}

fn unknown(mechanism: &Mechanism, written: &Constant) -> Diagnostic {
    let name = &written.name;
    let parameters = mechanism.parameters.iter().map(|own| own.name.as_str());
    let inputs = mechanism.inputs.iter().map(|own| own.name.as_str());
    let names: Vec<&str> = parameters.chain(inputs).collect();
    let finding = Diagnostic::error(
        Code::UnknownName,
        name.span,
        format!(
            "`{}` has no parameter or input named `{}`",
            mechanism.name, name.text
        ),
    )
    .label("nothing to set");
    match (nearest(&name.text, names.iter().copied()), names.as_slice()) {
        (Some(meant), _) => finding.help(format!("did you mean `{meant}`?")),
        (None, []) => finding.help("declare one in the description: `param L2 = 350mm;`"),
        (None, _) => finding.help(format!("it has {}", super::expression::listed(&names))),
    }
}
