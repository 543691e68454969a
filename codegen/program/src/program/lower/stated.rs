//! A plan → the functions of all its blocks and of what is asked for besides, with nothing left out, and the fields that are asked for.

use std::sync::Arc;

use super::needed::{Needed, path_of, read_by_path, share_path};
use crate::expr::{IdSet, SymbolId};
use crate::program::block::{Block, Lowering, Measured};
use crate::program::forces::{Forces, forces};
use crate::program::forms::Form;
use crate::program::outputs::{Output, outputs};
use crate::program::passes::liveness::prune;
use crate::program::passes::zeros::propagate;
use crate::program::sensitivities::{Sensitivity, sensitivities};
use crate::program::transmissions::{Transmission, transmissions};
use crate::structure::SolvedPlan;
use crate::system::System;

/// Everything that is computed before anything is left out.
pub(super) struct Stated {
    pub blocks: Vec<Block>,
    /// How the parts of each block of the plan are solved.
    pub forms: Vec<Vec<Arc<dyn Form>>>,
    pub outputs: Option<Vec<Output>>,
    pub transmissions: Vec<Transmission>,
    pub sensitivities: Vec<Sensitivity>,
    pub forces: Forces,
    /// The fields that are asked for, beside the coordinates where there are no outputs.
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
        let (forces, exerting) = forces(lowering, plan, &transposed).unzip();
        let forces = forces.unwrap_or_default();
        // What is known to be zero carries nothing either.
        let exerts = exerting.is_some();
        blocks.extend(exerting);
        propagate(&mut blocks, &mut lowering.system.mechanism.graph);
        let exerting = blocks.pop_if(|_| exerts);
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
        Stated {
            blocks,
            forms,
            outputs,
            transmissions,
            sensitivities,
            forces,
            asked,
        }
    }

    /// What the blocks find that is needed, and what shows that they have stayed on their path.
    pub fn needed(&self, lowering: &mut Lowering<'_>, plan: &SolvedPlan) -> Needed {
        let mut asked = self.asked.clone();
        let mut blocks = self.pruned(&asked, lowering.system);
        let mut path = None;
        if !lowering.system.mechanism.is_unguarded {
            let mut found = path_of(&blocks, lowering, plan);
            asked.extend(read_by_path(&found, &self.blocks, lowering.system));
            blocks = self.pruned(&asked, lowering.system);
            for function in found.whole_functions_mut() {
                share_path(function, lowering.system);
            }
            path = Some(found);
        }
        Needed {
            blocks,
            asked,
            path,
        }
    }

    /// The blocks without what nothing asks for.
    fn pruned(&self, asked: &IdSet<SymbolId>, system: &System) -> Vec<Block> {
        let is_asked = |symbol: SymbolId| {
            asked.contains(&symbol) || self.outputs.is_none() && system.is_coordinate(symbol)
        };
        let mut blocks = self.blocks.clone();
        prune(&mut blocks, &is_asked, &system.mechanism.graph);
        blocks
    }
}
