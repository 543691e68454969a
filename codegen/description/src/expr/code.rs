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
    /// The product of the first two, plus the third.
    MultiplyAdd([Register; 3]),
    /// The product of the first two less the third.
    MultiplySubtract([Register; 3]),
    /// The first less the product of the others.
    SubtractMultiply([Register; 3]),
    /// The product of the first two, plus that of the last two.
    AddProducts([Register; 4]),
    /// The product of the first two less that of the last two.
    SubtractProducts([Register; 4]),
    /// The second operand if the first one is negative, otherwise the third.
    Choose([Register; 3]),
    /// A derivative, by its order, of the spline of this number in the code.
    Spline(Register, u32, u8),
}

/// Number of lanes: two of the widest vectors, so that one of them is computed while the other waits for its operands.
pub const LANES: usize = 16;

/// Contents of a register in sixteen lanes: of sixteen mechanisms that are solved in step.
pub type Lanes = linkwright_math::Lanes<f64, LANES>;

/// Contents of a register, one number for each lane.
trait Numbers<const N: usize>: Copy {
    fn numbers(self) -> [f64; N];
    fn of(numbers: [f64; N]) -> Self;
    fn sines_cosines(angles: [f64; N]) -> [[f64; N]; 2];
    fn arctangents(y: [f64; N], x: [f64; N]) -> [f64; N];
}

impl Numbers<1> for f64 {
    #[inline(always)]
    fn numbers(self) -> [f64; 1] {
        [self]
    }

    #[inline(always)]
    fn of([number]: [f64; 1]) -> f64 {
        number
    }

    #[inline(always)]
    fn sines_cosines([angle]: [f64; 1]) -> [[f64; 1]; 2] {
        let (sine, cosine) = double::sin_cos(angle);
        [[sine], [cosine]]
    }

    #[inline(always)]
    fn arctangents([y]: [f64; 1], [x]: [f64; 1]) -> [f64; 1] {
        [double::atan2(y, x)]
    }
}

impl Numbers<LANES> for Lanes {
    #[inline(always)]
    fn numbers(self) -> [f64; LANES] {
        self.0
    }

    #[inline(always)]
    fn of(numbers: [f64; LANES]) -> Lanes {
        linkwright_math::Lanes(numbers)
    }

    #[inline(always)]
    fn sines_cosines(angles: [f64; LANES]) -> [[f64; LANES]; 2] {
        double::sines_cosines(angles)
    }

    #[inline(always)]
    fn arctangents(y: [f64; LANES], x: [f64; LANES]) -> [f64; LANES] {
        double::arctangents(y, x)
    }
}

impl Code {
    /// All registers as they are before the first instruction.
    pub fn registers(&self) -> &[f64] {
        &self.initial
    }

    /// All registers in sixteen lanes, as they are before the first instruction.
    pub fn lanes(&self) -> Vec<Lanes> {
        self.initial.iter().map(|&it| Lanes::splat(it)).collect()
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

    /// Runs instructions in sixteen lanes at once, each with the bits of [`Code::run`].
    ///
    /// It is inlined: code compiled for wider vectors has to contain it.
    ///
    /// # Panics
    /// Panics as [`Code::run`] does.
    #[inline(always)]
    pub fn run_lanes(&self, range: Range<usize>, registers: &mut [Lanes]) {
        for &instruction in &self.instructions[range] {
            self.execute(instruction, registers);
        }
    }

    #[inline(always)]
    fn execute<const N: usize, R: Numbers<N>>(
        &self,
        instruction: Instruction,
        registers: &mut [R],
    ) {
        let of = |register: Register| registers[register.index()].numbers();
        let target = instruction.target.index();
        // Each arm writes its result, which then stays in a vector register.
        match instruction.computation {
            Computation::Add([a, b]) => registers[target] = both(of(a), of(b), |a, b| a + b),
            Computation::Subtract([a, b]) => registers[target] = both(of(a), of(b), |a, b| a - b),
            Computation::Multiply([a, b]) => registers[target] = both(of(a), of(b), |a, b| a * b),
            Computation::Divide([a, b]) => registers[target] = both(of(a), of(b), |a, b| a / b),
            // Products are rounded before they are added.
            Computation::MultiplyAdd([a, b, c]) => {
                registers[target] = both(products(of(a), of(b)), of(c), |product, c| product + c);
            }
            Computation::MultiplySubtract([a, b, c]) => {
                registers[target] = both(products(of(a), of(b)), of(c), |product, c| product - c);
            }
            Computation::SubtractMultiply([a, b, c]) => {
                registers[target] = both(of(a), products(of(b), of(c)), |a, product| a - product);
            }
            Computation::AddProducts([a, b, c, d]) => {
                let [first, second] = [products(of(a), of(b)), products(of(c), of(d))];
                registers[target] = both(first, second, |first, second| first + second);
            }
            Computation::SubtractProducts([a, b, c, d]) => {
                let [first, second] = [products(of(a), of(b)), products(of(c), of(d))];
                registers[target] = both(first, second, |first, second| first - second);
            }
            Computation::Power([base, exponent]) => {
                registers[target] = both(of(base), of(exponent), double::powf);
            }
            Computation::RationalPower(base, exponent) => {
                let exponent = self.exponents[exponent as usize];
                registers[target] = each(of(base), |base| float_power(base, exponent));
            }
            Computation::SquareRoot(a) => registers[target] = each(of(a), f64::sqrt),
            Computation::Magnitude(a) => registers[target] = each(of(a), f64::abs),
            Computation::Sine(angle) => {
                let [sines, _] = R::sines_cosines(of(angle));
                registers[target] = R::of(sines);
            }
            Computation::Cosine(angle) => {
                let [_, cosines] = R::sines_cosines(of(angle));
                registers[target] = R::of(cosines);
            }
            Computation::SineCosine { cosine, angle } => {
                let [sines, cosines] = R::sines_cosines(of(angle));
                registers[cosine.index()] = R::of(cosines);
                registers[target] = R::of(sines);
            }
            Computation::Arctangent([y, x]) => {
                registers[target] = R::of(R::arctangents(of(y), of(x)));
            }
            Computation::Exponential(a) => registers[target] = each(of(a), double::exp),
            Computation::Logarithm(a) => registers[target] = each(of(a), double::ln),
            Computation::Floor(a) => registers[target] = each(of(a), f64::floor),
            Computation::Less([a, b]) => {
                let less = |a, b| if a < b { -1.0 } else { 0.0 };
                registers[target] = both(of(a), of(b), less);
            }
            Computation::Choose([condition, below, otherwise]) => {
                let [condition, below, otherwise] = [condition, below, otherwise].map(of);
                registers[target] =
                    R::of(std::array::from_fn(|lane| match condition[lane] < 0.0 {
                        true => below[lane],
                        false => otherwise[lane],
                    }));
            }
            Computation::Spline(argument, spline, order) => {
                let spline = &self.splines[spline as usize];
                let order = usize::from(order);
                registers[target] = each(of(argument), |argument| spline.at(argument)[order]);
            }
        }
    }
}

/// Applies a function in each lane.
#[inline(always)]
fn each<const N: usize, R: Numbers<N>>(numbers: [f64; N], function: impl Fn(f64) -> f64) -> R {
    R::of(numbers.map(function))
}

/// Applies a function of two numbers in each lane.
#[inline(always)]
fn both<const N: usize, R: Numbers<N>>(
    first: [f64; N],
    second: [f64; N],
    function: impl Fn(f64, f64) -> f64,
) -> R {
    R::of(std::array::from_fn(|lane| {
        function(first[lane], second[lane])
    }))
}

/// Multiplies in each lane.
#[inline(always)]
fn products<const N: usize>(first: [f64; N], second: [f64; N]) -> [f64; N] {
    std::array::from_fn(|lane| first[lane] * second[lane])
}
