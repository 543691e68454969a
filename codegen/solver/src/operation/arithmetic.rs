//! Compiles arithmetic into instructions, operation by operation in its order.
//!
//! Each computation is written once: the same operation on the same registers has the same bits.

use linkwright_codegen::stages::expr::{Computation, Register, SplineId};
use linkwright_codegen::stages::program::{Arithmetic, Choice, Elementary};

use super::Writer;

impl Writer<'_> {
    /// Writes the computation of a number.
    pub(super) fn arithmetic(&mut self, arithmetic: &Arithmetic) -> Register {
        match arithmetic {
            Arithmetic::Number(value) => self.assembler.constant(*value),
            Arithmetic::Constant(place) => {
                let value = self.program.constants.list()[*place].value;
                self.assembler.constant(value)
            }
            Arithmetic::Variable(symbol) => self.assembler.symbol(*symbol),
            Arithmetic::Sum(terms) => self.sum(terms),
            Arithmetic::Product(factors) => {
                let first = self.arithmetic(&factors[0]);
                self.multiplied(first, &factors[1..])
            }
            Arithmetic::Quotient(both) => {
                let both = both.each_ref().map(|it| self.arithmetic(it));
                self.compute(Computation::Divide(both))
            }
            Arithmetic::Call(function, arguments) => self.call(*function, arguments),
            Arithmetic::Lookup {
                spline,
                order,
                place,
            } => {
                let place = self.arithmetic(place);
                self.lookup(*spline, *order as u8, place)
            }
            Arithmetic::Choice(choice) => self.choice(choice),
        }
    }

    /// From the first term to the last.
    fn sum(&mut self, terms: &[(bool, Arithmetic)]) -> Register {
        let mut sum = None;
        for (is_subtracted, term) in terms {
            let term = match (sum, is_subtracted) {
                (None, true) => self.negated(term),
                _ => self.arithmetic(term),
            };
            sum = Some(match sum {
                None => term,
                Some(sum) if *is_subtracted => self.compute(Computation::Subtract([sum, term])),
                Some(sum) => self.compute(Computation::Add([sum, term])),
            });
        }
        sum.unwrap_or_else(|| self.assembler.constant(0.0))
    }

    /// The opposite: that of the first factor changes the sign of a product and nothing else.
    fn negated(&mut self, arithmetic: &Arithmetic) -> Register {
        match arithmetic {
            Arithmetic::Number(value) => self.assembler.constant(-value),
            Arithmetic::Constant(place) => {
                let value = self.program.constants.list()[*place].value;
                self.assembler.constant(-value)
            }
            Arithmetic::Product(factors) => {
                let first = self.negated(&factors[0]);
                self.multiplied(first, &factors[1..])
            }
            Arithmetic::Quotient(both) => {
                let [numerator, denominator] = &**both;
                let both = [self.negated(numerator), self.arithmetic(denominator)];
                self.compute(Computation::Divide(both))
            }
            _ => {
                let both = [self.assembler.constant(-1.0), self.arithmetic(arithmetic)];
                self.compute(Computation::Multiply(both))
            }
        }
    }

    fn multiplied(&mut self, first: Register, factors: &[Arithmetic]) -> Register {
        factors.iter().fold(first, |product, factor| {
            let factor = self.arithmetic(factor);
            self.compute(Computation::Multiply([product, factor]))
        })
    }

    fn call(&mut self, function: Elementary, arguments: &[Arithmetic]) -> Register {
        let registers: Vec<Register> = arguments.iter().map(|it| self.arithmetic(it)).collect();
        let first = registers[0];
        let both = [first, *registers.last().unwrap_or(&first)];
        self.compute(match function {
            Elementary::Sin => Computation::Sine(first),
            Elementary::Cos => Computation::Cosine(first),
            Elementary::Exp => Computation::Exponential(first),
            Elementary::Ln => Computation::Logarithm(first),
            Elementary::Atan2 => Computation::Arctangent(both),
            Elementary::Floor => Computation::Floor(first),
            Elementary::Abs => Computation::Magnitude(first),
            Elementary::Sqrt => Computation::SquareRoot(first),
            Elementary::Power => Computation::Power(both),
        })
    }

    /// A derivative of a table by its order.
    pub(super) fn lookup(&mut self, spline: SplineId, order: u8, place: Register) -> Register {
        let spline = self.assembler.spline(spline);
        self.compute(Computation::Spline(place, spline, order))
    }

    fn choice(&mut self, choice: &Choice) -> Register {
        let [left, right, below, otherwise] = [
            &choice.left,
            &choice.right,
            &choice.below,
            &choice.otherwise,
        ]
        .map(|it| self.arithmetic(it));
        let condition = self.compute(Computation::Less(match choice.is_less {
            true => [left, right],
            false => [right, left],
        }));
        self.compute(Computation::Choose([condition, below, otherwise]))
    }
}
