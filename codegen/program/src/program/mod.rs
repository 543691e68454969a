//! System and SolvedPlan → Program.
//!
//! Everything that is computed is a [`Function`]: Φ and what is derived from it, the blocks of the solution, the equations of their
//! Newton-Raphson, points, responses. [`forms`] say how the parts of a block are solved; [`passes`] share, prune, name and count what
//! they state, whatever it is. Afterwards everything is defined before it is used, nothing is computed that nobody asks for, every
//! angle has one sine and one cosine, and what is known to be zero is not multiplied. Deliberately unknown here: any output
//! language, and what the results mean.

mod addends;
mod arithmetic;
mod block;
mod builder;
mod directional_derivatives;
mod forces;
pub mod forms;
mod function;
mod lengths;
mod loads;
mod lower;
mod outputs;
pub mod passes;
mod path;
mod pin_motion;
mod prose;
mod requirements;
mod sensitivities;
mod stretch;
mod tearing;
mod textbook;
mod transmissions;
mod two_links;

pub use addends::{Addend, Compared, Power, addends, compared};
pub use arithmetic::{Arithmetic, Choice, Elementary, Evaluation};
pub use block::{Block, Branch, Measured, NewtonBlock, PageName};
pub use forces::{Effort, Energy, Forces, FreeCoordinate, Reaction, Reduced};
pub use forms::{DrawnMode, sign_of};
pub use function::{Function, Level, Statement};
pub use lengths::Lengths;
pub use loads::Loads;
pub use lower::{forms_of, lower, lower_with_unknowns, unpruned};
pub use outputs::Output;
pub use passes::constants::{ConstantPart, Constants};
pub use passes::costs::{LARGEST_PRODUCT, Operations};
pub use passes::iterations::{BEYOND_STEPS, EVALUATIONS, Iterations, STEPS};
pub use passes::work::{self, Work};
pub use path::Path;
pub use requirements::Requirements;
pub use sensitivities::{Found, SensitiveQuantity, Sensitivity};
pub use tearing::{Tearing, TornFields};
pub use textbook::{LARGEST_TEXTBOOK, Textbook};
pub use transmissions::Transmission;

use std::sync::Arc;

use crate::expr::{IdMap, IdSet, SymbolId};
use forms::Form;

/// What is emitted for a mechanism.
#[derive(Clone, Debug)]
pub struct Program {
    /// The functions of the solved view, in solve order.
    pub blocks: Vec<Block>,
    /// How the parts of each block of the plan are solved, whether or not the block is kept.
    pub forms: Vec<Vec<Arc<dyn Form>>>,
    /// Values that more than one block uses, in order of definition; coordinates of a frame that holds all of them apart.
    pub fields: Vec<SymbolId>,
    /// The assembly modes of all closed forms that have one.
    pub branches: Vec<Branch>,
    /// What is asked for; `None` where everything is.
    pub outputs: Option<Vec<Output>>,
    /// What the drivers transmit, in written order.
    pub transmissions: Vec<Transmission>,
    /// How the motion depends on parameters, in written order.
    pub sensitivities: Vec<Sensitivity>,
    /// What drivers exert, what joints carry, and what is stored, as far as it is asked for.
    pub forces: Forces,
    /// What was kept and left out.
    pub report: Report,
    /// The constants of all functions that are no short decimals, each once.
    pub constants: Constants,
    /// The functions of the textbook view; left out of mechanisms whose dense matrices fit no stack.
    pub textbook: Option<Textbook>,
    /// The drawing's value of every unknown of the vector form, where parameters change it.
    pub drawn: Option<Function>,
    /// The motion of each point: position, velocity, acceleration, x and y each. Empty where single outputs are asked for.
    pub points: Vec<Function>,
    /// What each pressure angle follows from: the velocity along and across the normal, and the square of the sliding speed.
    /// Empty where single outputs are asked for.
    pub pressures: Vec<Function>,
    /// Loads among which the cause of a refused frame is found; `None` if none may become infinite.
    pub loads: Option<Loads>,
    /// What parameters must leave positive; `None` where none can do else.
    pub requirements: Option<Requirements>,
    /// What shows that frames lie on their path; `None` where nobody asks.
    pub path: Option<Path>,
    // The fields and branches by symbol; only looked up.
    field_set: IdSet<SymbolId>,
    branch_places: IdMap<SymbolId, usize>,
}

impl Program {
    /// The number of the block that solves this one of the plan.
    pub fn number_of(&self, place: usize) -> u16 {
        let number = self
            .blocks
            .iter()
            .position(|block| block.place == Some(place));
        number.map_or(0, |number| u16::try_from(number).unwrap_or(u16::MAX))
    }

    /// What shows that frames lie on their path where all blocks are closed forms.
    pub fn closed_path(&self) -> Option<&Function> {
        self.path.as_ref()?.closed.as_ref()
    }

    /// Whether a value that is no coordinate is kept in the frame.
    pub fn is_field(&self, symbol: SymbolId) -> bool {
        self.field_set.contains(&symbol)
    }

    /// The assembly mode whose sign a symbol stands for.
    pub fn branch_of(&self, symbol: SymbolId) -> Option<&Branch> {
        self.branch_places
            .get(&symbol)
            .map(|&place| &self.branches[place])
    }
}

/// What the solved view computes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Report {
    /// The blocks that are kept, in solve order.
    pub kept: Vec<String>,
    /// The blocks that nothing asks for.
    pub left_out: Vec<String>,
    /// Angles whose sine and cosine suffice.
    pub angles_left_out: Vec<String>,
    /// The operations of each level: position, velocity, acceleration. Those inside Newton-Raphson are not counted.
    pub operations: [Operations; 3],
    /// The same with nothing left out.
    pub all_operations: [Operations; 3],
    /// What Newton-Raphson takes in blocks without a closed form.
    pub iterations: Vec<Iterations>,
    /// What the transmissions take beside the pose; `None` where there are none.
    pub transmission: Option<Operations>,
    /// What the sensitivities take beside pose and rates; `None` where there are none.
    pub sensitivity: Option<Operations>,
    /// What the forces take beside pose, rates and accelerations; `None` where none is asked for.
    pub forces: Option<Operations>,
    /// What one call of `advance` takes at most.
    pub work: Work,
}
