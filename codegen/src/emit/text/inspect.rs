//! A system → the page that shows its equations.

use super::super::notation::Notation;
use super::formula::Printer;
use super::table::{aligned, shown_width};
use crate::expr::ExprId;
use crate::model::Role;
use crate::system::{Output, Row, System};

/// The widest matrix that is printed as one; wider ones are listed entry by entry.
const WIDEST_MATRIX: usize = 110;

/// Φ, Φ_q, Φ_t and γ of a system row by row, and the motion of its points.
pub fn inspect(system: &System, notation: Notation) -> String {
    let page = Page { system, notation };
    let headings = match notation {
        Notation::Ascii => ["Phi(q, t) = 0", "Phi_q", "Phi_t", "gamma"],
        Notation::Unicode => ["Φ(q, t) = 0", "Φ_q", "Φ_t", "γ"],
    };
    let mut text = page.summary();
    text.push_str(&page.rows(headings[0], |row| row.residual));
    text.push_str(&page.jacobian(headings[1]));
    text.push_str(&page.rows(headings[2], |row| row.time_derivative));
    text.push_str(&page.rows(headings[3], |row| row.gamma));
    text.push_str(&page.points());
    text
}

struct Page<'a> {
    system: &'a System,
    notation: Notation,
}

impl Page<'_> {
    fn summary(&self) -> String {
        let mechanism = &self.system.mechanism;
        let drivers = self
            .system
            .rows
            .iter()
            .filter(|row| mechanism.joints[row.joint].role == Role::Driver)
            .count();
        let coordinates = self.system.coordinates.len();
        let constraints = self.system.rows.len() - drivers;
        let freedom = coordinates as i64 - constraints as i64;
        let printer = Printer::new(self.system, &[], self.notation);
        let names: Vec<String> = self
            .system
            .coordinates
            .iter()
            .enumerate()
            .map(|(index, _)| printer.symbol(crate::system::SymbolRole::Position(index)))
            .collect();
        let plural = |number: i64, one: &str, several: &str| {
            format!("{number} {}", if number == 1 { one } else { several })
        };
        format!(
            "mechanism {}: {}, {}, {} of joints, {} of drivers, {}\n\nq = ({})\n",
            mechanism.name,
            plural(mechanism.moving_bodies().len() as i64, "body", "bodies"),
            plural(coordinates as i64, "coordinate", "coordinates"),
            plural(constraints as i64, "equation", "equations"),
            plural(drivers as i64, "equation", "equations"),
            plural(freedom, "degree of freedom", "degrees of freedom"),
            names.join(", "),
        )
    }

    /// Row number and joint, the joint only at its first row.
    fn label(&self, index: usize) -> Vec<String> {
        let row = &self.system.rows[index];
        let first = index == 0 || self.system.rows[index - 1].joint != row.joint;
        let joint = if first {
            self.system.mechanism.joints[row.joint].label.as_str()
        } else {
            ""
        };
        vec![format!("{}", index + 1), joint.to_string()]
    }

    fn rows(&self, heading: &str, of: impl Fn(&Row) -> ExprId) -> String {
        let zero = self.system.mechanism.graph.zero();
        if self.system.rows.iter().all(|row| of(row) == zero) {
            return format!("\n{heading} = 0\n");
        }
        let lines: Vec<Vec<String>> = self
            .system
            .rows
            .iter()
            .enumerate()
            .map(|(index, row)| {
                let mut line = self.label(index);
                line.push(
                    Printer::new(self.system, &row.bodies, self.notation).expression(of(row)),
                );
                line
            })
            .collect();
        format!("\n{heading}\n{}", aligned(&lines))
    }

    fn jacobian(&self, heading: &str) -> String {
        let entries: Vec<Vec<(usize, String)>> = self
            .system
            .rows
            .iter()
            .map(|row| {
                let printer = Printer::new(self.system, &row.bodies, self.notation);
                row.jacobian
                    .iter()
                    .map(|entry| (entry.coordinate, printer.expression(entry.value)))
                    .collect()
            })
            .collect();
        let names = Printer::new(self.system, &[], self.notation);
        let name = |coordinate| names.symbol(crate::system::SymbolRole::Position(coordinate));
        let columns = self.system.coordinates.len();
        let mut matrix: Vec<Vec<String>> = Vec::with_capacity(entries.len() + 1);
        matrix.push(
            [String::new(), String::new()]
                .into_iter()
                .chain((0..columns).map(name))
                .collect(),
        );
        for (index, row) in entries.iter().enumerate() {
            let mut line = self.label(index);
            line.resize(columns + 2, "0".to_string());
            for (coordinate, entry) in row {
                line[coordinate + 2].clone_from(entry);
            }
            matrix.push(line);
        }
        let text = aligned(&matrix);
        if text.lines().all(|line| shown_width(line) <= WIDEST_MATRIX) {
            return format!("\n{heading}\n{text}");
        }
        let lines: Vec<Vec<String>> = entries
            .iter()
            .enumerate()
            .map(|(index, row)| {
                let mut line = self.label(index);
                let listed: Vec<String> = row
                    .iter()
                    .map(|(coordinate, entry)| format!("{}: {entry}", name(*coordinate)))
                    .collect();
                line.push(listed.join(",  "));
                line
            })
            .collect();
        format!(
            "\n{heading}, entries that are not zero\n{}",
            aligned(&lines)
        )
    }

    fn points(&self) -> String {
        if self.system.outputs.is_empty() {
            return String::new();
        }
        let printer = Printer::new(self.system, &[], self.notation);
        let pair = |pair: [ExprId; 2]| {
            format!(
                "({}, {})",
                printer.expression(pair[0]),
                printer.expression(pair[1])
            )
        };
        let line = |output: &Output| vec![output.name.clone(), pair(output.position)];
        let positions: Vec<Vec<String>> = self.system.outputs.iter().map(line).collect();
        format!("\npoints\n{}", aligned(&positions))
    }
}
