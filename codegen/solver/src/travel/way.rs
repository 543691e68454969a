//! Follows a drive in one direction: from its start, over full turns, to its end.

use std::f64::consts::TAU;

use linkwright::math::Real as _;
use linkwright::{Failure, Shell};
use linkwright_codegen::stages::system::Derived;

use super::digits::{Decimals, DriveScale, decimals};
use super::ending::{EndKind, ending, is_near, located};
use super::line::{DriveLine, Place, TravelEvent};
use super::{Immovable, TravelEnd};
use crate::interpreted::Interpreted;
use crate::measures::Measures;
use crate::proof::Proof;
use crate::schedule::Schedule;
use crate::view::View;

/// Longest step of an angle (rad): one degree.
const ANGLE_STEP: f64 = TAU / 360.0;

/// Longest step of a length, as a part of the characteristic length.
const LENGTH_STEP: f64 = 1.0 / 200.0;

/// Full turns after which an angle that does not return to its pose counts as unlimited.
const TURNS: u32 = 8;

/// Characteristic lengths after which a length counts as unlimited.
const LENGTHS: f64 = 20.0;

/// Distances from a singular start at which poses are tried, as parts of the longest step.
const BESIDE: [f64; 4] = [1e-9, 1e-7, 1e-5, 1e-3];

/// Distance, in rad and characteristic lengths, below which two poses are the same.
const SAME_POSE: f64 = 1e-9;

/// Number of halvings of the way to an end at which a proof has frames.
const PROOF_INSTANTS: usize = 48;

/// One way of a drive.
pub(super) struct TravelWay {
    /// Mechanism whose time is the value of the drive, in the direction of the way.
    pub interpreted: Interpreted,
    pub is_angle: bool,
    pub scale: DriveScale,
}

impl TravelWay {
    /// Returns the value of the drive at the start, and the end of the way.
    pub fn end(self, proves: bool, see: &mut impl FnMut()) -> Result<(f64, TravelEnd), Immovable> {
        let TravelWay {
            interpreted, scale, ..
        } = &self;
        let mechanism = &interpreted.system().mechanism;
        let start = mechanism
            .inputs
            .last()
            .and_then(|it| interpreted.pool().graph.constant_value(it.initial));
        let start = scale.sign * start.ok_or(Immovable::Unsolvable)?;
        let laws = interpreted.input_laws();
        let measures = interpreted.measured();
        let length = mechanism.characteristic_length;
        let line = DriveLine {
            laws: &laws,
            measures: &measures,
            step: match self.is_angle {
                true => ANGLE_STEP,
                false => LENGTH_STEP * length,
            },
            precision: 0.0,
        };
        let shell = self.begun(start, line.step)?;
        let first = Place::of(&shell);
        let (stretch, stretches) = match self.is_angle {
            true => (TAU, TURNS),
            false => (LENGTHS * length, 1),
        };
        let mut moving = self.departed(&line, &shell);
        let (mut end, mut turns) = (None, None);
        for turn in 1..=stretches {
            let ended = line.follow(moving.clone(), start + f64::from(turn) * stretch, |_| see());
            let is_complete = matches!(ended.event, TravelEvent::Complete);
            let last = ended.places.last().cloned();
            end = Some(ended);
            if !is_complete {
                break;
            }
            let Some(last) = last else { break };
            if self.is_angle && self.is_same(&first, &last) {
                turns = Some(turn);
                break;
            }
            moving = line.resumed(&last, &moving);
        }
        let end = end.ok_or(Immovable::Unsolvable)?;
        let ending = ending(&line, &end, &shell);
        let kind = match turns {
            Some(_) => EndKind::FullTurn,
            None => ending.kind,
        };
        let end = match kind {
            EndKind::Reach | EndKind::DeadPoint => located(&line, end, &shell),
            _ => end,
        };
        let decimals_of = |at_most: usize| match kind.is_end() {
            true => decimals(&line, &end, kind, (*scale, at_most), &shell),
            false => None,
        };
        let mut decimals = decimals_of(usize::MAX);
        let last = end.places.last().unwrap_or(&first);
        let value = match kind {
            EndKind::ChangePoint => scale.sign * end.outside,
            _ => scale.sign * last.instant.t(),
        };
        let proof = match proves {
            true => self.proof(start, last.instant.t(), kind, &mut decimals, decimals_of),
            false => None,
        };
        let travel_end = TravelEnd {
            kind,
            block: ending.block,
            measure: ending.limit.map(|it| {
                let limit = &mechanism.limits[it];
                mechanism.measurements[limit.measurement].name.clone()
            }),
            words: match kind {
                EndKind::Unended => self.unended(&measures),
                _ => ending.words,
            },
            value,
            decimals,
            turns,
            instant: last.instant.clone(),
            proof,
        };
        Ok((scale.sign * start, travel_end))
    }

    /// Assembles the mechanism at the start, or next to a start that is singular.
    fn begun(&self, start: f64, step: f64) -> Result<Shell<Interpreted>, Immovable> {
        let assembled = |t: f64| self.interpreted.assembled_as_drawn(t);
        let failure = match assembled(start) {
            Ok(shell) => return Ok(shell),
            Err(failure) => failure,
        };
        let mut beside = BESIDE.iter().flat_map(|off| [off * step, -off * step]);
        let beside = beside.find_map(|off| assembled(start + off).ok());
        beside.ok_or_else(|| self.unassembled(&failure))
    }

    /// Returns the mechanism at the start, or a little further along the way if the start is too close to singular to be left by steps.
    fn departed(&self, line: &DriveLine<'_>, shell: &Shell<Interpreted>) -> Shell<Interpreted> {
        let start = shell.frame().t();
        let nearest = start + BESIDE[0] * line.step;
        if line.passed(&Place::of(shell), nearest, shell).is_some() {
            return shell.clone();
        }
        let further = BESIDE.iter().map(|off| start + off * line.step);
        let mut further = further.filter_map(|t| self.interpreted.assembled_as_drawn(t).ok());
        let near = further.find(|it| is_near(shell, it.frame().q()));
        near.unwrap_or_else(|| shell.clone())
    }

    /// Proves the path to the value of an end, or around a full turn.
    ///
    /// A proof that stops just before an end has its decimals reduced to those that are proven.
    fn proof(
        &self,
        start: f64,
        last: f64,
        kind: EndKind,
        decimals: &mut Option<Decimals>,
        decimals_of: impl Fn(usize) -> Option<Decimals>,
    ) -> Option<Proof> {
        let Some(all) = *decimals else {
            return match kind {
                EndKind::FullTurn => proof(&self.interpreted, start, last),
                _ => None,
            };
        };
        let inner = |it: &Decimals| self.scale.sign * it.inner * self.scale.unit;
        let to = inner(&all);
        if to <= start {
            return None;
        }
        let whole = proof(&self.interpreted, start, to)?;
        let Some(unproven) = &whole.unproven else {
            return Some(whole);
        };
        let reached = unproven.window[0];
        let fewer = (0..all.count).rev().filter_map(decimals_of);
        let mut fewer = fewer.filter(|it| (start..=reached).contains(&inner(it)));
        if let Some(proven) = fewer.next().filter(|it| inner(it) > start)
            && let Some(proof) = proof(&self.interpreted, start, inner(&proven))
            && proof.proven.is_some()
        {
            *decimals = Some(proven);
            return Some(proof);
        }
        Some(whole)
    }

    /// Returns how far no end is found, in words.
    fn unended(&self, measures: &Measures) -> String {
        let mechanism = &self.interpreted.system().mechanism;
        if measures.parts().is_empty() && mechanism.limits.is_empty() {
            return "no pose is singular".to_string();
        }
        match self.is_angle {
            true => format!("none within {TURNS} full turns"),
            false => {
                format!("none within {LENGTHS} times the largest coordinate of the description")
            }
        }
    }

    fn unassembled(&self, failure: &Failure) -> Immovable {
        Immovable::NotAssembled(self.interpreted.reported(failure))
    }

    /// True if two poses are equal up to whole turns, with equal modes.
    fn is_same(&self, first: &Place, last: &Place) -> bool {
        let system = self.interpreted.system();
        let length = system.mechanism.characteristic_length;
        let pairs = first.instant.q().iter().zip(last.instant.q());
        let mut coordinates = system.coordinates.iter().zip(pairs);
        first.modes == last.modes
            && coordinates.all(|(own, (&a, &b))| {
                let power = own.quantity.power_of_length();
                let b = match power {
                    0 => b.nearest_turn(a),
                    _ => b,
                };
                (a - b).abs() <= SAME_POSE * length.powi(power)
            })
    }
}

/// Returns the mechanism whose last input is its time, with this sign; `None` if it cannot be solved.
pub(super) fn along(driven: &Derived, sign: f64) -> Option<Interpreted> {
    let mut driven = driven.clone();
    let Derived { pool, system } = &mut driven;
    let graph = &mut pool.graph;
    let time = graph.variable(system.mechanism.time);
    let (one, zero) = (graph.one(), graph.zero());
    let signal = match sign > 0.0 {
        true => [time, one, zero],
        false => [graph.negate(time), graph.negate(one), zero],
    };
    system.mechanism.inputs.last_mut()?.signal = signal;
    Interpreted::new(&driven)
}

/// Proves the path between two lengths, with windows that become shorter towards both ends.
fn proof(interpreted: &Interpreted, from: f64, to: f64) -> Option<Proof> {
    let length = to - from;
    let halves = (1..=PROOF_INSTANTS as i32).map(|k| to - length * 0.5_f64.powi(k));
    let instants: Vec<f64> = halves.chain([to]).collect();
    let schedule = Schedule::instants(from, &instants, length / 64.0).ok()?;
    Some(Proof::new(interpreted, &schedule, &[], &[]))
}
