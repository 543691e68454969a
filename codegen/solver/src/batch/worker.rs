//! Solves sets one after another in eight lanes, on one thread.
//!
//! A lane takes the next set as soon as its own has ended, so lanes are at different instants. A lane whose checks fail is solved again
//! by its shell, which finds the failure or advances in several steps.

use super::lane::Lane;
use super::{Outcome, Supplied, Task};
use crate::interpreted::{Interpreted, InterpretedLanes};
use crate::observable::Observable;
use crate::operation::LANES;

/// Lanes of a thread.
pub(super) struct Worker<'a> {
    task: Task<'a>,
    blocks: Interpreted,
    lanes: [Option<Lane>; LANES],
    /// Blocks of ended sets, whose memory the next ones take.
    spare: Vec<Interpreted>,
    registers: InterpretedLanes,
    /// False if the program has Newton-Raphson, so that shells solve all instants.
    has_lanes: bool,
    has_points: bool,
}

/// Consecutive sets with their results.
pub(super) struct Piece<'a> {
    /// Index of the first set.
    pub first: usize,
    pub supplied: &'a Supplied<'a>,
    pub outcomes: &'a mut [Outcome],
    pub values: &'a mut [f64],
}

impl<'a> Worker<'a> {
    pub fn new(task: Task<'a>, blocks: Interpreted) -> Worker<'a> {
        let is_point = |it: &Observable| matches!(it, Observable::Point { .. });
        Worker {
            task,
            lanes: Default::default(),
            spare: Vec::new(),
            registers: InterpretedLanes::new(&blocks),
            has_lanes: blocks.has_lanes(),
            has_points: task.observables.iter().any(is_point),
            blocks,
        }
    }

    /// Solves all sets of a piece.
    pub fn solve(&mut self, mut piece: Piece<'_>) {
        piece.values.fill(f64::NAN);
        let mut next = 0;
        loop {
            let began = self.begin(&mut next, &mut piece);
            self.measure(began, &mut piece);
            if self.lanes.iter().all(Option::is_none) {
                return;
            }
            let solved = self.step(&mut piece);
            self.measure(solved, &mut piece);
        }
    }

    /// Takes ended sets out of their lanes and assembles the next sets there; returns these lanes as bits.
    fn begin(&mut self, next: &mut usize, piece: &mut Piece<'_>) -> u8 {
        let mut began = 0;
        for lane in 0..LANES {
            let times = self.task.times.len();
            if let Some(ended) = self.lanes[lane].take_if(|it| it.next == times) {
                piece.outcomes[ended.set - piece.first] = ended.outcome;
                self.spare.push(ended.shell.into_blocks());
            }
            while self.lanes[lane].is_none() && *next < piece.outcomes.len() {
                let set = piece.first + *next;
                let blocks = self.spare.pop().unwrap_or_else(|| self.blocks.clone());
                match Lane::assemble(&self.task, blocks, set, piece.supplied) {
                    Ok(assembled) => {
                        self.lanes[lane] = Some(assembled);
                        began |= 1 << lane;
                    }
                    Err(failure) => piece.outcomes[*next].failure = Some(failure),
                }
                *next += 1;
            }
        }
        began
    }

    /// Advances all lanes to their next instants; returns the lanes with a solution as bits.
    fn step(&mut self, piece: &mut Piece<'_>) -> u8 {
        let Task {
            times,
            follows_path,
            ..
        } = self.task;
        for place in 0..LANES {
            let lane = self.lanes[place].as_ref().filter(|_| self.has_lanes);
            let Some(lane) = lane.filter(|it| it.next < times.len()) else {
                continue;
            };
            let inputs = piece.supplied.inputs(lane.set, lane.next);
            let supplied = (lane.shell.parameters(), inputs);
            let (t, modes) = (times[lane.next], lane.shell.branches());
            self.registers
                .fill(&self.blocks, place, lane.shell.frame(), t, modes, supplied);
        }
        let failed = match self.has_lanes {
            true => self.registers.solve(&self.blocks),
            false => u8::MAX,
        };
        let mut solved = 0;
        for place in 0..LANES {
            let lane = self.lanes[place].as_mut();
            let Some(lane) = lane.filter(|it| it.next < times.len()) else {
                continue;
            };
            let t = times[lane.next];
            let inputs = piece.supplied.inputs(lane.set, lane.next);
            let Lane { shell, at, .. } = lane;
            let is_solved = failed & 1 << place == 0;
            let result = match (follows_path, is_solved) {
                (true, true) => shell
                    .advance_solved(t, inputs, |at| {
                        self.registers.keep(&self.blocks, place, t, at);
                    })
                    .map(drop),
                (true, false) => shell.advance(t, inputs).map(drop),
                (false, true) => {
                    self.registers.keep(&self.blocks, place, t, at);
                    Ok(())
                }
                (false, false) => shell.frame_at(t, inputs).map(|frame| *at = frame),
            };
            lane.next += 1;
            match result {
                Ok(()) => {
                    lane.outcome.solved += 1;
                    solved |= 1 << place;
                }
                Err(failure) => {
                    lane.outcome.failure.get_or_insert(failure);
                    if follows_path {
                        lane.next = times.len();
                    }
                }
            }
        }
        solved
    }

    /// Writes the observables of these lanes.
    fn measure(&mut self, lanes: u8, piece: &mut Piece<'_>) {
        let follows_path = self.task.follows_path;
        let solved = |place: &usize| lanes & 1 << place != 0;
        if self.has_points && lanes != 0 {
            for place in (0..LANES).filter(solved) {
                if let Some(lane) = &self.lanes[place] {
                    let at = lane.instant(follows_path);
                    self.registers.fill_points(&self.blocks, place, at);
                }
            }
            self.registers.run_points(&self.blocks);
        }
        let observables = self.task.observables;
        for place in (0..LANES).filter(solved) {
            let Some(lane) = &self.lanes[place] else {
                continue;
            };
            let at = lane.instant(follows_path);
            let row = (lane.set - piece.first) * self.task.times.len() + lane.next - 1;
            let row = &mut piece.values[row * observables.len()..][..observables.len()];
            for (value, observable) in row.iter_mut().zip(observables) {
                let measured = match *observable {
                    Observable::Coordinate { place, level } => {
                        at.coordinate(place).map(|it| it[level])
                    }
                    Observable::Point {
                        place: point,
                        axis,
                        level,
                    } => self
                        .registers
                        .point(&self.blocks, (place, at), point, [level, axis]),
                    Observable::Force(force) => self.blocks.force(at, force),
                };
                *value = measured.unwrap_or(f64::NAN);
            }
        }
    }
}
