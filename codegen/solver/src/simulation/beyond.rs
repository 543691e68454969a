//! *The last frame that was far from singular poses, and signals at or beyond one* → *the frame there that goes straight on*.
//!
//! Where modes of a block meet, the smooth path goes on in the other one. The shell follows it where it can tell; where several blocks
//! are singular in one pose it cannot. Here the modes are chosen block by block, in the order in which they are solved, such that its
//! unknowns and their rates are nearest to those that the last frame leads to. Near a meeting the poses of both modes are close, but their
//! rates are not.

use linkwright::{Blocks, Frame, Shell};
use nalgebra::Dyn;

use crate::instant::Instant;
use crate::interpreted::Interpreted;
use crate::measures::Measures;
use crate::supplied::{InputSignals, Modes};
use crate::view::View;

/// To which part of itself a measure must be expected to fall for its block to count as close to singular.
const FALLEN: f64 = 0.5;

/// The numbers of the blocks that are expected to be close to a singular pose, or beyond it, when so much time has passed.
pub(super) fn close_blocks(
    measures: &Measures,
    view: &Interpreted,
    frame: &Instant,
    time: f64,
) -> Vec<usize> {
    let samples = measures.at(frame);
    let parts = measures.parts().iter().zip(samples);
    let mut close: Vec<usize> = parts
        .filter(|(_, [size, rate])| {
            let expected = size + rate * time;
            expected * size.signum() <= FALLEN * size.abs()
        })
        .map(|(part, _)| usize::from(view.program().number_of(part.block)))
        .collect();
    close.dedup();
    close
}

/// The frame at a time that goes straight on from that of the shell, and its modes; `time` is how much later the mechanism is expected
/// to be so far on its way.
///
/// # Errors
/// It cannot be solved there.
pub(super) fn straight_on(
    shell: &Shell<Interpreted>,
    close: &[usize],
    (t, time): (f64, f64),
    inputs: &InputSignals,
) -> Result<(Instant, Modes), linkwright::Failure> {
    let view = shell.blocks();
    let last = shell.frame();
    let mut modes = shell.branches().clone();
    let mut found = shell.frame_at(t, inputs);
    if close.is_empty() {
        return found.map(|frame| (frame, modes));
    }
    let mut other = shell.clone();
    for &block in close {
        let number = u16::try_from(block).unwrap_or(u16::MAX);
        let Some(exchanged) = view.exchanged(&modes, number) else {
            continue;
        };
        other.resume(last, &exchanged, inputs);
        let Ok(tried) = other.frame_at(t, inputs) else {
            continue;
        };
        let unknowns = view.found_in(block);
        let missed = |frame: &Instant| distance(view, [last, frame], time, &unknowns);
        let is_nearer = match &found {
            Ok(stays) => missed(&tried) < missed(stays),
            Err(_) => true,
        };
        if is_nearer {
            (found, modes) = (Ok(tried), exchanged);
        }
    }
    found.map(|frame| (frame, modes))
}

/// How far coordinates and rates are from those that the first frame leads to in a time, over that time.
fn distance(view: &Interpreted, frames: [&Instant; 2], time: f64, unknowns: &[usize]) -> f64 {
    let length = view.system().mechanism.characteristic_length;
    let [from, to]: [Frame<f64, Dyn>; 2] = frames.map(Instant::frame);
    let own = unknowns.iter().map(|&at| {
        let scale = match view.system().coordinates[at].quantity.power_of_length() {
            0 => 1.0,
            _ => length,
        };
        let pose = from.q[at] + time * (from.qd[at] + 0.5 * time * from.qdd[at]);
        let rate = from.qd[at] + time * from.qdd[at];
        let missed = [to.q[at] - pose, time * (to.qd[at] - rate)];
        missed.map(|it| (it / scale).powi(2)).iter().sum::<f64>()
    });
    own.sum()
}
