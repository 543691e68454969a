//! Units of measurement: names, exact factors to SI units, and powers of m, s, kg and rad.
//!
//! Descriptions, columns of tables, messages and documentation read this one table. A name belongs to one unit.

mod output;
mod unit;

pub use output::{OutputUnit, OutputUnits, ReportUnits, Tally};
pub use unit::Unit;

/// Powers of m, s, kg and rad.
pub type Powers = [i32; 4];

/// A named unit.
#[derive(Debug)]
pub struct Named {
    /// Names in descriptions, the usual one first; also valid in columns.
    pub names: &'static [&'static str],
    /// Names valid only in columns.
    pub in_columns: &'static [&'static str],
    /// Numerator and denominator of the factor to SI units.
    pub factor: [i64; 2],
    /// True if the factor is multiplied by π.
    pub times_pi: bool,
    /// Powers of the measured quantity.
    pub powers: Powers,
    /// True if the rate of an angle in this unit, without a unit of angles, counts turns.
    pub counts_turns: bool,
    /// True if descriptions that use its first name are reported in it. Positions in turns or kilometers would be unreadable.
    pub is_adopted: bool,
}

const LENGTH: Powers = [1, 0, 0, 0];
const TIME: Powers = [0, 1, 0, 0];
const MASS: Powers = [0, 0, 1, 0];
const ANGLE: Powers = [0, 0, 0, 1];
const ANGULAR_VELOCITY: Powers = [0, -1, 0, 1];
const FORCE: Powers = [1, -2, 1, 0];
const TORQUE: Powers = [2, -2, 1, 0];

const fn rational(
    names: &'static [&'static str],
    in_columns: &'static [&'static str],
    factor: [i64; 2],
    powers: Powers,
) -> Named {
    Named {
        names,
        in_columns,
        factor,
        times_pi: false,
        powers,
        counts_turns: false,
        is_adopted: false,
    }
}

impl Named {
    const fn times_pi(self) -> Named {
        Named {
            times_pi: true,
            ..self
        }
    }

    const fn counting_turns(self) -> Named {
        Named {
            counts_turns: true,
            ..self
        }
    }

    const fn adopted(self) -> Named {
        Named {
            is_adopted: true,
            ..self
        }
    }
}

/// All named units, by quantity.
pub const KNOWN: &[Named] = &[
    rational(&[], &["1", "-", "–", "none", "no_units"], [1, 1], [0; 4]),
    rational(
        &["m"],
        &["meter", "meters", "metre", "metres"],
        [1, 1],
        LENGTH,
    )
    .adopted(),
    rational(&[], &["dm"], [1, 10], LENGTH),
    rational(
        &["cm"],
        &["centimeter", "centimeters", "centimetre"],
        [1, 100],
        LENGTH,
    )
    .adopted(),
    rational(
        &["mm"],
        &["millimeter", "millimeters", "millimetre", "millimetres"],
        [1, 1000],
        LENGTH,
    )
    .adopted(),
    rational(&["um"], &["µm", "μm", "micrometer"], [1, 1_000_000], LENGTH),
    rational(&["km"], &[], [1000, 1], LENGTH),
    rational(&["inch"], &["in", "inches"], [254, 10_000], LENGTH).adopted(),
    rational(&["ft"], &["foot", "feet"], [3048, 10_000], LENGTH).adopted(),
    rational(&["rad"], &["radian", "radians"], [1, 1], ANGLE).adopted(),
    rational(&["mrad"], &[], [1, 1000], ANGLE),
    rational(
        &["deg"],
        &["°", "degree", "degrees", "grad°"],
        [1, 180],
        ANGLE,
    )
    .times_pi()
    .adopted(),
    rational(&["turn", "turns"], &["rev", "revolutions"], [2, 1], ANGLE).times_pi(),
    rational(&["s"], &["sec", "second", "seconds", "secs"], [1, 1], TIME),
    rational(
        &["ms"],
        &["msec", "millisecond", "milliseconds"],
        [1, 1000],
        TIME,
    ),
    rational(
        &[],
        &["us", "µs", "μs", "microsecond", "microseconds"],
        [1, 1_000_000],
        TIME,
    ),
    rational(&[], &["ns"], [1, 1_000_000_000], TIME),
    rational(&["min"], &["minute", "minutes"], [60, 1], TIME).counting_turns(),
    rational(&[], &["h", "hour", "hours"], [3600, 1], TIME).counting_turns(),
    // A hertz is 1/s as in the SI, so a cycle needs its 2π; a revolution per minute is an angular velocity, 2π/60 rad/s.
    rational(&["Hz"], &["hz"], [1, 1], [0, -1, 0, 0]).counting_turns(),
    rational(&["rpm", "U/min", "r/min"], &[], [1, 30], ANGULAR_VELOCITY).times_pi(),
    rational(&["U/s", "r/s"], &["rps"], [2, 1], ANGULAR_VELOCITY).times_pi(),
    rational(&["kg"], &[], [1, 1], MASS).adopted(),
    rational(&["g"], &[], [1, 1000], MASS).adopted(),
    rational(&["t"], &[], [1000, 1], MASS),
    rational(&["N"], &["newton", "newtons"], [1, 1], FORCE).adopted(),
    rational(&["mN"], &[], [1, 1000], FORCE).adopted(),
    rational(&["kN"], &[], [1000, 1], FORCE).adopted(),
    rational(&["MN"], &[], [1_000_000, 1], FORCE),
    // 0.453 592 37 kg times 9.806 65 m/s².
    rational(
        &["lbf"],
        &[],
        [44_482_216_152_605, 10_000_000_000_000],
        FORCE,
    ),
    rational(&["Nm"], &["J", "joule", "joules"], [1, 1], TORQUE).adopted(),
    rational(&["mNm", "Nmm"], &[], [1, 1000], TORQUE).adopted(),
    rational(&["kNm"], &[], [1000, 1], TORQUE).adopted(),
    rational(&[], &["W", "watt", "watts"], [1, 1], [2, -3, 1, 0]),
];

/// Names of descriptions that are one word, for lists and completion; `U/min` is excluded.
pub const UNITS: &[&str] = &words::<{ count_of_words() }>();

const fn is_word(name: &str) -> bool {
    let (bytes, mut place) = (name.as_bytes(), 0);
    while place < bytes.len() {
        if bytes[place] == b'/' {
            return false;
        }
        place += 1;
    }
    true
}

const fn count_of_words() -> usize {
    let (mut count, mut unit) = (0, 0);
    while unit < KNOWN.len() {
        let mut name = 0;
        while name < KNOWN[unit].names.len() {
            count += is_word(KNOWN[unit].names[name]) as usize;
            name += 1;
        }
        unit += 1;
    }
    count
}

const fn words<const COUNT: usize>() -> [&'static str; COUNT] {
    let mut words = [""; COUNT];
    let (mut count, mut unit) = (0, 0);
    while unit < KNOWN.len() {
        let mut name = 0;
        while name < KNOWN[unit].names.len() {
            if is_word(KNOWN[unit].names[name]) {
                words[count] = KNOWN[unit].names[name];
                count += 1;
            }
            name += 1;
        }
        unit += 1;
    }
    words
}

/// Returns the unit with this name in descriptions; `None` if there is none.
pub fn of_description(name: &str) -> Option<&'static Named> {
    KNOWN.iter().find(|it| it.names.contains(&name))
}

/// Returns the unit with this name in columns; `None` if there is none. Words may be in capitals; symbols may not, since `MS`
/// is not a unit.
pub fn of_column(name: &str) -> Option<&'static Named> {
    let lower = name.to_lowercase();
    let called = |name: &str| {
        KNOWN
            .iter()
            .find(|it| it.names.contains(&name) || it.in_columns.contains(&name))
    };
    let is_long = lower.len() > 2 && is_word(name);
    called(name).or_else(|| called(&lower).filter(|_| is_long))
}

#[cfg(test)]
mod tests {
    use super::{KNOWN, UNITS, of_column, of_description};

    #[test]
    fn names_belong_to_one_unit() {
        let mut names: Vec<&str> = KNOWN
            .iter()
            .flat_map(|it| it.names.iter().chain(it.in_columns))
            .copied()
            .collect();
        let count = names.len();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), count);
    }

    #[test]
    fn descriptions_take_no_word_of_columns() {
        assert!(UNITS.contains(&"turns") && !UNITS.contains(&"U/min") && !UNITS.contains(&""));
        assert!(of_description("inch").is_some() && of_description("inches").is_none());
        for name in ["inches", "Inches", "U/min", "kNm", "RPM"] {
            assert!(of_column(name).is_some(), "{name}");
        }
        for name in ["MS", "u/min", "NMM", "U", "r"] {
            assert!(of_column(name).is_none(), "{name}");
        }
    }
}
