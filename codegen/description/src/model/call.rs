//! Evaluates function calls.
//!
//! Laws of motion and tables have the syntax of functions; their modules evaluate them.

use super::dimension::Dimension;
use super::expression::{Value, listed};
use super::law::LAWS;
use super::resolve::Resolver;
use super::synonyms::{self, meant};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::joint::geometry::{length, subtract};
use crate::syntax::{Expression, ExpressionKind, Name};

/// Functions of the language, for help lines.
pub const FUNCTIONS: &[&str] = &[
    "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sqrt", "exp", "ln", "distance",
];

impl Resolver<'_> {
    /// Evaluates a call. Errors are reported at the name, or at the argument that does not fit.
    pub(super) fn call(
        &mut self,
        function: &Name,
        arguments: &[Expression],
        span: Span,
    ) -> Option<Value> {
        let name = function.text.as_str();
        if let Some(value) = self.kinematic_call(function, arguments, span) {
            return value;
        }
        if LAWS.contains(&name) {
            return self.law(function, arguments, span);
        }
        if let Some((declaration, _)) = self.declared.table_names.found(name) {
            self.note_use(function, declaration);
            return self.look_up(function, arguments, span);
        }
        if !FUNCTIONS.contains(&name) {
            self.report_unknown_function(function);
            return None;
        }
        let count = if matches!(name, "atan2" | "distance") {
            2
        } else {
            1
        };
        if arguments.len() != count {
            self.report_count(name, count, arguments.len(), span);
            return None;
        }
        if name == "distance" {
            return self.distance(arguments);
        }
        let values: Vec<Option<Value>> = arguments
            .iter()
            .map(|argument| self.value(argument))
            .collect();
        let values: Vec<Value> = values.into_iter().collect::<Option<_>>()?;
        let (x, dimension) = values[0];
        match name {
            "sqrt" => {
                let Some(root) = dimension.power(1, 2) else {
                    self.report_argument("`sqrt` cannot take", &arguments[0], dimension);
                    return None;
                };
                return Some((self.graph.sqrt(x), root));
            }
            "atan2" => {
                let (other, other_dimension) = values[1];
                if !dimension.fits(other_dimension) {
                    self.report_argument(
                        &format!("`atan2` of {} cannot take", dimension.name()),
                        &arguments[1],
                        other_dimension,
                    );
                    return None;
                }
                return Some((self.graph.atan2(x, other), Dimension::Angle));
            }
            _ => {}
        }
        self.elementary(name, values[0], &arguments[0])
    }

    /// Reports an unknown function with the known ones.
    fn report_unknown_function(&mut self, function: &Name) {
        let name = function.text.as_str();
        let tables = self
            .declared
            .table_names
            .iter()
            .map(|(table, _)| table.text.as_str());
        let words = FUNCTIONS.iter().chain(LAWS).copied().chain(tables);
        let help = match meant(name, synonyms::FUNCTIONS, words) {
            Some(meant) => format!("did you mean `{meant}`?"),
            None => format!(
                "the functions are {}, and the laws of motion {}",
                listed(FUNCTIONS),
                listed(LAWS)
            ),
        };
        self.diagnostics.push(
            Diagnostic::error(
                Code::UnknownFunction,
                function.span,
                format!("unknown function `{name}`"),
            )
            .label("not a function of this language")
            .help(help),
        );
    }

    /// Reports the number of arguments that a function requires.
    fn report_count(&mut self, name: &str, wanted: usize, given: usize, span: Span) {
        let noun = if wanted == 1 { "argument" } else { "arguments" };
        self.diagnostics.push(
            Diagnostic::error(
                Code::WrongArgumentCount,
                span,
                format!("`{name}` takes {wanted} {noun}, not {given}"),
            )
            .label(format!("{given} given"))
            .help(match name {
                "atan2" => "`atan2(y, x)` is the angle of the vector (x, y)".to_string(),
                "distance" => {
                    "`distance(A, B)` measures two points in the design configuration".to_string()
                }
                _ => format!("write `{name}(…)` with one expression"),
            }),
        );
    }

    /// Evaluates a function of an angle or a number.
    fn elementary(&mut self, name: &str, of: Value, written: &Expression) -> Option<Value> {
        let (x, dimension) = of;
        if !dimension.fits(Dimension::Angle) {
            self.report_argument(&format!("`{name}` cannot take"), written, dimension);
            return None;
        }
        if let ("sin" | "cos", Some([cosine, sine])) = (name, self.live_direction(x)) {
            let value = if name == "sin" { sine } else { cosine };
            return Some((value, Dimension::Number));
        }
        let graph = &mut self.graph;
        Some(match name {
            "sin" => (graph.sin(x), Dimension::Number),
            "cos" => (graph.cos(x), Dimension::Number),
            "tan" => (graph.tan(x), Dimension::Number),
            "asin" => (graph.asin(x), Dimension::Angle),
            "acos" => (graph.acos(x), Dimension::Angle),
            "atan" => (graph.atan(x), Dimension::Angle),
            "exp" => (graph.exp(x), Dimension::Number),
            _ => (graph.ln(x), Dimension::Number),
        })
    }

    /// Evaluates `distance(A, B)`: the distance between two points in the design configuration.
    fn distance(&mut self, arguments: &[Expression]) -> Option<Value> {
        let points: Vec<_> = arguments
            .iter()
            .map(|argument| match &argument.kind {
                ExpressionKind::Reference(reference) => self.drawn_point(reference),
                _ => {
                    self.diagnostics.push(
                        Diagnostic::error(
                            Code::OutsideGrammar,
                            argument.span,
                            "`distance` measures points",
                        )
                        .label("not the name of a point")
                        .help("write `distance(A, B)` or `distance(c1.A, c2.B)`"),
                    );
                    None
                }
            })
            .collect();
        let (from, to) = (points[0]?, points[1]?);
        let gap = subtract(to, from, &mut self.graph);
        Some((length(gap, &mut self.graph), Dimension::LENGTH))
    }
}
