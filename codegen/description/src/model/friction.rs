//! Resolves `friction` statements.

use super::dimension::Dimension;
use super::forces::Forces;
use super::resolve::Resolver;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::expr::ExprId;
use crate::joint::Feature;
use crate::syntax::{self, Statement};

/// Coulomb friction in a joint.
#[derive(Clone, Copy, Debug)]
pub struct Friction {
    /// Index into the mechanism's joints.
    pub joint: usize,
    /// Coefficient of friction.
    pub coefficient: ExprId,
    /// Surfaces that slide on one another.
    pub surfaces: Surfaces,
    /// Source location of the statement.
    pub span: Span,
}

/// Surfaces that slide on one another.
#[derive(Clone, Copy, Debug)]
pub enum Surfaces {
    /// Pin of this radius, in m.
    Pin(ExprId),
    /// Slide, which carries its moment at the ends of this length, in m; `None` if the moment does not count.
    Slide(Option<ExprId>),
}

/// Name of the radius of a pin, and help for one that is not positive.
const RADIUS: [&str; 2] = [
    "the radius of a pin",
    "write the radius of the pin: `friction P = 0.1 radius 6mm;`",
];

/// Name of the length of a slide, and help for one that is not positive.
const LENGTH: [&str; 2] = [
    "the length of a slide",
    "write the length over which both bodies touch: `friction rail = 0.1 over 40mm;`",
];

impl Friction {
    /// True for a pin.
    pub fn is_pin(&self) -> bool {
        matches!(self.surfaces, Surfaces::Pin(_))
    }
}

impl Resolver<'_> {
    /// Resolves all `friction` statements; those with an error are reported and omitted.
    pub(super) fn frictions(
        &mut self,
        statements: &[&Statement],
        forces: &Forces,
    ) -> Vec<Friction> {
        let mut frictions: Vec<Friction> = Vec::new();
        for statement in statements {
            let Statement::Friction(written) = statement else {
                continue;
            };
            if !self.may_have_friction(written, forces) {
                continue;
            }
            let joints = self.joints_with_friction(written);
            let is_earlier = |it: &&Friction| joints.contains(&it.joint);
            if let Some(earlier) = frictions.iter().find(is_earlier) {
                let name = &written.joint;
                let message = format!("the friction of `{}` is given twice", name.text);
                let finding = Diagnostic::error(Code::DuplicateName, name.span, message)
                    .label("given again here")
                    .also(earlier.span, "first given here")
                    .help("remove one of them");
                self.diagnostics.push(finding);
                continue;
            }
            // Joints of one name have friction of one kind.
            let Some(&first) = joints.first() else {
                continue;
            };
            let coefficient = self.constant(&written.coefficient, Dimension::RATIO);
            let what = "a coefficient of friction";
            let coefficient = coefficient
                .filter(|&value| self.is_not_negative(value, &written.coefficient, what));
            let surfaces = self.surfaces(written, first);
            if let (Some(coefficient), Some(surfaces)) = (coefficient, surfaces) {
                frictions.extend(joints.into_iter().map(|joint| Friction {
                    joint,
                    coefficient,
                    surfaces,
                    span: written.span,
                }));
            }
        }
        frictions.sort_by_key(|it| (!it.is_pin(), it.joint));
        frictions
    }

    /// True if the reactions of the mechanism follow from the equations alone; otherwise reports an error.
    fn may_have_friction(&mut self, written: &syntax::Friction, forces: &Forces) -> bool {
        let joints = self.linkage.joints.iter().map(|(joint, _)| joint);
        let redundant = joints.clone().find_map(|joint| {
            let message = format!(
                "`{}` repeats constraints of other joints, so that rigid bodies do not determine reactions and friction",
                joint.label
            );
            Some((joint.redundant?, message, "remove the redundant joint"))
        });
        let free = forces.free.first().map(|free| {
            let message = "friction is not part of free motion".to_string();
            (
                free.span,
                message,
                "write a `drive` statement instead of `free`, or a `damper`",
            )
        });
        let teeth = forces.teeth.first().map(|teeth| {
            let message = "friction does not act beside tooth forces in bearings".to_string();
            let gear = &self.linkage.joints[teeth.gear].0;
            (
                gear.span,
                message,
                "remove the `pressure_angle` of the gear",
            )
        });
        let Some((place, message, help)) = redundant.or(free).or(teeth) else {
            return true;
        };
        let finding = Diagnostic::error(Code::WrongForm, written.span, message)
            .also(place, "this one")
            .help(help);
        self.diagnostics.push(finding);
        false
    }

    /// Returns the joints of a statement's name; empty after an error.
    fn joints_with_friction(&mut self, written: &syntax::Friction) -> Vec<usize> {
        let name = &written.joint;
        let joints = self.constraints_named(name);
        let features: Vec<_> = joints.iter().map(|&it| self.feature_of(it)).collect();
        let slides = |it: &Option<Feature>| matches!(it, Some(Feature::Slide | Feature::Slot(_)));
        let is_pin = |it: &Option<Feature>| matches!(it, Some(Feature::Pin));
        if features.iter().all(is_pin) || features.iter().all(slides) {
            return joints;
        }
        let mut others = joints.iter().zip(&features);
        let other = others.find(|(_, feature)| !is_pin(feature) && !slides(feature));
        let joint = other.map_or(joints[0], |(&joint, _)| joint);
        let joint = &self.linkage.joints[joint].0;
        let (message, help) = match other {
            Some(_) => (
                format!("`{}` has neither a pin nor a slide", joint.label),
                "write friction of `revolute`, `translational`, `point_on_line` or `revolute_translational` joints",
            ),
            None => (
                format!("joints of different kinds are named `{}`", name.text),
                "give each joint a name of its own",
            ),
        };
        let finding = Diagnostic::error(Code::WrongForm, name.span, message)
            .also(joint.span, "the joint")
            .help(help);
        self.diagnostics.push(finding);
        Vec::new()
    }

    fn feature_of(&mut self, joint: usize) -> Option<Feature> {
        let joint = &self.linkage.joints[joint].0;
        let (kind, operands) = (joint.kind, joint.operands.clone());
        kind.feature(&operands, &mut self.graph)
    }

    /// Resolves the radius of a pin or the length of a slide; `None` after an error.
    fn surfaces(&mut self, written: &syntax::Friction, joint: usize) -> Option<Surfaces> {
        let feature = self.feature_of(joint);
        let label = self.linkage.joints[joint].0.label.clone();
        let finding =
            |span: Span, message: String| Diagnostic::error(Code::WrongForm, span, message);
        let refusal = match (feature, &written.radius, &written.length) {
            (Some(Feature::Pin), None, _) => Some(
                finding(
                    written.span,
                    format!("the friction of `{label}` needs the radius of its pin"),
                )
                .help(RADIUS[1]),
            ),
            (Some(Feature::Pin), _, Some(length)) => Some(
                finding(
                    length.span,
                    format!("`{label}` has a pin, and no length to slide over"),
                )
                .help("remove `over`"),
            ),
            (Some(Feature::Pin), ..) => None,
            (_, Some(radius), _) => Some(
                finding(radius.span, format!("`{label}` slides, and has no pin"))
                    .help("remove `radius`"),
            ),
            (Some(Feature::Slot(_)), _, Some(length)) => Some(
                finding(length.span, format!("`{label}` carries no moment")).help("remove `over`"),
            ),
            _ => None,
        };
        if let Some(refusal) = refusal {
            self.diagnostics.push(refusal);
            return None;
        }
        let mut positive = |written: &syntax::Expression, names| {
            let value = self.constant(written, Dimension::LENGTH);
            value.filter(|&value| self.is_above_zero(value, written, names))
        };
        match (&written.radius, &written.length) {
            (Some(radius), _) => positive(radius, RADIUS).map(Surfaces::Pin),
            (None, Some(length)) => positive(length, LENGTH).map(|it| Surfaces::Slide(Some(it))),
            (None, None) => Some(Surfaces::Slide(None)),
        }
    }
}
