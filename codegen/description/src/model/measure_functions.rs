//! Resolves the functions of measures: rates, vectors and their magnitudes, relative angles, and forces.

use super::dimension::Dimension;
use super::expression::Value;
use super::resolve::Resolver;
use super::{ForceTerm, ReactionPart, Role};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::expr::ExprId;
use crate::joint::Feature;
use crate::syntax::{Expression, ExpressionKind, Name};

/// Functions that only measures contain.
pub const MEASURE_FUNCTIONS: &[&str] = &[
    "rate",
    "speed",
    "position",
    "velocity",
    "acceleration",
    "magnitude",
    "relative_angle",
    "transmission_angle",
    "reaction",
    "moment",
    "effort",
    "power",
    "length",
    "tension",
    "energy",
    "kinetic_energy",
    "potential_energy",
    "reduced_mass",
];

/// Functions whose value is a vector.
const VECTORS: [&str; 4] = ["position", "velocity", "acceleration", "reaction"];

/// Components along the global axes, with their dimension.
type Components = ([ExprId; 2], Dimension);

impl Resolver<'_> {
    /// Resolves a call that has a particular meaning in measures; `None` for any other call, and outside measures.
    pub(super) fn measure_call(
        &mut self,
        function: &Name,
        arguments: &[Expression],
        span: Span,
    ) -> Option<Option<Value>> {
        self.formulas.kinematic.as_mut()?.measure()?;
        let name = function.text.as_str();
        let is_component = matches!(name, "x" | "y") && arguments.first().is_some_and(is_vector);
        if !is_component && !MEASURE_FUNCTIONS.contains(&name) {
            return None;
        }
        let count = match name {
            "relative_angle" => 2,
            "transmission_angle" => 3,
            "kinetic_energy" | "potential_energy" => 0,
            _ => 1,
        };
        if arguments.len() != count {
            self.report_measure_count(name, count, arguments.len(), span);
            return Some(None);
        }
        let Some(argument) = arguments.first() else {
            return Some(self.energy_of_all(name));
        };
        Some(match name {
            "x" => self.vector(argument).map(|([x, _], unit)| (x, unit)),
            "y" => self.vector(argument).map(|([_, y], unit)| (y, unit)),
            "rate" => self.rate_of(argument),
            "speed" => self.speed(function, argument),
            "magnitude" => self.magnitude(argument),
            "relative_angle" => self.angle_between(function, arguments),
            "transmission_angle" => self.transmission_angle(function, arguments),
            "moment" => self.moment_of_reaction(argument),
            "effort" | "power" => self.effort_of(function, argument),
            "reduced_mass" => self.reduced_mass(argument, span),
            "length" | "tension" | "energy" => self.quantity_of_element(function, argument),
            _ => {
                self.report_vector(function, span);
                None
            }
        })
    }

    fn rate_of(&mut self, argument: &Expression) -> Option<Value> {
        let value = self.value(argument)?;
        self.rate_in_measure(value, argument.span)
    }

    /// Resolves the magnitude of a velocity.
    fn speed(&mut self, function: &Name, argument: &Expression) -> Option<Value> {
        let (components, dimension) = self.rates_of_point(function, argument, 1)?;
        let name = self.name_of_vector("speed", argument);
        let length = self.length_in_measure(name, components.to_vec())?;
        Some((length, dimension))
    }

    /// Returns the stem of names for a vector: `speed_k`, `reaction_p`.
    fn name_of_vector(&self, word: &str, argument: &Expression) -> String {
        match &argument.kind {
            ExpressionKind::Reference(reference) => {
                format!("{word}_{}", reference.name.text.to_lowercase())
            }
            _ => word.to_string(),
        }
    }

    fn magnitude(&mut self, argument: &Expression) -> Option<Value> {
        if !is_vector(argument) {
            let (value, dimension) = self.value(argument)?;
            return Some((self.graph.magnitude(value), dimension));
        }
        let (components, dimension) = self.vector(argument)?;
        let name = match &argument.kind {
            ExpressionKind::Call {
                function,
                arguments,
            } => {
                let word = match function.text.as_str() {
                    "velocity" => "speed",
                    other => other,
                };
                self.name_of_vector(word, &arguments[0])
            }
            _ => String::new(),
        };
        let length = self.length_in_measure(name, components.to_vec())?;
        Some((length, dimension))
    }

    /// Resolves `position(K)`, `velocity(K)`, `acceleration(K)` or `reaction(P)`; reports an error for others.
    fn vector(&mut self, written: &Expression) -> Option<Components> {
        let ExpressionKind::Call {
            function,
            arguments,
        } = &written.kind
        else {
            return None;
        };
        let [argument] = arguments.as_slice() else {
            self.report_measure_count(&function.text, 1, arguments.len(), written.span);
            return None;
        };
        match function.text.as_str() {
            "position" => self.rates_of_point(function, argument, 0),
            "velocity" => self.rates_of_point(function, argument, 1),
            "acceleration" => self.rates_of_point(function, argument, 2),
            _ => {
                let joint = self.joint_in_measure(argument, true)?;
                let parts = [ReactionPart::X, ReactionPart::Y];
                let [x, y] = parts.map(|part| {
                    let force = ForceTerm::Reaction(joint, part);
                    self.force_in_measure(force, Dimension::FORCE)
                });
                Some(([x?.0, y?.0], Dimension::FORCE))
            }
        }
    }

    /// Returns the position of a point, differentiated `order` times.
    fn rates_of_point(
        &mut self,
        function: &Name,
        argument: &Expression,
        order: usize,
    ) -> Option<Components> {
        let reference = self.written_place(function, argument)?;
        let mark = self.live_point(&reference)?;
        let position = self.live_position(mark);
        let mut values = position.map(|it| Some((it, Dimension::LENGTH)));
        for _ in 0..order {
            values = values.map(|it| self.rate_in_measure(it?, argument.span));
        }
        let [(x, dimension), (y, _)] = [values[0]?, values[1]?];
        Some(([x, y], dimension))
    }

    fn moment_of_reaction(&mut self, argument: &Expression) -> Option<Value> {
        let joint = self.joint_in_measure(argument, false)?;
        let moment = ForceTerm::Reaction(joint, ReactionPart::Moment);
        self.force_in_measure(moment, Dimension::TORQUE)
    }

    /// Returns the joint of this name with a force or a moment; `None` after an error.
    fn joint_in_measure(&mut self, argument: &Expression, with_force: bool) -> Option<usize> {
        let name = self.name_in_measure(argument, "a joint")?;
        let joints = self.linkage.joints.iter().enumerate();
        let named = joints.filter(|(_, (joint, _))| {
            joint.role == Role::Constraint && joint.name.as_deref() == Some(&name.text)
        });
        let named: Vec<usize> = named.map(|(place, _)| place).collect();
        let place = match named[..] {
            [only] => only,
            [] => {
                let constraints: Vec<usize> = self.constraint_places();
                self.report_unknown_joint(&name, &constraints);
                return None;
            }
            [first, second, ..] => {
                let spans = [first, second].map(|it| self.linkage.joints[it].0.span);
                let message = format!("several joints are named `{}`", name.text);
                self.diagnostics.push(
                    Diagnostic::error(Code::WrongForm, name.span, message)
                        .label("which one?")
                        .also(spans[0], "the first one")
                        .also(spans[1], "another one")
                        .help("give the joint a name of its own"),
                );
                return None;
            }
        };
        let joint = &self.linkage.joints[place].0;
        let (label, declaration) = (joint.label.clone(), joint.name_span);
        let has_teeth = joint.pressure_angle.is_some();
        let (kind, operands) = (joint.kind, joint.operands.clone());
        let feature = kind.feature(&operands, &mut self.graph);
        let fits = match feature {
            Some(Feature::Weld | Feature::Slide) => true,
            Some(Feature::Wheels(..)) => !with_force || has_teeth,
            Some(Feature::Orientation | Feature::RelativeOrientation) => !with_force,
            Some(Feature::Written) | None => false,
            Some(_) => with_force,
        };
        if !fits {
            let (what, help) = match with_force {
                true => ("force", "its moment is `moment(…)`, if it has one"),
                false => ("moment", "its force is `reaction(…)`, if it has one"),
            };
            let message = format!("`{label}` transmits no {what}");
            let finding = Diagnostic::error(Code::WrongForm, name.span, message).help(help);
            self.diagnostics.push(finding);
            return None;
        }
        if let Some(declaration) = declaration {
            self.note_use(&name, declaration);
        }
        Some(place)
    }

    /// Returns the name in an argument; `None` after an error.
    pub(super) fn name_in_measure(&mut self, argument: &Expression, sort: &str) -> Option<Name> {
        if let ExpressionKind::Reference(reference) = &argument.kind
            && reference.body.is_none()
        {
            return Some(reference.name.clone());
        }
        let message = format!("expected the name of {sort}");
        let finding = Diagnostic::error(Code::OutsideGrammar, argument.span, message)
            .label("not a name")
            .help("write `magnitude(reaction(P))`, `moment(P)` or `effort(crank)`");
        self.diagnostics.push(finding);
        None
    }

    fn report_vector(&mut self, function: &Name, span: Span) {
        let name = &function.text;
        let message = format!("`{name}` is a vector, not a number");
        self.diagnostics.push(
            Diagnostic::error(Code::OutsideGrammar, span, message)
                .label("has two components")
                .help(format!(
                    "write `magnitude({name}(…))`, `x({name}(…))` or `y({name}(…))`"
                )),
        );
    }

    fn report_measure_count(&mut self, name: &str, wanted: usize, given: usize, span: Span) {
        let noun = if wanted == 1 { "argument" } else { "arguments" };
        let count = if wanted == 0 {
            "no".to_string()
        } else {
            wanted.to_string()
        };
        let message = format!("`{name}` takes {count} {noun}, not {given}");
        let example = match name {
            "relative_angle" => "write `relative_angle(a, b)` with the names of two bodies",
            "transmission_angle" => {
                "write `transmission_angle(B, C, D)` with the pin of both links between their other points"
            }
            "rate" => "write `rate(…)` with one formula, such as `rate(phi(1))`",
            "effort" | "power" => "write the name of a driver: `effort(crank)`",
            "reduced_mass" => "write the name of a driver: `reduced_mass(crank)`",
            "kinetic_energy" | "potential_energy" => "write `kinetic_energy()`",
            "length" | "tension" | "energy" => {
                "write the name of a spring or damper: `tension(main)`"
            }
            "reaction" | "moment" => "write the name of a joint: `reaction(P)`",
            "magnitude" | "x" | "y" => "write `magnitude(velocity(K))` with one vector",
            _ => "write the name of a point: `speed(K)`",
        };
        self.diagnostics.push(
            Diagnostic::error(Code::WrongArgumentCount, span, message)
                .label(format!("{given} given"))
                .help(example),
        );
    }
}

/// True for a call whose value is a vector.
fn is_vector(written: &Expression) -> bool {
    match &written.kind {
        ExpressionKind::Call { function, .. } => VECTORS.contains(&function.text.as_str()),
        _ => false,
    }
}
