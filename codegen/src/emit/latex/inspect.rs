//! Prints the equations of systems as a LaTeX document.

use super::super::inspection::{Entry, Inspection, Quantity, Section, Subject};
use super::lines::{self, Line, displayed, fit_in_a_row, title, width};
use super::spelling::{Latex, escaped};
use crate::emit::derivation::SingularPose;
use crate::system::{Derived, System};

/// Number of columns up to which a Jacobian is a matrix; of a larger one the entries that are not zero are listed.
const LARGEST_MATRIX: usize = 12;

/// Returns a document with coordinates, Φ, Φ_q, Φ_t, γ, points and singular poses of each system.
pub fn inspect(systems: &[(&Derived, Vec<SingularPose>)]) -> String {
    lines::document(&pages(systems).join("\\clearpage\n"))
}

/// Returns the equations for a document with its own preamble.
pub fn inspect_fragment(systems: &[(&Derived, Vec<SingularPose>)]) -> String {
    lines::fragment(&pages(systems).join("\n"))
}

fn pages(systems: &[(&Derived, Vec<SingularPose>)]) -> Vec<String> {
    let pages = systems.iter();
    pages.map(|(derived, poses)| page(derived, poses)).collect()
}

/// Page of one system.
fn page(derived: &Derived, poses: &[SingularPose]) -> String {
    let system = &derived.system;
    let inspection = Inspection::of(derived, Latex);
    let names: Vec<&str> = inspection.coordinates.iter().map(|it| &*it[0]).collect();
    let listed: Vec<String> = names.iter().map(|it| format!("${it}$")).collect();
    let mut text = format!(
        "{}The coordinates $\\mathbf{{q}}$ are {}.\n",
        title(&escaped(&system.mechanism.title())),
        listed.join(", ")
    );
    for section in &inspection.sections {
        text += &section_text(system, section, &names);
    }
    let poses: Vec<String> = poses
        .iter()
        .map(|pose| {
            let (block, unknowns) = (pose.block + 1, &pose.unknowns);
            format!("Block {block}, {unknowns}: {}\n", pose.sentence())
        })
        .collect();
    if !poses.is_empty() {
        text += &subsection("Singular poses, by the determinant of each block up to its sign");
        text += &poses.join("\n");
    }
    text
}

fn subsection(heading: &str) -> String {
    format!("\n\\subsection*{{{heading}}}\n")
}

/// Returns a quantity with its heading and its remarks.
fn section_text(system: &System, section: &Section, names: &[&str]) -> String {
    let of_parameter;
    let (heading, symbol) = match &section.quantity {
        Quantity::Residual => ("Constraint equations $\\Phi(\\mathbf{q}, t) = 0$", "\\Phi"),
        Quantity::Jacobian => ("Jacobian $\\Phi_{\\mathbf{q}}$", "\\Phi_{\\mathbf{q}}"),
        Quantity::TimeDerivative => ("Partial derivative $\\Phi_{t}$", "\\Phi_{t}"),
        Quantity::Gamma => ("Right-hand side $\\gamma$ of the accelerations", "\\gamma"),
        Quantity::Drivers => ("Partial derivatives $\\Phi_{s}$", "\\Phi_{s}"),
        Quantity::Parameter(name) => {
            of_parameter = format!(
                "Partial derivative $\\Phi_{{p}}$ for the parameter $p$ = {}",
                escaped(name)
            );
            (&*of_parameter, "\\Phi_{p}")
        }
        Quantity::Points => ("Points", ""),
        Quantity::Definitions => ("What the names stand for", ""),
        Quantity::Monitored => ("Redundant equations, monitored but not solved", ""),
    };
    let equations: Vec<[String; 3]> = section
        .entries
        .iter()
        .map(|entry| equation(system, entry, symbol, names))
        .collect();
    let is_partial = section.entries.len() < system.rows.len();
    let listed = || {
        displayed(equations.iter().map(|it| Line {
            left: &it[0],
            right: &it[1],
            note: &it[2],
        }))
    };
    let contents = match section.quantity {
        Quantity::Jacobian => matrix(system, section, names.len())
            .unwrap_or_else(|| format!("{}All other entries are zero.\n", listed())),
        Quantity::Parameter(_) if equations.is_empty() => "It is zero.\n".to_string(),
        _ if equations.is_empty() => format!("\\[ {symbol} = 0 \\]\n"),
        Quantity::Parameter(_) => format!("All other rows are zero.\n{}", listed()),
        Quantity::Drivers => format!(
            "The value of each driver is $s$; all other rows are zero.\n{}",
            listed()
        ),
        Quantity::TimeDerivative | Quantity::Gamma if is_partial => {
            format!("{}All other rows are zero.\n", listed())
        }
        _ => listed(),
    };
    subsection(heading) + &contents
}

/// The left side of an equation, its right side, and the joint that it comes from as a remark.
fn equation(system: &System, entry: &Entry, symbol: &str, names: &[&str]) -> [String; 3] {
    let joint = |index: usize| {
        let label = &system.mechanism.joints[index].label;
        escaped(label).replace("->", "$\\to$")
    };
    let value = entry.value.clone();
    match &entry.subject {
        Subject::Row(row) => {
            let end = if symbol == "\\Phi" { " = 0" } else { "" };
            let left = format!("({symbol})_{{{}}}", row + 1);
            [left, value + end, joint(system.rows[*row].joint)]
        }
        Subject::Redundant(index) => [value, "0".to_string(), joint(*index)],
        Subject::Slope(row, coordinate) => {
            let (row, name) = (row + 1, names[*coordinate]);
            let left = format!("\\frac{{\\partial \\Phi_{{{row}}}}}{{\\partial {name}}}");
            [left, value, String::new()]
        }
        Subject::Point(point, axis) => {
            let (axis, name) = (["x", "y"][*axis], escaped(&system.outputs[*point].name));
            let left = format!("{axis}_{{\\mathrm{{{name}}}}}");
            [left, value, String::new()]
        }
        Subject::Name(name) => [name.clone(), value, String::new()],
    }
}

/// Φ_q as a matrix; `None` if it does not fit on a page.
fn matrix(system: &System, section: &Section, columns: usize) -> Option<String> {
    if columns > LARGEST_MATRIX {
        return None;
    }
    // The widest entry of each column beside one another.
    let mut widest = vec!["0"; columns];
    let rows = (0..system.rows.len()).map(|row| {
        let mut line = vec!["0"; columns];
        for (coordinate, value) in section.slopes(row) {
            line[coordinate] = value;
            if width(value) >= width(widest[coordinate]) {
                widest[coordinate] = value;
            }
        }
        format!("  {}", line.join(" & "))
    });
    let body = rows.collect::<Vec<_>>().join(" \\\\\n");
    fit_in_a_row(widest.into_iter())
        .then(|| format!("\\[ \\begin{{pmatrix}}\n{body}\n\\end{{pmatrix}} \\]\n"))
}
