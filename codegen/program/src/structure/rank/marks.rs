//! Chooses the monitored rows of joints marked `redundant`.

use super::arms::arms;
use super::functions::Pose;
use super::independence::{Basis, Reduced, TOLERANCE};
use super::survey::{all_rows, poses, whole};
use super::{LARGEST_SURVEY, balanced, pose};
use crate::model::Mechanism;
use crate::pool::Pool;
use crate::system::{System, assemble, assemble_without};

/// Factor by which a later row must exceed an earlier one to be preferred.
const CLEARLY: f64 = 1.05;

/// Monitored row that does not follow from the others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::structure) struct Misfit {
    /// Index into the monitored rows.
    pub monitored: usize,
    /// Residual where all other rows hold, in m or rad.
    pub size: f64,
}

/// Returns the equations of a mechanism with the repeated rows of `redundant` joints monitored. Of rows that could determine the
/// same motion, those that do so best in all poses near the design configuration are solved.
pub fn released(pool: &mut Pool, mut mechanism: Mechanism) -> System {
    if mechanism.joints.iter().all(|own| own.redundant.is_none()) {
        return assemble(pool, mechanism);
    }
    // Repetition is measured on equations that are assembled apart, so that the pool holds only those of the result.
    let mut apart = pool.clone();
    let mut draft = assemble(&mut apart, mechanism.clone());
    if draft.coordinates.len() > LARGEST_SURVEY || shared_line(&draft).is_some() {
        *pool = apart;
        return draft;
    }
    let arms = arms(&apart, &draft);
    if !arms.is_empty() {
        for arm in arms {
            arm.state(&mut mechanism, &mut pool.graph);
        }
        apart = pool.clone();
        draft = assemble(&mut apart, mechanism.clone());
    }
    let dropped = dependent(&apart, &draft);
    assemble_without(pool, mechanism, &dropped)
}

/// Returns a marked joint whose line another joint or driver names, and that joint: both are needed.
pub(in crate::structure) fn shared_line(system: &System) -> Option<(usize, usize)> {
    let joints = &system.mechanism.joints;
    let owned = |at: usize| {
        let count = joints[at].kind.auxiliaries().len();
        joints[at].operands.auxiliaries.iter().take(count)
    };
    let marked = (0..joints.len()).filter(|&at| joints[at].redundant.is_some());
    marked
        .flat_map(|line| (0..joints.len()).map(move |user| (line, user)))
        .find(|&(line, user)| {
            let count = joints[user].kind.auxiliaries().len();
            let mut borrowed = joints[user].operands.auxiliaries.iter().skip(count);
            borrowed.any(|theirs| owned(line).any(|mine| mine.value == theirs.value))
        })
}

/// Returns the rows of marked joints that other rows repeat, ascending.
fn dependent(pool: &Pool, system: &System) -> Vec<usize> {
    let is_marked = |at: usize| {
        let joint = &system.mechanism.joints[system.row(at).joint];
        joint.redundant.is_some()
    };
    // Uses all rows if they are consistent; otherwise the unmarked rows.
    let (unmarked, marked): (Vec<usize>, Vec<usize>) =
        all_rows(system).into_iter().partition(|&at| !is_marked(at));
    let mut consistent = poses(pool, system, &whole(pool, system, all_rows(system)));
    let fits = consistent.len() > 1;
    if !fits {
        consistent = poses(pool, system, &whole(pool, system, unmarked.clone()));
    }
    let ordered = whole(pool, system, [unmarked.clone(), marked.clone()].concat());
    let matrices: Vec<Vec<Vec<f64>>> = consistent
        .iter()
        .map(|pose| balanced(ordered.jacobian(pose)).0)
        .collect();
    let mut bases = vec![Basis::default(); matrices.len()];
    for (basis, matrix) in bases.iter_mut().zip(&matrices) {
        for (at, row) in matrix.iter().take(unmarked.len()).enumerate() {
            // Repetition among unmarked rows is reported elsewhere.
            let _ = basis.take(at, row);
        }
    }
    let mut open = marked;
    // Takes the row that is most independent of the earlier rows in its worst pose.
    while let Some((best, reduced)) =
        most_independent(&open, unmarked.len(), &ordered.rows, &matrices, &bases)
    {
        let at = open.remove(best);
        for (basis, reduced) in bases.iter_mut().zip(reduced) {
            if reduced.independent > TOLERANCE {
                basis.insert(at, reduced);
            }
        }
    }
    open.sort_unstable();
    open
}

/// Returns the open row that is most independent, with its reductions; `None` if all depend on earlier rows in every pose.
fn most_independent(
    open: &[usize],
    unmarked: usize,
    ordered: &[usize],
    matrices: &[Vec<Vec<f64>>],
    bases: &[Basis],
) -> Option<(usize, Vec<Reduced>)> {
    let mut best: Option<(f64, usize, Vec<Reduced>)> = None;
    for (place, at) in open.iter().enumerate() {
        let row = unmarked + ordered[unmarked..].iter().position(|it| it == at)?;
        let pairs = matrices.iter().zip(bases);
        let reduced: Vec<Reduced> = pairs
            .map(|(matrix, basis)| basis.reduce(&matrix[row]))
            .collect();
        let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
        for reduced in &reduced {
            least = least.min(reduced.independent);
            most = most.max(reduced.independent);
        }
        // Written order decides, unless a later row is clearly better.
        let is_better = best.as_ref().is_none_or(|best| least > CLEARLY * best.0);
        if most > TOLERANCE && is_better {
            best = Some((least, place, reduced));
        }
    }
    best.map(|(_, place, reduced)| (place, reduced))
}

/// Returns the monitored row with the largest misfit; `None` if all rows hold in the design configuration and in a pose off it.
pub(in crate::structure) fn misfit(pool: &Pool, system: &System) -> Option<Misfit> {
    if system.monitored.is_empty() {
        return None;
    }
    let together = whole(pool, system, all_rows(system));
    if poses(pool, system, &together).len() > 1 {
        return None;
    }
    let solved = whole(pool, system, (0..system.rows.len()).collect());
    let watched = system.rows.len()..system.rows.len() + system.monitored.len();
    let watched = whole(pool, system, watched.collect());
    let mut worst: Option<Misfit> = None;
    let mut consider = |pose: &Pose| {
        for (monitored, value) in watched.residuals(pose).into_iter().enumerate() {
            let size = value.abs() * system.scale(system.monitored[monitored].quantity, pool);
            if worst.is_none_or(|worst| size > worst.size) {
                worst = Some(Misfit { monitored, size });
            }
        }
    };
    let consistent = poses(pool, system, &solved);
    consistent.iter().for_each(&mut consider);
    if consistent.is_empty() {
        // The other rows do not hold near the design configuration, so the misfit is measured in that configuration.
        consider(&pose::start(pool, system, 0));
    }
    worst
}
