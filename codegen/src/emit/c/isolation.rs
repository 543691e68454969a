//! Writes the proof that unknowns stay on their path, in calls of the runtime.

use super::printer::Printer;
use crate::emit::code::Code;
use crate::emit::module::scope::Scope;
use crate::expr::SymbolId;
use crate::program::Function;

/// An entry of a matrix, with its row and its column.
pub(super) type Entry = ([usize; 2], String);

/// Unknowns that must stay on their path, with the printed expressions of the proof.
pub(super) struct Isolated<'a> {
    pub is_chain: bool,
    pub blocks: &'a [usize],
    pub found: &'a [SymbolId],
    pub vectors: [(&'static str, Vec<String>); 4],
    pub turns: &'a [bool],
    pub matrices: [(&'static str, Vec<Entry>); 2],
    pub varied: &'a [[usize; 2]],
    pub variation: &'a Function,
}

impl Printer<'_> {
    /// Writes the calls that bound the deviations of unknowns from the chord.
    pub(super) fn isolation(&self, isolated: &Isolated<'_>, scope: &Scope<'_>, text: &mut Code) {
        let Isolated {
            is_chain,
            blocks,
            found,
            vectors,
            turns,
            matrices,
            varied,
            variation,
        } = isolated;
        let (real, order) = (self.real(), found.len());
        let graph = &self.module.pool.graph;
        let is_varied = |symbol: &SymbolId| {
            let mut values = variation.values();
            values.any(|expr| graph.symbols(expr).contains(symbol))
        };
        let named = found.iter().enumerate();
        let named = named.map(|(place, symbol)| Deviation {
            place,
            name: self.symbol(*symbol, scope),
            is_varied: is_varied(symbol),
            is_wanted: scope.is_wanted(*symbol),
        });
        let named: Vec<Deviation> = named.collect();
        for deviation in named.iter().filter(|deviation| deviation.is_wanted) {
            text.line(format!("{real} {};", deviation.name));
        }
        text.open("{");
        let numbers = blocks
            .iter()
            .map(|&place| format!("{}U", self.module.block_number(place)));
        let numbers: Vec<String> = numbers.collect();
        text.line(format!(
            "const uint16_t blocks[{order}] = {{{}}};",
            numbers.join(", ")
        ));
        for (name, values) in vectors {
            text.line(format!(
                "{real} {name}[{order}] = {{{}}};",
                values.join(", ")
            ));
        }
        let turns: Vec<String> = turns.iter().map(bool::to_string).collect();
        text.line(format!(
            "const bool turns[{order}] = {{{}}};",
            turns.join(", ")
        ));
        let zero = self.number(0.0);
        for matrix in ["jacobian", "turning", "variation"] {
            text.line(format!(
                "{real} {matrix}[{order}][{order}] = {{{{{zero}}}}};"
            ));
        }
        text.line(format!(
            "{real} reals[LINKWRIGHT_ISOLATION_REALS({order})];"
        ));
        let chord = "{window->remainder, bounds, curvatures, changes, sizes, &jacobian[0][0], turns, &turning[0][0]}";
        text.line(format!("const {} chord = {chord};", self.runtime("chord")));
        text.line(format!("{} isolation;", self.runtime("isolation")));
        for (matrix, entries) in matrices {
            for ([row, column], entry) in entries {
                text.line(format!("{matrix}[{row}][{column}] = {entry};"));
            }
        }
        let (call, window) = match is_chain {
            true => ("isolate_chain", "window, "),
            false => ("isolate", ""),
        };
        text.line(format!(
            "{}(&isolation, {order}U, blocks, {window}&chord, &variation[0][0], reals);",
            self.runtime(call)
        ));
        if !is_chain {
            self.variation(&named, (varied, variation), scope, text);
        }
        text.open("if (!isolation.is_shown) {");
        text.line("*block = isolation.block;");
        text.line("return false;");
        text.close("}");
        for deviation in named.iter().filter(|deviation| deviation.is_wanted) {
            text.line(format!(
                "{} = isolation.found[{}];",
                deviation.name, deviation.place
            ));
        }
        text.close("}");
    }

    /// Writes the loop that bounds the variation of the Jacobian as often as the runtime needs it.
    fn variation(
        &self,
        named: &[Deviation],
        (varied, variation): (&[[usize; 2]], &Function),
        scope: &Scope<'_>,
        text: &mut Code,
    ) {
        let real = self.real();
        text.open(format!(
            "while ({}(&isolation)) {{",
            self.runtime("isolation_needs_variation")
        ));
        for deviation in named.iter().filter(|deviation| deviation.is_varied) {
            let declared = match deviation.is_wanted {
                true => String::new(),
                false => format!("const {real} "),
            };
            text.line(format!(
                "{declared}{} = isolation.deviations[{}];",
                deviation.name, deviation.place
            ));
        }
        let inner = scope.inner(variation);
        self.plain_statements(&inner, text);
        for ([row, column], entry) in varied.iter().zip(self.results(&inner)) {
            text.line(format!("variation[{row}][{column}] = {entry};"));
        }
        text.close("}");
    }
}

/// Bound on the deviation of an unknown from the chord.
struct Deviation {
    place: usize,
    name: String,
    /// True if the variation of the Jacobian reads the bound.
    is_varied: bool,
    /// True if later statements read the bound.
    is_wanted: bool,
}
