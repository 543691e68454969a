//! *Headers and options* → *the unit of each column*.

use linkwright_codegen::stages::columns::{Columns, Unit};

use super::mapping::column;
use crate::arguments::Table;

/// Where the unit of a column is from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The header.
    Header,
    /// An option.
    Option,
    /// Neither: it is that of SI.
    Assumed,
}

/// The unit of a column.
#[derive(Clone, Debug, PartialEq)]
pub struct Scale {
    /// As it is printed.
    pub text: String,
    /// What it is.
    pub unit: Unit,
    /// Where it is from.
    pub origin: Origin,
    /// True if it counts turns: the rate of an angle in `1/min` or `Hz`.
    pub counts_turns: bool,
}

impl Scale {
    /// A unit as it measures what has these powers; `None` if it cannot.
    fn new(text: &str, unit: &Unit, powers: [i32; 4], origin: Origin) -> Option<Scale> {
        Some(Scale {
            text: text.to_string(),
            unit: unit.measuring(powers)?,
            origin,
            counts_turns: unit.counts_turns_of(powers),
        })
    }
}

/// Units that options give.
pub struct Units {
    of_columns: Vec<(usize, String, Unit)>,
    of_others: Vec<(String, Unit)>,
}

impl Units {
    pub fn read(asked: &Table, file: &str, columns: &Columns) -> Result<Units, String> {
        let mut units = Units {
            of_columns: Vec::new(),
            of_others: Vec::new(),
        };
        for wish in &asked.unit {
            let (name, text) = match wish.rsplit_once('=') {
                Some((name, text)) => (Some(name.trim()), text.trim()),
                None => (None, wish.trim()),
            };
            let unit = Unit::parse(text).ok_or_else(|| {
                format!("error: `{text}` is not a unit\n  = help: write it as in `mm`, `deg`, `m/s^2`, `rpm`")
            })?;
            match name {
                Some(name) => {
                    let own = column(file, columns, name)?;
                    units.of_columns.push((own, text.to_string(), unit));
                }
                None => units.of_others.push((text.to_string(), unit)),
            }
        }
        Ok(units)
    }

    /// The unit of a column that measures what has these powers of m, s, kg and rad; or why it cannot.
    pub fn of(
        &self,
        columns: &Columns,
        column: usize,
        powers: [i32; 4],
        si: &str,
    ) -> Result<Scale, String> {
        let own = &columns.columns[column];
        let option = self.of_columns.iter().find(|it| it.0 == column);
        let header = own
            .unit
            .as_deref()
            .and_then(|it| Some((it, Unit::parse(it)?)));
        let given = match (option, header) {
            (Some((_, text, unit)), _) => Some((text.as_str(), *unit, Origin::Option)),
            (None, Some((text, unit))) => Some((text, unit, Origin::Header)),
            (None, None) => None,
        };
        if let Some((text, unit, origin)) = given {
            return Scale::new(text, &unit, powers, origin)
                .ok_or_else(|| format!("`{}` cannot be in {text}", own.name));
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

    /// `mm/s` where all lengths are in mm.
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
