//! Writes the coordinates and points of the first instant with their rates, and the first Newton-Raphson step from it.

use std::fmt::Write as _;

use linkwright::PointMotion;
use linkwright_codegen::stages::emit::markup::escaped;
use linkwright_codegen::stages::emit::mathml::symbol;
use linkwright_codegen::stages::pool::{Pool, SymbolRole};
use linkwright_codegen::stages::system::System;
use linkwright_codegen::stages::units::OutputUnit;
use linkwright_solver::condition::Condition;
use linkwright_solver::first_step::{FirstStep, first_step as first_step_from};
use linkwright_solver::{Instant, Interpreted, View as _};
use nalgebra::{DMatrix, DVector};

use super::number::{mathml, number};
use crate::units::{LENGTHS, Units};

/// Largest number of columns of a matrix that is shown whole; nonzero entries of wider ones are listed.
const LARGEST_MATRIX: usize = 12;

/// Magnitude that counts as zero in a matrix, relative to its largest entry.
const ROUNDING: f64 = 1e-12;

/// Returns q, q̇ and q̈ at the start, and the motion of the points.
pub fn values(view: &Interpreted, instant: &Instant) -> String {
    let system = view.system();
    let message_units = system.mechanism.units.of_messages();
    let mut text = String::from(
        "<div class=\"wide\" tabindex=\"0\"><table class=\"numbers\"><thead><tr><td></td><th>position</th><td></td><th>rate</th><th>acceleration</th><th>unit</th></tr></thead><tbody>\n",
    );
    for place in 0..system.coordinates.len() {
        let [q, qd, qdd] = instant.coordinate(place).unwrap_or_default();
        let name = symbol(view.pool(), system, SymbolRole::Position(place));
        let units = Units::of(system, place, message_units).levels;
        let degrees = match units[0].name.as_str() {
            "rad" => format!("{}°", number(q.to_degrees())),
            _ => String::new(),
        };
        let _ = writeln!(
            text,
            "<tr data-is=\"q{place}\" tabindex=\"0\"><th><math>{name}</math></th><td>{}</td><td>{degrees}</td><td>{}</td><td>{}</td><td>{}</td></tr>",
            number(units[0].of_si(q)),
            number(units[1].of_si(qd)),
            number(units[2].of_si(qdd)),
            names(&units),
        );
    }
    text += "</tbody></table></div>\n";
    let points = view.points(instant);
    if points.is_empty() {
        return text;
    }
    let units = LENGTHS.map(|it| message_units.of(it));
    let [position, velocity, acceleration] = units.each_ref().map(|it| escaped(&it.name));
    let _ = writeln!(
        text,
        "<div class=\"wide\" tabindex=\"0\"><table class=\"numbers\"><thead><tr><th>Point</th><th>position, {position}</th><th>velocity, {velocity}</th><th>acceleration, {acceleration}</th></tr></thead><tbody>"
    );
    for (place, (output, motion)) in system.outputs.iter().zip(&points).enumerate() {
        let PointMotion {
            position,
            velocity,
            acceleration,
        } = motion;
        let pair = |values: &[f64; 2], unit: &OutputUnit| {
            let [x, y] = values.map(|it| number(unit.of_si(it)));
            format!("({x}, {y})")
        };
        let _ = writeln!(
            text,
            "<tr data-is=\"p{place}\" tabindex=\"0\"><th>{}</th><td>{}</td><td>{}</td><td>{}</td></tr>",
            escaped(&output.name),
            pair(position, &units[0]),
            pair(velocity, &units[1]),
            pair(acceleration, &units[2])
        );
    }
    text + "</tbody></table></div>\n"
}

/// Returns the unit of a coordinate, or all three units if those of rates do not follow from it.
fn names(units: &[OutputUnit; 3]) -> String {
    let [own, rate, acceleration] = units.each_ref().map(|it| it.name.as_str());
    let is_usual =
        own.is_empty() || rate == format!("{own}/s") && acceleration == format!("{own}/s²");
    escaped(&match is_usual {
        true => own.to_string(),
        false => format!("{own}, {rate}, {acceleration}"),
    })
}

/// Returns the equation of the first Newton-Raphson step at `t` (s), from the pose of an earlier instant.
pub fn first_step(pool: &Pool, system: &System, instant: &Instant, t: f64) -> String {
    let FirstStep {
        jacobian: matrix,
        residual,
        correction: step,
        ..
    } = first_step_from(pool, system, instant.q(), t);
    let right = -residual;
    let scale = right.amax().max(1.0);
    let right = right.map(|it| if it.abs() < ROUNDING * scale { 0.0 } else { it });
    let mut text = format!(
        "<p>Newton-Raphson starts at the pose q<sub>0</sub> of t = {} s and seeks that of t = {} s. Its first step Δq solves <math><msub><mi mathvariant=\"normal\">Φ</mi><mi class=\"bold\" mathvariant=\"normal\">q</mi></msub><mo>(</mo><msub><mi class=\"bold\" mathvariant=\"normal\">q</mi><mn>0</mn></msub><mo>,</mo><mi>t</mi><mo>)</mo><mspace width=\"0.15em\"/><mi mathvariant=\"normal\">Δ</mi><mi class=\"bold\" mathvariant=\"normal\">q</mi></math> = <math><mo>−</mo><mi mathvariant=\"normal\">Φ</mi><mo>(</mo><msub><mi class=\"bold\" mathvariant=\"normal\">q</mi><mn>0</mn></msub><mo>,</mo><mi>t</mi><mo>)</mo></math>, here in numbers of SI units:</p>\n",
        number(instant.t()),
        number(t)
    );
    text += &match right.len() <= LARGEST_MATRIX {
        true => full(&matrix, &right, step.as_ref(), pool, system),
        false => sparse(&matrix, &right, step.as_ref(), pool, system),
    };
    let condition = Condition::of(&matrix);
    let verdict = match condition.sign {
        0 => "It is zero: the matrix is singular and gives no step.",
        _ => "It is not zero, so that exactly one step solves the equations.",
    };
    let _ = writeln!(
        text,
        "<p>The determinant of this matrix is <b>{}</b>. {verdict}</p>",
        number(condition.determinant)
    );
    text
}

/// Returns the whole matrix.
fn full(
    matrix: &DMatrix<f64>,
    right: &DVector<f64>,
    step: Option<&DVector<f64>>,
    pool: &Pool,
    system: &System,
) -> String {
    let rows: String = matrix
        .row_iter()
        .map(|row| {
            let cells: String = row
                .iter()
                .map(|value| format!("<mtd>{}</mtd>", mathml(*value)))
                .collect();
            format!("<mtr>{cells}</mtr>")
        })
        .collect();
    let unknowns: Vec<String> = (0..right.len())
        .map(|place| {
            format!(
                "<mi mathvariant=\"normal\">Δ</mi>{}",
                symbol(pool, system, SymbolRole::Position(place))
            )
        })
        .collect();
    let unknowns = column(unknowns.into_iter());
    let right = column(right.iter().map(|it| mathml(*it)));
    let solved = step.map_or(String::new(), |step| {
        format!(
            "<mo>⇒</mo>{unknowns}<mo>=</mo>{}",
            column(step.iter().map(|it| mathml(*it)))
        )
    });
    format!(
        "<div class=\"wide\" tabindex=\"0\"><math id=\"first-step\"><mrow><mo>(</mo><mtable>{rows}</mtable><mo>)</mo></mrow>{unknowns}<mo>=</mo>{right}</math> <math>{solved}</math></div>\n"
    )
}

fn column(cells: impl Iterator<Item = String>) -> String {
    let rows: String = cells
        .map(|it| format!("<mtr><mtd>{it}</mtd></mtr>"))
        .collect();
    format!("<mrow><mo>(</mo><mtable>{rows}</mtable><mo>)</mo></mrow>")
}

/// Returns the nonzero entries row by row.
fn sparse(
    matrix: &DMatrix<f64>,
    right: &DVector<f64>,
    step: Option<&DVector<f64>>,
    pool: &Pool,
    system: &System,
) -> String {
    let mut text = String::from(
        "<div class=\"wide\" tabindex=\"0\"><table class=\"numbers\"><thead><tr><td></td><th class=\"left\">entries of Φ<sub>q</sub></th><th>−Φ</th></tr></thead><tbody>\n",
    );
    for (index, row) in matrix.row_iter().enumerate() {
        let entries = row.iter().enumerate().filter(|(_, value)| **value != 0.0);
        let entries: Vec<String> = entries
            .map(|(place, value)| {
                format!(
                    "<span class=\"entry\"><span class=\"column\"><math>{}</math></span> {}</span>",
                    symbol(pool, system, SymbolRole::Position(place)),
                    number(*value)
                )
            })
            .collect();
        let _ = writeln!(
            text,
            "<tr data-is=\"e{index}\" tabindex=\"0\"><th>{}</th><td class=\"left\">{}</td><td>{}</td></tr>",
            index + 1,
            entries.join(" "),
            number(right[index])
        );
    }
    text += "</tbody></table></div>\n";
    if let Some(step) = step {
        let moved = step
            .iter()
            .enumerate()
            .filter(|(_, value)| value.abs() > ROUNDING);
        let moved: Vec<String> = moved
            .map(|(place, value)| {
                format!(
                    "<span class=\"entry\"><math><mi mathvariant=\"normal\">Δ</mi>{}</math> = {}</span>",
                    symbol(pool, system, SymbolRole::Position(place)),
                    number(*value)
                )
            })
            .collect();
        let _ = writeln!(
            text,
            "<p>Nonzero entries of the solution: {}</p>",
            moved.join(" ")
        );
    }
    text
}
