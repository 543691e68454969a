//! The file that a table names → its points, each column in its unit.

use super::super::dimension::Dimension;
use super::super::resolve::Resolver;
use super::{Columns, Point, csv};
use crate::diagnostic::{Attachment, Code, Diagnostic};
use crate::expr::{ExprId, Number};
use crate::syntax::{Name, is_relative, leaves_folder};

impl Resolver<'_> {
    /// The points of a file, each column in its unit.
    pub(super) fn in_file(&mut self, path: &Name, units: Option<&[Name; 2]>) -> Option<Columns> {
        let one = (self.graph.one(), Dimension::Number);
        let units = match units {
            Some(units) => {
                let found = [0, 1].map(|column| match units[column].text.as_str() {
                    "1" => Some(one),
                    _ => self.unit(&units[column]),
                });
                let [x, y] = found;
                [x?, y?]
            }
            None => [one, one],
        };
        let attachments = self.declared.attachments;
        let text = match file_of(attachments, path) {
            Ok(text) => text,
            Err((message, help)) => {
                self.report_file(path, message, help);
                return None;
            }
        };
        // One file may stand behind many tables.
        self.graph.spend(text.len() / 16);
        if leaves_folder(&path.text) {
            let message = format!("`{}` leaves the folder of the description", path.text);
            self.diagnostics.push(
                Diagnostic::warning(Code::UnreadableTable, path.span, message)
                    .label("another folder is read")
                    .help("put the file beside the description, so that both are copied together"),
            );
        }
        let rows = match csv::rows(text) {
            Ok(rows) => rows,
            Err(faults) => {
                for fault in faults {
                    let message =
                        format!("line {} of `{}`: {}", fault.line, path.text, fault.message);
                    self.report_file(path, message, fault.help);
                }
                return None;
            }
        };
        let mut points = Vec::new();
        for row in rows {
            let [x, y] = [0, 1].map(|column| self.cell(row.cells[column], units[column].0));
            let (Some(x), Some(y)) = (x, y) else {
                let message = format!(
                    "line {} of `{}` holds a number that is too large",
                    row.line, path.text
                );
                self.report_file(path, message, "is its unit or its exponent wrong?");
                return None;
            };
            points.push(Point {
                values: [x, y],
                spans: [path.span; 2],
                line: Some(row.line),
            });
        }
        Some(Columns {
            points,
            dimensions: units.map(|unit| unit.1),
        })
    }

    /// The number in a cell, in SI units, rounded once: the same that a listed point would have.
    fn cell(&mut self, cell: &str, unit: ExprId) -> Option<f64> {
        let unsigned = cell.strip_prefix(['-', '+']).unwrap_or(cell);
        let number = match unsigned.starts_with('.') {
            true => Number::parse(&format!("0{unsigned}")),
            false => Number::parse(unsigned),
        };
        let number = self.graph.number(number?);
        let value = self.graph.multiply(number, unit);
        let value = self.graph.constant_value(value)?;
        let signed = if cell.starts_with('-') { -value } else { value };
        signed.is_finite().then_some(signed)
    }

    fn report_file(&mut self, path: &Name, message: String, help: &str) {
        self.diagnostics.push(
            Diagnostic::error(Code::UnreadableTable, path.span, message)
                .label("the points of this table")
                .help(help),
        );
    }
}

/// The text of the file that a table names, or what is wrong with it and what to do.
fn file_of<'a>(
    attachments: &'a [Attachment],
    path: &Name,
) -> Result<&'a str, (String, &'static str)> {
    let name = &path.text;
    if !is_relative(name) {
        let message = format!("`{name}` is no path relative to the description");
        return Err((
            message,
            "name a file beside the description: `table lift = \"lift.csv\";`",
        ));
    }
    match attachments.iter().find(|file| file.path == *name) {
        Some(Attachment { text: Ok(text), .. }) => Ok(text),
        Some(Attachment {
            text: Err(cause), ..
        }) => Err((
            format!("cannot read `{name}`: {cause}"),
            "paths are relative to the folder of the description",
        )),
        None => Err((
            format!("`{name}` was not given together with the description"),
            "whoever reads a description attaches the files that it names",
        )),
    }
}
