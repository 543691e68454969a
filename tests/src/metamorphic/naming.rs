//! Rewrites a description with other names for everything that it names.

use std::collections::BTreeMap;

use linkwright_codegen::stages::syntax::{
    Center, Document, Drive, Expression, ExpressionKind, Joint, Member, Name, Orientation, Origin,
    OutputItem, Reference, Shape, Statement,
};

use super::edits::Edits;
use super::roles::each_formula;
use crate::random::Random;

/// Gives declared items other names, one for each text whatever it names. Their order is another one.
pub fn renamed(text: &str, document: &Document, seed: u64) -> String {
    let mut names = Vec::new();
    declared(&document.mechanism.statements, &mut names);
    names.push(document.mechanism.name.text.clone());
    names.sort();
    names.dedup();
    let mut random = Random::new(seed);
    let mut numbers: Vec<usize> = (0..names.len()).collect();
    for place in (1..numbers.len()).rev() {
        numbers.swap(place, (random.bits() % (place as u64 + 1)) as usize);
    }
    let other: BTreeMap<String, String> = names
        .into_iter()
        .zip(numbers)
        .map(|(name, number)| (name, format!("it_{number}_is")))
        .collect();
    let mut renaming = Renaming {
        other,
        edits: Edits::default(),
    };
    renaming.name(&document.mechanism.name);
    renaming.statements(&document.mechanism.statements);
    each_formula(&document.mechanism.statements, &mut |formula, live| {
        renaming.formula(formula, live);
    });
    renaming.edits.apply(text)
}

/// The names that statements declare.
fn declared(statements: &[Statement], names: &mut Vec<String>) {
    for statement in statements {
        let mut declarations: Vec<&Name> = Vec::new();
        match statement {
            Statement::Constant(it) | Statement::Angle(it) | Statement::Measure(it) => {
                declarations.push(&it.name);
            }
            Statement::Given(it) | Statement::Parameter(it) | Statement::Input(it) => {
                declarations.push(&it.constant.name);
            }
            Statement::Table(it) => declarations.push(&it.name),
            Statement::Points(it) => declarations.extend(it.points.iter().map(|point| &point.name)),
            Statement::Body(body) => {
                declarations.push(&body.name);
                declarations.extend(body.members.iter().filter_map(|member| match member {
                    Member::Local { name, .. } => Some(name),
                    Member::Carried { .. } => None,
                }));
            }
            Statement::Joint(it) => declarations.extend(&it.name),
            Statement::Drive(it) => declarations.extend(&it.name),
            Statement::Free(it) => declarations.push(&it.name),
            Statement::Equation(it) => declarations.extend(&it.name),
            Statement::Curve(it) => declarations.extend([&it.name, &it.parameter]),
            Statement::Motion(motion) => {
                declarations.push(&motion.name);
                declared(&motion.statements, names);
            }
            Statement::Request(_)
            | Statement::Mass(_)
            | Statement::Gravity(_)
            | Statement::Force(_)
            | Statement::Torque(_)
            | Statement::Limit(_)
            | Statement::Clearance(_)
            | Statement::Friction(_)
            | Statement::Motor(_)
            | Statement::Units(_) => {}
            Statement::Element(it) => declarations.extend(&it.name),
        }
        names.extend(declarations.into_iter().map(|name| name.text.clone()));
    }
}

struct Renaming {
    other: BTreeMap<String, String>,
    edits: Edits,
}

impl Renaming {
    fn name(&mut self, name: &Name) {
        // A measure of a motor begins with the name of its driver.
        let end = name.text.find("_motor_").unwrap_or(name.text.len());
        let (driver, measure) = name.text.split_at(end);
        if let Some(other) = self.other.get(driver) {
            self.edits.replace(name.span, format!("{other}{measure}"));
        }
    }

    fn reference(&mut self, reference: &Reference) {
        if let Some(body) = &reference.body {
            self.name(body);
        }
        self.name(&reference.name);
    }

    fn statements(&mut self, statements: &[Statement]) {
        for statement in statements {
            match statement {
                Statement::Constant(it) | Statement::Angle(it) | Statement::Measure(it) => {
                    self.name(&it.name);
                }
                Statement::Given(it) | Statement::Parameter(it) | Statement::Input(it) => {
                    self.name(&it.constant.name);
                }
                Statement::Table(it) => self.name(&it.name),
                Statement::Points(it) => it.points.iter().for_each(|point| self.name(&point.name)),
                Statement::Body(it) => {
                    self.name(&it.name);
                    if let Origin::Point(reference) = &it.origin {
                        self.reference(reference);
                    }
                    if let Orientation::Facing(direction) = &it.orientation {
                        self.reference(&direction.from);
                        self.reference(&direction.to);
                    }
                    for member in &it.members {
                        let (Member::Local { name, .. } | Member::Carried { name, .. }) = member;
                        self.name(name);
                    }
                }
                Statement::Joint(it) => self.joint(it),
                Statement::Drive(it) => self.drive(it),
                Statement::Free(it) => self.drive(&it.drive),
                Statement::Equation(it) => it.name.iter().for_each(|name| self.name(name)),
                Statement::Curve(it) => {
                    self.name(&it.name);
                    self.name(&it.parameter);
                    self.name(&it.body);
                    // Its formulas are visited with all others.
                    let (Shape::Parametric(_) | Shape::Polar(_)) = it.shape;
                }
                Statement::Limit(it) => self.name(&it.measure),
                Statement::Clearance(it) => self.name(&it.name),
                Statement::Friction(it) => self.name(&it.joint),
                Statement::Motor(it) => self.name(&it.driver),
                Statement::Request(it) => {
                    self.items(&it.items);
                    it.names.iter().for_each(|name| self.name(name));
                }
                Statement::Mass(it) => {
                    self.name(&it.body);
                    if let Some(Center::Point(point)) = &it.center {
                        self.name(point);
                    }
                }
                Statement::Element(it) => {
                    it.name.iter().for_each(|name| self.name(name));
                    it.operands.iter().for_each(|it| self.reference(it));
                }
                Statement::Force(it) => {
                    self.reference(&it.point);
                    it.frame.iter().for_each(|name| self.name(name));
                }
                Statement::Torque(it) => self.name(&it.body),
                Statement::Gravity(_) | Statement::Units(_) => {}
                Statement::Motion(it) => {
                    self.name(&it.name);
                    self.statements(&it.statements);
                }
            }
        }
    }

    fn joint(&mut self, joint: &Joint) {
        joint.name.iter().for_each(|name| self.name(name));
        joint.operands.iter().for_each(|it| self.reference(it));
        if let Some(direction) = &joint.along {
            self.reference(&direction.from);
            self.reference(&direction.to);
        }
    }

    fn drive(&mut self, drive: &Drive) {
        drive.name.iter().for_each(|name| self.name(name));
        drive.operands.iter().for_each(|it| self.reference(it));
    }

    fn items(&mut self, items: &[OutputItem]) {
        for item in items {
            match item {
                OutputItem::Point(reference) => self.reference(reference),
                OutputItem::Coordinate { bodies, .. } => {
                    bodies.iter().for_each(|it| self.reference(it));
                }
            }
        }
    }

    fn formula(&mut self, formula: &Expression, live: bool) {
        match &formula.kind {
            ExpressionKind::Number { .. } => {}
            ExpressionKind::Reference(reference) => {
                // The component of a point does not count as a name.
                match (&reference.body, live) {
                    (Some(point), true) if ["x", "y"].contains(&reference.name.text.as_str()) => {
                        self.name(point);
                    }
                    _ => self.reference(reference),
                }
            }
            ExpressionKind::Component(component) => self.reference(&component.point),
            ExpressionKind::Sum(terms) => {
                terms.iter().for_each(|(_, term)| self.formula(term, live))
            }
            ExpressionKind::Product(factors) => factors
                .iter()
                .for_each(|(_, factor)| self.formula(factor, live)),
            ExpressionKind::Negative(inner) => self.formula(inner, live),
            ExpressionKind::Power(base, exponent) => {
                self.formula(base, live);
                self.formula(exponent, live);
            }
            ExpressionKind::Call {
                function,
                arguments,
            } => {
                let of_a_body = live && ["x", "y", "phi"].contains(&function.text.as_str());
                self.name(function);
                for argument in arguments {
                    match &argument.kind {
                        // A body may be called by a number.
                        ExpressionKind::Number { digits, unit: None } if of_a_body => {
                            if let Some(other) = self.other.get(digits) {
                                self.edits.replace(argument.span, other.clone());
                            }
                        }
                        _ => self.formula(argument, live),
                    }
                }
            }
            ExpressionKind::Components(parts) => {
                parts.iter().for_each(|part| self.formula(part, live));
            }
            ExpressionKind::Choice(choice) => {
                for part in [
                    &choice.left,
                    &choice.right,
                    &choice.holds,
                    &choice.otherwise,
                ] {
                    self.formula(part, live);
                }
            }
        }
    }
}
