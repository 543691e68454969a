//! The explicit formulas of a block, with their rates and accelerations.

use super::writer::Writer;
use crate::expr::ExprId;
use crate::structure::SolvedBlock;
use crate::system::SymbolRole;

/// So many accelerations are written out; more would fill the page with what differentiating once more says.
const FEW: usize = 3;

impl Writer<'_> {
    /// The formulas of a block, each beside the row that says it. Values that were found as constants are put in.
    pub(super) fn definitions(&mut self, number: usize, block: &SolvedBlock) {
        let mut equations = Vec::with_capacity(block.definitions.len());
        let mut moving = Vec::new();
        for definition in &block.definitions {
            let note = match self.defining_row(&block.joints, definition.unknown, definition.value)
            {
                Some(row) => self.row_note(row),
                None => String::new(),
            };
            let value = self.with_numbers(definition.value);
            self.found(definition.unknown, number, Some(value));
            let variable = self.variable(definition.unknown);
            equations.push(self.equation(variable, value, note));
            if !self.graph().is_fixed(value) {
                moving.push((definition.unknown, value));
            }
        }
        if equations.is_empty() {
            return;
        }
        self.paragraph(match (block.steps.is_empty(), equations.len()) {
            (true, 1) => "It follows from one equation:",
            (true, _) => "Each follows from one equation:",
            (false, 1) => "What is left follows from one equation:",
            (false, _) => "The rest follows, each from one equation:",
        });
        self.equations(equations);
        self.motion(&moving);
    }

    /// The rates of these values; the accelerations where they are few or functions of time alone.
    fn motion(&mut self, moving: &[(usize, ExprId)]) {
        if moving.is_empty() {
            return;
        }
        let (mut rates, mut accelerations) = (Vec::new(), Vec::new());
        for &(unknown, value) in moving {
            let rate = self.derivative(value);
            let left = self.rate_of(unknown);
            rates.push(self.equation(left, rate, ""));
            if moving.len() <= FEW || self.is_given_by_time(value) {
                let acceleration = self.derivative(rate);
                let left = self.acceleration_of(unknown);
                accelerations.push(self.equation(left, acceleration, ""));
            }
        }
        self.paragraph(if rates.len() == accelerations.len() {
            "Differentiated once and twice:"
        } else if accelerations.is_empty() {
            "Differentiated once; the accelerations follow by differentiating once more:"
        } else {
            "Differentiated once, functions of time twice; the other accelerations follow by differentiating once more:"
        });
        self.equations(rates.into_iter().chain(accelerations).collect());
    }

    /// Whether an expression holds nothing but t, inputs and parameters.
    fn is_given_by_time(&mut self, expr: ExprId) -> bool {
        let graph = &self.system.mechanism.graph;
        let mut symbols = graph.symbols(expr).iter();
        symbols.all(|symbol| {
            matches!(
                self.system.roles[symbol.index()],
                SymbolRole::Time | SymbolRole::Parameter(_) | SymbolRole::Input { .. }
            )
        })
    }
}
