//! Writes the constraints of a system in words, and the degrees of freedom that they leave.

use std::fmt::Write as _;

use linkwright_codegen::stages::emit::derivation::constraints_in_html;
use linkwright_codegen::stages::emit::markup::escaped;
use linkwright_codegen::stages::model::Role;
use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::system::System;
use linkwright_solver::Check;

use super::equations::about;

/// Returns the table of constraints and drivers, and the count of degrees of freedom.
pub fn section(pool: &Pool, system: &System, check: &Check) -> String {
    let words = constraints_in_html(pool, system);
    let mut text = String::from("<div class=\"wide\" tabindex=\"0\"><table>\n");
    for (role, title) in [
        (Role::Constraint, "Joints, Φ<sup>K</sup>"),
        (Role::Driver, "Drivers, Φ<sup>D</sup>"),
    ] {
        let of_role = |joint: usize| system.mechanism.joints[joint].role == role;
        let joints = (0..system.mechanism.joints.len()).filter(|&joint| of_role(joint));
        let mut rows = String::new();
        for joint in joints {
            let labeled = &system.mechanism.joints[joint];
            let count = system.rows.iter().filter(|row| row.joint == joint).count();
            let docs = match labeled.docs.is_empty() {
                true => String::new(),
                false => format!("<br><small>{}</small>", escaped(&labeled.docs.join(" "))),
            };
            let _ = writeln!(
                rows,
                "<tr {} tabindex=\"0\"><td><code>{}</code>{docs}</td><td>{}.</td><td class=\"count\">{count}</td></tr>",
                about(system, joint, None),
                escaped(&labeled.label.replace("->", "→")),
                capitalized(&words[joint]),
            );
        }
        if !rows.is_empty() {
            let _ = writeln!(
                text,
                "<tbody><tr><th>{title}</th><th>In words</th><th>Equations</th></tr>\n{rows}</tbody>"
            );
        }
    }
    text += "</table></div>\n";
    let coordinates = system.coordinates.len();
    let constraints = coordinates as i64 - check.kinematic_freedom;
    let drivers = check.kinematic_freedom - check.net_freedom;
    let _ = writeln!(
        text,
        "<p class=\"freedom\">Kinematic degrees of freedom: <b>KDOF</b> = {coordinates} coordinates − {constraints} equations of joints = <b>{}</b>. \
         As many independent driver equations determine the motion. Net degrees of freedom: <b>NDOF</b> = {} − {drivers} {} = <b>{}</b>.</p>",
        check.kinematic_freedom,
        check.kinematic_freedom,
        if drivers == 1 {
            "driver equation"
        } else {
            "driver equations"
        },
        check.net_freedom
    );
    text
}

/// Capitalizes the first letter of words that may begin with a tag.
fn capitalized(words: &str) -> String {
    let mut letters = words.chars();
    match letters.next() {
        Some(first) if first != '<' => first.to_uppercase().chain(letters).collect(),
        _ => words.to_string(),
    }
}
