//! Builds laws without pieces: polynomials and harmonics.
//!
//! Source: MSC ADAMS, function reference (POLY and SHF).

use super::super::dimension::Dimension;
use super::super::expression::Value;
use super::super::resolve::Resolver;
use crate::diagnostic::Span;
use crate::expr::{ExprId, Rational};
use crate::syntax::Expression;

impl Resolver<'_> {
    /// Evaluates `polynomial(x, x0, a0, a1, …)`: a0 + a1 (x − x0) + a2 (x − x0)² + ….
    pub(super) fn polynomial(&mut self, arguments: &[Expression], span: Span) -> Option<Value> {
        let (given, form) = (arguments.len(), "polynomial(x, x0, a0, a1, …)");
        if given < 3 {
            self.wrong_count("polynomial", "at least 3 arguments", given, form, span);
            return None;
        }
        let values = self.all_values(arguments)?;
        let (x, x0) = (values[0], values[1]);
        if !self.fits_like(&arguments[1], x0.1, (&arguments[0], x.1)) {
            return None;
        }
        let shifted = self.graph.subtract(x.0, x0.0);
        let along = x.1.joined(x0.1);
        let mut terms: Vec<ExprId> = Vec::new();
        let mut dimension = values[2].1;
        for (exponent, (&(coefficient, found), written)) in
            values[2..].iter().zip(&arguments[2..]).enumerate()
        {
            let exponent = i64::try_from(exponent).ok()?;
            let power = along.power(exponent.into(), 1)?;
            let term = match exponent {
                0 => found,
                _ => found.times(power, 1),
            };
            if !self.fits_like(written, term, (&arguments[2], values[2].1)) {
                return None;
            }
            dimension = dimension.joined(term);
            let graph = &mut self.graph;
            let power = graph.power(shifted, Rational::integer(exponent));
            terms.push(graph.multiply(coefficient, power));
        }
        Some((self.graph.sum(&terms), dimension))
    }

    /// Evaluates `harmonic(x, x0, amplitude, frequency, phase, offset)`: amplitude·sin(frequency·(x − x0) − phase) + offset.
    pub(super) fn harmonic(&mut self, arguments: &[Expression], span: Span) -> Option<Value> {
        let form = "harmonic(x, x0, amplitude, frequency, phase, offset)";
        if arguments.len() != 6 {
            self.wrong_count("harmonic", "6 arguments", arguments.len(), form, span);
            return None;
        }
        let values = self.all_values(arguments)?;
        let [x, x0, amplitude, frequency, phase, offset] = values[..] else {
            return None;
        };
        let turning = frequency.1.times(x.1.joined(x0.1), 1);
        let fits = [
            self.fits_like(&arguments[1], x0.1, (&arguments[0], x.1)),
            self.fits_like(&arguments[5], offset.1, (&arguments[2], amplitude.1)),
            self.fits_like(&arguments[4], phase.1, (&arguments[3], turning)),
        ];
        if fits.contains(&false) {
            return None;
        }
        if !turning.fits(Dimension::Angle) {
            self.report_argument(
                "`harmonic` turns by an angle, not by",
                &arguments[3],
                turning,
            );
            return None;
        }
        let graph = &mut self.graph;
        let shifted = graph.subtract(x.0, x0.0);
        let turned = graph.multiply(frequency.0, shifted);
        let angle = graph.subtract(turned, phase.0);
        let sine = graph.sin(angle);
        let wave = graph.multiply(amplitude.0, sine);
        Some((graph.add(wave, offset.0), amplitude.1.joined(offset.1)))
    }
}
