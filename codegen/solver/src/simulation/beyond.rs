//! *A mechanism shortly before a singular pose, and signals beyond it* → *the frame there that goes straight on*.
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

/// The frame at a time that goes straight on from the last one, and its modes; `None` where there is none.
pub(super) fn straight_on(
    shell: &Shell<Interpreted>,
    close: &[usize],
    t: f64,
    inputs: &InputSignals,
) -> Option<(Instant, Modes)> {
    let view = shell.blocks();
    let last = shell.frame();
    let mut other = shell.clone();
    let mut modes = shell.branches().clone();
    let mut frame = shell.frame_at(t, inputs).ok()?;
    for &block in close {
        let number = u16::try_from(block).ok()?;
        let Some(exchanged) = view.exchanged(&modes, number) else {
            continue;
        };
        other.resume(last, &exchanged, inputs);
        let Ok(tried) = other.frame_at(t, inputs) else {
            continue;
        };
        let unknowns = found_in(view, block);
        let [stays, changes] = [&frame, &tried].map(|it| distance(view, last, it, &unknowns));
        if changes < stays {
            (frame, modes) = (tried, exchanged);
        }
    }
    Some((frame, modes))
}

/// The coordinates that a block finds.
fn found_in(view: &Interpreted, number: usize) -> Vec<usize> {
    let block = view.program().blocks.get(number).and_then(|it| it.place);
    let Some(block) = block.and_then(|place| view.plan().blocks.get(place)) else {
        return Vec::new();
    };
    let torn = block
        .parts
        .iter()
        .flat_map(|part| part.unknowns.iter().copied());
    let following = block.definitions.iter().map(|it| it.unknown);
    let count = view.system().coordinates.len();
    torn.chain(following).filter(|it| *it < count).collect()
}

/// How far coordinates and rates are from those that the last frame leads to, over the time that has passed.
fn distance(view: &Interpreted, last: &Instant, found: &Instant, unknowns: &[usize]) -> f64 {
    let time = found.t() - last.t();
    let length = view.system().mechanism.characteristic_length;
    let [from, to]: [Frame<f64, Dyn>; 2] = [last, found].map(Instant::frame);
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
