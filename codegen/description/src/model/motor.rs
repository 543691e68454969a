//! Resolves `motor` statements into measures of torque, speed and power at the shafts of motors.
//!
//! The gear turns the shaft G times the driven quantity s and loses a part of the power that passes it: F/(G η) drives the load F with
//! the efficiency η, and F η/G is left of a load that drives the motor. The rotor takes its own torque, J G s̈.

use super::ForceTerm;
use super::dimension::Dimension;
use super::kinematic::KinematicTerms;
use super::resolve::Resolver;
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::expr::ExprId;
use crate::joint::Quantity;
use crate::syntax::{self, Expression, Name};

/// Motor of a driver.
#[derive(Clone, Debug)]
pub struct Motor {
    /// Index of the driver among the mechanism's joints.
    pub joint: usize,
    /// Rotation of the shaft per unit of the driven quantity: a number about an angle, rad/m along a length.
    pub gear: ExprId,
    /// Moment of inertia at the shaft, in kg·m².
    pub inertia: ExprId,
    /// Part of the power that the gear transmits.
    pub efficiency: ExprId,
    /// Indices of torque, speed and power among the mechanism's measurements.
    pub measurements: [usize; 3],
    /// Source location of the statement.
    pub span: Span,
}

/// Ends of the names of a motor's torque, speed and power, behind the name of its driver.
const SUFFIXES: [&str; 3] = ["_motor_torque", "_motor_speed", "_motor_power"];

/// Quantities of motors, for documentation.
const QUANTITIES: [&str; 3] = ["Torque", "Speed", "Power"];

/// Name of the ratio of a gear, and help for one that is not positive.
const GEAR: [&str; 2] = [
    "the ratio of a gear",
    "check the sign; a shaft turns forward as its driver does",
];

/// Values of the clauses of a motor, or their defaults.
struct Clauses {
    gear: ExprId,
    inertia: ExprId,
    efficiency: ExprId,
}

impl Resolver<'_> {
    pub(super) fn add_motor(&mut self, written: &syntax::Motor) {
        let name = &written.driver;
        let Some(joint) = self.driver_named(name) else {
            return;
        };
        let quantity = self.linkage.joints[joint].0.kind.value.quantity();
        let Some(clauses) = self.clauses_of_motor(written, quantity) else {
            return;
        };
        if let Some(free) = self.forces.free.iter().find(|it| it.joint == joint) {
            let message = format!("`{}` is free, so that no motor moves it", name.text);
            let finding = Diagnostic::error(Code::WrongForm, name.span, message)
                .also(free.span, "forces move it")
                .help("write a `drive` statement instead of `free`");
            self.diagnostics.push(finding);
            return;
        }
        let mut motors = self.declared.motors.iter();
        if let Some(earlier) = motors.find(|it| it.joint == joint) {
            let message = format!("`{}` has two motors", name.text);
            let finding = Diagnostic::error(Code::DuplicateName, name.span, message)
                .also(earlier.span, "the first one")
                .help("remove one of them");
            self.diagnostics.push(finding);
            return;
        }
        let Clauses {
            gear,
            inertia,
            efficiency,
        } = clauses;
        if let Some(measurements) = self.measurements_of_motor(written, joint, &clauses) {
            self.declared.motors.push(Motor {
                joint,
                gear,
                inertia,
                efficiency,
                measurements,
                span: written.span,
            });
        }
    }

    /// Resolves the clauses of a motor at a driver of this quantity; `None` after an error.
    fn clauses_of_motor(
        &mut self,
        written: &syntax::Motor,
        quantity: Option<Quantity>,
    ) -> Option<Clauses> {
        let (zero, one) = (self.graph.zero(), self.graph.one());
        let is_angle = quantity.is_none_or(|it| it == Quantity::Angle);
        let expected = match is_angle {
            true => Dimension::RATIO,
            false => Dimension::ANGLE_PER_LENGTH,
        };
        let gear = match &written.gear {
            Some(gear) => {
                let value = self.constant(gear, expected);
                value.filter(|&value| self.is_above_zero(value, gear, GEAR))
            }
            None if is_angle => Some(one),
            None => {
                let name = &written.driver;
                let message = format!("`{}` moves along a length, and a motor turns", name.text);
                let finding = Diagnostic::error(Code::WrongForm, name.span, message)
                    .label("expected a gear")
                    .help("write the rotation of the shaft over the length: `gear 2*pi/5mm` for a screw with a lead of 5 mm");
                self.diagnostics.push(finding);
                None
            }
        };
        let inertia = match &written.inertia {
            Some(inertia) => {
                let value = self.constant(inertia, Dimension::INERTIA);
                let what = "a moment of inertia";
                value.filter(|&value| self.is_not_negative(value, inertia, what))
            }
            None => Some(zero),
        };
        let efficiency = match &written.efficiency {
            Some(efficiency) => {
                let value = self.constant(efficiency, Dimension::RATIO);
                value.filter(|&value| self.is_efficiency(value, efficiency))
            }
            None => Some(one),
        };
        Some(Clauses {
            gear: gear?,
            inertia: inertia?,
            efficiency: efficiency?,
        })
    }

    /// True if a value is positive at the defaults of the parameters; otherwise reports an error.
    pub(super) fn is_above_zero(
        &mut self,
        value: ExprId,
        written: &Expression,
        [what, help]: [&str; 2],
    ) -> bool {
        let value = self.graph.constant_value(value);
        let is_possible = value.is_none_or(|it| it > 0.0);
        if !is_possible {
            let message = format!("{what} must be positive");
            let finding = Diagnostic::error(Code::ValueNotAllowed, written.span, message);
            self.diagnostics.push(finding.help(help));
        }
        is_possible
    }

    /// True if a value can be an efficiency at the defaults of the parameters; otherwise reports an error.
    fn is_efficiency(&mut self, value: ExprId, written: &Expression) -> bool {
        let value = self.graph.constant_value(value);
        let is_possible = value.is_none_or(|it| it > 0.0 && it <= 1.0);
        if !is_possible {
            let message = "an efficiency is above 0 and at most 1";
            let finding = Diagnostic::error(Code::ValueNotAllowed, written.span, message)
                .help("write the part of the power that the gear transmits: `efficiency 0.8`");
            self.diagnostics.push(finding);
        }
        is_possible
    }

    /// Adds the measures of a motor; `None` after an error.
    fn measurements_of_motor(
        &mut self,
        written: &syntax::Motor,
        joint: usize,
        clauses: &Clauses,
    ) -> Option<[usize; 3]> {
        let torque = self.measurement_of_motor(written, 0, Dimension::TORQUE, |resolver| {
            resolver.torque_at_shaft(joint, clauses, written.span)
        })?;
        let speed = self.measurement_of_motor(written, 1, Dimension::AngleRate(1), |resolver| {
            let rate = resolver.rate_of_driver(joint, 1, written.span)?;
            Some(resolver.graph.multiply(clauses.gear, rate))
        })?;
        let power = self.measurement_of_motor(written, 2, Dimension::POWER, |resolver| {
            let factors = [torque, speed].map(|it| resolver.declared.measurements[it].symbol);
            let [torque, speed] = factors.map(|it| resolver.graph.variable(it));
            Some(resolver.graph.multiply(torque, speed))
        })?;
        Some([torque, speed, power])
    }

    /// Adds a measure of a motor, and returns its index; `None` after an error.
    fn measurement_of_motor(
        &mut self,
        written: &syntax::Motor,
        quantity: usize,
        dimension: Dimension,
        value: impl FnOnce(&mut Self) -> Option<ExprId>,
    ) -> Option<usize> {
        let driver = &written.driver;
        let name = Name {
            text: format!("{}{}", driver.text, SUFFIXES[quantity]),
            span: driver.span,
        };
        if let Some((earlier, _)) = self.declared.measures.found(&name.text) {
            let message = format!(
                "the motor of `{}` has the measure `{}`",
                driver.text, name.text
            );
            let finding = Diagnostic::error(Code::DuplicateName, driver.span, message)
                .also(earlier, "a measure of this name")
                .help("give the other measure another name");
            self.diagnostics.push(finding);
            return None;
        }
        self.begin_measure(&name.text);
        let value = value(self);
        let terms = self.formulas.kinematic.take();
        let (terms, _) = terms.and_then(KinematicTerms::into_measure)?;
        let mut docs = vec![format!(
            "{} at the shaft of the motor of `{}`.",
            QUANTITIES[quantity], driver.text
        )];
        docs.extend(written.docs.iter().cloned());
        self.push_measurement(name, docs, (value?, dimension), (terms, Vec::new()))
    }

    /// Returns the torque at the shaft of a motor; `None` after an error.
    fn torque_at_shaft(&mut self, joint: usize, clauses: &Clauses, span: Span) -> Option<ExprId> {
        let &Clauses {
            gear,
            inertia,
            efficiency,
        } = clauses;
        let (effort, _) = self.force_in_measure(ForceTerm::Effort(joint), Dimension::TORQUE)?;
        let load = self.graph.divide(effort, gear);
        let mut torque = load;
        if efficiency != self.graph.one() {
            let (power, _) = self.force_in_measure(ForceTerm::Power(joint), Dimension::POWER)?;
            let driving = self.graph.divide(load, efficiency);
            let driven = self.graph.multiply(load, efficiency);
            torque = self.graph.choose(power, driven, driving);
        }
        if inertia != self.graph.zero() {
            let acceleration = self.rate_of_driver(joint, 2, span)?;
            let acceleration = self.graph.multiply(gear, acceleration);
            let of_rotor = self.graph.multiply(inertia, acceleration);
            torque = self.graph.add(torque, of_rotor);
        }
        Some(torque)
    }

    /// Returns the rate (1) or the acceleration (2) of a driven quantity in a measure.
    pub(super) fn rate_of_driver(
        &mut self,
        joint: usize,
        order: usize,
        span: Span,
    ) -> Option<ExprId> {
        let driven = self.linkage.joints[joint].0.operands.value?;
        let mut value = (driven, Dimension::OfTime);
        for _ in 0..order {
            value = self.rate_in_measure(value, span)?;
        }
        Some(value.0)
    }

    /// Records the use of a motor's measure as one of its driver, so that both are renamed together.
    pub(super) fn note_motor(&mut self, name: &Name) {
        let motors = self.declared.motors.iter();
        let drivers = motors.map(|it| &self.linkage.joints[it.joint].0);
        let used = drivers.filter_map(|driver| {
            let prefix = driver.name.as_deref()?;
            let suffix = name.text.strip_prefix(prefix)?;
            Some((prefix.to_string(), suffix, driver.name_span?))
        });
        let mut used = used.filter(|(_, suffix, _)| SUFFIXES.contains(suffix));
        let Some((text, suffix, declaration)) = used.next() else {
            return;
        };
        let written = name.span.range();
        let driver = Span::new(written.start, written.end - suffix.len().min(written.len()));
        // An index is not part of the name of a measure.
        if driver.range().len() == declaration.range().len() {
            self.note_use(&Name { text, span: driver }, declaration);
        }
    }
}

impl Motor {
    /// True if a measure is one of the motor.
    pub fn has(&self, measurement: usize) -> bool {
        self.measurements.contains(&measurement)
    }
}
