//! Records the motion of each assembly as columns of numbers that a page plays back.
//!
//! A column holds one coordinate, rate, acceleration, measure or force at all kept instants. Columns that assemblies share, and constants,
//! are written once.

use std::collections::HashMap;
use std::convert::Infallible;
use std::io;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use linkwright::Blocks as _;
use linkwright_solver::{
    Instant, Interpreted, Modes, Movable as _, Moved, Numbers, Schedule, View as _, follow,
};
use serde::Serialize;

use crate::forced::{followed, is_moved_by_forces};
use crate::motion::{Followed, Shown, Sink, Wanted};

/// Precision of the numbers of columns.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// `f32`, for pages in files: what a screen can show.
    #[default]
    Single,
    /// `f64`, the bits of the solver.
    Double,
}

/// Numbers of all motions.
#[derive(Debug, Default, Serialize)]
#[serde(transparent)]
pub struct Columns {
    columns: Vec<Column>,
    #[serde(skip)]
    precision: Precision,
    #[serde(skip)]
    places: HashMap<Vec<u8>, usize>,
}

/// Values of one quantity.
#[derive(Debug, Serialize)]
#[serde(untagged)]
enum Column {
    /// Value at all times.
    Constant(f64),
    /// Value at all times, in single precision.
    ConstantSingle(f32),
    /// Values in the precision of the page, little-endian, in Base64.
    Changing(String),
}

/// One motion.
#[derive(Debug, Serialize)]
pub struct Recorded {
    /// Times of the kept instants (s).
    pub times: Vec<f64>,
    /// Columns of q, q̇ and q̈, coordinate by coordinate.
    pub coordinates: Vec<[usize; 3]>,
    /// Columns of the distances of blocks from a singular pose.
    pub measures: Vec<usize>,
    /// Columns of the requested forces.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub forces: Vec<usize>,
    /// Reason of an early end; `None` if the motion is complete.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
    /// Warnings.
    #[serde(skip)]
    pub warnings: Vec<String>,
    /// Kept instants.
    #[serde(skip)]
    pub instants: Vec<Instant>,
}

impl Columns {
    /// Creates an empty set of columns.
    pub fn new(precision: Precision) -> Columns {
        Columns {
            precision,
            ..Columns::default()
        }
    }

    /// Precision of the numbers.
    pub fn precision(&self) -> Precision {
        self.precision
    }

    /// Returns the index of a column of these values, adding it if necessary.
    pub fn place(&mut self, values: impl Iterator<Item = f64>) -> usize {
        let mut values: Vec<f64> = values.collect();
        if self.precision == Precision::Single {
            values.iter_mut().for_each(|it| *it = f64::from(*it as f32));
        }
        let first = values.first().copied();
        let constant = first.filter(|first| values.iter().all(|it| it == first));
        let used = match constant {
            Some(_) => &values[..1],
            None => &values[..],
        };
        let bytes: Vec<u8> = match self.precision {
            Precision::Single => used
                .iter()
                .flat_map(|it| (*it as f32).to_le_bytes())
                .collect(),
            Precision::Double => used.iter().flat_map(|it| it.to_le_bytes()).collect(),
        };
        if let Some(&place) = self.places.get(&bytes) {
            return place;
        }
        self.columns.push(match (constant, self.precision) {
            (Some(value), Precision::Single) => Column::ConstantSingle(value as f32),
            (Some(value), Precision::Double) => Column::Constant(value),
            (None, _) => Column::Changing(STANDARD.encode(&bytes)),
        });
        self.places.insert(bytes, self.columns.len() - 1);
        self.columns.len() - 1
    }
}

/// Examination of a motion while it is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Examination {
    /// Closest approaches to singular poses and signs of forces, for warnings.
    Full,
    /// None, for a motion that is replaced at once.
    None,
}

/// Kept instants of a motion, and findings.
pub struct Track {
    /// Instants with their measures and forces.
    pub kept: Vec<KeptInstant>,
    /// Reason of an early end.
    pub error: Option<String>,
    /// Warnings.
    pub warnings: Vec<String>,
}

/// Follows a motion and keeps at most `most` of its instants.
///
/// # Errors
/// The reason that the mechanism cannot be assembled.
pub fn recorded(
    view: &Interpreted,
    schedule: &Schedule,
    chosen: Option<(Instant, Modes)>,
    most: usize,
    examination: Examination,
    columns: &mut Columns,
) -> Result<Recorded, String> {
    let kept = Kept {
        every: schedule.wanted().div_ceil(most.max(2)).max(1),
        count: 0,
        instants: Vec::new(),
        last: None,
    };
    let track = match examination {
        _ if is_moved_by_forces(view) => followed(view, schedule, chosen, kept)?,
        Examination::Full => examined(view, schedule, chosen, kept)?,
        Examination::None => unexamined(view, schedule, chosen, kept)?,
    };
    let kept = track.kept;
    let Some((first, measures, forces)) = kept.first() else {
        return Err(track.error.unwrap_or_default());
    };
    let (count, measured, exerted) = (first.q().len(), measures.len(), forces.len());
    let mut column = |of: &dyn Fn(&KeptInstant) -> f64| columns.place(kept.iter().map(of));
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
    let force = |forces: &[f64], place| forces.get(place).copied().unwrap_or(f64::NAN);
    let forces = (0..exerted).map(|place| column(&|(.., forces)| force(forces, place)));
    let forces = forces.collect();
    Ok(Recorded {
        times: kept.iter().map(|(it, ..)| it.t()).collect(),
        coordinates,
        measures,
        forces,
        error: track.error,
        warnings: track.warnings,
        instants: kept.into_iter().map(|(it, ..)| it).collect(),
    })
}

fn examined(
    view: &Interpreted,
    schedule: &Schedule,
    chosen: Option<(Instant, Modes)>,
    mut kept: Kept,
) -> Result<Track, String> {
    let selection = Wanted {
        monitor: true,
        ..Wanted::default()
    };
    let mut motion = Followed::new(view.clone(), selection, schedule.start.t, chosen);
    let ended = motion.follow(schedule, &mut [&mut kept], |_| {});
    ended.map_err(|error| error.to_string())?;
    Ok(Track {
        kept: kept.all(),
        error: motion.error,
        warnings: motion.warnings,
    })
}

fn unexamined(
    view: &Interpreted,
    schedule: &Schedule,
    chosen: Option<(Instant, Modes)>,
    mut kept: Kept,
) -> Result<Track, String> {
    let mut moved = at_start(view, chosen, schedule.start.t)?;
    let laws = view.input_laws();
    let measures = view.measures();
    let mut see = |moved: &Moved<Interpreted>| {
        kept.keep(|| {
            let instant = moved.instant().clone();
            let forces = view.reported(&instant).unwrap_or_default();
            let samples = measures.iter().flat_map(|measures| {
                let samples = measures.at(moved.fuller().frame());
                let parts = measures.parts().iter().zip(samples);
                parts.map(|(part, [value, _])| part.bounded(value.abs()))
            });
            let samples = samples.collect();
            (instant, samples, forces)
        });
    };
    see(&moved);
    let end = follow(&mut moved, &laws, &schedule.forward, |moved, _| {
        see(moved);
        Ok::<(), Infallible>(())
    });
    let Ok(end) = end;
    Ok(Track {
        kept: kept.all(),
        error: end.map(|end| moved.ended(&end)),
        warnings: Vec::new(),
    })
}

/// Assembles the mechanism at `t` (s) near a chosen pose, or as in the design configuration.
///
/// # Errors
/// The reason that it cannot be assembled.
pub fn at_start(
    view: &Interpreted,
    chosen: Option<(Instant, Modes)>,
    t: f64,
) -> Result<Moved<Interpreted>, String> {
    let (pose, modes) = match chosen {
        Some((instant, modes)) => (Numbers(instant.q().to_vec()), modes),
        None => (
            view.drawn_pose(&view.nominal_parameters()),
            view.drawn_branches(),
        ),
    };
    Moved::assemble(view.clone(), &pose, modes, t).map_err(|refused| refused.reason)
}

/// Instant, its measures and its forces.
pub type KeptInstant = (Instant, Vec<f64>, Vec<f64>);

/// Every `every`-th instant, and the last.
pub struct Kept {
    every: usize,
    count: usize,
    instants: Vec<KeptInstant>,
    last: Option<KeptInstant>,
}

impl Kept {
    /// Keeps an instant if it is one of every few, or until the next one.
    fn keep(&mut self, instant: impl FnOnce() -> KeptInstant) {
        match self.count.is_multiple_of(self.every) {
            true => {
                self.instants.push(instant());
                self.last = None;
            }
            false => self.last = Some(instant()),
        }
        self.count += 1;
    }

    /// Returns all kept instants, the last one among them.
    pub fn all(mut self) -> Vec<KeptInstant> {
        self.instants.extend(self.last.take());
        self.instants
    }
}

impl Sink for Kept {
    fn take(&mut self, shown: &Shown<'_>) -> io::Result<()> {
        self.keep(|| {
            let forces = shown.reported.unwrap_or_default().to_vec();
            (shown.instant.clone(), shown.measures.to_vec(), forces)
        });
        Ok(())
    }
}
