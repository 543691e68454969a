//! Judges an equilibrium by the stiffness on the constraints, and finds the rates of small motions about it.

use std::f64::consts::TAU;

use nalgebra::{Complex, DMatrix, DVector, SymmetricEigen};

use super::statics::{PoseForces, PoseStiffness, ROUNDING, StaticEquations};

/// Part of the magnitudes that rounding leaves of an eigenvalue.
const EIGENVALUE_ROUNDING: f64 = 1e-13;

/// Part of the magnitudes of stiffness and loads below which an eigenvalue is compared with its value beside the pose.
const SUSPECT: f64 = 1e-4;

/// Number of doublings of a distance over which forces stay within rounding.
const DOUBLINGS: usize = 48;

/// Shortest of these distances, scaled.
const SHORTEST: f64 = 1e-14;

/// Asymmetry of the stiffness beyond which it is not a Hessian, as a part of the magnitudes.
const ASYMMETRY: f64 = 1e-10;

/// Imaginary part of an eigenvalue beyond which it is complex, as a part of its magnitude.
const COMPLEX: f64 = 1e-6;

/// Mass below which a direction counts as massless, as a part of the largest.
const MASSLESS: f64 = 1e-13;

/// Stability of an equilibrium.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stability {
    /// The Hessian of the energy is positive definite.
    Stable,
    /// A small motion grows.
    Unstable,
    /// The stiffness vanishes in a direction, within its error.
    Indifferent,
}

/// Small motion about an equilibrium, without damping.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SmallMotion {
    /// Frequency (Hz); 0 for a motion that only grows.
    pub frequency: f64,
    /// Rate of growth (1/s); 0 for an oscillation.
    pub growth: f64,
}

/// Verdict on an equilibrium.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// Stability.
    pub stability: Stability,
    /// True if the stiffness is symmetric, so that it is the Hessian of an energy.
    pub is_conservative: bool,
    /// Small motions: growing ones first, then by frequency. Directions without mass have none.
    pub motions: Vec<SmallMotion>,
    /// Number of negative eigenvalues of the Hessian, or of growing motions without one.
    pub(super) growing: usize,
    /// Number of eigenvalues of the stiffness that vanish within their errors.
    pub(super) vanishing: usize,
}

impl Stability {
    /// Name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Stability::Stable => "stable",
            Stability::Unstable => "unstable",
            Stability::Indifferent => "indifferent",
        }
    }
}

impl Verdict {
    /// Judges a pose without forces.
    pub(super) fn of(
        equations: &StaticEquations,
        pose: &PoseForces,
        stiffness: &PoseStiffness,
    ) -> Verdict {
        let matrix = &stiffness.reduced;
        let magnitude = pose.basis.map(f64::abs);
        let magnitude = magnitude.tr_mul(&(&stiffness.magnitude * &magnitude));
        let skew = matrix - matrix.transpose();
        let pairs = skew.iter().zip(magnitude.iter());
        let is_conservative = pairs.clone().all(|(it, all)| it.abs() <= ASYMMETRY * all);
        let squares = squares(matrix, &pose.mass);
        // Of a conjugate pair, one stands for both.
        let squares = squares.iter().filter(|it| it.im >= 0.0);
        let mut motions: Vec<SmallMotion> = squares.map(motion).collect();
        motions.sort_by(|a, b| {
            let growth = b.growth.total_cmp(&a.growth);
            growth.then(a.frequency.total_cmp(&b.frequency))
        });
        let symmetric = SymmetricEigen::new(0.5 * (matrix + matrix.transpose()));
        let values = symmetric.eigenvalues.iter().enumerate();
        let signs = values.map(|(place, &value)| {
            let along = &pose.basis * symmetric.eigenvectors.column(place);
            match is_zero(equations, pose, stiffness, &along, value) {
                true => 0,
                false => value.signum() as i32,
            }
        });
        let signs: Vec<i32> = signs.collect();
        let vanishing = signs.iter().filter(|it| **it == 0).count();
        if is_conservative {
            // A vanishing stiffness leaves rounding of either sign.
            let mut slow: Vec<&mut SmallMotion> = motions.iter_mut().collect();
            slow.sort_by(|a, b| speed(a).total_cmp(&speed(b)));
            for motion in slow.into_iter().take(vanishing) {
                *motion = SmallMotion::default();
            }
        }
        let negative = symmetric.eigenvalues.iter().filter(|it| **it < 0.0).count();
        if is_conservative {
            let stability = match signs.iter().min() {
                Some(-1) => Stability::Unstable,
                Some(0) => Stability::Indifferent,
                _ => Stability::Stable,
            };
            return Verdict {
                stability,
                is_conservative,
                motions,
                growing: negative,
                vanishing,
            };
        }
        let growing = motions.iter().filter(|it| it.growth > 0.0).count();
        let singular = matrix.singular_values();
        let is_singular = singular.min() <= ASYMMETRY * singular.max() || motions.is_empty();
        Verdict {
            stability: match (growing, is_singular) {
                (0, false) => Stability::Stable,
                (0, true) => Stability::Indifferent,
                _ => Stability::Unstable,
            },
            is_conservative,
            motions,
            growing,
            vanishing: usize::from(is_singular),
        }
    }
}

/// True if an eigenvalue of the stiffness (J) vanishes within its error: that of rounding, and that of the pose.
fn is_zero(
    equations: &StaticEquations,
    pose: &PoseForces,
    stiffness: &PoseStiffness,
    along: &DVector<f64>,
    value: f64,
) -> bool {
    let lengths = along.map(f64::abs);
    let magnitude = lengths.dot(&(&stiffness.magnitude * &lengths));
    // The direction itself is rounded.
    let rounding = EIGENVALUE_ROUNDING * magnitude + ROUNDING * stiffness.magnitude.amax();
    if value.abs() <= rounding {
        return true;
    }
    if value.abs() > SUSPECT * (magnitude + lengths.dot(&pose.magnitude)) {
        return false;
    }
    // As far as the force cannot be told from zero, the pose may be off.
    let step = pose.basis.tr_mul(along);
    let rounding = pose.rounding(along, stiffness);
    [1.0, -1.0].iter().any(|sign| {
        let mut reach = SHORTEST;
        for _ in 0..DOUBLINGS {
            let Some(side) = equations.moved(pose, &(&step * (sign * reach))) else {
                return false;
            };
            let along = held(along, &side);
            if side.load.dot(&along).abs() > rounding {
                return false;
            }
            let whole = side.stiffness(equations).whole;
            let beside = along.dot(&(whole * &along)) / along.norm_squared();
            if (beside - value).abs() > 0.5 * value.abs() {
                return true;
            }
            reach *= 2.0;
        }
        false
    })
}

/// Returns the speed of a small motion (1/s).
fn speed(motion: &SmallMotion) -> f64 {
    (TAU * motion.frequency).hypot(motion.growth)
}

/// Returns the part of a direction along the constraints in a pose.
fn held(along: &DVector<f64>, pose: &PoseForces) -> DVector<f64> {
    &pose.basis * pose.basis.tr_mul(along)
}

/// Returns the small motion of a root of |K − ω² M|.
fn motion(square: &Complex<f64>) -> SmallMotion {
    let is_real = square.im.abs() <= COMPLEX * square.norm();
    match (is_real, square.re >= 0.0) {
        (true, true) => SmallMotion {
            frequency: square.re.sqrt() / TAU,
            growth: 0.0,
        },
        (true, false) => SmallMotion {
            frequency: 0.0,
            growth: (-square.re).sqrt(),
        },
        (false, _) => {
            let root = (-square).sqrt();
            SmallMotion {
                frequency: root.im.abs() / TAU,
                growth: root.re.abs(),
            }
        }
    }
}

/// Returns the roots ω² of |K − ω² M| (1/s²). Directions without mass follow the others at rest.
fn squares(stiffness: &DMatrix<f64>, mass: &DMatrix<f64>) -> Vec<Complex<f64>> {
    let masses = SymmetricEigen::new(0.5 * (mass + mass.transpose()));
    let largest = masses.eigenvalues.amax();
    let is_massive = |place: &usize| masses.eigenvalues[*place] > MASSLESS * largest;
    let (moving, light): (Vec<usize>, Vec<usize>) =
        (0..mass.nrows()).partition(|it| is_massive(it));
    if largest <= 0.0 || moving.is_empty() {
        return Vec::new();
    }
    let part = |places: &[usize]| {
        DMatrix::from_fn(mass.nrows(), places.len(), |row, column| {
            masses.eigenvectors[(row, places[column])]
        })
    };
    let [moving_part, light_part] = [part(&moving), part(&light)];
    let block = |one: &DMatrix<f64>, other: &DMatrix<f64>| one.tr_mul(&(stiffness * other));
    let mut condensed = block(&moving_part, &moving_part);
    if !light.is_empty() {
        let following = block(&light_part, &light_part).lu();
        let Some(follow) = following.solve(&block(&light_part, &moving_part)) else {
            return Vec::new();
        };
        condensed -= block(&moving_part, &light_part) * follow;
    }
    let weights = moving.iter().map(|&it| 1.0 / masses.eigenvalues[it].sqrt());
    let weights = DMatrix::from_diagonal(&DVector::from_iterator(moving.len(), weights));
    let matrix = &weights * condensed * &weights;
    let is_symmetric = (&matrix - matrix.transpose()).amax() <= ASYMMETRY * matrix.amax();
    match is_symmetric {
        true => {
            let values = SymmetricEigen::new(0.5 * (&matrix + matrix.transpose())).eigenvalues;
            values.iter().map(|&it| Complex::new(it, 0.0)).collect()
        }
        false => matrix.complex_eigenvalues().iter().copied().collect(),
    }
}
