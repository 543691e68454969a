//! *The text of a unit* → *what a number of it is in m, rad, s and kg*.

use std::f64::consts::PI;

/// A unit of measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    times: f64,
    over: f64,
    /// Powers of m, s, kg and rad.
    pub powers: [i32; 4],
}

/// What a number of a unit is multiplied by and divided by, so that `5 mm` is rounded once; and the powers of m, s, kg and rad.
type Known = (&'static [&'static str], f64, f64, Powers);

/// Powers of m, s, kg and rad.
type Powers = [i32; 4];

const LENGTH: Powers = [1, 0, 0, 0];
const TIME: Powers = [0, 1, 0, 0];
const MASS: Powers = [0, 0, 1, 0];
const ANGLE: Powers = [0, 0, 0, 1];

const KNOWN: [Known; 27] = [
    (&["1", "-", "–", "none", "no_units"], 1.0, 1.0, [0; 4]),
    (
        &["m", "meter", "meters", "metre", "metres"],
        1.0,
        1.0,
        LENGTH,
    ),
    (
        &[
            "mm",
            "millimeter",
            "millimeters",
            "millimetre",
            "millimetres",
        ],
        1.0,
        1_000.0,
        LENGTH,
    ),
    (
        &["cm", "centimeter", "centimeters", "centimetre"],
        1.0,
        100.0,
        LENGTH,
    ),
    (&["dm"], 1.0, 10.0, LENGTH),
    (&["km"], 1_000.0, 1.0, LENGTH),
    (&["um", "µm", "μm", "micrometer"], 1.0, 1_000_000.0, LENGTH),
    (&["in", "inch", "inches"], 254.0, 10_000.0, LENGTH),
    (&["ft", "foot", "feet"], 3048.0, 10_000.0, LENGTH),
    (&["s", "sec", "second", "seconds", "secs"], 1.0, 1.0, TIME),
    (
        &["ms", "msec", "millisecond", "milliseconds"],
        1.0,
        1_000.0,
        TIME,
    ),
    (
        &["us", "µs", "μs", "microsecond", "microseconds"],
        1.0,
        1_000_000.0,
        TIME,
    ),
    (&["ns"], 1.0, 1_000_000_000.0, TIME),
    (&["min", "minute", "minutes"], 60.0, 1.0, TIME),
    (&["h", "hour", "hours"], 3600.0, 1.0, TIME),
    (&["kg"], 1.0, 1.0, MASS),
    (&["g"], 1.0, 1_000.0, MASS),
    (&["rad", "radian", "radians"], 1.0, 1.0, ANGLE),
    (&["mrad"], 1.0, 1_000.0, ANGLE),
    (
        &["deg", "°", "degree", "degrees", "grad°"],
        PI,
        180.0,
        ANGLE,
    ),
    (
        &["rev", "turn", "turns", "revolutions"],
        2.0 * PI,
        1.0,
        ANGLE,
    ),
    (&["rpm"], PI, 30.0, [0, -1, 0, 1]),
    (&["Hz", "hz"], 1.0, 1.0, [0, -1, 0, 0]),
    (&["N", "newton", "newtons"], 1.0, 1.0, [1, -2, 1, 0]),
    (&["kN"], 1_000.0, 1.0, [1, -2, 1, 0]),
    (&["J", "joule", "joules", "Nm"], 1.0, 1.0, [2, -2, 1, 0]),
    (&["W", "watt", "watts"], 1.0, 1.0, [2, -3, 1, 0]),
];

impl Unit {
    /// The unit of SI with these powers.
    pub fn coherent(powers: [i32; 4]) -> Unit {
        Unit {
            times: 1.0,
            over: 1.0,
            powers,
        }
    }

    /// `mm/s^2`, `deg/s²`, `m/s**2`, `m s-2`, `N*mm`; `None` where a part of it is no unit.
    pub fn parse(text: &str) -> Option<Unit> {
        let text = text
            .trim()
            .replace("**", "^")
            .replace('²', "^2")
            .replace('³', "^3");
        let text = text
            .replace("⁻^", "^-")
            .replace("⁻¹", "^-1")
            .replace("⁻", "^-");
        let text = text.replace("^-^", "^-");
        let mut unit = Unit::coherent([0; 4]);
        let (mut sign, mut start) = (1, 0);
        let is_break = |it: char| matches!(it, '/' | '*' | '·' | '⋅' | ' ' | '.');
        for (place, it) in text.char_indices().chain([(text.len(), '*')]) {
            if !is_break(it) {
                continue;
            }
            let part = &text[start..place];
            start = place + it.len_utf8();
            if !part.is_empty() {
                unit.take(part, sign)?;
                sign = 1;
            } else if it != ' ' && !text[..place].ends_with(' ') {
                return None;
            }
            if it == '/' {
                sign = -1;
            }
        }
        (!text.is_empty()).then_some(unit)
    }

    /// A value of this unit in SI units.
    pub fn si(&self, value: f64) -> f64 {
        value * self.times / self.over
    }

    /// A value in SI units in this unit.
    pub fn of_si(&self, value: f64) -> f64 {
        value * self.over / self.times
    }

    /// The product of two units, the second one to a power.
    pub fn times(self, other: Unit, power: i32) -> Unit {
        let (times, over) = match power < 0 {
            true => (other.over, other.times),
            false => (other.times, other.over),
        };
        let mut powers = self.powers;
        for (own, more) in powers.iter_mut().zip(other.powers) {
            *own += power * more;
        }
        Unit {
            times: self.times * times.powi(power.abs()),
            over: self.over * over.powi(power.abs()),
            powers,
        }
    }

    /// Whether values of this unit can measure what has these powers of m, s, kg and rad: angles may be plain numbers.
    pub fn measures(&self, powers: [i32; 4]) -> bool {
        let [own, wanted] = [self.powers, powers].map(|it| [it[0], it[1], it[2]]);
        own == wanted && (self.powers[3] == powers[3] || self.powers[3] == 0)
    }

    /// Multiplies by `s^2`, `s2` or `s`.
    fn take(&mut self, part: &str, sign: i32) -> Option<()> {
        let digits = part.trim_end_matches(|it: char| it.is_ascii_digit());
        let (name, power) = match part.split_once('^') {
            Some((name, power)) => (name, power.parse().ok()?),
            None if digits.is_empty() || digits.len() == part.len() => (part, 1),
            None => match digits.strip_suffix('-') {
                Some(name) => (name, -part[digits.len()..].parse::<i32>().ok()?),
                None => (digits, part[digits.len()..].parse().ok()?),
            },
        };
        let power: i32 = power;
        if !(-4..=4).contains(&power) {
            return None;
        }
        let lower = name.to_lowercase();
        let exact = KNOWN.iter().find(|it| it.0.contains(&name));
        // Words are also written in capitals; symbols are not, since `MS` is nothing.
        let word = || {
            KNOWN
                .iter()
                .find(|it| lower.len() > 2 && it.0.contains(&lower.as_str()))
        };
        let &(_, times, over, powers) = exact.or_else(word)?;
        *self = self.times(
            Unit {
                times,
                over,
                powers,
            },
            sign * power,
        );
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::Unit;

    #[test]
    fn units_are_products_of_powers() {
        for (text, value, powers) in [
            ("mm", 1e-3, [1, 0, 0, 0]),
            ("m/s", 1.0, [1, -1, 0, 0]),
            ("mm/s^2", 1e-3, [1, -2, 0, 0]),
            ("mm / s²", 1e-3, [1, -2, 0, 0]),
            ("m/s**2", 1.0, [1, -2, 0, 0]),
            ("m/s2", 1.0, [1, -2, 0, 0]),
            ("m/s/s", 1.0, [1, -2, 0, 0]),
            ("m s-2", 1.0, [1, -2, 0, 0]),
            ("rad*s^-1", 1.0, [0, -1, 0, 1]),
            ("deg/sec", std::f64::consts::PI / 180.0, [0, -1, 0, 1]),
            ("°", std::f64::consts::PI / 180.0, [0, 0, 0, 1]),
            ("rpm", std::f64::consts::PI / 30.0, [0, -1, 0, 1]),
            ("Seconds", 1.0, [0, 1, 0, 0]),
            ("N*mm", 1e-3, [2, -2, 1, 0]),
            ("1/s", 1.0, [0, -1, 0, 0]),
            ("-", 1.0, [0, 0, 0, 0]),
        ] {
            let unit = Unit::parse(text).unwrap_or_else(|| panic!("{text}"));
            assert!((unit.si(1.0) / value - 1.0).abs() < 1e-15, "{text}");
            assert_eq!(unit.powers, powers, "{text}");
        }
        assert_eq!(Unit::parse("mm").map(|it| it.si(5.0)), Some(0.005));
        for text in ["", "x", "m//s", "m/", "mm^9", "MS", "2", "m^", "/s"] {
            assert!(Unit::parse(text).is_none(), "{text}");
        }
    }
}
