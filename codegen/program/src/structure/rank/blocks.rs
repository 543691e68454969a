//! A structurally square system → whether its equations are independent, block by block.
//!
//! Φ_q is block triangular in solve order, so it is regular where each diagonal block is. The poses are found block by block too,
//! so that the cost grows with the number of blocks and not with its cube.

use super::functions::{Functions, Pose};
use super::independence::Basis;
use super::{balanced, pose};
use crate::structure::{Incidence, Matching, components};
use crate::system::System;

/// A block larger than this is left to the solver, which judges it at run time.
const LARGEST_BLOCK: usize = super::LARGEST_SURVEY;

/// In so many poses in which it holds a block must be singular before its equations are said to repeat one another: one pose
/// may be a singular one of the mechanism.
const SINGULAR_POSES: usize = 2;

/// In so many poses off all solutions it must be singular before they are said to contradict one another.
const SINGULAR_ELSEWHERE: usize = 3;

/// Equations that determine less than their number.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::structure) enum Singular {
    /// They hold together, in more than one pose: ascending.
    Repeating(Vec<usize>),
    /// They repeat one another wherever the bodies are, and hold nowhere.
    Contradicting {
        /// The equation that is left over.
        row: usize,
        /// Those that it repeats but for the misfit, ascending.
        repeats: Vec<usize>,
        /// By how much they miss one another near the drawing, in m or rad.
        misfit: f64,
    },
}

/// A row of a block that repeats others, and those: places in the block.
type Dependent = (usize, Vec<usize>);

/// What is known of a block so far.
#[derive(Clone, Debug, Default)]
struct Found {
    regular: bool,
    /// In how many poses in which it holds it was singular.
    singular: usize,
    /// In how many poses off all solutions it was singular, and whether it was regular in one.
    singular_anywhere: usize,
    regular_somewhere: bool,
    /// The smallest misfit with the equation that repeats others.
    misfit: Option<(f64, Dependent, Pose)>,
}

/// The equations that are singular in every pose that was found; `None` where the equations are independent, or where too few
/// poses were found to say so.
pub(in crate::structure) fn singular(
    system: &System,
    incidence: &Incidence,
    matching: &Matching,
) -> Option<Singular> {
    let length = system.characteristic_length();
    let blocks: Vec<Functions<'_>> = components(incidence, matching)
        .into_iter()
        .map(|rows| {
            let mut columns: Vec<usize> = rows
                .iter()
                .filter_map(|&row| matching.column_of[row])
                .collect();
            columns.sort_unstable();
            Functions::measured_in(length, system, rows, columns)
        })
        .collect();
    let mut found = vec![Found::default(); blocks.len()];
    for (block, found) in blocks.iter().zip(&mut found) {
        found.regular = block.rows.len() > LARGEST_BLOCK;
    }
    for number in 0..pose::COUNT {
        if found.iter().all(|found| found.regular) {
            return None;
        }
        look_at(
            &blocks,
            &mut found,
            pose::start(system, number),
            number,
            incidence,
        );
    }
    let open = || {
        blocks
            .iter()
            .zip(&found)
            .filter(|(_, found)| !found.regular)
    };
    let mut rows: Vec<usize> = open()
        .filter(|(_, found)| found.singular >= SINGULAR_POSES)
        .flat_map(|(block, _)| block.rows.iter().copied())
        .collect();
    rows.sort_unstable();
    if !rows.is_empty() {
        return Some(Singular::Repeating(rows));
    }
    open().find_map(|(block, found)| {
        let everywhere = found.singular_anywhere >= SINGULAR_ELSEWHERE && !found.regular_somewhere;
        let (off, (place, repeats), pose) = found.misfit.as_ref().filter(|_| everywhere)?;
        if !off.is_finite() || *off <= pose::HOLDS {
            return None;
        }
        let mut repeats: Vec<usize> = repeats.iter().map(|&place| block.rows[place]).collect();
        repeats.sort_unstable();
        let row = block.rows[*place];
        Some(Singular::Contradicting {
            row,
            repeats,
            misfit: left_over(system, block, *place, pose.clone()),
        })
    })
}

/// The residual of one row of a block where the others hold, in its own unit.
fn left_over(system: &System, block: &Functions<'_>, place: usize, mut pose: Pose) -> f64 {
    let (mut others, columns) = (block.rows.clone(), block.columns.clone());
    let row = others.remove(place);
    pose::project(&Functions::new(system, others, columns), &mut pose);
    pose.shift = 0.0;
    let alone = Functions::new(system, vec![row], block.columns.clone());
    alone.residuals(&pose)[0].abs() * system.scale(system.row(row).quantity)
}

/// Solves the blocks one after another and judges those that hold.
fn look_at(
    blocks: &[Functions<'_>],
    found: &mut [Found],
    mut pose: Pose,
    number: usize,
    incidence: &Incidence,
) {
    // Coordinates that are not where the equations want them.
    let mut lost = vec![false; incidence.columns];
    for (block, found) in blocks.iter().zip(found) {
        if block.rows.len() > LARGEST_BLOCK {
            block.columns.iter().for_each(|&column| lost[column] = true);
            continue;
        }
        let mentioned = block.rows.iter().flat_map(|&row| &incidence.rows[row]);
        let follows_lost = mentioned.into_iter().any(|&column| lost[column]);
        let before = (number > 0 && !found.regular).then(|| dependent(block, &pose));
        let off = pose::project(block, &mut pose);
        let holds = off <= pose::HOLDS && !follows_lost;
        if !holds {
            block.columns.iter().for_each(|&column| lost[column] = true);
        }
        match before {
            Some(None) => found.regular_somewhere = true,
            Some(Some(dependent)) => {
                found.singular_anywhere += 1;
                let is_less = found.misfit.as_ref().is_none_or(|least| off < least.0);
                if is_less {
                    found.misfit = Some((off, dependent, pose.clone()));
                }
            }
            None => {}
        }
        if found.regular {
            continue;
        }
        if off.is_finite() && dependent(block, &pose).is_none() {
            found.regular = true;
        } else if holds {
            found.singular += 1;
        }
    }
}

/// The first row of a block that repeats others in a pose, and those: places in the block.
fn dependent(block: &Functions<'_>, pose: &Pose) -> Option<Dependent> {
    let (rows, _) = balanced(block.jacobian(pose));
    let mut basis = Basis::default();
    rows.iter().enumerate().find_map(|(at, row)| {
        let parts = basis.take(at, row).err()?;
        Some((at, parts.into_iter().map(|part| part.0).collect()))
    })
}
