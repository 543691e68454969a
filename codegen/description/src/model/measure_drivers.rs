//! Resolves quantities of drivers in measures: efforts, powers, and the mass that a driver moves.

use super::dimension::Dimension;
use super::expression::Value;
use super::resolve::Resolver;
use super::{ForceTerm, Role};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::joint::Quantity;
use crate::syntax::{Expression, Name};

impl Resolver<'_> {
    /// Resolves `effort(NAME)` or `power(NAME)` of a driver.
    pub(super) fn effort_of(&mut self, function: &Name, argument: &Expression) -> Option<Value> {
        let (place, quantity) = self.driver_in_measure(argument)?;
        let dimension = match quantity {
            Some(Quantity::Angle) => Dimension::TORQUE,
            _ => Dimension::FORCE,
        };
        match function.text.as_str() {
            "power" => self.force_in_measure(ForceTerm::Power(place), Dimension::POWER),
            _ => self.force_in_measure(ForceTerm::Effort(place), dimension),
        }
    }

    /// Resolves `kinetic_energy()` or `potential_energy()`.
    pub(super) fn energy_of_all(&mut self, name: &str) -> Option<Value> {
        let energy = match name {
            "kinetic_energy" => ForceTerm::KineticEnergy,
            _ => ForceTerm::PotentialEnergy,
        };
        self.force_in_measure(energy, Dimension::TORQUE)
    }

    /// Resolves `reduced_mass(NAME)` of the only driver that moves: the mass or the moment of inertia that has the kinetic energy of all
    /// masses at the rate of the driver.
    pub(super) fn reduced_mass(&mut self, argument: &Expression, span: Span) -> Option<Value> {
        let (place, quantity) = self.driver_in_measure(argument)?;
        let joints = self.linkage.joints.iter().enumerate();
        let mut others = joints.filter(|(other, (joint, _))| {
            let value = joint.operands.value;
            let stands = value.is_none_or(|it| self.graph.constant_value(it).is_some());
            *other != place && joint.role == Role::Driver && !stands
        });
        if let Some((_, (other, _))) = others.next() {
            let finding = Diagnostic::error(
                Code::WrongForm,
                span,
                format!("`{}` moves masses, too", other.label),
            )
            .label("the energy is not that of one driver")
            .also(other.span, "this driver depends on t or an input")
            .help("let the other drivers stand still in this motion");
            self.diagnostics.push(finding);
            return None;
        }
        let rate = self.rate_of_driver(place, 1, span)?;
        let (energy, _) = self.energy_of_all("kinetic_energy")?;
        let square = self.graph.multiply(rate, rate);
        let half = self.graph.divide(energy, square);
        let dimension = match quantity {
            Some(Quantity::Angle) => Dimension::INERTIA,
            _ => Dimension::MASS,
        };
        Some((self.graph.add(half, half), dimension))
    }

    /// Returns the driver in an argument with its quantity; `None` after an error.
    fn driver_in_measure(&mut self, argument: &Expression) -> Option<(usize, Option<Quantity>)> {
        let name = self.name_in_measure(argument, "a driver")?;
        let place = self.driver_named(&name)?;
        Some((place, self.linkage.joints[place].0.kind.value.quantity()))
    }

    /// Returns the driver of this name, and records its use; `None` after an error.
    pub(super) fn driver_named(&mut self, name: &Name) -> Option<usize> {
        let joints = self.linkage.joints.iter().map(|(joint, _)| joint);
        let mut drivers = joints
            .enumerate()
            .filter(|(_, joint)| joint.role == Role::Driver && joint.operands.value.is_some());
        let named = drivers.find(|(_, joint)| joint.name.as_deref() == Some(&name.text));
        let Some((place, driver)) = named else {
            // A driver with an error has been reported.
            if self.declared.drivers.declaration(&name.text).is_some() {
                return None;
            }
            let message = format!("no driver is named `{}`", name.text);
            self.diagnostics.push(
                Diagnostic::error(Code::UnknownName, name.span, message)
                    .label("not declared above")
                    .help("name a driver behind `drive`: `drive crank: phi(1) = 2*t;`"),
            );
            return None;
        };
        if let Some(declaration) = driver.name_span {
            self.note_use(name, declaration);
        }
        Some(place)
    }
}
