//! Chooses the units in which values are printed and written.
//!
//! A chosen unit applies to its quantity. Units of length, angle, mass and force also apply to derived quantities: mm implies
//! mm/s and N/mm. Torques, energies and powers are independent: N*m remains beside mm until `N*mm` is chosen. Times are in s.

use std::fmt::Display;

use super::{ANGLE, ANGULAR_VELOCITY, FORCE, LENGTH, MASS, Powers, TORQUE, Unit, of_description};

/// Base quantities with their SI units.
const BASES: [(&str, Powers); 4] = [("m", LENGTH), ("rad", ANGLE), ("kg", MASS), ("N", FORCE)];

/// Quantities for which a unit can be chosen.
const QUANTITIES: [Powers; 9] = [
    LENGTH,
    ANGLE,
    MASS,
    FORCE,
    TORQUE,
    [1, -1, 0, 0],
    [1, -2, 0, 0],
    ANGULAR_VELOCITY,
    [0, -2, 0, 1],
];

/// SI units of energy and power, which are never used for torques.
const ENERGIES: [&str; 2] = ["J", "W"];

/// Unit of a value that is printed or written.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputUnit {
    /// Name, such as `mm/s²`; empty for plain numbers.
    pub name: String,
    unit: Unit,
}

impl OutputUnit {
    fn coherent(si: &str) -> OutputUnit {
        OutputUnit {
            name: si.to_string(),
            unit: Unit::coherent([0; 4]),
        }
    }

    /// True if values in this unit are those in SI units.
    pub fn is_si(&self) -> bool {
        self.unit.is_same(&Unit::coherent(self.unit.powers))
    }

    /// Returns a value in this unit from its value in SI units.
    pub fn of_si(&self, value: f64) -> f64 {
        self.unit.of_si(value)
    }

    /// Returns a value in this unit, rounded to so many significant digits.
    pub fn rounded(&self, si: f64, digits: usize) -> f64 {
        let value = self.of_si(si);
        let text = format!("{value:.*e}", digits.saturating_sub(1));
        text.parse().unwrap_or(value)
    }

    /// Returns a value that is written in this unit with the name of the unit: `80 mm`; numbers without a unit stay alone.
    pub fn labeled(&self, value: impl Display) -> String {
        match self.name.as_str() {
            "" => value.to_string(),
            name => format!("{value} {name}"),
        }
    }
}

/// Units of output, one for each quantity that has one; SI units for all others.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OutputUnits {
    chosen: Vec<OutputUnit>,
}

impl OutputUnits {
    /// Chooses a unit by its text, such as `mm`, `N*mm`, `rpm`.
    ///
    /// # Errors
    /// Returns the message and the help of an error if the text is not a unit, if its quantity is not reported, or if the
    /// quantity has a unit already.
    pub fn choose(&mut self, text: &str) -> Result<(), [String; 2]> {
        let Some(unit) = Unit::parse(text) else {
            return Err([
                format!("no unit is named `{text}`"),
                "write units as in `mm, deg, N, N*mm, rpm`".to_string(),
            ]);
        };
        if !QUANTITIES.contains(&unit.powers) {
            return Err([
                format!("`{text}` is not a unit of output"),
                "choose units of length, angle, mass, force, torque, velocity or acceleration; times are in s".to_string(),
            ]);
        }
        let others = self.chosen.iter();
        if let Some(other) = others.clone().find(|it| it.unit.powers == unit.powers) {
            return Err([
                format!("`{}` and `{text}` measure the same", other.name),
                "leave out one of them".to_string(),
            ]);
        }
        self.chosen.push(OutputUnit {
            name: text.to_string(),
            unit,
        });
        Ok(())
    }

    /// Chooses units from a list, such as `mm, deg`.
    ///
    /// # Errors
    /// Returns the errors of [`OutputUnits::choose`], and an error for an empty list.
    pub fn listed(text: &str) -> Result<OutputUnits, [String; 2]> {
        let mut units = OutputUnits::default();
        for unit in text.split(',') {
            units.choose(unit.trim())?;
        }
        Ok(units)
    }

    /// Returns the chosen units as a list, as [`OutputUnits::listed`] reads it.
    pub fn listing(&self) -> String {
        let names = self.chosen.iter().map(|it| it.name.as_str());
        names.collect::<Vec<_>>().join(",")
    }

    /// Returns the unit chosen for lengths; `None` if none is chosen.
    pub fn of_lengths(&self) -> Option<&OutputUnit> {
        self.chosen.iter().find(|it| it.unit.powers == LENGTH)
    }

    /// Returns the units with this one added, if its quantity has none.
    pub fn or(mut self, text: &str) -> OutputUnits {
        // On an error, the existing unit of the quantity is kept.
        let _ = self.choose(text);
        self
    }

    /// Returns the units with angles in this one.
    pub fn with_angles_in(mut self, text: &str) -> OutputUnits {
        self.chosen.retain(|it| it.unit.powers != ANGLE);
        self.or(text)
    }

    /// Returns the unit for values that are in this unit of SI: `m/s²`, `N*m`, `J`.
    pub fn of(&self, si: &str) -> OutputUnit {
        let Some(own) = Unit::parse(si).filter(|_| !ENERGIES.contains(&si)) else {
            return OutputUnit::coherent(si);
        };
        let chosen = |powers: Powers| self.chosen.iter().find(|it| it.unit.powers == powers);
        if let Some(chosen) = chosen(own.powers) {
            return chosen.clone();
        }
        let torque = chosen(TORQUE).map_or("N*m", |it| it.name.as_str());
        let pieces: Vec<String> = si.split("N*m").map(|it| self.made(it)).collect();
        let name = pieces.join(torque);
        match Unit::parse(&name) {
            Some(unit) if unit.powers == own.powers => OutputUnit { name, unit },
            _ => OutputUnit::coherent(si),
        }
    }

    /// Replaces SI units by the chosen ones.
    fn made(&self, si: &str) -> String {
        let mut made = String::new();
        let mut rest = si;
        while !rest.is_empty() {
            let word = rest
                .find(|it: char| !it.is_ascii_alphabetic())
                .unwrap_or(rest.len());
            if word == 0 {
                let next = rest.chars().next().map_or(rest.len(), char::len_utf8);
                made.push_str(&rest[..next]);
                rest = &rest[next..];
                continue;
            }
            let base = BASES.iter().find(|it| it.0 == &rest[..word]);
            let chosen = base.and_then(|(_, powers)| {
                let mut chosen = self.chosen.iter();
                chosen.find(|it| it.unit.powers == *powers)
            });
            made.push_str(chosen.map_or(&rest[..word], |it| &it.name));
            rest = &rest[word..];
        }
        made
    }
}

/// Counts of the units that a description writes.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    counts: Vec<(&'static str, usize)>,
}

impl Tally {
    /// Counts a unit.
    pub fn count(&mut self, name: &str) {
        let adopted = of_description(name).filter(|it| it.is_adopted);
        let usual = adopted.and_then(|it| it.names.first());
        let Some(usual) = usual.filter(|it| **it == name) else {
            return;
        };
        match self.own(name) {
            Some(count) => *count += 1,
            None => self.counts.push((usual, 1)),
        }
    }

    /// Removes one count of a unit.
    pub fn forget(&mut self, name: &str) {
        if let Some(count) = self.own(name) {
            *count = count.saturating_sub(1);
        }
    }

    fn own(&mut self, name: &str) -> Option<&mut usize> {
        let mut counts = self.counts.iter_mut();
        counts.find(|it| it.0 == name).map(|it| &mut it.1)
    }

    /// Returns the most frequent unit of each quantity; the first among equally frequent ones.
    pub fn most(&self) -> OutputUnits {
        let mut units = OutputUnits::default();
        let mut counts = self.counts.clone();
        counts.sort_by_key(|it| std::cmp::Reverse(it.1));
        for (name, _) in counts.iter().filter(|it| it.1 > 0) {
            units = units.or(name);
        }
        units
    }
}

/// Units in which a mechanism is reported.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReportUnits {
    /// Units of a statement or an option; `None` without both.
    pub requested: Option<OutputUnits>,
    /// Most frequent units of the description.
    pub written: OutputUnits,
}

impl ReportUnits {
    /// Returns the units of tables, files and plots: the requested ones, otherwise SI units.
    pub fn of_tables(&self) -> OutputUnits {
        self.requested.clone().unwrap_or_default()
    }

    /// Returns the units of messages and pages: the requested ones, otherwise the most frequent units of the description.
    pub fn of_messages(&self) -> &OutputUnits {
        self.requested.as_ref().unwrap_or(&self.written)
    }
}

#[cfg(test)]
mod tests {
    use super::{OutputUnits, Tally};

    #[test]
    fn chosen_units_make_others() {
        let units = OutputUnits::listed("mm, deg,N*mm").expect("units");
        for (si, name, value) in [
            ("m", "mm", 1000.0),
            ("m/s²", "mm/s²", 1000.0),
            ("m^3", "mm^3", 1e9),
            ("rad", "deg", 180.0 / std::f64::consts::PI),
            ("rad/s", "deg/s", 180.0 / std::f64::consts::PI),
            ("m/rad", "mm/deg", 1000.0 * std::f64::consts::PI / 180.0),
            ("N/m", "N/mm", 1e-3),
            ("N*m", "N*mm", 1000.0),
            ("N*m*s", "N*mm*s", 1000.0),
            ("kg*m^2", "kg*mm^2", 1e6),
            ("J", "J", 1.0),
            ("W", "W", 1.0),
            ("s", "s", 1.0),
            ("1/s", "1/s", 1.0),
            ("", "", 1.0),
            ("SI units", "SI units", 1.0),
        ] {
            let unit = units.of(si);
            assert_eq!(unit.name, name);
            assert!((unit.of_si(1.0) / value - 1.0).abs() < 1e-15, "{si}");
        }
        assert_eq!(units.of("m").of_si(0.1), 100.0);
    }

    #[test]
    fn torques_are_made_of_nothing() {
        let units = OutputUnits::listed("mm,kN").expect("units");
        assert_eq!(units.of("N*m").name, "N*m");
        assert_eq!(units.of("N/m").name, "kN/mm");
        let units = OutputUnits::listed("rpm,m/s").expect("units");
        assert_eq!(units.of("rad/s").name, "rpm");
        assert_eq!(units.of("rad/s²").name, "rad/s²");
        assert_eq!(units.of("m/s").name, "m/s");
    }

    #[test]
    fn refusals_say_what_to_write() {
        for (text, message) in [
            ("mm, furlong", "no unit is named `furlong`"),
            ("", "no unit is named ``"),
            ("mm,,deg", "no unit is named ``"),
            ("ms", "`ms` is not a unit of output"),
            ("m^2", "`m^2` is not a unit of output"),
            ("1", "`1` is not a unit of output"),
            ("mm,deg,cm", "`mm` and `cm` measure the same"),
        ] {
            let refused = OutputUnits::listed(text).expect_err(text);
            assert_eq!(refused[0], message);
        }
    }

    #[test]
    fn the_most_frequent_unit_counts() {
        let mut tally = Tally::default();
        for name in ["m", "mm", "deg", "mm", "turn", "turn", "N/mm"] {
            tally.count(name);
        }
        let most = tally.most();
        assert_eq!(most.of("m").name, "mm");
        assert_eq!(most.of("rad").name, "deg");
        assert_eq!(most.of("N").name, "N");
    }
}
