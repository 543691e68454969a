//! Names mean in an editor what they mean in the equations.

use linkwright_codegen::diagnostic::{Diagnostics, Source};
use linkwright_codegen::read;
use linkwright_codegen::stages::syntax::parse;
use linkwright_command::language_server::names::Names;

/// Requires that a use refers to the declarations at these places, each given by the text that begins there.
fn refers(text: &str, used: &str, declared: &[&str]) {
    let source = Source::new("text", text);
    if let Err(found) = read(&source) {
        panic!("{}", found.render(&source));
    }
    let document = parse(&source, &mut Diagnostics::new()).expect("a document");
    let names = Names::of(&document, text);
    let offset = |part: &str| text.find(part).unwrap_or_else(|| panic!("no `{part}`"));
    let mention = names.mention_at(offset(used));
    let symbols = mention
        .iter()
        .flat_map(|mention| names.mentioned_at(mention.span));
    let mut places: Vec<usize> = symbols
        .map(|it| names.symbols[it].declared.start as usize)
        .collect();
    places.sort_unstable();
    places.dedup();
    let expected: Vec<usize> = declared.iter().map(|it| offset(it)).collect();
    assert_eq!(places, expected, "`{used}` in\n{text}");
}

/// A crank with these statements before those of its joint.
fn crank(statements: &str) -> String {
    format!(
        "mechanism m {{\n    point O = (0, 0);\n    body rod at O {{ O }}\n    revolute O(ground, rod);\n{statements}\n}}\n"
    )
}

/// No body carries the point `tip`, so a load and a driver act on the body of this name.
#[test]
fn a_body_precedes_a_point_of_the_ground() {
    let text = "mechanism m {
    point O = (0, 0), tip = (5m, 5m);
    body tip at (1m, 0) { Q: (0, 0) }
    absolute_angle(tip) = 0;
    absolute_y(tip) = 0;
    mass tip = 2kg;
    force on tip = (1N, 0);
    drive tip.x = 1m + t;
    effort;
}
";
    refers(text, "tip = (1N", &["tip at"]);
    refers(text, "tip.x", &["tip at"]);
}

/// A motion follows all statements outside of motions, also those below it.
#[test]
fn a_motion_uses_statements_below_it() {
    let text = "mechanism m {
    point O = (0, 0), P = (1m, 0);
    body rod at O { O, A: (0, 0) }
    body block at P { Q: (0, 0) }
    revolute O(ground, rod);
    motion turn { drive phi(rod) = speed*t; drive length(A, Q) = 1m + t; }
    const speed = 2;
    translational (rod, block) along A -> Q;
}
";
    refers(text, "speed*t", &["speed = 2"]);
    refers(text, "A, Q) = 1m", &["A: (0, 0)"]);
    refers(text, "Q) = 1m", &["Q: (0, 0)"]);
}

/// A request outside of motions applies to every motion.
#[test]
fn a_request_names_a_joint_of_every_motion() {
    let text = "mechanism m {
    point P = (-1m, 0);
    body rod at (0, 0) { A: (0, 0) }
    mass rod = 1kg;
    gravity = (0, -9.81);
    motion one { translational guide(ground, rod) along P -> A; drive length(P, A) = 1m + t; }
    motion two { translational guide(rod, ground) along A -> P; drive length(A, P) = 1m + t; }
    reaction guide;
}
";
    refers(
        text,
        "guide;",
        &["guide(ground, rod)", "guide(rod, ground)"],
    );
}

#[test]
fn a_request_names_an_equation() {
    let text = "mechanism m {
    point O = (0, 0);
    body rod at O { O }
    body block at (2m, 0) { B: (0, 0) }
    revolute O(ground, rod);
    absolute_angle(block) = 0;
    absolute_y(block) = 0;
    equation link: x(block) = 2m + 0.1m*phi(rod);
    mass block = 2kg;
    drive phi(rod) = t;
    reaction link;
}
";
    refers(text, "link;", &["link: x"]);
}

/// A unit follows a number with a unit, without a blank, and names no value.
#[test]
fn a_name_is_a_unit_only_behind_a_unit() {
    let angles = crank(
        "    angle s = 0.1;\n    angle m = 0.2;\n    equation first: s = 2*phi(rod);\n    equation second: 3*m = phi(rod) + 0.55;\n    mass rod = 2kg;\n    gravity = (0, -9.81m/s^2);\n    drive phi(rod) = 0.05 + t;\n    effort;",
    );
    refers(&angles, "m = phi", &["m = 0.2"]);
    refers(&angles, "s^2", &[]);
    let curve = crank(
        "    curve rim(m) on rod = (20mm + 1mm*m, 2mm*sin(m));\n    body wheel at (20mm, 0) { T: (0, 0) }\n    absolute_angle(wheel) = 0;\n    absolute_x(wheel) = 20mm;\n    point_on_curve (wheel.T, rim);\n    drive phi(rod) = t;",
    );
    refers(&curve, "m, 2mm", &["m) on"]);
}

/// `x`, `y` and `rate` are functions of bodies in an equation or a load, and names of tables elsewhere.
#[test]
fn a_table_may_have_the_name_of_a_coordinate() {
    let text = crank(
        "    table y = [(0, 0), (1, 1), (2, 4), (3, 9)];\n    table rate = [(0, 0), (1, 1), (2, 4), (3, 9)];\n    mass rod = 1kg;\n    torque on rod = -2*rate(phi(rod));\n    drive phi(rod) = y(t) + 0*rate(t);\n    effort;",
    );
    refers(&text, "y(t)", &["y = ["]);
    refers(&text, "rate(t)", &["rate = ["]);
    refers(&text, "rate(phi", &[]);
}
