//! The joints of a mechanism → what must be positive whatever its parameters are.
//!
//! What a description may not say of a length or of a ratio is refused when it is read where it is a constant, and by the runtime where
//! parameters change it.

use super::function::Function;
use super::passes::sharing::share_all;
use crate::expr::SymbolId;
use crate::system::{SymbolRole, System};

/// What parameters must leave positive.
#[derive(Clone, Debug)]
pub struct Requirements {
    /// The values, as functions of parameters alone.
    pub function: Function,
    /// The joint of each value, an index into those of the mechanism, and what the value is called.
    pub names: Vec<(usize, &'static str)>,
}

/// The requirements of all joints; `None` where no parameter can break one.
pub(super) fn requirements(system: &mut System) -> Option<Requirements> {
    let mut names = Vec::new();
    let mut values = Vec::new();
    let mechanism = &mut system.mechanism;
    for (number, joint) in mechanism.joints.iter().enumerate() {
        let Some((value, name)) = joint.kind.positive(&joint.operands, &mut mechanism.graph) else {
            continue;
        };
        let is_parameter = |symbol: &SymbolId| {
            let role = system.roles.get(symbol.index());
            matches!(role, Some(SymbolRole::Parameter(_)))
        };
        let mut symbols = mechanism.graph.symbols(value).iter();
        if symbols.len() > 0 && symbols.all(is_parameter) && !values.contains(&value) {
            values.push(value);
            names.push((number, name));
        }
    }
    if values.is_empty() {
        return None;
    }
    let mut function = Function::of_results(values);
    share_all(&mut function, system);
    Some(Requirements { function, names })
}
