//! Rewrites a description with the two bodies of each joint exchanged.

use linkwright_codegen::stages::syntax::{Direction, Document, Drive, Joint, Reference, Statement};

use super::edits::Edits;

/// Kinds of joints that are left alone: their two bodies have different roles.
pub const ONE_SIDED: [&str; 10] = [
    "absolute_x",
    "absolute_y",
    "absolute_angle",
    "absolute_distance",
    "point_on_line",
    "revolute_translational",
    "point_on_curve",
    "roller",
    "flat",
    "rack",
];

/// Puts body j first in every joint or driver that is symmetric in i and j.
///
/// # Panics
/// On a kind of joint with unknown symmetry.
pub fn swapped(text: &str, document: &Document) -> String {
    let mut edits = Edits::default();
    let lines = lines(&document.mechanism.statements);
    statements(text, &document.mechanism.statements, &lines, &mut edits);
    edits.apply(text)
}

/// Lines of the joints that can be reversed, and along which they are driven.
fn lines(statements: &[Statement]) -> Vec<&Direction> {
    let joints = statements.iter().filter_map(|statement| match statement {
        Statement::Joint(joint) => Some(joint),
        _ => None,
    });
    joints
        .filter(|joint| joint.kind.text == "translational")
        .filter_map(|joint| joint.along.as_ref())
        .collect()
}

fn statements(text: &str, all: &[Statement], lines: &[&Direction], edits: &mut Edits) {
    for statement in all {
        match statement {
            Statement::Joint(joint) => of_joint(text, joint, edits),
            Statement::Drive(drive) => of_drive(text, drive, lines, edits),
            Statement::Free(free) => of_drive(text, &free.drive, lines, edits),
            Statement::Motion(motion) => {
                let mut inside = lines.to_vec();
                inside.extend(self::lines(&motion.statements));
                statements(text, &motion.statements, &inside, edits);
            }
            _ => {}
        }
    }
}

fn exchange(text: &str, first: &Reference, second: &Reference, edits: &mut Edits) {
    edits.replace(first.span, &text[second.span.range()]);
    edits.replace(second.span, &text[first.span.range()]);
}

fn of_joint(text: &str, joint: &Joint, edits: &mut Edits) {
    let kind = joint.kind.text.as_str();
    if ONE_SIDED.contains(&kind) {
        return;
    }
    let [first, second, ..] = &joint.operands[..] else {
        panic!("`{kind}` has fewer than two operands");
    };
    exchange(text, first, second, edits);
    if let Some(along) = &joint.along {
        exchange(text, &along.from, &along.to, edits);
    }
    let Some(value) = &joint.value else { return };
    match kind {
        "relative_x" | "relative_y" | "relative_angle" => edits.enclose(value.span, "*(-1)"),
        "external_gear" | "internal_gear" | "belt" | "crossed_belt" => {
            edits.enclose(value.span, "^(-1)");
        }
        "relative_distance" | "revolute_revolute" => {}
        other => panic!("what `{other}` says of j and i is not known here"),
    }
}

fn of_drive(text: &str, drive: &Drive, lines: &[&Direction], edits: &mut Edits) {
    let [first, second] = &drive.operands[..] else {
        return;
    };
    let same = |a: &Reference, b: &Reference| text[a.span.range()] == text[b.span.range()];
    match drive.quantity.text.as_str() {
        "distance" => exchange(text, first, second, edits),
        "relative_x" | "relative_y" | "relative_angle" => {
            exchange(text, first, second, edits);
            edits.enclose(drive.value.span, "*(-1)");
        }
        "length"
            if lines
                .iter()
                .any(|line| same(&line.from, first) && same(&line.to, second)) =>
        {
            exchange(text, first, second, edits);
        }
        _ => {}
    }
}
