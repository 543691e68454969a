//! Rewrites a description with new values of parameters and new poses of bodies; all other text is unchanged.
//!
//! A value keeps its unit and has all digits: reading it restores the fitted value up to the rounding of one multiplication. The new
//! text is read for a check: it must be the same description with these values.

use linkwright_codegen::diagnostic::{Diagnostics, Source};
use linkwright_codegen::stages::columns::Unit;
use linkwright_codegen::stages::model::Dimension;
use linkwright_codegen::stages::syntax::{Statement, parse};
use linkwright_codegen::stages::system::{Derived, System};

use crate::output::{Beginning, Record, Signature};

/// Largest relative difference of a written value from the fitted one.
const VALUE_TOLERANCE: f64 = 1e-12;

/// Signature that no file has: a description is never replaced without `--force`.
pub const SIGNATURE: Signature = Signature {
    noun: "a new file",
    beginning: Beginning::Line(|_| false),
    record: Record::None,
};

/// Body with its position (m) and its angle (rad).
pub type BodyPose<'a> = (&'a str, [f64; 3]);

/// Relative precision of the positions in a pose.
const POSE_PRECISION: f64 = 1e-5;

/// Number of millimeters in a meter.
const MILLIMETERS: f64 = 1000.0;

/// Number of steps in a degree to which the angle of a pose is rounded.
const ANGLE_STEPS: f64 = 1000.0;

/// Returns the text with these values, which are in SI units, and with these poses in the design configuration.
///
/// # Errors
/// A parameter or a body is not declared in a place where it can be replaced.
pub fn rewritten(
    source: &Source,
    values: &[(&str, f64)],
    poses: &[BodyPose<'_>],
    derived: &Derived,
) -> Result<String, String> {
    let Derived { pool, system } = derived;
    let document = parse(source, &mut Diagnostics::new());
    let statements = document.map_or(Vec::new(), |it| it.mechanism.statements);
    let mut edits = Vec::new();
    for (name, value) in values {
        let declared = of_motion(&statements, system).find_map(|it| match it {
            Statement::Parameter(own) if own.constant.name.text == *name => Some(&own.constant),
            _ => None,
        });
        let parameter = system
            .mechanism
            .parameters
            .iter()
            .find(|it| it.name == *name);
        let (Some(declared), Some(parameter)) = (declared, parameter) else {
            return Err(format!(
                "error: `{name}` is not declared where it could be replaced"
            ));
        };
        let nominal = pool.graph.constant_value(parameter.nominal).unwrap_or(0.0);
        let range = declared.value.span.range();
        let before = &source.text[range.clone()];
        let now = in_its_unit(before, nominal, *value)
            .unwrap_or_else(|| in_si(*value, parameter.dimension));
        edits.push((range, now));
    }
    for (name, pose) in poses {
        let declared = statements.iter().find_map(|it| match it {
            Statement::Body(own) if own.name.text == *name => Some(own),
            _ => None,
        });
        let place = declared.and_then(|it| {
            let (start, end) = (it.name.span.range().end, it.span.range().end);
            let length = source.text.get(start..end)?.find('{')?;
            Some(start..start + length)
        });
        let place = place.ok_or_else(|| {
            format!("error: the pose of `{name}` is not written where it could be replaced")
        })?;
        edits.push((place, at(*pose)));
    }
    edits.sort_by_key(|it| std::cmp::Reverse(it.0.start));
    let mut text = source.text.clone();
    for (range, now) in edits {
        text.replace_range(range, &now);
    }
    confirm(source, &text, values, system)?;
    Ok(text)
}

/// Returns the statements outside of motions, and those of the motion of this system.
fn of_motion<'a>(
    statements: &'a [Statement],
    system: &'a System,
) -> impl Iterator<Item = &'a Statement> {
    let motion = system.mechanism.motion.as_ref();
    let motions = statements.iter().filter_map(move |it| match it {
        Statement::Motion(one) if motion.is_some_and(|it| it.name == one.name.text) => Some(one),
        _ => None,
    });
    statements
        .iter()
        .chain(motions.flat_map(|it| &it.statements))
}

/// Checks the new text by reading it.
fn confirm(
    source: &Source,
    text: &str,
    values: &[(&str, f64)],
    fitted: &System,
) -> Result<(), String> {
    let new = Source {
        text: text.to_string(),
        ..source.clone()
    };
    let read = linkwright_codegen::read(&new).map_err(|found| found.render(&new))?;
    let motion = fitted.mechanism.motion.as_ref();
    let derived = match motion {
        Some(motion) => read.motion(&motion.name),
        None => read.motions.first(),
    };
    let Some(Derived { pool, system }) = derived else {
        return Ok(());
    };
    let mechanism = &system.mechanism;
    for (name, value) in values {
        let parameter = mechanism.parameters.iter().find(|it| it.name == *name);
        let rewritten = parameter.and_then(|it| pool.graph.constant_value(it.nominal));
        let allowed = VALUE_TOLERANCE * value.abs();
        if rewritten.is_none_or(|it| (it - value).abs() > allowed) {
            return Err(format!(
                "error: `{name}` cannot be replaced as it is written\n  = help: write its value as a number with a unit, such as `40mm`"
            ));
        }
    }
    Ok(())
}

/// Rewrites `40mm` as `40.127mm`, `3/1s` as `3.004/1s`; `None` if the text is not a number with a unit.
fn in_its_unit(before: &str, nominal: f64, value: f64) -> Option<String> {
    let is_digit = |it: char| it.is_ascii_digit() || matches!(it, '.' | '-' | '_');
    let before = before.trim();
    let end = before.find(|it| !is_digit(it)).unwrap_or(before.len());
    let (number, unit) = before.split_at(end);
    let rate = unit.split_once("/1");
    let letters = |it: &str| it.chars().all(|it| it.is_ascii_alphabetic());
    let is_unit = match rate {
        Some((above, below)) => letters(above) && letters(below),
        None => letters(unit),
    };
    let written: f64 = number.replace('_', "").parse().ok()?;
    if !is_unit {
        return None;
    }
    let value = match written == 0.0 || nominal == 0.0 {
        // Zero does not tell the size of its unit.
        true => Unit::parse(unit)?.of_si(value),
        false => value * (written / nominal),
    };
    Some(format!("{value}{unit}"))
}

/// Writes a pose: ` at (40mm, 0mm, 30deg) `.
fn at([x, y, angle]: [f64; 3]) -> String {
    let extent = x.abs().max(y.abs());
    // An estimate needs few digits.
    let length = |value: f64| {
        let step = 10.0_f64.powf((POSE_PRECISION * extent).log10().floor());
        let rounded = match step > 0.0 {
            true => (value / step).round() * step,
            false => 0.0,
        };
        format!("{}mm", short(MILLIMETERS * rounded))
    };
    let angle = short((angle.to_degrees() * ANGLE_STEPS).round() / ANGLE_STEPS);
    format!(" at ({}, {}, {angle}deg) ", length(x), length(y))
}

/// Returns a number without the digits of rounding.
fn short(value: f64) -> f64 {
    format!("{value:.9e}").parse().unwrap_or(value) + 0.0
}

/// Writes a value in SI units: `0.04m`, `0.3rad`, `2.5*1m/1s`.
fn in_si(value: f64, dimension: Dimension) -> String {
    let number = value.to_string();
    match dimension {
        Dimension::Angle => format!("{number}rad"),
        Dimension::Marked {
            length: 1,
            time: 0,
            mass: 0,
        } => format!("{number}m"),
        Dimension::Marked { length, time, mass } => {
            let units = [("m", length), ("s", time), ("kg", mass)];
            let factor = |(unit, power): (&str, i32)| {
                let sign = if power < 0 { "/" } else { "*" };
                format!("{sign}1{unit}").repeat(power.unsigned_abs() as usize)
            };
            number + &units.map(factor).concat()
        }
        _ => number,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_keep_their_units() {
        let of = in_its_unit;
        assert_eq!(
            of("40mm", 0.04, 0.041_234_567_891_23).as_deref(),
            Some("41.23456789123mm")
        );
        assert_eq!(
            of("-0.5", -0.5, -0.512_345_678_9).as_deref(),
            Some("-0.5123456789")
        );
        assert_eq!(of("0mm", 0.0, 0.25).as_deref(), Some("250mm"));
        assert_eq!(of("3/1s", 3.0, 3.001).as_deref(), Some("3.001/1s"));
        assert_eq!(of("0.1 + 0.2", 0.3, 0.4), None);
        assert_eq!(of("sqrt(2)*1m", 1.414, 1.5), None);
        let speed = Dimension::Marked {
            length: 1,
            time: -2,
            mass: 0,
        };
        assert_eq!(in_si(9.81, speed), "9.81*1m/1s/1s");
    }
}
