//! Finds loops of fixed links that cannot close, or close only in a singular pose.
//!
//! Such a loop has constant links and ends, from constants and parameters, in every pose. The generator precomputes its closing,
//! and would take the root of a negative number.

use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::expr::ExprId;
use crate::pool::Pool;
use crate::program::{Block, Statement};
use crate::system::System;
use crate::units::OutputUnit;

/// Largest multiple of ε by which the radicand of a closing is rounding, as in the runtime.
const ROUNDING: f64 = 16.0;

/// Number of digits of a length in a message.
const DIGITS: usize = 4;

/// Range in which plain decimals are short.
const PLAIN_RANGE: [f64; 2] = [1e-4, 1e6];

/// Lengths of a fixed loop, in m.
struct Ends {
    distance: f64,
    longest: f64,
    shortest: f64,
}

/// Returns one error for each block whose fixed links do not close.
pub fn of_blocks(pool: &Pool, system: &System, blocks: &[Block]) -> Diagnostics {
    let mut findings = Diagnostics::new();
    for block in blocks {
        let statements = block.function.statements.iter();
        findings.extend(
            statements
                .filter_map(|it| refusal(it, block, pool, system))
                .take(1),
        );
    }
    findings
}

/// Returns the error; `None` if the closing moves, or if its links reach.
fn refusal(
    statement: &Statement,
    block: &Block,
    pool: &Pool,
    system: &System,
) -> Option<Diagnostic> {
    let Statement::Reach {
        excess,
        scale,
        distance,
        longest,
        shortest,
    } = statement
    else {
        return None;
    };
    let value = |expr: &ExprId| {
        let value = pool.graph.constant_value(*expr)?;
        value.is_finite().then_some(value)
    };
    let (excess_value, scale) = (value(excess)?, value(scale)?);
    let limit = ROUNDING * f64::EPSILON * scale;
    if excess_value > limit {
        return None;
    }
    let ends = Ends {
        distance: value(distance)?,
        longest: value(longest)?,
        shortest: value(shortest)?.abs(),
    };
    let joints = block.joints.iter();
    let joints: Vec<_> = joints.map(|&it| &system.mechanism.joints[it]).collect();
    let (first, others) = joints.split_first()?;
    let title = match others {
        [] => format!("`{}`", first.label),
        [second] => format!("the loop of `{}` and `{}`", first.label, second.label),
        more => format!("the loop of `{}` and {} more", first.label, more.len()),
    };
    let missing = (ends.distance - ends.longest).max(ends.shortest - ends.distance);
    let is_in_line = excess_value >= -limit || missing <= 0.0;
    let unit = system.mechanism.units.of_messages().of("m");
    let error = if is_in_line {
        let message = format!("{title} closes only with its links in line");
        Diagnostic::error(Code::DegenerateGeometry, first.span, message)
            .label("singular in every pose")
            .help("change a length or a place: links in line carry no force across, and their rates are undetermined")
    } else {
        let message = format!(
            "{title} cannot close: out of reach by {}",
            rounded(missing, &unit)
        );
        Diagnostic::error(Code::OutOfReach, first.span, message)
            .label("closes a loop of fixed lengths")
            .help(ends.help(&unit))
    };
    let others = others.iter();
    Some(others.fold(error, |error, it| error.also(it.span, "together with this")))
}

impl Ends {
    fn help(&self, unit: &OutputUnit) -> String {
        let lengths = [self.distance, self.longest, self.shortest];
        let [distance, longest, shortest] = lengths.map(|it| rounded(it, unit));
        let (bridged, changed) = if self.distance > self.longest {
            (format!("at most {longest}"), "lengthen a link, or move")
        } else {
            (
                format!("at least {shortest}"),
                "make the links more alike, or move",
            )
        };
        let apart = if self.distance > self.longest {
            "closer together"
        } else {
            "further apart"
        };
        format!(
            "the ends are {distance} apart, and the links bridge {bridged}: {changed} the ends {apart}"
        )
    }
}

/// Returns a length in a unit with few digits, in plain notation if that is short.
fn rounded(length: f64, unit: &OutputUnit) -> String {
    let rounded = unit.rounded(length, DIGITS);
    if (PLAIN_RANGE[0]..PLAIN_RANGE[1]).contains(&rounded) || rounded == 0.0 {
        format!("{rounded} {}", unit.name)
    } else {
        format!("{rounded:e} {}", unit.name)
    }
}
