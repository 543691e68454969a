//! Determines whether the equations of a structurally square system are independent, block by block.
//!
//! Φ_q is block triangular in solve order, so it is nonsingular if each diagonal block is. Poses are computed block by block too,
//! so that the cost is linear in the number of blocks.

use super::functions::{Functions, Pose};
use super::independence::Basis;
use super::{balanced, pose};
use crate::pool::Pool;
use crate::structure::{Incidence, Matching, components};
use crate::system::System;

/// Largest block with a numerical rank; the solver judges larger ones at run time.
const LARGEST_BLOCK: usize = super::LARGEST_SURVEY;

/// Number of consistent poses in which a block is singular before its equations count as repeated. A single pose may be singular
/// in any mechanism.
const SINGULAR_POSES: usize = 2;

/// Number of inconsistent poses in which a block is singular before its equations count as contradictory.
const SINGULAR_ELSEWHERE: usize = 3;

/// Equations whose rank is less than their number.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::structure) enum Singular {
    /// Rows that are consistent and repeated in more than one pose, ascending.
    Repeating(Vec<usize>),
    /// Rows that repeat one another in every pose and are never consistent.
    Contradicting {
        /// Surplus equation.
        row: usize,
        /// Equations that the surplus one repeats except for the misfit, ascending.
        repeats: Vec<usize>,
        /// Misfit of the equations near the design configuration, in m or rad.
        misfit: f64,
    },
}

/// Row of a block that repeats others, and these: indices in the block.
type Dependent = (usize, Vec<usize>);

/// Results for a block so far.
#[derive(Clone, Debug, Default)]
struct Found {
    regular: bool,
    /// Number of consistent poses in which the block was singular.
    singular: usize,
    /// Number of inconsistent poses in which the block was singular, and true if it was regular in one.
    singular_anywhere: usize,
    regular_somewhere: bool,
    /// Smallest misfit, with the repeating equation and the pose.
    misfit: Option<(f64, Dependent, Pose)>,
}

/// Returns equations that are singular in every pose considered. `None` if the equations are independent, or if there are too few
/// poses to decide.
pub(in crate::structure) fn singular(
    pool: &Pool,
    system: &System,
    incidence: &Incidence,
    matching: &Matching,
) -> Option<Singular> {
    let length = system.characteristic_length(pool);
    let blocks: Vec<Functions<'_>> = components(incidence, matching)
        .into_iter()
        .map(|rows| {
            let mut columns: Vec<usize> = rows
                .iter()
                .filter_map(|&row| matching.column_of[row])
                .collect();
            columns.sort_unstable();
            Functions::measured_in(length, pool, system, rows, columns)
        })
        .collect();
    let mut results = vec![Found::default(); blocks.len()];
    for (block, found) in blocks.iter().zip(&mut results) {
        found.regular = block.rows.len() > LARGEST_BLOCK;
    }
    for number in 0..pose::COUNT {
        if results.iter().all(|found| found.regular) {
            return None;
        }
        look_at(
            &blocks,
            &mut results,
            pose::start(pool, system, number),
            number,
            incidence,
        );
    }
    let open = || {
        blocks
            .iter()
            .zip(&results)
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
            misfit: left_over(pool, system, block, *place, pose.clone()),
        })
    })
}

/// Returns the residual of one row of a block where the other rows hold, in the row's unit.
fn left_over(
    pool: &Pool,
    system: &System,
    block: &Functions<'_>,
    place: usize,
    mut pose: Pose,
) -> f64 {
    let (mut others, columns) = (block.rows.clone(), block.columns.clone());
    let row = others.remove(place);
    pose::project(&Functions::new(pool, system, others, columns), &mut pose);
    pose.shift = 0.0;
    let alone = Functions::new(pool, system, vec![row], block.columns.clone());
    alone.residuals(&pose)[0].abs() * system.scale(system.row(row).quantity, pool)
}

/// Solves blocks one after another and judges the consistent ones.
fn look_at(
    blocks: &[Functions<'_>],
    found: &mut [Found],
    mut pose: Pose,
    number: usize,
    incidence: &Incidence,
) {
    // True for each coordinate that does not satisfy its equations.
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

/// Returns the first row of a block that repeats others in a pose, and these: indices in the block.
fn dependent(block: &Functions<'_>, pose: &Pose) -> Option<Dependent> {
    let (rows, _) = balanced(block.jacobian(pose));
    let mut basis = Basis::default();
    rows.iter().enumerate().find_map(|(at, row)| {
        let parts = basis.take(at, row).err()?;
        Some((at, parts.into_iter().map(|part| part.0).collect()))
    })
}
