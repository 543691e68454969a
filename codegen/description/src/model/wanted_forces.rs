//! Resolves `effort`, `reaction`, `reactions` and `energy` statements into requested forces, and checks that forces act on free
//! coordinates.

use std::collections::BTreeMap;

use super::forces::Forces;
use super::resolve::Resolver;
use super::{ForceTerm, Role};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::syntax::{Name, RequestKind, Statement};

/// Word of the statements that resist drivers in joints.
const FRICTION: &str = "friction";

/// Word of the statements that measure the forces of drivers at motors.
const MOTOR: &str = "motor";

impl Resolver<'_> {
    /// Returns masses, loads and requests.
    pub(super) fn wanted_forces(&mut self, statements: &[&Statement]) -> Forces {
        let mut forces = std::mem::take(&mut self.forces);
        forces.teeth = self.teeth();
        forces.frictions = self.frictions(statements, &forces);
        if let Some((gravity, span)) = self.gravity {
            if forces.masses.is_empty() && !self.diagnostics.has_errors() {
                self.diagnostics.push(
                    Diagnostic::error(Code::WrongForm, span, "no body has a mass")
                        .label("acts on nothing")
                        .help("give a body a mass: `mass 1 = 2kg;`"),
                );
            }
            forces.gravity = Some(gravity);
        }
        let measures = |is: fn(&ForceTerm) -> bool| self.measured_forces().any(|it| is(&it.0));
        let of_driver = measures(|it| matches!(it, ForceTerm::Effort(_) | ForceTerm::Power(_)));
        let of_masses =
            measures(|it| matches!(it, ForceTerm::KineticEnergy | ForceTerm::PotentialEnergy));
        let resists = !forces.frictions.is_empty();
        forces.efforts = of_driver || resists || self.has(RequestKind::Effort, statements);
        forces.energy = of_masses || self.has(RequestKind::Energy, statements);
        let every = self.has(RequestKind::Reactions, statements);
        forces.reactions = self.reactions(statements, every);
        forces.least_norm = self.has(RequestKind::LeastNorm, statements);
        let mut requests = asking(statements);
        requests.extend(self.measured_forces().map(|(force, span)| {
            let mut motors = self.declared.motors.iter();
            let word = match force {
                _ if motors.any(|it| it.span.range().contains(&span.range().start)) => MOTOR,
                ForceTerm::Effort(_) | ForceTerm::Power(_) => "effort",
                ForceTerm::Reaction(..) => "reaction",
                ForceTerm::KineticEnergy | ForceTerm::PotentialEnergy => "energy",
            };
            (word, span)
        }));
        let frictions = forces.frictions.iter();
        requests.extend(frictions.map(|it| (FRICTION, it.span)));
        if let Some((word, span)) = requests.first() {
            let word = *word;
            let acts = !forces.masses.is_empty() || !forces.loads.is_empty();
            if !acts && !self.diagnostics.has_errors() {
                self.diagnostics.push(
                    Diagnostic::error(
                        Code::WrongForm,
                        *span,
                        "no body has a mass, and nothing acts on one",
                    )
                    .label("would always be zero")
                    .help(format!(
                        "give bodies a mass, `mass 1 = 2kg;`, or loads, or remove `{word}`"
                    )),
                );
            }
        }
        if let Some(free) = forces.free.first()
            && forces.masses.is_empty()
            && !self.diagnostics.has_errors()
        {
            let mut bodies = self.linkage.bodies.iter().skip(1);
            let body = bodies.find(|it| !it.is_angle());
            let body = body.map_or("BODY", |it| it.name.as_str());
            self.diagnostics.push(
                Diagnostic::error(
                    Code::WrongForm,
                    free.span,
                    "a free coordinate requires a body with a mass",
                )
                .label("would have no acceleration")
                .help(format!("give the bodies a mass: `mass {body} = 2kg;`")),
            );
        }
        let is_of_driver = |word: &str| matches!(word, "effort" | MOTOR | FRICTION);
        if let Some((word, span)) = requests.iter().find(|(word, _)| is_of_driver(word)) {
            self.require_drivers(*span, "has no effort along it", &format!("`{word}`"));
        }
        let reaction = requests
            .iter()
            .find(|(word, _)| word.starts_with("reaction"));
        if let Some((_, span)) = reaction
            && !forces.least_norm
        {
            self.refuse_redundant(*span);
        }
        if let Some(span) = least_norm(statements) {
            self.require_redundant(span, &requests);
        }
        forces
    }

    /// Returns the indices of the joints that are constraints.
    pub(super) fn constraint_places(&self) -> Vec<usize> {
        let joints = self.linkage.joints.iter().enumerate();
        let constraints = joints.filter(|(_, (joint, _))| joint.role == Role::Constraint);
        constraints.map(|(place, _)| place).collect()
    }

    /// Returns the forces that measures contain, each with the name of its measure.
    fn measured_forces(&self) -> impl Iterator<Item = (ForceTerm, Span)> {
        let measures = self.declared.measurements.iter();
        measures.flat_map(|it| it.forces().map(|force| (force, it.span)))
    }

    /// Returns the joints whose reactions are requested.
    fn reactions(&mut self, statements: &[&Statement], every: bool) -> Vec<usize> {
        let constraints = self.constraint_places();
        let mut named: BTreeMap<String, Span> = BTreeMap::new();
        let measured = self.measured_forces().map(|(force, _)| force);
        let measured = measured.filter_map(|force| match force {
            ForceTerm::Reaction(joint, _) => Some(joint),
            _ => None,
        });
        let mut joints: Vec<usize> = measured.collect();
        for statement in statements {
            let Some(reaction) = statement.request(RequestKind::Reaction) else {
                continue;
            };
            for name in &reaction.names {
                if let Some(&earlier) = named.get(&name.text) {
                    self.diagnostics.push(
                        Diagnostic::error(
                            Code::DuplicateName,
                            name.span,
                            format!("the reaction of `{}` is requested twice", name.text),
                        )
                        .label("named again here")
                        .also(earlier, "first named here")
                        .help("remove one of them"),
                    );
                    continue;
                }
                named.insert(name.text.clone(), name.span);
                let matching = constraints.iter().filter(|&&place| {
                    self.linkage.joints[place].0.name.as_deref() == Some(name.text.as_str())
                });
                let matching: Vec<usize> = matching.copied().collect();
                if matching.is_empty() {
                    self.report_unknown_joint(name, &constraints);
                }
                for &place in &matching {
                    if let Some(declaration) = self.linkage.joints[place].0.name_span {
                        self.note_use(name, declaration);
                    }
                }
                joints.extend(matching);
            }
        }
        if every {
            return constraints;
        }
        joints.sort_unstable();
        joints.dedup();
        joints
    }

    pub(super) fn report_unknown_joint(&mut self, name: &Name, constraints: &[usize]) {
        let message = format!("no joint is named `{}`", name.text);
        let finding = Diagnostic::error(Code::UnknownName, name.span, message)
            .label("not a joint of this mechanism");
        let known: Vec<&str> = constraints
            .iter()
            .filter_map(|&place| self.linkage.joints[place].0.name.as_deref())
            .collect();
        let finding = match self.declared.nearest_known(&name.text, known) {
            Some(meant) => finding.help(format!("did you mean `{meant}`?")),
            None => finding.help("name a joint behind its word, `revolute P(1, 2);`, or request all reactions with `reactions;`"),
        };
        self.diagnostics.push(finding);
    }

    /// Rejects redundant joints, whose reactions are not unique.
    fn refuse_redundant(&mut self, span: Span) {
        let joints = self.linkage.joints.iter().map(|(joint, _)| joint);
        let redundant = joints.filter_map(|joint| Some((joint.redundant?, joint.label.clone())));
        if let Some((place, label)) = redundant.into_iter().next() {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::WrongForm,
                    span,
                    format!("`{label}` repeats constraints of other joints, so that rigid bodies do not determine their reactions"),
                )
                .label("has no unique answer")
                .also(place, "repeats constraints of other joints")
                .help("remove the redundant joint, request `effort;`, which does not depend on it, or write `least_norm;` for the smallest reactions"),
            );
        }
    }

    /// Requires redundant joints and a request for reactions, since the least norm has no effect otherwise.
    fn require_redundant(&mut self, span: Span, asked: &[(&'static str, Span)]) {
        if self.diagnostics.has_errors() {
            return;
        }
        let mut joints = self.linkage.joints.iter();
        let is_choice = joints.any(|(joint, _)| joint.redundant.is_some());
        let is_asked = asked.iter().any(|(word, _)| word.starts_with("reaction"));
        let (message, help) = match (is_choice, is_asked) {
            (true, true) => return,
            (false, _) => (
                "without redundant joints, reactions are unique",
                "remove `least_norm`",
            ),
            (true, false) => (
                "`least_norm` requires `reaction` or `reactions`",
                "request them, `reactions;`, or remove `least_norm`",
            ),
        };
        self.diagnostics.push(
            Diagnostic::error(Code::WrongForm, span, message)
                .label("leaves nothing to choose")
                .help(help),
        );
    }
}

/// Returns the statements that request forces, each with its keyword.
fn asking(statements: &[&Statement]) -> Vec<(&'static str, Span)> {
    let requests = statements.iter().filter_map(|statement| match statement {
        Statement::Request(it) => match it.kind {
            RequestKind::Effort
            | RequestKind::Reaction
            | RequestKind::Reactions
            | RequestKind::Energy => Some((it.word, it.span)),
            _ => None,
        },
        _ => None,
    });
    requests.collect()
}

/// Returns the location of the `least_norm` statement; `None` without one.
fn least_norm(statements: &[&Statement]) -> Option<Span> {
    let mut requests = statements.iter();
    requests.find_map(|it| Some(it.request(RequestKind::LeastNorm)?.span))
}
