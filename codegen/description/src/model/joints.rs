//! Resolves joint and drive statements into joints with their kinds, labels and operands.

use super::expression::listed;
use super::operands::WrittenJoint;
use super::resolve::Resolver;
use super::synonyms::{self, meant};
use super::{Joint, Role};
use crate::diagnostic::{Code, Diagnostic, Span, nearest};
use crate::joint::{CONSTRAINTS, DRIVERS, Kind};
use crate::syntax;

impl Resolver<'_> {
    pub(super) fn add_joint(&mut self, joint: &syntax::Joint) {
        let keyword = joint.kind.text.as_str();
        let Some(kind) = kind_named(keyword, CONSTRAINTS) else {
            self.linkage.broken_lines.extend(joint.along.clone());
            self.note_operands(&joint.operands, joint.along.as_ref(), [0, 1]);
            let keywords: Vec<&str> = CONSTRAINTS.iter().map(|kind| kind.keyword).collect();
            let diagnostic = Diagnostic::error(
                Code::UnknownStatement,
                joint.kind.span,
                format!("no joint is named `{keyword}`"),
            )
            .label("not a statement of this language");
            let words = keywords.iter().chain(&syntax::KEYWORDS).copied();
            self.diagnostics.push(
                match meant(keyword, synonyms::JOINTS, words) {
                    Some(meant) => diagnostic.help(format!("did you mean `{meant}`?")),
                    None if matches!(keyword, "fixed" | "fix") => diagnostic.help(
                        "a body that does not move is the `ground`; points that move together stand in the braces of one body; two bodies that keep their relative pose are joined by `weld (1, 2);`",
                    ),
                    None if kind_named(keyword, DRIVERS).is_some() => diagnostic.help(format!(
                        "a driver begins with `drive`: `drive {keyword}(…) = …;`"
                    )),
                    None => diagnostic.help(format!("the joints are {}", listed(&keywords))),
                },
            );
            return;
        };
        let written = WrittenJoint {
            kind,
            role: Role::Constraint,
            is_free: false,
            name: joint.name.as_ref(),
            operands: &joint.operands,
            along: joint.along.as_ref(),
            value: joint.value.as_ref(),
            pressure_angle: joint.pressure_angle.as_ref(),
            is_bare: false,
            placed: joint.placed,
            span: joint.span,
        };
        self.add_rows_of(&written, joint.redundant, &joint.docs);
    }

    pub(super) fn add_driver(&mut self, drive: &syntax::Drive) {
        self.add_driven(drive, &drive.value, false);
    }

    /// Adds a driver with `value` for a driven or free quantity.
    pub(super) fn add_driven(
        &mut self,
        drive: &syntax::Drive,
        value: &syntax::Expression,
        is_free: bool,
    ) {
        // Joint names are point names, which several pairs of bodies may share; driver names are unique.
        let duplicate = drive
            .name
            .as_ref()
            .and_then(|name| self.declared.drivers.declare(name, ()));
        self.diagnostics.extend(duplicate);
        let quantity = drive.quantity.text.as_str();
        let Some(kind) = kind_named(quantity, DRIVERS) else {
            self.note_operands(&drive.operands, None, [0, 1]);
            let quantities: Vec<&str> = DRIVERS.iter().map(|kind| kind.keyword).collect();
            let help = match nearest(quantity, quantities.iter().copied()) {
                Some(meant) => format!("did you mean `{meant}`?"),
                None => format!(
                    "the quantities that can be driven are {}",
                    listed(&quantities)
                ),
            };
            self.diagnostics.push(
                Diagnostic::error(
                    Code::UnknownStatement,
                    drive.quantity.span,
                    format!("`{quantity}` is not a quantity that can be driven"),
                )
                .help(help),
            );
            return;
        };
        let mut operands = drive.operands.clone();
        if drive.form == syntax::DrivenForm::Bare && !self.is_angle_alone(&drive.operands[0]) {
            return;
        }
        if drive.form == syntax::DrivenForm::Dotted {
            for operand in &mut operands {
                let Some(carried) = self.on_its_carrier(operand) else {
                    return;
                };
                *operand = carried;
            }
        }
        let driver = WrittenJoint {
            kind,
            role: Role::Driver,
            is_free,
            name: drive.name.as_ref(),
            operands: &operands,
            along: None,
            value: Some(value),
            pressure_angle: None,
            is_bare: drive.form == syntax::DrivenForm::Bare,
            placed: drive.placed,
            span: drive.span,
        };
        self.add_rows_of(&driver, None, &drive.docs);
    }

    /// Resolves the point K of `drive K.x` on the first body that has the point; leaves a body, or a point of a body, as
    /// written.
    pub(super) fn on_its_carrier(
        &mut self,
        operand: &syntax::Reference,
    ) -> Option<syntax::Reference> {
        let name = &operand.name;
        let carrier = self.linkage.carriers.first_carrier(&name.text);
        let carrier = carrier.map(|(body, _)| &self.linkage.bodies[body.0]);
        if operand.body.is_some()
            || (carrier.is_none() && self.declared.body_ids.get(&name.text).is_some())
        {
            return Some(operand.clone());
        }
        if let Some(carrier) = carrier {
            return Some(syntax::Reference {
                body: Some(syntax::Name {
                    text: carrier.name.clone(),
                    span: carrier.span,
                }),
                ..operand.clone()
            });
        }
        let diagnostic = match self.declared.drawn.get(&name.text) {
            Some(_) => Diagnostic::error(
                Code::PointNotOnBody,
                name.span,
                format!("no body carries the point `{}`", name.text),
            )
            .label("fixed to the ground")
            .help("list it in the braces of the body that it moves with"),
            None => self.declared.drawn.unknown(&name.text, name.span),
        };
        self.diagnostics.push(diagnostic);
        None
    }

    /// True if the name in `drive NAME = …` is an angle; otherwise reports an error.
    fn is_angle_alone(&mut self, named: &syntax::Reference) -> bool {
        let text = &named.name.text;
        if self.angle_named(text).is_some() {
            return true;
        }
        let example = match self.declared.body_ids.get(text) {
            Some(_) => format!("write `drive phi({text}) = …;`"),
            None => "a driver is written `drive phi(BODY) = …;`, or `drive ANGLE = …;` with an `angle` that is declared above".to_string(),
        };
        self.diagnostics.push(
            Diagnostic::error(
                Code::UnknownName,
                named.span,
                format!("no angle is named `{text}`"),
            )
            .label("cannot be driven by its name alone")
            .help(example),
        );
        false
    }

    fn add_rows_of(&mut self, given: &WrittenJoint<'_>, redundant: Option<Span>, docs: &[String]) {
        if let Some(part) = given.placed
            && is_global(given)
        {
            let message = format!("`{}` cannot be moved with a part", label(given));
            self.diagnostics.push(
                Diagnostic::error(Code::WrongForm, given.span, message)
                    .label("refers to the global axes")
                    .also(part, "the part is placed here")
                    .help("write it in the mechanism, with names such as `PART.BODY`"),
            );
        }
        let operands = self.operands(given);
        // Resolved even after an error, so that all errors are reported at once.
        let pressure_angle = given
            .pressure_angle
            .and_then(|written| self.pressure_angle(given, written, operands.as_ref()));
        let Some(operands) = operands else {
            self.linkage.broken_lines.extend(given.along.cloned());
            return;
        };
        let label = label(given);
        let slug = self.unique_slug(given);
        let joint = Joint {
            kind: given.kind,
            role: given.role,
            redundant,
            name: given.name.map(|name| name.text.clone()),
            name_span: given.name.map(|name| name.span),
            label,
            slug,
            docs: docs.to_vec(),
            operands,
            pressure_angle,
            span: given.span,
        };
        let along = given.along.map(|along| self.on_bodies(along, &joint));
        self.linkage.push_joint(joint, along);
    }

    /// Returns the line of a joint with the bodies of its ends, by which drivers may name them.
    fn on_bodies(&self, along: &syntax::Direction, joint: &Joint) -> syntax::Direction {
        let marks = &joint.operands.marks;
        let owners = joint.kind.operands.line.owners();
        let [from, to] = [(&along.from, owners[0]), (&along.to, owners[1])].map(|(end, owner)| {
            let body = &self.linkage.bodies[marks[owner].frame.body.0];
            let body = syntax::Name {
                text: body.name.clone(),
                span: end.span,
            };
            syntax::Reference {
                body: end.body.clone().or(Some(body)),
                ..end.clone()
            }
        });
        syntax::Direction {
            from,
            to,
            span: along.span,
        }
    }
}

/// True if moving the bodies of a joint in the design configuration changes its meaning.
fn is_global(given: &WrittenJoint<'_>) -> bool {
    let mut bodies = given
        .operands
        .iter()
        .map(|it| it.body.as_ref().unwrap_or(&it.name));
    given.kind.is_global(bodies.any(|it| it.text == "ground"))
}

fn kind_named(keyword: &str, kinds: &[&'static Kind]) -> Option<&'static Kind> {
    kinds.iter().copied().find(|kind| kind.keyword == keyword)
}

/// Returns the label of a statement in messages: `revolute P(1, 2)`, `drive length(N, M)`.
pub(super) fn label(given: &WrittenJoint<'_>) -> String {
    let reference = |reference: &syntax::Reference| match &reference.body {
        Some(body) => format!("{}.{}", body.text, reference.name.text),
        None => reference.name.text.clone(),
    };
    let operands: Vec<String> = given.operands.iter().map(reference).collect();
    let operands = operands.join(", ");
    let keyword = given.kind.keyword;
    let along = given.along.map(|along| {
        format!(
            " along {} -> {}",
            reference(&along.from),
            reference(&along.to)
        )
    });
    let along = along.unwrap_or_default();
    let driven = match given.is_bare {
        true => operands.clone(),
        false => format!("{keyword}({operands})"),
    };
    let word = if given.is_free { "free" } else { "drive" };
    match (given.role, given.name.map(|name| name.text.as_str())) {
        (Role::Driver, Some(name)) => format!("{word} {name}: {driven}"),
        (Role::Driver, None) => format!("drive {driven}"),
        (Role::Constraint, Some(name)) => format!("{keyword} {name}({operands}){along}"),
        (Role::Constraint, None) if given.operands.len() == 1 => format!("{keyword}({operands})"),
        (Role::Constraint, None) => format!("{keyword} ({operands}){along}"),
    }
}
