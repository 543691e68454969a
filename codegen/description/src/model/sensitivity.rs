//! Resolves `sensitivity` statements into the parameters with respect to which the motion is differentiated.
//!
//! Each parameter is listed once, and generated names are unique. A parameter without influence is accepted: its sensitivity is
//! zero, and a separate warning says that it is unused.

use std::collections::{HashMap, HashSet};

use super::resolve::Resolver;
use super::{Point, Requested, field_name};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::syntax::{Name, RequestKind, Statement};

/// Infix of the names of sensitivities, between quantity and parameter.
const BETWEEN: &str = "_sensitivity_";

/// For a parameter, the name that equals a generated sensitivity, with its location; never iterated.
type Taken = HashMap<String, (String, Option<Span>)>;

impl Resolver<'_> {
    /// Resolves all `sensitivity` statements in source order; names with an error are reported and omitted.
    pub(super) fn sensitivities(
        &mut self,
        statements: &[&Statement],
        points: &[Point],
    ) -> Vec<usize> {
        let mut indices: Vec<usize> = Vec::new();
        let mut spans: HashMap<usize, Span> = HashMap::new();
        let mut taken: Option<Taken> = None;
        let parameters = self.declared.parameters.iter().enumerate();
        let places: HashMap<String, usize> = parameters
            .map(|(place, own)| (own.name.clone(), place))
            .collect();
        for statement in statements {
            let Some(sensitivity) = statement.request(RequestKind::Sensitivity) else {
                continue;
            };
            for name in &sensitivity.names {
                let Some(parameter) = self.parameter_named(name, &places) else {
                    continue;
                };
                match spans.get(&parameter) {
                    Some(&earlier) => self.diagnostics.push(
                        Diagnostic::error(
                            Code::DuplicateName,
                            name.span,
                            format!("the sensitivity to `{}` is requested twice", name.text),
                        )
                        .label("named again here")
                        .also(earlier, "first named here")
                        .help("remove one of them"),
                    ),
                    None => {
                        let taken = taken.get_or_insert_with(|| self.taken_names(points));
                        self.reject_generated_names(name, taken);
                        spans.insert(parameter, name.span);
                        indices.push(parameter);
                    }
                }
            }
        }
        indices
    }

    /// Returns the parameter of this name; `None` after an error.
    fn parameter_named(&mut self, name: &Name, places: &HashMap<String, usize>) -> Option<usize> {
        if let Some((declaration, _)) = self.declared.constants.found(&name.text) {
            self.note_use(name, declaration);
        }
        if let Some(&place) = places.get(&name.text) {
            return Some(place);
        }
        let text = &name.text;
        let is_input = self.declared.inputs.iter().any(|input| input.name == *text);
        let finding = if is_input {
            let message = format!("`{text}` is an input, not a parameter");
            Diagnostic::error(Code::WrongForm, name.span, message)
                .label("changes with time")
                .help("request a `transmission` for the dependence of the motion on an input")
        } else if self.declared.constants.get(text).is_some() {
            let message = format!("`{text}` is a constant, not a parameter");
            Diagnostic::error(Code::WrongForm, name.span, message)
                .label("cannot be changed at run time")
                .help(format!("declare it as a parameter: `param {text} = …;`"))
        } else {
            let message = format!("no parameter is named `{text}`");
            let finding = Diagnostic::error(Code::UnknownName, name.span, message)
                .label("not a parameter of this mechanism");
            let known = self.declared.parameters.iter().map(|it| it.name.as_str());
            match self.declared.nearest_known(text, known) {
                Some(meant) => finding.help(format!("did you mean `{meant}`?")),
                None => finding.help(format!("declare it: `param {text} = …;`")),
            }
        };
        self.diagnostics.push(finding);
        None
    }

    /// Returns the names of points and coordinates that look like a sensitivity of another quantity.
    fn taken_names(&self, points: &[Point]) -> Taken {
        let coordinates = self.linkage.bodies.iter().flat_map(|body| body.places());
        let coordinates = coordinates.map(Requested::Coordinate);
        let all: Vec<(String, Option<Span>)> = (0..points.len())
            .map(|place| (Requested::Point(place), Some(points[place].span)))
            .chain(coordinates.map(|quantity| (quantity, None)))
            .map(|(quantity, span)| (self.generated_name(quantity, points), span))
            .collect();
        let known: HashSet<&str> = all.iter().map(|(name, _)| name.as_str()).collect();
        let mut taken = Taken::new();
        for (name, span) in &all {
            for (end, between) in name.match_indices(BETWEEN) {
                if known.contains(&name[..end]) {
                    let parameter = name[end + between.len()..].to_string();
                    taken.entry(parameter).or_insert((name.clone(), *span));
                }
            }
        }
        taken
    }

    /// Reports names that equal a generated one, which consists of a point or a coordinate and a parameter.
    fn reject_generated_names(&mut self, parameter: &Name, taken: &Taken) {
        if let Some((name, span)) = taken.get(&field_name(&parameter.text)) {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::NameNotAllowed,
                    parameter.span,
                    format!("something else is called `{name}`, as its sensitivity would be"),
                )
                .label("names the sensitivity")
                .also(span.unwrap_or(parameter.span), "the other one")
                .help("give the point or the parameter another name"),
            );
        }
    }
}
