//! Finds the contact of a joint with its curve in the design configuration, and reports impossible or doubtful contacts.
//!
//! The contact minimizes the residuals of the joint's rows in the estimated pose, independently of the kind.

use super::curve::{DrawnCurve, shown};
use super::operands::WrittenJoint;
use super::resolve::Resolver;
use super::search::{Along, Minima, Minimum, minima};
use crate::diagnostic::{Code, Diagnostic};
use crate::expr::{ExprId, Number, SymbolId};
use crate::joint::{Curve, Resolved};
use crate::syntax::Reference;

/// Tolerance on the residual for an equally good contact, relative to the size of the curve.
const EQUIVALENCE_TOLERANCE: f64 = 1e-3;

/// Distance beyond which a contact is reported as far away, relative to the size of the curve.
const DISTANCE_LIMIT: f64 = 0.25;

/// Inverse of the unit to which estimates are rounded. Eight decimals suffice, and are equal on every machine.
const ESTIMATED_TO: f64 = 1e8;

impl Resolver<'_> {
    /// Returns the curve of this name; `None` also if its statement has an error.
    pub(super) fn named_curve(&mut self, reference: &Reference) -> Option<DrawnCurve> {
        let name = &reference.name;
        if let (None, Some((declaration, curve))) =
            (&reference.body, self.declared.curves.found(&name.text))
        {
            self.note_use(name, declaration);
            return curve;
        }
        let diagnostic = match &reference.body {
            Some(_) => Diagnostic::error(
                Code::WrongForm,
                reference.span,
                "expected a curve, found a point",
            )
            .help("declare `curve NAME(s) on BODY = (X, Y);` and write its name alone"),
            None => self.declared.curves.unknown(&name.text, name.span),
        };
        self.diagnostics.push(diagnostic);
        None
    }

    /// Returns the curve with a separate parameter for this joint; [`Resolver::touch`] finds the contact.
    pub(super) fn touched_curve(&mut self, drawn: &DrawnCurve, slug: &str) -> Curve {
        let base = format!("s_{slug}");
        let numbered = (2..).map(|number| format!("{base}_{number}"));
        let free = std::iter::once(base.clone())
            .chain(numbered)
            .find(|name| self.graph.find_symbol(name).is_none());
        let parameter = self.graph.symbol(&free.unwrap_or(base));
        let frame = self.linkage.bodies[drawn.body.0].frame;
        let variable = self.graph.variable(parameter);
        let (zero, one) = (self.graph.zero(), self.graph.one());
        let point = drawn
            .point
            .map(|part| self.graph.substitute(part, &[(drawn.parameter, variable)]));
        Curve {
            frame,
            axis: frame.rotate([one, zero], &mut self.graph),
            parameter,
            quantity: drawn.quantity,
            point,
            range: [drawn.range.from, drawn.range.to],
            side: one,
            estimate: zero,
        }
    }

    /// Finds position and side of the contact in the design configuration. `None` after an error.
    pub(super) fn touch(
        &mut self,
        given: &WrittenJoint<'_>,
        drawn: &DrawnCurve,
        mut operands: Resolved,
    ) -> Option<Resolved> {
        let curve = operands.curve?;
        let one = self.graph.one();
        let mut searched: Vec<(ExprId, Minima)> = Vec::new();
        let mut stated: Vec<Vec<ExprId>> = Vec::new();
        for side in [one, self.graph.negate(one)] {
            operands.curve = Some(Curve { side, ..curve });
            let rows = given.kind.rows(&operands, &mut self.graph);
            let rows: Vec<ExprId> = rows.iter().map(|row| row.residual).collect();
            // A kind that is independent of the side has equal rows for both.
            if !stated.contains(&rows) {
                let mut along = self.along(&rows, curve.parameter);
                searched.push((side, minima(drawn.range, |place| along.square(place))));
                stated.push(rows);
            }
        }
        let mut along = self.along(&drawn.point, drawn.parameter);
        self.graph.spend(along.work());
        // Half the larger side of the bounding box, wherever the box is in the frame of the body.
        let size = [0, 1]
            .map(|axis| {
                let extrema = minima(drawn.range, |place| along.at(place)[axis]);
                let least = extrema.first().map_or(extrema.largest, |least| least.cost);
                0.5 * (extrema.largest - least)
            })
            .into_iter()
            .fold(0.0, f64::max);
        let candidates = searched
            .iter()
            .flat_map(|(side, minima)| minima.iter().map(|minimum| (*side, *minimum)));
        let candidates: Vec<(ExprId, Minimum)> = candidates.collect();
        let best = candidates
            .iter()
            .min_by(|(_, one), (_, other)| one.cost.total_cmp(&other.cost));
        let Some(&(side, Minimum { place, cost })) = best else {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::DegenerateGeometry,
                    given.span,
                    "this curve is undefined, or without a normal, over its whole range",
                )
                .help("check the formula of the curve"),
            );
            return None;
        };
        let distance = cost.sqrt();
        let [x, y] = [along.at(place)[0], along.at(place)[1]];
        let rival = candidates.iter().find(|(other, minimum)| {
            let there = along.at(minimum.place);
            let apart = (there[0] - x).hypot(there[1] - y) > EQUIVALENCE_TOLERANCE * size;
            (apart || *other != side)
                && minimum.cost.sqrt() - distance <= EQUIVALENCE_TOLERANCE * size
        });
        let is_even = searched
            .iter()
            .any(|(_, minima)| minima.largest.sqrt() - distance <= EQUIVALENCE_TOLERANCE * size);
        let doubt = match rival {
            _ if is_even => Some("every point of it is equally near".to_string()),
            Some((other, _)) if *other != side => Some(format!(
                "both sides of it are equally near, at {}",
                shown(place, drawn.quantity)
            )),
            Some((_, rival)) => {
                let (low, high) = (place.min(rival.place), place.max(rival.place));
                Some(format!(
                    "{} and {} are equally near",
                    shown(low, drawn.quantity),
                    shown(high, drawn.quantity)
                ))
            }
            None => None,
        };
        if let Some(doubt) = doubt {
            self.diagnostics.push(
                Diagnostic::error(
                    Code::DegenerateGeometry,
                    given.span,
                    "the design configuration does not determine the contact point",
                )
                .label(doubt)
                .help("place the bodies so that one point of the curve is nearest"),
            );
            return None;
        }
        if distance > DISTANCE_LIMIT * size {
            let unit = self.formulas.reported().of("m");
            let away = unit.rounded(distance, 3);
            self.diagnostics.push(
                Diagnostic::warning(
                    Code::DegenerateGeometry,
                    given.span,
                    format!(
                        "in the design configuration this is {away} {} away from its curve",
                        unit.name
                    ),
                )
                .label(format!("nearest at {}", shown(place, drawn.quantity)))
                .help("place the bodies in contact; the mechanism is assembled from there"),
            );
        }
        let rounded = (place * ESTIMATED_TO).round() / ESTIMATED_TO;
        let estimate = self.graph.number(Number::float(rounded));
        operands.curve = Some(Curve {
            side,
            estimate,
            ..curve
        });
        self.warn_of_hollows(given, drawn, &operands, rounded);
        Some(operands)
    }

    /// Warns if the shape of the curve prevents contact.
    fn warn_of_hollows(
        &mut self,
        given: &WrittenJoint<'_>,
        drawn: &DrawnCurve,
        operands: &Resolved,
        place: f64,
    ) {
        let Some(curve) = operands.curve else { return };
        let contact = given.kind.contact(operands, &mut self.graph);
        let Some((fit, problem)) = contact.and_then(|contact| contact.fit) else {
            return;
        };
        let mut along = self.along(&[fit], curve.parameter);
        let sign = along.at(place)[0].signum();
        let worst = minima(drawn.range, |place| sign * along.at(place)[0]).first();
        if let Some(worst) = worst
            && worst.cost <= 0.0
        {
            self.diagnostics.push(
                Diagnostic::warning(
                    Code::DegenerateGeometry,
                    given.span,
                    format!("{problem} at {}", shown(worst.place, drawn.quantity)),
                )
                .label("would touch the curve at two points there")
                .help(
                    "the equations describe one contact only: give the curve another shape there",
                ),
            );
        }
    }

    /// Returns expressions as functions of a parameter, with all other symbols at the design configuration. Counts the work of
    /// a later search.
    pub(super) fn along(&mut self, parts: &[ExprId], parameter: SymbolId) -> Along {
        let along = Along::new(&self.graph, parts, parameter, |symbol| {
            self.drawn_value(symbol)
        });
        self.graph.spend(along.work());
        along
    }

    /// Returns the value of a symbol in the design configuration, at t = 0.
    pub(super) fn drawn_value(&self, symbol: SymbolId) -> f64 {
        let coordinate = self.linkage.coordinate_places.get(&symbol);
        let estimate = coordinate.map(|&(body, axis)| self.linkage.bodies[body.0].estimate()[axis]);
        let value = estimate.and_then(|drawn| self.graph.constant_value(drawn));
        value.or(self.graph.nominal(symbol)).unwrap_or(0.0)
    }
}
