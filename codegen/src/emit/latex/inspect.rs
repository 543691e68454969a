//! A system → a fragment for amsmath with its equations.

use super::super::formula::Printer;
use super::spelling::{Latex, escaped};
use crate::emit::named_parts::NamedParts;
use crate::expr::ExprId;
use crate::system::{Cause, Row, SymbolRole, System};

/// More coordinates than these make a matrix that fits no page; its entries are then listed.
const LARGEST_MATRIX: usize = 9;

/// Φ, Φ_q, Φ_t and γ of a system as display equations.
pub fn inspect(system: &System) -> String {
    let mut system = system.clone();
    let parts = &NamedParts::of_rows(&mut system);
    let names = Printer::new(&system, &[], Latex);
    let coordinates: Vec<String> = (0..system.coordinates.len())
        .map(|index| names.symbol(SymbolRole::Position(index)))
        .collect();
    let mut text = format!("% mechanism {}\n", escaped(&system.mechanism.title()));
    text.push_str(&format!(
        "\\[ \\mathbf{{q}} = ({})^T \\]\n",
        coordinates.join(", ")
    ));
    text.push_str(&rows(&system, parts, "\\Phi", |row| row.residual, " = 0"));
    text.push_str(&jacobian(&system, parts, &coordinates));
    text.push_str(&rows(
        &system,
        parts,
        "\\Phi_{t}",
        |row| row.time_derivative,
        "",
    ));
    text.push_str(&rows(&system, parts, "\\gamma", |row| row.gamma, ""));
    text.push_str(&driven(&system, parts));
    text.push_str(&parameters(&system, parts));
    let definitions = parts.definitions(&mut system);
    if !definitions.is_empty() {
        let printer = Printer::new(&system, &[], Latex);
        let lines: Vec<String> = definitions
            .iter()
            .map(|definition| {
                let [name, value] =
                    [definition.name, definition.value].map(|it| printer.expression(it));
                format!("  {name} &= {value}")
            })
            .collect();
        text.push_str(&format!(
            "where\n\\begin{{align*}}\n{}\n\\end{{align*}}\n",
            lines.join(" \\\\\n")
        ));
    }
    text
}

/// A formula that mentions the bodies in the order of its row.
fn formula(system: &System, parts: &NamedParts, row: &Row, expr: ExprId) -> String {
    let is_long = parts.meet(&system.mechanism.graph, expr);
    Printer::new(system, &row.bodies, Latex)
        .naming(parts, is_long)
        .expression(expr)
}

/// ∂Φ/∂s for the value s of each driver, where something is transmitted: the rows that are not zero.
fn driven(system: &System, parts: &NamedParts) -> String {
    let lines: Vec<String> = system
        .driven()
        .flat_map(|(place, ..)| column(&system.directions[place].column, "s", system, parts))
        .collect();
    if lines.is_empty() {
        return String::new();
    }
    format!(
        "The value of each driver is $s$; all other rows of $\\Phi_{{s}}$ are zero.\n\\begin{{align*}}\n{}\n\\end{{align*}}\n",
        lines.join(" \\\\\n")
    )
}

/// ∂Φ/∂p for each parameter p whose sensitivity is asked for: the rows that are not zero.
fn parameters(system: &System, parts: &NamedParts) -> String {
    let mut text = String::new();
    for direction in &system.directions {
        let Cause::Parameter(place) = direction.cause else {
            continue;
        };
        let name = escaped(&system.mechanism.parameters[place].name);
        let lines = column(&direction.column, "p", system, parts);
        text.push_str(&match lines.is_empty() {
            true => format!("For the parameter {name}, $\\Phi_{{p}}$ is zero.\n"),
            false => format!(
                "For the parameter $p$ = {name}; all other rows of $\\Phi_{{p}}$ are zero.\n\\begin{{align*}}\n{}\n\\end{{align*}}\n",
                lines.join(" \\\\\n")
            ),
        });
    }
    text
}

/// The rows of a column that are not zero, as aligned equations.
fn column(column: &[ExprId], index_name: &str, system: &System, parts: &NamedParts) -> Vec<String> {
    let zero = system.mechanism.graph.zero();
    let entries = system.rows.iter().zip(column).enumerate();
    entries
        .filter(|(_, (_, entry))| **entry != zero)
        .map(|(index, (row, &entry))| {
            let formula = formula(system, parts, row, entry);
            let joint = escaped(&system.mechanism.joints[row.joint].label).replace("->", "$\\to$");
            format!(
                "  (\\Phi_{{{index_name}}})_{{{}}} &= {formula} && \\text{{{joint}}}",
                index + 1
            )
        })
        .collect()
}

/// One aligned equation a row, with the joint as its tag. Where the equations do not end in ` = 0`, a remark stands for the rows
/// that are zero.
fn rows(
    system: &System,
    parts: &NamedParts,
    symbol: &str,
    of: impl Fn(&Row) -> ExprId,
    end: &str,
) -> String {
    let left_out = |row: &Row| end.is_empty() && of(row) == system.mechanism.graph.zero();
    if system.rows.iter().all(left_out) {
        return format!("\\[ {symbol} = 0 \\]\n");
    }
    let rest = if system.rows.iter().any(left_out) {
        "All other rows are zero.\n"
    } else {
        ""
    };
    let lines: Vec<String> = system
        .rows
        .iter()
        .enumerate()
        .filter(|(_, row)| !left_out(row))
        .map(|(index, row)| {
            let formula = formula(system, parts, row, of(row));
            let joint = escaped(&system.mechanism.joints[row.joint].label).replace("->", "$\\to$");
            format!(
                "  ({symbol})_{{{}}} &= {formula}{end} && \\text{{{joint}}}",
                index + 1
            )
        })
        .collect();
    format!(
        "\\begin{{align*}}\n{}\n\\end{{align*}}\n{rest}",
        lines.join(" \\\\\n")
    )
}

fn jacobian(system: &System, parts: &NamedParts, coordinates: &[String]) -> String {
    let entries = |row: &Row| -> Vec<(usize, String)> {
        row.jacobian
            .iter()
            .map(|entry| (entry.coordinate, formula(system, parts, row, entry.value)))
            .collect()
    };
    if coordinates.len() <= LARGEST_MATRIX {
        let lines: Vec<String> = system
            .rows
            .iter()
            .map(|row| {
                let mut line = vec!["0".to_string(); coordinates.len()];
                for (coordinate, entry) in entries(row) {
                    line[coordinate] = entry;
                }
                format!("  {}", line.join(" & "))
            })
            .collect();
        let body = lines.join(" \\\\\n");
        return format!(
            "\\[ \\Phi_{{\\mathbf{{q}}}} = \\begin{{pmatrix}}\n{body}\n\\end{{pmatrix}} \\]\n"
        );
    }
    let lines: Vec<String> = system
        .rows
        .iter()
        .enumerate()
        .flat_map(|(index, row)| {
            entries(row).into_iter().map(move |(coordinate, entry)| {
                format!(
                    "  \\frac{{\\partial \\Phi_{{{}}}}}{{\\partial {}}} &= {entry}",
                    index + 1,
                    coordinates[coordinate]
                )
            })
        })
        .collect();
    format!(
        "\\begin{{align*}}\n{}\n\\end{{align*}}\n",
        lines.join(" \\\\\n")
    )
}
