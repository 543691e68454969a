//! Evaluates the [`Equations`] of a block without a closed form on registers.

mod torn;

use std::cell::RefCell;

use linkwright::{Equations, Frame};
use linkwright_codegen::stages::assemblies;
use linkwright_codegen::stages::expr::{Code, Register, SymbolId};
use linkwright_codegen::stages::joint::Quantity;
use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::program::{Block, Function, Lengths, Statement};
use linkwright_codegen::stages::system::System;
use nalgebra::{DMatrix, DVector, Dyn};

use crate::operation::{Operation, Writer, run};
use torn::Tearing;

/// Newton-Raphson of a block.
#[derive(Clone, Debug)]
pub(crate) struct Newton {
    /// Tearing variables with their rates and accelerations.
    pub tears: [Vec<Register>; 3],
    /// Tearing variables, rates and accelerations at the last instant.
    pub last: [Vec<Register>; 3],
    /// Determinant and reciprocal condition; `None` if they are not requested.
    pub measure: Option<[Register; 2]>,
    /// Symbols and registers that the functions read of earlier blocks.
    pub known: Vec<(SymbolId, Register)>,
    /// Solution with fewer unknowns; `None` if the block is not torn.
    pub tearing: Option<Tearing>,
    /// True for tearing variables that are angles, whose whole turns are the same pose.
    pub is_angle: Vec<bool>,
    residual: Part,
    jacobian: Part,
    time_derivative: Part,
    gamma: Part,
    rows: Vec<Quantity>,
    columns: Vec<Quantity>,
    /// Scale of lengths in the rows, and in the columns.
    scaled_by: [ScaledBy; 2],
}

/// Scale of lengths: the largest of some lengths.
#[derive(Clone, Debug)]
struct ScaledBy {
    following: Option<Part>,
    /// Value with nominal parameters, in m.
    nominal: f64,
}

/// Function on registers.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    pub operations: Vec<Operation>,
    pub results: Vec<Register>,
}

impl Newton {
    /// Writes the equations of a block, and binds its tearing variables; `None` if the block has closed forms only.
    pub fn new(
        block: &Block,
        pool: &Pool,
        system: &System,
        writer: &mut Writer<'_>,
    ) -> Option<Newton> {
        let newton = block.newton.as_ref()?;
        let unknowns = newton
            .unknowns
            .iter()
            .map(|&it| &system.vector_form.unknowns[it]);
        let symbols: Vec<_> = unknowns
            .clone()
            .map(|it| [it.position, it.rate, it.acceleration])
            .collect();
        let graph = &pool.graph;
        let read = assemblies::read(newton, graph).into_iter();
        let known = read.map(|symbol| (symbol, writer.assembler.symbol(symbol)));
        let known = known.collect();
        let level = |level: usize| symbols.iter().map(move |it| it[level]);
        let last = [0, 1, 2].map(|it| level(it).map(|symbol| writer.last(symbol)).collect());
        let tears = [0, 1, 2].map(|it| level(it).map(|symbol| writer.found(symbol)).collect());
        let measure = block
            .function
            .statements
            .iter()
            .find_map(|statement| match statement {
                Statement::Newton { measure, .. } => *measure,
                _ => None,
            });
        let columns: Vec<Quantity> = unknowns.map(|it| it.quantity).collect();
        let scaled_by = newton
            .scaled_by
            .each_ref()
            .map(|it| ScaledBy::new(it, writer));
        Some(Newton {
            known,
            measure: measure.map(|both| both.map(|symbol| writer.found(symbol))),
            residual: Part::new(&newton.residual, writer),
            jacobian: Part::new(&newton.jacobian, writer),
            time_derivative: Part::new(&newton.time_derivative, writer),
            gamma: Part::new(&newton.gamma, writer),
            is_angle: columns.iter().map(|it| *it == Quantity::Angle).collect(),
            rows: newton.quantities.clone(),
            columns,
            scaled_by,
            tearing: Tearing::new(block, &tears, system, writer),
            tears,
            last,
        })
    }

    /// Returns the equations after the blocks before them; `count` is called at every evaluation of the residual.
    pub fn at<'a>(
        &'a self,
        code: &'a Code,
        registers: &'a mut [f64],
        count: &'a dyn Fn(),
    ) -> NewtonEquations<'a> {
        let lengths = self
            .scaled_by
            .each_ref()
            .map(|it| it.length(code, registers));
        NewtonEquations {
            newton: self,
            code,
            registers: RefCell::new(registers),
            lengths,
            count,
        }
    }

    /// Returns the tearing variables at the last instant, for time `t` (s).
    pub fn last_frame(&self, registers: &[f64], t: f64) -> Frame<f64, Dyn> {
        let [q, qd, qdd] = [0, 1, 2].map(|level| vector(&self.last[level], registers));
        Frame { t, q, qd, qdd }
    }

    /// Sets the tearing variables of the last instant, from which an assembly starts.
    pub fn set_last(&self, pose: &DVector<f64>, registers: &mut [f64]) {
        for (place, value) in self.last[0].iter().zip(pose.iter()) {
            registers[place.index()] = *value;
        }
    }

    /// Scale of a tearing variable with nominal parameters.
    pub fn scale(&self, place: usize) -> f64 {
        self.scaled_by[1]
            .nominal
            .powi(self.columns[place].power_of_length())
    }

    /// Returns the solved tearing variables.
    pub fn pose(&self, registers: &[f64]) -> DVector<f64> {
        vector(&self.tears[0], registers)
    }
}

fn vector(places: &[Register], registers: &[f64]) -> DVector<f64> {
    DVector::from_iterator(places.len(), places.iter().map(|it| registers[it.index()]))
}

impl ScaledBy {
    fn new(lengths: &Lengths, writer: &mut Writer<'_>) -> ScaledBy {
        let following = lengths.following.as_ref();
        ScaledBy {
            following: following.map(|function| Part::new(function, writer)),
            nominal: lengths.nominal,
        }
    }

    fn length(&self, code: &Code, registers: &mut [f64]) -> f64 {
        let Some(Part {
            operations,
            results,
        }) = &self.following
        else {
            return self.nominal;
        };
        // The function does not depend on time and cannot fail.
        let ran = operations
            .iter()
            .all(|it| run(it, code, registers, 0.0, 0).is_ok());
        let lengths = results.iter().map(|it| registers[it.index()].abs());
        let largest = if ran {
            lengths.fold(0.0, f64::max)
        } else {
            0.0
        };
        match largest > 0.0 && largest.is_finite() {
            true => largest,
            false => self.nominal,
        }
    }
}

impl Part {
    pub fn new(function: &Function, writer: &mut Writer<'_>) -> Part {
        let (operations, results) = writer.function(function);
        Part {
            operations,
            results,
        }
    }
}

/// Equations of a block at one instant.
pub(crate) struct NewtonEquations<'a> {
    pub newton: &'a Newton,
    code: &'a Code,
    registers: RefCell<&'a mut [f64]>,
    lengths: [f64; 2],
    count: &'a dyn Fn(),
}

impl NewtonEquations<'_> {
    /// Writes the solved tearing variables.
    pub fn set(&self, frame: &Frame<f64, Dyn>) {
        let levels = [&frame.q, &frame.qd, &frame.qdd];
        for (places, values) in self.newton.tears.iter().zip(levels) {
            self.write(places, values);
        }
    }

    /// Counts an evaluation of the residual.
    pub fn count(&self) {
        (self.count)();
    }

    /// Returns the values of registers.
    pub fn read(&self, places: &[Register]) -> Vec<f64> {
        let registers = &*self.registers.borrow();
        places.iter().map(|it| registers[it.index()]).collect()
    }

    /// Returns the results of a function whose arguments are written; `None` if it fails.
    pub fn results(&self, part: &Part, t: f64) -> Option<Vec<f64>> {
        let registers = &mut *self.registers.borrow_mut();
        let mut operations = part.operations.iter();
        let ran = operations.all(|it| run(it, self.code, registers, t, 0).is_ok());
        let results = part.results.iter().map(|it| registers[it.index()]);
        ran.then(|| results.collect())
    }

    /// Writes values.
    pub fn write(&self, places: &[Register], values: &DVector<f64>) {
        let registers = &mut *self.registers.borrow_mut();
        for (place, value) in places.iter().zip(values.iter()) {
            registers[place.index()] = *value;
        }
    }

    /// Evaluates a function for these tearing variables.
    fn evaluate(&self, part: &Part, t: f64, tears: &DVector<f64>, mut see: impl FnMut(usize, f64)) {
        self.write(&self.newton.tears[0], tears);
        let registers = &mut *self.registers.borrow_mut();
        let mut operations = part.operations.iter();
        let ran = operations.all(|it| run(it, self.code, registers, t, 0).is_ok());
        for (place, result) in part.results.iter().enumerate() {
            see(
                place,
                if ran {
                    registers[result.index()]
                } else {
                    f64::NAN
                },
            );
        }
    }
}

impl Equations<f64, Dyn> for NewtonEquations<'_> {
    fn dimension(&self) -> Dyn {
        Dyn(self.newton.columns.len())
    }

    fn residual(&self, q: &DVector<f64>, t: f64, phi: &mut DVector<f64>) {
        (self.count)();
        self.evaluate(&self.newton.residual, t, q, |row, value| phi[row] = value);
    }

    fn jacobian(&self, q: &DVector<f64>, t: f64, phi_q: &mut DMatrix<f64>) {
        let columns = self.newton.columns.len();
        let see = |place: usize, value| phi_q[(place / columns, place % columns)] = value;
        self.evaluate(&self.newton.jacobian, t, q, see);
    }

    fn time_derivative(&self, q: &DVector<f64>, t: f64, phi_t: &mut DVector<f64>) {
        self.evaluate(&self.newton.time_derivative, t, q, |row, value| {
            phi_t[row] = value
        });
    }

    fn gamma(&self, q: &DVector<f64>, qd: &DVector<f64>, t: f64, gamma: &mut DVector<f64>) {
        self.write(&self.newton.tears[1], qd);
        self.evaluate(&self.newton.gamma, t, q, |row, value| gamma[row] = value);
    }

    fn row_scale(&self, row: usize) -> f64 {
        self.lengths[0].powi(self.newton.rows[row].power_of_length())
    }

    fn coordinate_scale(&self, column: usize) -> f64 {
        self.lengths[1].powi(self.newton.columns[column].power_of_length())
    }

    fn is_angle(&self, column: usize) -> bool {
        self.newton.is_angle[column]
    }
}
