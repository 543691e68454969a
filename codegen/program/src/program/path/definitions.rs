//! Substitutes short explicit assignments for their unknowns, and bounds other unknowns once an expression mentions them.

use super::isolation::Loops;
use crate::expr::{ExprId, SymbolId};
use crate::joint::Quantity;
use crate::pool::SymbolRole;
use crate::program::builder::Builder;
use crate::program::passes::enclosure::Enclosure;
use crate::structure::Definition;

/// Largest number of symbols of an assignment that is substituted for its unknown.
const MAX_SYMBOLS: usize = 16;

impl Builder<'_> {
    /// Returns an expression with assignments substituted, which merges vectors of one body.
    pub(in crate::program) fn in_short(&mut self, expr: ExprId) -> ExprId {
        let graph = &mut self.pool.graph;
        let definitions = graph.symbols(expr).iter();
        let definitions =
            definitions.filter_map(|symbol| Some((*symbol, *self.paths.definitions.get(symbol)?)));
        let definitions: Vec<(SymbolId, ExprId)> = definitions.collect();
        graph.substitute(expr, &definitions)
    }

    /// Records a short assignment for substitution, unless its unknown rotates vectors or is driven. Other assignments are
    /// bounded when an expression mentions their unknowns.
    pub(in crate::program) fn path_of_definition(&mut self, definition: &Definition, block: usize) {
        let value = self.in_short(definition.value);
        let unknown = &self.system.vector_form.unknowns[definition.unknown];
        let symbols = self.pool.graph.symbols(value);
        let mut roles = symbols.iter().map(|it| self.pool.role(*it));
        let is_driven =
            roles.any(|role| matches!(role, SymbolRole::Time | SymbolRole::Input { .. }));
        if unknown.quantity != Quantity::Angle && !is_driven && symbols.len() <= MAX_SYMBOLS {
            self.paths.definitions.insert(unknown.position, value);
        } else {
            let awaited = &mut self.paths.awaited;
            awaited.insert(definition.unknown, (*definition, block));
        }
    }

    /// Takes the assignment of a symbol's unknown, and its block; `None` if it has been taken before.
    pub(in crate::program) fn awaited(&mut self, symbol: SymbolId) -> Option<(Definition, usize)> {
        let unknown = self.moving(symbol)?;
        self.paths.awaited.remove(&unknown)
    }

    /// Bounds the assignments of all unknowns that an expression mentions, as far as that has not been done.
    pub(super) fn meet(&mut self, expr: ExprId, loops: &mut Loops) {
        for symbol in self.pool.graph.symbols(expr).to_vec() {
            if let Some((definition, block)) = self.awaited(symbol) {
                self.look_at_definition(&definition, block, loops);
            }
        }
    }

    fn look_at_definition(&mut self, definition: &Definition, block: usize, loops: &mut Loops) {
        let unknown = definition.unknown;
        let value = self.in_short(definition.value);
        self.meet(value, loops);
        let symbol = self.system.vector_form.unknowns[unknown].position;
        let symbols = self.pool.graph.symbols(value);
        let mut moving = symbols.iter().filter_map(|&symbol| self.moving(symbol));
        if moving.any(|unknown| loops.columns.contains_key(&unknown)) {
            let position = self.graph().variable(symbol);
            let residual = self.graph().subtract(position, value);
            return self.join(&[unknown], &[residual], block, loops);
        }
        let zero = self.graph().zero();
        let enclosure = self.enclosure(value);
        self.path_geometry(&[enclosure.radius, enclosure.deviation]);
        self.require(block);
        if enclosure.radius == zero {
            return self.know(unknown, enclosure);
        }
        let named = |builder: &mut Self, value: ExprId, what: &str| {
            if value == zero {
                return value;
            }
            let symbol = builder.bound(unknown, what);
            builder.assign(symbol, value);
            builder.graph().variable(symbol)
        };
        let deviation = named(self, enclosure.deviation, "deviation");
        // Between both frames, the unknown changes by their difference, and beyond them by as much.
        let change = self.change(unknown);
        let change = self.graph().variable(change);
        let reach = self.graph().add(change, deviation);
        let radius = named(self, reach, "radius");
        self.know(unknown, Enclosure { radius, deviation });
    }
}
