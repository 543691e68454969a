//! *Instructions on registers* → *what the registers hold afterwards*.
//!
//! [`Code`] is what a [`Recorder`](super::Recorder) has written down; it is independent of the graph of the expressions.

use std::ops::Range;
use std::sync::Arc;

use linkwright_math::double;

use super::number::float_power;
use super::rational::Rational;
use super::spline::Spline;

/// A place that holds one number. Every register is written by at most one instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Register(pub(super) u32);

impl Register {
    /// Its place among all registers.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// Instructions in the order in which they run, and the constants among their registers.
#[derive(Clone, Debug, Default)]
pub struct Code {
    pub(super) instructions: Vec<Instruction>,
    /// What every register holds at first: constants, and zero where something is written.
    pub(super) initial: Vec<f64>,
    pub(super) exponents: Vec<Rational>,
    pub(super) splines: Vec<Arc<Spline>>,
}

/// target = what the name says of its operands.
#[derive(Clone, Copy, Debug)]
pub(super) enum Instruction {
    Add(Register, [Register; 2]),
    Subtract(Register, [Register; 2]),
    Multiply(Register, [Register; 2]),
    Divide(Register, [Register; 2]),
    SquareRoot(Register, Register),
    Magnitude(Register, Register),
    /// By the number of the exponent.
    Power(Register, Register, u32),
    Sine(Register, Register),
    Cosine(Register, Register),
    SineCosine([Register; 2], Register),
    Arctangent(Register, [Register; 2]),
    Exponential(Register, Register),
    Logarithm(Register, Register),
    Floor(Register, Register),
    /// The second operand where the first one is negative, or else the third.
    Choose(Register, [Register; 3]),
    /// A derivative of a spline by its order.
    Spline(Register, Register, u32, u8),
}

impl Code {
    /// All registers as they are before the first instruction.
    pub fn registers(&self) -> &[f64] {
        &self.initial
    }

    /// How many instructions there are.
    pub fn length(&self) -> usize {
        self.instructions.len()
    }

    /// Runs instructions, whose operands must be there.
    ///
    /// # Panics
    /// Where there are not so many instructions, or fewer registers than those of [`Code::registers`].
    #[inline]
    pub fn run(&self, range: Range<usize>, registers: &mut [f64]) {
        for &instruction in &self.instructions[range] {
            self.execute(instruction, registers);
        }
    }

    #[inline]
    fn execute(&self, instruction: Instruction, registers: &mut [f64]) {
        let of = |register: Register| registers[register.index()];
        let (target, value) = match instruction {
            Instruction::Add(target, [a, b]) => (target, of(a) + of(b)),
            Instruction::Subtract(target, [a, b]) => (target, of(a) - of(b)),
            Instruction::Multiply(target, [a, b]) => (target, of(a) * of(b)),
            Instruction::Divide(target, [a, b]) => (target, of(a) / of(b)),
            Instruction::SquareRoot(target, a) => (target, of(a).sqrt()),
            Instruction::Magnitude(target, a) => (target, of(a).abs()),
            Instruction::Power(target, base, exponent) => (
                target,
                float_power(of(base), self.exponents[exponent as usize]),
            ),
            Instruction::Sine(target, angle) => (target, double::sin(of(angle))),
            Instruction::Cosine(target, angle) => (target, double::cos(of(angle))),
            Instruction::SineCosine([sine, cosine], angle) => {
                let (s, c) = double::sin_cos(of(angle));
                registers[sine.index()] = s;
                (cosine, c)
            }
            Instruction::Arctangent(target, [y, x]) => (target, double::atan2(of(y), of(x))),
            Instruction::Exponential(target, a) => (target, double::exp(of(a))),
            Instruction::Logarithm(target, a) => (target, double::ln(of(a))),
            Instruction::Floor(target, a) => (target, of(a).floor()),
            Instruction::Choose(target, [condition, below, otherwise]) => {
                let chosen = if of(condition) < 0.0 {
                    below
                } else {
                    otherwise
                };
                (target, of(chosen))
            }
            Instruction::Spline(target, argument, spline, order) => {
                let values = self.splines[spline as usize].at(of(argument));
                (target, values[usize::from(order)])
            }
        };
        registers[target.index()] = value;
    }
}
