//! Reads products of powers of units, and converts numbers between them and SI units.

use std::f64::consts::PI;

use super::{Named, Powers, of_column};

/// A unit of measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// Multiplier and divisor of numbers, separate so that `5 mm` is rounded once.
    times: f64,
    over: f64,
    /// Powers of m, s, kg and rad.
    pub powers: Powers,
    /// True if the rate of an angle in this unit counts turns.
    counts: bool,
}

/// Relative tolerance of equal factors with different rounding, such as `N*mm` and `mN*m`.
const FACTOR_TOLERANCE: f64 = 1e-14;

/// Powers of an angular velocity and of an angular acceleration.
const RATES_OF_ANGLES: [Powers; 2] = [[0, -1, 0, 1], [0, -2, 0, 1]];

impl Unit {
    /// Returns the SI unit with these powers.
    pub fn coherent(powers: [i32; 4]) -> Unit {
        Unit {
            times: 1.0,
            over: 1.0,
            powers,
            counts: false,
        }
    }

    fn named(unit: &Named) -> Unit {
        let [numerator, denominator] = unit.factor.map(|it| it as f64);
        Unit {
            times: if unit.times_pi {
                numerator * PI
            } else {
                numerator
            },
            over: denominator,
            powers: unit.powers,
            counts: unit.counts_turns,
        }
    }

    /// Parses a unit: `mm/s^2`, `deg/s²`, `m/s**2`, `m s-2`, `N*mm`, `U/min`; `None` if a factor is not a unit.
    pub fn parse(text: &str) -> Option<Unit> {
        if let Some(named) = of_column(text.trim()) {
            return Some(Unit::named(named));
        }
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

    /// Converts a value from this unit into SI units.
    pub fn si(&self, value: f64) -> f64 {
        value * self.times / self.over
    }

    /// Converts a value from SI units into this unit.
    pub fn of_si(&self, value: f64) -> f64 {
        value * self.over / self.times
    }

    /// Returns the product with a power of another unit.
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
            counts: self.counts || other.counts,
        }
    }

    /// Returns the unit for a quantity with these powers of m, s, kg and rad; `None` if the unit does not fit.
    ///
    /// Angles may be plain numbers in rad. The rate of an angle in `1/min` or `Hz` counts turns.
    pub fn measuring(self, powers: Powers) -> Option<Unit> {
        if self.counts_turns_of(powers) {
            let turns = Unit {
                times: self.times * 2.0 * PI,
                powers,
                ..self
            };
            return Some(turns);
        }
        let [own, wanted] = [self.powers, powers].map(|it| [it[0], it[1], it[2]]);
        let fits = own == wanted && (self.powers[3] == powers[3] || self.powers[3] == 0);
        fits.then_some(self)
    }

    /// True if values with these powers count turns in this unit: the rate of an angle in `1/min` or `Hz`.
    pub fn counts_turns_of(&self, powers: Powers) -> bool {
        let [length, time, mass, angle] = self.powers;
        let plain = [length, time, mass, 1];
        self.counts && angle == 0 && plain == powers && RATES_OF_ANGLES.contains(&powers)
    }

    /// True if both units have equal values for equal numbers.
    pub fn is_same(&self, other: &Unit) -> bool {
        let [one, two] = [self.times * other.over, other.times * self.over];
        self.powers == other.powers && (one - two).abs() <= FACTOR_TOLERANCE * one.abs()
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
        *self = self.times(Unit::named(of_column(name)?), sign * power);
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
            ("kNm", 1e3, [2, -2, 1, 0]),
            ("mN*m", 1e-3, [2, -2, 1, 0]),
            ("Nmm", 1e-3, [2, -2, 1, 0]),
            ("MN", 1e6, [1, -2, 1, 0]),
            ("t", 1e3, [0, 0, 1, 0]),
            ("lbf", 4.448_221_615_260_5, [1, -2, 1, 0]),
            ("U/min", std::f64::consts::PI / 30.0, [0, -1, 0, 1]),
            (" r/min ", std::f64::consts::PI / 30.0, [0, -1, 0, 1]),
            ("r/s", std::f64::consts::TAU, [0, -1, 0, 1]),
            ("1/s", 1.0, [0, -1, 0, 0]),
            ("-", 1.0, [0, 0, 0, 0]),
        ] {
            let unit = Unit::parse(text).unwrap_or_else(|| panic!("{text}"));
            assert!((unit.si(1.0) / value - 1.0).abs() < 1e-15, "{text}");
            assert_eq!(unit.powers, powers, "{text}");
        }
        assert_eq!(Unit::parse("mm").map(|it| it.si(5.0)), Some(0.005));
        for text in [
            "", "x", "m//s", "m/", "mm^9", "MS", "2", "m^", "/s", "U", "r",
        ] {
            assert!(Unit::parse(text).is_none(), "{text}");
        }
    }

    #[test]
    fn rates_of_angles_count_turns() {
        let rate = [0, -1, 0, 1];
        for (text, value) in [
            ("1/min", std::f64::consts::PI / 30.0),
            ("min^-1", std::f64::consts::PI / 30.0),
            ("Hz", std::f64::consts::TAU),
            // Without a unit of angles, 1/s is rad/s.
            ("1/s", 1.0),
            ("rad/min", 1.0 / 60.0),
        ] {
            let unit = Unit::parse(text).and_then(|it| it.measuring(rate));
            let unit = unit.unwrap_or_else(|| panic!("{text}"));
            assert!((unit.si(1.0) / value - 1.0).abs() < 1e-15, "{text}");
        }
        let hertz = Unit::parse("Hz").expect("a unit");
        assert_eq!(
            hertz.measuring([0, -1, 0, 0]).map(|it| it.si(1.0)),
            Some(1.0)
        );
        assert!(hertz.measuring([1, -1, 0, 0]).is_none());
        let per_minute = Unit::parse("Hz/min").and_then(|it| it.measuring([0, -2, 0, 1]));
        assert!(per_minute.is_some_and(|it| (it.si(60.0) - std::f64::consts::TAU).abs() < 1e-14));
    }
}
