//! A block of the plan → its function: positions, then rates, then accelerations, then responses to each direction.

mod definitions;
mod lowering;
mod newton;

pub(super) use lowering::Lowering;
pub use newton::NewtonBlock;

use std::sync::Arc;

use super::forms::{Form, Transposed};
use super::function::{Function, Statement};
use crate::expr::{IdMap, IdSet, SymbolId};

/// The function of one block.
#[derive(Clone, Debug)]
pub struct Block {
    /// Its name: how it is solved, and the joints it closes.
    pub name: String,
    /// How its parts are solved, and the statements it uses.
    pub title: String,
    /// The block of the plan that it solves, from 0; `None` for what only follows from the blocks.
    pub place: Option<usize>,
    /// The joints whose equations it uses.
    pub joints: Vec<usize>,
    /// How the parts of the block are solved.
    pub forms: Vec<Arc<dyn Form>>,
    /// What it does.
    pub function: Function,
    /// The equations of its Newton-Raphson, where it needs it.
    pub newton: Option<NewtonBlock>,
    /// How far its parts are from singular, where a `monitor` statement asks for it, in their order.
    pub measured: Vec<Measured>,
    /// The Jacobians of its parts, where somebody asks for multipliers.
    pub(super) transposed: Vec<Option<Transposed>>,
    /// Local values that a page calls otherwise than the code; only looked up.
    pub page_names: IdMap<SymbolId, PageName>,
    /// Local values that a page writes out wherever they occur; only looked up.
    pub written_out: IdSet<SymbolId>,
}

/// What a page calls a local value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PageName {
    /// The component x (0) or y (1) of a vector.
    Component(String, usize),
    /// The cosine of an unknown.
    Cosine(usize),
    /// The sine of an unknown.
    Sine(usize),
}

/// An assembly mode.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
    /// Its name in the generated code.
    pub name: String,
    /// The symbol that is +1 or −1.
    pub symbol: SymbolId,
    /// The block of the plan that it belongs to, from 0.
    pub block: usize,
    /// What has its sign in the drawing: the sine of the angle between what the form turns, or NaN.
    pub drawn: f64,
    /// What its sign tells apart.
    pub meaning: String,
}

impl Branch {
    /// Whether it is positive in the drawing; also where the drawing says nothing.
    pub fn is_positive(&self) -> bool {
        self.drawn.is_nan() || self.drawn >= 0.0
    }
}

/// The fields that hold how far a part is from singular.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measured {
    /// The sine of the angle between the two vectors of a closed form.
    Sine(SymbolId),
    /// The coefficient of a linear part.
    Slope(SymbolId),
    /// The determinant of a Newton block with columns of length 1, and its reciprocal condition.
    Block([SymbolId; 2]),
}

impl Measured {
    /// Its fields.
    pub fn fields(&self) -> Vec<SymbolId> {
        match self {
            Measured::Sine(field) | Measured::Slope(field) => vec![*field],
            Measured::Block(both) => both.to_vec(),
        }
    }
}

impl Block {
    /// A block that only follows from those before it.
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

    /// All its functions: its own, and those of its Newton-Raphson.
    pub fn functions(&self) -> impl Iterator<Item = &Function> {
        let newton = self.newton.iter();
        let lengths = newton.clone().flat_map(|it| &it.scaled_by);
        let lengths = lengths.filter_map(|it| it.following.as_ref());
        let newton = newton.flat_map(NewtonBlock::functions);
        [&self.function].into_iter().chain(newton).chain(lengths)
    }

    /// The same without what scales its Newton-Raphson, to be changed.
    pub(super) fn functions_mut(&mut self) -> impl Iterator<Item = &mut Function> {
        let newton = self.newton.iter_mut().flat_map(NewtonBlock::functions_mut);
        [&mut self.function].into_iter().chain(newton)
    }
}
