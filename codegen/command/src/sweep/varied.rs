//! Reads what a sweep varies: names of parameters and inputs, their ranges and their units.
//!
//! Afterwards each name is a parameter or an input once, and all ends of ranges are finite numbers in its unit.

use linkwright_codegen::stages::columns::Unit;
use linkwright_codegen::stages::model::{Dimension, set};
use linkwright_codegen::stages::system::Derived;
use linkwright_codegen::stages::units::OutputUnit;

use linkwright_solver::data::{ROUNDED_END, number_and_unit, on_end, powers};

/// Number of digits of ends in a unit: two fewer than identify a number.
const DIGITS: usize = 15;

/// Parameter or input by its index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Index among the parameters.
    Parameter(usize),
    /// Index among the inputs.
    Input(usize),
}

/// Parameter or input that differs between sets.
#[derive(Clone, Debug)]
pub struct Varied {
    /// Name.
    pub name: String,
    /// Its index.
    pub place: Place,
    /// Both ends of the range that the description gives it, in SI units; `None` if it is not limited.
    range: Option<[f64; 2]>,
    /// Unit of given values.
    given: Unit,
    /// Unit of its column if given values have no unit; `None` if the column has their unit.
    column: Option<OutputUnit>,
    /// Name of the unit of its column; empty for plain numbers.
    pub unit: String,
}

/// Range of an option `--vary`.
#[derive(Clone, Debug)]
pub struct Range {
    /// Varied parameter or input.
    pub varied: Varied,
    /// Both ends, in the unit of given values.
    pub ends: [f64; 2],
    /// Number of values; `None` if it is not given.
    pub count: Option<u64>,
}

impl Varied {
    /// Returns what a column of this name varies; its unit is that of the header, or else SI.
    ///
    /// # Errors
    /// The reason that the unit does not fit; `None` if no parameter or input has this name.
    pub fn of_column(
        derived: &Derived,
        name: &str,
        unit: Option<&str>,
    ) -> Option<Result<Varied, String>> {
        let (place, dimension) = place(derived, name)?;
        let written = unit.and_then(|text| Some((text, Unit::parse(text)?)));
        Some(match written {
            None => Ok(Varied::new(derived, name, place, dimension, None)),
            Some((text, unit)) => match measuring(dimension, unit) {
                None => Err(format!("`{name}` cannot be in {text}")),
                unit => {
                    let unit = unit.map(|it| (text, it));
                    Ok(Varied::new(derived, name, place, dimension, unit))
                }
            },
        })
    }

    fn new(
        derived: &Derived,
        name: &str,
        place: Place,
        dimension: Dimension,
        written: Option<(&str, Unit)>,
    ) -> Varied {
        let si = match dimension.is_marked() {
            true => dimension.unit(),
            false => String::new(),
        };
        let units = derived.system.mechanism.units.of_tables();
        // A ratio may be an angle, so it has no unit of its own.
        let si = Unit::parse(&si).map_or("", |_| si.as_str());
        let column = written.is_none().then(|| units.of(si));
        let unit = match (&column, written) {
            (Some(column), _) => column.name.clone(),
            (None, written) => written.map_or(String::new(), |(text, _)| text.to_string()),
        };
        let mechanism = &derived.system.mechanism;
        let range = match place {
            Place::Parameter(at) => mechanism.parameters[at].range,
            Place::Input(at) => mechanism.inputs[at].range,
        };
        Varied {
            name: name.to_string(),
            place,
            range,
            given: written.map_or(Unit::coherent([0; 4]), |(_, unit)| unit),
            column,
            unit,
        }
    }

    /// Returns a given value in SI units. Rounding in its unit does not leave the range.
    pub fn si(&self, given: f64) -> f64 {
        let value = self.given.si(given);
        self.range.map_or(value, |range| on_end(value, range))
    }

    /// Returns a given value in the unit of the column.
    pub fn written(&self, given: f64) -> f64 {
        match &self.column {
            None => given,
            Some(unit) => unit.of_si(given),
        }
    }

    /// Returns what is varied with values given in the unit of its column, in which ends of a range are mostly round numbers.
    fn in_column_unit(self, range: [f64; 2]) -> (Varied, [f64; 2]) {
        let unit = self.column.as_ref();
        let unit = unit.and_then(|it| Some((it, Unit::parse(&it.name)?)));
        match unit {
            Some((column, given)) => {
                let ends = range.map(|end| column.rounded(end, DIGITS));
                let column = None;
                (
                    Varied {
                        given,
                        column,
                        ..self
                    },
                    ends,
                )
            }
            None => (self, range),
        }
    }

    /// Returns the name of the column with its unit.
    pub fn header(&self) -> String {
        named(&self.name, &self.unit)
    }
}

/// Returns the name of a column, with its unit if it has one.
pub fn named(name: &str, unit: &str) -> String {
    match unit {
        "" => name.to_string(),
        unit => format!("{name} ({unit})"),
    }
}

impl Range {
    /// Reads the value of an option, `NAME=FIRST..LAST:COUNT` or `NAME=FIRST..LAST`. Without `=` and ends, they are those of the range in the
    /// description.
    ///
    /// # Errors
    /// The printed message.
    pub fn read(derived: &Derived, option: &str, text: &str) -> Result<Range, String> {
        let form = || {
            format!(
                "error: `{option} {text}` is not a range\n  = help: write it as in `{option} rod=100mm..200mm:101`"
            )
        };
        let Some((name, range)) = text.split_once('=') else {
            return Range::of_description(derived, option, text).unwrap_or_else(|| Err(form()));
        };
        let (first, rest) = range.split_once("..").ok_or_else(form)?;
        let (last, count) = match rest.rsplit_once(':') {
            Some((last, count)) => (last, Some(read_count(option, text, count.trim())?)),
            None => (rest, None),
        };
        let (name, ends) = (name.trim(), [first.trim(), last.trim()]);
        if ends.contains(&"") {
            return Err(form());
        }
        let mut values = [0.0; 2];
        for (value, end) in values.iter_mut().zip(ends) {
            *value = value_of(derived, option, name, end)?;
        }
        let Some((place, dimension)) = place(derived, name) else {
            return Err(form());
        };
        let units = ends.map(number_and_unit);
        let of = |end: Option<(f64, &'_ str)>| end.map_or("", |(_, unit)| unit).to_string();
        let [one, other] = units.map(of);
        let is_plain =
            |end: Option<(f64, &str)>| matches!(end, Some((number, "")) if number != 0.0);
        if one != other && units.iter().any(|it| is_plain(*it)) {
            return Err(format!(
                "error: one end of `{option} {text}` has a unit, and the other has none\n  = help: write the unit of both"
            ));
        }
        // Ends in one unit are divided in this unit, so that the column has its round numbers.
        let text_of_unit = if one.is_empty() { other } else { one };
        let read = Unit::parse(&text_of_unit).and_then(|it| measuring(dimension, it));
        let in_unit = read.and_then(|unit| {
            let mut numbers = [0.0; 2];
            for ((number, end), si) in numbers.iter_mut().zip(units).zip(values) {
                let (own, its_unit) = end?;
                let is_same = its_unit == text_of_unit || own == 0.0;
                let is_close = (unit.si(own) - si).abs() <= ROUNDED_END * si.abs();
                *number = (is_same && is_close).then_some(own)?;
            }
            Some((unit, numbers))
        });
        let (written, ends) = match in_unit {
            Some((unit, numbers)) => (Some((text_of_unit.as_str(), unit)), numbers),
            None => (None, values),
        };
        let varied = Varied::new(derived, name, place, dimension, written);
        if !(ends[1] - ends[0]).is_finite() {
            return Err(format!("error: `{option} {text}` is not a finite range"));
        }
        counted(option, text, (varied, ends), count)
    }
}

impl Range {
    /// Reads `NAME:COUNT` or `NAME`, with the ends of the description; `None` for another name.
    fn of_description(
        derived: &Derived,
        option: &str,
        text: &str,
    ) -> Option<Result<Range, String>> {
        let (name, count) = match text.split_once(':') {
            Some((name, count)) => (name, Some(count.trim())),
            None => (text, None),
        };
        let name = name.trim();
        let (place, dimension) = place(derived, name)?;
        let varied = Varied::new(derived, name, place, dimension, None);
        let Some(range) = varied.range else {
            return Some(Err(format!(
                "error: `{name}` has no range in the description\n  = help: write both ends, as in `{option} rod=100mm..200mm:101`"
            )));
        };
        let count = match count.map(|count| read_count(option, text, count)) {
            Some(Err(message)) => return Some(Err(message)),
            Some(Ok(count)) => Some(count),
            None => None,
        };
        Some(counted(option, text, varied.in_column_unit(range), count))
    }
}

/// Returns a range, of whose values there are enough.
fn counted(
    option: &str,
    text: &str,
    (varied, ends): (Varied, [f64; 2]),
    count: Option<u64>,
) -> Result<Range, String> {
    match count {
        Some(0) => Err(format!(
            "error: `{option} {text}` has no values\n  = help: write the number of values behind `:`, at least 2"
        )),
        Some(1) if ends[0] != ends[1] => Err(format!(
            "error: `{option} {text}` has two ends, but one value\n  = help: write at least 2 values, or equal ends"
        )),
        Some(2..) | None if ends[0] == ends[1] => Err(format!(
            "error: the range `{option} {text}` is empty\n  = help: write different ends, or set the value with `--set`"
        )),
        count => Ok(Range {
            varied,
            ends,
            count,
        }),
    }
}

fn read_count(option: &str, text: &str, count: &str) -> Result<u64, String> {
    count.parse().map_err(|_| {
        format!(
            "error: `{count}` in `{option} {text}` is not a number of values\n  = help: write a whole number behind `:`"
        )
    })
}

/// Returns the value of an end in SI units, which an assignment would give.
fn value_of(derived: &Derived, option: &str, name: &str, end: &str) -> Result<f64, String> {
    let (mut pool, mut mechanism) = (derived.pool.clone(), derived.system.mechanism.clone());
    set(&mut pool, &mut mechanism, option, &format!("{name}={end}"))?;
    let value = match place(derived, name) {
        Some((Place::Parameter(at), _)) => pool.graph.nominal(mechanism.parameters[at].symbol),
        Some((Place::Input(at), _)) => pool.graph.constant_value(mechanism.inputs[at].signal[0]),
        None => None,
    };
    let value = value.ok_or_else(|| {
        format!(
            "error: `{end}` in `{option} {name}` depends on t\n  = help: write numbers; a varied input is constant during a motion"
        )
    })?;
    match value.is_finite() {
        true => Ok(value),
        false => Err(format!(
            "error: `{end}` in `{option} {name}` is not a finite number"
        )),
    }
}

/// Returns the parameter or input of a name, with its dimension.
fn place(derived: &Derived, name: &str) -> Option<(Place, Dimension)> {
    let mechanism = &derived.system.mechanism;
    let parameter = mechanism.parameters.iter().position(|it| it.name == name);
    let input = mechanism.inputs.iter().position(|it| it.name == name);
    match (parameter, input) {
        (Some(at), _) => Some((Place::Parameter(at), mechanism.parameters[at].dimension)),
        (None, Some(at)) => Some((Place::Input(at), mechanism.inputs[at].dimension)),
        (None, None) => None,
    }
}

/// Returns the unit of values of a dimension; `None` if it does not fit. A ratio may be an angle.
fn measuring(dimension: Dimension, unit: Unit) -> Option<Unit> {
    let powers = powers(dimension, Some(unit.powers));
    let is_ratio = powers == [0; 4];
    unit.measuring(powers)
        .or_else(|| unit.measuring([0, 0, 0, 1]).filter(|_| is_ratio))
}
