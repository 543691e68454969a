//! Reduces code to what is read of it: leaves out instructions, and joins products with the sums that alone read them.
//!
//! Results that are read keep their bits: a joined instruction rounds the products as they were rounded before.

use std::ops::Range;

use super::code::{Code, Computation, Instruction, Register};

/// Readers of registers, and the instructions whose results are read.
#[derive(Clone, Debug)]
pub struct Reads {
    /// Number of readers of each register.
    readers: Vec<u32>,
    /// True for each instruction whose result is read.
    is_live: Vec<bool>,
}

impl Reads {
    /// Begins without readers.
    pub fn new(code: &Code) -> Reads {
        Reads {
            readers: vec![0; code.initial.len()],
            is_live: vec![false; code.instructions.len()],
        }
    }

    /// Adds a reader of registers.
    pub fn add(&mut self, registers: impl IntoIterator<Item = Register>) {
        for register in registers {
            self.readers[register.index()] += 1;
        }
    }

    /// True if something reads a register.
    pub fn has(&self, register: Register) -> bool {
        self.readers[register.index()] > 0
    }

    /// Adds the instructions of a range whose results are read, as readers of their operands. Later readers come first: ranges are added from
    /// the last one on.
    pub fn add_range(&mut self, code: &Code, range: Range<usize>) {
        for place in range.rev() {
            let Instruction {
                target,
                computation,
            } = code.instructions[place];
            let also = match computation {
                Computation::SineCosine { cosine, .. } => self.has(cosine),
                _ => false,
            };
            if self.has(target) || also {
                self.is_live[place] = true;
                each_operand(&computation, |operand| self.add([operand]));
            }
        }
    }
}

impl Code {
    /// Returns the instructions whose results are read, joined where a sum alone reads a product; and the new index of each instruction,
    /// followed by their number.
    pub fn reduced(&self, reads: &Reads) -> (Code, Vec<usize>) {
        let mut products: Vec<Option<[Register; 2]>> = vec![None; self.initial.len()];
        let mut definitions = vec![0; self.initial.len()];
        let mut is_kept = reads.is_live.clone();
        let mut instructions = self.instructions.clone();
        for (place, instruction) in instructions.iter_mut().enumerate() {
            if !reads.is_live[place] {
                continue;
            }
            let target = instruction.target.index();
            if let Computation::Multiply(factors) = instruction.computation
                && reads.readers[target] == 1
            {
                products[target] = Some(factors);
                definitions[target] = place;
            }
            let (Computation::Add(both) | Computation::Subtract(both)) = instruction.computation
            else {
                continue;
            };
            let is_sum = matches!(instruction.computation, Computation::Add(_));
            let [first, second] = both.map(|it| products[it.index()]);
            let joined = match (first, second) {
                (Some([a, b]), Some([c, d])) if is_sum => Computation::AddProducts([a, b, c, d]),
                (Some([a, b]), Some([c, d])) => Computation::SubtractProducts([a, b, c, d]),
                (Some([a, b]), None) if is_sum => Computation::MultiplyAdd([a, b, both[1]]),
                (Some([a, b]), None) => Computation::MultiplySubtract([a, b, both[1]]),
                (None, Some([a, b])) if is_sum => Computation::MultiplyAdd([a, b, both[0]]),
                (None, Some([a, b])) => Computation::SubtractMultiply([both[0], a, b]),
                (None, None) => continue,
            };
            instruction.computation = joined;
            for (operand, product) in both.into_iter().zip([first, second]) {
                if product.is_some() {
                    is_kept[definitions[operand.index()]] = false;
                }
            }
        }
        let mut places = Vec::with_capacity(instructions.len() + 1);
        let mut count = 0;
        for kept in &is_kept {
            places.push(count);
            count += usize::from(*kept);
        }
        places.push(count);
        let kept = instructions.into_iter().zip(is_kept);
        let reduced = Code {
            instructions: kept.filter(|(_, kept)| *kept).map(|(it, _)| it).collect(),
            ..self.clone()
        };
        (reduced, places)
    }
}

/// Calls `visit` with every operand.
fn each_operand(computation: &Computation, mut visit: impl FnMut(Register)) {
    match *computation {
        Computation::Add(both)
        | Computation::Subtract(both)
        | Computation::Multiply(both)
        | Computation::Divide(both)
        | Computation::Power(both)
        | Computation::Arctangent(both)
        | Computation::Less(both) => both.into_iter().for_each(visit),
        Computation::Choose(all)
        | Computation::MultiplyAdd(all)
        | Computation::MultiplySubtract(all)
        | Computation::SubtractMultiply(all) => all.into_iter().for_each(visit),
        Computation::AddProducts(all) | Computation::SubtractProducts(all) => {
            all.into_iter().for_each(visit);
        }
        Computation::RationalPower(operand, _)
        | Computation::SquareRoot(operand)
        | Computation::Magnitude(operand)
        | Computation::Sine(operand)
        | Computation::Cosine(operand)
        | Computation::SineCosine { angle: operand, .. }
        | Computation::Exponential(operand)
        | Computation::Logarithm(operand)
        | Computation::Floor(operand)
        | Computation::Spline(operand, ..) => visit(operand),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expr::{Assembler, Graph};

    /// Bits of some registers after all instructions.
    fn bits(code: &Code, read: &[Register], inputs: &[Register]) -> Vec<u64> {
        let mut registers = code.registers().to_vec();
        for (place, input) in inputs.iter().enumerate() {
            registers[input.index()] = 0.1 + 1.0 / (3.0 + place as f64);
        }
        code.run(0..code.length(), &mut registers);
        read.iter()
            .map(|it| registers[it.index()].to_bits())
            .collect()
    }

    #[test]
    fn results_that_are_read_keep_their_bits() {
        let graph = Graph::new();
        let mut state = 1_u64;
        let mut random = |count: usize| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 33) as usize % count
        };
        let (mut before, mut after) = (0, 0);
        for _ in 0..200 {
            let mut assembler = Assembler::new(&graph);
            let inputs: Vec<Register> = (0..6).map(|_| assembler.register()).collect();
            let mut known = inputs.clone();
            for _ in 0..40 {
                let both = [known[random(known.len())], known[random(known.len())]];
                known.push(assembler.write(match random(6) {
                    0 | 1 => Computation::Add(both),
                    2 => Computation::Subtract(both),
                    3 | 4 => Computation::Multiply(both),
                    _ => Computation::Divide(both),
                }));
            }
            let code = assembler.finish();
            let read: Vec<Register> = (0..4).map(|_| known[random(known.len())]).collect();
            let mut reads = Reads::new(&code);
            reads.add(read.iter().copied());
            reads.add_range(&code, 0..code.length());
            let (reduced, places) = code.reduced(&reads);
            assert_eq!(places.last(), Some(&reduced.length()));
            assert_eq!(bits(&code, &read, &inputs), bits(&reduced, &read, &inputs));
            before += code.length();
            after += reduced.length();
        }
        assert!(2 * after < before, "{before} {after}");
    }
}
