//! States the explicit assignments of a block and describes them.

use crate::expr::SymbolId;
use crate::program::builder::Builder;
use crate::program::function::Level;
use crate::structure::SolvedBlock;
use crate::words::{Phrase, Piece, enumerated, phrase};

/// Largest number of accelerations that are written out; a longer list says no more than a second differentiation.
const FEW: usize = 3;

impl Builder<'_> {
    /// States the explicit assignments of a block.
    pub(super) fn definitions(&mut self, block: &SolvedBlock) {
        if block.parts.is_empty() {
            let source = self.explicit_source(block);
            self.heading(source);
        }
        self.say(|_| {
            match (block.parts.is_empty(), block.definitions.len()) {
                (_, 0) => "",
                (true, 1) => "It follows from one equation:",
                (true, _) => "Each follows from one equation:",
                (false, 1) => "What is left follows from one equation:",
                (false, _) => "The rest follows, each from one equation:",
            }
            .into()
        });
        for definition in &block.definitions {
            let symbol = self.system.vector_form.unknowns[definition.unknown].position;
            let remark = self.origin(&block.joints, definition.row);
            self.assign_with(symbol, definition.value, remark);
            self.known.find(definition.unknown, self.place);
            self.explicit_angle(definition.unknown);
        }
    }

    /// States the rates or derivatives of explicit assignments at a level.
    pub(super) fn definition_rates(&mut self, block: &SolvedBlock, level: Level) {
        let graph = &self.pool.graph;
        let moving = block.definitions.iter();
        let moving = moving.filter(|it| !graph.is_fixed(it.value)).count();
        let follows = !block.parts.is_empty();
        let words = match level {
            _ if moving == 0 => "",
            Level::Velocity if moving > FEW => {
                "Differentiated once; where accelerations are not written, they follow by differentiating once more:"
            }
            Level::Velocity if follows => "Differentiated once:",
            Level::Velocity => "Differentiated once and twice:",
            Level::Acceleration if follows && moving <= FEW => "Differentiated twice:",
            _ => "",
        };
        self.say(|_| words.into());
        for definition in &block.definitions {
            let rate = self.rate_at(definition.value, level);
            self.find(definition.unknown, level, rate);
        }
    }

    /// Describes the results and inputs of a block without a subsystem.
    fn explicit_source(&mut self, block: &SolvedBlock) -> Phrase {
        const NAMED: usize = 6;
        let mechanism = &self.system.mechanism;
        let drives = |symbol: SymbolId| {
            let mut inputs = mechanism.inputs.iter();
            symbol == mechanism.time || inputs.any(|input| input.symbols[0] == symbol)
        };
        let graph = &self.pool.graph;
        let mut values = block.definitions.iter().map(|definition| definition.value);
        let driven = values
            .clone()
            .any(|value| graph.symbols(value).iter().copied().any(drives));
        let source = match (values.any(|value| graph.is_fixed(value)), driven) {
            (true, true) => " from what is fixed and what is driven",
            (false, true) => " from the drivers",
            _ => " from what is fixed",
        };
        let definitions = block.definitions.iter();
        let unknowns: Vec<Phrase> = definitions
            .map(|it| Piece::Unknown(it.unknown).into())
            .collect();
        match unknowns.len() {
            0..=NAMED => phrase![enumerated(&unknowns), source],
            number => phrase![format!("{number} unknowns"), source],
        }
    }
}
