//! Equations along a straight line through two frames → whether they have one solution near it all the while.
//!
//! Then what is found at any time of the [`TimeWindow`](crate::TimeWindow) is what the first frame leads to. The generator knows how far the
//! equations are from zero along the line, and how their Jacobian changes near it. With C the inverse of the Jacobian, the operator of
//! Newton with C maps the deviations R into themselves where what it leaves of the line and |I − C J| R are together no more than R (Krawczyk
//! 1969). The module does not know equations.

use nalgebra::allocator::Allocator;
use nalgebra::{Const, DefaultAllocator, Dim, OMatrix, OVector, SMatrix};

use crate::deviations::settled;
use crate::factored_inverse::invert_by_factors;
use crate::inverse::invert;
use crate::math::Real;
use crate::time_window::LEFT_BY_ROUNDING;
use crate::vector::{add, zero_matrix, zero_vector};

/// The number of unknowns from which on an inverse is found by factors: chains of so many links have few entries.
const FACTORED: usize = 16;

/// n equations in n unknowns along a straight line through two frames: vectors (n), matrices (n × n) and what is true or false (n).
///
/// An angle that only turns arms, in all equations, has a column of the Jacobian that turns with it: J(φ + δ) = J cos δ + J′ sin δ.
/// So C J cos δ is known, and what arms of one angle do to one unknown through many equations is added up with its signs, as it
/// cancels along a chain of links.
pub struct Chord<'a, T: Real, D: Dim>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// The remainder of linear interpolation over the window, for a second derivative of 1 and a change of 1.
    pub remainder: T,
    /// How far each equation may be from zero on the line, but for what follows.
    pub bounds: OVector<T, D>,
    /// What each equation's second derivative over the window is, where it is known with its sign, without the arms that turn.
    pub curvatures: OVector<T, D>,
    /// How far each unknown goes along the line.
    pub changes: OVector<T, D>,
    /// How large the unknowns are, which rounding is a part of.
    pub sizes: OVector<T, D>,
    /// The Jacobian of the second frame. Its inverse takes its place.
    pub jacobian: &'a mut OMatrix<T, D, D>,
    /// Whether a column turns with its angle.
    pub turns: OVector<bool, D>,
    /// The derivatives of the columns that do, and zeros in the others. Their products with the inverse take their place.
    pub turning: &'a mut OMatrix<T, D, D>,
}

/// [`isolate_all`] for a number of unknowns that generated code knows. `blocks` (N) says to which block an equation belongs.
///
/// # Errors
/// The block that is farthest from it, where it cannot be shown.
pub fn isolate<T: Real, const N: usize>(
    blocks: [u16; N],
    chord: Chord<'_, T, Const<N>>,
    variation: impl Fn(&[T; N], &mut SMatrix<T, N, N>),
) -> Result<[T; N], u16> {
    let found = isolate_all(chord, |deviations, entries| {
        let [deviations] = &deviations.data.0;
        variation(deviations, entries);
    });
    in_blocks(blocks, found)
}

/// What is found of equations of these blocks.
pub(crate) fn in_blocks<T: Real, const N: usize>(
    blocks: [u16; N],
    found: Result<OVector<T, Const<N>>, usize>,
) -> Result<[T; N], u16> {
    match found {
        Ok(deviations) => Ok(deviations.data.0[0]),
        Err(row) => Err(blocks.get(row).copied().unwrap_or(0)),
    }
}

/// How far n unknowns may be from a straight line through two frames, where their equations have one solution about the line at
/// every time of the window.
///
/// `variation` says how far the entries of the Jacobian may change, but for the columns that turn, where the unknowns are no farther
/// from the line than its first argument (n): it writes those that do over a matrix (n × n) of zeros.
///
/// # Errors
/// The row that is farthest from it, where it cannot be shown.
pub fn isolate_all<T: Real, D: Dim>(
    chord: Chord<'_, T, D>,
    mut variation: impl FnMut(&OVector<T, D>, &mut OMatrix<T, D, D>),
) -> Result<OVector<T, D>, usize>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let dimension = chord.bounds.shape_generic().0;
    let mut entries = zero_matrix(dimension);
    let sizes = chord.sizes.map(|size| size.abs());
    variation(&sizes, &mut entries);
    let (operator, least) = Operator::new(chord, &entries, &sizes)?;
    settled(&least, |deviations| {
        variation(deviations, &mut entries);
        operator.spread(&entries, deviations)
    })
}

/// The operator of Newton with the inverse C of the Jacobian of the second frame.
struct Operator<'a, T: Real, D: Dim>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// |C|.
    inverse: &'a OMatrix<T, D, D>,
    /// |C J′| of the columns that turn.
    turned: &'a OMatrix<T, D, D>,
    turns: OVector<bool, D>,
    changes: OVector<T, D>,
}

impl<'a, T: Real, D: Dim> Operator<'a, T, D>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// The operator, and what it leaves of the line: arms on it are A cos δ + J sin δ, the second derivative of A is J′, and both
    /// frames satisfy their equations but for rounding.
    fn new(
        chord: Chord<'a, T, D>,
        variation: &OMatrix<T, D, D>,
        sizes: &OVector<T, D>,
    ) -> Result<(Self, OVector<T, D>), usize> {
        let mut off = roundings(&chord, variation, sizes);
        let Chord {
            remainder,
            bounds,
            curvatures,
            changes,
            jacobian: inverse,
            turns,
            turning: turned,
            ..
        } = chord;
        let order = inverse.shape_generic().0.value();
        match order < FACTORED {
            true => invert(inverse)?,
            false => invert_by_factors(inverse)?,
        }
        let columns = turned.as_mut_slice().chunks_exact_mut(order);
        for (column, _) in columns.zip(turns.as_slice()).filter(|(_, turns)| **turns) {
            multiply(inverse, column);
        }
        let squares = changes.map(|change| change * change);
        let mut least = times(turned, &squares);
        add(&mut least, &times(inverse, &curvatures));
        for matrix in [&mut *inverse, &mut *turned] {
            for entry in matrix.as_mut_slice() {
                *entry = entry.abs();
            }
        }
        let rest = times(turned, &fourth(&squares));
        add_remainder(&mut least, remainder, &rest, &changes, &turns);
        add(&mut off, &bounds);
        add(&mut least, &times(inverse, &off));
        let operator = Self {
            inverse,
            turned,
            turns,
            changes,
        };
        Ok((operator, least))
    }

    /// |I − C J| R near the line.
    fn spread(&self, variation: &OMatrix<T, D, D>, deviations: &OVector<T, D>) -> OVector<T, D> {
        // Every column either turns or varies.
        let (mut turned, mut varied) = (deviations.clone(), deviations.clone());
        let mut beside = deviations.clone();
        let angles = self.changes.as_slice().iter().zip(self.turns.as_slice());
        let vectors = turned.as_mut_slice().iter_mut();
        let vectors = vectors
            .zip(varied.as_mut_slice())
            .zip(beside.as_mut_slice());
        for ((change, turns), ((turned, varied), beside)) in angles.zip(vectors) {
            let deviation = *turned;
            let [by_sine, by_cosine] = turned_by(*change, deviation);
            (*turned, *varied, *beside) = match turns {
                true => (by_sine, T::ZERO, by_cosine),
                false => (T::ZERO, deviation, T::ZERO),
            };
        }
        let mut spread = times(self.inverse, &times(variation, &varied));
        add(&mut spread, &beside);
        add(&mut spread, &times(self.turned, &turned));
        spread
    }
}

/// What a deviation of a column that turns does where its angle goes so far: |sin δ| is at most δ, and 1 − cos δ at most ½ δ².
pub(crate) fn turned_by<T: Real>(change: T, deviation: T) -> [T; 2] {
    let delta = change + deviation;
    [delta * deviation, T::HALF * delta * delta * deviation]
}

/// ½ δ⁴ for each δ².
pub(crate) fn fourth<T: Real, D: Dim>(squares: &OVector<T, D>) -> OVector<T, D>
where
    DefaultAllocator: Allocator<D>,
{
    squares.map(|square| T::HALF * square * square)
}

/// What second derivatives do to each unknown → how far it is off the line by them and by what is left beside them, ½ δ⁴ of the
/// cosine's (`rest`) and δ³ of the sine's.
pub(crate) fn add_remainder<T: Real, D: Dim>(
    second: &mut OVector<T, D>,
    remainder: T,
    rest: &OVector<T, D>,
    changes: &OVector<T, D>,
    turns: &OVector<bool, D>,
) where
    DefaultAllocator: Allocator<D>,
{
    let entries = second.as_mut_slice().iter_mut().zip(rest.as_slice());
    let entries = entries.zip(changes.as_slice()).zip(turns.as_slice());
    for (((entry, rest), change), turns) in entries {
        let third = match turns {
            true => *change * (*change * *change),
            false => T::ZERO,
        };
        *entry = remainder * (entry.abs() + *rest + third);
    }
}

/// How far rounding may leave each equation from zero: by the largest part that an unknown has in it, where it is or, as links in
/// line multiply their angles by almost nothing along the line, where it turns and `variation` takes it.
fn roundings<T: Real, D: Dim>(
    chord: &Chord<'_, T, D>,
    variation: &OMatrix<T, D, D>,
    sizes: &OVector<T, D>,
) -> OVector<T, D>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let dimension = sizes.shape_generic().0;
    let mut roundings = zero_vector(dimension);
    let [jacobian, turning, variation] = [&*chord.jacobian, &*chord.turning, variation]
        .map(|matrix| matrix.as_slice().chunks_exact(dimension.value()));
    let columns = jacobian.zip(turning).zip(variation);
    for (((column, turned), change), size) in columns.zip(sizes.as_slice()) {
        let rounding = T::from_f64(LEFT_BY_ROUNDING) * T::EPSILON * *size;
        let entries = column.iter().zip(turned).zip(change);
        for (largest, ((entry, turned), change)) in roundings.as_mut_slice().iter_mut().zip(entries)
        {
            let part = rounding * (entry.abs() + turned.abs() + change.abs());
            *largest = if part > *largest { part } else { *largest };
        }
    }
    roundings
}

fn times<T: Real, D: Dim>(matrix: &OMatrix<T, D, D>, vector: &OVector<T, D>) -> OVector<T, D>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let mut product = vector.clone();
    multiply(matrix, product.as_mut_slice());
    product
}

/// Puts the product with a matrix in the place of a vector.
fn multiply<T: Real, D: Dim>(matrix: &OMatrix<T, D, D>, vector: &mut [T])
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let dimension = matrix.shape_generic().0;
    let mut product: OVector<T, D> = zero_vector(dimension);
    let columns = matrix.as_slice().chunks_exact(dimension.value());
    for (column, factor) in columns.zip(&*vector) {
        // An equation has few unknowns.
        if *factor == T::ZERO {
            continue;
        }
        for (sum, entry) in product.as_mut_slice().iter_mut().zip(column) {
            *sum += *entry * *factor;
        }
    }
    for (entry, product) in vector.iter_mut().zip(product.as_slice()) {
        *entry = *product;
    }
}

#[cfg(test)]
mod tests {
    use core::f64::consts::TAU;

    use nalgebra::{Matrix2, Vector2};

    use super::{Chord, isolate};
    use crate::time_window::TimeWindow;

    /// Two links of lengths a and b whose ends lie on the ground, one pin fixed, the other one where a crank of radius r turns by θ.
    struct FourBar {
        r: f64,
        a: f64,
        b: f64,
        d: f64,
    }

    impl FourBar {
        /// Both angles, by the law of cosines.
        fn angles(&self, theta: f64) -> Vector2<f64> {
            let (x, y) = (self.d - self.r * theta.cos(), -self.r * theta.sin());
            let distance = x.hypot(y);
            let inner = (distance * distance + self.a * self.a - self.b * self.b)
                / (2.0 * self.a * distance);
            let first = y.atan2(x) + inner.acos();
            let (px, py) = (self.a * first.cos() - x, self.a * first.sin() - y);
            Vector2::new(first, py.atan2(px))
        }

        /// The Jacobian of r e(θ) + a e(φ) − b e(ψ) − d, and its derivative by the angle of each column.
        fn columns(&self, angles: Vector2<f64>) -> [Matrix2<f64>; 2] {
            let [first, second] = [0, 1].map(|place| angles[place].sin_cos());
            let column = |length: f64, (s, c): (f64, f64)| {
                [Vector2::new(-s, c), Vector2::new(-c, -s)].map(|it| it * length)
            };
            let (first, second) = (column(self.a, first), column(-self.b, second));
            [0, 1].map(|place| Matrix2::from_columns(&[first[place], second[place]]))
        }

        /// How far both angles may be from the line through two frames, while the crank turns by so much in a step.
        fn deviations(
            &self,
            [before, now]: [Vector2<f64>; 2],
            theta: f64,
            turned: f64,
            window: &TimeWindow,
        ) -> Result<[f64; 2], u16> {
            let [mut jacobian, mut turning] = self.columns(now);
            let (s, c) = theta.sin_cos();
            let change = turned * window.steps;
            let chord = Chord {
                remainder: window.remainder,
                bounds: [self.r * change.powi(3) * window.remainder; 2].into(),
                curvatures: [-self.r * c * change * change, -self.r * s * change * change].into(),
                changes: (now - before).abs() * window.steps,
                sizes: [1.0; 2].into(),
                jacobian: &mut jacobian,
                turns: [true; 2].into(),
                turning: &mut turning,
            };
            isolate([0; 2], chord, |_, _| {})
        }
    }

    /// The angles that closed forms give never leave the deviations, and those are not much more than they need.
    #[test]
    fn angles_stay_within_their_deviations() {
        let (mut shown, mut tightest) = (0, f64::INFINITY);
        for linkage in 0..40 {
            let part = |k: f64| (f64::from(linkage) * k).sin();
            let four_bar = FourBar {
                r: 0.3 + 0.1 * part(1.3),
                a: 1.0 + 0.3 * part(2.1),
                b: 1.0 + 0.3 * part(3.7),
                d: 0.9 + 0.2 * part(0.7),
            };
            for place in 0..24 {
                let (theta, turned) = (f64::from(place) * 0.26, 0.01);
                let frames = [theta - turned, theta].map(|theta| four_bar.angles(theta));
                for stretch in [1.0, 2.0, 5.0, 10.0, 20.0, 40.0] {
                    let window = match stretch {
                        1.0 => TimeWindow::between(1.0),
                        _ => TimeWindow::around(1.0, stretch),
                    };
                    let Ok(deviations) = four_bar.deviations(frames, theta, turned, &window) else {
                        continue;
                    };
                    shown += 1;
                    let mut off = Vector2::zeros();
                    for k in -100..=100 {
                        let steps = match stretch {
                            1.0 => f64::from(k - 100) / 200.0,
                            _ => f64::from(k) / 100.0 * stretch,
                        };
                        let exact = four_bar.angles(theta + steps * turned);
                        let line = frames[1] + (frames[1] - frames[0]) * steps;
                        off =
                            off.sup(&(exact - line).map(|it| it - TAU * (it / TAU).round()).abs());
                    }
                    for (deviation, off) in deviations.iter().zip(&off) {
                        assert!(
                            off <= deviation,
                            "{linkage}, {place}, {stretch}: {off} of {deviation}"
                        );
                        tightest = tightest.min(deviation / off);
                    }
                }
            }
        }
        assert!(shown > 2000, "only {shown} windows were shown");
        assert!(
            tightest < 1.2,
            "at least {tightest} times as much as needed"
        );
    }
}
