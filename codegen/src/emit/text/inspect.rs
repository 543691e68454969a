//! A system → the page that shows its equations.

use super::super::formula::Printer;
use super::super::named_parts::NamedParts;
use super::super::notation::Notation;
use super::table::{aligned, in_lines, shown_width};
use crate::expr::ExprId;
use crate::model::{Dimension, Role};
use crate::pool::{Pool, SymbolRole};
use crate::system::{Cause, Derived, Output, Row, System};

/// The widest matrix that is printed as one; wider ones are listed entry by entry.
const WIDEST_MATRIX: usize = 110;

/// The column that the list of coordinates is wrapped at.
const WIDEST_LIST: usize = 100;

/// Φ, Φ_q, Φ_t and γ of a system row by row, and the motion of its points.
pub fn inspect(derived: &Derived, notation: Notation) -> String {
    let system = &derived.system;
    let mut pool = derived.pool.draft();
    let parts = NamedParts::of_rows(&mut pool, system);
    let page = Page {
        pool: &pool,
        system,
        notation,
        parts: &parts,
    };
    let headings = match notation {
        Notation::Ascii => ["Phi(q, t) = 0", "Phi_q", "Phi_t", "gamma"],
        Notation::Unicode => ["Φ(q, t) = 0", "Φ_q", "Φ_t", "γ"],
    };
    let mut text = page.summary();
    text.push_str(&page.rows(headings[0], |row| row.residual, true));
    text.push_str(&page.jacobian(headings[1]));
    text.push_str(&page.rows(headings[2], |row| row.time_derivative, false));
    text.push_str(&page.rows(headings[3], |row| row.gamma, false));
    text.push_str(&page.driven());
    text.push_str(&page.parameters());
    text.push_str(&page.monitored());
    text.push_str(&page.points());
    let definitions = parts.definitions(&mut pool);
    if definitions.is_empty() {
        return text;
    }
    let printer = Printer::new(&pool, system, &[], notation);
    let lines = definitions.iter().flat_map(|definition| {
        let name = printer.expression(definition.name);
        in_lines(&name, &printer.expression(definition.value))
    });
    let lines: Vec<Vec<String>> = lines.map(|line| vec![line]).collect();
    format!("{text}\nwhere\n{}", aligned(&lines))
}

/// The parameters and inputs with their defaults, a line each; nothing where there are none.
pub(crate) fn given(pool: &Pool, system: &System) -> String {
    let mechanism = &system.mechanism;
    let value = |expr| pool.graph.constant_value(expr).unwrap_or(f64::NAN);
    let line = |what: &str, name: &str, dimension: Dimension, default: f64| {
        format!("{what} {name} = {default} {}\n", dimension.unit())
    };
    let parameters = mechanism.parameters.iter().map(|own| {
        let default = value(own.nominal);
        line("parameter", &own.name, own.dimension, default)
    });
    let inputs = mechanism.inputs.iter().map(|own| {
        let initial = value(own.initial);
        line("input", &own.name, own.dimension, initial)
    });
    let tables = mechanism.tables.iter().map(|own| {
        let spline = pool.graph.spline_of(own.spline);
        let [first, .., last] = &spline.starts[..] else {
            return String::new();
        };
        format!(
            "table {}: {} points from {first} to {last} {}, values in {}{}\n",
            own.name,
            spline.starts.len(),
            own.argument.unit(),
            own.value.unit(),
            spline.period.map_or("", |_| ", repeated"),
        )
    });
    parameters.chain(inputs).chain(tables).collect()
}

struct Page<'a> {
    pool: &'a Pool,
    system: &'a System,
    notation: Notation,
    parts: &'a NamedParts,
}

impl Page<'_> {
    fn printer<'b>(&'b self, bodies: &'b [usize]) -> Printer<'b, Notation> {
        Printer::new(self.pool, self.system, bodies, self.notation)
    }

    /// A formula that mentions the bodies in this order.
    fn formula(&self, bodies: &[usize], expr: ExprId) -> String {
        let is_long = self.parts.meet(&self.pool.graph, expr);
        self.printer(bodies)
            .naming(self.parts, is_long)
            .expression(expr)
    }

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
        let printer = self.printer(&[]);
        let names: Vec<String> = self
            .system
            .coordinates
            .iter()
            .enumerate()
            .map(|(index, _)| printer.symbol(SymbolRole::Position(index)))
            .collect();
        let plural = |number: i64, one: &str, several: &str| {
            format!("{number} {}", if number == 1 { one } else { several })
        };
        format!(
            "mechanism {}: {}, {}, {} of joints, {} of drivers, {}\n\n{}\n",
            mechanism.title(),
            mechanism.body_count_label(),
            plural(coordinates as i64, "coordinate", "coordinates"),
            plural(constraints as i64, "equation", "equations"),
            plural(drivers as i64, "equation", "equations"),
            plural(freedom, "degree of freedom", "degrees of freedom"),
            wrapped("q = (", &names, ")"),
        ) + &given(self.pool, self.system)
    }

    /// The rows that are not solved.
    fn monitored(&self) -> String {
        if self.system.monitored.is_empty() {
            return String::new();
        }
        let lines: Vec<Vec<String>> = self
            .system
            .monitored
            .iter()
            .map(|row| {
                let joint = &self.system.mechanism.joints[row.joint];
                vec![joint.label.clone(), self.formula(&row.bodies, row.residual)]
            })
            .collect();
        format!(
            "\nredundant: follows from the rest, monitored\n{}",
            aligned(&lines)
        )
    }

    /// Row number and joint, the joint only at its first row that is shown: `previous` is the one shown before.
    fn label(&self, index: usize, previous: Option<usize>) -> Vec<String> {
        let row = &self.system.rows[index];
        let first = previous.is_none_or(|previous| self.system.rows[previous].joint != row.joint);
        let joint = if first {
            self.system.mechanism.joints[row.joint].label.as_str()
        } else {
            ""
        };
        vec![format!("{}", index + 1), joint.to_string()]
    }

    /// A line per row: of every row, or only of those that are not zero.
    fn rows(&self, heading: &str, of: impl Fn(&Row) -> ExprId, every: bool) -> String {
        let zero = self.pool.graph.zero();
        if !every && self.system.rows.iter().all(|row| of(row) == zero) {
            return format!("\n{heading} = 0\n");
        }
        let mut lines: Vec<Vec<String>> = Vec::new();
        let mut previous = None;
        for (index, row) in self.system.rows.iter().enumerate() {
            if !every && of(row) == zero {
                continue;
            }
            let mut line = self.label(index, previous);
            line.push(self.formula(&row.bodies, of(row)));
            lines.push(line);
            previous = Some(index);
        }
        let remark = if lines.len() < self.system.rows.len() {
            "  all other rows are zero\n"
        } else {
            ""
        };
        format!("\n{heading}\n{}{remark}", aligned(&lines))
    }

    fn jacobian(&self, heading: &str) -> String {
        let entries: Vec<Vec<(usize, String)>> = self
            .system
            .rows
            .iter()
            .map(|row| {
                row.jacobian
                    .iter()
                    .map(|entry| (entry.coordinate, self.formula(&row.bodies, entry.value)))
                    .collect()
            })
            .collect();
        let names = self.printer(&[]);
        let name = |coordinate| names.symbol(SymbolRole::Position(coordinate));
        let columns = self.system.coordinates.len();
        // A column is a character wide or more, and two spaces stand before it.
        if 3 * columns <= WIDEST_MATRIX {
            let mut matrix: Vec<Vec<String>> = Vec::with_capacity(entries.len() + 1);
            let labels = [String::new(), String::new()].into_iter();
            matrix.push(labels.chain((0..columns).map(name)).collect());
            for (index, row) in entries.iter().enumerate() {
                let mut line = self.label(index, index.checked_sub(1));
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
        }
        let lines: Vec<Vec<String>> = entries
            .iter()
            .enumerate()
            .map(|(index, row)| {
                let mut line = self.label(index, index.checked_sub(1));
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

    /// ∂Φ/∂s for the value s of each driver, where something is transmitted: the rows that are not zero.
    fn driven(&self) -> String {
        let driven = self.system.driven();
        let columns = driven.map(|(place, ..)| &self.system.directions[place].column);
        let lines: Vec<_> = columns.flat_map(|column| self.column(column)).collect();
        if lines.is_empty() {
            return String::new();
        }
        let heading = match self.notation {
            Notation::Ascii => "Phi_s, s the value of the driver",
            Notation::Unicode => "Φ_s, s the value of the driver",
        };
        format!("\n{heading}\n{}", aligned(&lines))
    }

    /// ∂Φ/∂p for each parameter p whose sensitivity is asked for: the rows that are not zero.
    fn parameters(&self) -> String {
        let mut text = String::new();
        for direction in &self.system.directions {
            let Cause::Parameter(place) = direction.cause else {
                continue;
            };
            let name = &self.system.mechanism.parameters[place].name;
            let symbol = match self.notation {
                Notation::Ascii => "Phi",
                Notation::Unicode => "Φ",
            };
            let lines = self.column(&direction.column);
            text.push_str(&match lines.is_empty() {
                true => format!("\n{symbol}_p = 0, p the parameter {name}\n"),
                false => format!("\n{symbol}_p, p the parameter {name}\n{}", aligned(&lines)),
            });
        }
        text
    }

    /// The rows of a column that are not zero.
    fn column(&self, column: &[ExprId]) -> Vec<Vec<String>> {
        let zero = self.pool.graph.zero();
        let entries = self.system.rows.iter().zip(column).enumerate();
        entries
            .filter(|(_, (_, entry))| **entry != zero)
            .map(|(index, (row, &entry))| {
                let mut line = self.label(index, None);
                line.push(self.formula(&row.bodies, entry));
                line
            })
            .collect()
    }

    fn points(&self) -> String {
        if self.system.outputs.is_empty() {
            return String::new();
        }
        let pair = |pair: [ExprId; 2]| {
            let [x, y] = pair.map(|part| self.formula(&[], part));
            format!("({x}, {y})")
        };
        let line = |output: &Output| vec![output.name.clone(), pair(output.position)];
        let positions: Vec<Vec<String>> = self.system.outputs.iter().map(line).collect();
        format!("\npoints\n{}", aligned(&positions))
    }
}

/// Names between an opening and a closing, separated by commas, wrapped at [`WIDEST_LIST`] and indented under the first.
fn wrapped(opening: &str, names: &[String], closing: &str) -> String {
    let indent = " ".repeat(shown_width(opening));
    let mut lines = vec![opening.to_string()];
    for (index, name) in names.iter().enumerate() {
        let end = if index + 1 == names.len() {
            closing
        } else {
            ","
        };
        let width = lines.last().map_or(0, |line| shown_width(line));
        if index > 0 && width + 1 + shown_width(name) + end.len() > WIDEST_LIST {
            lines.push(indent.clone());
        } else if index > 0 {
            push(&mut lines, " ");
        }
        push(&mut lines, name);
        push(&mut lines, end);
    }
    if names.is_empty() {
        push(&mut lines, closing);
    }
    lines.join("\n")
}

/// Adds to the last of the lines.
fn push(lines: &mut [String], text: &str) {
    if let Some(line) = lines.last_mut() {
        line.push_str(text);
    }
}
