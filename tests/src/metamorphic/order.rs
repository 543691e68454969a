//! Rewrites a description with its bodies and joints in another order.

use linkwright_codegen::stages::syntax::{
    Body, Document, Drive, Orientation, Origin, Reference, Statement,
};

use crate::random::Random;

/// Puts bodies, joints, drivers and equations into an order that follows from `seed`; declarations stay above their
/// uses.
pub fn reordered(text: &str, document: &Document, seed: u64) -> String {
    let mut random = Random::new(seed);
    let mechanism = &document.mechanism;
    let inside = ordered(text, &mechanism.statements, &mut random);
    let name = &mechanism.name.text;
    format!("mechanism {name} {{\n{inside}}}\n")
}

fn shuffled<'a, T>(items: impl Iterator<Item = &'a T>, random: &mut Random) -> Vec<&'a T> {
    let mut items: Vec<&T> = items.collect();
    for place in (1..items.len()).rev() {
        items.swap(place, (random.bits() % (place as u64 + 1)) as usize);
    }
    items
}

/// Items in an order in which none comes before an item that it needs. `needs(a, b)` is true if a needs b.
fn settled<T>(mut waiting: Vec<&T>, needs: impl Fn(&T, &T) -> bool) -> Vec<&T> {
    let mut done = Vec::new();
    while !waiting.is_empty() {
        let free = |item: &&T| !waiting.iter().any(|other| needs(item, other));
        let next = waiting
            .iter()
            .position(free)
            .expect("what is declared above its use has no cycles");
        done.push(waiting.remove(next));
    }
    done
}

fn ordered(text: &str, statements: &[Statement], random: &mut Random) -> String {
    let mut written = String::new();
    let mut write = |statement: &Statement| {
        written.push_str("    ");
        written.push_str(&text[statement.span().range()]);
        written.push('\n');
    };
    let is_declaration = |it: &&Statement| {
        matches!(
            it,
            Statement::Constant(_)
                | Statement::Given(_)
                | Statement::Parameter(_)
                | Statement::Input(_)
                | Statement::Table(_)
                | Statement::Points(_)
        )
    };
    let is_body = |it: &&Statement| matches!(it, Statement::Body(_) | Statement::Angle(_));
    let is_curve = |it: &&Statement| matches!(it, Statement::Curve(_));
    let is_constraint = |it: &&Statement| {
        matches!(
            it,
            Statement::Joint(_) | Statement::Drive(_) | Statement::Free(_) | Statement::Equation(_)
        )
    };
    statements
        .iter()
        .filter(is_declaration)
        .for_each(&mut write);
    let bodies = shuffled(statements.iter().filter(is_body), random);
    let bodies = settled(bodies, |item, other| match (item, other) {
        (Statement::Body(item), Statement::Body(other)) => mentions(item, &other.name.text),
        _ => false,
    });
    bodies.into_iter().for_each(&mut write);
    statements.iter().filter(is_curve).for_each(&mut write);
    let constraints = shuffled(statements.iter().filter(is_constraint), random);
    let constraints = settled(constraints, |item, other| match (item, other) {
        (Statement::Drive(drive), Statement::Joint(joint)) => {
            drive.quantity.text == "length"
                && joint
                    .along
                    .as_ref()
                    .is_some_and(|along| measures(text, drive, &along.from, &along.to))
        }
        _ => false,
    });
    constraints.into_iter().for_each(&mut write);
    let is_last = |it: &&Statement| {
        matches!(
            it,
            Statement::Request(_)
                | Statement::Measure(_)
                | Statement::Limit(_)
                | Statement::Clearance(_)
                | Statement::Friction(_)
                | Statement::Motor(_)
                | Statement::Mass(_)
                | Statement::Gravity(_)
                | Statement::Element(_)
                | Statement::Force(_)
                | Statement::Torque(_)
                | Statement::Units(_)
        )
    };
    statements.iter().filter(is_last).for_each(&mut write);
    for statement in statements {
        if let Statement::Motion(motion) = statement {
            let inside = ordered(text, &motion.statements, random);
            written.push_str(&format!("motion {} {{\n{inside}}}\n", motion.name.text));
        }
    }
    written
}

/// True if the estimate of a body names a point of another one.
fn mentions(body: &Body, name: &str) -> bool {
    let of = |reference: &Reference| reference.body.as_ref().is_some_and(|it| it.text == name);
    let origin = matches!(&body.origin, Origin::Point(reference) if of(reference));
    let facing = matches!(&body.orientation, Orientation::Facing(it) if of(&it.from) || of(&it.to));
    origin || facing
}

fn measures(text: &str, drive: &Drive, from: &Reference, to: &Reference) -> bool {
    let written = |reference: &Reference| &text[reference.span.range()];
    let [first, second] = &drive.operands[..] else {
        return false;
    };
    written(first) == written(from) && written(second) == written(to)
}
