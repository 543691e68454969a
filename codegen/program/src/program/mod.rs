//! Lowers a solved plan to functions of statements.
//!
//! Functions compute Φ and its derivatives, the blocks of the solution, the equations of their Newton-Raphson, points and
//! responses. [`forms`] has the solution methods of subsystems. [`passes`] share, prune, name and count statements of any kind.
//!
//! In a [`Program`], every symbol is defined before its use, and every computed value is requested. Every angle has one sine and
//! one cosine. No statement multiplies by a known zero.

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
mod measures;
mod outputs;
pub mod passes;
mod path;
mod pin_motion;
mod prose;
mod quantities;
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
pub use forces::{Effort, Energy, Forces, FreeCoordinate, Reaction, Reduced, Resistance};
pub use forms::{DrawnMode, sign_of};
pub use function::{Function, Level, Statement};
pub use lengths::Lengths;
pub use loads::Loads;
pub use lower::{Kept, lower};
pub use measures::Measure;
pub use outputs::Output;
pub use passes::constants::{Constant, ConstantPart, Constants};
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

/// Functions that solve a mechanism, and everything else that is emitted for it.
#[derive(Clone, Debug, Default)]
pub struct Program {
    /// Functions of the solved formulation, in solve order.
    pub blocks: Vec<Block>,
    /// Solution methods of the subsystems of each block of the plan, including blocks that are not kept.
    pub forms: Vec<Vec<Arc<dyn Form>>>,
    /// Values that several blocks use, in order of definition; without coordinates if the frame holds all coordinates separately.
    pub fields: Vec<SymbolId>,
    /// Assembly modes of all closed forms that have one.
    pub branches: Vec<Branch>,
    /// Requested outputs; `None` if all are requested.
    pub outputs: Option<Vec<Output>>,
    /// Transmissions of the drivers, in written order.
    pub transmissions: Vec<Transmission>,
    /// Sensitivities of the motion to parameters, in written order.
    pub sensitivities: Vec<Sensitivity>,
    /// Driving forces, reactions and stored energy, as far as they are requested.
    pub forces: Forces,
    /// Requested measures, in written order.
    pub measures: Vec<Measure>,
    /// Kept and omitted calculations, with their costs.
    pub report: Report,
    /// Constants of all functions, each once, except for short decimals.
    pub constants: Constants,
    /// Functions of the textbook formulation; `None` if its dense matrices exceed the stack.
    pub textbook: Option<Textbook>,
    /// Design value of every unknown of the vector form; `None` if no parameter changes them.
    pub drawn: Option<Function>,
    /// Motion of each point: position, velocity, acceleration, x and y each. Empty if single outputs are requested.
    pub points: Vec<Function>,
    /// Terms of each pressure angle: velocity along and across the normal, and the squared sliding speed. Empty if single outputs
    /// are requested.
    pub pressures: Vec<Function>,
    /// Loads that may cause a rejected frame; `None` if none can become infinite.
    pub loads: Option<Loads>,
    /// Expressions of parameters that must be positive; `None` if all always are.
    pub requirements: Option<Requirements>,
    /// Verification that frames stay on their path; `None` if it is not requested.
    pub path: Option<Path>,
    // Symbols of fields and branches; only looked up.
    field_set: IdSet<SymbolId>,
    branch_places: IdMap<SymbolId, usize>,
}

impl Program {
    /// Returns the number of the block that solves the given block of the plan.
    pub fn number_of(&self, place: usize) -> u16 {
        let number = self
            .blocks
            .iter()
            .position(|block| block.place == Some(place));
        number.map_or(0, |number| u16::try_from(number).unwrap_or(u16::MAX))
    }

    /// Returns the path verification if all blocks are closed forms; otherwise `None`.
    pub fn closed_path(&self) -> Option<&Function> {
        self.path.as_ref()?.closed.as_ref()
    }

    /// True if the frame keeps a value that is not a coordinate.
    pub fn is_field(&self, symbol: SymbolId) -> bool {
        self.field_set.contains(&symbol)
    }

    /// Returns the assembly mode whose sign the symbol is; `None` if the symbol is not a sign.
    pub fn branch_of(&self, symbol: SymbolId) -> Option<&Branch> {
        self.branch_places
            .get(&symbol)
            .map(|&place| &self.branches[place])
    }
}

/// Calculations of the solved formulation, with their costs.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Report {
    /// Names of the blocks that are kept, in solve order.
    pub kept: Vec<String>,
    /// Names of the blocks that no output requires.
    pub left_out: Vec<String>,
    /// Angles of which only sine and cosine are computed.
    pub angles_left_out: Vec<String>,
    /// Operations of position, velocity and acceleration. Operations inside Newton-Raphson are not counted.
    pub operations: [Operations; 3],
    /// Operations of these levels if nothing is omitted.
    pub all_operations: [Operations; 3],
    /// Operations of Newton-Raphson in blocks without a closed form.
    pub iterations: Vec<Iterations>,
    /// Operations of transmissions besides the pose; `None` if there are none.
    pub transmission: Option<Operations>,
    /// Operations of sensitivities besides pose and rates; `None` if there are none.
    pub sensitivity: Option<Operations>,
    /// Operations of forces besides pose, rates and accelerations; `None` if none is requested.
    pub forces: Option<Operations>,
    /// Largest work of one call of `advance`.
    pub work: Work,
}
