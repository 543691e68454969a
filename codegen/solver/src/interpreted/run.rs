//! Runs the operations of a block on registers.
//!
//! A Newton-Raphson operation is solved by the runtime, and its factorization solves the rates.

use linkwright::generated::{Measure, Start, block, kinematics};
use linkwright::{Branch, Failure, Frame};

use super::Interpreted;
use super::compiled::Compiled;
use crate::newton::Newton;
use crate::operation::{Operation, run};
use crate::supplied::Modes;

impl Interpreted {
    /// Solves one block.
    #[inline]
    pub(super) fn run_block(
        &self,
        index: usize,
        registers: &mut [f64],
        t: f64,
        start: Start,
        modes: &mut Modes,
        settings: &linkwright::Settings,
    ) -> Result<(), Failure> {
        let Compiled { code, blocks, .. } = &*self.compiled;
        let block = &blocks[index];
        let (code, operations) = match &self.limited {
            Some(limited) => (&limited.reduced.code, &limited.reduced.operations[index]),
            None => (code, &block.operations),
        };
        let number = u16::try_from(index).unwrap_or(u16::MAX);
        let mut factorization = None;
        for operation in operations {
            match (operation, &block.newton) {
                (Operation::Newton, Some(newton)) => {
                    let mode = &mut modes.iterated[block.iterated];
                    let measure = self
                        .iterate(newton, registers, t, start, mode, settings)
                        .map_err(|failure| failure.in_block(number))?;
                    if let Some(both) = newton.measure {
                        registers[both[0].index()] = measure.determinant;
                        registers[both[1].index()] = measure.reciprocal_condition;
                    }
                }
                (Operation::Factorize, Some(newton)) => {
                    let tears = newton.pose(registers);
                    let equations = newton.at(code, registers, &|| ());
                    let factors = kinematics::factorize(&equations, &tears, t, settings);
                    factorization = Some(factors.map_err(|failure| failure.in_block(number))?);
                }
                (
                    Operation::Solve {
                        targets,
                        right_hand_side,
                    },
                    _,
                ) => {
                    let rows = right_hand_side.iter().map(|it| registers[it.index()]);
                    let mut solution =
                        nalgebra::DVector::from_iterator(right_hand_side.len(), rows);
                    if let Some(factorization) = &factorization {
                        factorization.solve(&mut solution);
                    }
                    for (target, value) in targets.iter().zip(solution.iter()) {
                        if let Some(target) = target {
                            registers[target.index()] = *value;
                        }
                    }
                }
                _ => run(operation, code, registers, t, number)?,
            }
        }
        Ok(())
    }

    /// Solves the equations of a block by Newton-Raphson, and measures their distance from singular.
    fn iterate(
        &self,
        newton: &Newton,
        registers: &mut [f64],
        t: f64,
        start: Start,
        mode: &mut Option<Branch>,
        settings: &linkwright::Settings,
    ) -> Result<Measure<f64>, Failure> {
        let last = newton.last_frame(registers, self.compiled.last_time(registers));
        let count = || self.residuals.set(self.residuals.get() + 1);
        self.solves.set(self.solves.get() + 1);
        let equations = newton.at(&self.compiled.code, registers, &count);
        if let Some(tearing) = &newton.tearing {
            tearing.solve(&equations, &last, start, mode, t, settings)?;
            return Ok(Measure::sine(0.0));
        }
        let mut measure = Measure::sine(0.0);
        let frame: Frame<f64, nalgebra::Dyn> = match newton.measure {
            None => block::solve(&equations, &last, start, mode, t, settings)?,
            Some(_) => {
                block::solve_measured(&equations, &last, start, mode, t, settings, &mut measure)?
            }
        };
        equations.set(&frame);
        Ok(measure)
    }
}
