//! Resolves `clearance` statements, and adds the offsets of loose pins to the equations for a study of tolerances.

use super::dimension::Dimension;
use super::resolve::Resolver;
use super::{Distribution, Mechanism, Parameter};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::expr::Graph;
use crate::joint::geometry::Mark;
use crate::syntax::{Constant, Name, Statement};

/// Keyword of the joints that may have a clearance.
const PIN: &str = "revolute";

/// Radial clearance of a pin.
#[derive(Clone, Debug, PartialEq)]
pub struct Clearance {
    /// Index into the mechanism's joints.
    pub joint: usize,
    /// Largest distance between both centers, in m.
    pub radius: f64,
    /// Source location of the name.
    pub span: Span,
}

impl Resolver<'_> {
    /// Resolves all `clearance` statements in source order; those with an error are reported and omitted.
    pub(super) fn clearances(&mut self, statements: &[&Statement]) -> Vec<Clearance> {
        let mut clearances: Vec<Clearance> = Vec::new();
        for statement in statements {
            let Statement::Clearance(written) = statement else {
                continue;
            };
            let joints = self.pins(written);
            let help = "write the largest distance between both centers: `clearance P = 0.05mm;`";
            let mut length = Dimension::LENGTH;
            let radius = self.fixed_extent(&written.value, ["a clearance", help], &mut length);
            let name = &written.name;
            let is_earlier = |it: &&Clearance| joints.contains(&it.joint);
            if let Some(earlier) = clearances.iter().find(is_earlier) {
                let message = format!("`{}` has two clearances", name.text);
                let finding = Diagnostic::error(Code::DuplicateName, name.span, message)
                    .also(earlier.span, "the first one")
                    .help("remove one of them");
                self.diagnostics.push(finding);
                continue;
            }
            let span = name.span;
            clearances.extend(radius.into_iter().flat_map(|radius| {
                joints.iter().map(move |&joint| Clearance {
                    joint,
                    radius,
                    span,
                })
            }));
        }
        clearances
    }

    /// Reports a name that no joint has.
    fn report_nameless_joint(&mut self, name: &Name, constraints: &[usize]) {
        let message = format!("no joint is named `{}`", name.text);
        let finding = Diagnostic::error(Code::UnknownName, name.span, message)
            .label("not a joint of this mechanism");
        let names = constraints.iter();
        let names = names.filter_map(|&it| self.linkage.joints[it].0.name.as_deref());
        let names: Vec<&str> = names.collect();
        let finding = match self.declared.nearest_known(&name.text, names) {
            Some(meant) => finding.help(format!("did you mean `{meant}`?")),
            None => finding.help("name a joint behind its word, `revolute P(1, 2);`"),
        };
        self.diagnostics.push(finding);
    }

    /// Returns the constraints of this name, and records their use; empty after an error.
    pub(super) fn constraints_named(&mut self, name: &Name) -> Vec<usize> {
        let constraints = self.constraint_places();
        let mut joints = constraints.clone();
        joints.retain(|&it| self.linkage.joints[it].0.name.as_deref() == Some(&name.text));
        if joints.is_empty() {
            self.report_nameless_joint(name, &constraints);
        }
        for &place in &joints {
            if let Some(declaration) = self.linkage.joints[place].0.name_span {
                self.note_use(name, declaration);
            }
        }
        joints
    }

    /// Returns the pins of a clearance's name; empty after an error.
    fn pins(&mut self, written: &Constant) -> Vec<usize> {
        let name = &written.name;
        let joints = self.constraints_named(name);
        let joint = |place: usize| &self.linkage.joints[place].0;
        let other = joints.iter().copied();
        let mut other =
            other.filter(|&it| joint(it).kind.keyword != PIN || joint(it).redundant.is_some());
        if let Some(place) = other.next() {
            let (label, span) = (joint(place).label.clone(), joint(place).span);
            let message = match joint(place).redundant {
                Some(_) => format!("`{label}` is redundant, so that it does not position anything"),
                None => format!("`{label}` has no pin"),
            };
            let finding = Diagnostic::error(Code::WrongForm, name.span, message)
                .label("expected a revolute joint")
                .also(span, "the joint")
                .help("write clearances of `revolute` joints that are not redundant");
            self.diagnostics.push(finding);
            return Vec::new();
        }
        joints
    }
}

impl Mechanism {
    /// Adds the offset of each loose pin to its joint: two parameters with the value 0, along the axes of the first body. The
    /// equations with them are those of a study of tolerances; no generated code has them.
    pub fn offset_pins(&mut self, graph: &mut Graph) {
        for clearance in self.clearances.clone() {
            let joint = &mut self.joints[clearance.joint];
            let mut local = joint.operands.marks[0].local;
            for (axis, component) in ["x", "y"].into_iter().zip(0..) {
                let name = format!("{}_clearance_{axis}", joint.slug);
                let symbol = graph.symbol(&format!("{name} parameter"));
                graph.set_nominal(symbol, 0.0);
                let offset = graph.variable(symbol);
                local[component] = graph.add(local[component], offset);
                self.parameters.push(Parameter {
                    name,
                    docs: Vec::new(),
                    symbol,
                    nominal: graph.zero(),
                    range: None,
                    tolerance: Some(Distribution::Clearance {
                        radius: clearance.radius,
                        axis: component,
                    }),
                    dimension: Dimension::LENGTH,
                    used: true,
                    span: clearance.span,
                });
            }
            let frame = joint.operands.marks[0].frame;
            joint.operands.marks[0] = Mark::new(frame, local, graph);
        }
    }
}
