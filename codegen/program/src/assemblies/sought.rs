//! *A block without a closed form, and what is known before it* → *the functions of one or two of its unknowns whose zeros are its poses*.
//!
//! Of a torn block these are its tears, with the signs of the closed forms that find everything else; of another one its unknowns,
//! where there are so few. They are angles, and all equations are the same a turn further: then every pose has them in one turn.

use super::enclosed::{Enclosed, Enclosing, Place};
use super::interval::Interval;
use super::turns::is_periodic;
use crate::expr::{Graph, SymbolId};
use crate::joint::Quantity;
use crate::program::{Function, NewtonBlock};
use crate::system::System;

/// The most signs of closed forms whose choices are all tried.
const MOST_SIGNS: usize = 8;

/// The functions of what is sought in a block.
#[derive(Clone, Debug)]
pub(super) struct Sought {
    /// Which of the block's unknowns are sought, from 0.
    pub places: Vec<usize>,
    /// How many signs the closed forms have that find the others.
    pub signs: usize,
    /// What remains, then its derivatives by what is sought, row by row.
    functions: Enclosed,
    /// The cosines of all unknowns of the block, and then their sines; of a length itself, and zero.
    whole: Enclosed,
}

impl Sought {
    /// What is sought in a block; `None` where more than two unknowns would be, or turns make a difference.
    pub fn of(
        newton: &NewtonBlock,
        system: &System,
        known: &dyn Fn(SymbolId) -> Option<Interval>,
    ) -> Option<Sought> {
        let graph = &system.mechanism.graph;
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
            let own = unknowns[place];
            own.quantity == Quantity::Angle && is_periodic(&newton.residual, own.position, graph)
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

    /// What remains and its derivatives, over a part of what is sought.
    pub fn remaining(
        &self,
        part: &[Interval],
        choice: usize,
        registers: &mut Vec<Interval>,
    ) -> Vec<Interval> {
        self.functions.at(&self.arguments(part, choice), registers)
    }

    /// The cosines and sines of all unknowns of the block, or the unknown itself and zero.
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

/// The symbols that the functions of a block read.
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
