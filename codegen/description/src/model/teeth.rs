//! Finds the axes of wheels whose `pressure_angle` is given, so that bearings can carry the force of their teeth.
//!
//! The axis of a wheel is its revolute joint on the carrier, or a joint about which both rotate on a third body. Either is a
//! point of the carrier, so the distance of two axes is constant.

use std::collections::HashMap;

use super::dimension::Dimension;
use super::operands::WrittenJoint;
use super::resolve::Resolver;
use super::{Joint, Role};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::expr::ExprId;
use crate::joint::geometry::{BodyId, Mark};
use crate::joint::{Feature, Mesh, Quantity, Resolved};
use crate::syntax::Expression;

/// The pressure angle of a gear.
#[derive(Clone, Copy, Debug)]
pub struct PressureAngle {
    /// Angle between the line of action and the common tangent of the pitch circles, in rad.
    pub value: ExprId,
    /// Location of the formula after `pressure_angle`.
    pub span: Span,
}

/// Teeth of two wheels that transmit a force.
#[derive(Clone, Debug)]
pub struct Teeth {
    /// Index of the gear among the joints.
    pub gear: usize,
    /// Pressure angle, in rad.
    pub pressure_angle: ExprId,
    /// Axes of both wheels, in the order of the gear's operands.
    pub axes: [WheelAxis; 2],
}

/// Axis about which a wheel rotates on its carrier.
#[derive(Clone, Debug)]
pub struct WheelAxis {
    /// Point of the axis on the carrier.
    pub place: Mark,
    /// Joints that transmit a force from the wheel to the carrier, in this order.
    pub bearings: Vec<Bearing>,
}

/// A revolute joint between a wheel and its carrier.
#[derive(Clone, Copy, Debug)]
pub struct Bearing {
    /// Index of the joint.
    pub joint: usize,
    /// True if the second body of the joint is the one on the side of the wheel.
    pub is_wheel_second: bool,
}

/// Revolute joints by their bodies, in source order.
struct Revolutes<'a> {
    joints: Vec<&'a Joint>,
    of_body: HashMap<BodyId, Vec<usize>>,
    between: HashMap<[BodyId; 2], Vec<usize>>,
}

impl<'a> Revolutes<'a> {
    fn new(joints: Vec<&'a Joint>) -> Revolutes<'a> {
        let mut of_body: HashMap<BodyId, Vec<usize>> = HashMap::new();
        let mut between: HashMap<[BodyId; 2], Vec<usize>> = HashMap::new();
        for (place, joint) in joints.iter().enumerate() {
            let ([one, other], Role::Constraint) = (&joint.operands.marks[..], joint.role) else {
                continue;
            };
            if !joint.kind.joins_points {
                continue;
            }
            let [one, other] = [one, other].map(|mark| mark.frame.body);
            for [body, on] in [[one, other], [other, one]] {
                of_body.entry(body).or_default().push(place);
                between.entry([body, on]).or_default().push(place);
            }
        }
        Revolutes {
            joints,
            of_body,
            between,
        }
    }

    fn of(&self, body: BodyId) -> &[usize] {
        self.of_body.get(&body).map_or(&[], Vec::as_slice)
    }

    fn joining(&self, one: BodyId, other: BodyId) -> &[usize] {
        let joints = self.between.get(&[one, other]);
        joints.map_or(&[], Vec::as_slice)
    }

    /// Returns the mark of a joint on a body, and the mark on its other body.
    fn seen_from(&self, joint: usize, body: BodyId) -> Option<[Mark; 2]> {
        match self.joints[joint].operands.marks[..] {
            [one, other] if one.frame.body == body => Some([one, other]),
            [one, other] if other.frame.body == body => Some([other, one]),
            _ => None,
        }
    }

    /// Returns the axis of a wheel on a carrier with the fewest redundant bearings; a direct joint is preferred among equals.
    /// `None` without an axis.
    fn axis(&self, wheel: BodyId, carrier: BodyId) -> Option<WheelAxis> {
        let direct = self.joining(wheel, carrier).iter().map(|&it| vec![it]);
        // One of the bodies may be the ground, to which many joints belong.
        let is_wheel_rarer = self.of(wheel).len() <= self.of(carrier).len();
        let (rarer, other) = match is_wheel_rarer {
            true => (wheel, carrier),
            false => (carrier, wheel),
        };
        let by_third = self.of(rarer).iter().flat_map(|&near| {
            let third = self.seen_from(near, rarer).map(|[_, it]| it);
            let third = third.filter(|it| it.frame.body != other);
            let far = third.map_or(&[][..], |it| self.joining(it.frame.body, other));
            let is_coaxial = move |far: &usize| {
                let marks = third.and_then(|it| self.seen_from(*far, it.frame.body));
                marks
                    .zip(third)
                    .is_some_and(|([mark, _], it)| mark.local == it.local)
            };
            let far = far.iter().copied().filter(is_coaxial);
            far.map(move |far| match is_wheel_rarer {
                true => vec![near, far],
                false => vec![far, near],
            })
        });
        let redundant = |path: &Vec<usize>| {
            let marked = path
                .iter()
                .filter(|&&it| self.joints[it].redundant.is_some());
            marked.count()
        };
        let path = direct.chain(by_third).min_by_key(redundant)?;
        let mut bearings = Vec::with_capacity(path.len());
        let (mut side, mut place) = (wheel, None);
        for joint in path {
            let [_, far] = self.seen_from(joint, side)?;
            let second = self.joints[joint].operands.marks[1].frame.body;
            bearings.push(Bearing {
                joint,
                is_wheel_second: second == side,
            });
            (side, place) = (far.frame.body, Some(far));
        }
        Some(WheelAxis {
            place: place?,
            bearings,
        })
    }
}

impl Resolver<'_> {
    /// Resolves the pressure angle of a joint; `None` after an error.
    pub(super) fn pressure_angle(
        &mut self,
        given: &WrittenJoint<'_>,
        written: &Expression,
        operands: Option<&Resolved>,
    ) -> Option<PressureAngle> {
        let value = self.constant(written, Dimension::of(Quantity::Angle))?;
        let keyword = given.kind.keyword;
        if !given.kind.has_pressure_angle {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::WrongForm,
                    written.span,
                    format!("`{keyword}` takes no `pressure_angle`"),
                )
                .help("remove it: teeth of `external_gear` and `internal_gear` have one"),
            );
            return None;
        }
        let angle = self.graph.constant_value(value)?;
        let refused = match angle {
            _ if angle < 0.0 => Some((
                "a pressure angle is not negative",
                "write it without a sign: which flank is loaded follows from the torque",
            )),
            _ if angle >= std::f64::consts::FRAC_PI_2 => Some((
                "a pressure angle is less than 90°",
                "write the angle between the line of action and the common tangent of the pitch circles with its unit: `20deg`",
            )),
            _ => None,
        };
        if let Some((problem, help)) = refused {
            self.diagnostics.push(
                Diagnostic::error(Code::ValueNotAllowed, written.span, problem)
                    .label(format!(
                        "this is {}°",
                        (angle.to_degrees() * 1000.0).round() / 1000.0
                    ))
                    .help(help),
            );
            return None;
        }
        let feature = operands.and_then(|it| given.kind.feature(it, &mut self.graph));
        if let Some(Feature::Wheels(Mesh::Internal, ratio)) = feature
            && let Some(ratio) = self.graph.constant_value(ratio)
            && (1.0 - ratio).abs() <= 8.0 * f64::EPSILON
        {
            let span = given.value.map_or(given.span, |value| value.span);
            self.diagnostics.push(
                Diagnostic::error(
                    Code::ValueNotAllowed,
                    span,
                    "a wheel does not mesh inside a ring of its own size",
                )
                .label("leaves no distance between the axes")
                .also(written.span, "asks for the force of the teeth")
                .help("correct the ratio, or remove `pressure_angle`"),
            );
            return None;
        }
        Some(PressureAngle {
            value,
            span: written.span,
        })
    }

    /// Returns the teeth of all gears with a pressure angle, in source order.
    pub(super) fn teeth(&mut self) -> Vec<Teeth> {
        // Joints omitted after an error would be missing.
        if self.diagnostics.has_errors() {
            return Vec::new();
        }
        let joints: Vec<&Joint> = self.linkage.joints.iter().map(|(joint, _)| joint).collect();
        let revolutes = Revolutes::new(joints);
        let mut teeth = Vec::new();
        let mut findings = Vec::new();
        for (gear, joint) in revolutes.joints.iter().enumerate() {
            let (Some(angle), [i, j, carrier]) = (joint.pressure_angle, &joint.operands.marks[..])
            else {
                continue;
            };
            let carrier = carrier.frame.body;
            let wheels = [i, j].map(|mark| mark.frame.body);
            let axes = wheels.map(|wheel| revolutes.axis(wheel, carrier));
            let [Some(of_i), Some(of_j)] = axes else {
                for (wheel, axis) in wheels.into_iter().zip(&axes) {
                    if axis.is_none() {
                        findings.push(self.without_axis(joint, angle.span, wheel, carrier));
                    }
                }
                continue;
            };
            if !self.are_apart(of_i.place.local, of_j.place.local) {
                findings.push(self.coaxial(joint, angle.span, wheels, [&of_i, &of_j]));
                continue;
            }
            teeth.push(Teeth {
                gear,
                pressure_angle: angle.value,
                axes: [of_i, of_j],
            });
        }
        self.diagnostics.extend(findings);
        teeth
    }

    fn without_axis(
        &self,
        gear: &Joint,
        angle: Span,
        wheel: BodyId,
        carrier: BodyId,
    ) -> Diagnostic {
        let [wheel, carrier] = [wheel, carrier].map(|it| &self.linkage.bodies[it.0].name);
        let message = format!(
            "`{wheel}` has no `revolute` on `{carrier}`, the carrier of `{}`",
            gear.label
        );
        Diagnostic::error(Code::WrongForm, angle, message)
            .label("the force of the teeth needs the axes of both wheels")
            .also(gear.span, "the gear")
            .help(format!(
                "hold the wheel by `revolute ({carrier}.P, {wheel}.P);` with its center P, or remove `pressure_angle`"
            ))
    }

    fn coaxial(
        &self,
        gear: &Joint,
        angle: Span,
        wheels: [BodyId; 2],
        axes: [&WheelAxis; 2],
    ) -> Diagnostic {
        let [one, other] = wheels.map(|it| &self.linkage.bodies[it.0].name);
        let message = format!(
            "`{one}` and `{other}` turn about one axis of `{}`",
            gear.label
        );
        let mut finding = Diagnostic::error(Code::DegenerateGeometry, angle, message)
            .label("the pitch radii have no distance to divide");
        for (axis, name) in axes.into_iter().zip([one, other]) {
            if let Some(bearing) = axis.bearings.first() {
                let place = self.linkage.joints[bearing.joint].0.span;
                finding = finding.also(place, format!("the axis of `{name}`"));
            }
        }
        finding.help("place the axes apart, or remove `pressure_angle`")
    }
}
