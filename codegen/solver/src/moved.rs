//! Moves the program that is written out and, beside it, a fuller one that computes what reports show of the mechanism besides.
//!
//! Coordinates, points and forces that generated code computes come from its own program, and so does the end of its motion.

use linkwright::{Failure, Shell};

use crate::emitted::Emitted;
use crate::instant::Instant;
use crate::supplied::{InputSignals, Modes, Pose};
use crate::trajectory::{End, Movable};
use crate::view::View;

/// Addition to the reason of a failure of the fuller program alone.
const UNAFFECTED: &str = "; generated code, which computes its outputs alone, goes on";

/// Mechanism in motion, with everything that reports show.
#[derive(Clone)]
pub struct Moved<V: View> {
    fuller: Shell<V>,
    /// `None` if the fuller program is the only one.
    emitted: Option<EmittedMotion<V>>,
    /// Program that failed first; `None` if none has failed.
    first_failing: Option<Program>,
}

/// Mechanism that cannot be assembled.
#[derive(Clone, Debug)]
pub struct Unmoved {
    /// Failure of the assembly.
    pub failure: Failure,
    /// Reason in words.
    pub reason: String,
}

/// Program that is written out, in motion.
#[derive(Clone)]
struct EmittedMotion<V: View> {
    emitted: Emitted<V>,
    shell: Shell<V>,
    /// Last instant of the fuller program with the values of the emitted one.
    joined: Instant,
}

/// One of both programs.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Program {
    Emitted,
    Fuller,
}

impl<V: View> Moved<V> {
    /// Assembles the mechanism with its nominal parameters at the time `t` (s), near a pose and in these modes.
    ///
    /// # Errors
    /// The reason that it cannot be assembled.
    pub fn assemble(blocks: V, pose: &Pose, modes: Modes, t: f64) -> Result<Moved<V>, Unmoved> {
        let laws = blocks.input_laws();
        let inputs = laws.at(t);
        let emitted = blocks.emitted().map(|emitted| {
            let modes = modes_of(&emitted.blocks, &blocks, &modes);
            let shell = assembled(emitted.blocks.clone(), pose, modes, t, &inputs);
            (emitted.clone(), shell)
        });
        let fuller = assembled(blocks.clone(), pose, modes, t, &inputs);
        let fuller = fuller.map_err(|failure| {
            let reason = blocks.not_assembled(&failure);
            let reason = match &emitted {
                Some((_, Ok(_))) => format!("{reason}{UNAFFECTED}"),
                _ => reason,
            };
            Unmoved { failure, reason }
        })?;
        let emitted = match emitted {
            None => None,
            Some((emitted, shell)) => {
                let shell = shell.map_err(|failure| Unmoved {
                    reason: emitted.blocks.not_assembled(&failure),
                    failure,
                })?;
                Some(EmittedMotion {
                    joined: emitted.joined(fuller.frame(), shell.frame()),
                    emitted,
                    shell,
                })
            }
        };
        Ok(Moved {
            fuller,
            emitted,
            first_failing: None,
        })
    }

    /// Fuller program, which computes the subsystems of all blocks.
    pub fn fuller(&self) -> &Shell<V> {
        &self.fuller
    }

    /// Explains the end of this motion.
    pub fn ended(&self, end: &End) -> String {
        let of_fuller = || self.fuller.blocks().ended(&end.failure, &end.last);
        match (&self.emitted, self.first_failing) {
            (Some(emitted), Some(Program::Emitted)) => {
                let EmittedMotion { shell, .. } = emitted;
                shell.blocks().ended(&end.failure, shell.frame())
            }
            (Some(_), _) => format!("{}{UNAFFECTED}", of_fuller()),
            (None, _) => of_fuller(),
        }
    }

    fn failed(&mut self, program: Program, failure: Failure) -> Failure {
        self.first_failing.get_or_insert(program);
        failure
    }
}

impl<V: View> Movable for Moved<V> {
    fn instant(&self) -> &Instant {
        let emitted = self.emitted.as_ref();
        emitted.map_or(self.fuller.frame(), |it| &it.joined)
    }

    fn move_to(&mut self, t: f64, inputs: &InputSignals) -> Result<(), Failure> {
        let Some(emitted) = &self.emitted else {
            return self.fuller.move_to(t, inputs);
        };
        // Both programs stay where they are if one of them fails.
        let mut next = emitted.shell.clone();
        if let Err(failure) = next.advance(t, inputs) {
            return Err(self.failed(Program::Emitted, failure));
        }
        if let Err(failure) = self.fuller.advance(t, inputs) {
            return Err(self.failed(Program::Fuller, failure));
        }
        if let Some(emitted) = &mut self.emitted {
            emitted.joined = emitted.emitted.joined(self.fuller.frame(), next.frame());
            emitted.shell = next;
        }
        Ok(())
    }
}

/// Returns the modes of emitted blocks among those of fuller ones.
fn modes_of<V: View>(emitted: &V, fuller: &V, all: &Modes) -> Modes {
    let names = fuller.mode_names();
    let mut modes = emitted.drawn_branches();
    for mode in emitted.mode_names() {
        let mut names = names.iter();
        let of_fuller = names.find(|it| it.name == mode.name && it.is_closed == mode.is_closed);
        match of_fuller {
            Some(of_fuller) if mode.is_closed => {
                modes.closed[mode.place] = all.closed[of_fuller.place];
            }
            Some(of_fuller) => modes.iterated[mode.place] = all.iterated[of_fuller.place],
            None => {}
        }
    }
    modes
}

/// Assembles blocks with their nominal parameters.
fn assembled<V: View>(
    blocks: V,
    pose: &Pose,
    modes: Modes,
    t: f64,
    inputs: &InputSignals,
) -> Result<Shell<V>, Failure> {
    let parameters = blocks.nominal_parameters();
    let settings = Default::default();
    Shell::assemble(blocks, &parameters, pose, modes, t, inputs, settings)
}
