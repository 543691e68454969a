//! What is explicit → its value in place of what it defines, where that is short, or else its bounds, once something mentions it.

use super::isolation::Loops;
use crate::expr::{ExprId, SymbolId};
use crate::joint::Quantity;
use crate::program::builder::Builder;
use crate::program::passes::enclosure::Enclosure;
use crate::structure::Definition;
use crate::system::SymbolRole;

/// How many symbols a definition may mention that takes the place of what it defines.
const SHORT: usize = 16;

impl Builder<'_> {
    /// An expression with definitions in place of the unknowns that they define: arms of one body are one arm then.
    pub(in crate::program) fn in_short(&mut self, expr: ExprId) -> ExprId {
        let graph = &mut self.system.mechanism.graph;
        let definitions = graph.symbols(expr).iter();
        let definitions =
            definitions.filter_map(|symbol| Some((*symbol, *self.paths.definitions.get(symbol)?)));
        let definitions: Vec<(SymbolId, ExprId)> = definitions.collect();
        graph.substitute(expr, &definitions)
    }

    /// Where a definition is short, and not that of what turns arms or is driven, its value takes the place of what it defines. The
    /// others are looked at where something mentions what they define.
    pub(in crate::program) fn path_of_definition(&mut self, definition: &Definition, block: usize) {
        let value = self.in_short(definition.value);
        let own = &self.system.vector_form.unknowns[definition.unknown];
        let symbols = self.system.mechanism.graph.symbols(value);
        let mut roles = symbols.iter().map(|it| self.system.roles[it.index()]);
        let is_driven =
            roles.any(|role| matches!(role, SymbolRole::Time | SymbolRole::Input { .. }));
        if own.quantity != Quantity::Angle && !is_driven && symbols.len() <= SHORT {
            self.paths.definitions.insert(own.position, value);
        } else {
            let awaited = &mut self.paths.awaited;
            awaited.insert(definition.unknown, (*definition, block));
        }
    }

    /// The definition of what a symbol moves with, and its block, where nothing has mentioned it before.
    pub(in crate::program) fn awaited(&mut self, symbol: SymbolId) -> Option<(Definition, usize)> {
        let unknown = self.moving(symbol)?;
        self.paths.awaited.remove(&unknown)
    }

    /// Looks at the definitions of what an expression mentions, as far as nothing has mentioned it before.
    pub(super) fn meet(&mut self, expr: ExprId, loops: &mut Loops) {
        for symbol in self.system.mechanism.graph.symbols(expr).to_vec() {
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
        let symbols = self.system.mechanism.graph.symbols(value);
        let mut moving = symbols.iter().filter_map(|&symbol| self.moving(symbol));
        if moving.any(|unknown| loops.columns.contains_key(&unknown)) {
            let position = self.graph().variable(symbol);
            let residual = self.graph().subtract(position, value);
            return self.join(&[unknown], &[residual], block, loops);
        }
        let zero = self.graph().zero();
        let found = self.enclosure(value);
        self.path_geometry(&[found.radius, found.deviation]);
        self.require(block);
        if found.radius == zero {
            return self.know(unknown, found);
        }
        let named = |builder: &mut Self, value: ExprId, what: &str| {
            if value == zero {
                return value;
            }
            let symbol = builder.bound(unknown, what);
            builder.assign(symbol, value);
            builder.graph().variable(symbol)
        };
        let deviation = named(self, found.deviation, "deviation");
        // Between both frames it moves by their difference, and beyond them as much.
        let change = self.change(unknown);
        let change = self.graph().variable(change);
        let reach = self.graph().add(change, deviation);
        let radius = named(self, reach, "radius");
        self.know(unknown, Enclosure { radius, deviation });
    }
}
