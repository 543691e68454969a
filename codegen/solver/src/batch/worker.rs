//! Solves sets one after another in a group of sixteen lanes, on one thread.
//!
//! A lane takes the next set as soon as its own has ended, so lanes are at different instants.

use linkwright::lanes::{Group, Mask};
use linkwright::{Blocks, Failure, Shell};
use linkwright_codegen::stages::expr::LANES;

use super::columns::Columns;
use super::{Outcome, Supplied, Task};
use crate::interpreted::Interpreted;
use crate::supplied::{InputSignals, Modes, Numbers, Pose};

/// Lanes of a thread.
pub(super) struct Worker<'a> {
    task: Task<'a>,
    group: Group<Interpreted, LANES>,
    /// Set of each lane; `None` for an empty lane.
    lanes: [Option<Lane>; LANES],
    blocks: Interpreted,
    /// Blocks of ended sets, whose memory the next ones take.
    spare: Vec<Interpreted>,
    columns: Columns,
    /// Inputs of empty lanes.
    none: InputSignals,
}

/// Set that is being solved.
#[derive(Clone, Copy)]
struct Lane {
    /// Index of the set among those of the piece.
    set: usize,
    /// Index of the next instant.
    next: usize,
    outcome: Outcome,
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
        Worker {
            columns: Columns::new(&blocks, task.observables),
            none: blocks.initial_inputs(),
            group: Group::new(blocks.clone()),
            lanes: [None; LANES],
            spare: Vec::new(),
            task,
            blocks,
        }
    }

    /// Solves all sets of a piece.
    pub fn solve(&mut self, mut piece: Piece<'_>) {
        piece.values.fill(f64::NAN);
        let mut next = 0;
        loop {
            let began = self.begin(&mut next, &mut piece);
            if !began.is_empty() {
                self.columns.read(self.group.frames());
                self.write(began, &mut piece);
            }
            if self.lanes.iter().all(Option::is_none) {
                return;
            }
            let solved = self.step(&mut piece);
            self.write(solved, &mut piece);
        }
    }

    /// Takes ended sets out of their lanes and assembles the next sets there; returns these lanes.
    fn begin(&mut self, next: &mut usize, piece: &mut Piece<'_>) -> Mask<LANES> {
        let mut began = Mask::NONE;
        for place in 0..LANES {
            let count = self.task.times.len();
            if let Some(ended) = self.lanes[place].take_if(|it| it.next == count) {
                piece.outcomes[ended.set] = ended.outcome;
                let shell = self.group.take(place);
                self.spare.extend(shell.map(Shell::into_blocks));
            }
            while self.lanes[place].is_none() && *next < piece.outcomes.len() {
                match self.assembled(*next, piece) {
                    Ok(shell) => {
                        self.group.put(place, shell);
                        let outcome = Outcome {
                            solved: 1,
                            failure: None,
                        };
                        self.lanes[place] = Some(Lane {
                            set: *next,
                            next: 1,
                            outcome,
                        });
                        began |= Mask::one(place);
                    }
                    Err(failure) => piece.outcomes[*next].failure = Some(failure),
                }
                *next += 1;
            }
        }
        began
    }

    /// Assembles a set of the piece at the first instant.
    fn assembled(&mut self, set: usize, piece: &Piece<'_>) -> Result<Shell<Interpreted>, Failure> {
        let blocks = self.spare.pop().unwrap_or_else(|| self.blocks.clone());
        let set = piece.first + set;
        let parameters = Numbers(piece.supplied.parameters(set).to_vec());
        let Task { pose, modes, .. } = self.task;
        let pose = pose.map_or_else(|| blocks.drawn_pose(&parameters), Pose::clone);
        let modes = modes.map_or_else(|| blocks.drawn_branches(), Modes::clone);
        let (t, inputs) = (self.task.times[0], piece.supplied.inputs(set, 0));
        Shell::assemble(
            blocks,
            &parameters,
            &pose,
            modes,
            t,
            inputs,
            self.task.settings,
        )
    }

    /// Advances all lanes to their next instants; returns the lanes with a solution.
    fn step(&mut self, piece: &mut Piece<'_>) -> Mask<LANES> {
        let times = self.task.times;
        let moving = Mask::of(|place| self.lanes[place].is_some_and(|it| it.next < times.len()));
        let lane = |place: usize| self.lanes[place].filter(|_| moving.has(place));
        let next = std::array::from_fn(|place| lane(place).map_or(0.0, |it| times[it.next]));
        let inputs = std::array::from_fn(|place| match lane(place) {
            Some(it) => piece.supplied.inputs(piece.first + it.set, it.next),
            None => &self.none,
        });
        let failed = match self.task.follows_path {
            true => {
                let failed = self.group.advance(&next, &inputs);
                self.columns.read(self.group.frames());
                failed
            }
            false => {
                let (failed, frames) = self.group.frames_at(&next, &inputs);
                self.columns.read(frames);
                failed
            }
        };
        for place in moving.lanes() {
            let Some(lane) = &mut self.lanes[place] else {
                continue;
            };
            lane.next += 1;
            if !failed.has(place) {
                lane.outcome.solved += 1;
                continue;
            }
            if lane.outcome.failure.is_none() {
                lane.outcome.failure = self.group.failure(place);
            }
            if self.task.follows_path {
                lane.next = times.len();
            }
        }
        moving & !failed
    }

    /// Writes the observables of these lanes at their last instants.
    fn write(&self, lanes: Mask<LANES>, piece: &mut Piece<'_>) {
        let count = self.columns.count();
        for place in lanes.lanes() {
            if let Some(lane) = &self.lanes[place] {
                let row = lane.set * self.task.times.len() + lane.next - 1;
                let row = &mut piece.values[row * count..][..count];
                self.columns.write(place, row);
            }
        }
    }
}
