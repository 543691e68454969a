//! The equations of a block → explicit definitions and the equations that remain for the tears.
//!
//! An unknown whose coefficient is a constant wherever it occurs is eliminated: one equation defines it, the definition is
//! put into the others. What remains mentions only angles and displacements (Elmqvist and Otter, Methods for tearing systems of
//! equations in object-oriented modeling, 1994). The definitions stay as they were written, not with all others put in, so
//! that each is one short sum.

use std::collections::{BTreeMap, BTreeSet};

use crate::expr::{ExprId, Graph, Node};
use crate::joint::Quantity;
use crate::system::VectorForm;

/// One eliminated unknown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Definition {
    /// Index into the unknowns of the vector form.
    pub unknown: usize,
    /// Its value in terms of what is solved before it.
    pub value: ExprId,
    /// The row of the vector form that says so.
    pub row: usize,
}

/// One equation of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BlockEquation {
    /// Zero when satisfied.
    pub residual: ExprId,
    /// The row of the vector form that it was before anything was put in.
    pub row: usize,
    /// What it is measured in.
    pub quantity: Quantity,
}

/// A block after elimination.
#[derive(Clone, Debug)]
pub(super) struct Eliminated {
    /// In the order in which they can be computed, once the tears are known.
    pub definitions: Vec<Definition>,
    /// The equations that are left.
    pub residuals: Vec<BlockEquation>,
    /// The unknowns that are left.
    pub tears: Vec<usize>,
}

/// Eliminates all unknowns that can be.
///
/// As by hand, an equation with only one such unknown left defines it, so that positions follow from one another along the
/// links. Only where a loop has no beginning the first unknown is taken from the first equation that mentions it.
pub(super) fn eliminate(
    residuals: Vec<BlockEquation>,
    unknowns: &[usize],
    form: &VectorForm,
    graph: &mut Graph,
) -> Eliminated {
    let (mut eliminable, tears) = partitioned(unknowns, &residuals, form, graph);
    let rows = residuals.into_iter().map(|it| ReducedEquation {
        written: it.residual,
        reduced: it.residual,
        row: it.row,
        quantity: it.quantity,
    });
    let mut open = OpenEquations::new(rows.collect(), &eliminable, form, graph);
    let (mut forward, mut stuck) = (Vec::new(), Vec::new());
    let mut backward: Vec<Definition> = Vec::new();
    let mut taken_out: BTreeMap<usize, ExprId> = BTreeMap::new();
    while let Some(&earliest) = eliminable.first() {
        let alone = open.first_alone();
        let first = || Some((open.first_with(earliest)?, earliest));
        let Some((at, unknown)) = alone.or_else(first) else {
            // Its equations have defined others: it is a tear after all.
            stuck.push(earliest);
            eliminable.remove(&earliest);
            open.mentioning.remove(&earliest);
            continue;
        };
        let symbol = form.unknowns[unknown].position;
        let Some(row) = open.take(at) else {
            break;
        };
        let value = solve_linear(row.reduced, symbol, graph);
        if alone.is_some() {
            // The equation as written names unknowns that are defined by now, so it stays short; but not where it leads, by what was
            // taken out of a loop, to an unknown that is not: that one may be defined by this one.
            let mut short = value;
            if graph.depends_on(row.written, symbol) {
                let written = solve_linear(row.written, symbol, graph);
                if !leads_to(written, &eliminable, &taken_out, form, graph) {
                    short = written;
                }
            }
            forward.push(Definition {
                unknown,
                value: short,
                row: row.row,
            });
        } else {
            taken_out.insert(unknown, value);
            backward.push(Definition {
                unknown,
                value,
                row: row.row,
            });
        }
        eliminable.remove(&unknown);
        open.put_in(unknown, value, form, graph);
    }
    // What was taken out of a loop mentions unknowns that were defined after it.
    backward.reverse();
    let definitions = in_order([forward, backward].concat(), form, graph);
    let mut tears = [tears, stuck].concat();
    tears.sort_unstable();
    let left = open.rows.into_iter().flatten();
    Eliminated {
        definitions,
        residuals: left
            .map(|row| BlockEquation {
                residual: row.reduced,
                row: row.row,
                quantity: row.quantity,
            })
            .collect(),
        tears,
    }
}

/// An equation as it was written, and with the definitions so far put in.
#[derive(Clone, Copy, Debug)]
struct ReducedEquation {
    written: ExprId,
    reduced: ExprId,
    row: usize,
    quantity: Quantity,
}

/// The equations that define nothing yet, and which of them mention which unknown that is to be eliminated.
struct OpenEquations {
    /// In their order; nothing where one has been taken.
    rows: Vec<Option<ReducedEquation>>,
    /// The unknowns that each mentions.
    mentioned: Vec<BTreeSet<usize>>,
    /// The equations that mention each unknown.
    mentioning: BTreeMap<usize, BTreeSet<usize>>,
    /// The equations that mention one only.
    alone: BTreeSet<usize>,
}

impl OpenEquations {
    fn new(
        rows: Vec<ReducedEquation>,
        eliminable: &BTreeSet<usize>,
        form: &VectorForm,
        graph: &Graph,
    ) -> OpenEquations {
        let mut open = OpenEquations {
            mentioned: vec![BTreeSet::new(); rows.len()],
            rows: rows.into_iter().map(Some).collect(),
            mentioning: eliminable.iter().map(|&it| (it, BTreeSet::new())).collect(),
            alone: BTreeSet::new(),
        };
        for at in 0..open.rows.len() {
            open.note(at, form, graph);
        }
        open
    }

    /// Notes what an equation mentions by now.
    fn note(&mut self, at: usize, form: &VectorForm, graph: &Graph) {
        let Some(row) = self.rows[at] else { return };
        let symbols = graph.symbols(row.reduced).iter();
        let unknowns = symbols.filter_map(|&symbol| form.place_of_unknown(symbol));
        let own: BTreeSet<usize> = unknowns
            .filter(|unknown| self.mentioning.contains_key(unknown))
            .collect();
        for gone in self.mentioned[at].difference(&own) {
            if let Some(rows) = self.mentioning.get_mut(gone) {
                rows.remove(&at);
            }
        }
        for new in own.difference(&self.mentioned[at]) {
            if let Some(rows) = self.mentioning.get_mut(new) {
                rows.insert(at);
            }
        }
        self.mentioned[at] = own;
        match self.mentioned[at].len() {
            1 => self.alone.insert(at),
            _ => self.alone.remove(&at),
        };
    }

    /// The first equation that mentions one unknown only, and that.
    fn first_alone(&self) -> Option<(usize, usize)> {
        let at = *self.alone.first()?;
        Some((at, *self.mentioned[at].first()?))
    }

    /// The first equation that mentions an unknown.
    fn first_with(&self, unknown: usize) -> Option<usize> {
        self.mentioning.get(&unknown)?.first().copied()
    }

    /// Takes out an equation.
    fn take(&mut self, at: usize) -> Option<ReducedEquation> {
        for unknown in std::mem::take(&mut self.mentioned[at]) {
            if let Some(rows) = self.mentioning.get_mut(&unknown) {
                rows.remove(&at);
            }
        }
        self.alone.remove(&at);
        self.rows[at].take()
    }

    /// Puts the value of an unknown into the equations that mention it.
    fn put_in(&mut self, unknown: usize, value: ExprId, form: &VectorForm, graph: &mut Graph) {
        let symbol = form.unknowns[unknown].position;
        for at in self.mentioning.remove(&unknown).unwrap_or_default() {
            self.mentioned[at].remove(&unknown);
            if let Some(row) = &mut self.rows[at] {
                row.reduced = graph.substitute(row.reduced, &[(symbol, value)]);
            }
            self.note(at, form, graph);
        }
    }
}

/// Whether a value mentions one of these unknowns, itself or through these definitions.
fn leads_to(
    value: ExprId,
    unknowns: &BTreeSet<usize>,
    definitions: &BTreeMap<usize, ExprId>,
    form: &VectorForm,
    graph: &Graph,
) -> bool {
    let mut reached = BTreeSet::new();
    let mut waiting = vec![value];
    while let Some(value) = waiting.pop() {
        let symbols = graph.symbols(value).iter();
        for named in symbols.filter_map(|&symbol| form.place_of_unknown(symbol)) {
            if unknowns.contains(&named) {
                return true;
            }
            if let Some(&further) = definitions.get(&named)
                && reached.insert(named)
            {
                waiting.push(further);
            }
        }
    }
    false
}

/// The unknowns that are multiplied by a number wherever they occur and turn nothing, and the others.
fn partitioned(
    unknowns: &[usize],
    residuals: &[BlockEquation],
    form: &VectorForm,
    graph: &mut Graph,
) -> (BTreeSet<usize>, Vec<usize>) {
    let mut turning = BTreeSet::new();
    let mut rows_of: BTreeMap<usize, Vec<ExprId>> = BTreeMap::new();
    for &BlockEquation { residual, .. } in residuals {
        for &symbol in graph.symbols(residual) {
            if let Some(place) = form.place_of_symbol(symbol) {
                turning.insert(form.arms[place].angle);
            }
            if let Some(unknown) = form.place_of_unknown(symbol) {
                rows_of.entry(unknown).or_default().push(residual);
            }
        }
    }
    let mut has_constant_coefficients = |unknown: &usize| {
        let symbol = form.unknowns[*unknown].position;
        let mut rows = rows_of.get(unknown).into_iter().flatten();
        !turning.contains(unknown)
            && rows.all(|&residual| {
                let slope = graph.derivative(residual, symbol);
                matches!(graph.node(slope), Node::Number(_))
            })
    };
    let (eliminable, tears): (Vec<usize>, Vec<usize>) = unknowns
        .iter()
        .partition(|unknown| has_constant_coefficients(unknown));
    (eliminable.into_iter().collect(), tears)
}

/// All definitions such that each mentions only those before it; of those that could be next, the first.
pub(super) fn in_order(all: Vec<Definition>, form: &VectorForm, graph: &Graph) -> Vec<Definition> {
    let place_of: BTreeMap<usize, usize> = all
        .iter()
        .enumerate()
        .map(|(at, it)| (it.unknown, at))
        .collect();
    // How many each waits for, and who waits for it.
    let (mut missing, mut waiting) = (vec![0; all.len()], vec![Vec::new(); all.len()]);
    for (at, definition) in all.iter().enumerate() {
        let symbols = graph.symbols(definition.value).iter();
        let named = symbols.filter_map(|&symbol| form.place_of_unknown(symbol));
        for needed in named.filter_map(|unknown| place_of.get(&unknown)) {
            missing[at] += 1;
            waiting[*needed].push(at);
        }
    }
    let mut left: BTreeSet<usize> = (0..all.len()).collect();
    let mut ready: BTreeSet<usize> = (0..all.len()).filter(|&at| missing[at] == 0).collect();
    let mut ordered = Vec::with_capacity(all.len());
    // Definitions were solved one after another, so they never wait for one another in a circle.
    while let Some(next) = ready.pop_first().or_else(|| left.first().copied()) {
        left.remove(&next);
        ordered.push(all[next]);
        for &at in &waiting[next] {
            missing[at] -= 1;
            if missing[at] == 0 && left.contains(&at) {
                ready.insert(at);
            }
        }
    }
    ordered
}

/// The value of a symbol that occurs linearly in residual = 0.
fn solve_linear(residual: ExprId, symbol: crate::expr::SymbolId, graph: &mut Graph) -> ExprId {
    let slope = graph.derivative(residual, symbol);
    let zero = graph.zero();
    let rest = graph.substitute(residual, &[(symbol, zero)]);
    let ratio = graph.divide(rest, slope);
    graph.negate(ratio)
}
