//! Moves a compiled mechanism and an interpreted one together, and counts different values.

use std::fmt::Debug;

use linkwright::{Blocks, Failure, Mechanism, Settings, Shell, Values};
use linkwright_codegen::stages::program::Output;
use linkwright_solver::{InputSignals, Instant, Interpreted, View};
use linkwright_tests::values::{filled, numbers};

use super::frame_numbers::numbers_of;
use super::paths::Moved;
use super::{Outputs, Tally};

/// Of so many frames, one is the end of verified windows, and one of more is that of the largest windows.
const VERIFIED: usize = 4;
const SEARCHED: usize = 24;

pub type Frame<M> = <<M as Mechanism>::Blocks as Blocks>::Frame;

/// Compiled mechanism and interpreted one, which are moved together.
pub struct Both<'a, M: Mechanism> {
    generated: Option<Shell<M::Blocks>>,
    interpreted: Option<Shell<Interpreted>>,
    view: &'a Interpreted,
    /// True if the interpreter runs the very program that is compiled.
    is_emitted: bool,
    outputs: fn(&Frame<M>) -> Outputs,
    forces: fn(&Frame<M>) -> Vec<f64>,
    derivatives: fn(&Frame<M>) -> Vec<f64>,
    /// Inputs of the last frame.
    before: InputSignals,
    /// Number of frames after the first ones.
    moves: usize,
    tally: Tally,
}

impl<'a, M> Both<'a, M>
where
    M: Mechanism<Blocks: Blocks<Scalar = f64, Frame: Debug, PathEnclosures: Debug> + Default>,
{
    pub fn new(
        view: &'a Interpreted,
        is_emitted: bool,
        outputs: fn(&Frame<M>) -> Outputs,
        forces: fn(&Frame<M>) -> Vec<f64>,
        derivatives: fn(&Frame<M>) -> Vec<f64>,
    ) -> Both<'a, M> {
        Both {
            generated: None,
            interpreted: None,
            view,
            is_emitted,
            outputs,
            forces,
            derivatives,
            before: view.initial_inputs(),
            moves: 0,
            tally: Tally::default(),
        }
    }

    /// Numbers of compared and of different values.
    pub fn tally(&self) -> Tally {
        self.tally
    }

    /// Assembles both for these parameters.
    pub fn assemble(&mut self, parameters: &[f64], inputs: &InputSignals, t: f64) {
        let blocks = M::Blocks::default();
        let values = filled(blocks.nominal_parameters(), parameters);
        let generated = Shell::assemble(
            M::Blocks::default(),
            &values,
            &blocks.drawn_pose(&values),
            blocks.drawn_branches(),
            t,
            &supplied(&blocks, inputs),
            Settings::default(),
        );
        let values = filled(self.view.nominal_parameters(), parameters);
        let interpreted = Shell::assemble(
            self.view.clone(),
            &values,
            &self.view.drawn_pose(&values),
            self.view.drawn_branches(),
            t,
            inputs,
            Settings::default(),
        );
        let failures = [generated.as_ref().err(), interpreted.as_ref().err()];
        let has_both = self.failed(failures);
        (self.generated, self.interpreted) = (generated.ok(), interpreted.ok());
        self.before = inputs.clone();
        if has_both {
            self.frames();
        }
    }

    /// Moves both, and verifies windows about the last two frames.
    pub fn advance(&mut self, inputs: &InputSignals, t: f64) {
        let (Some(generated), Some(interpreted)) = (&mut self.generated, &mut self.interpreted)
        else {
            return;
        };
        let compiled_inputs = supplied(generated.blocks(), inputs);
        let last = (generated.frame().clone(), interpreted.frame().clone());
        let failures = [
            generated.advance(t, &compiled_inputs).err(),
            interpreted.advance(t, inputs).err(),
        ];
        if self.failed(failures.each_ref().map(Option::as_ref)) {
            self.frames();
            self.moves += 1;
            if self.moves.is_multiple_of(VERIFIED) {
                self.paths(&last, inputs);
            }
            self.before = inputs.clone();
        }
    }

    /// Changes the parameters of both during the motion.
    pub fn change(&mut self, parameters: &[f64]) {
        let (Some(generated), Some(interpreted)) = (&mut self.generated, &mut self.interpreted)
        else {
            return;
        };
        let compiled_parameters = filled(generated.parameters().clone(), parameters);
        let same = filled(interpreted.parameters().clone(), parameters);
        let failures = [
            generated.set_parameters(&compiled_parameters).err(),
            interpreted.set_parameters(&same).err(),
        ];
        self.failed(failures.each_ref().map(Option::as_ref));
    }

    /// Compares failures; true if there is none.
    fn failed(&mut self, failures: [Option<&Failure>; 2]) -> bool {
        let [own, other] = failures.map(|it| it.map(|failure| format!("{failure:?}")));
        if own.is_some() || other.is_some() {
            if own != other {
                println!("generated: {own:?}\ninterpreted: {other:?}");
            }
            self.note(5, own == other);
        }
        own.is_none() && other.is_none()
    }

    fn note(&mut self, kind: usize, is_equal: bool) {
        self.tally[kind][0] += 1;
        self.tally[kind][1] += usize::from(!is_equal);
    }

    /// Compares numbers bit by bit, of which there must be as many.
    fn numbers(&mut self, kind: usize, own: &[f64], same: &[f64]) {
        assert_eq!(own.len(), same.len(), "numbers of kind {kind}");
        for (own, same) in own.iter().zip(same) {
            self.note(kind, own.to_bits() == same.to_bits());
        }
    }

    /// Compares the last frames.
    fn frames(&mut self) {
        let (Some(generated), Some(interpreted)) = (&self.generated, &self.interpreted) else {
            return;
        };
        let (frame, instant) = (generated.frame(), interpreted.frame());
        let (blocks, view) = (generated.blocks(), interpreted.blocks());
        assert_eq!(blocks.holds_coordinates(), view.holds_coordinates());
        let mut pairs: [[Vec<f64>; 2]; 5] = Default::default();
        // What the frame offers by name.
        for (name, level, own) in (self.outputs)(frame) {
            pairs[0][0].extend(own);
            pairs[0][1].extend(output(view, instant, name, level));
        }
        for place in 0.. {
            let [own, same] = [
                blocks.coordinate(frame, place),
                view.coordinate(instant, place),
            ];
            assert_eq!(own.is_some(), same.is_some(), "coordinate {place}");
            let (Some(own), Some(same)) = (own, same) else {
                break;
            };
            pairs[0][0].extend(own);
            pairs[0][1].extend(same);
        }
        for place in 0.. {
            let names = (blocks.point_name(place), view.point_name(place));
            assert_eq!(names.0, names.1);
            let (Some(own), Some(same)) = (blocks.point(frame, place), view.point(instant, place))
            else {
                assert_eq!(names.0, None);
                break;
            };
            for (all, it) in pairs[1].iter_mut().zip([own, same]) {
                all.extend([it.position, it.velocity, it.acceleration].concat());
            }
        }
        let requests = [
            ((self.forces)(frame), view.reported(instant)),
            ((self.derivatives)(frame), view.derivatives(instant)),
        ];
        for (pair, (own, same)) in pairs[2..].iter_mut().zip(requests) {
            if !own.is_empty() {
                *pair = [own, same.expect("columns")];
            }
        }
        if self.is_emitted {
            pairs[4] = [numbers_of(frame), held(interpreted)];
            drop_parameters(&mut pairs[4], interpreted);
        }
        for (kind, [own, same]) in pairs.iter().enumerate() {
            self.numbers(kind, own, same);
        }
    }

    /// Compares verifications of the path from the last frames.
    fn paths(&mut self, last: &(Frame<M>, Instant), inputs: &InputSignals) {
        let (Some(generated), Some(interpreted)) = (&self.generated, &self.interpreted) else {
            return;
        };
        let compiled = [&self.before, inputs].map(|it| supplied(generated.blocks(), it));
        let generated = Moved::new(generated, &last.0, [&compiled[0], &compiled[1]]);
        let interpreted = Moved::new(interpreted, &last.1, [&self.before, inputs]);
        let mut both = [generated.verified(), interpreted.verified()];
        if self.moves.is_multiple_of(SEARCHED) {
            both[0].bounds.extend(generated.largest());
            both[1].bounds.extend(interpreted.largest());
        }
        let [own, same] = both;
        for (own, same) in own.results.iter().zip(&same.results) {
            self.note(6, own == same);
        }
        if own.results == same.results {
            self.numbers(7, &own.bounds, &same.bounds);
        }
    }
}

/// Inputs of a compiled mechanism.
pub fn supplied<B: Blocks<Scalar = f64>>(blocks: &B, inputs: &InputSignals) -> B::Inputs {
    let mut supplied = blocks.initial_inputs();
    assert_eq!(supplied.count(), inputs.count());
    for place in 0..inputs.count() {
        supplied.set(place, inputs.value(place).expect("an input"));
    }
    supplied
}

/// Components of an output of this name at a level.
fn output(view: &Interpreted, instant: &Instant, name: &str, level: usize) -> Vec<f64> {
    let outputs = view.program().outputs.iter().flatten();
    let symbols = outputs.filter_map(|output| match output {
        Output::Point { name: own, fields } if own == name => Some(fields.get(level)?.to_vec()),
        Output::Coordinate {
            name: own, fields, ..
        } if own == name => Some(vec![*fields.get(level)?]),
        _ => None,
    });
    let symbols: Vec<_> = symbols.flatten().collect();
    let slots = symbols.iter().map(|&it| view.layout().slot(it));
    let slots = slots.map(|slot| slot.expect("instants keep outputs"));
    slots.map(|slot| instant.values()[slot]).collect()
}

/// Everything that an instant holds: what later blocks, the next frame and the path read, and the inside of torn blocks.
fn held(shell: &Shell<Interpreted>) -> Vec<f64> {
    let inputs = shell.blocks().initial_inputs().count();
    let supplied = shell.parameters().count() + 3 * inputs;
    let (t, rest) = shell.frame().values().split_at(1);
    [t, &rest[supplied..]].concat()
}

/// Removes the parameters of a frame that keeps them, behind its coordinates.
fn drop_parameters([own, same]: &mut [Vec<f64>; 2], shell: &Shell<Interpreted>) {
    if own.len() > same.len() {
        let parameters = numbers(shell.parameters());
        let coordinates = 1 + 3 * shell.frame().q().len();
        let kept = own.drain(coordinates..coordinates + parameters.len());
        assert!(kept.eq(parameters));
    }
}
