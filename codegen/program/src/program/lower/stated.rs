//! States the functions of all blocks and requests of a plan without omissions, with the requested fields.

use std::sync::Arc;

use super::needed::{Needed, path_of, read_by_path, share_path};
use crate::expr::{IdSet, SymbolId};
use crate::pool::Pool;
use crate::program::block::{Block, Lowering, Measured};
use crate::program::forces::{Forces, forces};
use crate::program::forms::Form;
use crate::program::measures::{Measure, MeasureStatements};
use crate::program::outputs::{Output, outputs};
use crate::program::passes::liveness::prune;
use crate::program::passes::zeros::propagate;
use crate::program::sensitivities::{Sensitivity, sensitivities};
use crate::program::transmissions::{Transmission, transmissions};
use crate::structure::SolvedPlan;
use crate::system::System;

/// All functions before pruning.
pub(super) struct Stated {
    pub blocks: Vec<Block>,
    /// Solution methods of the subsystems of each block of the plan.
    pub forms: Vec<Vec<Arc<dyn Form>>>,
    pub outputs: Option<Vec<Output>>,
    pub transmissions: Vec<Transmission>,
    pub sensitivities: Vec<Sensitivity>,
    pub forces: Forces,
    pub measures: Vec<Measure>,
    /// Requested fields, without the coordinates that are kept in the absence of outputs.
    asked: IdSet<SymbolId>,
}

impl Stated {
    pub fn of(lowering: &mut Lowering<'_>, plan: &SolvedPlan, kept: &IdSet<SymbolId>) -> Stated {
        let mut blocks: Vec<Block> = plan
            .blocks
            .iter()
            .enumerate()
            .map(|(place, block)| lowering.block(place, block))
            .collect();
        let forms = blocks.iter().map(|block| block.forms.clone()).collect();
        let requested = outputs(lowering.pool, lowering.system);
        let mut measured =
            MeasureStatements::new(lowering.pool, lowering.system, &mut lowering.derivatives);
        let measuring = measured.of_motion();
        let (transmissions, transmitting) =
            transmissions(lowering.pool, lowering.system, &mut lowering.derivatives).unzip();
        let (sensitivities, sensing) =
            sensitivities(lowering.pool, lowering.system, &mut lowering.derivatives).unzip();
        let (transmissions, sensitivities) = (
            transmissions.unwrap_or_default(),
            sensitivities.unwrap_or_default(),
        );
        let transposed: Vec<_> = blocks.iter().map(|it| it.transposed.clone()).collect();
        let (forces, exerting) = forces(lowering, plan, &transposed).unzip();
        let forces = forces.unwrap_or_default();
        let measuring_forces = measured.of_forces(&forces, lowering.pool, lowering.system);
        let measures = measured.measures;
        // Zero loads have zero reactions.
        let exerts = exerting.is_some();
        blocks.extend(exerting);
        propagate(&mut blocks, &mut lowering.pool.graph);
        let exerting = blocks.pop_if(|_| exerts);
        let mut fields = kept.clone();
        fields.extend(transmissions.iter().flat_map(Transmission::fields));
        fields.extend(sensitivities.iter().flat_map(Sensitivity::fields));
        fields.extend(forces.fields());
        fields.extend(measures.iter().map(|it| it.field));
        fields.extend(
            blocks
                .iter()
                .flat_map(|block| &block.measured)
                .flat_map(Measured::fields),
        );
        let (outputs, last) = requested.unzip();
        fields.extend(outputs.iter().flatten().flat_map(Output::fields));
        blocks.extend(last);
        blocks.extend(measuring);
        blocks.extend(transmitting.into_iter().chain(sensing).chain(exerting));
        blocks.extend(measuring_forces);
        Stated {
            blocks,
            forms,
            outputs,
            transmissions,
            sensitivities,
            forces,
            measures,
            asked: fields,
        }
    }

    /// Returns the needed statements of the blocks, and the verification of their path.
    pub fn needed(&self, lowering: &mut Lowering<'_>, plan: &SolvedPlan) -> Needed {
        let mut fields = self.asked.clone();
        let mut blocks = self.pruned(&fields, lowering.pool, lowering.system);
        let mut path = None;
        if !lowering.system.mechanism.is_unguarded {
            let mut path_functions = path_of(&blocks, lowering, plan);
            fields.extend(read_by_path(&path_functions, &self.blocks, lowering.pool));
            blocks = self.pruned(&fields, lowering.pool, lowering.system);
            for function in path_functions.whole_functions_mut() {
                share_path(function, lowering.pool, lowering.system);
            }
            path = Some(path_functions);
        }
        Needed {
            blocks,
            asked: fields,
            path,
        }
    }

    /// Returns the blocks without unneeded statements.
    fn pruned(&self, asked: &IdSet<SymbolId>, pool: &Pool, system: &System) -> Vec<Block> {
        let is_asked = |symbol: SymbolId| {
            asked.contains(&symbol) || self.outputs.is_none() && system.is_coordinate(symbol, pool)
        };
        let mut blocks = self.blocks.clone();
        prune(&mut blocks, &is_asked, &pool.graph);
        blocks
    }
}
