//! `NAME = EXPRESSION` from outside of a description → another value of a parameter, or the motion of an input.
//!
//! The expression is of the description's language, of numbers, units, functions and t; it knows no names of the description.
//! Afterwards the parameter's nominal value, or the input's signal, is the one given. Rows and derivatives are not touched: they
//! hold the parameter or the input by name.

use super::Mechanism;
use super::resolve::Resolver;
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Source, Span, nearest};
use crate::syntax::{self, Constant, Statement};

/// What is put around an assignment so that it is a description.
const BEFORE: &str = "mechanism set { const\n";
const AFTER: &str = "\n;}";

/// Reads one assignment and carries it out.
///
/// # Errors
/// What is wrong with it, rendered; nothing is changed then.
pub fn set(mechanism: &mut Mechanism, assignment: &str) -> Result<(), String> {
    if assignment.contains(';') {
        return Err(FORM.to_string());
    }
    let source = Source::new("--set", format!("{BEFORE}{assignment}{AFTER}"));
    let mut diagnostics = Diagnostics::new();
    let document = syntax::parse(&source, &mut diagnostics);
    let statements = document.map_or(Vec::new(), |document| document.mechanism.statements);
    if !diagnostics.has_errors() {
        match statements.as_slice() {
            [Statement::Constant(written)] => carry_out(mechanism, written, &mut diagnostics),
            _ => return Err(FORM.to_string()),
        }
    }
    if diagnostics.has_errors() {
        return Err(rendered(diagnostics, assignment));
    }
    Ok(())
}

/// How an assignment is written.
const FORM: &str = "error: `--set` takes one assignment, such as `--set L2=0.36m`\n";

/// What is said of a description, and the same of an assignment.
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

/// The findings as they are about the assignment alone.
fn rendered(diagnostics: Diagnostics, assignment: &str) -> String {
    let end = assignment.len();
    let place = |offset: u32| (offset as usize).saturating_sub(BEFORE.len()).min(end);
    let moved = |span: Span| Span::new(place(span.start), place(span.end));
    let mut own = Diagnostics::new();
    for mut finding in diagnostics {
        // What is put around the assignment is nothing to be shown.
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
        own.push(finding);
    }
    own.render(&Source::new("--set", assignment))
}

fn carry_out(mechanism: &mut Mechanism, written: &Constant, diagnostics: &mut Diagnostics) {
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
    let graph = std::mem::take(&mut mechanism.graph);
    let mut resolver = Resolver::new(graph, mechanism.time, mechanism.naming, diagnostics);
    let value = resolver.quantity(&written.value, dimension);
    let graph = resolver.graph;
    mechanism.graph = graph;
    let Some(value) = value else { return };
    if let Some(at) = parameter {
        let own = &mechanism.parameters[at];
        let Some(number) = mechanism.graph.constant_value(value) else {
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
        mechanism.graph.set_nominal(own.symbol, number);
    } else if let Some(at) = input {
        let (graph, time) = (&mut mechanism.graph, mechanism.time);
        let rate = graph.derivative(value, time);
        let acceleration = graph.derivative(rate, time);
        mechanism.inputs[at].signal = [value, rate, acceleration];
    }
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
