//! Finds the decimals of an end that hold from both sides.

use linkwright::Shell;

use super::ending::{EndKind, continues, exists, place_before};
use super::line::{DriveLine, LineEnd};
use crate::interpreted::Interpreted;
use crate::number::fixed;

/// Significant digits of a number in double precision that are never rounding.
const DIGITS: i32 = 14;

/// Decimal value of an end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decimals {
    /// Value in the unit of the report.
    pub value: f64,
    /// Number of decimals.
    pub count: usize,
    /// Value on the inner side at which a pose exists: the value itself, or one digit before it.
    pub inner: f64,
}

impl Decimals {
    /// Returns the value as text.
    pub fn text(&self) -> String {
        fixed(self.value, self.count)
    }

    /// True if a pose exists at the value itself. Otherwise the end lies less than one digit from the value.
    pub fn is_inside(&self) -> bool {
        self.inner == self.value
    }
}

/// Line of a drive, on which lengths count in its direction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DriveScale {
    /// 1 if the drive grows along the line, -1 if it shrinks.
    pub sign: f64,
    /// Value of the unit of the report in SI units.
    pub unit: f64,
}

/// Returns the value with as many decimals as hold from both sides, and at most so many.
///
/// `None` if no number of decimals holds, as where the drive starts at its end.
pub(crate) fn decimals(
    line: &DriveLine<'_>,
    end: &LineEnd,
    kind: EndKind,
    (scale, at_most): (DriveScale, usize),
    shell: &Shell<Interpreted>,
) -> Option<Decimals> {
    let along = end.outside / scale.unit;
    let start = end.places.first()?.instant.t() / scale.unit;
    let largest = along.abs().max(start.abs());
    let most = DIGITS - 1 - largest.log10().floor().max(-300.0) as i32;
    let most = usize::try_from(most.clamp(0, 15)).unwrap_or(0);
    (0..=most.min(at_most)).rev().find_map(|count| {
        let step = 10.0_f64.powi(-(count as i32));
        let rounded = |value: f64| format!("{value:.count$}").parse::<f64>().ok();
        // The value is the last one with a pose, or the nearest one if it cannot be decided on which side it lies.
        let floor = (along / step).floor() * step;
        let nearest = (along / step).round() * step;
        let inside = [floor, floor - step].map(|value| [value, value, value + step]);
        let around = [nearest - step, nearest, nearest + step];
        let candidates = match kind {
            EndKind::ChangePoint => vec![around],
            _ => [inside.as_slice(), &[around]].concat(),
        };
        candidates.into_iter().find_map(|[inner, value, outer]| {
            let [inner, value, outer] = [rounded(inner)?, rounded(value)?, rounded(outer)?];
            let at = inner * scale.unit;
            let place = place_before(&end.places, at)?;
            let is_reached = line.reached(place, at, shell).is_some();
            let may_exist = matches!(kind, EndKind::Reach | EndKind::DeadPoint);
            let is_pose = is_reached || (may_exist && exists(line, place, at, shell));
            if !is_pose {
                return None;
            }
            let is_end = !continues(line, end, kind, outer * scale.unit, shell);
            is_end.then_some(Decimals {
                value: scale.sign * value,
                inner: scale.sign * inner,
                count,
            })
        })
    })
}
