//! Finds the roles of the formulas of a document: those that give the mechanism a length or an angle, and those that
//! take one from it.
//!
//! Everything between the two is left alone, so that a rewriting can ignore constants, laws, tables and units.

use linkwright_codegen::stages::syntax::{
    Body, Center, Curve, Document, Drive, Equation, Expression, ExpressionKind, Joint, Member,
    Orientation, Origin, Pair, Shape, Statement,
};

/// Quantity that a formula gives to the mechanism.
#[derive(Clone, Copy, Debug)]
pub enum Given<'a> {
    /// Position in the global frame.
    Place(&'a Pair),
    /// Position in the frame of a body, or a distance vector.
    Vector(&'a Pair),
    /// Global abscissa.
    X(&'a Expression),
    /// Global ordinate.
    Y(&'a Expression),
    /// Difference of two global coordinates.
    Component(&'a Expression),
    /// Angle of a body.
    Angle(&'a Expression),
    /// Body whose frame is parallel to the global one: its orientation is omitted after this position.
    Aligned(&'a Body),
    /// Distance.
    Length(&'a Expression),
    /// Both sides of an equation of the user.
    Sides(&'a Equation),
}

/// Quantity that a formula takes from the mechanism or its design configuration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Taken {
    /// A distance.
    Distance,
    /// An abscissa.
    X,
    /// An ordinate.
    Y,
    /// The angle of a body.
    Angle,
}

/// Calls `visit` with every quantity given, in written order.
pub fn each_given<'a>(document: &'a Document, visit: &mut dyn FnMut(Given<'a>)) {
    statements(&document.mechanism.statements, visit);
}

fn statements<'a>(all: &'a [Statement], visit: &mut dyn FnMut(Given<'a>)) {
    for statement in all {
        match statement {
            Statement::Points(points) => {
                for point in &points.points {
                    visit(Given::Place(&point.position));
                }
            }
            Statement::Body(body) => of_body(body, visit),
            Statement::Joint(joint) => of_joint(joint, visit),
            Statement::Drive(drive) => of_drive(drive, visit),
            Statement::Free(free) => of_drive(&free.drive, visit),
            Statement::Equation(equation) => of_equation(equation, visit),
            Statement::Curve(curve) => of_curve(curve, visit),
            Statement::Motion(motion) => statements(&motion.statements, visit),
            Statement::Friction(friction) => {
                let lengths = friction.radius.iter().chain(&friction.length);
                lengths.for_each(|it| visit(Given::Length(it)));
            }
            Statement::Constant(_)
            | Statement::Given(_)
            | Statement::Angle(_)
            | Statement::Parameter(_)
            | Statement::Input(_)
            | Statement::Table(_)
            | Statement::Measure(_)
            | Statement::Limit(_)
            | Statement::Clearance(_)
            | Statement::Motor(_)
            | Statement::Request(_)
            | Statement::Mass(_)
            | Statement::Gravity(_)
            | Statement::Element(_)
            | Statement::Force(_)
            | Statement::Torque(_)
            | Statement::Units(_) => {}
        }
    }
}

/// True if an expression is a position.
fn is_place(written: &Expression) -> bool {
    matches!(written.kind, ExpressionKind::Components(_))
}

/// Both sides, or the components and the length of a rod.
fn of_equation<'a>(equation: &'a Equation, visit: &mut dyn FnMut(Given<'a>)) {
    let places = |side: &'a Expression| match &side.kind {
        ExpressionKind::Call { arguments, .. } if arguments.iter().all(is_place) => {
            arguments.as_slice()
        }
        _ => &[],
    };
    let components = |end: &'a Expression| match &end.kind {
        ExpressionKind::Components(parts) => parts.as_slice(),
        _ => &[],
    };
    let (left, right) = (places(&equation.left), places(&equation.right));
    let length = match [left.is_empty(), right.is_empty()] {
        [false, true] => &equation.right,
        [true, false] => &equation.left,
        _ => return visit(Given::Sides(equation)),
    };
    for part in left.iter().chain(right).flat_map(components) {
        visit(Given::Length(part));
    }
    visit(Given::Length(length));
}

fn of_body<'a>(body: &'a Body, visit: &mut dyn FnMut(Given<'a>)) {
    if let Origin::Coordinates(place) = &body.origin {
        visit(Given::Place(place));
    }
    match &body.orientation {
        Orientation::Aligned => visit(Given::Aligned(body)),
        Orientation::Angle(angle) => visit(Given::Angle(angle)),
        Orientation::Facing(_) => {}
    }
    for member in &body.members {
        if let Member::Local { position, .. } = member {
            visit(Given::Vector(position));
        }
    }
}

fn of_joint<'a>(joint: &'a Joint, visit: &mut dyn FnMut(Given<'a>)) {
    let Some(value) = &joint.value else { return };
    visit(match joint.kind.text.as_str() {
        "absolute_x" => Given::X(value),
        "absolute_y" => Given::Y(value),
        "absolute_angle" => Given::Angle(value),
        "relative_x" | "relative_y" => Given::Component(value),
        "absolute_distance"
        | "relative_distance"
        | "revolute_revolute"
        | "revolute_translational"
        | "rack"
        | "roller" => Given::Length(value),
        "relative_angle" | "external_gear" | "internal_gear" | "belt" | "crossed_belt" => return,
        other => panic!("what the value of `{other}` says is not known here"),
    });
}

fn of_drive<'a>(drive: &'a Drive, visit: &mut dyn FnMut(Given<'a>)) {
    let value = &drive.value;
    visit(match drive.quantity.text.as_str() {
        "x" => Given::X(value),
        "y" => Given::Y(value),
        "phi" => Given::Angle(value),
        "relative_x" | "relative_y" => Given::Component(value),
        "length" | "distance" => Given::Length(value),
        "relative_angle" => return,
        other => panic!("what `drive {other}` says is not known here"),
    });
}

fn of_curve<'a>(curve: &'a Curve, visit: &mut dyn FnMut(Given<'a>)) {
    match &curve.shape {
        // The frame of the ground is the global one.
        Shape::Parametric(pair) if curve.body.text == "ground" => visit(Given::Place(pair)),
        Shape::Parametric(pair) => visit(Given::Vector(pair)),
        Shape::Polar(radius) => {
            assert_ne!(
                curve.body.text, "ground",
                "a polar curve turns about the origin"
            );
            visit(Given::Length(radius));
        }
    }
}

/// Calls `visit` with every quantity that a formula takes. `live` is true in an equation, which may mention
/// coordinates.
pub fn each_taken<'a>(
    expression: &'a Expression,
    live: bool,
    visit: &mut dyn FnMut(&'a Expression, Taken),
) {
    let axis = |text: &str| match text {
        "x" => Some(Taken::X),
        "y" => Some(Taken::Y),
        "phi" => Some(Taken::Angle),
        _ => None,
    };
    match &expression.kind {
        ExpressionKind::Number { .. } => {}
        ExpressionKind::Reference(reference) => {
            if live
                && reference.body.is_some()
                && let Some(taken) = axis(&reference.name.text)
            {
                visit(expression, taken);
            }
        }
        ExpressionKind::Component(component) => {
            if let Some(taken) = axis(&component.axis.text) {
                visit(expression, taken);
            }
        }
        ExpressionKind::Sum(terms) => {
            for (_, term) in terms {
                each_taken(term, live, visit);
            }
        }
        ExpressionKind::Product(factors) => {
            for (_, factor) in factors {
                each_taken(factor, live, visit);
            }
        }
        ExpressionKind::Negative(inner) => each_taken(inner, live, visit),
        ExpressionKind::Power(base, exponent) => {
            each_taken(base, live, visit);
            each_taken(exponent, live, visit);
        }
        ExpressionKind::Call {
            function,
            arguments,
        } => match function.text.as_str() {
            "distance" if !arguments.iter().any(is_place) => {
                visit(expression, Taken::Distance);
            }
            name if live && axis(name).is_some() => {
                visit(expression, axis(name).expect("just seen"));
            }
            _ => {
                for argument in arguments {
                    each_taken(argument, live, visit);
                }
            }
        },
        ExpressionKind::Components(parts) => {
            for part in parts {
                each_taken(part, live, visit);
            }
        }
        ExpressionKind::Choice(choice) => {
            for part in [
                &choice.left,
                &choice.right,
                &choice.holds,
                &choice.otherwise,
            ] {
                each_taken(part, live, visit);
            }
        }
    }
}

/// Calls `visit` with every formula of a document as a whole, and whether it stands in an equation.
pub fn each_formula<'a>(all: &'a [Statement], visit: &mut dyn FnMut(&'a Expression, bool)) {
    let pair = |pair: &'a Pair, visit: &mut dyn FnMut(&'a Expression, bool)| {
        visit(&pair.x, false);
        visit(&pair.y, false);
    };
    for statement in all {
        match statement {
            Statement::Constant(it) | Statement::Angle(it) | Statement::Clearance(it) => {
                visit(&it.value, false);
            }
            Statement::Measure(it) => visit(&it.value, true),
            Statement::Given(it) | Statement::Parameter(it) | Statement::Input(it) => {
                visit(&it.constant.value, false);
                for end in it.range.iter().flatten() {
                    visit(end, false);
                }
                if let Some(tolerance) = &it.tolerance {
                    visit(&tolerance.extent, false);
                }
            }
            Statement::Points(points) => {
                for point in &points.points {
                    pair(&point.position, visit);
                }
            }
            Statement::Body(body) => {
                if let Origin::Coordinates(place) = &body.origin {
                    pair(place, visit);
                }
                if let Orientation::Angle(angle) = &body.orientation {
                    visit(angle, false);
                }
                for member in &body.members {
                    if let Member::Local { position, .. } = member {
                        pair(position, visit);
                    }
                }
            }
            Statement::Joint(joint) => {
                for part in joint.value.iter().chain(&joint.pressure_angle) {
                    visit(part, false);
                }
            }
            Statement::Drive(drive) => visit(&drive.value, false),
            Statement::Free(free) => {
                visit(&free.drive.value, false);
                free.rate.iter().for_each(|rate| visit(rate, false));
            }
            Statement::Equation(equation) => {
                visit(&equation.left, true);
                visit(&equation.right, true);
            }
            Statement::Curve(curve) => {
                for end in curve.range.iter().flatten() {
                    visit(end, false);
                }
                match &curve.shape {
                    Shape::Parametric(place) => pair(place, visit),
                    Shape::Polar(radius) => visit(radius, false),
                }
            }
            Statement::Motion(motion) => each_formula(&motion.statements, visit),
            Statement::Mass(mass) => {
                visit(&mass.mass, false);
                if let Some(Center::Local(place)) = &mass.center {
                    pair(place, visit);
                }
                mass.inertia.iter().for_each(|it| visit(it, false));
            }
            Statement::Gravity(gravity) => pair(&gravity.acceleration, visit),
            Statement::Element(element) => {
                let formulas = [
                    Some(&element.value),
                    element.free.as_ref(),
                    element.preload.as_ref(),
                ];
                formulas
                    .into_iter()
                    .flatten()
                    .for_each(|it| visit(it, false));
            }
            Statement::Force(force) => {
                visit(&force.components.x, true);
                visit(&force.components.y, true);
            }
            Statement::Torque(torque) => visit(&torque.value, true),
            Statement::Limit(limit) => {
                limit.ends.iter().flatten().for_each(|it| visit(it, false));
            }
            Statement::Friction(friction) => {
                visit(&friction.coefficient, false);
                let others = friction.radius.iter().chain(&friction.length);
                others.for_each(|it| visit(it, false));
            }
            Statement::Motor(motor) => {
                let formulas = [&motor.gear, &motor.inertia, &motor.efficiency];
                let formulas = formulas.into_iter().flatten();
                formulas.for_each(|it| visit(it, false));
            }
            // Its points are numbers.
            Statement::Table(_) | Statement::Request(_) | Statement::Units(_) => {}
        }
    }
}
