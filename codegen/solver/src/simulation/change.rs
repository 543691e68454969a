//! *A mechanism whose free coordinate is about to stand still while all else moves* → *the same mechanism with another one free*.
//!
//! At a dead center a free coordinate turns back while the mechanism goes on: nothing is a smooth function of it there, although the motion
//! is one of time. Then a coordinate of a body takes its place, with the value and the rate that it has at that instant; the pose is
//! solved again and must be the same. Where equations of joints lose rank every coordinate fails, and none is changed.

use linkwright::{Blocks, Shell, Signal};

use super::freedom::{Exchange, Freedom, steadiness};
use super::reduced::ReducedMotion;
use super::right_side::RightSide;
use super::stop::{SINGULAR, closest};
use crate::dormand_prince::Rates;
use crate::instant::Instant;
use crate::interpreted::Interpreted;
use crate::supplied::Numbers;
use crate::view::View;

/// To which part of its largest steadiness a free coordinate falls before another one takes its place.
const UNSTEADY: f64 = 0.3;

/// The same for the end of a step, which is otherwise tried shorter.
const TOO_UNSTEADY: f64 = 0.15;

/// The normalized determinant below which a coordinate is compared with others, whatever it was before.
const CLOSE: f64 = 0.15;

/// By how much another coordinate must be steadier.
const GAIN: f64 = 2.0;

/// How many coordinates are tried.
const TRIED: usize = 8;

/// How far the pose may be from the one before, in characteristic lengths or rad.
const SAME_POSE: f64 = 1e-9;

/// To which part of that of another one the steadiness of a coordinate has fallen that has ended a motion.
const STILL: f64 = 0.01;

/// A change of a free coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// When (s).
    pub t: f64,
    /// What was free, as a description writes it: `x(piston)`.
    pub from: String,
    /// What is free then.
    pub to: String,
    /// What the part of the mechanism that was closest to singular finds, where there is one: `phi_crank and phi_rod`.
    pub part: Option<String>,
    /// Its normalized determinant.
    pub determinant: f64,
}

/// For each free coordinate of the description the one that is free in its place: an index into q.
type Chosen = Vec<Option<usize>>;

/// What is free, and what could be.
#[derive(Clone, Debug)]
pub(super) struct Changing {
    described: Interpreted,
    chosen: Chosen,
    /// Mechanisms with others free; `None` where there is no order in which they are solved.
    known: Vec<(Chosen, Option<Interpreted>)>,
    freedom: Freedom,
    /// The largest steadiness of what is free now, and the one of the last frame.
    steadiest: f64,
    last: f64,
    pub changes: Vec<Change>,
}

/// A mechanism with another coordinate free, where it goes on.
pub(super) struct Changed {
    pub right_side: RightSide,
    pub state: Vec<f64>,
    pub slope: Vec<f64>,
    chosen: Chosen,
}

impl Changing {
    /// Of a mechanism as it is described.
    pub fn new(view: &Interpreted) -> Changing {
        Changing {
            described: view.clone(),
            chosen: vec![None; view.system().mechanism.forces.free.len()],
            known: Vec::new(),
            freedom: Freedom::new(view),
            steadiest: 0.0,
            last: 0.0,
            changes: Vec::new(),
        }
    }

    /// Whether a step may not end so: what is free has been steady, and would be too unsteady there.
    pub fn is_too_far(&self, view: &Interpreted, end: &Instant) -> bool {
        let moved = self.freedom.moved(view, end);
        let there = moved.map_or(0.0, |moved| steadiness(&moved));
        self.last >= UNSTEADY * self.steadiest && there < TOO_UNSTEADY * self.steadiest
    }

    /// Sees the frame at the end of a step; the mechanism with another coordinate free, where one is about to stand still and another is not.
    pub fn see(&mut self, old: &RightSide, state: &[f64]) -> Option<Changed> {
        let (view, frame) = (old.shell.blocks(), old.shell.frame());
        let moved = self.freedom.moved(view, frame)?;
        self.last = steadiness(&moved);
        self.steadiest = self.steadiest.max(self.last);
        let exchanges = self.freedom.exchanges(&moved);
        let best = exchanges.iter().map(|it| it.steadiness);
        let best = best.fold(0.0, f64::max);
        let measured = closest(view, frame);
        let is_close = || measured.as_ref().is_some_and(|(_, size)| *size < CLOSE);
        let is_unsteady =
            self.last < UNSTEADY * self.steadiest || (self.last < UNSTEADY * best && is_close());
        if !is_unsteady {
            return None;
        }
        let better = exchanges.iter();
        let better = better.filter(|it| it.steadiness >= GAIN * self.last);
        let better: Vec<Exchange> = better.take(TRIED).copied().collect();
        let found = better.iter().find_map(|exchange| {
            let found = self.changed(old, state, exchange)?;
            Some((exchange, found))
        });
        let (exchange, found) = found?;
        let to = found.right_side.shell.blocks();
        let (part, determinant) = measured.map_or((None, 0.0), |(part, size)| (Some(part), size));
        self.changes.push(Change {
            t: frame.t(),
            from: free_name(view, exchange.place),
            to: free_name(to, exchange.place),
            part,
            determinant,
        });
        self.freedom = Freedom::new(to);
        self.chosen.clone_from(&found.chosen);
        self.last = exchange.steadiness;
        self.steadiest = exchange.steadiness;
        Some(found)
    }

    /// The mechanism after an exchange in the same pose; `None` where it cannot be solved there.
    fn changed(&mut self, old: &RightSide, state: &[f64], exchange: &Exchange) -> Option<Changed> {
        let mut chosen = self.chosen.clone();
        chosen[exchange.place] = Some(exchange.coordinate);
        let view = self.with(&chosen)?;
        let motion = ReducedMotion::new(view.program(), view.layout())?;
        let frame = old.shell.frame();
        let (t, count) = (frame.t(), chosen.len());
        let mut state = state.to_vec();
        for (place, coordinate) in chosen.iter().enumerate() {
            let Some(coordinate) = *coordinate else {
                continue;
            };
            state[place] = frame.q()[coordinate];
            state[count + place] = frame.qd()[coordinate];
        }
        let mut inputs = view.input_laws().at(t);
        for (place, &input) in motion.inputs.iter().enumerate() {
            inputs.0[input] = Signal::new(state[place], state[count + place], 0.0);
        }
        let parameters = view.nominal_parameters();
        let modes = view.modes_in(frame.q(), t, &inputs)?;
        let pose = Numbers(frame.q().to_vec());
        let settings = Default::default();
        let shell = Shell::assemble(view, &parameters, &pose, modes, t, &inputs, settings).ok()?;
        let view = shell.blocks();
        let length = view.system().mechanism.characteristic_length;
        let coordinates = view.system().coordinates.iter().enumerate();
        let mut distances = coordinates.map(|(at, coordinate)| {
            let scale = match coordinate.quantity.power_of_length() {
                0 => 1.0,
                _ => length,
            };
            (shell.frame().q()[at] - frame.q()[at]).abs() / scale
        });
        if !distances.all(|distance| distance <= SAME_POSE) {
            return None;
        }
        let mut right_side = old.with(shell, motion);
        let mut slope = vec![0.0; state.len()];
        right_side.rates(t, &state, &mut slope).ok()?;
        let inputs = right_side.inputs(t, &state, &slope[count..2 * count]);
        right_side.follow(t, &inputs).ok()?;
        Some(Changed {
            right_side,
            state,
            slope,
            chosen,
        })
    }

    /// The mechanism with these coordinates free.
    fn with(&mut self, chosen: &Chosen) -> Option<Interpreted> {
        if let Some((_, known)) = self.known.iter().find(|(own, _)| own == chosen) {
            return known.clone();
        }
        let described = self.described.system().clone();
        let pairs = chosen.iter().enumerate();
        let mut pairs = pairs.filter_map(|(place, coordinate)| Some((place, (*coordinate)?)));
        let system = pairs.try_fold(described, |system, (place, coordinate)| {
            system.exchanged(place, coordinate)
        });
        let view = system.and_then(|system| Interpreted::new(&system));
        self.known.push((chosen.clone(), view.clone()));
        view
    }
}

/// What keeps a motion from going on in its free coordinates.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Hindrance {
    /// This one, as a description writes it, stands still while the mechanism moves.
    StandsStill(String),
    /// Equations of joints and drivers lose rank, whatever is free.
    LosesRank,
}

/// What keeps a motion from going on after a frame, where it is one of the two.
pub(super) fn hindrance(view: &Interpreted, last: &Instant) -> Option<Hindrance> {
    let freedom = Freedom::new(view);
    let moved = freedom.moved(view, last)?;
    let exchanges = freedom.exchanges(&moved);
    let best = exchanges.iter();
    let best = best.max_by(|one, other| one.steadiness.total_cmp(&other.steadiness));
    if let Some(best) = best
        && steadiness(&moved) < STILL * best.steadiness
    {
        return Some(Hindrance::StandsStill(free_name(view, best.place)));
    }
    let (_, size) = closest(view, last)?;
    (size < SINGULAR).then_some(Hindrance::LosesRank)
}

/// What is free, as a description writes it.
fn free_name(view: &Interpreted, place: usize) -> String {
    let mechanism = &view.system().mechanism;
    let free = mechanism.forces.free.get(place);
    let label = free.map_or("", |free| mechanism.joints[free.joint].label.as_str());
    let name = label.split_once(": ").map_or(label, |(_, name)| name);
    name.to_string()
}
