//! Describes the singular poses of blocks without a closed form.
//!
//! A platform on three links that transmit only axial forces is singular if the lines of the links meet in one point or are
//! parallel. The platform can then rotate about that point, or move across the lines (Gosselin and Angeles 1990). Other blocks
//! are described by their bodies and pins, since no shorter condition is known.

use super::ends::{End, movable};
use super::known::Known;
use super::lists::enumerated;
use super::phrase::{Phrase, Piece, phrase};
use super::singular::SingularWords;
use crate::pool::Pool;
use crate::structure::SolvedBlock;
use crate::system::System;

/// Largest number of bodies, and of pins, in a sentence.
const MAX_LISTED: usize = 8;

/// Number of links of a platform.
const LEGS: usize = 3;

impl Known {
    pub(super) fn of_coupled(
        &self,
        unknowns: &[usize],
        block: &SolvedBlock,
        pool: &mut Pool,
        system: &System,
    ) -> SingularWords {
        let ends: Vec<Vec<End>> = unknowns
            .iter()
            .map(|&unknown| self.coupled_ends(unknown, unknowns, block, pool, system))
            .collect();
        if let Some(legs) = self.legs(unknowns, &ends, block, pool, system) {
            let lines = legs.map(|[from, to]| phrase![Piece::Name(from), "-", Piece::Name(to)]);
            return SingularWords::both(phrase![
                "the lines ",
                enumerated(&lines),
                " meet in one point or are parallel"
            ]);
        }
        let mut moved: Vec<Phrase> = unknowns
            .iter()
            .map(|&it| movable(it, pool, system))
            .collect();
        moved.dedup();
        let mut pins: Vec<String> = Vec::new();
        for end in ends.into_iter().flatten() {
            if !pins.contains(&end.name) {
                pins.push(end.name);
            }
        }
        let pins: Vec<Phrase> = pins.into_iter().map(|it| Piece::Name(it).into()).collect();
        let joined = match pins.is_empty() {
            true => Phrase::default(),
            false => phrase![", joined at ", shortened(pins), ","],
        };
        let bodies = phrase![shortened(moved), joined, " can move although "];
        let points = match unknowns {
            &[only] => phrase![
                Piece::Unknown(only),
                " can move although everything before it "
            ],
            _ => phrase![&bodies, "everything before them "],
        };
        SingularWords {
            points: phrase![points, "stands still"],
            bodies: phrase![bodies, "the drivers stand still"],
        }
    }

    /// Returns the ends of the link or body of one unknown that are known or rotate with another unknown.
    fn coupled_ends(
        &self,
        unknown: usize,
        unknowns: &[usize],
        block: &SolvedBlock,
        pool: &mut Pool,
        system: &System,
    ) -> Vec<End> {
        let mut ends = self.ends(unknown, block, pool, system);
        ends.retain(|end| {
            let mut others = unknowns.iter().filter(|it| **it != unknown);
            self.is_known(end.beyond, system)
                || others.any(|&other| end.is_beyond_on(other, block, pool, system))
        });
        ends
    }

    /// Returns the names of both ends of each leg if one body stands on three legs and nothing else moves; otherwise `None`.
    fn legs(
        &self,
        unknowns: &[usize],
        ends: &[Vec<End>],
        block: &SolvedBlock,
        pool: &mut Pool,
        system: &System,
    ) -> Option<[[String; 2]; LEGS]> {
        if unknowns.len() != LEGS + 1 {
            return None;
        }
        unknowns.iter().enumerate().find_map(|(place, &platform)| {
            let legs = ends.iter().enumerate().filter(|(leg, _)| *leg != place);
            let named = legs.map(|(_, ends)| {
                let [one, other] = &ends[..] else { return None };
                let mut leads = |from: &End, to: &End| {
                    let is_leg = self.is_known(from.beyond, system)
                        && to.is_beyond_on(platform, block, pool, system);
                    is_leg.then(|| [from.name.clone(), to.name.clone()])
                };
                leads(one, other).or_else(|| leads(other, one))
            });
            let named: Option<Vec<[String; 2]>> = named.collect();
            named?.try_into().ok()
        })
    }
}

/// Returns a list, cut at a readable length.
fn shortened(mut parts: Vec<Phrase>) -> Phrase {
    if let Some(more) = parts.len().checked_sub(MAX_LISTED).filter(|it| *it > 1) {
        parts.truncate(MAX_LISTED);
        parts.push(format!("{more} more").into());
    }
    enumerated(&parts)
}
