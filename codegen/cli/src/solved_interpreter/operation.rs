//! *The actions of a closed form → operations on a value per symbol.*
//!
//! They do what the generated statements do, with the same tests. The module does not know blocks.

use linkwright::closed_form::{angle_near, failed, no_span, spans};
use linkwright::{Failure, FailureKind};
use linkwright_codegen::expr::{ExprId, SymbolId, Tape};
use linkwright_codegen::program::solved::Action;
use linkwright_codegen::system::System;

/// One instruction.
#[derive(Clone, Debug)]
pub(super) enum Operation {
    Let(SymbolId, Tape),
    SineCosine([SymbolId; 2], Tape),
    Angle(SymbolId, Tape),
    /// Fails unless the first value is safely positive beside the second; the others are the distance, and the longest and
    /// the shortest that is reached.
    Reach(Tape),
    /// Fails unless the square of the first value is safely positive beside that of the second.
    Nonzero(Tape),
    Newton,
}

/// Actions as operations; comments and sections do nothing.
pub(super) fn operations<'a>(
    actions: impl Iterator<Item = &'a Action>,
    system: &System,
) -> Vec<Operation> {
    let tape = |roots: &[ExprId]| Tape::new(&system.mechanism.graph, roots);
    actions
        .filter_map(|action| {
            Some(match action {
                Action::Let { target, value } => Operation::Let(*target, tape(&[*value])),
                Action::SineCosine {
                    sine,
                    cosine,
                    angle,
                } => Operation::SineCosine([*sine, *cosine], tape(&[*angle])),
                Action::Angle {
                    unknown,
                    sine,
                    cosine,
                } => Operation::Angle(
                    system.vector_form.unknowns[*unknown].position,
                    tape(&[*sine, *cosine]),
                ),
                Action::Reach { .. } => Operation::Reach(tape(&action.values())),
                Action::Nonzero { value, scale } => Operation::Nonzero(tape(&[*value, *scale])),
                Action::Newton => Operation::Newton,
                // Shared values are evaluated where they occur; nothing is factorized without directions.
                _ => return None,
            })
        })
        .collect()
}

/// Runs one operation of a closed form at `t`.
pub(super) fn run(
    operation: &Operation,
    t: f64,
    symbols: &mut [f64],
    workspace: &mut Vec<f64>,
) -> Result<(), Failure<f64>> {
    let mut evaluated = |tape: &Tape, results: &mut [f64], symbols: &[f64]| {
        tape.evaluate(symbols, workspace, results);
    };
    let refused = |kind| Err(failed(kind, t, 0));
    match operation {
        Operation::Let(target, tape) => {
            let mut value = [0.0];
            evaluated(tape, &mut value, symbols);
            symbols[target.index()] = value[0];
            if !value[0].is_finite() {
                return refused(FailureKind::NotFinite);
            }
        }
        Operation::SineCosine([sine, cosine], tape) => {
            let mut angle = [0.0];
            evaluated(tape, &mut angle, symbols);
            (symbols[sine.index()], symbols[cosine.index()]) = angle[0].sin_cos();
        }
        Operation::Angle(target, tape) => {
            let mut direction = [0.0; 2];
            evaluated(tape, &mut direction, symbols);
            let near = symbols[target.index()];
            symbols[target.index()] = angle_near(direction[0], direction[1], near);
        }
        Operation::Reach(tape) => {
            let mut values = [0.0; 5];
            evaluated(tape, &mut values, symbols);
            let [excess, scale, distance, longest, shortest] = values;
            if !spans(excess, scale) {
                return Err(no_span(distance, longest, shortest, t, 0));
            }
        }
        Operation::Nonzero(tape) => {
            let mut values = [0.0; 2];
            evaluated(tape, &mut values, symbols);
            let [value, scale] = values;
            if !spans(value * value, scale * scale) {
                return refused(FailureKind::Singular {
                    pivot_ratio: value / scale,
                    column: 0,
                });
            }
        }
        // What has no closed form is not solved by evaluation.
        Operation::Newton => return refused(FailureKind::IterationLimit),
    }
    Ok(())
}
