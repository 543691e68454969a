//! Writes a proof of a motion as text.
//!
//! Bounds are rounded outwards.

use std::io::{self, Write};

use linkwright_codegen::stages::units::OutputUnit;
use linkwright_solver::number::{counted, time};
use linkwright_solver::proof::{Enclosed, Proof, Proven};
use linkwright_solver::{Check, View};

use linkwright_page::units::enclosing;

/// Decimals of a bound, and of a bound whose range is shorter than [`NARROW_RANGE`].
const DIGITS: usize = 9;
const MORE_DIGITS: usize = 15;
const NARROW_RANGE: f64 = 1e-4;

/// Writes the proven bounds, or the first window that cannot be proven.
///
/// # Errors
/// Errors of `output`.
pub fn write(check: &Check, proof: &Proof, output: &mut dyn Write) -> io::Result<()> {
    let [from, to] = proof.range.map(time);
    let title = check.interpreted.system().mechanism.title();
    if let Some(proven) = &proof.proven {
        writeln!(
            output,
            "\nproven: `{title}` moves on one smooth path from t = {from} s to {to} s, as drawn"
        )?;
        let windows = counted(proof.windows, "window");
        writeln!(
            output,
            "  {windows} of time cover the range, the shortest of {:.1e} s; at every instant of them:",
            proof.shortest
        )?;
        return write_proven(check, proven, output);
    }
    let Some(unproven) = &proof.unproven else {
        return Ok(());
    };
    let [first, last] = unproven.window.map(time);
    let block = unproven
        .block
        .map_or(String::new(), |block| format!(", block {}", block + 1));
    writeln!(
        output,
        "\nnot proven: the first window that cannot be proven goes from t = {first} s to {last} s{block}: {}",
        unproven.reason
    )?;
    writeln!(
        output,
        "  there the motion is *sampled*: what is said above of the range holds in its frames"
    )
}

fn write_proven(check: &Check, proven: &Proven, output: &mut dyn Write) -> io::Result<()> {
    if !proven.determinants.is_empty() {
        writeln!(output, "  magnitudes of normalized determinants")?;
    }
    for own in &proven.determinants {
        writeln!(
            output,
            "    block {}, {}: at least {} (smallest located {})",
            own.block + 1,
            check.unknowns_of(own.block, own.part),
            rounded(own.least, DIGITS, false),
            rounded(own.located, DIGITS, false),
        )?;
    }
    let (angles, places): (Vec<&Enclosed>, Vec<&Enclosed>) =
        proven.coordinates.iter().partition(|it| it.is_angle);
    let units = check.interpreted.system().mechanism.units.of_tables();
    let (angle, length) = (units.of("rad"), units.of("m"));
    for (title, unit, all) in [("angles", &angle, angles), ("coordinates", &length, places)] {
        if !all.is_empty() {
            writeln!(output, "  {title} ({})", unit.name)?;
        }
        for own in all {
            writeln!(output, "    {} in {}", own.name, range(own.bounds, unit))?;
        }
    }
    if !proven.points.is_empty() {
        writeln!(output, "  points ({})", length.name)?;
    }
    for [x, y] in &proven.points {
        let name = &x.name;
        writeln!(
            output,
            "    {name}: x in {}, y in {}",
            range(x.bounds, &length),
            range(y.bounds, &length)
        )?;
    }
    let mechanism = &check.interpreted.system().mechanism;
    if !proven.measures.is_empty() {
        writeln!(output, "  measures")?;
    }
    for (place, own) in &proven.measures {
        let unit = units.of(&mechanism.measurements[*place].unit());
        let range = unit.labeled(range(own.bounds, &unit));
        writeln!(output, "    {} in {range}", own.name)?;
    }
    let limits = mechanism.limits.iter().filter_map(|limit| {
        let mut measures = proven.measures.iter();
        let (_, own) = measures.find(|it| it.0 == limit.measurement)?;
        let holds = own.bounds.iter().all(|it| limit.margin(*it) >= 0.0);
        let verdict = if holds { "never broken" } else { "not proven" };
        Some((own, limit, verdict))
    });
    for (own, limit, verdict) in limits {
        writeln!(
            output,
            "    limit of {}, {}: {verdict}",
            own.name,
            limit.text(&units)
        )?;
    }
    Ok(())
}

/// Returns bounds in a unit, rounded outwards.
fn range(bounds: [f64; 2], unit: &OutputUnit) -> String {
    let [low, high] = enclosing(unit, bounds);
    let digits = match high - low < NARROW_RANGE {
        true => MORE_DIGITS,
        false => DIGITS,
    };
    format!(
        "[{}, {}]",
        rounded(low, digits, false),
        rounded(high, digits, true)
    )
}

/// Returns a bound with this number of decimals, rounded up or down.
fn rounded(value: f64, digits: usize, upwards: bool) -> String {
    let unit = 10_f64.powi(-i32::try_from(digits).unwrap_or(0));
    let mut tried = value;
    for _ in 0..4 {
        let text = format!("{tried:.digits$}");
        let read: f64 = text.parse().unwrap_or(f64::NAN);
        // Reading the text rounds again, by less than the distance to the next number.
        let is_outside = match upwards {
            true => read > value,
            false => read < value,
        };
        if is_outside || text.trim_start_matches('-').parse() == Ok(0.0) && value == 0.0 {
            return text;
        }
        tried += match upwards {
            true => unit,
            false => -unit,
        };
    }
    format!(
        "{}",
        if upwards {
            value.next_up()
        } else {
            value.next_down()
        }
    )
}

#[cfg(test)]
mod tests {
    use super::rounded;

    #[test]
    fn bounds_are_rounded_outwards() {
        assert_eq!(rounded(0.123_456_789_4, 9, false), "0.123456789");
        assert_eq!(rounded(0.123_456_789_4, 9, true), "0.123456790");
        assert_eq!(rounded(-0.123_456_789_4, 9, false), "-0.123456790");
        assert_eq!(rounded(-0.123_456_789_4, 9, true), "-0.123456789");
        assert_eq!(rounded(0.0, 9, false), "0.000000000");
        assert_eq!(rounded(-1.0, 9, false), "-1.000000001");
    }
}
