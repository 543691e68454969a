//! Evaluates [`Torn`] equations of a block on registers.

use linkwright::generated::{
    Start, Torn,
    torn::{self, Completion, Evaluation, Found, Memory},
};
use linkwright::{Branch, Equations, Failure, Frame, Settings};
use linkwright_codegen::stages::expr::{Register, SymbolId};
use linkwright_codegen::stages::program::{Block, Statement};
use linkwright_codegen::stages::system::System;
use nalgebra::{DMatrix, DVector, Dyn};

use super::{NewtonEquations, Part};
use crate::operation::Writer;

/// Torn block.
#[derive(Clone, Debug)]
pub(crate) struct Tearing {
    /// Indices of the unknowns that are tearing variables.
    tears: Vec<usize>,
    /// Registers of the tearing variables and the signs, as arguments of the functions.
    given: Vec<Register>,
    signs: Vec<Register>,
    /// Registers of the determinant and the signs, at the last instant and now.
    last: Vec<Register>,
    memory: Vec<Register>,
    /// Registers of the sine and the cosine of each angle.
    directions: Vec<Option<[Register; 2]>>,
    /// Row that scales each residual.
    rows: Vec<usize>,
    terms: Vec<f64>,
    scales: Part,
    evaluate: Part,
    complete: Part,
    sign_values: Part,
}

impl Tearing {
    /// Writes the functions of a block, whose unknowns have these registers: values, rates, accelerations.
    pub fn new(
        block: &Block,
        unknowns: &[Vec<Register>; 3],
        system: &System,
        writer: &mut Writer<'_>,
    ) -> Option<Tearing> {
        let newton = block.newton.as_ref()?;
        let tearing = newton.tearing.as_ref()?;
        let mut statements = block.function.statements.iter();
        let torn = statements.find_map(|statement| match statement {
            Statement::Newton { torn, .. } => torn.as_ref(),
            _ => None,
        })?;
        let signs = tearing.signs.iter().map(|&sign| writer.found(sign));
        let signs = signs.collect();
        let scales = Part::new(&tearing.scales, writer);
        let sign_values = Part::new(&tearing.sign_values, writer);
        // Intermediate values that both functions use stay in their registers.
        let (_, [evaluate, complete]) = writer.apart(|writer| {
            [&tearing.evaluate, &tearing.complete].map(|function| {
                let results = writer.body(function);
                Part {
                    operations: writer.take(),
                    results,
                }
            })
        });
        // The functions include rates.
        for (place, &unknown) in newton.unknowns.iter().enumerate() {
            let form = &system.vector_form.unknowns[unknown];
            for (symbol, registers) in [form.position, form.rate, form.acceleration]
                .into_iter()
                .zip(unknowns)
            {
                writer.assembler.bind(symbol, registers[place]);
            }
        }
        let memory = |registers: &mut dyn FnMut(SymbolId) -> Register| -> Vec<Register> {
            torn.memory
                .iter()
                .map(|&symbol| registers(symbol))
                .collect()
        };
        let last = memory(&mut |symbol| writer.last(symbol));
        let memory = memory(&mut |symbol| writer.found(symbol));
        let directions = torn.directions.iter();
        let directions = directions.map(|pair| pair.map(|pair| pair.map(|it| writer.found(it))));
        Some(Tearing {
            given: tearing
                .tears
                .iter()
                .map(|&tear| unknowns[0][tear])
                .collect(),
            tears: tearing.tears.clone(),
            directions: directions.collect(),
            rows: tearing.rows.clone(),
            terms: tearing.terms.clone(),
            signs,
            last,
            memory,
            scales,
            evaluate,
            complete,
            sign_values,
        })
    }

    /// Solves the block with [`torn::solve`], and writes the solution.
    pub fn solve(
        &self,
        equations: &NewtonEquations<'_>,
        last: &Frame<f64, Dyn>,
        start: Start,
        branch: &mut Option<Branch>,
        t: f64,
        settings: &Settings<f64>,
    ) -> Result<(), Failure> {
        let kept = equations.read(&self.last);
        let memory = Memory {
            determinant: kept[0],
            signs: kept[1..].to_vec(),
        };
        let solution = match self.tears.len() {
            2 => self.solved::<2>(equations, last, &memory, start, branch, t, settings),
            _ => self.solved::<1>(equations, last, &memory, start, branch, t, settings),
        }?;
        equations.set(&solution.frame);
        let Memory { determinant, signs } = solution.memory;
        let memory = [determinant].into_iter().chain(signs);
        equations.write(
            &self.memory,
            &DVector::from_iterator(self.memory.len(), memory),
        );
        for (place, pair) in self.directions.iter().enumerate() {
            if let Some(pair) = pair {
                let values = [solution.sines[place], solution.cosines[place]];
                equations.write(pair, &DVector::from_column_slice(&values));
            }
        }
        Ok(())
    }

    #[expect(clippy::too_many_arguments, reason = "what `torn::solve` takes")]
    fn solved<const K: usize>(
        &self,
        equations: &NewtonEquations<'_>,
        last: &Frame<f64, Dyn>,
        memory: &Memory<f64, Vec<f64>>,
        start: Start,
        branch: &mut Option<Branch>,
        t: f64,
        settings: &Settings<f64>,
    ) -> Result<Found<f64, Dyn, Vec<f64>>, Failure> {
        let torn = TornEquations::<K> {
            tearing: self,
            whole: equations,
        };
        torn::solve(&torn, last, memory, start, branch, t, settings)
    }
}

/// Torn block with its equations, at one instant.
struct TornEquations<'a, 'b, const K: usize> {
    tearing: &'a Tearing,
    whole: &'a NewtonEquations<'b>,
}

impl<const K: usize> Equations<f64, Dyn> for TornEquations<'_, '_, K> {
    fn dimension(&self) -> Dyn {
        self.whole.dimension()
    }

    fn residual(&self, q: &DVector<f64>, t: f64, phi: &mut DVector<f64>) {
        self.whole.residual(q, t, phi);
    }

    fn jacobian(&self, q: &DVector<f64>, t: f64, phi_q: &mut DMatrix<f64>) {
        self.whole.jacobian(q, t, phi_q);
    }

    fn time_derivative(&self, q: &DVector<f64>, t: f64, phi_t: &mut DVector<f64>) {
        self.whole.time_derivative(q, t, phi_t);
    }

    fn gamma(&self, q: &DVector<f64>, qd: &DVector<f64>, t: f64, gamma: &mut DVector<f64>) {
        self.whole.gamma(q, qd, t, gamma);
    }

    fn row_scale(&self, row: usize) -> f64 {
        self.whole.row_scale(row)
    }

    fn coordinate_scale(&self, column: usize) -> f64 {
        self.whole.coordinate_scale(column)
    }

    fn is_angle(&self, column: usize) -> bool {
        self.whole.is_angle(column)
    }
}

impl<const K: usize> TornEquations<'_, '_, K> {
    fn set(&self, tears: &[f64; K], signs: &[f64]) {
        let Tearing {
            given,
            signs: places,
            ..
        } = self.tearing;
        self.whole.write(given, &DVector::from_column_slice(tears));
        self.whole.write(places, &DVector::from_column_slice(signs));
    }
}

impl<const K: usize> Torn<f64, Dyn, K> for TornEquations<'_, '_, K> {
    type Signs = Vec<f64>;
    /// Unit: intermediate values stay in registers.
    type Carried = ();

    fn tears(&self) -> [usize; K] {
        std::array::from_fn(|place| self.tearing.tears[place])
    }

    fn scales(&self, t: f64) -> [f64; K] {
        let factors = self.whole.results(&self.tearing.scales, t);
        std::array::from_fn(|place| {
            let factor = factors.as_ref().map_or(f64::NAN, |factors| factors[place]);
            factor * self.whole.row_scale(self.tearing.rows[place])
        })
    }

    fn terms(&self) -> [f64; K] {
        std::array::from_fn(|place| self.tearing.terms[place])
    }

    fn evaluate(
        &self,
        tears: &[f64; K],
        signs: &Vec<f64>,
        t: f64,
    ) -> Option<Evaluation<f64, K, ()>> {
        self.whole.count();
        self.set(tears, signs);
        let results = self.whole.results(&self.tearing.evaluate, t)?;
        Some(Evaluation {
            residual: std::array::from_fn(|row| results[row]),
            inverse: std::array::from_fn(|row| {
                std::array::from_fn(|column| results[K + row * K + column])
            }),
            determinant: results[K + K * K],
            carried: (),
        })
    }

    fn complete(
        &self,
        tears: &[f64; K],
        signs: &Vec<f64>,
        (): &(),
        t: f64,
    ) -> Completion<f64, Dyn> {
        self.set(tears, signs);
        let results = self.whole.results(&self.tearing.complete, t);
        let size = self.whole.dimension().0;
        let part = |place: usize| match &results {
            Some(results) => DVector::from_column_slice(&results[place * size..(place + 1) * size]),
            None => DVector::from_element(size, f64::NAN),
        };
        Completion {
            cosines: part(0),
            sines: part(1),
            rates: part(2),
            accelerations: part(3),
            residual: part(4),
            response: results
                .as_ref()
                .map_or(f64::NAN, |results| torn::largest_of(&results[5 * size..])),
        }
    }

    fn signs(&self, q: &DVector<f64>, t: f64) -> Vec<f64> {
        self.whole.write(&self.whole.newton.tears[0], q);
        let values = self.whole.results(&self.tearing.sign_values, t);
        let values = values.unwrap_or_else(|| vec![f64::NAN; self.tearing.signs.len()]);
        values.into_iter().map(torn::sign).collect()
    }
}
