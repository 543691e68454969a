//! Resolves `table` statements into splines, and calls of tables into expressions.
//!
//! A table is a function of any argument, twice continuously differentiable through its points. The pieces are computed once,
//! so the points must be numbers, independent of t and of parameters.

mod ends;
mod file;
mod pieces;

pub use self::ends::ENDS_OF_TABLES;
pub(super) use self::pieces::{Ends, spline};
use super::call::FUNCTIONS;
use super::dimension::Dimension;
use super::expression::Value;
use super::law::LAWS;
use super::resolve::Resolver;
use super::{Table, field_name};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::syntax::{self, Expression, Name, Pair, TablePoints};

/// A number of the description with its dimension.
type Entry<'a> = (&'a Expression, f64, Dimension);

/// A point of a table.
struct Point {
    values: [f64; 2],
    /// Locations of both numbers; for a file, the location of its name.
    spans: [Span; 2],
    /// Line in the file; `None` for a listed point.
    line: Option<usize>,
}

/// Points of a table with the dimensions of both columns.
struct Columns {
    points: Vec<Point>,
    dimensions: [Dimension; 2],
}

impl Resolver<'_> {
    /// Declares a table, even with an error, so that its uses cause no further errors.
    pub(super) fn add_table(&mut self, written: &syntax::Table) {
        let name = &written.name;
        if !self.may_be_declared(name) || !self.may_name_table(name) {
            return;
        }
        let table = self.table(written);
        let place = table.is_some().then_some(self.declared.tables.len());
        match self.declared.table_names.declare(name, place) {
            Some(duplicate) => self.diagnostics.push(duplicate),
            None => self.declared.tables.extend(table),
        }
    }

    /// Reports a name of another function, or a name that collides with the constant of another table; true if the name is
    /// free.
    fn may_name_table(&mut self, name: &Name) -> bool {
        let text = name.text.as_str();
        let finding = |message: String| Diagnostic::error(Code::NameNotAllowed, name.span, message);
        if FUNCTIONS.contains(&text) || LAWS.contains(&text) {
            self.diagnostics.push(
                finding(format!("`{text}` is a function of this language"))
                    .label("calls could not tell them apart")
                    .help("give the table another name"),
            );
            return false;
        }
        let fields = &mut self.declared.table_fields;
        let earlier = fields
            .entry(field_name(text))
            .or_insert_with(|| name.clone());
        let (other, span) = (earlier.text.clone(), earlier.span);
        if other != text {
            self.diagnostics.push(
                finding(format!("tables `{other}` and `{text}` differ only in case"))
                    .label("both would be one constant in the generated code")
                    .also(span, "the other one")
                    .help("give one of them another name"),
            );
            return false;
        }
        true
    }

    fn table(&mut self, written: &syntax::Table) -> Option<Table> {
        let columns = self.columns(written);
        let ends = self.ends(written, columns.as_ref().map(|columns| columns.dimensions));
        let (Columns { points, dimensions }, ends) = (columns?, ends?);
        let least = if ends == Ends::Periodic { 3 } else { 2 };
        if points.len() < least {
            let (given, kind) = match ends {
                Ends::Periodic => (points.len(), "a periodic table"),
                _ => (points.len(), "a table"),
            };
            self.diagnostics.push(
                Diagnostic::error(
                    Code::WrongForm,
                    written.place,
                    format!("{kind} needs at least {least} points, not {given}"),
                )
                .label(format!("{given} given"))
                .help("write `table NAME = [(X, Y), (X, Y), …];`"),
            );
            return None;
        }
        let points: Vec<[f64; 2]> = points.iter().map(|point| point.values).collect();
        let spline = spline(&written.name.text, &points, ends);
        if !spline.pieces.iter().flatten().all(|part| part.is_finite()) {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::NotFinite,
                    written.place,
                    "the slopes of this table are too large",
                )
                .label("beyond 1.8e308")
                .help("check the unit and the exponent"),
            );
            return None;
        }
        Some(Table {
            name: written.name.text.clone(),
            docs: written.docs.clone(),
            spline: self.graph.add_spline(spline),
            argument: dimensions[0],
            value: dimensions[1],
            used: false,
            span: written.name.span,
        })
    }

    /// Resolves the points: numbers, with one dimension per column and increasing arguments.
    fn columns(&mut self, written: &syntax::Table) -> Option<Columns> {
        let columns = match &written.points {
            TablePoints::Listed(pairs) => self.listed(pairs),
            TablePoints::InFile {
                path,
                columns,
                units,
            } => self.in_file(path, columns.as_ref(), units.as_ref()),
        }?;
        let mut sound = true;
        for pair in columns.points.windows(2) {
            sound &= self.increases_to(&pair[0], &pair[1]);
        }
        let is_periodic = written
            .ends
            .as_ref()
            .is_some_and(|ends| ends.word.text == "periodic");
        if let (true, [first, .., last]) = (is_periodic && sound, &columns.points[..]) {
            sound = self.returns(first, last);
        }
        sound.then_some(columns)
    }

    /// Resolves the points listed in the description.
    fn listed(&mut self, pairs: &[Pair]) -> Option<Columns> {
        let mut rows: Vec<[Entry<'_>; 2]> = Vec::new();
        let mut sound = true;
        for pair in pairs {
            let [x, y] = [&pair.x, &pair.y].map(|part| self.entry(part));
            let (Some(x), Some(y)) = (x, y) else {
                sound = false;
                continue;
            };
            if let Some(first) = rows.first().copied() {
                for (own, first) in [x, y].into_iter().zip(first) {
                    sound &= self.fits_like(own.0, own.2, (first.0, first.2));
                }
            }
            rows.push([x, y]);
        }
        let joined = |column: usize| {
            let dimensions = rows.iter().map(|row| row[column].2);
            dimensions.reduce(Dimension::joined)
        };
        let dimensions = [joined(0), joined(1)].map(|found| found.unwrap_or(Dimension::Number));
        let points = rows.iter().map(|row| Point {
            values: row.map(|entry| entry.1),
            spans: row.map(|entry| entry.0.span),
            line: None,
        });
        let points = points.collect();
        sound.then_some(Columns { points, dimensions })
    }

    /// True if the argument of a point exceeds that of the previous one; otherwise reports an error.
    fn increases_to(&mut self, before: &Point, point: &Point) -> bool {
        if point.values[0] > before.values[0] {
            return true;
        }
        let message = match point.line {
            Some(line) => format!("the arguments of a table must increase, but not in line {line}"),
            None => "the arguments of a table must increase".to_string(),
        };
        let finding = Diagnostic::error(Code::NotIncreasing, point.spans[0], message)
            .help("order the points by their first value, and give each first value once");
        let finding = match point.line {
            Some(_) => finding.label("the points of this table"),
            None => finding
                .label("not larger than the one before")
                .also(before.spans[0], "the one before"),
        };
        self.diagnostics.push(finding);
        false
    }

    /// Resolves a constant number.
    fn entry<'a>(&mut self, written: &'a Expression) -> Option<Entry<'a>> {
        let (value, dimension) = self.value(written)?;
        if self.graph.is_constant(value) {
            let number = self.graph.constant_value(value)?;
            return Some((written, number, dimension));
        }
        let cause = self.moving(value);
        let cause = cause.as_deref().unwrap_or("a parameter");
        self.diagnostics.push(
            Diagnostic::error(
                Code::NotConstant,
                written.span,
                format!("a table cannot depend on {cause}"),
            )
            .label("expected a number")
            .help("the pieces of a table are computed once; multiply its value where it is used"),
        );
        None
    }

    /// True if a periodic table ends at its initial value; otherwise reports an error.
    fn returns(&mut self, first: &Point, last: &Point) -> bool {
        if first.values[1] == last.values[1] {
            return true;
        }
        let finding = Diagnostic::error(
            Code::PiecesApart,
            last.spans[1],
            "a periodic table must end at the value at which it begins",
        )
        .help("give the first and the last point the same value, or leave out `periodic`");
        let finding = match (first.line, last.line) {
            (Some(first), Some(last)) => finding.label(format!(
                "the values in lines {first} and {last} of the file differ"
            )),
            _ => finding
                .label("not the value of the first point")
                .also(first.spans[1], "it begins here"),
        };
        self.diagnostics.push(finding);
        false
    }

    /// Evaluates `lift(x)`: the value of a declared table.
    pub(super) fn look_up(
        &mut self,
        table: &Name,
        arguments: &[Expression],
        span: Span,
    ) -> Option<Value> {
        let name = &table.text;
        let known = self.declared.table_names.get(name).copied().flatten();
        if let Some(table) = known.and_then(|place| self.declared.tables.get_mut(place)) {
            table.used = true;
        }
        let [written] = arguments else {
            let count = arguments.len();
            self.diagnostics.push(
                Diagnostic::error(
                    Code::WrongArgumentCount,
                    span,
                    format!("the table `{name}` takes 1 argument, not {count}"),
                )
                .label(format!("{count} given"))
                .help(format!("write `{name}(…)` with one expression")),
            );
            return None;
        };
        let argument = self.value(written);
        // A table with an error has been reported.
        let table = self.declared.tables.get(known?)?;
        let (spline, place, value) = (table.spline, table.argument, table.value);
        let (argument, found) = argument?;
        if !found.fits(place) {
            let message = format!(
                "the table `{name}` takes {}, not {}",
                place.name(),
                found.name()
            );
            let finding = Diagnostic::error(Code::WrongDimension, written.span, message)
                .label(format!("this is {}", found.name()))
                .help("divide by a quantity of the same unit, or write bare numbers for SI units");
            let finding = self.with_declarations(finding, &[written]);
            self.diagnostics.push(finding);
            return None;
        }
        Some((self.graph.spline(spline, 0, argument), value))
    }
}
