//! *Expressions of a graph* → *the code that computes them*.
//!
//! A [`Recorder`] writes down what computes expressions, each node once and operands first; whoever records says in which register a
//! symbol is found. It knows neither names nor what is computed.

use std::collections::{HashMap, HashSet};

use super::code::{Code, Instruction, Register};
use super::graph::Graph;
use super::hashing::BuildExprHasher;
use super::node::{ExprId, Factor, Node, SymbolId, Term};
use super::rational::Rational;
use super::spline::SplineId;

/// Writes the code of expressions.
#[derive(Clone, Debug)]
pub struct Recorder<'a> {
    graph: &'a Graph,
    code: Code,
    bound: HashMap<SymbolId, Register>,
    recorded: HashMap<ExprId, Register, BuildExprHasher>,
    /// What was recorded, in order, so that it can be forgotten.
    journal: Vec<ExprId>,
    /// Which of the code's splines are which of the graph's.
    splines: HashMap<SplineId, u32>,
    /// By the bits of a constant.
    constants: HashMap<u64, Register>,
    unbound: Vec<(SymbolId, Register)>,
}

impl<'a> Recorder<'a> {
    /// Nothing is recorded, and no symbol bound.
    pub fn new(graph: &'a Graph) -> Recorder<'a> {
        Recorder {
            graph,
            code: Code::default(),
            bound: HashMap::new(),
            recorded: HashMap::default(),
            journal: Vec::new(),
            splines: HashMap::new(),
            constants: HashMap::new(),
            unbound: Vec::new(),
        }
    }

    /// A register that holds zero until something is written to it.
    ///
    /// # Panics
    /// Where registers can no longer be numbered with 32 bits.
    pub fn register(&mut self) -> Register {
        let place = u32::try_from(self.code.initial.len());
        self.code.initial.push(0.0);
        Register(place.expect("registers are numbered with 32 bits"))
    }

    /// A register that holds a constant.
    pub fn constant(&mut self, value: f64) -> Register {
        if let Some(&register) = self.constants.get(&value.to_bits()) {
            return register;
        }
        let register = self.register();
        self.code.initial[register.index()] = value;
        self.constants.insert(value.to_bits(), register);
        register
    }

    /// States where a symbol is found from now on. What was recorded of another value of it is to be forgotten first.
    pub fn bind(&mut self, symbol: SymbolId, register: Register) {
        self.bound.insert(symbol, register);
    }

    /// Where a symbol is found; one that is not bound gets a register that somebody else has to write.
    pub fn symbol(&mut self, symbol: SymbolId) -> Register {
        if let Some(&register) = self.bound.get(&symbol) {
            return register;
        }
        let register = self.register();
        self.bound.insert(symbol, register);
        self.unbound.push((symbol, register));
        register
    }

    /// The symbols that nobody has bound, in the order in which they were met.
    pub fn unbound(&self) -> &[(SymbolId, Register)] {
        &self.unbound
    }

    /// The number of the next instruction.
    pub fn position(&self) -> usize {
        self.code.length()
    }

    /// How much is recorded; [`Recorder::forget`] takes it back to here.
    pub fn mark(&self) -> usize {
        self.journal.len()
    }

    /// Forgets which expressions were recorded since a mark: their registers are written only where that code runs.
    pub fn forget(&mut self, mark: usize) {
        for expr in self.journal.drain(mark..) {
            self.recorded.remove(&expr);
        }
    }

    /// The code that was recorded.
    pub fn finish(self) -> Code {
        self.code
    }

    /// Records the sine and the cosine of an angle.
    pub fn sine_cosine(&mut self, angle: ExprId) -> [Register; 2] {
        let angle = self.value(angle);
        let both = [self.register(), self.register()];
        self.code
            .instructions
            .push(Instruction::SineCosine(both, angle));
        both
    }

    /// Records a derivative of a spline at a place, by its order.
    pub fn lookup(&mut self, spline: SplineId, order: u8, argument: ExprId) -> Register {
        let argument = self.value(argument);
        let spline = self.spline(spline);
        self.write(|it| Instruction::Spline(it, argument, spline, order))
    }

    /// The number of a spline in the code.
    fn spline(&mut self, spline: SplineId) -> u32 {
        let splines = &mut self.code.splines;
        *self.splines.entry(spline).or_insert_with(|| {
            splines.push(self.graph.splines[spline.index()].clone());
            splines.len() as u32 - 1
        })
    }

    /// Records the sum of the absolute values of an expression's terms, by which a residual is scaled: of what is no sum its absolute
    /// value.
    pub fn magnitude(&mut self, expr: ExprId) -> Register {
        let terms = match self.graph.node(expr) {
            Node::Sum(terms) => terms
                .iter()
                .map(|it| (it.coefficient.to_f64().abs(), it.expr))
                .collect(),
            _ => vec![(1.0, expr)],
        };
        let mut sum = None;
        for (coefficient, term) in terms {
            let value = self.value(term);
            let size = self.write(|it| Instruction::Magnitude(it, value));
            let scaled = self.scaled(coefficient, size);
            sum = Some(match sum {
                Some(sum) => self.write(|it| Instruction::Add(it, [sum, scaled])),
                None => scaled,
            });
        }
        sum.unwrap_or_else(|| self.constant(0.0))
    }

    /// Records an expression as far as it is not recorded yet.
    pub fn value(&mut self, expr: ExprId) -> Register {
        if let Some(&register) = self.recorded.get(&expr) {
            return register;
        }
        let order = self.missing(expr);
        // The sine and the cosine of one angle are computed together.
        let mut waves: HashMap<ExprId, [Option<ExprId>; 2], BuildExprHasher> = HashMap::default();
        for &expr in &order {
            match *self.graph.node(expr) {
                Node::Sin(angle) => waves.entry(angle).or_default()[0] = Some(expr),
                Node::Cos(angle) => waves.entry(angle).or_default()[1] = Some(expr),
                _ => {}
            }
        }
        for &expr in &order {
            if self.recorded.contains_key(&expr) {
                continue;
            }
            match *self.graph.node(expr) {
                Node::Sin(angle) | Node::Cos(angle)
                    if waves[&angle].iter().all(Option::is_some) =>
                {
                    let both = self.sine_cosine(angle);
                    for (wave, register) in waves[&angle].into_iter().flatten().zip(both) {
                        self.note(wave, register);
                    }
                }
                _ => {
                    let register = self.node(expr);
                    self.note(expr, register);
                }
            }
        }
        self.recorded[&expr]
    }

    fn note(&mut self, expr: ExprId, register: Register) {
        self.recorded.insert(expr, register);
        self.journal.push(expr);
    }

    /// What an expression needs that is not recorded, operands first: operands have smaller ids, so the order of ids will do.
    fn missing(&self, expr: ExprId) -> Vec<ExprId> {
        let mut seen: HashSet<ExprId, BuildExprHasher> = HashSet::default();
        let mut order = Vec::new();
        let mut open = vec![expr];
        while let Some(expr) = open.pop() {
            if self.recorded.contains_key(&expr) || !seen.insert(expr) {
                continue;
            }
            order.push(expr);
            open.extend(self.graph.operands(expr));
        }
        order.sort_unstable();
        order
    }

    fn write(&mut self, instruction: impl FnOnce(Register) -> Instruction) -> Register {
        let target = self.register();
        self.code.instructions.push(instruction(target));
        target
    }

    /// A node whose operands are recorded.
    fn node(&mut self, expr: ExprId) -> Register {
        let graph = self.graph;
        let of = |expr: &ExprId| self.recorded[expr];
        match graph.node(expr) {
            Node::Number(value) => self.constant(value.to_f64()),
            Node::Pi => self.constant(std::f64::consts::PI),
            Node::Symbol(symbol) => self.symbol(*symbol),
            Node::Sum(terms) => self.sum(terms),
            Node::Product(factors) => self.product(factors),
            Node::Sin(angle) => {
                let angle = of(angle);
                self.write(|it| Instruction::Sine(it, angle))
            }
            Node::Cos(angle) => {
                let angle = of(angle);
                self.write(|it| Instruction::Cosine(it, angle))
            }
            Node::Atan2(y, x) => {
                let both = [of(y), of(x)];
                self.write(|it| Instruction::Arctangent(it, both))
            }
            Node::Exp(exponent) => {
                let exponent = of(exponent);
                self.write(|it| Instruction::Exponential(it, exponent))
            }
            Node::Ln(argument) => {
                let argument = of(argument);
                self.write(|it| Instruction::Logarithm(it, argument))
            }
            Node::Floor(argument) => {
                let argument = of(argument);
                self.write(|it| Instruction::Floor(it, argument))
            }
            Node::Choose {
                condition,
                below,
                otherwise,
            } => {
                let all = [condition, below, otherwise].map(of);
                self.write(|it| Instruction::Choose(it, all))
            }
            Node::Spline {
                spline,
                order,
                argument,
            } => {
                let argument = of(argument);
                let spline = self.spline(*spline);
                self.write(|it| Instruction::Spline(it, argument, spline, *order))
            }
        }
    }

    fn scaled(&mut self, coefficient: f64, register: Register) -> Register {
        if coefficient == 1.0 {
            return register;
        }
        let factor = self.constant(coefficient);
        self.write(|it| Instruction::Multiply(it, [factor, register]))
    }

    /// From the first term to the last.
    fn sum(&mut self, terms: &[Term]) -> Register {
        let mut sum = None;
        for term in terms {
            let value = self.recorded[&term.expr];
            let coefficient = term.coefficient.to_f64();
            sum = Some(match sum {
                None => self.scaled(coefficient, value),
                Some(sum) if coefficient == -1.0 => {
                    self.write(|it| Instruction::Subtract(it, [sum, value]))
                }
                Some(sum) => {
                    let value = self.scaled(coefficient, value);
                    self.write(|it| Instruction::Add(it, [sum, value]))
                }
            });
        }
        sum.unwrap_or_else(|| self.constant(0.0))
    }

    /// The factors with positive exponents over those with negative ones: one division, and one rounding less per quotient.
    fn product(&mut self, factors: &[Factor]) -> Register {
        let [above, below] = [false, true].map(|is_divisor| {
            let factors = factors
                .iter()
                .filter(|it| it.exponent.is_negative() == is_divisor);
            let mut product = None;
            for factor in factors {
                let value = self.power(self.recorded[&factor.base], factor.exponent.absolute());
                product = Some(match product {
                    Some(product) => self.write(|it| Instruction::Multiply(it, [product, value])),
                    None => value,
                });
            }
            product
        });
        let above = above.unwrap_or_else(|| self.constant(1.0));
        match below {
            Some(below) => self.write(|it| Instruction::Divide(it, [above, below])),
            None => above,
        }
    }

    fn power(&mut self, base: Register, exponent: Rational) -> Register {
        match (exponent.numerator(), exponent.denominator()) {
            (1, 1) => base,
            (2, 1) => self.write(|it| Instruction::Multiply(it, [base, base])),
            (1, 2) => self.write(|it| Instruction::SquareRoot(it, base)),
            (odd, 2) => match Rational::new(odd / 2, 1) {
                Some(whole) => {
                    let whole = self.power(base, whole);
                    let root = self.write(|it| Instruction::SquareRoot(it, base));
                    self.write(|it| Instruction::Multiply(it, [whole, root]))
                }
                None => self.constant(f64::NAN),
            },
            _ => {
                let number = self.code.exponents.len() as u32;
                self.code.exponents.push(exponent);
                self.write(|it| Instruction::Power(it, base, number))
            }
        }
    }
}
