//! Names the load that is not finite in a frame, or else the block.

use linkwright_codegen::stages::expr::{ExprId, SymbolId};
use linkwright_codegen::stages::pool::Pool;
use linkwright_codegen::stages::program::Statement;
use linkwright_codegen::stages::system::System;

use crate::instant::{Instant, Layout};
use crate::interpreted::Interpreted;
use crate::reader::Reader;
use crate::view::View;

/// Returns the first load that is not finite at an instant, as the description writes it; `None` if all are finite.
pub fn load(pool: &Pool, system: &System, layout: &Layout, instant: &Instant) -> Option<String> {
    let loads = Loads::of(pool, system, layout)?;
    let values = loads.reader.values(instant);
    loads.label(system, values.iter().position(|value| !value.is_finite())?)
}

/// Returns the first load that grows from one instant to another by more than a ratio; `None` if none does.
pub(crate) fn growing(
    pool: &Pool,
    system: &System,
    layout: &Layout,
    instants: [&Instant; 2],
    ratio: f64,
) -> Option<String> {
    let loads = Loads::of(pool, system, layout)?;
    let [before, after] = instants.map(|instant| loads.reader.values(instant));
    let mut pairs = before.iter().zip(&after);
    let place =
        pairs.position(|(before, after)| after.abs() > ratio * before.abs() && *before != 0.0);
    loads.label(system, place?)
}

/// Components of all loads.
struct Loads {
    reader: Reader,
    /// Number of components of each load.
    counts: Vec<usize>,
}

impl Loads {
    /// Returns the components; `None` if the mechanism has no loads.
    fn of(pool: &Pool, system: &System, layout: &Layout) -> Option<Loads> {
        let mut pool = pool.draft();
        let forces = system.forces.as_ref()?;
        let parts = forces.exerted.iter().flatten().map(|part| {
            let part = pool.graph.substitute(*part, &forces.lengths);
            pool.written_out(part)
        });
        let parts: Vec<ExprId> = parts.collect();
        Some(Loads {
            reader: Reader::new(&pool.graph, layout, &parts),
            counts: forces.exerted.iter().map(Vec::len).collect(),
        })
    }

    /// Returns the label of the load with a component.
    fn label(&self, system: &System, component: usize) -> Option<String> {
        let mut ends = self.counts.iter().scan(0, |end, count| {
            *end += count;
            Some(*end)
        });
        let load = ends.position(|end| component < end)?;
        let load = system.mechanism.forces.loads.get(load)?;
        Some(load.label.clone())
    }
}

/// Describes the first block with a result that is not finite; `None` if all are finite.
pub(crate) fn block(view: &Interpreted, instant: &Instant) -> Option<String> {
    let layout = view.layout();
    let is_infinite = |symbol: &SymbolId| {
        let slot = layout.slot(*symbol);
        slot.is_some_and(|slot| !instant.values()[slot].is_finite())
    };
    let blocks = &view.program().blocks;
    let place = blocks.iter().position(|block| {
        let statements = block.function.statements.iter();
        statements
            .flat_map(found)
            .any(|symbol| is_infinite(&symbol))
    })?;
    let words = view.compiled().words.get(place)?;
    Some(words.name.clone())
}

/// Returns the symbols that a statement of a block computes.
fn found(statement: &Statement) -> Vec<SymbolId> {
    match statement {
        Statement::Let { target, .. } | Statement::Angle { target, .. } => vec![*target],
        Statement::SineCosine { sine, cosine, .. } => vec![*sine, *cosine],
        Statement::Lookup { targets, .. } => targets.iter().flatten().copied().collect(),
        Statement::Newton { found, .. } => found.concat(),
        Statement::Solve { targets, .. }
        | Statement::Multipliers { targets, .. }
        | Statement::Friction { targets, .. } => targets.iter().flatten().copied().collect(),
        _ => Vec::new(),
    }
}
