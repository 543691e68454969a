//! Measures the distance of each subsystem from a singular pose, and its rate.
//!
//! The measure of a subsystem is its determinant divided by the lengths of its Jacobian's columns (Hadamard's ratio): the sine of
//! the angle between two links, between a link and its slide, between two lines. It is dimensionless, at most 1 in magnitude, and
//! zero exactly in singular poses. One equation encloses no angle: its measure is its slope, relative to the largest of the motion.
//! The slope of a Newton-Raphson is scaled by its equation and its unknown.

use linkwright::generated::Measure;
use linkwright_codegen::stages::expr::ExprId;
use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::program::{Lengths, Program};
use linkwright_codegen::stages::structure::SolvedPlan;
use linkwright_codegen::stages::system::System;
use nalgebra::{DMatrix, DVector};

use crate::instant::Instant;
use crate::reader::Reader;

/// Measure and its rate.
pub type Sample = [f64; 2];

/// Subsystem of the plan that can be singular.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredPart {
    /// Block of the plan, from 0.
    pub block: usize,
    /// Subsystem of its block, from 0.
    pub part: usize,
    /// Unknowns: `phi_c3`, `phi_c10`.
    pub unknowns: Vec<String>,
    /// True if the largest value of the measure is known only from the motion.
    pub is_relative: bool,
    /// Order of the evaluated Jacobian; `None` for a closed form, whose measure and rate are evaluated.
    size: Option<usize>,
    /// Factor of the slope of a single equation.
    scale: f64,
}

/// Measures of all subsystems that can be singular.
#[derive(Clone, Debug)]
pub struct Measures {
    parts: Vec<MeasuredPart>,
    reader: Reader,
}

/// Returns the evaluated expressions of each subsystem: values, then as many rates.
pub(crate) fn measured(
    pool: &mut Pool,
    system: &System,
    plan: &SolvedPlan,
    program: &Program,
) -> (Vec<MeasuredPart>, Vec<ExprId>) {
    let zero = pool.graph.zero();
    // Changes of drivers for the sake of derivatives are zero.
    let drivers = system
        .directions
        .iter()
        .filter(|direction| !direction.is_parameter());
    let shifts: Vec<_> = drivers.map(|direction| (direction.symbol, zero)).collect();
    let form = &system.vector_form;
    let (mut parts, mut all) = (Vec::new(), Vec::new());
    let mut single_newtons = Vec::new();
    for (block, forms) in program.forms.iter().enumerate().take(plan.blocks.len()) {
        for (part, own) in forms.iter().enumerate() {
            let determinant = own.determinant(pool);
            // One equation for one unknown encloses no angle.
            let is_single = determinant.normalized.is_none() && determinant.jacobian.len() <= 1;
            let values: Vec<ExprId> = match determinant.normalized {
                Some(value) => vec![value],
                None if is_single => determinant.value.into_iter().collect(),
                None => determinant.jacobian.concat(),
            };
            let values: Vec<ExprId> = values
                .iter()
                .map(|&it| pool.graph.substitute(it, &shifts))
                .collect();
            if values.is_empty() || values.iter().all(|&value| pool.graph.is_fixed(value)) {
                continue;
            }
            let rates: Vec<ExprId> = values.iter().map(|&value| pool.rate(value)).collect();
            all.extend(values);
            all.extend(rates);
            let unknowns = own.unknowns();
            let scale = match (is_single && own.modes().is_none(), &unknowns[..]) {
                (true, &[unknown]) => {
                    let equation = &plan.blocks[block].parts[part].equations[0];
                    let row = equation.quantity;
                    let column = form.unknowns[unknown].quantity;
                    single_newtons.push((parts.len(), equation.residual, row, column));
                    1.0
                }
                _ => 1.0,
            };
            let unknowns = unknowns.iter().map(|&it| form.unknowns[it].name.clone());
            parts.push(MeasuredPart {
                block,
                part,
                scale,
                unknowns: unknowns.collect(),
                is_relative: is_single,
                size: (determinant.normalized.is_none() && !is_single)
                    .then_some(determinant.jacobian.len()),
            });
        }
    }
    for (part, residual, row, column) in single_newtons {
        let [rows, columns] = Lengths::of_block(&[residual], &[row], pool, system);
        let part: &mut MeasuredPart = &mut parts[part];
        part.scale = columns.scale(column) / rows.scale(row);
    }
    (parts, all)
}

impl MeasuredPart {
    /// Order of the evaluated Jacobian; `None` if the measure itself is evaluated.
    pub(crate) fn order(&self) -> Option<usize> {
        self.size
    }

    /// Factor of the measure's value.
    pub(crate) fn scale(&self) -> f64 {
        self.scale
    }

    /// Returns the magnitude as a number up to 1, also for relative measures; see [`Measure::slope`].
    pub fn bounded(&self, size: f64) -> f64 {
        match self.is_relative {
            true => Measure::slope(size).reciprocal_condition,
            false => size,
        }
    }
}

impl Measures {
    /// Creates the measures of subsystems with their expressions from [`measured`], evaluated by `reader`.
    pub(crate) fn new(parts: Vec<MeasuredPart>, reader: Reader) -> Measures {
        Measures { parts, reader }
    }

    /// Measured subsystems.
    pub fn parts(&self) -> &[MeasuredPart] {
        &self.parts
    }

    /// Returns the measure of each subsystem with its rate.
    pub fn at(&self, instant: &Instant) -> Vec<Sample> {
        let values = self.reader.values(instant);
        let mut rest = values.as_slice();
        let samples = self.parts.iter().map(|part| {
            let count = part.size.map_or(1, |size| size * size);
            let (own, others) = rest.split_at(2 * count);
            rest = others;
            let (values, rates) = own.split_at(count);
            match part.size {
                None => [part.scale * values[0], part.scale * rates[0]],
                Some(size) => hadamard(
                    &DMatrix::from_row_slice(size, size, values),
                    &DMatrix::from_row_slice(size, size, rates),
                ),
            }
        });
        samples.collect()
    }
}

/// Returns det J over the product of the lengths of its columns, and its rate: d(det J) = det J · tr(J⁻¹ dJ).
fn hadamard(jacobian: &DMatrix<f64>, rates: &DMatrix<f64>) -> Sample {
    let lengths: Vec<f64> = jacobian.column_iter().map(|it| it.norm()).collect();
    if lengths.contains(&0.0) {
        return [0.0; 2];
    }
    let mut unit = jacobian.clone();
    for (mut column, length) in unit.column_iter_mut().zip(&lengths) {
        column /= *length;
    }
    let factors = unit.lu();
    let value = factors.determinant();
    let mut logarithmic = 0.0;
    for (place, length) in lengths.iter().enumerate() {
        let rate: DVector<f64> = rates.column(place) / *length;
        let along = rate.dot(&jacobian.column(place)) / *length;
        let Some(solved) = factors.solve(&rate) else {
            return [0.0; 2];
        };
        logarithmic += solved[place] - along;
    }
    [value, value * logarithmic]
}
