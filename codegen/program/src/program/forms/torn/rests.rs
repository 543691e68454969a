//! Derives tearing residuals from the steps of a sequence, with their derivatives in the tearing variables and the inverse of
//! these.

use super::Torn;
use super::sequence::Remaining;
use super::stated::Stated;
use crate::expr::ExprId;
use crate::program::builder::Builder;
use crate::program::function::Level;

/// Tearing residual.
pub(super) struct Rest {
    pub residual: ExprId,
    /// Derivatives in each tearing variable.
    pub slopes: Vec<ExprId>,
}

/// Returns the residuals and their derivatives in the tearing variables, after all steps have been stated.
pub(super) fn rests(
    torn: &Torn,
    steps: &mut [Stated],
    places: &[usize],
    builder: &mut Builder<'_>,
) -> Vec<Rest> {
    for step in steps.iter_mut() {
        if let Stated::Closed(solved) = step {
            solved.prepare(builder);
        }
    }
    for &place in places {
        for step in steps.iter_mut() {
            step.rates(Level::Response(place), builder);
        }
    }
    let mut rests = Vec::with_capacity(places.len());
    for remaining in &torn.sequence.remaining {
        let residual = match *remaining {
            Remaining::Length { step, .. } => match steps[step].link() {
                Some(link) => link.residual(builder),
                None => builder.graph().zero(),
            },
            Remaining::Equation(at) => torn.whole.residuals[at],
        };
        let residual = builder.value("rest", residual);
        let mut slopes = Vec::with_capacity(places.len());
        for &place in places {
            let slope = rest_rate(torn, steps, *remaining, Level::Response(place), builder);
            slopes.push(builder.value("slope", slope));
        }
        rests.push(Rest { residual, slopes });
    }
    rests
}

/// Returns the rate of a tearing residual.
pub(super) fn rest_rate(
    torn: &Torn,
    steps: &[Stated],
    remaining: Remaining,
    level: Level,
    builder: &mut Builder<'_>,
) -> ExprId {
    match remaining {
        Remaining::Equation(at) => builder.rate_at(torn.whole.residuals[at], level),
        Remaining::Length { step, .. } => match steps[step].link() {
            Some(link) => link.residual_rate(level, builder),
            None => builder.graph().zero(),
        },
    }
}

/// Returns the determinant of the derivatives, and their inverse row by row, by Cramer's rule.
pub(super) fn inverse(rests: &[Rest], builder: &mut Builder<'_>) -> (ExprId, Vec<ExprId>) {
    let one = builder.graph().one();
    match rests {
        [first, second] => {
            let ([a, b], [c, d]) = (
                [first.slopes[0], first.slopes[1]],
                [second.slopes[0], second.slopes[1]],
            );
            let determinant = builder.cross([a, b], [c, d]);
            let determinant = builder.value("determinant", determinant);
            let ratio = builder.graph().divide(one, determinant);
            builder.comment(|_| "Inverse of the 2 x 2 matrix of slopes by Cramer's rule".into());
            let ratio = builder.value("inverse", ratio);
            let minus = builder.negated([b, c]);
            let entries = [d, minus[0], minus[1], a];
            let entries = entries.map(|entry| builder.graph().multiply(entry, ratio));
            let entries = entries.map(|entry| builder.value("inverse", entry));
            (determinant, entries.to_vec())
        }
        _ => {
            let determinant = rests.first().map_or(one, |rest| rest.slopes[0]);
            let inverse = builder.graph().divide(one, determinant);
            let inverse = builder.value("inverse", inverse);
            (determinant, vec![inverse])
        }
    }
}
