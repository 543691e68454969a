//! Resolves `limit` statements into ranges of measures.

use super::dimension::Dimension;
use super::resolve::Resolver;
use super::{range_text, value_text};
use crate::diagnostic::{Code, Diagnostic, Span};
use crate::syntax;
use crate::units::OutputUnits;

/// Range of permitted values of a measure.
#[derive(Clone, Debug, PartialEq)]
pub struct Limit {
    /// Index into the mechanism's measurements.
    pub measurement: usize,
    /// Smallest and largest permitted value in SI units; `None` for an end without a limit.
    pub ends: [Option<f64>; 2],
    /// Dimension of the ends.
    pub dimension: Dimension,
    /// True if a motion under forces ends where the limit is reached.
    pub stops: bool,
    /// Documentation lines.
    pub docs: Vec<String>,
    /// Source location of the statement.
    pub span: Span,
}

impl Limit {
    /// Returns the limit in units of output: `from 20 mm to 80 mm`, `at most 80 mm`.
    pub fn text(&self, units: &OutputUnits) -> String {
        let value = |value| value_text(value, self.dimension, units);
        match self.ends {
            [Some(low), Some(high)] => range_text([low, high], self.dimension, units),
            [Some(low), None] => format!("at least {}", value(low)),
            [None, Some(high)] => format!("at most {}", value(high)),
            [None, None] => String::new(),
        }
    }

    /// Returns the distance of a value to the ends, in SI units: negative beyond an end.
    pub fn margin(&self, value: f64) -> f64 {
        let [low, high] = self.ends;
        let below = low.map_or(f64::INFINITY, |low| value - low);
        let above = high.map_or(f64::INFINITY, |high| high - value);
        below.min(above)
    }
}

impl Resolver<'_> {
    pub(super) fn add_limit(&mut self, written: &syntax::Limit) {
        let name = &written.measure;
        let Some((declaration, place)) = self.declared.measures.found(&name.text) else {
            let unknown = self.declared.measures.unknown(&name.text, name.span);
            self.diagnostics.push(unknown);
            return;
        };
        self.note_use(name, declaration);
        self.note_motor(name);
        // A measure with an error has been reported.
        let Some(measurement) = place else {
            return;
        };
        let mut dimension = self.declared.measurements[measurement].dimension;
        let [low, high] = &written.ends;
        let ends = [low, high].map(|end| end.as_ref().map(|it| self.end(it, &mut dimension)));
        if ends.iter().flatten().any(Option::is_none) {
            return;
        }
        let ends = ends.map(Option::flatten);
        if let ([Some(first), Some(last)], [Some(low), Some(high)]) = (ends, [low, high])
            && first >= last
        {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::ValueNotAllowed,
                    low.span.to(high.span),
                    format!("the limit of `{}` permits no value", name.text),
                )
                .label("the second end is not larger than the first one")
                .help("write the smaller end first: `from 20mm to 80mm`"),
            );
            return;
        }
        let mut limits = self.declared.limits.iter();
        if let Some(earlier) = limits.find(|it| it.measurement == measurement) {
            let finding = Diagnostic::error(
                Code::DuplicateName,
                written.span,
                format!("`{}` has two limits", name.text),
            )
            .also(earlier.span, "the first one")
            .help("write both ends in one limit: `from 20mm to 80mm`");
            self.diagnostics.push(finding);
            return;
        }
        self.declared.limits.push(Limit {
            measurement,
            ends,
            dimension,
            stops: written.stop.is_some(),
            docs: written.docs.clone(),
            span: written.span,
        });
    }
}
