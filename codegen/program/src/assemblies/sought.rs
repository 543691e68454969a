//! Reduces a block without a closed form to functions of one or two unknowns whose zeros are its poses.
//!
//! For a torn block, these unknowns are its tearing variables, with the signs of the closed forms for all others; for another
//! block, all unknowns if there are at most two. The unknowns are angles, and all equations are periodic in them: so every pose
//! lies in one turn.

use super::enclosed::{Enclosed, Enclosing, Place};
use super::interval::Interval;
use super::turns::is_periodic;
use crate::expr::{Graph, SymbolId};
use crate::joint::Quantity;
use crate::pool::Pool;
use crate::program::{Function, NewtonBlock};
use crate::system::System;

/// Largest number of signs of closed forms with all combinations tried.
const MOST_SIGNS: usize = 8;

/// Functions of the searched unknowns of a block.
#[derive(Clone, Debug)]
pub(super) struct Sought {
    /// Searched unknowns of the block: indices from 0.
    pub places: Vec<usize>,
    /// Number of signs of the closed forms for the other unknowns.
    pub signs: usize,
    /// Residuals, then their derivatives in the searched unknowns, row by row.
    functions: Enclosed,
    /// Cosines of all unknowns of the block, then their sines; for a length, the length and zero.
    whole: Enclosed,
}

impl Sought {
    /// Returns the functions of a block; `None` if they have more than two unknowns or are not periodic.
    pub fn of(
        newton: &NewtonBlock,
        pool: &Pool,
        system: &System,
        known: &dyn Fn(SymbolId) -> Option<Interval>,
    ) -> Option<Sought> {
        let graph = &pool.graph;
        let places = match &newton.tearing {
            Some(tearing) => tearing.tears.clone(),
            None => (0..newton.unknowns.len()).collect(),
        };
        let signs = newton.tearing.as_ref().map_or(&[][..], |it| &it.signs);
        if places.is_empty() || places.len() > 2 || signs.len() > MOST_SIGNS {
            return None;
        }
        let unknowns = newton.unknowns.iter();
        let unknowns: Vec<_> = unknowns
            .map(|&it| &system.vector_form.unknowns[it])
            .collect();
        let is_sought = |&place: &usize| {
            let unknown = unknowns[place];
            unknown.quantity == Quantity::Angle
                && is_periodic(&newton.residual, unknown.position, graph)
        };
        if !places.iter().all(is_sought) {
            return None;
        }
        let arguments = places.iter().map(|&place| unknowns[place].position);
        let arguments: Vec<SymbolId> = arguments.chain(signs.iter().copied()).collect();
        let enclosing = || {
            let mut enclosing = Enclosing::new(graph, &arguments);
            for symbol in read(newton, graph) {
                if let Some(value) = known(symbol).filter(|_| !arguments.contains(&symbol)) {
                    enclosing.know(symbol, value);
                }
            }
            enclosing
        };
        let mut remaining = enclosing();
        let mut whole = enclosing();
        let (remaining_results, whole_results) = match &newton.tearing {
            Some(tearing) => {
                whole.statements(&tearing.evaluate);
                let mut all = whole.results(&tearing.complete);
                all.truncate(2 * unknowns.len());
                for &(symbol, square) in &tearing.proof.turned {
                    remaining.limit(symbol, square);
                }
                (remaining.results(&tearing.proof.function), all)
            }
            None => {
                let mut results = remaining.results(&newton.residual);
                results.extend(remaining.results(&newton.jacobian));
                let angles = || (0..places.len()).map(Place::Argument);
                let cosines: Vec<Place> = angles().map(|it| whole.cosine(it)).collect();
                let sines = angles().map(|it| whole.sine(it)).collect();
                (results, [cosines, sines].concat())
            }
        };
        Some(Sought {
            signs: signs.len(),
            functions: remaining.finish(remaining_results),
            whole: whole.finish(whole_results),
            places,
        })
    }

    /// Returns residuals and derivatives over a part of the search range.
    pub fn remaining(
        &self,
        part: &[Interval],
        choice: usize,
        registers: &mut Vec<Interval>,
    ) -> Vec<Interval> {
        self.functions.at(&self.arguments(part, choice), registers)
    }

    /// Returns the cosines and sines of all unknowns of the block; for a length, the length and zero.
    pub fn whole(&self, at: &[f64], choice: usize) -> Vec<Interval> {
        let at: Vec<Interval> = at.iter().map(|&value| Interval::point(value)).collect();
        self.whole.at(&self.arguments(&at, choice), &mut Vec::new())
    }

    fn arguments(&self, part: &[Interval], choice: usize) -> Vec<Interval> {
        let signs = (0..self.signs).map(|bit| {
            Interval::point(match choice >> bit & 1 {
                0 => 1.0,
                _ => -1.0,
            })
        });
        part.iter().copied().chain(signs).collect()
    }
}

/// Returns the symbols that the functions of a block read.
pub fn read(newton: &NewtonBlock, graph: &Graph) -> Vec<SymbolId> {
    let tearing = newton.tearing.iter();
    let torn = tearing.flat_map(|it| [&it.evaluate, &it.complete, &it.proof.function]);
    let functions = [&newton.residual, &newton.jacobian].into_iter().chain(torn);
    let values = functions.flat_map(Function::values);
    let squares = newton.tearing.iter().flat_map(|it| &it.proof.turned);
    let values = values.chain(squares.map(|(_, square)| *square));
    let mut read: Vec<SymbolId> = values
        .flat_map(|expr| graph.symbols(expr).iter().copied())
        .collect();
    read.sort();
    read.dedup();
    read
}
