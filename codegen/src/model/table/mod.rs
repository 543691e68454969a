//! `table` statements → splines, and calls of tables → expressions.
//!
//! A table is a function of any argument, twice continuously differentiable through its points. Its pieces are computed here,
//! once; so its points are numbers: neither t nor a parameter moves them. Deliberately unknown here: what depends on it.

mod pieces;

use self::pieces::{Ends, spline};
use super::dimension::Dimension;
use super::expression::{FUNCTIONS, Value};
use super::law::LAWS;
use super::resolve::Resolver;
use super::{Table, field_name};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::syntax::{self, Expression, Name};

/// How a table may end, for help lines.
const ENDS: &str =
    "a table ends in `;` or `natural;`, in `clamped(SLOPE, SLOPE);`, or in `periodic;`";

/// A number of a table, where it is written, and what it measures.
type Entry<'a> = (&'a Expression, f64, Dimension);

/// The points of a table with what both columns measure.
struct Columns {
    points: Vec<[f64; 2]>,
    dimensions: [Dimension; 2],
}

impl Resolver<'_> {
    /// Declares a table, also where something is wrong with it, so that its uses are not reported too.
    pub(super) fn add_table(&mut self, written: &syntax::Table) {
        let name = &written.name;
        if !self.may_be_declared(name) || !self.may_name_table(name) {
            return;
        }
        let table = self.table(written);
        let place = table.is_some().then_some(self.tables.len());
        match self.table_names.declare(name, place) {
            Some(duplicate) => self.diagnostics.push(duplicate),
            None => self.tables.extend(table),
        }
    }

    /// Reports a name that another function has, or that becomes the same constant as that of another table.
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
        let mut others = self.table_names.iter().map(|(other, _)| other);
        let alike = others
            .find(|other| other.text != text && field_name(&other.text) == field_name(text))
            .map(|other| (other.text.clone(), other.span));
        if let Some((other, span)) = alike {
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
                    written.list,
                    format!("{kind} has at least {least} points, not {given}"),
                )
                .label(format!("{given} given"))
                .help("write `table NAME = [(X, Y), (X, Y), …];`"),
            );
            return None;
        }
        let spline = spline(&written.name.text, &points, ends);
        if !spline.pieces.iter().flatten().all(|part| part.is_finite()) {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::NotFinite,
                    written.list,
                    "the slopes of this table are too large",
                )
                .label("beyond 1.8e308")
                .help("no number of a computer is as large; is a unit or an exponent wrong?"),
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

    /// The points: numbers, each column of one dimension, the first one increasing.
    fn columns(&mut self, written: &syntax::Table) -> Option<Columns> {
        let mut rows: Vec<[Entry<'_>; 2]> = Vec::new();
        let mut sound = true;
        for pair in &written.points {
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
            if let Some(last) = rows.last()
                && x.1 <= last[0].1
            {
                let before = last[0].0.span;
                self.diagnostics.push(
                    Diagnostic::error(
                        Code::NotIncreasing,
                        x.0.span,
                        "the places of a table increase",
                    )
                    .label("not larger than the place before")
                    .also(before, "the place before")
                    .help("order the points by their first value, and give each place once"),
                );
                sound = false;
            }
            rows.push([x, y]);
        }
        let joined = |column: usize| {
            let dimensions = rows.iter().map(|row| row[column].2);
            dimensions.reduce(Dimension::joined)
        };
        let dimensions = [joined(0), joined(1)].map(|found| found.unwrap_or(Dimension::Number));
        let points = rows.iter().map(|row| row.map(|entry| entry.1)).collect();
        let is_periodic = written
            .ends
            .as_ref()
            .is_some_and(|ends| ends.word.text == "periodic");
        if let (true, Some(first), Some(last)) = (is_periodic, rows.first(), rows.last()) {
            sound = sound && self.returns(first[1], last[1]);
        }
        sound.then_some(Columns { points, dimensions })
    }

    /// A number that nothing changes.
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
            .label("a number is wanted here")
            .help("the pieces of a table are computed once; multiply its value where it is used"),
        );
        None
    }

    /// Reports a periodic table that does not end at the value at which it begins.
    fn returns(&mut self, first: Entry<'_>, last: Entry<'_>) -> bool {
        if first.1 == last.1 {
            return true;
        }
        self.diagnostics.push(
            Diagnostic::error(
                Code::PiecesApart,
                last.0.span,
                "a periodic table ends at the value at which it begins",
            )
            .label("not the value of the first point")
            .also(first.0.span, "it begins here")
            .help("give the first and the last point the same value, or leave out `periodic`"),
        );
        false
    }

    /// The end conditions; the slopes of clamped ends are checked where it is known what the columns measure.
    fn ends(
        &mut self,
        written: &syntax::Table,
        dimensions: Option<[Dimension; 2]>,
    ) -> Option<Ends> {
        let Some(ends) = &written.ends else {
            return Some(Ends::Natural);
        };
        match (ends.word.text.as_str(), &ends.slopes[..]) {
            ("natural", []) => return Some(Ends::Natural),
            ("periodic", []) => return Some(Ends::Periodic),
            ("clamped", []) => return Some(Ends::Clamped([0.0; 2])),
            ("clamped", [first, last]) => {
                let slopes = [first, last].map(|slope| self.slope(slope, dimensions));
                let [first, last] = slopes;
                return Some(Ends::Clamped([first?, last?]));
            }
            (word @ ("natural" | "periodic" | "clamped"), slopes) => {
                let wanted = if word == "clamped" {
                    "two slopes"
                } else {
                    "no slopes"
                };
                self.diagnostics.push(
                    Diagnostic::error(
                        Code::WrongArgumentCount,
                        ends.span,
                        format!("`{word}` takes {wanted}, not {}", slopes.len()),
                    )
                    .label(format!("{} given", slopes.len()))
                    .help(ENDS),
                );
            }
            (word, _) => self.diagnostics.push(
                Diagnostic::error(
                    Code::WrongForm,
                    ends.word.span,
                    format!("no table ends in `{word}`"),
                )
                .label("not an end condition")
                .help(ENDS),
            ),
        }
        None
    }

    fn slope(&mut self, written: &Expression, columns: Option<[Dimension; 2]>) -> Option<f64> {
        let (_, slope, found) = self.entry(written)?;
        let expected = columns.map_or(Dimension::Number, |[x, y]| y.times(x, -1));
        if found.fits(expected) {
            return Some(slope);
        }
        self.diagnostics.push(
            Diagnostic::error(
                Code::WrongDimension,
                written.span,
                format!("expected {}, found {}", expected.name(), found.name()),
            )
            .label(format!("this is {}", found.name()))
            .help("a slope is a value over a place, such as `12mm/90deg`"),
        );
        None
    }

    /// `lift(x)`: the value of a declared table.
    pub(super) fn look_up(
        &mut self,
        table: &Name,
        arguments: &[Expression],
        span: Span,
    ) -> Option<Value> {
        let name = &table.text;
        let known = self.table_names.get(name).copied().flatten();
        if let Some(table) = known.and_then(|place| self.tables.get_mut(place)) {
            table.used = true;
        }
        let [written] = arguments else {
            let given = arguments.len();
            self.diagnostics.push(
                Diagnostic::error(
                    Code::WrongArgumentCount,
                    span,
                    format!("the table `{name}` takes 1 argument, not {given}"),
                )
                .label(format!("{given} given"))
                .help(format!("write `{name}(…)` with one expression")),
            );
            return None;
        };
        let argument = self.value(written);
        // A table with an error has been reported.
        let table = self.tables.get(known?)?;
        let (spline, place, value) = (table.spline, table.argument, table.value);
        let (argument, found) = argument?;
        if !found.fits(place) {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::WrongDimension,
                    written.span,
                    format!(
                        "the table `{name}` takes {}, not {}",
                        place.name(),
                        found.name()
                    ),
                )
                .label(format!("this is {}", found.name()))
                .help("divide by a quantity of the same unit, or write bare numbers for SI units"),
            );
            return None;
        }
        Some((self.graph.spline(spline, 0, argument), value))
    }
}
