//! Decides the arguments of a block's function, and whether the function can fail.

use super::Module;
use super::scope::{Place, Scope};
use crate::expr::SymbolId;
use crate::program::{Block, Statement};

/// Arguments and failures of a block's function.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::emit) struct Needs {
    /// True if the function takes the last frame.
    pub last: bool,
    /// True if the function takes the modes.
    pub branches: bool,
    /// True if the function sets its own mode.
    pub finds_branch: bool,
    /// True if the function takes time, parameters, inputs, settings and the kind of the last frame.
    pub conditions: bool,
    /// True if the function reads the time, or a failure reports it.
    pub time: bool,
    /// True if the function can fail.
    pub fails: bool,
}

impl Needs {
    pub(in crate::emit) fn of(block: &Block, module: &Module<'_>) -> Needs {
        let scope = Scope::new(module, &block.function, Place::Frame);
        let reads = scope.reads();
        let newton = block.newton.is_some();
        let has = |test: fn(&Statement) -> bool| block.function.statements.iter().any(test);
        let checks = has(is_check);
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

    /// Returns the needs of the function that solves several mechanisms, in which no failure reports the time.
    pub(in crate::emit) fn in_lanes(block: &Block, module: &Module<'_>) -> Needs {
        let reads = Scope::new(module, &block.function, Place::Lanes).reads();
        Needs {
            time: reads.time,
            conditions: reads.time || reads.parameters || reads.inputs,
            fails: block.function.statements.iter().any(is_check),
            ..Needs::of(block, module)
        }
    }
}

/// Returns the needed ones of arguments, as declared and as passed.
pub(in crate::emit) fn listed<D: Into<String>, const N: usize>(
    arguments: [(bool, D, &str); N],
) -> [String; 2] {
    let needed = arguments.into_iter().filter(|(is_needed, ..)| *is_needed);
    let (declared, passed): (Vec<String>, Vec<&str>) = needed
        .map(|(_, declared, passed)| (declared.into(), passed))
        .unzip();
    [declared.join(", "), passed.join(", ")]
}

fn is_check(statement: &Statement) -> bool {
    matches!(
        statement,
        Statement::Reach { .. }
            | Statement::Nonzero { .. }
            | Statement::Positive { .. }
            | Statement::Multipliers { .. }
            | Statement::Friction { .. }
    )
}

/// Returns the values of a block that a large mechanism checks before it solves the next block. One check of thousands of coordinates
/// would become as many local values in the compiler.
pub(in crate::emit) fn checked_at_once(block: &Block, scope: &Scope<'_>) -> Vec<SymbolId> {
    let targets = block.function.targets();
    targets.filter(|&symbol| scope.is_field(symbol)).collect()
}
