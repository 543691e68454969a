//! Reads the points of a table from its file, each column in its unit.

use super::super::dimension::{Dimension, exact};
use super::super::resolve::Resolver;
use super::{Columns, Point};
use crate::columns::{self, Known, Unit};
use crate::diagnostic::{Attachment, Code, Diagnostic, Position, Source, nearest};
use crate::expr::{ExprId, Number};
use crate::syntax::{Name, is_relative, leaves_folder};
use crate::units::of_column;

impl Resolver<'_> {
    /// Returns the points of a file in SI units; `None` after an error.
    pub(super) fn in_file(
        &mut self,
        path: &Name,
        columns: Option<&[Name; 2]>,
        units: Option<&[Name; 2]>,
    ) -> Option<Columns> {
        let attachments = self.declared.attachments;
        let bytes = match file_of(attachments, path) {
            Ok(bytes) => bytes,
            Err((message, help)) => {
                self.units(units, None)?;
                self.report_file(path, message, help);
                return None;
            }
        };
        // Many tables may name one file.
        self.graph.spend(bytes.len() / 16);
        if leaves_folder(&path.text) {
            let message = format!("`{}` leaves the folder of the description", path.text);
            self.diagnostics.push(
                Diagnostic::warning(Code::UnreadableTable, path.span, message)
                    .label("another folder is read")
                    .help("put the file beside the description, so that both are copied together"),
            );
        }
        let table = match columns::Columns::read(bytes, Known::default()) {
            Ok(table) => table,
            Err(refused) => {
                self.units(units, None);
                let source = Source::new(path.text.as_str(), refused.text);
                for fault in refused.faults {
                    let Position { line, column } = source.position(fault.span.start);
                    let message = format!(
                        "line {line}, column {column} of `{}`: {}",
                        path.text, fault.message
                    );
                    self.report_file(path, message, &fault.help);
                }
                return None;
            }
        };
        let chosen = self.chosen(path, &table, columns);
        let written = chosen.map(|chosen| {
            chosen.map(|column| {
                let unit = table.columns[column].unit.clone();
                unit.map(|text| Name {
                    text,
                    span: path.span,
                })
            })
        });
        let units = self.units(units, written.as_ref());
        let (chosen, units) = (chosen?, units?);
        let mut points = Vec::with_capacity(table.rows);
        for row in 0..table.rows {
            let line = table.lines[row];
            let mut values = [0.0; 2];
            for (value, (column, unit)) in values.iter_mut().zip(chosen.into_iter().zip(units)) {
                let column = &table.columns[column];
                let Some(number) = column.values[row].and(table.written(column.spans[row])) else {
                    let message = format!(
                        "line {line} of `{}` has no number for `{}`",
                        path.text, column.name
                    );
                    self.report_file(path, message, "leave out the line, or write the number");
                    return None;
                };
                let Some(found) = self.cell(&number, unit.0) else {
                    let message = format!(
                        "line {line} of `{}` holds a number that is too large",
                        path.text
                    );
                    self.report_file(path, message, "check the unit and the exponent");
                    return None;
                };
                *value = found;
            }
            points.push(Point {
                values,
                spans: [path.span; 2],
                line: Some(line),
            });
        }
        Some(Columns {
            points,
            dimensions: units.map(|unit| unit.1),
        })
    }

    /// Returns the indices of both columns: the written ones, or the only two.
    fn chosen(
        &mut self,
        path: &Name,
        table: &columns::Columns,
        wanted: Option<&[Name; 2]>,
    ) -> Option<[usize; 2]> {
        let names: Vec<&str> = table.columns.iter().map(|it| it.name.as_str()).collect();
        let listed = format!("its columns are: {}", names.join(", "));
        let Some(wanted) = wanted else {
            if let [_, _] = names.as_slice() {
                return Some([0, 1]);
            }
            let message = format!("`{}` has {} columns", path.text, names.len());
            let help = format!(
                "choose two of them with `columns (X, Y)`: {}",
                names.join(", ")
            );
            self.report_file(path, message, &help);
            return None;
        };
        let indices = [0, 1].map(|place| {
            let name = &wanted[place];
            let number = name
                .text
                .parse::<usize>()
                .ok()
                .and_then(|it| it.checked_sub(1));
            let mut named = table.named(&name.text);
            let cause = match (named.next(), named.next(), number) {
                (Some(column), None, _) => return Some(column),
                (None, _, Some(number)) if number < names.len() => return Some(number),
                (Some(_), Some(_), _) => format!(
                    "several columns of `{}` are called `{}`",
                    path.text, name.text
                ),
                _ => format!("no column of `{}` is called `{}`", path.text, name.text),
            };
            let help = match nearest(&name.text, names.iter().copied()) {
                Some(meant) => format!("did you mean `{meant}`?"),
                None => listed.clone(),
            };
            self.diagnostics.push(
                Diagnostic::error(Code::UnreadableTable, name.span, cause)
                    .label("a column by its name, or its number from 1")
                    .help(help),
            );
            None
        });
        let [x, y] = indices;
        Some([x?, y?])
    }

    /// Returns the units of both columns: from the description, otherwise from the header, otherwise SI units. Units in both
    /// places must agree.
    fn units(
        &mut self,
        said: Option<&[Name; 2]>,
        written: Option<&[Option<Name>; 2]>,
    ) -> Option<[(ExprId, Dimension); 2]> {
        let one = (self.graph.one(), Dimension::Number);
        let units_of_columns = [0, 1].map(|column| {
            let units_written = said.map(|units| &units[column]);
            let written = written.and_then(|units| units[column].as_ref());
            if let (Some(units_written), Some(written)) = (units_written, written) {
                let units = [units_written, written].map(|it| Unit::parse(&it.text));
                // A unit of this language that is unknown in columns takes precedence.
                if let [Some(said_unit), Some(written_unit)] = units
                    && said_unit != written_unit
                {
                    let message = format!(
                        "the unit in the file is `{}`, not `{}`",
                        written.text, units_written.text
                    );
                    self.diagnostics.push(
                        Diagnostic::error(Code::UnreadableTable, units_written.span, message)
                            .label("the unit of this column")
                            .also(written.span, "in the header of this file")
                            .help("write the unit of the file, or none"),
                    );
                    return None;
                }
            }
            match units_written.or(written) {
                None => Some(one),
                Some(unit) if matches!(unit.text.as_str(), "1" | "-") => Some(one),
                Some(unit) => match of_column(&unit.text).filter(|_| units_written.is_none()) {
                    Some(named) => Some(exact(named, &mut self.graph)),
                    None => self.unit(unit),
                },
            }
        });
        let [x, y] = units_of_columns;
        Some([x?, y?])
    }

    /// Returns the number of a cell in SI units, rounded once like that of a listed point.
    fn cell(&mut self, cell: &str, unit: ExprId) -> Option<f64> {
        let unsigned = cell.strip_prefix('-').unwrap_or(cell);
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

/// Returns the bytes of the named file, or the message and the help of an error.
fn file_of<'a>(
    attachments: &'a [Attachment],
    path: &Name,
) -> Result<&'a [u8], (String, &'static str)> {
    let name = &path.text;
    if !is_relative(name) {
        let message = format!("`{name}` is not a path relative to the description");
        return Err((
            message,
            "name a file beside the description: `table lift = \"lift.csv\";`",
        ));
    }
    match attachments.iter().find(|file| file.path == *name) {
        Some(Attachment {
            bytes: Ok(bytes), ..
        }) => Ok(bytes),
        Some(Attachment {
            bytes: Err(cause), ..
        }) => Err((
            format!("cannot read `{name}`: {cause}"),
            "paths are relative to the folder of the description",
        )),
        None => Err((
            format!("`{name}` is not attached to the description"),
            "attach the files that the description names",
        )),
    }
}
