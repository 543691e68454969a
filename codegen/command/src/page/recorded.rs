//! *The motion of each assembly* → *columns of numbers that a page plays back*.
//!
//! A column is what one coordinate, rate, acceleration, measure or force is at all kept instants. What assemblies have in common, and what
//! stands still, is written once.

use std::collections::HashMap;
use std::io;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use linkwright_solver::instant::Instant;
use linkwright_solver::interpreted::Interpreted;
use linkwright_solver::schedule::Schedule;
use linkwright_solver::supplied::Modes;
use serde::Serialize;

use crate::motion::{Followed, Shown, Sink, Wanted};

/// The numbers of all motions.
#[derive(Debug, Default, Serialize)]
#[serde(transparent)]
pub struct Columns {
    columns: Vec<Column>,
    #[serde(skip)]
    places: HashMap<Vec<u8>, usize>,
}

/// The values of one quantity.
#[derive(Debug, Serialize)]
#[serde(untagged)]
enum Column {
    /// The same at all times.
    Constant(f32),
    /// Single precision, the lowest byte first, in Base64.
    Changing(String),
}

/// One motion.
#[derive(Debug, Serialize)]
pub struct Recorded {
    /// When the kept instants are (s).
    pub times: Vec<f64>,
    /// The columns of q, q̇ and q̈, coordinate by coordinate.
    pub coordinates: Vec<[usize; 3]>,
    /// The columns of what says how close each part is to a singular pose.
    pub measures: Vec<usize>,
    /// The columns of the forces that are asked for.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub forces: Vec<usize>,
    /// Why it ends early, if it does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
    /// What to look at.
    #[serde(skip)]
    pub warnings: Vec<String>,
    /// The kept instants.
    #[serde(skip)]
    pub instants: Vec<Instant>,
}

impl Columns {
    /// The place of a column of these values.
    pub fn place(&mut self, values: impl Iterator<Item = f64>) -> usize {
        let values: Vec<f32> = values.map(|value| value as f32).collect();
        let is_constant = values.iter().all(|it| *it == values[0]) && !values.is_empty();
        let used = if is_constant { &values[..1] } else { &values };
        let bytes: Vec<u8> = used.iter().flat_map(|value| value.to_le_bytes()).collect();
        if let Some(&place) = self.places.get(&bytes) {
            return place;
        }
        self.columns.push(match is_constant {
            true => Column::Constant(values[0]),
            false => Column::Changing(STANDARD.encode(&bytes)),
        });
        self.places.insert(bytes, self.columns.len() - 1);
        self.columns.len() - 1
    }
}

/// Follows a motion and keeps at most so many of its instants.
///
/// # Errors
/// Why the mechanism cannot be assembled.
pub fn recorded(
    view: &Interpreted,
    schedule: &Schedule,
    chosen: Option<(Instant, Modes)>,
    most: usize,
    columns: &mut Columns,
) -> Result<Recorded, String> {
    let wanted = Wanted {
        points: Vec::new(),
        coordinates: Vec::new(),
        monitor: true,
        curves: false,
    };
    let mut motion = Followed::new(view.clone(), wanted, schedule.start.t, chosen);
    let mut kept = Kept {
        every: schedule.wanted().div_ceil(most.max(2)).max(1),
        count: 0,
        instants: Vec::new(),
        last: None,
    };
    let followed = motion.follow(schedule, &mut [&mut kept], |_| {});
    followed.map_err(|error| error.to_string())?;
    kept.instants.extend(kept.last.take());
    let Some((first, measures, forces)) = kept.instants.first() else {
        return Err(motion.error.unwrap_or_default());
    };
    let (count, measured, exerted) = (first.q().len(), measures.len(), forces.len());
    let mut column = |of: &dyn Fn(&KeptInstant) -> f64| columns.place(kept.instants.iter().map(of));
    let coordinates = (0..count).map(|index| {
        [
            column(&|(it, ..)| it.q()[index]),
            column(&|(it, ..)| it.qd()[index]),
            column(&|(it, ..)| it.qdd()[index]),
        ]
    });
    let coordinates = coordinates.collect();
    let measures = (0..measured).map(|part| column(&|(_, measures, _)| measures[part]));
    let measures = measures.collect();
    let forces = (0..exerted).map(|place| column(&|(.., forces)| forces[place]));
    let forces = forces.collect();
    Ok(Recorded {
        times: kept.instants.iter().map(|(it, ..)| it.t()).collect(),
        coordinates,
        measures,
        forces,
        error: motion.error,
        warnings: motion.warnings,
        instants: kept.instants.into_iter().map(|(it, ..)| it).collect(),
    })
}

/// An instant, its measures and its forces.
type KeptInstant = (Instant, Vec<f64>, Vec<f64>);

/// Every so manieth instant, and the last.
struct Kept {
    every: usize,
    count: usize,
    instants: Vec<KeptInstant>,
    last: Option<KeptInstant>,
}

impl Sink for Kept {
    fn take(&mut self, shown: &Shown<'_>) -> io::Result<()> {
        let forces = shown.forces.unwrap_or_default();
        let own = (
            shown.instant.clone(),
            shown.measures.to_vec(),
            forces.to_vec(),
        );
        match self.count.is_multiple_of(self.every) {
            true => {
                self.instants.push(own);
                self.last = None;
            }
            false => self.last = Some(own),
        }
        self.count += 1;
        Ok(())
    }
}
