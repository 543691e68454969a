//! Writes Φ, Φ_q, Φ_t, γ and the points of a system in MathML.

use std::fmt::Write as _;

use linkwright_codegen::stages::emit::inspection::{Entry, Quantity, Section, Subject};
use linkwright_codegen::stages::emit::markup::escaped;
use linkwright_codegen::stages::emit::mathml::{inspection, lines};
use linkwright_codegen::stages::model::Joint;
use linkwright_codegen::stages::system::{Derived, System};

use super::pattern::entries;

/// Largest number of columns of a matrix that is shown whole; nonzero entries of wider ones are listed.
const LARGEST_MATRIX: usize = 9;

/// Returns the equations as a section.
pub fn section(derived: &Derived) -> String {
    let system = &derived.system;
    let inspection = inspection(derived);
    let names: Vec<&str> = inspection.coordinates.iter().map(|it| &*it[0]).collect();
    let listed: Vec<String> = names
        .iter()
        .map(|it| format!("<math>{it}</math>"))
        .collect();
    let mut text = format!(
        "<p class=\"names\"><math><mi mathvariant=\"normal\" class=\"bold\">q</mi></math> = ({})</p>\n",
        listed.join(", ")
    );
    let units = system.mechanism.units.of_messages();
    if !(units.of("m").is_si() && units.of("rad").is_si()) {
        text += "<p>Equations are in SI units: m, rad, kg and s.</p>\n";
    }
    for section in &inspection.sections {
        text += &heading(&section.quantity);
        text += &match section.quantity {
            Quantity::Jacobian if names.len() <= LARGEST_MATRIX => matrix(system, section, &names),
            Quantity::Jacobian => entries(system, section, &names),
            _ => equations(system, section),
        };
    }
    text
}

/// Returns the heading of a section; empty for derivatives, which have one per cause.
fn heading(quantity: &Quantity) -> String {
    match quantity {
        Quantity::Residual => "<h3 id=\"phi\">Constraint equations Φ(q, t) = 0</h3>\n",
        Quantity::Jacobian => "<h3 id=\"phi-q\">Jacobian Φ<sub>q</sub> = ∂Φ/∂q</h3>\n",
        Quantity::TimeDerivative => {
            "<h3 id=\"phi-t\">Φ<sub>t</sub> = ∂Φ/∂t, for the velocities: Φ<sub>q</sub> q̇ = −Φ<sub>t</sub></h3>\n"
        }
        Quantity::Gamma => {
            "<h3 id=\"gamma\">γ, for the accelerations: Φ<sub>q</sub> q̈ = γ</h3>\n"
        }
        Quantity::Drivers => "",
        Quantity::Parameter(name) => return cause(name),
        Quantity::Monitored => "<h3>Redundant equations, monitored but not solved</h3>\n",
        Quantity::Points => "<h3 id=\"points\">Points</h3>\n",
        Quantity::Definitions => "<h3>where</h3>\n",
    }.to_string()
}

/// Returns the heading of the derivatives with respect to a driver or a parameter.
fn cause(name: &str) -> String {
    format!(
        "<h3>Partial derivative of Φ with respect to <code>{}</code></h3>\n",
        escaped(name)
    )
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

/// Returns one equation with its number and its origin, as an element for pointer and keyboard.
fn equation(about: &str, number: &str, formula: &str, note: &str) -> String {
    format!(
        "<div class=\"equation\" tabindex=\"0\" {about}><b>{number}</b><span>{formula}</span><small>{note}</small></div>\n"
    )
}

/// Returns one line per entry, and a remark on rows that are zero.
fn equations(system: &System, section: &Section) -> String {
    let mut text = String::new();
    let mut driver = None;
    let mut previous = None;
    for Entry { subject, value } in &section.entries {
        let line = match subject {
            Subject::Row(row) | Subject::Slope(row, _) => {
                let joint = system.rows[*row].joint;
                if section.quantity == Quantity::Drivers && driver.replace(joint) != Some(joint) {
                    text += &cause(&system.mechanism.joints[joint].label);
                    previous = None;
                }
                let end = match section.quantity {
                    Quantity::Residual => "<mo>=</mo><mn>0</mn>",
                    _ => "",
                };
                let is_first = previous.replace(joint) != Some(joint);
                numbered(system, *row, is_first, &lines(&format!("{value}{end}")))
            }
            Subject::Redundant(joint) => equation(
                &about(system, *joint, None),
                "",
                &lines(value),
                &label(system, *joint),
            ),
            Subject::Point(point, axis) => {
                let (name, axis) = (escaped(&system.outputs[*point].name), ["x", "y"][*axis]);
                let row = format!(
                    "<msub><mi>{axis}</mi><mi mathvariant=\"normal\">{name}</mi></msub><mo>=</mo>{value}"
                );
                equation(&format!("data-is=\"p{point}\""), "", &lines(&row), "")
            }
            Subject::Name(name) => {
                equation("", "", &lines(&format!("{name}<mo>=</mo>{value}")), "")
            }
        };
        text += &line;
    }
    let is_partial = matches!(section.quantity, Quantity::TimeDerivative | Quantity::Gamma)
        && section.entries.len() < system.rows.len();
    text += match is_partial {
        false => "",
        true if section.entries.is_empty() => "<p>All rows are zero.</p>\n",
        true => "<p>All other rows are zero.</p>\n",
    };
    text
}

/// Returns an equation with the number of its row; the first one of a joint has its label.
pub fn numbered(system: &System, row: usize, is_first: bool, formula: &str) -> String {
    let joint = system.rows[row].joint;
    let about = about(system, joint, Some(row));
    let label = match is_first {
        true => label(system, joint),
        false => String::new(),
    };
    equation(&about, &(row + 1).to_string(), formula, &label)
}

/// Returns Φ_q as a table with the names of its rows and columns.
fn matrix(system: &System, section: &Section, names: &[&str]) -> String {
    let mut text = String::from(
        "<div class=\"wide\" tabindex=\"0\"><table class=\"matrix\"><thead><tr><td></td>",
    );
    for name in names {
        let _ = write!(text, "<th><math>{name}</math></th>");
    }
    text += "</tr></thead><tbody>\n";
    for (index, row) in system.rows.iter().enumerate() {
        let about = about(system, row.joint, Some(index));
        let _ = write!(text, "<tr {about} tabindex=\"0\"><th>{}</th>", index + 1);
        let mut cells = vec!["<td class=\"zero\">0</td>".to_string(); names.len()];
        for (coordinate, value) in section.slopes(index) {
            cells[coordinate] = format!("<td><math>{value}</math></td>");
        }
        text += &cells.concat();
        text += "</tr>\n";
    }
    text + "</tbody></table></div>\n"
}
