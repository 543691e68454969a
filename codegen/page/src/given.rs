//! Writes the parameters and inputs of a system with their values and documentation.

use std::fmt::Write as _;

use linkwright_codegen::stages::emit::markup::escaped;
use linkwright_codegen::stages::emit::mathml;
use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::system::System;

use super::number::number;

/// Returns the first paragraph of documentation.
pub fn leading_docs(lines: &[String]) -> String {
    paragraphs(lines).into_iter().take(1).collect()
}

/// Returns the paragraphs of documentation after the first one.
pub fn remaining_docs(lines: &[String]) -> String {
    paragraphs(lines).into_iter().skip(1).collect()
}

fn paragraphs(lines: &[String]) -> Vec<String> {
    let text = lines.iter().map(|line| line.trim()).collect::<Vec<_>>();
    let paragraphs = text.split(|line| line.is_empty());
    let paragraphs = paragraphs.filter(|lines| !lines.is_empty());
    paragraphs
        .map(|lines| format!("<p>{}</p>\n", with_code(&lines.join(" "))))
        .collect()
}

/// Escapes a text in which backticks enclose names.
fn with_code(text: &str) -> String {
    let parts = text.split('`').map(escaped).collect::<Vec<_>>();
    let is_open = parts.len().is_multiple_of(2);
    let marked = parts
        .iter()
        .enumerate()
        .map(|(place, part)| match place % 2 {
            1 if is_open && place + 1 == parts.len() => format!("`{part}"),
            1 => format!("<code>{part}</code>"),
            _ => part.clone(),
        });
    marked.collect()
}

/// Returns the heading of moving bodies or angles, and the word for one of them.
pub fn moving(system: &System) -> (&'static str, &'static str) {
    let bodies = &system.mechanism.bodies[1..];
    let has_angles = bodies.iter().any(|it| it.is_angle());
    let has_bodies = bodies.iter().any(|it| !it.is_angle());
    match (has_bodies, has_angles) {
        (true, true) => ("Bodies and angles", "Body or angle"),
        (false, true) => ("Angles", "Angle"),
        (_, false) => ("Bodies", "Body"),
    }
}

/// Returns the bodies and angles with their documentation.
pub fn bodies(system: &System) -> String {
    let (_, one) = moving(system);
    let bodies = system.mechanism.bodies.iter().enumerate().skip(1);
    let rows: String = bodies
        .map(|(place, body)| {
            let points: Vec<String> = body.marks.iter().map(|it| escaped(&it.name)).collect();
            format!(
                "<tr data-is=\"b{place}\" tabindex=\"0\"><td><b>{}</b></td><td>{}</td><td>{}</td></tr>\n",
                escaped(&body.name),
                points.join(", "),
                escaped(&body.docs.join(" "))
            )
        })
        .collect();
    match rows.is_empty() {
        true => String::new(),
        false => format!(
            "<div class=\"wide\" tabindex=\"0\"><table><thead><tr><th>{one}</th><th>Points</th><td></td></tr></thead><tbody>\n{rows}</tbody></table></div>\n"
        ),
    }
}

/// Returns a table of parameters and inputs; empty if there are none.
pub fn values(pool: &Pool, system: &System) -> String {
    let mechanism = &system.mechanism;
    let mut rows = String::new();
    for own in &mechanism.parameters {
        let value = pool.graph.nominal(own.symbol).unwrap_or(f64::NAN);
        let unit = mechanism.units.of_messages().of(&own.dimension.unit());
        let _ = writeln!(
            rows,
            "<tr><td>parameter</td><td><b>{}</b></td><td>{}</td><td>{}</td><td>{}</td></tr>",
            escaped(&own.name),
            number(unit.of_si(value)),
            escaped(&unit.name),
            escaped(&own.docs.join(" "))
        );
    }
    let free = &mechanism.forces.free;
    for (index, own) in mechanism.inputs.iter().enumerate() {
        let kind = match free.iter().any(|it| it.input == index) {
            true => "free coordinate",
            false => "input",
        };
        let _ = writeln!(
            rows,
            "<tr><td>{kind}</td><td><b>{}</b></td><td><math>{}</math></td><td>{}</td><td>{}</td></tr>",
            escaped(&own.name),
            mathml::formula(pool, system, &[], own.signal[0]),
            escaped(&own.dimension.unit()),
            escaped(&own.docs.join(" "))
        );
    }
    for own in &mechanism.tables {
        let spline = pool.graph.spline_of(own.spline);
        let _ = writeln!(
            rows,
            "<tr><td>table</td><td><b>{}</b></td><td>{} points</td><td>{}</td><td>{}</td></tr>",
            escaped(&own.name),
            spline.starts.len(),
            escaped(&own.value.unit()),
            escaped(&own.docs.join(" "))
        );
    }
    match rows.is_empty() {
        true => String::new(),
        false => format!(
            "<div class=\"wide\" tabindex=\"0\"><table><thead><tr><td></td><th>Name</th><th>Value</th><th>Unit</th><td></td></tr></thead><tbody>\n{rows}</tbody></table></div>\n"
        ),
    }
}
