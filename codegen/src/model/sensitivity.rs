//! `sensitivity` statements → the parameters along which the motion is differentiated.
//!
//! Afterwards each is named once, and nothing that is generated for it is named like anything else. A parameter that nothing
//! depends on is accepted: its sensitivity is zero, and that nothing uses it is a warning of its own.

use super::resolve::Resolver;
use super::{Point, Requested, field_name};
use crate::diagnostic::{Code, Diagnostic, Span, nearest};
use crate::syntax::{Name, Statement};

impl Resolver<'_> {
    /// What all `sensitivity` statements name, in written order; names with an error are reported and left out.
    pub(super) fn sensitivities(
        &mut self,
        statements: &[&Statement],
        points: &[Point],
    ) -> Vec<usize> {
        let mut found: Vec<(usize, Span)> = Vec::new();
        for statement in statements {
            let Statement::Sensitivity(sensitivity) = statement else {
                continue;
            };
            for name in &sensitivity.names {
                let Some(parameter) = self.parameter_named(name) else {
                    continue;
                };
                match found.iter().find(|(other, _)| *other == parameter) {
                    Some(&(_, earlier)) => self.diagnostics.push(
                        Diagnostic::error(
                            Code::DuplicateName,
                            name.span,
                            format!("the sensitivity to `{}` is asked for twice", name.text),
                        )
                        .label("named again here")
                        .also(earlier, "first named here")
                        .help("remove one of them"),
                    ),
                    None => {
                        self.reject_generated_names(name, points);
                        found.push((parameter, name.span));
                    }
                }
            }
        }
        found.into_iter().map(|(parameter, _)| parameter).collect()
    }

    /// The parameter of this name; `None` after an error.
    fn parameter_named(&mut self, name: &Name) -> Option<usize> {
        let named = |parameter: &super::Parameter| parameter.name == name.text;
        if let Some(place) = self.parameters.iter().position(named) {
            return Some(place);
        }
        let text = &name.text;
        let is_input = self.inputs.iter().any(|input| input.name == *text);
        let finding = if is_input {
            let message = format!("`{text}` is an input, no parameter");
            Diagnostic::error(Code::WrongForm, name.span, message)
                .label("changes with time")
                .help("an input drives: how the motion depends on it is a `transmission`")
        } else if self.constants.get(text).is_some() {
            let message = format!("`{text}` is a constant, no parameter");
            Diagnostic::error(Code::WrongForm, name.span, message)
                .label("cannot be changed at run time")
                .help(format!("declare it as a parameter: `param {text} = …;`"))
        } else {
            let message = format!("no parameter is named `{text}`");
            let finding = Diagnostic::error(Code::UnknownName, name.span, message)
                .label("not a parameter of this mechanism");
            let known = self.parameters.iter().map(|it| it.name.as_str());
            match nearest(text, known) {
                Some(meant) => finding.help(format!("did you mean `{meant}`?")),
                None => finding.help(format!("declare it: `param {text} = …;`")),
            }
        };
        self.diagnostics.push(finding);
        None
    }

    /// Functions of a point or a coordinate and a parameter are named after both, so nothing else must have that name.
    fn reject_generated_names(&mut self, parameter: &Name, points: &[Point]) {
        let own = field_name(&parameter.text);
        let coordinates = (1..self.bodies.len())
            .flat_map(|body| (0..3).map(move |axis| Requested::Coordinate { body, axis }));
        let all: Vec<(String, Span)> = (0..points.len())
            .map(|place| (Requested::Point(place), points[place].span))
            .chain(coordinates.map(|quantity| (quantity, parameter.span)))
            .map(|(quantity, span)| (self.generated_name(quantity, points), span))
            .collect();
        let clash = all.iter().find(|(name, _)| {
            let base = name.strip_suffix(&format!("_sensitivity_{own}"));
            base.is_some_and(|base| all.iter().any(|(other, _)| other == base))
        });
        if let Some((name, span)) = clash {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::NameNotAllowed,
                    parameter.span,
                    format!("something else is called `{name}`, as its sensitivity would be"),
                )
                .label("names the sensitivity")
                .also(*span, "the other one")
                .help("give the point or the parameter another name"),
            );
        }
    }
}
