//! The equations of a block → explicit definitions and the equations that remain for the tears.
//!
//! An unknown whose coefficient is a constant wherever it occurs is eliminated: one equation defines it, the definition is
//! put into the others. What remains mentions only angles and displacements (Elmqvist and Otter, Methods for tearing systems of
//! equations in object-oriented modeling, 1994). The definitions stay as they were written, not with all others put in, so
//! that each is one short sum.

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
}

/// One equation of a block.
#[derive(Clone, Copy, Debug)]
pub(super) struct Measured {
    /// Zero when satisfied.
    pub residual: ExprId,
    /// What it is measured in.
    pub quantity: Quantity,
}

/// A block after elimination.
#[derive(Clone, Debug)]
pub(super) struct Eliminated {
    /// In the order in which they can be computed, once the tears are known.
    pub definitions: Vec<Definition>,
    /// The equations that are left.
    pub residuals: Vec<Measured>,
    /// The unknowns that are left.
    pub tears: Vec<usize>,
}

/// Eliminates all unknowns that can be.
///
/// As by hand, an equation with only one such unknown left defines it, so that positions follow from one another along the
/// links. Only where a loop has no beginning the first unknown is taken from the first equation that mentions it.
pub(super) fn eliminate(
    residuals: Vec<Measured>,
    unknowns: &[usize],
    form: &VectorForm,
    graph: &mut Graph,
) -> Eliminated {
    let (mut eliminable, tears): (Vec<usize>, Vec<usize>) = unknowns
        .iter()
        .partition(|&&unknown| has_constant_coefficients(unknown, &residuals, form, graph));
    let mut rows: Vec<Equation> = residuals
        .into_iter()
        .map(|it| Equation {
            written: it.residual,
            reduced: it.residual,
            quantity: it.quantity,
        })
        .collect();
    let (mut forward, mut stuck) = (Vec::new(), Vec::new());
    let mut backward: Vec<Definition> = Vec::new();
    while !eliminable.is_empty() {
        let mentioned = |row: &Equation, graph: &Graph| -> Vec<usize> {
            let symbol = |unknown: usize| form.unknowns[unknown].position;
            eliminable
                .iter()
                .copied()
                .filter(|&unknown| graph.depends_on(row.reduced, symbol(unknown)))
                .collect()
        };
        let alone = rows
            .iter()
            .enumerate()
            .find_map(|(at, row)| match mentioned(row, graph)[..] {
                [only] => Some((at, only)),
                _ => None,
            });
        let first = || {
            let unknown = eliminable[0];
            let symbol = form.unknowns[unknown].position;
            rows.iter()
                .position(|row| graph.depends_on(row.reduced, symbol))
                .map(|at| (at, unknown))
        };
        let Some((at, unknown)) = alone.or_else(first) else {
            // Its equations have defined others: it is a tear after all.
            stuck.push(eliminable.remove(0));
            continue;
        };
        let symbol = form.unknowns[unknown].position;
        let row = rows.remove(at);
        let value = solve_linear(row.reduced, symbol, graph);
        if alone.is_some() {
            // The equation as written names unknowns that are defined by now, so it stays short; but not where it names one that
            // was taken out of a loop with this one, and is defined by it.
            // Nor where it names this one only by what was taken out of a loop.
            let mut short = value;
            if graph.depends_on(row.written, symbol) {
                let written = solve_linear(row.written, symbol, graph);
                if !leads_to(written, unknown, &backward, form, graph) {
                    short = written;
                }
            }
            forward.push(Definition {
                unknown,
                value: short,
            });
        } else {
            backward.push(Definition { unknown, value });
        }
        for row in &mut rows {
            if graph.depends_on(row.reduced, symbol) {
                row.reduced = graph.substitute(row.reduced, &[(symbol, value)]);
            }
        }
        eliminable.retain(|&other| other != unknown);
    }
    // What was taken out of a loop mentions unknowns that were defined after it.
    backward.reverse();
    let definitions = in_order(forward, backward, form, graph);
    let mut tears = [tears, stuck].concat();
    tears.sort_unstable();
    Eliminated {
        definitions,
        residuals: rows
            .iter()
            .map(|row| Measured {
                residual: row.reduced,
                quantity: row.quantity,
            })
            .collect(),
        tears,
    }
}

/// An equation as it was written, and with the definitions so far put in.
#[derive(Clone, Copy, Debug)]
struct Equation {
    written: ExprId,
    reduced: ExprId,
    quantity: Quantity,
}

/// Whether a value mentions an unknown, itself or through these definitions.
fn leads_to(
    value: ExprId,
    unknown: usize,
    definitions: &[Definition],
    form: &VectorForm,
    graph: &Graph,
) -> bool {
    let mut reached = vec![false; definitions.len()];
    let mut waiting = vec![value];
    while let Some(value) = waiting.pop() {
        if graph.depends_on(value, form.unknowns[unknown].position) {
            return true;
        }
        for (at, definition) in definitions.iter().enumerate() {
            let symbol = form.unknowns[definition.unknown].position;
            if !reached[at] && graph.depends_on(value, symbol) {
                reached[at] = true;
                waiting.push(definition.value);
            }
        }
    }
    false
}

/// Whether an unknown is multiplied by a number wherever it occurs, and turns nothing.
fn has_constant_coefficients(
    unknown: usize,
    residuals: &[Measured],
    form: &VectorForm,
    graph: &mut Graph,
) -> bool {
    let symbol = form.unknowns[unknown].position;
    residuals.iter().all(|&Measured { residual, .. }| {
        let slope = graph.derivative(residual, symbol);
        matches!(graph.node(slope), Node::Number(_)) && !turned_by(residual, unknown, form, graph)
    })
}

/// All definitions such that each mentions only those before it.
fn in_order(
    forward: Vec<Definition>,
    backward: Vec<Definition>,
    form: &VectorForm,
    graph: &Graph,
) -> Vec<Definition> {
    let mut waiting: Vec<Definition> = forward.into_iter().chain(backward).collect();
    let mut ordered = Vec::with_capacity(waiting.len());
    while !waiting.is_empty() {
        let ready = waiting.iter().position(|definition| {
            waiting.iter().all(|other| {
                !graph.depends_on(definition.value, form.unknowns[other.unknown].position)
            })
        });
        // Definitions were solved one after another, so they never wait for one another in a circle.
        ordered.push(waiting.remove(ready.unwrap_or(0)));
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

/// Whether an equation mentions an unknown, itself or through an arm that it turns.
pub(super) fn mentions(residual: ExprId, unknown: usize, form: &VectorForm, graph: &Graph) -> bool {
    graph.depends_on(residual, form.unknowns[unknown].position)
        || turned_by(residual, unknown, form, graph)
}

/// Whether an equation holds an arm that the unknown turns.
pub(super) fn turned_by(
    residual: ExprId,
    unknown: usize,
    form: &VectorForm,
    graph: &Graph,
) -> bool {
    form.arms_of(unknown).any(|arm| {
        arm.symbols
            .iter()
            .any(|&symbol| graph.depends_on(residual, symbol))
    })
}
