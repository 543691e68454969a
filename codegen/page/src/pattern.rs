//! Draws the pattern of the nonzero entries of Φ_q, and lists the entries row by row.

use std::fmt::Write as _;

use linkwright_codegen::stages::emit::inspection::Section;
use linkwright_codegen::stages::emit::markup::escaped;
use linkwright_codegen::stages::emit::mathml::lines;
use linkwright_codegen::stages::system::System;

use super::equations::{about, numbered};

/// Side of a cell in pixels.
const CELL: usize = 12;

/// Height of the names of bodies above the pattern, and width of the numbers of rows beside it, in pixels.
const MARGINS: [usize; 2] = [18, 24];

/// Smallest number of columns that the name of a body fits above.
const NAMED_COLUMNS: usize = 3;

/// Returns the pattern as a figure, followed by one line per row.
pub fn entries(system: &System, section: &Section, names: &[&str]) -> String {
    let mut text = figure(system, section);
    for row in 0..system.rows.len() {
        let entries = section.slopes(row).map(|(column, value)| {
            format!(
                "<span class=\"entry\" data-entry=\"{row} {column}\"><span class=\"column\"><math>{}</math></span> <span class=\"value\">{}</span></span>",
                names[column],
                lines(value)
            )
        });
        let is_first = row == 0 || system.rows[row - 1].joint != system.rows[row].joint;
        text += &numbered(
            system,
            row,
            is_first,
            &entries.collect::<Vec<_>>().join(" "),
        );
    }
    text
}

/// Returns the pattern; a cell belongs to the joint of its row and to the unknown of its column.
fn figure(system: &System, section: &Section) -> String {
    let [top, left] = MARGINS;
    let [rows, columns] = [system.rows.len(), system.coordinates.len()];
    let [width, height] = [columns * CELL, rows * CELL];
    let count: usize = (0..rows).map(|row| section.slopes(row).count()).sum();
    let mut text = format!(
        "<figure class=\"pattern\"><svg viewBox=\"0 0 {} {}\" style=\"max-width:{}px\" role=\"img\" aria-label=\"Pattern of the Jacobian: {count} of {rows} by {columns} entries are not zero\">\n<g transform=\"translate({left} {top})\"><rect class=\"sheet\" width=\"{width}\" height=\"{height}\"/>\n",
        left + width + 1,
        top + height + 1,
        (left + width) * 3 / 2,
    );
    let bounds = |all: &mut dyn Iterator<Item = Option<usize>>| {
        let mut bounds: Vec<(usize, Option<usize>)> = Vec::new();
        for (place, owner) in all.enumerate() {
            if bounds.last().is_none_or(|last| last.1 != owner) {
                bounds.push((place, owner));
            }
        }
        bounds
    };
    let bodies = bounds(&mut system.coordinates.iter().map(|it| it.describes.body()));
    let joints = bounds(&mut system.rows.iter().map(|it| Some(it.joint)));
    let mut grid = String::new();
    for (place, &(start, body)) in bodies.iter().enumerate() {
        let end = bodies.get(place + 1).map_or(columns, |it| it.0);
        if start > 0 {
            let _ = write!(grid, "M{} 0V{height}", start * CELL);
        }
        if let Some(body) = body.filter(|_| end - start >= NAMED_COLUMNS) {
            let _ = writeln!(
                text,
                "<text x=\"{}\" y=\"-5\" text-anchor=\"middle\" data-is=\"b{body}\">{}</text>",
                (start + end) * CELL / 2,
                escaped(&system.mechanism.bodies[body].name)
            );
        }
    }
    for &(start, _) in &joints {
        if start > 0 {
            let _ = write!(grid, "M0 {}H{width}", start * CELL);
        }
        let _ = writeln!(
            text,
            "<text x=\"-5\" y=\"{}\" text-anchor=\"end\">{}</text>",
            start * CELL + CELL - 2,
            start + 1
        );
    }
    let _ = writeln!(text, "<path class=\"bounds\" d=\"{grid}\"/>");
    for row in 0..rows {
        let _ = write!(
            text,
            "<g {}>",
            about(system, system.rows[row].joint, Some(row))
        );
        for (column, _) in section.slopes(row) {
            let body = system.coordinates[column].describes.body();
            let of = body.map_or(String::new(), |body| format!(" data-of=\"b{body}\""));
            let _ = write!(
                text,
                "<rect data-is=\"q{column} e{row}\"{of} data-entry=\"{row} {column}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>",
                column * CELL + 1,
                row * CELL + 1,
                CELL - 2,
                CELL - 2
            );
        }
        text += "</g>\n";
    }
    text + "</g></svg><figcaption><output>Rows are equations, columns are unknowns. Point at a cell to see its entry.</output></figcaption></figure>\n"
}
