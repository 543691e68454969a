//! Lowers all blocks of a plan, and the other requests of the mechanism.

mod needed;
mod reported;
mod stated;

use std::sync::Arc;

use super::block::{Block, Branch, Lowering};
use super::forces::forces;
use super::forms::{Form, recognize};
use super::function::Function;
use super::loads::loads;
use super::passes::fields::fields;
use super::passes::liveness::prune;
use super::passes::sharing::{share, share_all};
use super::passes::zeros::propagate;
use super::path::Path;
use super::requirements::requirements;
use super::textbook::Textbook;
use super::{Constants, Program};
use crate::expr::{ExprId, IdSet, SymbolId};
use crate::structure::SolvedPlan;
use crate::system::System;
use needed::Needed;
use reported::reported;
use stated::Stated;

/// Returns all functions of a mechanism. The system's arena grows by intermediate values.
pub fn lower(system: &mut System, plan: &SolvedPlan) -> Program {
    lower_keeping(system, plan, &IdSet::default())
}

/// Returns all functions, with every unknown of the vector form in frames, including rate and acceleration.
pub fn lower_with_unknowns(system: &mut System, plan: &SolvedPlan) -> Program {
    let unknowns = system.vector_form.unknowns.iter();
    let kept = unknowns.flat_map(|it| [it.position, it.rate, it.acceleration]);
    let kept = kept.collect();
    lower_keeping(system, plan, &kept)
}

fn lower_keeping(system: &mut System, plan: &SolvedPlan, kept: &IdSet<SymbolId>) -> Program {
    let mut lowering = Lowering::new(system, false);
    let stated = Stated::of(&mut lowering, plan, kept);
    let mut needed = stated.needed(&mut lowering, plan);
    let branches = lowering.branches;
    share_blocks(&mut needed.blocks, system);
    let report = reported(&stated, &mut needed, system);
    let Needed {
        blocks,
        asked,
        path,
    } = needed;
    let branches = read_branches(branches, &blocks, system);
    let branch_places = branches.iter().enumerate();
    let is_whole = stated.outputs.is_none();
    let fields = fields(&blocks, &asked, is_whole, system);
    let mut program = Program {
        field_set: fields.iter().copied().collect(),
        branch_places: branch_places
            .map(|(place, branch)| (branch.symbol, place))
            .collect(),
        path,
        requirements: requirements(system),
        textbook: Textbook::of(system),
        drawn: drawn(system),
        // If there are outputs, points are computed in blocks.
        points: match is_whole {
            true => points(system),
            false => Vec::new(),
        },
        pressures: match is_whole {
            true => pressures(system),
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
        report,
    };
    program.loads = loads(system, &program);
    let mut constants = Constants::new(system);
    for function in program.functions() {
        constants.note(function, system);
    }
    program.constants = constants;
    program
}

/// Returns the assembly modes that the blocks read.
fn read_branches(mut branches: Vec<Branch>, blocks: &[Block], system: &System) -> Vec<Branch> {
    let read: IdSet<SymbolId> = blocks
        .iter()
        .flat_map(Block::functions)
        .flat_map(Function::values)
        .flat_map(|expr| system.mechanism.graph.symbols(expr))
        .copied()
        .collect();
    branches.retain(|branch| read.contains(&branch.symbol));
    branches
}

fn share_blocks(blocks: &mut [Block], system: &mut System) {
    for function in blocks.iter_mut().flat_map(Block::functions_mut) {
        share(function, system);
    }
}

/// Returns the functions of all blocks without omissions and with derivations, for printing or interpretation. Unneeded values
/// are computed too, so that every unknown of the vector form has its position and rate. If forces are requested, their block
/// comes last.
pub fn unpruned(system: &mut System, plan: &SolvedPlan) -> (Vec<Block>, Vec<Branch>) {
    let mut lowering = Lowering::new(system, true);
    let blocks = plan.blocks.iter().enumerate();
    let mut blocks: Vec<Block> = blocks
        .map(|(place, block)| lowering.block(place, block))
        .collect();
    let transposed: Vec<_> = blocks.iter().map(|it| it.transposed.clone()).collect();
    let (forces, exerting) = forces(&mut lowering, plan, &transposed).unzip();
    let branches = lowering.branches;
    blocks.extend(exerting);
    propagate(&mut blocks, &mut system.mechanism.graph);
    if let (Some(forces), Some(block)) = (forces, blocks.last_mut()) {
        // Unrequested loads are not part of the derivation.
        let fields: IdSet<SymbolId> = forces.fields().into_iter().collect();
        let only_block = std::slice::from_mut(block);
        prune(
            only_block,
            &|symbol| fields.contains(&symbol),
            &system.mechanism.graph,
        );
    }
    (blocks, branches)
}

/// Returns the solution methods of the subsystems of each block of a plan.
pub fn forms_of(system: &mut System, plan: &SolvedPlan) -> Vec<Vec<Arc<dyn Form>>> {
    let blocks = plan.blocks.iter();
    blocks
        .map(|block| {
            let parts = block.parts.iter();
            parts.map(|part| recognize(part, system)).collect()
        })
        .collect()
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
pub(super) fn shared(results: impl IntoIterator<Item = ExprId>, system: &mut System) -> Function {
    let mut function = Function::of_results(results);
    share_all(&mut function, system);
    function
}

/// Returns the estimates of all unknowns; `None` if none depends on a parameter.
fn drawn(system: &mut System) -> Option<Function> {
    let unknowns = system.vector_form.unknowns.iter();
    let estimates: Vec<ExprId> = unknowns.map(|unknown| unknown.estimate).collect();
    let graph = &system.mechanism.graph;
    let is_given = estimates.iter().any(|&expr| !graph.is_constant(expr));
    is_given.then(|| shared(estimates, system))
}

fn points(system: &mut System) -> Vec<Function> {
    let outputs = system.outputs.iter();
    let motions = outputs.map(|it| [it.position, it.velocity, it.acceleration].concat());
    let motions: Vec<_> = motions.collect();
    motions.into_iter().map(|it| shared(it, system)).collect()
}

fn pressures(system: &mut System) -> Vec<Function> {
    let pressures = system.pressures.iter();
    let parts = pressures.map(|it| [it.along, it.across, it.sliding]);
    let parts: Vec<_> = parts.collect();
    parts.into_iter().map(|it| shared(it, system)).collect()
}
