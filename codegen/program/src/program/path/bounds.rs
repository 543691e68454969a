//! States the bounds of unknowns and inputs along the chord, and names them.

use crate::expr::{ExprId, SymbolId};
use crate::pool::SymbolRole;
use crate::program::builder::Builder;
use crate::program::function::Statement;
use crate::program::passes::enclosure::Enclosure;

impl Builder<'_> {
    /// Returns the change of an unknown along the chord: its change since the last frame, extrapolated over the window.
    pub(super) fn change(&mut self, unknown: usize) -> SymbolId {
        let change = self.bound(unknown, "change");
        let moved = self.moved_since(unknown);
        let moved = self.graph().magnitude(moved);
        let stretch = self.paths.window.steps;
        let stretch = self.graph().variable(stretch);
        let value = self.graph().multiply(stretch, moved);
        self.assign(change, value);
        change
    }

    /// Returns the change of an unknown since the last frame.
    pub(in crate::program) fn moved_since(&mut self, unknown: usize) -> ExprId {
        match self.paths.directions.get(&unknown) {
            // Without the angle itself, its change is known to be less than half a turn.
            Some(&[cosine, sine]) => {
                let both = [cosine, sine].map(|symbol| [symbol, self.pool.last(symbol)]);
                let [[c, c_last], [s, s_last]] =
                    both.map(|pair| pair.map(|symbol| self.graph().variable(symbol)));
                let (along, across) = (
                    self.combined_product([c, c_last], [s, s_last], false),
                    self.combined_product([s, c_last], [c, s_last], true),
                );
                self.graph().atan2(across, along)
            }
            None => {
                let symbol = self.system.vector_form.unknowns[unknown].position;
                self.moved(symbol)
            }
        }
    }

    /// Returns a b + c d, or their difference.
    fn combined_product(
        &mut self,
        first: [ExprId; 2],
        second: [ExprId; 2],
        subtract: bool,
    ) -> ExprId {
        let [first, second] = [first, second].map(|factors| self.graph().product(&factors));
        match subtract {
            true => self.graph().subtract(first, second),
            false => self.graph().add(first, second),
        }
    }

    /// Returns a value less its value in the last frame.
    fn moved(&mut self, symbol: SymbolId) -> ExprId {
        let last = self.pool.last(symbol);
        let [now, before] = [symbol, last].map(|it| self.graph().variable(it));
        self.graph().subtract(now, before)
    }

    /// Returns a symbol for a bound of an unknown.
    pub(super) fn bound(&mut self, unknown: usize, what: &str) -> SymbolId {
        let name = self.system.unknown_name(unknown);
        let name = format!("{name}_{what}");
        self.pool.intermediate(&name)
    }

    pub(in crate::program) fn know(&mut self, unknown: usize, enclosure: Enclosure) {
        let symbol = self.system.vector_form.unknowns[unknown].position;
        self.paths.enclosures.know(symbol, enclosure);
    }

    /// Records that an unknown is constant.
    pub(in crate::program) fn know_still(&mut self, unknown: usize) {
        let zero = self.graph().zero();
        self.know(
            unknown,
            Enclosure {
                radius: zero,
                deviation: zero,
            },
        );
    }

    pub(in crate::program) fn enclosure(&mut self, expr: ExprId) -> Enclosure {
        self.meet_signals(expr);
        self.paths.enclosures.of(expr, self.pool, self.system)
    }

    /// Adds the requirements of the bounds of a block.
    pub(in crate::program) fn require(&mut self, block: usize) {
        let mut required = std::mem::take(&mut self.paths.enclosures.required);
        required.sort_unstable();
        required.dedup();
        self.path_geometry(&required);
        for value in required {
            self.state(Statement::Require { value, block });
        }
    }

    /// Adds the bounds of the inputs that an expression mentions.
    fn meet_signals(&mut self, expr: ExprId) {
        for symbol in self.pool.graph.symbols(expr).to_vec() {
            let SymbolRole::Input { input, level: 0 } = self.pool.role(symbol) else {
                continue;
            };
            if !self.paths.signals.insert(input) {
                continue;
            }
            let name = self.system.mechanism.inputs[input].name.to_lowercase();
            let bounds = ["radius", "deviation"]
                .map(|what| self.pool.intermediate(&format!("{name}_{what}")));
            self.state(Statement::Signal {
                input,
                found: bounds,
            });
            let [radius, deviation] = bounds.map(|it| self.graph().variable(it));
            self.paths
                .enclosures
                .know(symbol, Enclosure { radius, deviation });
        }
    }
}
