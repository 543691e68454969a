//! The explicit formulas of a block → their statements, and what a person says of them.

use crate::expr::SymbolId;
use crate::program::builder::Builder;
use crate::program::function::Level;
use crate::structure::SolvedBlock;
use crate::words::{Phrase, Piece, enumerated, phrase};

/// So many accelerations are written out; more would fill a page with what differentiating once more says.
const FEW: usize = 3;

impl Builder<'_> {
    /// The explicit formulas of a block.
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

    /// What the explicit formulas do at a level.
    pub(super) fn definition_rates(&mut self, block: &SolvedBlock, level: Level) {
        let graph = &self.system.mechanism.graph;
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

    /// What a block without a part finds, and what it starts from.
    fn explicit_source(&mut self, block: &SolvedBlock) -> Phrase {
        const NAMED: usize = 6;
        let mechanism = &self.system.mechanism;
        let drives = |symbol: SymbolId| {
            let mut inputs = mechanism.inputs.iter();
            symbol == mechanism.time || inputs.any(|input| input.symbols[0] == symbol)
        };
        let graph = &mechanism.graph;
        let mut values = block.definitions.iter().map(|definition| definition.value);
        let driven = values
            .clone()
            .any(|value| graph.symbols(value).iter().copied().any(drives));
        let source = match (values.any(|value| graph.is_fixed(value)), driven) {
            (true, true) => " from what is fixed and what is driven",
            (false, true) => " from the drivers",
            _ => " from what is fixed",
        };
        let found = block.definitions.iter();
        let found: Vec<Phrase> = found.map(|it| Piece::Unknown(it.unknown).into()).collect();
        match found.len() {
            0..=NAMED => phrase![enumerated(&found), source],
            number => phrase![format!("{number} unknowns"), source],
        }
    }
}
