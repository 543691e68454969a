//! A block → what its function must be given, and whether it can fail.

use super::Module;
use super::scope::{Place, Scope};
use crate::expr::SymbolId;
use crate::program::{Block, Statement};

/// What a block's function needs to be given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::emit) struct Needs {
    pub last: bool,
    pub branches: bool,
    /// Whether it finds its own mode.
    pub finds_branch: bool,
    /// Time, parameters, inputs, settings and what the last frame is.
    pub conditions: bool,
    /// Whether a failure says the time.
    pub time: bool,
    pub fails: bool,
}

impl Needs {
    pub(in crate::emit) fn of(block: &Block, module: &Module<'_>) -> Needs {
        let scope = Scope::new(module, &block.function, Place::Frame);
        let reads = scope.reads();
        let newton = block.newton.is_some();
        let has = |wanted: fn(&Statement) -> bool| block.function.statements.iter().any(wanted);
        let checks = has(|it| {
            matches!(
                it,
                Statement::Reach { .. }
                    | Statement::Nonzero { .. }
                    | Statement::Positive { .. }
                    | Statement::Multipliers { .. }
            )
        });
        let fails = newton || checks || module.is_large();
        Needs {
            last: newton || has(|it| matches!(it, Statement::Angle { .. })),
            branches: newton || reads.branches,
            finds_branch: newton,
            time: checks || module.is_large() || reads.time,
            conditions: fails || reads.time || reads.parameters || reads.inputs,
            fails,
        }
    }
}

/// The numbers of a block that are looked at before the next one is solved: those of a frame of thousands of coordinates are not
/// looked through at once, because the compiler would turn it into as many local values.
pub(in crate::emit) fn checked_at_once(block: &Block, scope: &Scope<'_>) -> Vec<SymbolId> {
    let found = block.function.targets();
    found.filter(|&symbol| scope.is_field(symbol)).collect()
}
