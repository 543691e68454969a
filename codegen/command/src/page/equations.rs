//! Writes Φ, Φ_q, Φ_t, γ and the points of a system in MathML.

use std::fmt::Write as _;

use linkwright_codegen::stages::emit::markup::escaped;
use linkwright_codegen::stages::emit::mathml::{Equation, Equations, equations, lines};
use linkwright_codegen::stages::model::Joint;
use linkwright_codegen::stages::system::{Derived, System};

/// Largest number of columns of a matrix that is shown whole; nonzero entries of wider ones are listed.
pub const LARGEST_MATRIX: usize = 9;

/// Returns the equations as a section.
pub fn section(derived: &Derived) -> String {
    let system = &derived.system;
    let listed = equations(derived);
    let names: Vec<&str> = listed.coordinates.iter().map(|it| it[0].as_str()).collect();
    let mut text = format!(
        "<p><math><mi mathvariant=\"normal\" class=\"bold\">q</mi></math> = ({})</p>\n",
        names
            .iter()
            .map(|it| format!("<math>{it}</math>"))
            .collect::<Vec<_>>()
            .join(", ")
    );
    let units = system.mechanism.units.of_messages();
    if !(units.of("m").is_si() && units.of("rad").is_si()) {
        text += "<p>Equations are in SI units: m, rad, kg and s.</p>\n";
    }
    text += "<h3 id=\"phi\">Constraint equations Φ(q, t) = 0</h3>\n";
    text += &rows(
        system,
        &listed,
        &|row| Some(row.residual.as_str()),
        "<mo>=</mo><mn>0</mn>",
    );
    text += "<h3 id=\"phi-q\">Jacobian Φ<sub>q</sub> = ∂Φ/∂q</h3>\n";
    text += &match names.len() <= LARGEST_MATRIX {
        true => matrix(system, &listed, &names),
        false => entries(system, &listed, &names),
    };
    text += "<h3 id=\"phi-t\">Φ<sub>t</sub> = ∂Φ/∂t, for the velocities: Φ<sub>q</sub> q̇ = −Φ<sub>t</sub></h3>\n";
    text += &rows(system, &listed, &|row| row.time_derivative.as_deref(), "");
    text += "<h3 id=\"gamma\">γ, for the accelerations: Φ<sub>q</sub> q̈ = γ</h3>\n";
    text += &rows(system, &listed, &|row| row.gamma.as_deref(), "");
    if !listed.monitored.is_empty() {
        text += "<h3>Redundant equations, monitored but not solved</h3>\n";
        for (joint, residual) in &listed.monitored {
            text += &equation(
                &about(system, *joint, None),
                "",
                residual,
                &label(system, *joint),
            );
        }
    }
    for (cause, entries) in &listed.directions {
        let _ = writeln!(
            text,
            "<h3>Partial derivative of Φ with respect to <code>{}</code></h3>",
            escaped(cause)
        );
        for (row, entry) in entries {
            let joint = listed.rows[*row].joint;
            text += &equation(
                &about(system, joint, Some(*row)),
                &numbered(*row),
                entry,
                &label(system, joint),
            );
        }
    }
    if !listed.points.is_empty() {
        text += "<h3 id=\"points\">Points</h3>\n";
        for (place, (name, position)) in listed.points.iter().enumerate() {
            for (axis, value) in ["x", "y"].iter().zip(position) {
                let left = format!(
                    "<msub><mi>{axis}</mi><mi mathvariant=\"normal\">{}</mi></msub><mo>=</mo>",
                    escaped(name)
                );
                let of = format!("data-is=\"p{place}\"");
                text += &equation(&of, "", &format!("{left}{value}"), "");
            }
        }
    }
    if !listed.definitions.is_empty() {
        text += "<h3>where</h3>\n";
        for definition in &listed.definitions {
            let row = format!("{}<mo>=</mo>{}", definition.name, definition.value);
            text += &equation("", "", &row, "");
        }
    }
    text
}

/// Returns the attributes of an element that belongs to a joint.
pub fn about(system: &System, joint: usize, row: Option<usize>) -> String {
    let bodies = moved(&system.mechanism.joints[joint]);
    let bodies: Vec<String> = bodies.iter().map(|it| format!("b{it}")).collect();
    let is = row.map_or(String::new(), |row| format!(" e{row}"));
    format!("data-is=\"j{joint}{is}\" data-of=\"{}\"", bodies.join(" "))
}

/// Returns the moving bodies of a joint, each once.
pub fn moved(joint: &Joint) -> Vec<usize> {
    let marks = joint.operands.marks.iter().map(|it| it.frame.body.0);
    let curve = joint.operands.curve.map(|it| it.frame.body.0);
    let mut bodies: Vec<usize> = marks.chain(curve).filter(|it| *it > 0).collect();
    bodies.sort_unstable();
    bodies.dedup();
    bodies
}

fn label(system: &System, joint: usize) -> String {
    escaped(&system.mechanism.joints[joint].label.replace("->", "→"))
}

fn numbered(row: usize) -> String {
    format!("{}", row + 1)
}

/// Returns one equation with its number and its origin, as an element for pointer and keyboard.
fn equation(about: &str, number: &str, row: &str, note: &str) -> String {
    format!(
        "<div class=\"equation\" tabindex=\"0\" {about}><b>{number}</b><span>{}</span><small>{note}</small></div>\n",
        lines(row)
    )
}

/// Returns one line for each nonzero row.
fn rows<'a>(
    system: &System,
    found: &'a Equations,
    of: &dyn Fn(&'a Equation) -> Option<&'a str>,
    end: &str,
) -> String {
    let mut text = String::new();
    let mut zero = 0;
    for (index, row) in found.rows.iter().enumerate() {
        match of(row) {
            Some(formula) => {
                let about = about(system, row.joint, Some(index));
                let formula = format!("{formula}{end}");
                text += &equation(
                    &about,
                    &numbered(index),
                    &formula,
                    &label(system, row.joint),
                );
            }
            None => zero += 1,
        }
    }
    text += match (zero, zero == found.rows.len()) {
        (0, _) => "",
        (_, true) => "<p>All rows are zero.</p>\n",
        _ => "<p>All other rows are zero.</p>\n",
    };
    text
}

/// Returns Φ_q as a table with the names of its rows and columns.
fn matrix(system: &System, found: &Equations, names: &[&str]) -> String {
    let mut text = String::from("<div class=\"wide\"><table class=\"matrix\"><thead><tr><th></th>");
    for name in names {
        let _ = write!(text, "<th><math>{name}</math></th>");
    }
    text += "</tr></thead><tbody>\n";
    for (index, row) in found.rows.iter().enumerate() {
        let _ = write!(
            text,
            "<tr {}><th>{}</th>",
            about(system, row.joint, Some(index)),
            index + 1
        );
        for coordinate in 0..names.len() {
            let entry = row.jacobian.iter().find(|it| it.coordinate == coordinate);
            match entry {
                Some(entry) => {
                    let _ = write!(text, "<td><math>{}</math></td>", entry.value);
                }
                None => text += "<td class=\"zero\">0</td>",
            }
        }
        text += "</tr>\n";
    }
    text + "</tbody></table></div>\n"
}

/// Returns the nonzero entries of Φ_q.
fn entries(system: &System, found: &Equations, names: &[&str]) -> String {
    let mut text = String::from("<p>Nonzero entries, row by row:</p>\n");
    for (index, row) in found.rows.iter().enumerate() {
        let entries = row.jacobian.iter().map(|entry| {
            format!(
                "<span class=\"entry\"><math><mfrac><mrow><mo>∂</mo><msub><mi mathvariant=\"normal\">Φ</mi><mn>{}</mn></msub></mrow><mrow><mo>∂</mo>{}</mrow></mfrac><mo>=</mo></math> {}</span>",
                index + 1,
                names[entry.coordinate],
                lines(&entry.value)
            )
        });
        let _ = writeln!(
            text,
            "<div class=\"equation\" tabindex=\"0\" {}><b>{}</b><span>{}</span><small>{}</small></div>",
            about(system, row.joint, Some(index)),
            index + 1,
            entries.collect::<Vec<_>>().join(" "),
            label(system, row.joint)
        );
    }
    text
}
