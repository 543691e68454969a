//! Every block of the plan → its function.

use std::collections::{HashMap, HashSet};

use super::block::lower_block;
use super::closeness::measured_fields;
use super::evaluation::{evaluated, note_constants, operations};
use super::fields::fields;
use super::liveness::prune;
use super::outputs::outputs;
use super::responses::Responses;
use super::sensitivities::{Sensitivity, sensitivities};
use super::sharing::share;
use super::transmissions::{Transmission, transmissions};
use super::{Action, BlockProgram, Output, Report, SolvedProgram};
use crate::expr::{ExprId, SymbolId};
use crate::program::constants::Constants;
use crate::structure::{SolvedPlan, Step};
use crate::system::{SymbolRole, System};

/// The functions of all blocks. The system's arena grows by the values that are computed on the way.
pub fn lower(system: &mut System, plan: &SolvedPlan, constants: &mut Constants) -> SolvedProgram {
    let drawn = drawn_values(system);
    let mut branches = Vec::new();
    let mut blocks = Vec::with_capacity(plan.blocks.len());
    let mut names = Vec::new();
    let mut responses = Responses::new(system);
    for (place, block) in plan.blocks.iter().enumerate() {
        let mut lowered = lower_block(
            system,
            block,
            &drawn,
            &mut branches,
            &mut responses,
            constants,
        );
        lowered.place = Some(place);
        set_apart(&mut lowered, &mut names);
        blocks.push(lowered);
    }
    let coordinates = system.coordinates.len();
    let is_coordinate = |symbol: SymbolId, system: &System| match system.roles[symbol.index()] {
        SymbolRole::Position(unknown)
        | SymbolRole::Rate(unknown)
        | SymbolRole::Acceleration(unknown) => unknown < coordinates,
        _ => false,
    };
    let wanted = outputs(system, constants);
    let (transmissions, transmitting) = transmissions(system, &mut responses, constants).unzip();
    let transmissions = transmissions.unwrap_or_default();
    let (sensitivities, sensing) = sensitivities(system, &mut responses, constants).unzip();
    let sensitivities = sensitivities.unwrap_or_default();
    let responding: Vec<BlockProgram> = transmitting.into_iter().chain(sensing).collect();
    let system = &*system;
    let mut report = Report::default();
    let mut all = blocks.clone();
    // What the points take is counted on both sides.
    all.extend(wanted.iter().map(|(_, last)| last.clone()));
    all.extend(responding.iter().cloned());
    let mut responded: HashSet<SymbolId> = transmissions
        .iter()
        .flat_map(Transmission::fields)
        .collect();
    responded.extend(sensitivities.iter().flat_map(Sensitivity::fields));
    responded.extend(measured_fields(
        blocks.iter().flat_map(|block| &block.measured),
    ));
    let mut asked_for: HashSet<SymbolId> = wanted
        .iter()
        .flat_map(|(outputs, _)| outputs)
        .flat_map(Output::fields)
        .collect();
    asked_for.extend(&responded);
    prune(
        &mut all,
        &|symbol| is_coordinate(symbol, system) || asked_for.contains(&symbol),
        system,
    );
    // What nothing asks for needs no constants.
    let mut unused = Constants::default();
    for block in &mut all {
        let constants = if wanted.is_none() {
            &mut *constants
        } else {
            &mut unused
        };
        share(block, system, constants);
    }
    let all_levels = operations(&all, system);
    report.all_operations.copy_from_slice(&all_levels[..3]);
    for last in wanted.iter().map(|(_, last)| last).chain(&responding) {
        note_constants(
            &last
                .actions
                .iter()
                .flat_map(Action::values)
                .collect::<Vec<_>>(),
            system,
            &last.time,
            constants,
        );
    }
    let (outputs, asked) = match wanted {
        None => {
            blocks = all;
            (None, responded)
        }
        Some((outputs, last)) => {
            blocks.push(last);
            blocks.extend(responding);
            let asked = asked_for;
            prune(&mut blocks, &|symbol| asked.contains(&symbol), system);
            for block in &mut blocks {
                share(block, system, constants);
            }
            (Some(outputs), asked)
        }
    };
    let is_empty = |block: &BlockProgram| block.actions.is_empty();
    report.left_out = blocks
        .iter()
        .filter(|block| is_empty(block) && !block.joints.is_empty())
        .map(|block| block.name.clone())
        .collect();
    blocks.retain(|block| !is_empty(block));
    report.kept = blocks.iter().map(|block| block.name.clone()).collect();
    let levels = operations(&blocks, system);
    report.operations.copy_from_slice(&levels[..3]);
    report.transmission = (!transmissions.is_empty()).then_some(levels[3]);
    report.sensitivity = (!sensitivities.is_empty()).then_some(levels[4]);
    let angles = |blocks: &[BlockProgram]| -> HashSet<usize> {
        let actions = blocks.iter().flat_map(|block| &block.actions);
        actions
            .filter_map(|action| match action {
                Action::Angle { unknown, .. } => Some(*unknown),
                _ => None,
            })
            .collect()
    };
    let computed = angles(&blocks);
    let closed = plan
        .blocks
        .iter()
        .flat_map(|block| &block.steps)
        .filter(|step| !matches!(step, Step::Newton { .. }));
    let left_out = closed.flat_map(Step::unknowns).filter(|unknown| {
        let is_angle =
            system.vector_form.unknowns[*unknown].quantity == crate::joint::Quantity::Angle;
        is_angle && !computed.contains(unknown)
    });
    report.angles_left_out = left_out
        .map(|unknown| system.unknown_name(unknown).to_string())
        .collect();
    for block in &mut blocks {
        let actions = &block.actions;
        let time = block
            .time
            .for_results(&evaluated(actions, block.newton.as_ref()), system);
        block.time = time;
    }
    let used: HashSet<SymbolId> = blocks
        .iter()
        .flat_map(|block| evaluated(&block.actions, block.newton.as_ref()))
        .flat_map(|expr| system.mechanism.graph.symbols(expr).to_vec())
        .collect();
    branches.retain(|branch| used.contains(&branch.symbol));
    let fields = fields(&blocks, &asked, outputs.is_none(), system);
    let field_set = fields.iter().copied().collect();
    let branch_places: HashMap<SymbolId, usize> = branches
        .iter()
        .enumerate()
        .map(|(place, branch)| (branch.symbol, place))
        .collect();
    for block in &mut blocks {
        let read = evaluated(&block.actions, None);
        let mut symbols = read
            .into_iter()
            .flat_map(|expr| system.mechanism.graph.symbols(expr));
        block.reads_branch = symbols.any(|symbol| branch_places.contains_key(symbol));
    }
    SolvedProgram {
        blocks,
        fields,
        branches,
        outputs,
        transmissions,
        sensitivities,
        report,
        plan: plan.clone(),
        field_set,
        branch_places,
    }
}

/// Numbers a block whose name is one of `taken`, and takes its own.
pub(super) fn set_apart(block: &mut BlockProgram, taken: &mut Vec<String>) {
    let base = block.name.clone();
    let mut number = 2;
    while taken.contains(&block.name) {
        block.name = format!("{base}_{number}");
        number += 1;
    }
    taken.push(block.name.clone());
}

/// The drawing's value of every parameter, unknown and arm, by symbol.
pub(super) fn drawn_values(system: &System) -> Vec<f64> {
    let graph = &system.mechanism.graph;
    let form = &system.vector_form;
    let mut values = vec![0.0; graph.symbol_count()];
    let constant = |expr: ExprId| graph.constant_value(expr).unwrap_or(0.0);
    graph.fill_nominal(&mut values);
    for unknown in &form.unknowns {
        values[unknown.position.index()] = constant(unknown.estimate);
    }
    for arm in &form.arms {
        let angle = form.unknowns[arm.angle].position;
        let (sine, cosine) = values[angle.index()].sin_cos();
        let [x, y] = arm.local.map(constant);
        values[arm.symbols[0].index()] = cosine * x - sine * y;
        values[arm.symbols[1].index()] = sine * x + cosine * y;
    }
    values
}
