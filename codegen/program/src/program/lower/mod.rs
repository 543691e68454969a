//! Lowers all blocks of a plan, and the other requests of the mechanism.

mod needed;
mod reported;
mod stated;

use super::block::{Block, Branch, Lowering};
use super::forces::{Forces, forces};
use super::forms::recognize;
use super::function::Function;
use super::loads::loads;
use super::measures::MeasureStatements;
use super::passes::fields::fields;
use super::passes::liveness::prune;
use super::passes::sharing::{share, share_all};
use super::passes::zeros::propagate;
use super::path::Path;
use super::requirements::requirements;
use super::textbook::Textbook;
use super::{Constants, Program};
use crate::expr::{ExprId, IdSet, SymbolId};
use crate::pool::Pool;
use crate::structure::SolvedPlan;
use crate::system::{System, Unknown};
use needed::Needed;
use reported::reported;
use stated::Stated;

/// Values that a program keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kept {
    /// None: the program has only the solution methods of the plan.
    Methods,
    /// Values that the description requests.
    Requested,
    /// Requested values, and every unknown of the vector form with rate and acceleration.
    Unknowns,
    /// All values, with remarks: the program has only blocks, as a derivation prints them.
    Everything,
}

/// Returns the functions of a mechanism. Intermediate values are added to the pool.
pub fn lower(pool: &mut Pool, system: &System, plan: &SolvedPlan, kept: Kept) -> Program {
    let kept = match kept {
        Kept::Methods => return methods(pool, system, plan),
        Kept::Everything => return unpruned(pool, system, plan),
        Kept::Requested => IdSet::default(),
        Kept::Unknowns => {
            let unknowns = system.vector_form.unknowns.iter();
            unknowns.flat_map(Unknown::symbols).collect()
        }
    };
    let mut lowering = Lowering::new(pool, system, plan, false);
    let stated = Stated::of(&mut lowering, plan, &kept);
    let mut needed = stated.needed(&mut lowering, plan);
    let branches = lowering.branches;
    share_blocks(&mut needed.blocks, pool, system);
    let report = reported(&stated, &mut needed, pool, system);
    let Needed {
        blocks,
        asked,
        path,
    } = needed;
    let branches = read_branches(branches, &blocks, pool);
    let branch_places = branches.iter().enumerate();
    let is_whole = stated.outputs.is_none();
    let fields = fields(&blocks, &asked, is_whole, pool, system);
    let mut program = Program {
        field_set: fields.iter().copied().collect(),
        branch_places: branch_places
            .map(|(place, branch)| (branch.symbol, place))
            .collect(),
        path,
        requirements: requirements(pool, system),
        textbook: Textbook::of(pool, system),
        drawn: drawn(pool, system),
        // If there are outputs, points are computed in blocks.
        points: match is_whole {
            true => points(pool, system),
            false => Vec::new(),
        },
        pressures: match is_whole {
            true => pressures(pool, system),
            false => Vec::new(),
        },
        loads: None,
        constants: Constants::default(),
        forms: stated.forms,
        blocks,
        fields,
        branches,
        outputs: stated.outputs,
        transmissions: stated.transmissions,
        sensitivities: stated.sensitivities,
        forces: stated.forces,
        measures: stated.measures,
        report,
    };
    program.loads = loads(pool, system, &program);
    let mut constants = Constants::new(pool, system);
    for function in program.functions() {
        constants.note(function, pool, system);
    }
    program.constants = constants;
    program
}

/// Returns the assembly modes that the blocks read.
fn read_branches(mut branches: Vec<Branch>, blocks: &[Block], pool: &Pool) -> Vec<Branch> {
    let read: IdSet<SymbolId> = blocks
        .iter()
        .flat_map(Block::functions)
        .flat_map(Function::values)
        .flat_map(|expr| pool.graph.symbols(expr))
        .copied()
        .collect();
    branches.retain(|branch| read.contains(&branch.symbol));
    branches
}

fn share_blocks(blocks: &mut [Block], pool: &mut Pool, system: &System) {
    for function in blocks.iter_mut().flat_map(Block::functions_mut) {
        share(function, pool, system);
    }
}

/// Returns the functions of all blocks without omissions and with derivations. Unneeded values are computed too, so that every
/// unknown of the vector form has its position and rate. If forces are requested, their block comes last.
fn unpruned(pool: &mut Pool, system: &System, plan: &SolvedPlan) -> Program {
    let mut lowering = Lowering::new(pool, system, plan, true);
    let blocks = plan.blocks.iter().enumerate();
    let mut blocks: Vec<Block> = blocks
        .map(|(place, block)| lowering.block(place, block))
        .collect();
    let forms = blocks.iter().map(|block| block.forms.clone()).collect();
    let transposed: Vec<_> = blocks.iter().map(|it| it.transposed.clone()).collect();
    let (forces, exerting) = forces(&mut lowering, plan, &transposed).unzip();
    let mut measured =
        MeasureStatements::new(lowering.pool, lowering.system, &mut lowering.derivatives);
    let measuring = measured.of_motion();
    let requested = forces.as_ref().map(Forces::fields);
    let forces = forces.unwrap_or_default();
    let measuring_forces = measured.of_forces(&forces, lowering.pool, lowering.system);
    let branches = lowering.branches;
    blocks.extend(exerting);
    propagate(&mut blocks, &mut pool.graph);
    if let (Some(fields), Some(block)) = (requested, blocks.last_mut()) {
        // Unrequested loads are not part of the derivation.
        let fields: IdSet<SymbolId> = fields.into_iter().collect();
        let only_block = std::slice::from_mut(block);
        prune(only_block, &|symbol| fields.contains(&symbol), &pool.graph);
    }
    let fields: IdSet<SymbolId> = measured.measures.iter().map(|it| it.field).collect();
    for mut block in measuring.into_iter().chain(measuring_forces) {
        // Intermediate values of other measures may be fields, so that each block is pruned alone.
        let only_block = std::slice::from_mut(&mut block);
        prune(only_block, &|symbol| fields.contains(&symbol), &pool.graph);
        blocks.push(block);
    }
    Program {
        blocks,
        forms,
        branches,
        ..Program::default()
    }
}

/// Returns the solution methods of the subsystems of each block of a plan.
fn methods(pool: &mut Pool, system: &System, plan: &SolvedPlan) -> Program {
    let blocks = plan.blocks.iter();
    let forms = blocks.map(|block| {
        let parts = block.parts.iter();
        parts.map(|part| recognize(part, pool, system)).collect()
    });
    Program {
        forms: forms.collect(),
        ..Program::default()
    }
}

impl Program {
    /// Returns all functions.
    pub fn functions(&self) -> impl Iterator<Item = &Function> {
        let blocks = self.blocks.iter().flat_map(super::Block::functions);
        let paths = self.path.iter().flat_map(Path::functions);
        let textbook = self.textbook.iter().flat_map(Textbook::functions);
        let others = self.points.iter().chain(&self.pressures);
        let optional = self.drawn.iter();
        let optional = optional.chain(self.requirements.iter().map(|it| &it.function));
        let optional = optional.chain(self.loads.iter().map(|it| &it.function));
        blocks
            .chain(paths)
            .chain(textbook)
            .chain(others)
            .chain(optional)
    }
}

/// Returns a function with these results, in which common subexpressions are shared.
pub(super) fn shared(
    results: impl IntoIterator<Item = ExprId>,
    pool: &mut Pool,
    system: &System,
) -> Function {
    let mut function = Function::of_results(results);
    share_all(&mut function, pool, system);
    function
}

/// Returns the estimates of all unknowns; `None` if none depends on a parameter.
fn drawn(pool: &mut Pool, system: &System) -> Option<Function> {
    let unknowns = system.vector_form.unknowns.iter();
    let estimates: Vec<ExprId> = unknowns.map(|unknown| unknown.estimate).collect();
    let graph = &pool.graph;
    let is_given = estimates.iter().any(|&expr| !graph.is_constant(expr));
    is_given.then(|| shared(estimates, pool, system))
}

fn points(pool: &mut Pool, system: &System) -> Vec<Function> {
    let outputs = system.outputs.iter();
    let motions = outputs.map(|it| [it.position, it.velocity, it.acceleration].concat());
    let motions: Vec<_> = motions.collect();
    motions
        .into_iter()
        .map(|it| shared(it, pool, system))
        .collect()
}

fn pressures(pool: &mut Pool, system: &System) -> Vec<Function> {
    let pressures = system.pressures.iter();
    let parts = pressures.map(|it| [it.along, it.across, it.sliding]);
    let parts: Vec<_> = parts.collect();
    parts
        .into_iter()
        .map(|it| shared(it, pool, system))
        .collect()
}
