//! Systems → a LaTeX document with their equations.

use super::super::formula::Printer;
use super::lines::{self, Line, displayed, fit_in_a_row, title, width};
use super::spelling::{Latex, escaped};
use crate::emit::derivation::SingularPose;
use crate::emit::named_parts::NamedParts;
use crate::expr::ExprId;
use crate::pool::{Pool, SymbolRole};
use crate::system::{Cause, Derived, Row, System};

/// A Jacobian of more columns than these is listed by its entries that are not zero.
const LARGEST_MATRIX: usize = 12;

/// An equation: its left side, its right side, and where it comes from.
type Equation = [String; 3];

/// The coordinates, Φ, Φ_q, Φ_t and γ of each system, its points, and the singular poses of its blocks, with formulas in LaTeX.
pub fn inspect(systems: &[(&Derived, Vec<SingularPose>)]) -> String {
    lines::document(&pages(systems).join("\\clearpage\n"))
}

/// Equations for a document that has a preamble.
pub fn inspect_fragment(systems: &[(&Derived, Vec<SingularPose>)]) -> String {
    lines::fragment(&pages(systems).join("\n"))
}

fn pages(systems: &[(&Derived, Vec<SingularPose>)]) -> Vec<String> {
    let pages = systems.iter();
    pages.map(|(derived, poses)| page(derived, poses)).collect()
}

/// What the document says of one system.
fn page(derived: &Derived, poses: &[SingularPose]) -> String {
    let system = &derived.system;
    let mut pool = derived.pool.draft();
    let parts = &NamedParts::of_rows(&mut pool, system);
    let names = Printer::new(&pool, system, &[], Latex);
    let coordinates: Vec<String> = (0..system.coordinates.len())
        .map(|index| names.symbol(SymbolRole::Position(index)))
        .collect();
    let mut text = title(&escaped(&system.mechanism.title()));
    let listed: Vec<String> = coordinates.iter().map(|it| format!("${it}$")).collect();
    text.push_str(&format!(
        "The coordinates $\\mathbf{{q}}$ are {}.\n",
        listed.join(", ")
    ));
    text.push_str(&section(
        "Constraint equations $\\Phi(\\mathbf{q}, t) = 0$",
        &rows(&pool, system, parts, "\\Phi", |row| row.residual, " = 0"),
    ));
    text.push_str(&section(
        "Jacobian $\\Phi_{\\mathbf{q}}$",
        &jacobian(&pool, system, parts, &coordinates),
    ));
    text.push_str(&section(
        "Partial derivative $\\Phi_{t}$",
        &rows(
            &pool,
            system,
            parts,
            "\\Phi_{t}",
            |row| row.time_derivative,
            "",
        ),
    ));
    text.push_str(&section(
        "Right-hand side $\\gamma$ of the accelerations",
        &rows(&pool, system, parts, "\\gamma", |row| row.gamma, ""),
    ));
    text.push_str(&driven(&pool, system, parts));
    text.push_str(&parameters(&pool, system, parts));
    text.push_str(&section("Points", &points(&pool, system, parts)));
    let definitions = parts.definitions(&mut pool);
    let printer = Printer::new(&pool, system, &[], Latex);
    let definitions: Vec<Equation> = definitions
        .iter()
        .map(|definition| {
            let [name, value] = [definition.name, definition.value];
            [
                printer.expression(name),
                printer.expression(value),
                String::new(),
            ]
        })
        .collect();
    text.push_str(&section("What the names stand for", &aligned(&definitions)));
    let poses: Vec<String> = poses
        .iter()
        .map(|pose| {
            let (block, unknowns) = (pose.block + 1, &pose.unknowns);
            format!("Block {block}, {unknowns}: {}\n", pose.sentence())
        })
        .collect();
    text.push_str(&section(
        "Singular poses, by the determinant of each block up to its sign",
        &poses.join("\n"),
    ));
    text
}

/// A heading with what stands below it, if there is anything.
fn section(heading: &str, contents: &str) -> String {
    match contents {
        "" => String::new(),
        contents => format!("\n\\subsection*{{{heading}}}\n{contents}"),
    }
}

fn aligned(equations: &[Equation]) -> String {
    match equations {
        [] => String::new(),
        equations => {
            displayed(
                equations
                    .iter()
                    .map(|[left, right, note]| Line { left, right, note }),
            )
        }
    }
}

/// Where each declared point is.
fn points(pool: &Pool, system: &System, parts: &NamedParts) -> String {
    let equations = system.outputs.iter().flat_map(|output| {
        let lines = [("x", 0), ("y", 1)].map(|(axis, place)| {
            let expr = output.position[place];
            let is_long = parts.meet(&pool.graph, expr);
            let printer = Printer::new(pool, system, &[], Latex).naming(parts, is_long);
            let name = format!("{axis}_{{\\mathrm{{{}}}}}", escaped(&output.name));
            [name, printer.expression(expr), String::new()]
        });
        lines.into_iter()
    });
    aligned(&equations.collect::<Vec<_>>())
}

/// The joint that a row comes from, as a remark.
fn joint(system: &System, row: &Row) -> String {
    escaped(&system.mechanism.joints[row.joint].label).replace("->", "$\\to$")
}

/// A formula that mentions the bodies in the order of its row.
fn formula(pool: &Pool, system: &System, parts: &NamedParts, row: &Row, expr: ExprId) -> String {
    let is_long = parts.meet(&pool.graph, expr);
    Printer::new(pool, system, &row.bodies, Latex)
        .naming(parts, is_long)
        .expression(expr)
}

/// ∂Φ/∂s for the value s of each driver, where something is transmitted: the rows that are not zero.
fn driven(pool: &Pool, system: &System, parts: &NamedParts) -> String {
    let lines: Vec<Equation> = system
        .driven()
        .flat_map(|(place, ..)| column(&system.directions[place].column, "s", pool, system, parts))
        .collect();
    if lines.is_empty() {
        return String::new();
    }
    let words = "The value of each driver is $s$; all other rows are zero.\n";
    section(
        "Partial derivatives $\\Phi_{s}$",
        &format!("{words}{}", aligned(&lines)),
    )
}

/// ∂Φ/∂p for each parameter p whose sensitivity is asked for: the rows that are not zero.
fn parameters(pool: &Pool, system: &System, parts: &NamedParts) -> String {
    let mut text = String::new();
    for direction in &system.directions {
        let Cause::Parameter(place) = direction.cause else {
            continue;
        };
        let name = escaped(&system.mechanism.parameters[place].name);
        let lines = column(&direction.column, "p", pool, system, parts);
        let contents = match lines.is_empty() {
            true => "It is zero.\n".to_string(),
            false => format!("All other rows are zero.\n{}", aligned(&lines)),
        };
        let heading = format!("Partial derivative $\\Phi_{{p}}$ for the parameter $p$ = {name}");
        text.push_str(&section(&heading, &contents));
    }
    text
}

/// The rows of a column that are not zero.
fn column(
    column: &[ExprId],
    index_name: &str,
    pool: &Pool,
    system: &System,
    parts: &NamedParts,
) -> Vec<Equation> {
    let zero = pool.graph.zero();
    let entries = system.rows.iter().zip(column).enumerate();
    entries
        .filter(|(_, (_, entry))| **entry != zero)
        .map(|(index, (row, &entry))| {
            [
                format!("(\\Phi_{{{index_name}}})_{{{}}}", index + 1),
                formula(pool, system, parts, row, entry),
                joint(system, row),
            ]
        })
        .collect()
}

/// One equation a row. Where the equations do not end in ` = 0`, a remark stands for the rows that are zero.
fn rows(
    pool: &Pool,
    system: &System,
    parts: &NamedParts,
    symbol: &str,
    of: impl Fn(&Row) -> ExprId,
    end: &str,
) -> String {
    let left_out = |row: &Row| end.is_empty() && of(row) == pool.graph.zero();
    if system.rows.iter().all(left_out) {
        return format!("\\[ {symbol} = 0 \\]\n");
    }
    let rest = if system.rows.iter().any(left_out) {
        "All other rows are zero.\n"
    } else {
        ""
    };
    let lines: Vec<Equation> = system
        .rows
        .iter()
        .enumerate()
        .filter(|(_, row)| !left_out(row))
        .map(|(index, row)| {
            [
                format!("({symbol})_{{{}}}", index + 1),
                format!("{}{end}", formula(pool, system, parts, row, of(row))),
                joint(system, row),
            ]
        })
        .collect();
    format!("{}{rest}", aligned(&lines))
}

/// As a matrix where that fits on a page, otherwise by the entries that are not zero.
fn jacobian(pool: &Pool, system: &System, parts: &NamedParts, coordinates: &[String]) -> String {
    let rows: Vec<Vec<(usize, String)>> = system
        .rows
        .iter()
        .map(|row| {
            let entries = row.jacobian.iter();
            entries
                .map(|entry| {
                    (
                        entry.coordinate,
                        formula(pool, system, parts, row, entry.value),
                    )
                })
                .collect()
        })
        .collect();
    // The widest entry of each column beside one another.
    let widest: Vec<&str> = (0..coordinates.len())
        .map(|column| {
            let entries = rows.iter().flatten().filter(|(own, _)| *own == column);
            let entries = entries.map(|(_, entry)| entry.as_str());
            entries.max_by_key(|entry| width(entry)).unwrap_or("0")
        })
        .collect();
    if coordinates.len() <= LARGEST_MATRIX && fit_in_a_row(widest.into_iter()) {
        let lines: Vec<String> = rows
            .iter()
            .map(|row| {
                let mut line = vec!["0"; coordinates.len()];
                for (coordinate, entry) in row {
                    line[*coordinate] = entry;
                }
                format!("  {}", line.join(" & "))
            })
            .collect();
        let body = lines.join(" \\\\\n");
        return format!("\\[ \\begin{{pmatrix}}\n{body}\n\\end{{pmatrix}} \\]\n");
    }
    let lines: Vec<Equation> = rows
        .into_iter()
        .enumerate()
        .flat_map(|(index, row)| {
            row.into_iter().map(move |(coordinate, entry)| {
                let name = &coordinates[coordinate];
                let left = format!(
                    "\\frac{{\\partial \\Phi_{{{}}}}}{{\\partial {name}}}",
                    index + 1
                );
                [left, entry, String::new()]
            })
        })
        .collect();
    format!("{}All other entries are zero.\n", aligned(&lines))
}
