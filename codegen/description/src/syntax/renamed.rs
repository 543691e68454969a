//! Prefixes the names in statements of a part: `rod` becomes `stage3_rod`.
//!
//! All names are prefixed except for predefined ones and parameters of curves, so a part is independent of its surroundings.

use std::cell::Cell;
use std::collections::{HashMap, HashSet};

use super::document::{
    Body, Constant, Curve, Drive, Joint, Member, Orientation, Origin, OutputItem, Shape, Statement,
    Table, TablePoints,
};
use super::forces::{Center, Element};
use super::formula::{Component, Direction, Expression, ExpressionKind, Name, Pair, Reference};
use super::reader::{Outcome, Reader};
use super::scope::inside;
use super::{AXES, BUILT_IN};
use crate::diagnostic::Span;

/// Renaming of the names of a part.
pub(super) struct Renaming<'a> {
    reader: &'a Reader<'a>,
    part: &'a str,
    /// Bodies of the part, with their points.
    bodies: HashMap<String, HashSet<String>>,
    /// Functions of the part.
    tables: HashSet<String>,
    /// Parameter of the curve being renamed.
    parameter: Option<String>,
    /// Location of a component along a global axis, or of an angle to it, in the statement being renamed.
    global: Cell<Option<Span>>,
}

impl<'a> Renaming<'a> {
    /// Creates the renaming of a part with these bodies and statements.
    pub(super) fn new(
        reader: &'a Reader<'a>,
        part: &'a str,
        bodies: Vec<(String, HashSet<String>)>,
        own: &[Statement],
    ) -> Renaming<'a> {
        let tables = own.iter().filter_map(|it| match it {
            Statement::Table(table) => Some(table.name.text.clone()),
            _ => None,
        });
        Renaming {
            reader,
            part,
            bodies: bodies.into_iter().collect(),
            tables: tables.collect(),
            parameter: None,
            global: Cell::new(None),
        }
    }

    /// Renames all names in a statement. Returns the location of a component along a global axis, or of an angle to it, in a
    /// formula.
    ///
    /// # Errors
    /// Returns an error if two names would coincide.
    pub(super) fn statement(&mut self, statement: &mut Statement) -> Outcome<Option<Span>> {
        self.global.set(None);
        self.all_of(statement)?;
        Ok(self.global.get())
    }

    fn all_of(&mut self, statement: &mut Statement) -> Outcome<()> {
        match statement {
            Statement::Constant(it)
            | Statement::Angle(it)
            | Statement::Measure(it)
            | Statement::Clearance(it) => self.constant(it),
            Statement::Given(it) | Statement::Parameter(it) | Statement::Input(it) => {
                self.constant(&mut it.constant)?;
                self.formulas(it.range.iter_mut().flatten())?;
                self.formulas(it.tolerance.iter_mut().map(|it| &mut it.extent))
            }
            Statement::Table(table) => self.table(table),
            Statement::Points(points) => points.points.iter_mut().try_for_each(|point| {
                self.name(&mut point.name)?;
                self.pair(&mut point.position)
            }),
            Statement::Body(body) => self.body(body),
            Statement::Joint(joint) => self.joint(joint),
            Statement::Drive(drive) => self.drive(drive),
            Statement::Free(free) => {
                self.name(&mut free.name)?;
                self.drive(&mut free.drive)?;
                self.formulas(&mut free.rate)
            }
            Statement::Equation(equation) => {
                self.names(&mut equation.name)?;
                self.formulas([&mut equation.left, &mut equation.right])
            }
            Statement::Curve(curve) => self.curve(curve),
            Statement::Limit(limit) => {
                self.name(&mut limit.measure)?;
                self.formulas(limit.ends.iter_mut().flatten())
            }
            Statement::Friction(friction) => {
                self.name(&mut friction.joint)?;
                self.formula(&mut friction.coefficient)?;
                self.formulas(&mut friction.radius)?;
                self.formulas(&mut friction.length)
            }
            Statement::Motor(motor) => {
                self.name(&mut motor.driver)?;
                self.formulas(&mut motor.gear)?;
                self.formulas(&mut motor.inertia)?;
                self.formulas(&mut motor.efficiency)
            }
            Statement::Request(request) => {
                self.items(&mut request.items)?;
                self.names(&mut request.names)
            }
            Statement::Mass(mass) => {
                self.body_name(&mut mass.body)?;
                self.formula(&mut mass.mass)?;
                match &mut mass.center {
                    Some(Center::Point(name)) => self.name(name)?,
                    Some(Center::Local(pair)) => self.pair(pair)?,
                    None => {}
                }
                self.formulas(&mut mass.inertia)
            }
            Statement::Gravity(gravity) => self.pair(&mut gravity.acceleration),
            Statement::Element(element) => self.element(element),
            Statement::Force(force) => {
                self.reference(&mut force.point)?;
                self.pair(&mut force.components)?;
                force.frame.iter_mut().try_for_each(|it| self.body_name(it))
            }
            Statement::Torque(torque) => {
                self.body_name(&mut torque.body)?;
                self.formula(&mut torque.value)
            }
            // Not permitted in a part.
            Statement::Units(_) | Statement::Motion(_) => Ok(()),
        }
    }

    fn name(&self, name: &mut Name) -> Outcome<()> {
        let reader = self.reader;
        let spelled = format!(
            "{}.{}",
            reader.spelled(self.part),
            reader.spelled(&name.text)
        );
        name.text = inside(self.part, &name.text);
        reader.spell(name, spelled)
    }

    fn names<'n>(&self, names: impl IntoIterator<Item = &'n mut Name>) -> Outcome<()> {
        names.into_iter().try_for_each(|it| self.name(it))
    }

    /// Renames a body, except for the ground.
    fn body_name(&self, name: &mut Name) -> Outcome<()> {
        match name.text.as_str() {
            "ground" => Ok(()),
            _ => self.name(name),
        }
    }

    /// Renames `NAME`, `BODY.POINT`, `POINT.x` or `BODY.x`.
    fn reference(&self, reference: &mut Reference) -> Outcome<()> {
        let is_component = self.is_component(reference);
        let Some(body) = &mut reference.body else {
            return self.body_name(&mut reference.name);
        };
        self.body_name(body)?;
        match is_component {
            true => Ok(()),
            false => self.name(&mut reference.name),
        }
    }

    /// True for `POINT.x` and `BODY.x`, and false for a point of a body.
    fn is_component(&self, reference: &Reference) -> bool {
        let Some(body) = &reference.body else {
            return false;
        };
        let points = self.bodies.get(&body.text);
        let is_point = points.is_some_and(|it| it.contains(&reference.name.text));
        AXES.contains(&reference.name.text.as_str()) && body.text != "ground" && !is_point
    }

    fn references<'n>(
        &self,
        references: impl IntoIterator<Item = &'n mut Reference>,
    ) -> Outcome<()> {
        references.into_iter().try_for_each(|it| self.reference(it))
    }

    fn direction(&self, direction: &mut Direction) -> Outcome<()> {
        self.references([&mut direction.from, &mut direction.to])
    }

    fn pair(&self, pair: &mut Pair) -> Outcome<()> {
        self.formulas([&mut pair.x, &mut pair.y])
    }

    fn formulas<'n>(&self, formulas: impl IntoIterator<Item = &'n mut Expression>) -> Outcome<()> {
        formulas.into_iter().try_for_each(|it| self.formula(it))
    }

    fn formula(&self, formula: &mut Expression) -> Outcome<()> {
        match &mut formula.kind {
            ExpressionKind::Number { .. } => Ok(()),
            ExpressionKind::Reference(reference) => {
                let name = reference.name.text.as_str();
                let is_fixed = BUILT_IN.contains(&name) || self.parameter.as_deref() == Some(name);
                if reference.body.is_some() && self.is_component(reference) {
                    self.global.set(Some(formula.span));
                }
                match reference.body.is_none() && is_fixed {
                    true => Ok(()),
                    false => self.reference(reference),
                }
            }
            ExpressionKind::Component(component) => {
                let Component { point, .. } = component.as_mut();
                self.global.set(Some(formula.span));
                self.reference(point)
            }
            ExpressionKind::Sum(terms) => self.formulas(terms.iter_mut().map(|it| &mut it.1)),
            ExpressionKind::Product(factors) => {
                self.formulas(factors.iter_mut().map(|it| &mut it.1))
            }
            ExpressionKind::Negative(of) => self.formula(of),
            ExpressionKind::Power(base, exponent) => self.formulas([&mut **base, &mut **exponent]),
            ExpressionKind::Call {
                function,
                arguments,
            } => {
                if self.tables.contains(&function.text) {
                    self.name(function)?;
                } else if AXES.contains(&function.text.as_str()) {
                    self.global.set(Some(formula.span));
                }
                self.formulas(arguments)
            }
            ExpressionKind::Components(parts) => self.formulas(parts),
            ExpressionKind::Choice(choice) => self.formulas([
                &mut choice.left,
                &mut choice.right,
                &mut choice.holds,
                &mut choice.otherwise,
            ]),
        }
    }

    fn constant(&self, constant: &mut Constant) -> Outcome<()> {
        self.name(&mut constant.name)?;
        self.formula(&mut constant.value)
    }

    fn table(&self, table: &mut Table) -> Outcome<()> {
        self.name(&mut table.name)?;
        if let TablePoints::Listed(points) = &mut table.points {
            points.iter_mut().try_for_each(|it| self.pair(it))?;
        }
        match &mut table.ends {
            Some(ends) => self.formulas(&mut ends.slopes),
            None => Ok(()),
        }
    }

    fn body(&self, body: &mut Body) -> Outcome<()> {
        self.name(&mut body.name)?;
        match &mut body.origin {
            Origin::Coordinates(pair) => self.pair(pair)?,
            Origin::Point(reference) => self.reference(reference)?,
        }
        match &mut body.orientation {
            Orientation::Aligned => {}
            Orientation::Angle(angle) => self.formula(angle)?,
            Orientation::Facing(direction) => self.direction(direction)?,
        }
        body.members.iter_mut().try_for_each(|member| match member {
            Member::Local { name, position, .. } => {
                self.name(name)?;
                self.pair(position)
            }
            Member::Carried { name, .. } => self.name(name),
        })
    }

    fn joint(&self, joint: &mut Joint) -> Outcome<()> {
        self.names(&mut joint.name)?;
        self.references(&mut joint.operands)?;
        if let Some(along) = &mut joint.along {
            self.direction(along)?;
        }
        self.formulas(&mut joint.value)?;
        self.formulas(&mut joint.pressure_angle)
    }

    fn drive(&self, drive: &mut Drive) -> Outcome<()> {
        self.names(&mut drive.name)?;
        self.references(&mut drive.operands)?;
        self.formula(&mut drive.value)
    }

    fn curve(&mut self, curve: &mut Curve) -> Outcome<()> {
        self.name(&mut curve.name)?;
        self.body_name(&mut curve.body)?;
        if let Some(range) = &mut curve.range {
            self.formulas(range)?;
        }
        self.parameter = Some(curve.parameter.text.clone());
        let renamed = match &mut curve.shape {
            Shape::Parametric(pair) => self.pair(pair),
            Shape::Polar(radius) => self.formula(radius),
        };
        self.parameter = None;
        renamed
    }

    fn items(&self, items: &mut [OutputItem]) -> Outcome<()> {
        items.iter_mut().try_for_each(|item| match item {
            OutputItem::Point(point) => self.reference(point),
            OutputItem::Coordinate { bodies, .. } => self.references(bodies),
        })
    }

    fn element(&self, element: &mut Element) -> Outcome<()> {
        self.names(&mut element.name)?;
        self.references(&mut element.operands)?;
        self.formula(&mut element.value)?;
        self.formulas(&mut element.free)?;
        self.formulas(&mut element.preload)
    }
}
