//! *A mechanism* → *how far each of its parts is from singular at an instant, and how fast that changes*.
//!
//! The measure of a part is its determinant divided by the lengths of its Jacobian's columns (Hadamard's ratio): the sine of
//! the angle between two links, between a link and its slide, between two lines. It is dimensionless, at most 1 in size, and
//! zero exactly where the part is singular. One equation encloses no angle: it is measured by its slope, which is compared with the
//! largest on the way; that of a Newton-Raphson is scaled as its equation and its unknown are.

use linkwright::Measure;
use linkwright_codegen::stages::expr::ExprId;
use linkwright_codegen::stages::program::{Lengths, Program};
use linkwright_codegen::stages::structure::SolvedPlan;
use linkwright_codegen::stages::system::System;
use nalgebra::{DMatrix, DVector};

use crate::instant::Instant;
use crate::interpreted::Interpreted;
use crate::reader::Reader;
use crate::view::View;

/// A measure with its rate.
pub type Sample = [f64; 2];

/// A part of the plan that can be singular.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredPart {
    /// The block of the plan, from 0.
    pub block: usize,
    /// The part in its block, from 0.
    pub part: usize,
    /// What it finds: `phi_c3`, `phi_c10`.
    pub unknowns: Vec<String>,
    /// Whether only its course says how large the measure can be.
    pub is_relative: bool,
    /// The size of the Jacobian that has to be evaluated; `None` for a closed form, of which measure and rate are evaluated.
    size: Option<usize>,
    /// What the slope of a single equation is multiplied by.
    scale: f64,
}

/// The measures of all parts that can be singular.
#[derive(Clone, Debug)]
pub struct Measures {
    parts: Vec<MeasuredPart>,
    reader: Reader,
}

/// What the measures are made of: for each part first values, then as many rates.
pub(crate) fn measured(
    system: &mut System,
    plan: &SolvedPlan,
    program: &Program,
) -> (Vec<MeasuredPart>, Vec<ExprId>) {
    let zero = system.mechanism.graph.zero();
    // What moves a driver for the sake of a derivative is zero.
    let drivers = system
        .directions
        .iter()
        .filter(|direction| !direction.is_parameter());
    let shifts: Vec<_> = drivers.map(|direction| (direction.symbol, zero)).collect();
    let form = &system.vector_form;
    let graph = &mut system.mechanism.graph;
    let (mut parts, mut all) = (Vec::new(), Vec::new());
    let mut single_newtons = Vec::new();
    for (block, forms) in program.forms.iter().enumerate().take(plan.blocks.len()) {
        for (part, own) in forms.iter().enumerate() {
            let found = own.determinant(form, graph);
            // One equation for one unknown encloses no angle.
            let is_single = found.normalized.is_none() && found.jacobian.len() <= 1;
            let values: Vec<ExprId> = match found.normalized {
                Some(value) => vec![value],
                None if is_single => found.value.into_iter().collect(),
                None => found.jacobian.concat(),
            };
            let values: Vec<ExprId> = values
                .iter()
                .map(|&it| graph.substitute(it, &shifts))
                .collect();
            if values.is_empty() || values.iter().all(|&value| graph.is_fixed(value)) {
                continue;
            }
            let rates: Vec<ExprId> = values
                .iter()
                .map(|&value| form.rate(value, graph))
                .collect();
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
                size: (found.normalized.is_none() && !is_single).then_some(found.jacobian.len()),
            });
        }
    }
    for (part, residual, row, column) in single_newtons {
        let [rows, columns] = Lengths::of_block(&[residual], &[row], system);
        let part: &mut MeasuredPart = &mut parts[part];
        part.scale = columns.scale(column) / rows.scale(row);
    }
    (parts, all)
}

impl MeasuredPart {
    /// The order of the Jacobian that is evaluated; `None` where its measure is.
    pub(crate) fn order(&self) -> Option<usize> {
        self.size
    }

    /// What the value of its measure is multiplied by.
    pub(crate) fn scale(&self) -> f64 {
        self.scale
    }

    /// The size of its measure as a number up to 1, also where it is relative; see [`Measure::slope`].
    pub fn bounded(&self, size: f64) -> f64 {
        match self.is_relative {
            true => Measure::slope(size).reciprocal_condition,
            false => size,
        }
    }
}

impl Measures {
    /// The measures of a mechanism.
    pub fn new(interpreted: &Interpreted) -> Measures {
        let compiled = interpreted.compiled();
        let graph = &interpreted.system().mechanism.graph;
        let (parts, values) = &compiled.measured;
        Measures {
            parts: parts.clone(),
            reader: Reader::new(graph, interpreted.layout(), values),
        }
    }

    /// What is measured.
    pub fn parts(&self) -> &[MeasuredPart] {
        &self.parts
    }

    /// The measure of each part with its rate.
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

/// det J over the product of the lengths of its columns, and its rate: with d(det J) = det J · tr(J⁻¹ dJ).
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
