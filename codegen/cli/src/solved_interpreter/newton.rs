//! *The equations of a block without a closed form → its tears with their rates and accelerations*, by the runtime's
//! Newton-Raphson, in the mode that is sought.

use std::cell::RefCell;
use std::f64::consts::PI;

use linkwright::closed_form::{failed, nearest_turn};
use linkwright::{
    Branch, Equations, Failure, FailureKind, Frame, Settings, Start, assemble_from_afar, block,
    branch_of,
};
use linkwright_codegen::expr::{SymbolId, Tape};
use linkwright_codegen::joint::Quantity;
use linkwright_codegen::program::solved::NewtonBlock;
use linkwright_codegen::system::System;
use nalgebra::{DMatrix, DVector, Dyn};

use super::operation::{Operation, operations, run};

/// From how many poses at random a mode is looked for, if it is not found from the last values.
pub const STARTS: u32 = 200;

/// How far these poses are from the last values at most: half a turn, and this many characteristic lengths.
const SCATTER: f64 = PI;

/// Poses closer than this, in the scale of each unknown, are the same.
pub const SAME: f64 = 1e-6;

/// A reproducible sequence of numbers in [-1, 1) (xorshift64*, Vigna 2016).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11;
        bits as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Which mode is sought of a block without a closed form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sought {
    /// That of its last frame, or the one near the last values where it has none.
    Near,
    /// The one with this sign of its Jacobian's determinant, from wherever it is found.
    Sign(Branch),
    /// The one that is not near.
    Other,
}

/// The last frame of a block without a closed form, and its mode.
#[derive(Clone, Debug)]
pub(super) struct Known {
    frame: Frame<f64, Dyn>,
    branch: Branch,
}

/// The equations of a block without a closed form.
#[derive(Clone, Debug)]
pub(super) struct Newton {
    positions: Vec<SymbolId>,
    rates: Vec<SymbolId>,
    accelerations: Vec<SymbolId>,
    scales: Vec<f64>,
    /// Which tears are angles, whose whole turns make no other pose.
    is_angle: Vec<bool>,
    row_scales: Vec<f64>,
    geometry: Vec<Operation>,
    residuals: Tape,
    jacobian: Tape,
    time_derivative: Tape,
    gamma: Tape,
}

impl Newton {
    /// The equations as instructions.
    pub(super) fn new(block: &NewtonBlock, system: &System) -> Newton {
        let graph = &system.mechanism.graph;
        let unknowns: Vec<_> = block
            .unknowns
            .iter()
            .map(|&unknown| &system.vector_form.unknowns[unknown])
            .collect();
        Newton {
            positions: unknowns.iter().map(|it| it.position).collect(),
            rates: unknowns.iter().map(|it| it.rate).collect(),
            accelerations: unknowns.iter().map(|it| it.acceleration).collect(),
            scales: unknowns
                .iter()
                .map(|it| system.scale(it.quantity))
                .collect(),
            is_angle: unknowns
                .iter()
                .map(|it| it.quantity == Quantity::Angle)
                .collect(),
            row_scales: block
                .quantities
                .iter()
                .map(|it| system.scale(*it))
                .collect(),
            geometry: operations(block.geometry.iter(), system),
            residuals: Tape::new(graph, &block.residuals),
            jacobian: Tape::new(graph, &block.jacobian),
            time_derivative: Tape::new(graph, &block.time_derivative),
            gamma: Tape::new(graph, &block.gamma),
        }
    }

    /// Finds the tears with their rates and accelerations at `t`.
    pub(super) fn solve(
        &self,
        t: f64,
        symbols: &mut [f64],
        known: &mut Option<Known>,
        sought: Sought,
    ) -> Result<(), Failure<f64>> {
        let equations = At {
            newton: self,
            symbols: RefCell::new(symbols.to_vec()),
        };
        let last = self.positions.iter().map(|it| symbols[it.index()]);
        let last = DVector::from_iterator(self.positions.len(), last);
        let found = match sought {
            Sought::Near => near(&equations, &last, known.as_ref(), t)?,
            Sought::Sign(branch) => search(&equations, &last, branch, t)?,
            Sought::Other => {
                let here = near(&equations, &last, known.as_ref(), t)?;
                search(&equations, &last, here.branch.opposite(), t)?
            }
        };
        let frame = &found.frame;
        let levels = [
            (&self.positions, &frame.q),
            (&self.rates, &frame.qd),
            (&self.accelerations, &frame.qdd),
        ];
        for (places, values) in levels {
            for (place, value) in places.iter().zip(values.iter()) {
                symbols[place.index()] = *value;
            }
        }
        *known = Some(found);
        Ok(())
    }
}

impl Newton {
    /// The poses (tears) that are found from the tears among the symbols and from [`STARTS`] poses at random about them, each
    /// once, in the order in which they are found. Angles are those nearest to the start.
    pub(super) fn poses(&self, t: f64, symbols: &[f64]) -> Vec<DVector<f64>> {
        let equations = At {
            newton: self,
            symbols: RefCell::new(symbols.to_vec()),
        };
        let last = self.positions.iter().map(|it| symbols[it.index()]);
        let last = DVector::from_iterator(self.positions.len(), last);
        let mut found: Vec<DVector<f64>> = Vec::new();
        let mut random = Random(1);
        let mut start = last.clone();
        for _ in 0..=STARTS {
            let reached = assemble_from_afar(&equations, &start, None, t, &Settings::default());
            if let Ok(frame) = reached {
                let mut pose = frame.q;
                for (place, value) in pose.iter_mut().enumerate() {
                    if self.is_angle[place] {
                        *value = nearest_turn(*value, last[place]);
                    }
                }
                if !found.iter().any(|other| self.is_same(other, &pose)) {
                    found.push(pose);
                }
            }
            self.scatter(&last, &mut random, &mut start);
        }
        found
    }

    /// Whether two poses of the tears differ by rounding alone, or by whole turns.
    fn is_same(&self, one: &DVector<f64>, other: &DVector<f64>) -> bool {
        (0..one.len()).all(|place| {
            let other = match self.is_angle[place] {
                true => nearest_turn(other[place], one[place]),
                false => other[place],
            };
            (one[place] - other).abs() <= SAME * self.scales[place]
        })
    }

    /// A pose at random about another.
    fn scatter(&self, about: &DVector<f64>, random: &mut Random, start: &mut DVector<f64>) {
        for (place, scale) in self.scales.iter().enumerate() {
            start[place] = about[place] + SCATTER * scale * random.next();
        }
    }

    /// Puts in a pose of the tears.
    pub(super) fn place(&self, pose: &DVector<f64>, symbols: &mut [f64]) {
        for (symbol, value) in self.positions.iter().zip(pose.iter()) {
            symbols[symbol.index()] = *value;
        }
    }
}

/// The pose of the mode that is known, or else the one near an estimate.
fn near(
    equations: &At<'_>,
    estimate: &DVector<f64>,
    known: Option<&Known>,
    t: f64,
) -> Result<Known, Failure<f64>> {
    let (start, last, mut branch) = match known {
        Some(known) => (Start::LastFrame, known.frame.clone(), Some(known.branch)),
        None => {
            let rest = DVector::zeros(estimate.len());
            let frame = Frame {
                t,
                q: estimate.clone(),
                qd: rest.clone(),
                qdd: rest,
            };
            (Start::Estimate, frame, None)
        }
    };
    let settings = Settings::default();
    let frame = block::solve(equations, &last, start, &mut branch, t, &settings)?;
    let branch = match branch {
        Some(branch) => branch,
        None => branch_of(equations, &frame.q, t, &settings)?,
    };
    Ok(Known { frame, branch })
}

/// A pose of a mode that the last values may be far from.
fn search(
    equations: &At<'_>,
    last: &DVector<f64>,
    branch: Branch,
    t: f64,
) -> Result<Known, Failure<f64>> {
    let mut random = Random(1);
    let mut start = last.clone();
    for _ in 0..=STARTS {
        let settings = Settings::default();
        if let Ok(frame) = assemble_from_afar(equations, &start, Some(branch), t, &settings) {
            return Ok(Known { frame, branch });
        }
        equations.newton.scatter(last, &mut random, &mut start);
    }
    Err(failed(FailureKind::WrongBranch, t, 0))
}

/// The equations of a Newton block after the blocks before it.
struct At<'a> {
    newton: &'a Newton,
    symbols: RefCell<Vec<f64>>,
}

impl At<'_> {
    /// Evaluates with the tears, and their rates if the results need them.
    fn evaluate(
        &self,
        tape: &Tape,
        t: f64,
        tears: &DVector<f64>,
        rates: Option<&DVector<f64>>,
        results: &mut [f64],
    ) {
        let symbols = &mut *self.symbols.borrow_mut();
        let mut workspace = Vec::new();
        for (symbol, value) in self.newton.positions.iter().zip(tears.iter()) {
            symbols[symbol.index()] = *value;
        }
        let rates = rates.into_iter().flat_map(|rates| rates.iter());
        for (symbol, value) in self.newton.rates.iter().zip(rates) {
            symbols[symbol.index()] = *value;
        }
        // What is not finite shows in the results.
        let ran = self.newton.geometry.iter();
        let failed = ran
            .map(|operation| run(operation, t, symbols, &mut workspace))
            .any(|outcome| outcome.is_err());
        match failed {
            true => results.fill(f64::NAN),
            false => tape.evaluate(symbols, &mut workspace, results),
        }
    }
}

impl Equations<f64, Dyn> for At<'_> {
    fn dimension(&self) -> Dyn {
        Dyn(self.newton.positions.len())
    }

    fn residual(&self, q: &DVector<f64>, t: f64, phi: &mut DVector<f64>) {
        self.evaluate(&self.newton.residuals, t, q, None, phi.as_mut_slice());
    }

    fn jacobian(&self, q: &DVector<f64>, t: f64, phi_q: &mut DMatrix<f64>) {
        let mut rows = vec![0.0; q.len() * q.len()];
        self.evaluate(&self.newton.jacobian, t, q, None, &mut rows);
        phi_q.copy_from(&DMatrix::from_row_slice(q.len(), q.len(), &rows));
    }

    fn time_derivative(&self, q: &DVector<f64>, t: f64, phi_t: &mut DVector<f64>) {
        let results = phi_t.as_mut_slice();
        self.evaluate(&self.newton.time_derivative, t, q, None, results);
    }

    fn gamma(&self, q: &DVector<f64>, qd: &DVector<f64>, t: f64, gamma: &mut DVector<f64>) {
        self.evaluate(&self.newton.gamma, t, q, Some(qd), gamma.as_mut_slice());
    }

    fn row_scale(&self, row: usize) -> f64 {
        self.newton.row_scales[row]
    }

    fn coordinate_scale(&self, column: usize) -> f64 {
        self.newton.scales[column]
    }
}
