//! Prepares a search: targets from a table, and the range of the motion.

use linkwright_calibrate::{Target, Targets, Unsearchable};
use linkwright_codegen::stages::system::Derived;
use linkwright_solver::data::{Data, sizes};
use linkwright_solver::full_turn::FullTurn;

use super::super::Problem;
use crate::arguments::Synthesize;

/// Number of steps between the frames of a search.
const STEPS: usize = 90;

/// Range of time over which a solution moves.
#[derive(Clone, Debug)]
pub struct MotionRange {
    /// First and last time (s).
    pub ends: [f64; 2],
    /// Drive that turns once in the range; `None` for another range.
    pub turning: Option<String>,
}

impl MotionRange {
    /// Returns the range that the options and the table give.
    ///
    /// # Errors
    /// The range has no end, is empty, or does not hold all times of the table.
    pub fn of(
        arguments: &Synthesize,
        data: &Data,
        derived: &Derived,
    ) -> Result<MotionRange, Problem> {
        let (first, last) = (data.times.first(), data.times.last());
        let from = arguments.from.or(first.copied()).unwrap_or(0.0);
        let turn = FullTurn::of(derived);
        let needs_turn = arguments.turn || (arguments.to.is_none() && last.is_none());
        let (to, turning) = match (needs_turn, turn) {
            (true, Some(turn)) => (from + turn.period, Some(turn.drive)),
            (true, None) => {
                let why = "no drive turns at a constant rate while the others stand still";
                return Err(Problem(format!(
                    "error: the motion has no full turn: {why}\n  = help: give its end with `--to`"
                )));
            }
            (false, _) => (arguments.to.or(last.copied()).unwrap_or(from), None),
        };
        let is_outside = |t: &f64| *t < from || *t > to;
        if let Some(t) = data.times.iter().find(|t| is_outside(t)) {
            return Err(Problem(format!(
                "error: the row at t = {t} s lies outside of the motion from t = {from} s to {to} s\n  = help: extend the motion with `--from` and `--to`"
            )));
        }
        if to < from || (to == from && data.times.is_empty()) {
            return Err(Problem(format!(
                "error: the motion from t = {from} s to {to} s has no length\n  = help: give a later end with `--to`"
            )));
        }
        Ok(MotionRange {
            ends: [from, to],
            turning,
        })
    }

    /// Returns the frames of a search.
    pub fn frames(&self) -> Vec<f64> {
        let [from, to] = self.ends;
        match to > from {
            true => {
                let inner = (0..STEPS).map(|it| from + (to - from) * it as f64 / STEPS as f64);
                inner.chain([to]).collect()
            }
            false => vec![from],
        }
    }
}

/// Returns the targets of a table, and the permitted difference of each column if it is given.
///
/// # Errors
/// A permitted difference cannot be read.
pub fn targets(
    data: &Data,
    tolerances: &[String],
    derived: &Derived,
) -> Result<(Targets, Vec<Option<f64>>), Problem> {
    let permitted = sizes("--tolerance", tolerances, data).map_err(Problem)?;
    if let Some(place) = permitted.iter().position(|it| *it == Some(0.0)) {
        return Err(Problem(format!(
            "error: the tolerance of `{}` is zero\n  = help: permit some difference",
            data.measured[place].name
        )));
    }
    let columns = data.measured.iter().zip(&permitted);
    let columns = columns.map(|(measured, permitted)| {
        let is_alike = |it: &&linkwright_solver::data::Measured| {
            it.quantity.powers == measured.quantity.powers
        };
        let alike = data.measured.iter().filter(is_alike);
        let extent = alike.fold(0.0_f64, |extent, it| extent.max(extent_of(&it.values)));
        let extent = if extent > 0.0 { extent } else { 1.0 };
        Target {
            name: measured.name.clone(),
            observable: measured.quantity.observable,
            values: measured.values.clone(),
            size: permitted.unwrap_or(extent),
            is_angle: measured.quantity.observable.is_angle(&derived.system),
        }
    });
    let targets = Targets {
        times: (!data.times.is_empty()).then(|| data.times.clone()),
        rows: data.rows(),
        columns: columns.collect(),
    };
    Ok((targets, permitted))
}

/// Returns the difference of the largest and the smallest value.
fn extent_of(values: &[Option<f64>]) -> f64 {
    let numbers = values.iter().flatten();
    let ends = numbers.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], it| {
        [low.min(*it), high.max(*it)]
    });
    (ends[1] - ends[0]).max(0.0)
}

/// Returns the error of a search that cannot begin.
pub fn unsearchable(reason: &Unsearchable) -> Problem {
    let (message, help) = match reason {
        Unsearchable::NoOrder => (
            "the equations have no order of solution".to_string(),
            "check the description with `linkwright check`",
        ),
        Unsearchable::NoParameters => (
            "no parameter is to be chosen".to_string(),
            "name parameters with `--param`",
        ),
        Unsearchable::TooManyParameters(count) => (
            format!(
                "{count} parameters are more than the {} that a search samples",
                linkwright_calibrate::MAX_PARAMETERS
            ),
            "choose fewer with `--param`",
        ),
        Unsearchable::NotDerived(name) => (
            format!(
                "`{name}` is an acceleration or a force, whose dependence on parameters is not derived"
            ),
            "give targets for positions and rates, and leave the column out with `--skip`",
        ),
        Unsearchable::NoRate(name) => (
            format!("`{name}` is a measure, and the rows have no times"),
            "add a column `t`, or give targets for points and angles",
        ),
    };
    Problem(format!("error: {message}\n  = help: {help}"))
}
