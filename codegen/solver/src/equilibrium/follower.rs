//! Solves equilibria and a parameter as one system, which is regular also where the parameter turns back (Keller's pseudo-arclength).
//!
//! Unknowns are those of the pose, the multipliers and the parameter: Q − Φ_qᵀ μ = 0 and Φ = 0, with one equation that selects a point
//! of the path.

use nalgebra::{DMatrix, DVector};

use super::Varied;
use super::statics::{PoseForces, StaticEquations};

/// Step of differences by the parameter, as a part of its range.
const DIFFERENCE: f64 = 6.1e-6;

/// Largest number of corrections of a point.
const CORRECTIONS: usize = 12;

/// Scaled correction at which a point is reached.
const PRECISE: f64 = 1e-12;

/// Scaled correction at which a point counts as reached although rounding moves it.
const ROUNDED: f64 = 1e-8;

/// Point of a path.
#[derive(Clone, Debug)]
pub(super) struct PathPoint {
    pub pose: PoseForces,
    /// Part of the range of the parameter.
    pub share: f64,
    /// Multipliers of the constraints, over the unit of energy.
    multipliers: DVector<f64>,
    /// Unit vector along the path: unknowns of the pose, then the multipliers, which do not count in its length, then the parameter.
    pub tangent: DVector<f64>,
}

/// Equations of a path.
pub(super) struct Follower {
    pub equations: StaticEquations,
    pub place: Varied,
    /// First and last value of the parameter.
    pub ends: [f64; 2],
    /// Unit of energy (J).
    energy: f64,
}

/// Equation that selects a point.
enum Selected<'a> {
    /// Distance along a tangent from an estimate.
    Across(&'a DVector<f64>, &'a DVector<f64>),
    /// Part of the range of the parameter.
    Share(f64),
}

impl Follower {
    /// Creates the equations of a path from an equilibrium.
    pub fn new(
        equations: StaticEquations,
        place: Varied,
        ends: [f64; 2],
        pose: &PoseForces,
    ) -> Follower {
        let stiffness = pose.stiffness(&equations).magnitude.amax();
        let energy = stiffness.max(pose.magnitude.amax());
        Follower {
            energy: if energy > 0.0 { energy } else { 1.0 },
            equations,
            place,
            ends,
        }
    }

    /// Returns the value of the parameter.
    pub fn value(&self, share: f64) -> f64 {
        let [first, last] = self.ends;
        match share {
            1.0 => last,
            share => first + share * (last - first),
        }
    }

    /// Returns the first point of the path, whose tangent leads towards the last value of the parameter; `None` if the parameter turns
    /// back there.
    pub fn first(&mut self, pose: PoseForces) -> Option<PathPoint> {
        let count = self.equations.count() + pose.residual.len() + 1;
        let mut ahead = DVector::zeros(count);
        ahead[count - 1] = 1.0;
        let point = PathPoint {
            multipliers: &pose.multipliers / self.energy,
            pose,
            share: 0.0,
            tangent: ahead.clone(),
        };
        let unknowns = self.unknowns(&point);
        self.corrected(unknowns, &Selected::Share(0.0), &ahead)
    }

    /// Returns the point at a distance along the path; `None` if none is near the estimate.
    pub fn next(&mut self, from: &PathPoint, distance: f64) -> Option<PathPoint> {
        let estimate = self.unknowns(from) + &from.tangent * distance;
        let selected = Selected::Across(&from.tangent, &estimate);
        let next = self.corrected(estimate.clone(), &selected, &from.tangent)?;
        let moved = self.unknowns(&next) - &estimate;
        let correction = self.length(&moved);
        (correction <= 0.3 * distance.abs() + ROUNDED).then_some(next)
    }

    /// Returns the point with a part of the parameter's range near a point.
    pub fn at_share(&mut self, from: &PathPoint, share: f64) -> Option<PathPoint> {
        let ahead = from.tangent[from.tangent.len() - 1];
        let distance = (share - from.share) / ahead;
        if !distance.is_finite() {
            return None;
        }
        let estimate = self.unknowns(from) + &from.tangent * distance;
        self.corrected(estimate, &Selected::Share(share), &from.tangent)
    }

    /// Returns the cosine of the turn of the path between two points.
    pub fn cosine(&self, one: &PathPoint, other: &PathPoint) -> f64 {
        let weights = self.weights(one.tangent.len());
        one.tangent.component_mul(&weights).dot(&other.tangent)
    }

    /// Returns the distance of two points.
    pub fn distance(&self, one: &PathPoint, other: &PathPoint) -> f64 {
        self.length(&(self.unknowns(one) - self.unknowns(other)))
    }

    fn unknowns(&self, point: &PathPoint) -> DVector<f64> {
        let origin = vec![0.0; self.equations.count()];
        let pose = self.equations.difference(&point.pose.unknowns, &origin);
        let all = pose.iter().chain(point.multipliers.iter());
        DVector::from_iterator(
            pose.len() + point.multipliers.len() + 1,
            all.copied().chain([point.share]),
        )
    }

    /// Returns 1 for unknowns that count in lengths, 0 for multipliers.
    fn weights(&self, count: usize) -> DVector<f64> {
        let poses = self.equations.count();
        DVector::from_fn(count, |at, _| {
            if at < poses || at + 1 == count {
                1.0
            } else {
                0.0
            }
        })
    }

    fn length(&self, vector: &DVector<f64>) -> f64 {
        vector.component_mul(&self.weights(vector.len())).norm()
    }

    /// Returns the residuals Q − Φ_qᵀ μ and Φ, scaled.
    fn residual(&mut self, unknowns: &DVector<f64>, share: f64) -> Option<DVector<f64>> {
        self.equations.set(self.place, self.value(share));
        let count = self.equations.count();
        let pose = unknowns.rows(0, count).into_owned();
        let pose = self.equations.stepped(&vec![0.0; count], &pose);
        let instant = self.equations.instant(&pose);
        let (closed, jacobian) = self.equations.motion.constraints(&instant);
        let [load, _] = self.equations.loads(&instant);
        let multipliers = unknowns.rows(count, closed.len());
        let balance = load / self.energy - jacobian.tr_mul(&multipliers);
        let all = balance.iter().chain(closed.iter()).copied();
        let all = DVector::from_iterator(count + closed.len(), all);
        all.iter().all(|it| it.is_finite()).then_some(all)
    }

    /// Returns the residuals and their derivatives, without the last row.
    fn system(&mut self, unknowns: &DVector<f64>) -> Option<(DVector<f64>, DMatrix<f64>)> {
        let share = unknowns[unknowns.len() - 1];
        let sides = [DIFFERENCE, -DIFFERENCE].map(|it| self.residual(unknowns, share + it));
        let [above, below] = sides;
        let slope = (above? - below?) / (2.0 * DIFFERENCE);
        let residual = self.residual(unknowns, share)?;
        let count = self.equations.count();
        let pose = unknowns.rows(0, count).into_owned();
        let pose = self.equations.stepped(&vec![0.0; count], &pose);
        let instant = self.equations.instant(&pose);
        let (closed, jacobian) = self.equations.motion.constraints(&instant);
        let multipliers = unknowns.rows(count, closed.len()) * self.energy;
        let identity = DMatrix::identity(count, count);
        let stiffness = self.equations.stiffness(&instant, &multipliers, &identity);
        let rows = closed.len();
        let mut matrix = DMatrix::zeros(count + rows + 1, count + rows + 1);
        matrix
            .view_mut((0, 0), (count, count))
            .copy_from(&(-stiffness.whole / self.energy));
        matrix
            .view_mut((0, count), (count, rows))
            .copy_from(&-jacobian.transpose());
        matrix
            .view_mut((count, 0), (rows, count))
            .copy_from(&jacobian);
        matrix
            .view_mut((0, count + rows), (count + rows, 1))
            .copy_from(&slope);
        Some((residual, matrix))
    }

    /// Corrects an estimate, with the tangent in the direction of `ahead`.
    fn corrected(
        &mut self,
        estimate: DVector<f64>,
        selected: &Selected<'_>,
        ahead: &DVector<f64>,
    ) -> Option<PathPoint> {
        let count = estimate.len();
        let weights = self.weights(count);
        let mut unknowns = estimate;
        let mut last = f64::INFINITY;
        for _ in 0..CORRECTIONS {
            let (residual, mut matrix) = self.system(&unknowns)?;
            let (row, missed) = match selected {
                Selected::Across(tangent, from) => {
                    let row = tangent.component_mul(&weights);
                    let missed = row.dot(&(&unknowns - *from));
                    (row, missed)
                }
                Selected::Share(share) => {
                    let mut row = DVector::zeros(count);
                    row[count - 1] = 1.0;
                    (row, unknowns[count - 1] - share)
                }
            };
            matrix.row_mut(count - 1).copy_from(&row.transpose());
            let right = residual.push(missed);
            let step = matrix.lu().solve(&right)?;
            let size = self.length(&step);
            if !size.is_finite() {
                return None;
            }
            let is_stuck = size <= ROUNDED && size >= 0.5 * last;
            if !is_stuck {
                unknowns -= step;
            }
            if size <= PRECISE || is_stuck {
                return self.point(unknowns, ahead);
            }
            last = size;
        }
        None
    }

    /// Returns the point with these unknowns, and its tangent.
    fn point(&mut self, mut unknowns: DVector<f64>, ahead: &DVector<f64>) -> Option<PathPoint> {
        let count = unknowns.len();
        let (_, mut matrix) = self.system(&unknowns)?;
        let weights = self.weights(count);
        matrix
            .row_mut(count - 1)
            .copy_from(&ahead.component_mul(&weights).transpose());
        let mut right = DVector::zeros(count);
        right[count - 1] = 1.0;
        let tangent = matrix.lu().solve(&right)?;
        let tangent = &tangent / self.length(&tangent);
        if tangent.iter().any(|it| !it.is_finite()) {
            return None;
        }
        let share = unknowns[count - 1];
        let poses = self.equations.count();
        let multipliers = unknowns.rows(poses, count - 1 - poses).into_owned();
        unknowns = unknowns.rows(0, poses).into_owned();
        self.equations.set(self.place, self.value(share));
        let pose = self.equations.stepped(&vec![0.0; poses], &unknowns);
        Some(PathPoint {
            pose: self.equations.forces(&pose)?,
            share,
            multipliers,
            tangent,
        })
    }
}
