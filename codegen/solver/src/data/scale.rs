//! Finds the unit of each column from headers and options.

use linkwright_codegen::stages::columns::{Columns, Unit};

use super::Reading;
use super::mapping::column;

/// Source of a column's unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The header.
    Header,
    /// An option.
    Option,
    /// Neither: the SI unit is assumed.
    Assumed,
}

/// Unit of a column.
#[derive(Clone, Debug, PartialEq)]
pub struct Scale {
    /// Printed text.
    pub text: String,
    /// Unit.
    pub unit: Unit,
    /// Source of the unit.
    pub origin: Origin,
    /// True if the unit counts turns: the rate of an angle in `1/min` or `Hz`.
    pub counts_turns: bool,
}

impl Scale {
    /// Returns the unit for a quantity of these powers; `None` if the unit does not fit it.
    fn new(text: &str, unit: &Unit, powers: [i32; 4], origin: Origin) -> Option<Scale> {
        Some(Scale {
            text: text.to_string(),
            unit: unit.measuring(powers)?,
            origin,
            counts_turns: unit.counts_turns_of(powers),
        })
    }
}

/// Units that options give to columns.
pub struct Units {
    of_columns: Vec<(usize, String, Unit)>,
    of_others: Vec<(String, Unit)>,
}

impl Units {
    pub fn read(reading: &Reading, file: &str, columns: &Columns) -> Result<Units, String> {
        let mut units = Units {
            of_columns: Vec::new(),
            of_others: Vec::new(),
        };
        for wish in &reading.unit {
            let (name, text) = match wish.rsplit_once('=') {
                Some((name, text)) => (Some(name.trim()), text.trim()),
                None => (None, wish.trim()),
            };
            let unit = Unit::parse(text).ok_or_else(|| {
                format!("error: `{text}` is not a unit\n  = help: write it as in `mm`, `deg`, `m/s^2`, `rpm`")
            })?;
            match name {
                Some(name) => {
                    let column_index = column(file, columns, name)?;
                    units
                        .of_columns
                        .push((column_index, text.to_string(), unit));
                }
                None => units.of_others.push((text.to_string(), unit)),
            }
        }
        Ok(units)
    }

    /// Returns the unit of a column whose quantity has these powers of m, s, kg and rad, or the reason that there is none.
    pub fn of(
        &self,
        columns: &Columns,
        column: usize,
        powers: [i32; 4],
        si: &str,
    ) -> Result<Scale, String> {
        let source = &columns.columns[column];
        let option = self.of_columns.iter().find(|it| it.0 == column);
        let header = source
            .unit
            .as_deref()
            .and_then(|it| Some((it, Unit::parse(it)?)));
        let stated = match (option, header) {
            (Some((_, text, unit)), _) => Some((text.as_str(), *unit, Origin::Option)),
            (None, Some((text, unit))) => Some((text, unit, Origin::Header)),
            (None, None) => None,
        };
        if let Some((text, unit, origin)) = stated {
            return Scale::new(text, &unit, powers, origin)
                .ok_or_else(|| format!("`{}` cannot be in {text}", source.name));
        }
        let is_meant = |unit: &Unit| unit.powers == powers || unit.counts_turns_of(powers);
        if let Some((text, unit)) = self.of_others.iter().find(|it| is_meant(&it.1))
            && let Some(scale) = Scale::new(text, unit, powers, Origin::Option)
        {
            return Ok(scale);
        }
        Ok(self.of_rate(powers).unwrap_or(Scale {
            text: si.to_string(),
            unit: Unit::coherent(powers),
            origin: Origin::Assumed,
            counts_turns: false,
        }))
    }

    /// Returns `mm/s` if all lengths are in mm.
    fn of_rate(&self, powers: [i32; 4]) -> Option<Scale> {
        let [length, time, mass, angle] = powers;
        let base = match (length, mass, angle) {
            (1, 0, 0) => [1, 0, 0, 0],
            (0, 0, 1) => [0, 0, 0, 1],
            _ => return None,
        };
        let per = ["", "/s", "/s²"].get(usize::try_from(-time).ok()?)?;
        let (text, unit) = self.of_others.iter().find(|it| it.1.powers == base)?;
        let second = Unit::parse("s")?;
        Some(Scale {
            text: format!("{text}{per}"),
            unit: unit.times(second, time),
            origin: Origin::Option,
            counts_turns: false,
        })
    }
}
