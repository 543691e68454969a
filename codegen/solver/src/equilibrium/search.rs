//! Searches for the equilibria of all poses that are reached.

use linkwright_codegen::stages::system::Derived;

use super::Equilibrium;
use super::curve::{Curve, CurveEnd, is_outside};
use super::pose::Settled;
use super::starts::{Starts, assembled, has_design_modes};
use super::statics::{PoseForces, StaticEquations};
use super::verdict::{Stability, Verdict};
use crate::dense::Dense;
use crate::interpreted::Interpreted;

/// Scaled distance within which equilibria are one.
const EQUAL_DISTANCE: f64 = 1e-6;

/// Distance within which indifferent equilibria are one, which forces locate less precisely.
const INDIFFERENT_DISTANCE: f64 = 1e-3;

/// Scaled distance at which a neighbor of an indifferent equilibrium is sought.
const NEIGHBOR: f64 = 0.03;

/// Relative difference of energies that are equal.
const ENERGY_DIFFERENCE: f64 = 1e-9;

/// Reason that no equilibria are sought.
#[derive(Clone, Debug)]
pub enum Unbalanced {
    /// No coordinate is free.
    NothingFree,
    /// The mechanism cannot be assembled at the time; in words.
    NotAssembled(String),
    /// The constraints have lost rank in the design configuration, or a load is undefined there.
    Singular,
}

/// Extent of a search.
#[derive(Clone, Debug, PartialEq)]
pub enum Coverage {
    /// Curves of poses of one degree of freedom, the one through the design configuration first, with their ends.
    Curves(Vec<[CurveEnd; 2]>),
    /// Number of starts from which an equilibrium was sought, and number of those that led to one.
    Starts([u32; 2]),
}

/// Equilibria of a mechanism.
#[derive(Clone, Debug)]
pub struct Equilibria {
    /// Equilibria, by the values of the free coordinates.
    pub all: Vec<Equilibrium>,
    /// Index of the stable equilibrium next to the design configuration, in its assembly if one is; of any if none is stable. `None` without
    /// equilibria.
    pub nearest: Option<usize>,
    /// True if forces do no virtual work in any pose.
    pub is_everywhere: bool,
    /// Extent of the search.
    pub coverage: Coverage,
    /// Number of equilibria that were left out because an input or a free coordinate is outside of its range.
    pub refused: usize,
    /// True if the search has ended early.
    pub is_interrupted: bool,
    pub(super) equations: StaticEquations,
    pub(super) view: Dense,
}

/// Receiver of the number of starts so far, and of the equilibria; it returns false to end the search.
type Progress<'a> = dyn FnMut(usize, &[Equilibrium]) -> bool + 'a;

/// Search in progress.
struct Search<'a> {
    interpreted: &'a Interpreted,
    equations: &'a StaticEquations,
    view: &'a Dense,
    start: &'a PoseForces,
    found: Vec<Equilibrium>,
    refused: Vec<PoseForces>,
    is_interrupted: bool,
}

impl Equilibria {
    /// Searches from the assembly in the design modes at `t` (s), and from `starts` other poses. `see` receives the number of starts so
    /// far, and the equilibria; it returns false to end the search early.
    ///
    /// # Errors
    /// The reason that no equilibria can be sought.
    pub fn new(
        derived: &Derived,
        interpreted: &Interpreted,
        t: f64,
        starts: u32,
        mut see: impl FnMut(usize, &[Equilibrium]) -> bool,
    ) -> Result<Equilibria, Unbalanced> {
        let equations = StaticEquations::new(&derived.pool, &derived.system, t);
        let equations = equations.ok_or(Unbalanced::NothingFree)?;
        let start = assembled(interpreted, &equations, t)?;
        let view = Dense::moved_by_forces(derived);
        let mut search = Search {
            interpreted,
            equations: &equations,
            view: &view,
            start: &start,
            found: Vec::new(),
            refused: Vec::new(),
            is_interrupted: false,
        };
        let (coverage, is_everywhere) = match equations.freedom() {
            1 => search.along_curves(starts, &mut see),
            _ => search.over_starts(starts, &mut see),
        };
        let Search {
            mut found,
            refused,
            is_interrupted,
            ..
        } = search;
        let is_everywhere = is_everywhere && !is_interrupted;
        if is_everywhere {
            found.clear();
        }
        found.sort_by(|one, other| {
            let orders = (0..one.free.len()).map(|place| {
                let unit = EQUAL_DISTANCE * equations.motion.free_scale(place);
                let rounded = |it: &Equilibrium| (it.free[place] / unit).round() + 0.0;
                rounded(one).total_cmp(&rounded(other))
            });
            orders
                .reduce(std::cmp::Ordering::then)
                .unwrap_or(std::cmp::Ordering::Equal)
        });
        let distances = found.iter().enumerate().map(|(place, it)| {
            let away = equations.difference(&it.pose.unknowns, &start.unknowns);
            let is_stable = it.verdict.stability == Stability::Stable;
            let is_reached = it.is_connected.unwrap_or(it.has_design_modes);
            ((!is_stable, !is_reached), away.norm(), place)
        });
        let nearest = distances.min_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        Ok(Equilibria {
            nearest: nearest.map(|(.., place)| place),
            is_everywhere,
            coverage,
            refused: refused.len(),
            is_interrupted,
            all: found,
            equations,
            view,
        })
    }
}

impl Search<'_> {
    /// Follows the curves of poses of one degree of freedom.
    fn along_curves(&mut self, starts: u32, see: &mut Progress<'_>) -> (Coverage, bool) {
        let origin = &self.start.unknowns;
        let mut curves: Vec<Curve> = Vec::new();
        let first = Curve::through(self.equations, self.start, origin, &mut || {
            see(0, &[]);
        });
        self.settle(&first, self.start, true);
        curves.push(first);
        // An equilibrium may be farther away than the curve is followed.
        let beyond = self.equations.settled(self.start.clone());
        if let Some(settled) = beyond.filter(|it| self.is_beyond(it)) {
            self.add(settled, None);
        }
        let others = Starts::about(self.equations, self.start);
        for index in 0..starts {
            if !see(index as usize, &self.found) {
                self.is_interrupted = true;
                break;
            }
            let Some(pose) = others.scattered(index) else {
                continue;
            };
            let is_outside = is_outside(self.equations, &pose.unknowns, origin)
                || !self.equations.holds_redundant(&pose);
            if is_outside || curves.iter().any(|it| it.passes(self.equations, &pose)) {
                continue;
            }
            let curve = Curve::through(self.equations, &pose, origin, &mut || {
                see(index as usize, &[]);
            });
            self.settle(&curve, &pose, false);
            curves.push(curve);
        }
        let is_everywhere = curves.iter().all(Curve::is_quiet);
        let ends = curves.iter().map(|it| it.ends).collect();
        (Coverage::Curves(ends), is_everywhere)
    }

    /// True if an equilibrium is outside of the curves that are followed.
    fn is_beyond(&self, settled: &Settled) -> bool {
        let unknowns = self
            .equations
            .unwound(&settled.pose, &self.start.unknowns)
            .unknowns;
        is_outside(self.equations, &unknowns, &self.start.unknowns)
    }

    /// Adds the equilibria on a curve through a pose.
    fn settle(&mut self, curve: &Curve, start: &PoseForces, is_connected: bool) {
        // One pose stands for a curve without forces.
        let zeros = match curve.is_quiet() {
            true => vec![start.unknowns.clone()],
            false => curve.zeros(self.equations),
        };
        for unknowns in zeros {
            let unknowns = curve.unwound(unknowns, &self.start.unknowns);
            let Some(pose) = self.equations.closed(unknowns) else {
                continue;
            };
            let is_open = curve.ends != [CurveEnd::Closed; 2];
            if is_open && is_outside(self.equations, &pose.unknowns, &self.start.unknowns) {
                continue;
            }
            // A force that jumps past zero has a bracket without a zero.
            let settled = self.equations.settled(pose.clone()).filter(|it| {
                let away = self.equations.difference(&it.pose.unknowns, &pose.unknowns);
                away.norm() <= INDIFFERENT_DISTANCE
            });
            let bracketed = self.is_quiet(&pose).then_some(Settled {
                pose,
                is_precise: false,
            });
            if let Some(settled) = settled.or(bracketed) {
                self.add(settled, Some(is_connected));
            }
        }
    }

    /// Seeks equilibria from many poses.
    fn over_starts(&mut self, starts: u32, see: &mut Progress<'_>) -> (Coverage, bool) {
        let mut others = Starts::about(self.equations, self.start);
        let (mut tried, mut settled_count) = (0, 0);
        let mut is_everywhere = true;
        for index in 0..=starts {
            if !see(index as usize, &self.found) {
                self.is_interrupted = true;
                break;
            }
            let pose = match (index, index % 2) {
                (0, _) => Some(self.start.clone()),
                (_, 1) => Some(others.walked(index / 2)),
                _ => others.scattered(index / 2 - 1),
            };
            let pose = pose.filter(|it| self.equations.holds_redundant(it));
            let Some(pose) = pose else { continue };
            tried += 1;
            is_everywhere &= self.is_quiet(&pose);
            // Where a damped motion from the design configuration ends, and where Newton's method does not help.
            let newton = self.equations.settled(pose.clone());
            let descent = match index > 0 && newton.is_some() {
                true => None,
                false => self.equations.descended(pose),
            };
            settled_count += u32::from(newton.is_some() || descent.is_some());
            for settled in newton.into_iter().chain(descent) {
                self.add(settled, None);
            }
        }
        // Half a turn of a link often leads to another equilibrium.
        let mut place = 0;
        let most = tried + starts;
        while place < self.found.len() && !is_everywhere {
            let pose = self.found[place].pose.clone();
            for free in 0..self.equations.motion.free_count() {
                let turned = match tried < most {
                    true => self.equations.half_turned(&pose, free),
                    false => None,
                };
                let Some(turned) = turned else { continue };
                tried += 1;
                if let Some(settled) = self.equations.settled(turned) {
                    settled_count += 1;
                    self.add(settled, None);
                }
            }
            place += 1;
        }
        (Coverage::Starts([tried, settled_count]), is_everywhere)
    }

    /// True if forces are rounding in a pose.
    fn is_quiet(&self, pose: &PoseForces) -> bool {
        let stiffness = pose.stiffness(self.equations);
        let mut columns = pose.basis.column_iter().zip(pose.force.iter());
        columns.all(|(along, force)| force.abs() <= pose.rounding(&along.into_owned(), &stiffness))
    }

    /// Adds an equilibrium unless it is known.
    fn add(&mut self, settled: Settled, is_connected: Option<bool>) {
        let start = &self.start.unknowns;
        let pose = self.equations.unwound(&settled.pose, start);
        let stiffness = pose.stiffness(self.equations);
        let verdict = Verdict::of(self.equations, &pose, &stiffness);
        let is_indifferent = !settled.is_precise || verdict.vanishing > 0;
        let tolerance = if is_indifferent {
            INDIFFERENT_DISTANCE
        } else {
            EQUAL_DISTANCE
        };
        let is_known = |it: &PoseForces| self.equations.is_same(it, &pose, tolerance);
        if !self.equations.holds_redundant(&pose) || !self.equations.is_smooth(&pose) {
            return;
        }
        if self.refused.iter().any(is_known) || self.found.iter().any(|it| is_known(&it.pose)) {
            return;
        }
        let is_of_family = is_indifferent && self.has_neighbor(&pose);
        let energy = pose.potential;
        let unit = pose.magnitude.amax() + stiffness.magnitude.amax();
        let is_equal = |it: &Equilibrium| {
            let scale = unit + energy.abs().max(it.potential.abs());
            it.is_of_family && (it.potential - energy).abs() <= ENERGY_DIFFERENCE * scale
        };
        let relative = self.found.iter().position(is_equal);
        if let Some(place) = relative.filter(|_| is_of_family) {
            let away = |it: &PoseForces| self.equations.difference(&it.unknowns, start).norm();
            // The member next to the design configuration stands for a family.
            if away(&pose) >= away(&self.found[place].pose) {
                return;
            }
            self.found.remove(place);
        }
        if self.view.refused(&pose.instant).is_some() {
            self.refused.push(pose);
            return;
        }
        let equilibrium = self.equations.equilibrium(self.view, pose, verdict);
        let has_design_modes =
            has_design_modes(self.interpreted, self.equations, &equilibrium.pose);
        self.found.push(Equilibrium {
            energy_unit: unit,
            has_design_modes,
            is_of_family,
            is_connected,
            ..equilibrium
        });
    }

    /// True if an indifferent pose has another equilibrium next to it.
    fn has_neighbor(&self, pose: &PoseForces) -> bool {
        let stiffness = pose.stiffness(self.equations).reduced;
        let symmetric = nalgebra::SymmetricEigen::new(0.5 * (&stiffness + stiffness.transpose()));
        let softest = symmetric.eigenvalues.map(f64::abs).argmin().0;
        let along = symmetric.eigenvectors.column(softest) * NEIGHBOR;
        [1.0, -1.0].iter().all(|sign| {
            let beside = self.equations.moved(pose, &(&along * *sign));
            let settled = beside.and_then(|it| self.equations.settled(it));
            settled.is_some_and(|it| {
                let away = self
                    .equations
                    .turned_difference(&it.pose.unknowns, &pose.unknowns);
                let distance = away.norm();
                distance > 0.5 * NEIGHBOR && distance < 2.0 * NEIGHBOR
            })
        })
    }
}
