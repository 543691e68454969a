//! Compares poses up to full turns of their angles, where turns change neither constraints nor loads.

use std::f64::consts::{PI, TAU};

use nalgebra::DVector;

use super::statics::{PoseForces, StaticEquations};

/// Change of a scaled constraint, or of a load as a part of the largest, that counts as one.
const CHANGED: f64 = 1e-6;

/// Part of half a turn by which an angle may exceed it.
const SLACK: f64 = 1e-9;

impl StaticEquations {
    /// Returns the scaled difference of two poses, with angles modulo full turns.
    pub fn turned_difference(&self, to: &[f64], from: &[f64]) -> DVector<f64> {
        let mut difference = self.difference(to, from);
        for (place, value) in difference.iter_mut().enumerate() {
            if self.is_angle(place) {
                *value -= TAU * (*value / TAU).round();
            }
        }
        difference
    }

    /// True if two poses are within this scaled distance up to full turns, and have the same loads.
    pub fn is_same(&self, one: &PoseForces, other: &PoseForces, tolerance: f64) -> bool {
        let difference = self.turned_difference(&one.unknowns, &other.unknowns);
        if difference.norm() > tolerance {
            return false;
        }
        // Over the tolerance, stiffness changes loads.
        let stiffness = one.stiffness(self).magnitude.row_sum().amax();
        let largest = one.magnitude.amax().max(other.magnitude.amax());
        let allowed = CHANGED * largest + 2.0 * tolerance * stiffness;
        (&one.load - &other.load).amax() <= allowed
    }

    /// Returns a pose with angles less than half a turn from those of another, where full turns change nothing.
    pub fn unwound(&self, pose: &PoseForces, start: &[f64]) -> PoseForces {
        let mut unknowns = pose.unknowns.clone();
        for group in self.turning_groups(pose) {
            // Free coordinates are the last unknowns.
            let Some(&last) = group.last() else { continue };
            let away = unknowns[last] - start[last];
            let turns = ((away - PI * (1.0 + SLACK)) / TAU).ceil();
            for &place in &group {
                unknowns[place] -= TAU * turns;
            }
        }
        if unknowns == pose.unknowns {
            return pose.clone();
        }
        self.forces(&unknowns).unwrap_or_else(|| pose.clone())
    }

    /// Returns groups of angles whose full turn changes nothing.
    fn turning_groups(&self, pose: &PoseForces) -> Vec<Vec<usize>> {
        let count = self.count();
        let largest = pose.magnitude.amax().max(f64::MIN_POSITIVE);
        let changed = |places: &[usize]| -> Vec<usize> {
            let mut unknowns = pose.unknowns.clone();
            for &place in places {
                unknowns[place] += TAU;
            }
            let instant = self.instant(&unknowns);
            let (residual, _) = self.motion.constraints(&instant);
            let [load, _] = self.loads(&instant);
            let off = (&residual - &pose.residual).map(f64::abs);
            let moved = (&load - &pose.load).map(|it| it.abs() / largest);
            let rows = off.iter().chain(moved.iter()).enumerate();
            rows.filter(|(_, it)| **it > CHANGED || it.is_nan())
                .map(|(row, _)| row)
                .collect()
        };
        let mut groups: Vec<(Vec<usize>, Vec<usize>)> = Vec::new();
        for place in (0..count).filter(|it| self.is_angle(*it)) {
            let (mut places, mut rows) = (vec![place], changed(&[place]));
            let (joined, apart): (Vec<_>, Vec<_>) = groups
                .into_iter()
                .partition(|(_, own)| own.iter().any(|row| rows.contains(row)));
            for (more, own) in joined {
                places.extend(more);
                rows.extend(own);
            }
            places.sort_unstable();
            groups = apart;
            groups.push((places, rows));
        }
        let groups = groups.into_iter().map(|(places, _)| places);
        groups.filter(|it| changed(it).is_empty()).collect()
    }
}
