//! Resolves the ends of a table into end conditions.

use super::super::dimension::Dimension;
use super::super::resolve::Resolver;
use super::pieces::Ends;
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::{self, Expression};

/// Forms of the ends, for help lines.
const ENDS: &str =
    "a table ends in `;` or `natural;`, in `clamped(SLOPE, SLOPE);`, or in `periodic;`";

/// Keywords of the ends of tables.
pub const ENDS_OF_TABLES: [&str; 3] = ["natural", "clamped", "periodic"];

impl Resolver<'_> {
    /// Resolves the end conditions; the slopes of clamped ends are checked after the dimensions of the columns are known.
    pub(super) fn ends(
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
            (word, slopes) if ENDS_OF_TABLES.contains(&word) => {
                let count = if word == "clamped" {
                    "two slopes"
                } else {
                    "no slopes"
                };
                self.diagnostics.push(
                    Diagnostic::error(
                        Code::WrongArgumentCount,
                        ends.span,
                        format!("`{word}` takes {count}, not {}", slopes.len()),
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
        let message = format!("expected {}, found {}", expected.name(), found.name());
        let finding = Diagnostic::error(Code::WrongDimension, written.span, message)
            .label(format!("this is {}", found.name()))
            .help("a slope is a value over an argument, such as `12mm/90deg`");
        let finding = self.with_declarations(finding, &[written]);
        self.diagnostics.push(finding);
        None
    }
}
