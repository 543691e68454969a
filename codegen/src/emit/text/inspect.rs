//! Prints the equations of a system as text.

use super::super::inspection::{Entry, Inspection, Quantity, Section, Subject};
use super::super::notation::Notation;
use super::table::{aligned, in_lines, shown_width};
use crate::model::{Dimension, Role};
use crate::pool::Pool;
use crate::system::{Derived, System};
use crate::units::OutputUnits;

/// The widest matrix that is printed as one; wider ones are listed entry by entry.
const WIDEST_MATRIX: usize = 110;

/// The column that the list of coordinates is wrapped at.
const WIDEST_LIST: usize = 100;

/// Φ, Φ_q, Φ_t and γ of a system row by row, and the motion of its points.
pub fn inspect(derived: &Derived, notation: Notation) -> String {
    let system = &derived.system;
    let inspection = Inspection::of(derived, notation);
    let names: Vec<&str> = inspection.coordinates.iter().map(|it| &*it[0]).collect();
    let mut text = summary(derived, &names);
    for section in &inspection.sections {
        let (symbol, remark) = heading(&section.quantity);
        let symbol = match notation {
            Notation::Ascii => symbol.replace('Φ', "Phi").replace('γ', "gamma"),
            Notation::Unicode => symbol.to_string(),
        };
        text.push_str(&match section.quantity {
            Quantity::Jacobian => format!("\n{symbol}{}", jacobian(system, section, &names)),
            Quantity::TimeDerivative | Quantity::Gamma | Quantity::Parameter(_)
                if section.entries.is_empty() =>
            {
                format!("\n{symbol} = 0{remark}\n")
            }
            _ => format!("\n{symbol}{remark}\n{}", lines(system, section)),
        });
    }
    text
}

/// The symbol of a quantity, and what it stands for.
fn heading(quantity: &Quantity) -> (&'static str, String) {
    let symbol = match quantity {
        Quantity::Residual => "Φ(q, t) = 0",
        Quantity::Jacobian => "Φ_q",
        Quantity::TimeDerivative => "Φ_t",
        Quantity::Gamma => "γ",
        Quantity::Drivers => return ("Φ_s", ", s the value of the driver".to_string()),
        Quantity::Parameter(name) => return ("Φ_p", format!(", p the parameter {name}")),
        Quantity::Monitored => "redundant: follows from the rest, monitored",
        Quantity::Points => "points",
        Quantity::Definitions => "where",
    };
    (symbol, String::new())
}

/// The parameters and inputs with their defaults, a line each; nothing where there are none.
pub(crate) fn given(pool: &Pool, system: &System) -> String {
    let mechanism = &system.mechanism;
    let graph = &pool.graph;
    let value = |expr| graph.constant_value(expr).unwrap_or(f64::NAN);
    let line = |what: &str, name: &str, dimension: Dimension, default: f64, range| {
        let unit = dimension.unit();
        let range: Option<[f64; 2]> = range;
        let range = range.map_or(String::new(), |[low, high]| {
            format!(" from {low} to {high} {unit}")
        });
        format!("{what} {name} = {default} {unit}{range}")
    };
    let parameters = mechanism.parameters.iter().map(|own| {
        let default = value(own.nominal);
        let line = line("parameter", &own.name, own.dimension, default, own.range);
        let tolerance = own.tolerance.map_or(String::new(), |it| {
            format!(" {}", it.text(own.dimension, &OutputUnits::default()))
        });
        format!("{line}{tolerance}\n")
    });
    let inputs = mechanism.inputs.iter().map(|own| {
        let initial = value(own.initial);
        line("input", &own.name, own.dimension, initial, own.range) + "\n"
    });
    let tables = mechanism.tables.iter().map(|own| {
        let spline = graph.spline_of(own.spline);
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

/// The name of the mechanism, its counts, its coordinates and what is given.
fn summary(derived: &Derived, names: &[&str]) -> String {
    let system = &derived.system;
    let mechanism = &system.mechanism;
    let is_driver = |joint: usize| mechanism.joints[joint].role == Role::Driver;
    let drivers = system.rows.iter().filter(|row| is_driver(row.joint));
    let drivers = drivers.count();
    let coordinates = system.coordinates.len();
    let constraints = system.rows.len() - drivers;
    let freedom = coordinates as i64 - constraints as i64;
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
        wrapped("q = (", names, ")"),
    ) + &given(&derived.pool, system)
}

/// Row number and joint; the joint only if it is not that of the row before.
fn label(system: &System, row: usize, previous: Option<usize>) -> [String; 2] {
    let joint = |row: usize| system.rows[row].joint;
    let is_first = previous.is_none_or(|previous| joint(previous) != joint(row));
    let label = match is_first {
        true => &system.mechanism.joints[joint(row)].label,
        false => "",
    };
    [(row + 1).to_string(), label.to_string()]
}

/// The entries of a section as aligned lines, and a remark on rows of Φ_t and γ that are left out.
fn lines(system: &System, section: &Section) -> String {
    let mut lines: Vec<Vec<String>> = Vec::new();
    let is_derivative = matches!(section.quantity, Quantity::Drivers | Quantity::Parameter(_));
    let mut previous = None;
    for Entry { subject, value } in &section.entries {
        match subject {
            Subject::Row(row) | Subject::Slope(row, _) => {
                let [number, joint] = label(system, *row, previous);
                lines.push(vec![number, joint, value.clone()]);
                previous = Some(*row).filter(|_| !is_derivative);
            }
            Subject::Redundant(joint) => {
                let label = system.mechanism.joints[*joint].label.clone();
                lines.push(vec![label, value.clone()]);
            }
            Subject::Point(point, 0) => {
                let name = system.outputs[*point].name.clone();
                lines.push(vec![name, format!("({value}")]);
            }
            Subject::Point(..) => {
                if let Some([_, position]) = lines.last_mut().map(Vec::as_mut_slice) {
                    *position += &format!(", {value})");
                }
            }
            Subject::Name(name) => {
                lines.extend(in_lines(name, value).into_iter().map(|it| vec![it]))
            }
        }
    }
    let is_partial = matches!(section.quantity, Quantity::TimeDerivative | Quantity::Gamma)
        && lines.len() < system.rows.len();
    let remark = if is_partial {
        "  all other rows are zero\n"
    } else {
        ""
    };
    aligned(&lines) + remark
}

/// Φ_q as a matrix, or by the entries that are not zero.
fn jacobian(system: &System, section: &Section, names: &[&str]) -> String {
    let labels = |row: usize| label(system, row, row.checked_sub(1)).into_iter();
    let rows = 0..system.rows.len();
    // A column is a character wide or more, and two spaces stand before it.
    if 3 * names.len() <= WIDEST_MATRIX {
        let head = ["", ""].iter().chain(names).map(|it| it.to_string());
        let mut matrix: Vec<Vec<String>> = vec![head.collect()];
        for row in rows.clone() {
            let mut line: Vec<String> = labels(row).collect();
            line.resize(names.len() + 2, "0".to_string());
            for (coordinate, value) in section.slopes(row) {
                line[coordinate + 2] = value.to_string();
            }
            matrix.push(line);
        }
        let text = aligned(&matrix);
        if text.lines().all(|line| shown_width(line) <= WIDEST_MATRIX) {
            return format!("\n{text}");
        }
    }
    let lines = rows.map(|row| {
        let entries = section.slopes(row);
        let entries = entries.map(|(coordinate, value)| format!("{}: {value}", names[coordinate]));
        let entries = entries.collect::<Vec<_>>().join(",  ");
        labels(row).chain([entries]).collect()
    });
    let lines: Vec<Vec<String>> = lines.collect();
    format!(", entries that are not zero\n{}", aligned(&lines))
}

/// Names between an opening and a closing, separated by commas, wrapped at [`WIDEST_LIST`] and indented under the first.
fn wrapped(opening: &str, names: &[&str], closing: &str) -> String {
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
