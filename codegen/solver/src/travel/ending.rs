//! Classifies the end of a line, and verifies it from both sides.

use linkwright::{Blocks, FailureKind, Shell};

use super::line::{DriveLine, LineEnd, Place, TravelEvent, broken, crossed};
use crate::interpreted::Interpreted;
use crate::view::View;

/// Measure below which the end of a line counts as singular: links within about two degrees of collinear.
const SINGULAR: f64 = 0.03;

/// Largest distance between poses on both sides of an end that count as one, in rad and characteristic lengths.
const POSE_DISTANCE: f64 = 0.01;

/// Distance beyond an end at which a pose is sought, as a part of the value or of the longest step. Rounding does not close a loop there.
const BEYOND: f64 = 1e-6;

/// Kind of an end of travel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EndKind {
    /// A loop in closed form cannot be closed beyond: its links are collinear there.
    Reach,
    /// A block without a closed form becomes singular, and no pose continues beyond.
    DeadPoint,
    /// A block becomes singular where branches meet: the motion could continue in another mode.
    ChangePoint,
    /// A measure reaches its limit.
    Limit,
    /// A value that must be positive or in a range is not.
    Refused,
    /// The motion cannot be followed further, for another reason.
    Lost,
    /// A full turn returns to the same pose.
    FullTurn,
    /// No end is found as far as the drive is followed.
    Unended,
}

impl EndKind {
    /// Name in JSON.
    pub fn name(self) -> &'static str {
        match self {
            EndKind::Reach => "reach",
            EndKind::DeadPoint => "dead_point",
            EndKind::ChangePoint => "change_point",
            EndKind::Limit => "limit",
            EndKind::Refused => "refused",
            EndKind::Lost => "lost",
            EndKind::FullTurn => "full_turn",
            EndKind::Unended => "unended",
        }
    }

    /// True if the travel ends there.
    pub fn is_end(self) -> bool {
        !matches!(self, EndKind::FullTurn | EndKind::Unended)
    }
}

/// End with what it concerns.
#[derive(Clone, Debug)]
pub(crate) struct Ending {
    pub kind: EndKind,
    /// Block of the plan, from 0; `None` without a block.
    pub block: Option<usize>,
    /// Index among the mechanism's limits; `None` for other ends.
    pub limit: Option<usize>,
    /// Block, state or reason in words.
    pub words: String,
}

/// Returns the kind of the end of a line.
pub(crate) fn ending(line: &DriveLine<'_>, end: &LineEnd, shell: &Shell<Interpreted>) -> Ending {
    let interpreted = shell.blocks();
    let of_block = |kind: EndKind, block: usize| Ending {
        kind,
        block: Some(block),
        limit: None,
        words: words(interpreted, block, kind),
    };
    let failure = match end.event {
        TravelEvent::Complete => {
            return Ending {
                kind: EndKind::Unended,
                block: None,
                limit: None,
                words: String::new(),
            };
        }
        TravelEvent::Limit(limit) => {
            return Ending {
                kind: EndKind::Limit,
                block: None,
                limit: Some(limit),
                words: of_limit(interpreted, limit),
            };
        }
        TravelEvent::Crossed(part) => {
            let block = line.measures.parts()[part].block;
            return of_block(EndKind::ChangePoint, block);
        }
        TravelEvent::Failed(failure) => failure,
    };
    let with_reason = |kind: EndKind| Ending {
        kind,
        block: None,
        limit: None,
        words: interpreted.reported(&failure),
    };
    if failure.kind.rejects_values() {
        return with_reason(EndKind::Refused);
    }
    let Some(last) = end.places.last() else {
        return with_reason(EndKind::Lost);
    };
    let there = line.resumed(last, shell);
    let scale = end.outside.abs().max(line.step);
    let beyond = end.outside + BEYOND * scale;
    let solved = there.frame_at(beyond, &line.laws.at(beyond));
    if let Err(failure) = &solved
        && is_excluded(failure.kind)
    {
        return match failure.kind.rejects_values() {
            true => with_reason(EndKind::Refused),
            false => of_block(EndKind::Reach, usize::from(failure.block)),
        };
    }
    let samples = line.measures.at(&last.instant);
    let parts = line.measures.parts().iter().zip(&samples);
    let sizes = parts.map(|(part, [value, _])| (part.block, part.bounded(value.abs())));
    let closest = sizes.min_by(|a, b| a.1.total_cmp(&b.1));
    let Some((block, _)) = closest.filter(|(_, size)| *size <= SINGULAR) else {
        return with_reason(EndKind::Lost);
    };
    match solved.is_ok_and(|frame| is_near(&there, frame.q())) {
        true => of_block(EndKind::ChangePoint, block),
        false => of_block(EndKind::DeadPoint, block),
    }
}

/// Returns the end of a line whose loops cannot be closed beyond, to the last digit to which poses exist.
///
/// Steps stop a little before, because their accelerations lose digits.
pub(crate) fn located(line: &DriveLine<'_>, end: LineEnd, shell: &Shell<Interpreted>) -> LineEnd {
    let Some(last) = end.places.last() else {
        return end;
    };
    let mut inside = last.instant.t();
    let mut outside = end.outside + BEYOND * end.outside.abs().max(line.step);
    loop {
        let middle = inside + 0.5 * (outside - inside);
        if middle <= inside || middle >= outside {
            break;
        }
        match exists(line, last, middle, shell) {
            true => inside = middle,
            false => outside = middle,
        }
    }
    LineEnd { outside, ..end }
}

/// True if a pose near a place exists at a length, in its modes.
pub(crate) fn exists(
    line: &DriveLine<'_>,
    place: &Place,
    t: f64,
    shell: &Shell<Interpreted>,
) -> bool {
    let there = line.resumed(place, shell);
    let frame = there.frame_at(t, &line.laws.at(t));
    frame.is_ok_and(|frame| is_near(&there, frame.q()))
}

/// True if a pose continues beyond an end of this kind, so that the end is refuted there.
pub(crate) fn continues(
    line: &DriveLine<'_>,
    end: &LineEnd,
    kind: EndKind,
    outside: f64,
    shell: &Shell<Interpreted>,
) -> bool {
    let Some(last) = end.places.last() else {
        return true;
    };
    let mut there = line.resumed(last, shell);
    let inputs = line.laws.at(outside);
    match kind {
        EndKind::Limit => {
            let moved = there.advance(outside, &inputs).is_ok();
            !moved || broken(&there).is_none()
        }
        EndKind::ChangePoint => {
            let samples = line.measures.at(there.frame());
            let passed = there.advance(outside, &inputs).is_ok();
            !passed || crossed(&samples, &line.measures.at(there.frame())).is_none()
        }
        EndKind::Reach | EndKind::Refused => {
            let beyond = there.frame_at(outside, &inputs);
            !beyond.is_err_and(|failure| is_excluded(failure.kind))
        }
        EndKind::DeadPoint => {
            exists(line, last, outside, shell) || there.advance(outside, &inputs).is_ok()
        }
        EndKind::Lost | EndKind::FullTurn | EndKind::Unended => true,
    }
}

/// True if a failure excludes a pose: links do not reach, or a value is not allowed.
fn is_excluded(kind: FailureKind) -> bool {
    matches!(kind, FailureKind::OutOfReach { .. }) || kind.rejects_values()
}

/// True if a pose is near the last frame: lengths in characteristic lengths.
pub(crate) fn is_near(shell: &Shell<Interpreted>, pose: &[f64]) -> bool {
    let system = shell.blocks().system();
    let length = system.mechanism.characteristic_length;
    let coordinates = system.coordinates.iter().zip(shell.frame().q()).zip(pose);
    let mut distances = coordinates.map(|((own, a), b)| {
        let scale = length.powi(own.quantity.power_of_length());
        (a - b).abs() / scale
    });
    distances.all(|it| it <= POSE_DISTANCE)
}

/// Returns the name of a block with its singular state.
fn words(interpreted: &Interpreted, block: usize, kind: EndKind) -> String {
    let Some(named) = interpreted.block_name(block) else {
        return format!("block {}", block + 1);
    };
    let (name, singular) = (named.name, named.singular);
    match kind {
        EndKind::Reach => format!("{name} cannot be closed beyond; there {singular}"),
        _ => format!("{name}: {singular}"),
    }
}

/// Returns a limit with its measure.
fn of_limit(interpreted: &Interpreted, limit: usize) -> String {
    let mechanism = &interpreted.system().mechanism;
    let limit = &mechanism.limits[limit];
    let name = &mechanism.measurements[limit.measurement].name;
    format!("`{name}`, {}", limit.text(mechanism.units.of_messages()))
}

/// Returns the last place at most at this length.
pub(crate) fn place_before(places: &[Place], t: f64) -> Option<&Place> {
    places.iter().rev().find(|it| it.instant.t() <= t)
}
