//! Straight-line code: instructions on registers.
//!
//! [`Code`] is what an [`Assembler`](super::Assembler) has written down; it is independent of the graph of the
//! expressions.

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
    /// Initial contents of all registers: constants, and zero for registers that instructions write.
    pub(super) initial: Vec<f64>,
    pub(super) exponents: Vec<Rational>,
    pub(super) splines: Vec<Arc<Spline>>,
}

/// Computation and the register of its result.
#[derive(Clone, Copy, Debug)]
pub(super) struct Instruction {
    pub target: Register,
    pub computation: Computation,
}

/// Computation of one instruction from registers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Computation {
    /// The sum.
    Add([Register; 2]),
    /// The first less the second.
    Subtract([Register; 2]),
    /// The product.
    Multiply([Register; 2]),
    /// The first over the second.
    Divide([Register; 2]),
    /// The power of the first with the second as a real exponent.
    Power([Register; 2]),
    /// The power with the exponent of this number in the code.
    RationalPower(Register, u32),
    /// The square root.
    SquareRoot(Register),
    /// The absolute value.
    Magnitude(Register),
    /// The sine.
    Sine(Register),
    /// The cosine.
    Cosine(Register),
    /// The sine of an angle; the cosine goes to a register of its own.
    SineCosine {
        /// Register of the cosine.
        cosine: Register,
        /// The angle.
        angle: Register,
    },
    /// The angle of a vector: ordinate and abscissa.
    Arctangent([Register; 2]),
    /// The exponential function.
    Exponential(Register),
    /// The natural logarithm.
    Logarithm(Register),
    /// The largest whole number that is not greater.
    Floor(Register),
    /// −1 if the first is less than the second, otherwise 0.
    Less([Register; 2]),
    /// The second operand if the first one is negative, otherwise the third.
    Choose([Register; 3]),
    /// A derivative, by its order, of the spline of this number in the code.
    Spline(Register, u32, u8),
}

impl Code {
    /// All registers as they are before the first instruction.
    pub fn registers(&self) -> &[f64] {
        &self.initial
    }

    /// Number of instructions.
    pub fn length(&self) -> usize {
        self.instructions.len()
    }

    /// Runs instructions, whose operands must have been computed.
    ///
    /// # Panics
    /// Panics if the range exceeds the instructions, or if `registers` is shorter than [`Code::registers`].
    #[inline]
    pub fn run(&self, range: Range<usize>, registers: &mut [f64]) {
        for &instruction in &self.instructions[range] {
            self.execute(instruction, registers);
        }
    }

    #[inline]
    fn execute(&self, instruction: Instruction, registers: &mut [f64]) {
        let of = |register: Register| registers[register.index()];
        let value = match instruction.computation {
            Computation::Add([a, b]) => of(a) + of(b),
            Computation::Subtract([a, b]) => of(a) - of(b),
            Computation::Multiply([a, b]) => of(a) * of(b),
            Computation::Divide([a, b]) => of(a) / of(b),
            Computation::Power([base, exponent]) => double::powf(of(base), of(exponent)),
            Computation::RationalPower(base, exponent) => {
                float_power(of(base), self.exponents[exponent as usize])
            }
            Computation::SquareRoot(a) => of(a).sqrt(),
            Computation::Magnitude(a) => of(a).abs(),
            Computation::Sine(angle) => double::sin(of(angle)),
            Computation::Cosine(angle) => double::cos(of(angle)),
            Computation::SineCosine { cosine, angle } => {
                let (s, c) = double::sin_cos(of(angle));
                registers[cosine.index()] = c;
                s
            }
            Computation::Arctangent([y, x]) => double::atan2(of(y), of(x)),
            Computation::Exponential(a) => double::exp(of(a)),
            Computation::Logarithm(a) => double::ln(of(a)),
            Computation::Floor(a) => of(a).floor(),
            Computation::Less([a, b]) => {
                if of(a) < of(b) {
                    -1.0
                } else {
                    0.0
                }
            }
            Computation::Choose([condition, below, otherwise]) => {
                if of(condition) < 0.0 {
                    of(below)
                } else {
                    of(otherwise)
                }
            }
            Computation::Spline(argument, spline, order) => {
                self.splines[spline as usize].at(of(argument))[usize::from(order)]
            }
        };
        registers[instruction.target.index()] = value;
    }
}
