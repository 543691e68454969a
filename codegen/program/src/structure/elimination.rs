//! Reduces a block to explicit assignments and the equations of its tearing variables.
//!
//! An unknown with a constant coefficient in every occurrence is eliminated: one equation defines the unknown, and its definition
//! is substituted in the others. The remaining equations mention only angles and displacements (Elmqvist and Otter, Methods for
//! tearing systems of equations in object-oriented modeling, 1994).
//!
//! Definitions stay as written, without substitution of each other, so that each is a short sum.

use std::collections::{BTreeMap, BTreeSet};

use crate::expr::{ExprId, Graph, Node};
use crate::joint::Quantity;
use crate::pool::Pool;
use crate::system::VectorForm;

/// Explicit assignment of an eliminated unknown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Definition {
    /// Index into the unknowns of the vector form.
    pub unknown: usize,
    /// Value in terms of unknowns that are solved earlier.
    pub value: ExprId,
    /// Row of the vector form that gives the assignment.
    pub row: usize,
}

/// Equation of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BlockEquation {
    /// Residual, zero if the equation is satisfied.
    pub residual: ExprId,
    /// Row of the vector form before substitution.
    pub row: usize,
    /// Quantity of the residual.
    pub quantity: Quantity,
}

/// Block after elimination.
#[derive(Clone, Debug)]
pub(super) struct Eliminated {
    /// Assignments in the order of evaluation, from the tearing variables.
    pub definitions: Vec<Definition>,
    /// Equations that remain.
    pub residuals: Vec<BlockEquation>,
    /// Tearing variables, the unknowns that remain.
    pub tears: Vec<usize>,
}

/// Eliminates all unknowns that can be.
///
/// As by hand, an equation that has only one such unknown defines it, so that positions follow from one another along the links.
/// Only in a closed loop is the first unknown taken from the first equation that mentions it.
pub(super) fn eliminate(
    residuals: Vec<BlockEquation>,
    unknowns: &[usize],
    form: &VectorForm,
    pool: &mut Pool,
) -> Eliminated {
    let (mut eliminable, tears) = partitioned(unknowns, &residuals, form, pool);
    let rows = residuals.into_iter().map(|it| ReducedEquation {
        written: it.residual,
        reduced: it.residual,
        row: it.row,
        quantity: it.quantity,
    });
    let mut open = OpenEquations::new(rows.collect(), &eliminable, pool);
    let (mut forward, mut stuck) = (Vec::new(), Vec::new());
    let mut backward: Vec<Definition> = Vec::new();
    let mut taken_out: BTreeMap<usize, ExprId> = BTreeMap::new();
    while let Some(&earliest) = eliminable.first() {
        let alone = open.first_alone();
        let first = || Some((open.first_with(earliest)?, earliest));
        let Some((at, unknown)) = alone.or_else(first) else {
            // All equations of the unknown define others: the unknown is a tearing variable after all.
            stuck.push(earliest);
            eliminable.remove(&earliest);
            open.mentioning.remove(&earliest);
            continue;
        };
        let symbol = form.unknowns[unknown].position;
        let Some(row) = open.take(at) else {
            break;
        };
        let value = solve_linear(row.reduced, symbol, &mut pool.graph);
        if alone.is_some() {
            // The equation as written names defined unknowns, so its solution is short. It must not lead through an unknown of an
            // opened loop to an undefined one, which may depend on this definition.
            let mut short = value;
            if pool.graph.depends_on(row.written, symbol) {
                let written = solve_linear(row.written, symbol, &mut pool.graph);
                if !leads_to(written, &eliminable, &taken_out, pool) {
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
        open.put_in(unknown, value, form, pool);
    }
    // Unknowns of opened loops mention unknowns that were defined after them.
    backward.reverse();
    let definitions = in_order([forward, backward].concat(), pool);
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

/// Equation as written, and with all definitions so far substituted.
#[derive(Clone, Copy, Debug)]
struct ReducedEquation {
    written: ExprId,
    reduced: ExprId,
    row: usize,
    quantity: Quantity,
}

/// Equations that define nothing yet, with the unknowns to be eliminated that they mention.
struct OpenEquations {
    /// Equations in their order; `None` if an equation has been taken.
    rows: Vec<Option<ReducedEquation>>,
    /// Unknowns that each equation mentions.
    mentioned: Vec<BTreeSet<usize>>,
    /// Equations that mention each unknown.
    mentioning: BTreeMap<usize, BTreeSet<usize>>,
    /// Equations that mention a single unknown.
    alone: BTreeSet<usize>,
}

impl OpenEquations {
    fn new(rows: Vec<ReducedEquation>, eliminable: &BTreeSet<usize>, pool: &Pool) -> OpenEquations {
        let mut open = OpenEquations {
            mentioned: vec![BTreeSet::new(); rows.len()],
            rows: rows.into_iter().map(Some).collect(),
            mentioning: eliminable.iter().map(|&it| (it, BTreeSet::new())).collect(),
            alone: BTreeSet::new(),
        };
        for at in 0..open.rows.len() {
            open.note(at, pool);
        }
        open
    }

    /// Records the unknowns that an equation mentions now.
    fn note(&mut self, at: usize, pool: &Pool) {
        let Some(row) = self.rows[at] else { return };
        let symbols = pool.graph.symbols(row.reduced).iter();
        let unknowns = symbols.filter_map(|&symbol| pool.place_of_unknown(symbol));
        let mentioned: BTreeSet<usize> = unknowns
            .filter(|unknown| self.mentioning.contains_key(unknown))
            .collect();
        for gone in self.mentioned[at].difference(&mentioned) {
            if let Some(rows) = self.mentioning.get_mut(gone) {
                rows.remove(&at);
            }
        }
        for new in mentioned.difference(&self.mentioned[at]) {
            if let Some(rows) = self.mentioning.get_mut(new) {
                rows.insert(at);
            }
        }
        self.mentioned[at] = mentioned;
        match self.mentioned[at].len() {
            1 => self.alone.insert(at),
            _ => self.alone.remove(&at),
        };
    }

    /// Returns the first equation that mentions a single unknown, and this unknown.
    fn first_alone(&self) -> Option<(usize, usize)> {
        let at = *self.alone.first()?;
        Some((at, *self.mentioned[at].first()?))
    }

    /// Returns the first equation that mentions an unknown.
    fn first_with(&self, unknown: usize) -> Option<usize> {
        self.mentioning.get(&unknown)?.first().copied()
    }

    /// Removes an equation.
    fn take(&mut self, at: usize) -> Option<ReducedEquation> {
        for unknown in std::mem::take(&mut self.mentioned[at]) {
            if let Some(rows) = self.mentioning.get_mut(&unknown) {
                rows.remove(&at);
            }
        }
        self.alone.remove(&at);
        self.rows[at].take()
    }

    /// Substitutes the value of an unknown in the equations that mention it.
    fn put_in(&mut self, unknown: usize, value: ExprId, form: &VectorForm, pool: &mut Pool) {
        let symbol = form.unknowns[unknown].position;
        for at in self.mentioning.remove(&unknown).unwrap_or_default() {
            self.mentioned[at].remove(&unknown);
            if let Some(row) = &mut self.rows[at] {
                row.reduced = pool.graph.substitute(row.reduced, &[(symbol, value)]);
            }
            self.note(at, pool);
        }
    }
}

/// True if a value mentions one of these unknowns, directly or through these definitions.
fn leads_to(
    value: ExprId,
    unknowns: &BTreeSet<usize>,
    definitions: &BTreeMap<usize, ExprId>,
    pool: &Pool,
) -> bool {
    let mut reached = BTreeSet::new();
    let mut waiting = vec![value];
    while let Some(value) = waiting.pop() {
        let symbols = pool.graph.symbols(value).iter();
        for named in symbols.filter_map(|&symbol| pool.place_of_unknown(symbol)) {
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

/// Splits unknowns into those with a number as coefficient everywhere that rotate nothing, and the others.
fn partitioned(
    unknowns: &[usize],
    residuals: &[BlockEquation],
    form: &VectorForm,
    pool: &mut Pool,
) -> (BTreeSet<usize>, Vec<usize>) {
    let mut turning = BTreeSet::new();
    let mut rows_of: BTreeMap<usize, Vec<ExprId>> = BTreeMap::new();
    for &BlockEquation { residual, .. } in residuals {
        for &symbol in pool.graph.symbols(residual) {
            if let Some(place) = pool.place_of_symbol(symbol) {
                turning.insert(pool.arms()[place].angle);
            }
            if let Some(unknown) = pool.place_of_unknown(symbol) {
                rows_of.entry(unknown).or_default().push(residual);
            }
        }
    }
    let mut has_constant_coefficients = |unknown: &usize| {
        let symbol = form.unknowns[*unknown].position;
        let mut rows = rows_of.get(unknown).into_iter().flatten();
        !turning.contains(unknown)
            && rows.all(|&residual| {
                let slope = pool.graph.derivative(residual, symbol);
                matches!(pool.graph.node(slope), Node::Number(_))
            })
    };
    let (eliminable, tears): (Vec<usize>, Vec<usize>) = unknowns
        .iter()
        .partition(|unknown| has_constant_coefficients(unknown));
    (eliminable.into_iter().collect(), tears)
}

/// Sorts definitions so that each mentions only earlier ones; ties keep the given order.
pub(super) fn in_order(all: Vec<Definition>, pool: &Pool) -> Vec<Definition> {
    let place_of: BTreeMap<usize, usize> = all
        .iter()
        .enumerate()
        .map(|(at, it)| (it.unknown, at))
        .collect();
    // Counts of missing definitions, and the definitions that wait for each.
    let (mut missing, mut waiting) = (vec![0; all.len()], vec![Vec::new(); all.len()]);
    for (at, definition) in all.iter().enumerate() {
        let symbols = pool.graph.symbols(definition.value).iter();
        let named = symbols.filter_map(|&symbol| pool.place_of_unknown(symbol));
        for needed in named.filter_map(|unknown| place_of.get(&unknown)) {
            missing[at] += 1;
            waiting[*needed].push(at);
        }
    }
    let mut left: BTreeSet<usize> = (0..all.len()).collect();
    let mut ready: BTreeSet<usize> = (0..all.len()).filter(|&at| missing[at] == 0).collect();
    let mut ordered = Vec::with_capacity(all.len());
    // Definitions were solved one after another, so they do not form a cycle.
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

/// Returns the value of a symbol that occurs linearly in residual = 0.
fn solve_linear(residual: ExprId, symbol: crate::expr::SymbolId, graph: &mut Graph) -> ExprId {
    let slope = graph.derivative(residual, symbol);
    let zero = graph.zero();
    let rest = graph.substitute(residual, &[(symbol, zero)]);
    let ratio = graph.divide(rest, slope);
    graph.negate(ratio)
}
