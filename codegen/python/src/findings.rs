//! Converts findings of descriptions to exceptions and warnings.

use linkwright_codegen::{Diagnostic, Source};
use linkwright_solver::Unopened;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Module that defines the exceptions.
const ERRORS: &str = "linkwright._errors";

/// Finding in a description, with its place in the text.
#[derive(Clone, Debug, IntoPyObject)]
pub struct Finding {
    code: &'static str,
    is_error: bool,
    message: String,
    help: Vec<String>,
    /// First line, from 1; 0 without a place.
    line: usize,
    column: usize,
    /// Message with its place and the line of text.
    rendered: String,
}

impl Finding {
    /// Returns a finding about a source.
    pub fn of(found: &Diagnostic, source: &Source) -> Finding {
        let [first, _] = found.range(source);
        Finding {
            code: found.code.name(),
            is_error: found.is_error(),
            message: found.message.clone(),
            help: found.help.clone(),
            line: first.line,
            column: first.column,
            rendered: found.render(source),
        }
    }

    fn without_place(message: String, help: Option<String>) -> Finding {
        let rendered = match &help {
            Some(help) => format!("error: {message}\n  = help: {help}"),
            None => format!("error: {message}"),
        };
        Finding {
            code: "",
            is_error: true,
            message,
            help: help.into_iter().collect(),
            line: 0,
            column: 0,
            rendered,
        }
    }
}

/// Returns the exception for a description that cannot be solved.
pub fn unopened(py: Python<'_>, reason: &Unopened, source: &Source) -> PyErr {
    let findings: Vec<Finding> = match reason.message(&source.name) {
        Ok((message, help)) => vec![Finding::without_place(message, help)],
        Err(findings) => findings.iter().map(|it| Finding::of(it, source)).collect(),
    };
    raised(py, findings)
}

/// Returns the exception for errors of a description.
pub fn raised(py: Python<'_>, findings: Vec<Finding>) -> PyErr {
    let made = py
        .import(ERRORS)
        .and_then(|module| module.getattr("DescriptionError"))
        .and_then(|class| class.call_method1("of", (findings,)));
    match made {
        Ok(error) => PyErr::from_value(error),
        Err(error) => error,
    }
}

/// Returns the exception for a value that cannot be used.
pub fn refused(text: impl Into<String>) -> PyErr {
    let text: String = text.into();
    let text = text
        .strip_prefix("error: ")
        .map(str::to_string)
        .unwrap_or(text);
    PyValueError::new_err(text)
}
