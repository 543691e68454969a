//! Evaluates the loads that may become infinite, so that a failure names the first one.
//!
//! Frames do not compute these values: they are evaluated after a frame has been rejected.

use super::Program;
use super::function::Function;
use super::lower::shared;
use crate::expr::{ExprId, Graph, IdSet, Node, SymbolId};
use crate::pool::{Pool, SymbolRole};
use crate::system::{Forces, System};

/// Loads that may be the cause of a rejected frame.
#[derive(Clone, Debug)]
pub struct Loads {
    /// Sum of the magnitudes of each load's components, finite if the components are.
    pub function: Function,
    /// Symbols of the frame that the function reads, each once.
    pub read: Vec<SymbolId>,
    /// Labels of the loads, as the description writes them.
    pub labels: Vec<String>,
    /// Number of the block that uses the loads.
    pub block: u16,
}

/// Returns the loads that may become infinite and that depend on frames only; `None` if there are none.
pub(super) fn loads(pool: &mut Pool, system: &System, program: &Program) -> Option<Loads> {
    let fields = program.forces.fields();
    let mut blocks = program.blocks.iter();
    let block = blocks.position(|block| block.function.targets().any(|it| fields.contains(&it)))?;
    let forces = system.forces.as_ref()?;
    let (mut labels, mut sums) = (Vec::new(), Vec::new());
    for (load, components) in forces.exerted.iter().enumerate() {
        let graph = &pool.graph;
        let sum = may_be_infinite(components, forces, graph).then(|| sum(components, forces, pool));
        let sum = sum.filter(|&sum| is_held(sum, program, pool, system));
        labels.extend(sum.map(|_| system.mechanism.forces.loads[load].label.clone()));
        sums.extend(sum);
    }
    if sums.is_empty() {
        return None;
    }
    let graph = &pool.graph;
    let mut read: Vec<SymbolId> = Vec::new();
    for &symbol in sums.iter().flat_map(|&sum| graph.symbols(sum)) {
        if !is_given(symbol, pool) && !read.contains(&symbol) {
            read.push(symbol);
        }
    }
    Some(Loads {
        function: shared(sums, pool, system),
        read,
        labels,
        block: u16::try_from(block).unwrap_or(u16::MAX),
    })
}

/// Returns the sum of the magnitudes of the components of a load, in symbols of frames. A component that is the opposite of another
/// counts once.
fn sum(components: &[ExprId], forces: &Forces, pool: &mut Pool) -> ExprId {
    let mut distinct: Vec<ExprId> = Vec::new();
    for &part in components {
        let part = pool.graph.substitute(part, &forces.lengths);
        let part = pool.written_out(part);
        let opposite = pool.graph.negate(part);
        if !distinct.contains(&part) && !distinct.contains(&opposite) {
            distinct.push(part);
        }
    }
    let graph = &mut pool.graph;
    let zero = graph.zero();
    distinct.into_iter().fold(zero, |sum, part| {
        let magnitude = graph.magnitude(part);
        graph.add(sum, magnitude)
    })
}

/// True if an expression divides, takes a root or a logarithm, or raises e to a power. Lengths of springs are nonzero wherever
/// forces are computed.
fn may_be_infinite(components: &[ExprId], forces: &Forces, graph: &Graph) -> bool {
    let is_length = |base: ExprId| {
        let mut lengths = forces.lengths.iter();
        matches!(graph.node(base), Node::Symbol(base) if lengths.any(|(length, _)| length == base))
    };
    let is_risky = |expr: ExprId| match graph.node(expr) {
        Node::Product(factors) => factors.iter().any(|factor| {
            let is_power = factor.exponent.is_integer() && !factor.exponent.is_negative();
            !is_power && !is_length(factor.base)
        }),
        Node::Exp(_) | Node::Ln(_) => true,
        _ => false,
    };
    let (mut open, mut seen) = (components.to_vec(), IdSet::default());
    while let Some(expr) = open.pop() {
        if is_risky(expr) {
            return true;
        }
        if seen.insert(expr) {
            open.extend(graph.operands(expr));
        }
    }
    false
}

/// True if each symbol of an expression is an input of a frame or kept by the frame.
fn is_held(expr: ExprId, program: &Program, pool: &Pool, system: &System) -> bool {
    let mut symbols = pool.graph.symbols(expr).iter();
    symbols.all(|&symbol| {
        let is_coordinate = program.outputs.is_none() && system.is_coordinate(symbol, pool);
        is_given(symbol, pool) || is_coordinate || program.is_field(symbol)
    })
}

/// True if a symbol is time, a parameter or an input.
fn is_given(symbol: SymbolId, pool: &Pool) -> bool {
    use SymbolRole::{Input, Parameter, Time};
    matches!(pool.role(symbol), Time | Parameter(_) | Input { .. })
}
