//! Names long choices, and the shared parts of long formulas.
//!
//! A choice that would fill a line by itself, or holds one that does, is written once under the name `piece_1`, and
//! by its name wherever it occurs. Its derivatives are named after it, `piece_1_slope` and `piece_1_curvature`. An
//! argument shifted into one period is `turn_1` in the definitions. Names are given when a printer meets a choice,
//! parts before the choices that contain them, so that every definition follows those that it needs. Without a long
//! choice nothing gets a name.
//!
//! In a formula too long to read at once, a part that occurs more than once on the page is `part_1` wherever it
//! occurs again. So a page grows with the graph of its formulas, and not with their tree.

mod definitions;

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet, HashSet};

use super::Notation;
use super::formula::Printer;
use crate::expr::{ExprId, Graph, Node, SymbolId};
use crate::pool::{Pool, SymbolRole};
use crate::system::System;

/// Longest choice that stands where it is used, in characters, without a name in it.
const LONGEST_IN_PLACE: usize = 75;

/// Longest derivative of a named choice that stands where it is used, in characters.
const LONGEST_SLOPE_IN_PLACE: usize = 40;

/// Longest formula without names for shared parts, in characters.
pub(super) const LONGEST_FORMULA: u64 = 2000;

/// Shortest shared part of a long formula that has a name, in characters.
const LONGEST_SHARED: u64 = 40;

/// Names on one page.
#[derive(Clone, Debug, Default)]
pub(super) struct NamedParts {
    state: RefCell<State>,
}

#[derive(Clone, Debug, Default)]
struct State {
    /// Choices and shared parts met so far; `None` for those that stay in place.
    names: BTreeMap<ExprId, Option<String>>,
    /// Those with a name in the order in which they got it.
    named: Vec<ExprId>,
    /// Number of names that are defined on the page already.
    defined: usize,
    /// Number of names with a number of their own.
    numbers: usize,
    /// Choice of which each choice is the derivative, and the variable.
    slopes: BTreeMap<ExprId, (ExprId, SymbolId)>,
    /// True if no more names are given.
    is_settled: bool,
    /// Names of the first `defined` of them, as expressions.
    symbols: BTreeMap<ExprId, ExprId>,
    /// Numbers of whole periods in definitions, with their replacements.
    turns: BTreeMap<ExprId, ExprId>,
    /// Parts of long formulas that were met.
    met: HashSet<ExprId>,
    /// Parts of long formulas that were met twice.
    shared: HashSet<ExprId>,
    /// Number of shared parts with a name.
    parts: usize,
    /// Parts of formulas that were searched for choices.
    searched: HashSet<ExprId>,
}

impl NamedParts {
    /// Names for the rows of a system, with derivatives of the residuals up to the second.
    pub(super) fn of_rows(pool: &mut Pool, system: &System) -> NamedParts {
        let parts = NamedParts::default();
        for row in 0..system.rows.len() {
            let residual = system.rows[row].residual;
            parts.relate(pool, residual, 2);
        }
        parts
    }

    /// Names that are defined on the page already, and no others: every other choice stays in place.
    pub(super) fn settled(&self) -> NamedParts {
        let mut state = self.state.borrow().clone();
        for undefined in state.named.split_off(state.defined) {
            state.names.remove(&undefined);
        }
        state.is_settled = true;
        NamedParts {
            state: RefCell::new(state),
        }
    }

    /// Looks for parts that a long formula shares with itself and with those before it. Choices are searched on their
    /// own. True if it is long.
    pub(super) fn meet(&self, graph: &Graph, formula: ExprId) -> bool {
        let state = &mut *self.state.borrow_mut();
        let is_within = |expr, longest, shared: &HashSet<ExprId>| {
            let has_name =
                |part| shared.contains(&part) || matches!(graph.node(part), Node::Choose { .. });
            graph.is_within_with_names(expr, longest, &has_name)
        };
        if state.is_settled || is_within(formula, LONGEST_FORMULA, &HashSet::new()) {
            return false;
        }
        let mut open = vec![formula];
        while let Some(expr) = open.pop() {
            let is_choice = matches!(graph.node(expr), Node::Choose { .. });
            if is_choice
                || graph.is_constant(expr)
                || is_within(expr, LONGEST_SHARED, &state.shared)
            {
                continue;
            }
            if state.met.insert(expr) {
                open.extend(graph.operands(expr));
            } else {
                state.shared.insert(expr);
            }
        }
        true
    }

    /// True if a formula takes at most this number of characters with the names in it.
    pub(super) fn is_within(&self, graph: &Graph, formula: ExprId, characters: u64) -> bool {
        let state = self.state.borrow();
        let is_choice = |part| !state.is_settled && matches!(graph.node(part), Node::Choose { .. });
        let has_name = |part| is_choice(part) || matches!(state.names.get(&part), Some(Some(_)));
        graph.is_within_with_names(formula, characters, &has_name)
    }

    /// Name of an expression; `None` if it is written out.
    pub(super) fn name(&self, pool: &Pool, system: &System, expr: ExprId) -> Option<String> {
        if let Some(known) = self.state.borrow().names.get(&expr) {
            return known.clone();
        }
        let is_choice = matches!(pool.graph.node(expr), Node::Choose { .. });
        let state = self.state.borrow();
        if state.is_settled || !is_choice && !state.shared.contains(&expr) {
            return None;
        }
        drop(state);
        match is_choice {
            true => self.name_of_choice(pool, system, expr),
            false => Some(self.name_of_part(pool, system, expr)),
        }
    }

    fn name_of_part(&self, pool: &Pool, system: &System, part: ExprId) -> String {
        // Printing it names its parts first. It has no name in its own definition.
        self.state.borrow_mut().names.insert(part, None);
        Printer::new(pool, system, &[], Notation::Ascii)
            .naming(self, true)
            .written_out(part);
        let mut state = self.state.borrow_mut();
        state.parts += 1;
        let name = format!("part_{}", state.parts);
        state.named.push(part);
        state.names.insert(part, Some(name.clone()));
        name
    }

    fn name_of_choice(&self, pool: &Pool, system: &System, choice: ExprId) -> Option<String> {
        let origin = self.state.borrow().slopes.get(&choice).copied();
        let of = origin.and_then(|(whole, by)| Some((self.name(pool, system, whole)?, whole, by)));
        let graph = &pool.graph;
        let (mut rest, mut is_long) = (choice, false);
        while let Node::Choose {
            condition,
            below,
            otherwise,
        } = *graph.node(rest)
        {
            is_long |= self.meet(graph, condition);
            is_long |= self.meet(graph, below);
            rest = otherwise;
        }
        is_long |= self.meet(graph, rest);
        // Printing it names its parts first.
        let printed = Printer::new(pool, system, &[], Notation::Ascii)
            .naming(self, is_long)
            .written_out(choice);
        let longest = match of {
            Some(_) => LONGEST_SLOPE_IN_PLACE,
            None => LONGEST_IN_PLACE,
        };
        let is_long = printed.len() > longest || self.holds_more(pool, choice);
        let name = is_long.then(|| match of {
            Some((of, whole, by)) => {
                slope_name(&of, moving(pool, whole).len() == 1, pool, system, by)
            }
            None => {
                let mut state = self.state.borrow_mut();
                state.numbers += 1;
                format!("piece_{}", state.numbers)
            }
        });
        let mut state = self.state.borrow_mut();
        if name.is_some() {
            state.named.push(choice);
        }
        state.names.insert(choice, name.clone());
        name
    }

    /// True if a choice holds a named one, or a number of whole periods: then it is long as a whole.
    fn holds_more(&self, pool: &Pool, choice: ExprId) -> bool {
        let graph = &pool.graph;
        let state = self.state.borrow();
        let mut parts = parts_of(graph, choice, |_| true).into_iter();
        parts.any(|part| {
            let is_named = matches!(state.names.get(&part), Some(Some(_)));
            is_named || matches!(graph.node(part), Node::Floor(_))
        })
    }

    /// Records the choices that are derivatives of those in an expression, up to an order.
    pub(super) fn relate(&self, pool: &mut Pool, expr: ExprId, order: usize) {
        let mut choices = self.new_choices(&pool.graph, expr);
        for _ in 0..order {
            let mut slopes = BTreeSet::new();
            for &whole in &choices {
                for by in moving(pool, whole) {
                    let graph = &mut pool.graph;
                    let slope = graph.derivative(whole, by);
                    if matches!(graph.node(slope), Node::Choose { .. }) && slope != whole {
                        slopes.insert(slope);
                        let mut state = self.state.borrow_mut();
                        state.slopes.entry(slope).or_insert((whole, by));
                    }
                }
            }
            choices = slopes;
        }
    }

    /// Choices in an expression that have not been met before.
    fn new_choices(&self, graph: &Graph, expr: ExprId) -> BTreeSet<ExprId> {
        let searched = &mut self.state.borrow_mut().searched;
        let mut choices = BTreeSet::new();
        let mut open = vec![expr];
        while let Some(expr) = open.pop() {
            if searched.insert(expr) {
                open.extend(graph.operands(expr));
                if matches!(graph.node(expr), Node::Choose { .. }) {
                    choices.insert(expr);
                }
            }
        }
        choices
    }
}

/// Name of a derivative.
fn slope_name(of: &str, is_only: bool, pool: &Pool, system: &System, by: SymbolId) -> String {
    if !is_only {
        return format!("{of}_by_{}", symbol_name(pool, system, by));
    }
    match of.strip_suffix("_slope") {
        Some(twice) => format!("{twice}_curvature"),
        None => format!("{of}_slope"),
    }
}

fn symbol_name(pool: &Pool, system: &System, symbol: SymbolId) -> String {
    let name = match pool.role(symbol) {
        SymbolRole::Position(unknown) => system.unknown_name(unknown),
        _ => pool.local_name(symbol),
    };
    name.to_string()
}

/// Symbols of an expression that change during a motion.
fn moving(pool: &Pool, expr: ExprId) -> Vec<SymbolId> {
    let symbols = pool.graph.symbols(expr).iter().copied();
    symbols
        .filter(|symbol| !matches!(pool.role(*symbol), SymbolRole::Parameter(_)))
        .collect()
}

/// Parts of an expression that are of a kind, itself included.
fn parts_of(graph: &Graph, expr: ExprId, is: impl Fn(&Node) -> bool) -> BTreeSet<ExprId> {
    let mut seen = BTreeSet::from([expr]);
    let mut open = vec![expr];
    while let Some(expr) = open.pop() {
        open.extend(
            graph
                .operands(expr)
                .into_iter()
                .filter(|&it| seen.insert(it)),
        );
    }
    seen.retain(|&it| is(graph.node(it)));
    seen
}
