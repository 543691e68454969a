//! Verifies that the equations have one solution near the chord everywhere in a window of time.
//!
//! For each s of the [`Chord`] the unknowns are on the chord up to e. With C near the inverse of the Jacobian, Krawczyk's operator
//! K(E) = −C Φ(chord) + (I − C Φ_q) E holds every solution in E. If it maps E into its interior, there is one solution, and Φ_q is
//! nonsingular (Krawczyk 1969; Neumaier, Interval Methods for Systems of Equations, 1990, section 5.1). Cells of few equations are
//! verified in order, each with the full regions of those before it.

use linkwright_codegen::stages::assemblies::Interval;
use linkwright_codegen::stages::expr::ExprId;
use linkwright_codegen::stages::structure::SolvedPlan;

use super::functions::{Chord, Functions, Writing, is_bounded, magnitude};
use super::matrices::{inverse, product};

/// First region of the unknowns, as a multiple of the correction that Φ on the chord requires.
const FIRST: f64 = 2.0;

/// Factor by which a region grows that is not mapped into itself, and largest number of attempts.
const INFLATION: f64 = 1.25;
const WIDENED: usize = 8;

/// Relative deviation from the chord that is always included.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Equations that are solved together.
#[derive(Clone, Debug)]
pub(super) struct Cell {
    /// Block of the plan, from 0.
    pub block: usize,
    /// Unknowns, as many as equations.
    own: Vec<usize>,
    functions: Functions,
}

/// Verification of a window.
#[derive(Clone, Debug)]
pub(super) struct Verified {
    pub chord: Chord,
    /// Largest deviation of each unknown from the chord up to which there is one solution.
    pub region: Vec<f64>,
    /// Enclosure of the solution's deviation from the chord.
    pub off: Vec<Interval>,
}

/// Returns the cells of a plan, each after those that it needs; `None` if they have no such order.
pub(super) fn cells(plan: &SolvedPlan, writing: &mut Writing<'_>) -> Option<Vec<Cell>> {
    let mut open = Vec::new();
    for (block, solved) in plan.blocks.iter().enumerate() {
        for part in &solved.parts {
            let equations = part.equations.iter().map(|it| it.residual);
            let equations: Vec<ExprId> = equations.collect();
            open.push(Cell {
                block,
                own: part.unknowns.clone(),
                functions: writing.functions(&equations),
            });
        }
        for definition in &solved.definitions {
            let equation = writing.definition(definition.unknown, definition.value);
            open.push(Cell {
                block,
                own: vec![definition.unknown],
                functions: writing.functions(&[equation]),
            });
        }
    }
    let mut ordered: Vec<Cell> = Vec::with_capacity(open.len());
    let mut known: Vec<usize> = Vec::new();
    while !open.is_empty() {
        let is_next = |cell: &Cell| {
            let mut mentioned = cell.functions.mentioned.iter().flatten();
            mentioned.all(|unknown| known.contains(unknown) || cell.own.contains(unknown))
        };
        let cell = open.remove(open.iter().position(is_next)?);
        let is_square = cell.functions.count() == cell.own.len();
        if !is_square || cell.own.iter().any(|unknown| known.contains(unknown)) {
            return None;
        }
        known.extend(&cell.own);
        ordered.push(cell);
    }
    Some(ordered)
}

/// Reason that a block is not verified.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Cause {
    /// The equations of this block or their derivatives are unbounded.
    Unbounded(usize),
    /// This block may have no solution near the chord, or several.
    NotAlone(usize),
}

/// Verifies all cells along a chord. The region of each unknown contains at least the deviations up to `least`.
///
/// # Errors
/// The first block whose verification fails.
pub(super) fn verify(cells: &[Cell], chord: Chord, least: &[f64]) -> Result<Verified, Cause> {
    let count = chord.line.len();
    let arguments = [Interval::point(0.0), chord.range].map(|s| chord.arguments(s));
    let arguments = [&arguments[0][..], &arguments[1][..]];
    let mut at: Vec<Interval> = Vec::with_capacity(count + 1);
    at.push(chord.times());
    at.extend((0..count).map(|unknown| chord.unknown(unknown, chord.range)));
    let mut verified = Verified {
        region: vec![0.0; count],
        off: vec![Interval::point(0.0); count],
        chord,
    };
    for cell in cells {
        cell.verify(&mut verified, &mut at, arguments, least)?;
    }
    Ok(verified)
}

impl Cell {
    fn verify(
        &self,
        verified: &mut Verified,
        at: &mut [Interval],
        arguments: [&[Interval]; 2],
        least: &[f64],
    ) -> Result<(), Cause> {
        let chord = &verified.chord;
        let along = self.functions.along(chord, arguments);
        let derivatives = self.functions.derivatives(at);
        let mut values = along.iter().chain(derivatives.iter().flatten());
        if !values.all(|&it| is_bounded(it)) {
            return Err(Cause::Unbounded(self.block));
        }
        let (middle, _) = self.split(derivatives, &verified.off);
        let inverse = inverse(&middle).ok_or(Cause::NotAlone(self.block))?;
        let order = self.own.len();
        let times = |values: &[Interval]| -> Vec<Interval> {
            let row = |row: usize| {
                (0..order).fold(Interval::point(0.0), |sum, k| {
                    sum.plus(Interval::point(inverse[(row, k)]).times(values[k]))
                })
            };
            (0..order).map(row).collect()
        };
        let floor: Vec<f64> = {
            let unknowns = self.own.iter();
            unknowns
                .map(|&it| least[it].max(ROUNDING * chord.line[it][0].abs()) + f64::MIN_POSITIVE)
                .collect()
        };
        let left = times(&along);
        let sizes = left.iter().zip(&floor);
        let mut region: Vec<f64> = sizes
            .map(|(it, floor)| FIRST * magnitude(*it) + floor)
            .collect();
        let lines: Vec<Interval> = self.own.iter().map(|&it| at[it + 1]).collect();
        for _ in 0..WIDENED {
            if !region.iter().all(|it| it.is_finite()) {
                break;
            }
            for ((&unknown, line), radius) in self.own.iter().zip(&lines).zip(&region) {
                at[unknown + 1] = line.plus(Interval::new(-radius, *radius));
            }
            let (jacobian, by_others) = self.split(self.functions.derivatives(at), &verified.off);
            let residual = along.iter().zip(&by_others);
            let residual: Vec<Interval> = residual.map(|(a, b)| a.plus(*b)).collect();
            let left = times(&residual);
            let products = product(&inverse, &jacobian);
            let mapped = products.iter().enumerate().map(|(row, entries)| {
                let mut sum = left[row].negated();
                for (column, entry) in entries.iter().enumerate() {
                    let one = f64::from(u8::from(row == column));
                    let radius = region[column];
                    let spread = Interval::point(one).minus(*entry);
                    sum = sum.plus(spread.times(Interval::new(-radius, radius)));
                }
                sum
            });
            let mapped: Vec<Interval> = mapped.collect();
            let mut pairs = mapped.iter().zip(&region);
            let is_inside = pairs.all(|(own, radius)| {
                is_bounded(*own) && own.is_inside(Interval::new(-radius, *radius))
            });
            if is_inside {
                for (place, &unknown) in self.own.iter().enumerate() {
                    verified.region[unknown] = region[place];
                    verified.off[unknown] = mapped[place];
                }
                return Ok(());
            }
            let sizes = mapped.iter().zip(&floor);
            region = sizes
                .map(|(own, floor)| INFLATION * magnitude(*own) + floor)
                .collect();
        }
        Err(Cause::NotAlone(self.block))
    }

    /// Splits derivatives into the matrix of the cell's unknowns, and the change by the deviations of other unknowns.
    fn split(
        &self,
        derivatives: Vec<Vec<Interval>>,
        off: &[Interval],
    ) -> (Vec<Vec<Interval>>, Vec<Interval>) {
        let zero = Interval::point(0.0);
        let mut jacobian = vec![vec![zero; self.own.len()]; self.own.len()];
        let mut others = vec![zero; self.own.len()];
        let rows = derivatives.into_iter().zip(&self.functions.mentioned);
        for (row, (derivatives, mentioned)) in rows.enumerate() {
            for (derivative, unknown) in derivatives.into_iter().zip(mentioned) {
                match self.own.iter().position(|own| own == unknown) {
                    Some(column) => jacobian[row][column] = derivative,
                    None => others[row] = others[row].plus(derivative.times(off[*unknown])),
                }
            }
        }
        (jacobian, others)
    }
}

impl Verified {
    /// True if the solution at one of the window's frames is that of the window: `node` is the frame with its own verification.
    pub fn holds(&self, node: &Verified) -> bool {
        let s = self.chord.place(node.chord.time[0]);
        let mut unknowns = (0..self.region.len()).map(|unknown| {
            let exact = Interval::point(node.chord.line[unknown][0]).plus(node.off[unknown]);
            let off = exact.minus(self.chord.unknown(unknown, s));
            let radius = self.region[unknown];
            is_bounded(off) && off.is_inside(Interval::new(-radius, radius))
        });
        unknowns.all(|is_held| is_held)
    }

    /// Returns all times and unknowns of the window, as arguments of functions.
    pub fn all(&self) -> Vec<Interval> {
        let zero = Interval::point(0.0);
        let unknowns = self.off.iter().enumerate();
        let unknowns = unknowns.map(|(unknown, off)| {
            let line = self.chord.unknown(unknown, self.chord.range);
            line.plus(off.hull(zero))
        });
        std::iter::once(self.chord.times())
            .chain(unknowns)
            .collect()
    }

    /// Returns an unknown in the window.
    pub fn unknown(&self, unknown: usize) -> Interval {
        let line = self.chord.unknown(unknown, self.chord.range);
        line.plus(self.off[unknown])
    }

    /// Returns functions in the window.
    pub fn values(&self, functions: &Functions) -> Vec<Interval> {
        let arguments = [Interval::point(0.0), self.chord.range].map(|s| self.chord.arguments(s));
        let along = functions.along(&self.chord, [&arguments[0], &arguments[1]]);
        let derivatives = functions.derivatives(&self.all());
        let rows = along.into_iter().zip(&functions.mentioned).zip(derivatives);
        let value =
            |((along, mentioned), derivatives): ((Interval, &Vec<usize>), Vec<Interval>)| {
                let others = derivatives.into_iter().zip(mentioned);
                others.fold(along, |sum, (derivative, &unknown)| {
                    sum.plus(derivative.times(self.off[unknown]))
                })
            };
        let values: Vec<Interval> = rows.map(value).collect();
        if values.iter().all(|it| is_bounded(*it)) {
            return values;
        }
        // Where a function has a kink, its derivatives have no bounds.
        let direct = functions.at(&self.all()).into_iter();
        let values = values.into_iter().zip(direct);
        let bounded = values.map(|(value, direct)| match is_bounded(value) {
            true => value,
            false => direct,
        });
        bounded.collect()
    }
}
