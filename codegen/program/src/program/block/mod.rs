//! Represents a block of the plan as functions: positions, then rates, then accelerations, then responses to each direction.

mod definitions;
mod lowering;
mod newton;

pub(super) use lowering::Lowering;
pub use newton::NewtonBlock;

use std::sync::Arc;

use super::forms::{Form, Transposed};
use super::function::{Function, Statement};
use crate::expr::{IdMap, IdSet, SymbolId};

/// Function of one block.
#[derive(Clone, Debug)]
pub struct Block {
    /// Name: solution method and closed joints.
    pub name: String,
    /// Title: solution methods of its subsystems, and the statements that the block uses.
    pub title: String,
    /// Index of the solved block of the plan; `None` if the block only follows from others.
    pub place: Option<usize>,
    /// Joints whose equations the block uses.
    pub joints: Vec<usize>,
    /// Solution methods of the subsystems.
    pub forms: Vec<Arc<dyn Form>>,
    /// Statements of the block.
    pub function: Function,
    /// Equations of Newton-Raphson; `None` if the block does not need it.
    pub newton: Option<NewtonBlock>,
    /// Distances of the subsystems from singular poses, in their order, if a `monitor` statement requests them.
    pub measured: Vec<Measured>,
    /// Jacobians of the subsystems, if multipliers are requested.
    pub(super) transposed: Vec<Option<Transposed>>,
    /// Names of local values in derivations that differ from those in code; only looked up.
    pub page_names: IdMap<SymbolId, PageName>,
    /// Local values that derivations expand wherever they occur; only looked up.
    pub written_out: IdSet<SymbolId>,
}

/// Name of a local value in a derivation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PageName {
    /// Component x (0) or y (1) of a vector.
    Component(String, usize),
    /// Cosine of an unknown.
    Cosine(usize),
    /// Sine of an unknown.
    Sine(usize),
}

/// Assembly mode of a closed form.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
    /// Name in generated code.
    pub name: String,
    /// Symbol that is +1 or −1.
    pub symbol: SymbolId,
    /// Index of its block of the plan.
    pub block: usize,
    /// Value with the mode's sign in the design configuration: the sine of the angle between the links of the closed form, or
    /// NaN.
    pub drawn: f64,
    /// Description of the two modes.
    pub meaning: String,
}

impl Branch {
    /// True if the mode is positive in the design configuration, or undecided there.
    pub fn is_positive(&self) -> bool {
        self.drawn.is_nan() || self.drawn >= 0.0
    }
}

/// Fields for the distance of a subsystem from singular poses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measured {
    /// Sine of the angle between the two vectors of a closed form.
    Sine(SymbolId),
    /// Coefficient of a linear subsystem.
    Slope(SymbolId),
    /// Determinant of a Newton block with columns of length 1, and its reciprocal condition number.
    Block([SymbolId; 2]),
}

impl Measured {
    /// Returns the fields.
    pub fn fields(&self) -> Vec<SymbolId> {
        match self {
            Measured::Sine(field) | Measured::Slope(field) => vec![*field],
            Measured::Block(both) => both.to_vec(),
        }
    }
}

impl Block {
    /// Returns a block that only follows from earlier blocks.
    pub(super) fn following(name: &str, title: &str, statements: Vec<Statement>) -> Block {
        Block {
            name: name.to_string(),
            title: title.to_string(),
            place: None,
            joints: Vec::new(),
            forms: Vec::new(),
            function: Function {
                statements,
                ..Function::default()
            },
            newton: None,
            measured: Vec::new(),
            transposed: Vec::new(),
            page_names: IdMap::default(),
            written_out: IdSet::default(),
        }
    }

    /// Returns all functions of the block, including those of Newton-Raphson.
    pub fn functions(&self) -> impl Iterator<Item = &Function> {
        let newton = self.newton.iter();
        let lengths = newton.clone().flat_map(|it| &it.scaled_by);
        let lengths = lengths.filter_map(|it| it.following.as_ref());
        let newton = newton.flat_map(NewtonBlock::functions);
        [&self.function].into_iter().chain(newton).chain(lengths)
    }

    /// Returns the functions for changes, except for the scales of Newton-Raphson.
    pub(super) fn functions_mut(&mut self) -> impl Iterator<Item = &mut Function> {
        let newton = self.newton.iter_mut().flat_map(NewtonBlock::functions_mut);
        [&mut self.function].into_iter().chain(newton)
    }
}
