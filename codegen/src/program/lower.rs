//! Every block of the plan → its function, and what the mechanism is asked for besides.

use std::collections::{HashMap, HashSet};
use std::sync::Arc;

use super::block::{Block, Lowering, Measured};
use super::forces::forces;
use super::forms::{Form, recognize};
use super::function::{Function, Statement};
use super::outputs::{Output, outputs};
use super::passes::costs::by_level;
use super::passes::fields::fields;
use super::passes::iterations::iterations;
use super::passes::liveness::{prune, prune_path};
use super::passes::sharing::{share, share_all};
use super::passes::zeros::propagate;
use super::path::Path;
use super::requirements::requirements;
use super::sensitivities::{Sensitivity, sensitivities};
use super::textbook::Textbook;
use super::transmissions::{Transmission, transmissions};
use super::{Constants, Program, Report, Work};
use crate::expr::{ExprId, SymbolId};
use crate::joint::Quantity;
use crate::structure::SolvedPlan;
use crate::system::{SymbolRole, System};

/// All functions of a mechanism. The system's arena grows by what is computed on the way.
pub fn lower(system: &mut System, plan: &SolvedPlan) -> Program {
    lower_keeping(system, plan, &HashSet::new())
}

/// The same, and frames hold every unknown of the vector form with its rate and acceleration.
pub fn lower_with_unknowns(system: &mut System, plan: &SolvedPlan) -> Program {
    let unknowns = system.vector_form.unknowns.iter();
    let kept = unknowns.flat_map(|it| [it.position, it.rate, it.acceleration]);
    let kept = kept.collect();
    lower_keeping(system, plan, &kept)
}

fn lower_keeping(system: &mut System, plan: &SolvedPlan, kept: &HashSet<SymbolId>) -> Program {
    let mut lowering = Lowering::new(system, false);
    let mut blocks: Vec<Block> = plan
        .blocks
        .iter()
        .enumerate()
        .map(|(place, block)| lowering.block(place, block))
        .collect();
    let forms = blocks.iter().map(|block| block.forms.clone()).collect();
    let wanted = outputs(lowering.system);
    let (transmissions, transmitting) =
        transmissions(lowering.system, &mut lowering.derivatives).unzip();
    let (sensitivities, sensing) =
        sensitivities(lowering.system, &mut lowering.derivatives).unzip();
    let (transmissions, sensitivities) = (
        transmissions.unwrap_or_default(),
        sensitivities.unwrap_or_default(),
    );
    let transposed: Vec<_> = blocks.iter().map(|it| it.transposed.clone()).collect();
    let (forces, exerting) = forces(&mut lowering, plan, &transposed).unzip();
    let forces = forces.unwrap_or_default();
    // What is known to be zero carries nothing either.
    let exerts = exerting.is_some();
    blocks.extend(exerting);
    propagate(&mut blocks, &mut lowering.system.mechanism.graph);
    let exerting = blocks.pop_if(|_| exerts);
    // What is asked for beside the coordinates.
    let mut asked = kept.clone();
    asked.extend(transmissions.iter().flat_map(Transmission::fields));
    asked.extend(sensitivities.iter().flat_map(Sensitivity::fields));
    asked.extend(forces.fields());
    asked.extend(
        blocks
            .iter()
            .flat_map(|block| &block.measured)
            .flat_map(Measured::fields),
    );
    let (outputs, last) = wanted.unzip();
    asked.extend(outputs.iter().flatten().flat_map(Output::fields));
    blocks.extend(last);
    blocks.extend(transmitting.into_iter().chain(sensing).chain(exerting));
    let mut report = Report::default();
    let is_asked = |symbol: SymbolId, asked: &HashSet<SymbolId>, system: &System| {
        asked.contains(&symbol) || outputs.is_none() && system.is_coordinate(symbol)
    };
    let unpruned = blocks.clone();
    let pruned = |asked: &HashSet<SymbolId>, system: &System| {
        let mut blocks = unpruned.clone();
        prune(
            &mut blocks,
            &|symbol| is_asked(symbol, asked, system),
            &system.mechanism.graph,
        );
        blocks
    };
    let mut blocks = pruned(&asked, lowering.system);
    let mut path = None;
    if !lowering.system.mechanism.is_unguarded {
        // The blocks that are kept must keep to their path, which asks for what shows it.
        let kept: Vec<usize> = blocks
            .iter()
            .filter(|block| !block.function.statements.is_empty())
            .filter_map(|block| block.place)
            .collect();
        let kept = kept.into_iter().map(|place| (place, &plan.blocks[place]));
        let mut found = lowering.path(kept.clone());
        // What Newton-Raphson finds needs its tubes, also where it does not move.
        if blocks.iter().all(|block| block.newton.is_none()) {
            found.closed = lowering.closed_path(kept);
        }
        prune_path(&mut found, &lowering.system.mechanism.graph);
        asked.extend(read_by_path(&found, &unpruned, lowering.system));
        blocks = pruned(&asked, lowering.system);
        for function in found.whole_functions_mut() {
            share_path(function, lowering.system);
        }
        path = Some(found);
    }
    let mut branches = lowering.branches;
    share_blocks(&mut blocks, system);
    report.all_operations.copy_from_slice(
        &match outputs {
            None => by_level(&blocks, system),
            Some(_) => {
                let mut all = unpruned;
                let coordinate = |symbol| system.is_coordinate(symbol) || asked.contains(&symbol);
                prune(&mut all, &coordinate, &system.mechanism.graph);
                share_blocks(&mut all, system);
                by_level(&all, system)
            }
        }[..3],
    );
    let is_empty = |block: &Block| block.function.statements.is_empty();
    report.left_out = blocks
        .iter()
        .filter(|block| is_empty(block) && !block.joints.is_empty())
        .map(|block| block.name.clone())
        .collect();
    blocks.retain(|block| !is_empty(block));
    report.kept = blocks.iter().map(|block| block.name.clone()).collect();
    let levels = by_level(&blocks, system);
    report.operations.copy_from_slice(&levels[..3]);
    report.iterations = iterations(&blocks, system);
    report.transmission = (!transmissions.is_empty()).then_some(levels[3]);
    report.forces = (!forces.fields().is_empty()).then_some(levels[5]);
    report.sensitivity = (!sensitivities.is_empty()).then_some(levels[4]);
    report.angles_left_out = angles_left_out(&blocks, system);
    report.work = Work::of(&blocks, path.as_ref(), system);
    let read: HashSet<SymbolId> = blocks
        .iter()
        .flat_map(Block::functions)
        .flat_map(Function::values)
        .flat_map(|expr| system.mechanism.graph.symbols(expr))
        .copied()
        .collect();
    branches.retain(|branch| read.contains(&branch.symbol));
    let fields = fields(&blocks, &asked, outputs.is_none(), system);
    let branch_places: HashMap<SymbolId, usize> = branches
        .iter()
        .enumerate()
        .map(|(place, branch)| (branch.symbol, place))
        .collect();
    let mut program = Program {
        field_set: fields.iter().copied().collect(),
        branch_places,
        path,
        requirements: requirements(system),
        textbook: Textbook::of(system),
        drawn: drawn(system),
        // The points of a mechanism with outputs are among its blocks.
        points: if outputs.is_none() {
            points(system)
        } else {
            Vec::new()
        },
        pressures: if outputs.is_none() {
            pressures(system)
        } else {
            Vec::new()
        },
        constants: Constants::default(),
        forms,
        blocks,
        fields,
        branches,
        outputs,
        transmissions,
        sensitivities,
        forces,
        report,
    };
    let mut constants = Constants::default();
    for function in program.functions() {
        constants.note(function, system);
    }
    program.constants = constants;
    program
}

/// The functions of all blocks with nothing left out, and with a person's words, for whoever reads them or evaluates them without
/// a compile step. Values that nothing needs are computed too, so that every unknown of the vector form has its position and rate.
/// Behind the blocks of the plan stands that of the forces, where any are asked for.
pub fn unpruned(system: &mut System, plan: &SolvedPlan) -> (Vec<Block>, Vec<super::Branch>) {
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
        // Loads that nobody asks for are no step of the derivation.
        let fields: HashSet<SymbolId> = forces.fields().into_iter().collect();
        let own = std::slice::from_mut(block);
        prune(
            own,
            &|symbol| fields.contains(&symbol),
            &system.mechanism.graph,
        );
    }
    (blocks, branches)
}

/// How the parts of each block of a plan are solved.
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
    /// Everything that is computed.
    pub fn functions(&self) -> impl Iterator<Item = &Function> {
        let blocks = self.blocks.iter().flat_map(super::Block::functions);
        let paths = self.path.iter().flat_map(Path::functions);
        let textbook = self.textbook.iter().flat_map(Textbook::functions);
        let others = self.points.iter().chain(&self.pressures);
        let given = self.drawn.iter();
        let given = given.chain(self.requirements.iter().map(|it| &it.function));
        blocks
            .chain(paths)
            .chain(textbook)
            .chain(others)
            .chain(given)
    }
}

/// What a path reads of what the blocks find, now and in the last frame; `whole` blocks have nothing left out.
fn read_by_path(path: &Path, unpruned: &[Block], system: &System) -> HashSet<SymbolId> {
    let graph = &system.mechanism.graph;
    let found: HashSet<SymbolId> = unpruned
        .iter()
        .flat_map(|it| it.function.targets())
        .collect();
    let symbols = path
        .functions()
        .flat_map(Function::values)
        .flat_map(|expr| graph.symbols(expr));
    let symbols = symbols.map(|&symbol| match system.roles[symbol.index()] {
        SymbolRole::Last(symbol) => symbol,
        _ => symbol,
    });
    // Arms are found anew.
    let is_arm = |symbol: SymbolId| matches!(system.roles[symbol.index()], SymbolRole::Arm(_));
    symbols
        .filter(|symbol| found.contains(symbol) && !is_arm(*symbol))
        .collect()
}

fn share_path(path: &mut Function, system: &mut System) {
    share_all(path, system);
    for inner in path.statements.iter_mut().filter_map(Statement::inner_mut) {
        share_all(inner, system);
    }
    halve(path, system);
}

/// Computes a sine without its cosine, or the other way round, where nobody reads the other.
fn halve(function: &mut Function, system: &mut System) {
    let graph = &mut system.mechanism.graph;
    // A value is read by its symbol, or as the expression that the symbol stands for.
    let mut read: HashSet<ExprId> = HashSet::new();
    let mut open: Vec<ExprId> = function.all_values().collect();
    while let Some(expr) = open.pop() {
        if read.insert(expr) {
            open.extend(graph.operands(expr));
        }
    }
    for statement in &mut function.statements {
        let Statement::SineCosine {
            sine,
            cosine,
            angle,
        } = *statement
        else {
            continue;
        };
        let values = [graph.sin(angle), graph.cos(angle)];
        let symbols = [sine, cosine].map(|symbol| graph.variable(symbol));
        let [reads_sine, reads_cosine] =
            [0, 1].map(|which| read.contains(&values[which]) || read.contains(&symbols[which]));
        if !reads_cosine {
            *statement = Statement::assignment(sine, values[0]);
        } else if !reads_sine {
            *statement = Statement::assignment(cosine, values[1]);
        }
    }
}

fn share_blocks(blocks: &mut [Block], system: &mut System) {
    for function in blocks.iter_mut().flat_map(Block::functions_mut) {
        share(function, system);
    }
}

/// The angles of closed forms that no statement finds.
fn angles_left_out(blocks: &[Block], system: &System) -> Vec<String> {
    let statements = blocks.iter().flat_map(|block| &block.function.statements);
    let found: HashSet<SymbolId> = statements
        .filter_map(|statement| match statement {
            Statement::Angle { target, .. } => Some(*target),
            _ => None,
        })
        .collect();
    let forms = blocks.iter().flat_map(|block| &block.forms);
    let closed = forms.filter(|form| form.modes().is_some());
    closed
        .flat_map(|form| form.unknowns())
        .filter(|&unknown| {
            let unknown = &system.vector_form.unknowns[unknown];
            unknown.quantity == Quantity::Angle && !found.contains(&unknown.position)
        })
        .map(|unknown| system.unknown_name(unknown).to_string())
        .collect()
}

/// A function with these results, everything in it shared.
pub(super) fn shared(results: impl IntoIterator<Item = ExprId>, system: &mut System) -> Function {
    let mut function = Function::of_results(results);
    share_all(&mut function, system);
    function
}

/// The estimates of all unknowns, where one of them depends on a parameter.
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
