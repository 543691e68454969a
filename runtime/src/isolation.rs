//! Verifies that equations have one solution near the chord through two frames, at every time of a window.
//!
//! Every pose found in the [`TimeWindow`](crate::time_window::TimeWindow) then lies on the path of the first frame. The caller
//! bounds the residual on the chord and the change of the Jacobian near the chord. Let C be the inverse of the
//! Jacobian. The Newton operator with C maps the deviations R into themselves if its remainder on the chord plus |I − C
//! J| R is at most R (Krawczyk 1969).

use nalgebra::allocator::Allocator;
use nalgebra::{Const, DefaultAllocator, Dim, OMatrix, OVector, SMatrix};

use crate::deviations::settled;
use crate::factored_inverse::invert_by_factors;
use crate::inverse::invert;
use crate::math::Real;
use crate::time_window::LEFT_BY_ROUNDING;
use crate::vector::{add, zero_matrix, zero_vector};

/// Number of unknowns from which on an inverse is computed by factors: chains of so many links have few entries.
const FACTORED: usize = 16;

/// n equations in n unknowns along a chord: vectors (n), matrices (n × n) and flags (n).
///
/// The column of an angle that only rotates arms, in all equations, rotates with the angle: J(φ + δ) = J cos δ + J′ sin
/// δ. C J cos δ is therefore known. Effects of one angle on one unknown through many equations are added with their
/// signs, because they cancel along a chain of links.
pub struct Chord<'a, T: Real, D: Dim>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// Remainder of linear interpolation over the window, for a second derivative of 1 and a change of 1.
    pub remainder: T,
    /// Bound on each equation's residual on the chord, without the terms that follow.
    pub bounds: OVector<T, D>,
    /// Second derivative of each equation over the window if its sign is known, without the rotated arms.
    pub curvatures: OVector<T, D>,
    /// Change of each unknown along the chord.
    pub changes: OVector<T, D>,
    /// Magnitudes of the unknowns, to which rounding is relative.
    pub sizes: OVector<T, D>,
    /// Jacobian of the second frame. Its inverse replaces it.
    pub jacobian: &'a mut OMatrix<T, D, D>,
    /// True for a column that rotates with its angle.
    pub turns: OVector<bool, D>,
    /// Derivatives of the columns that rotate, and zeros in the others. Their products with the inverse replace them.
    pub turning: &'a mut OMatrix<T, D, D>,
}

/// Calls [`isolate_all`] for a number of unknowns that generated code knows. `blocks` (N) gives the block of each
/// equation.
///
/// # Errors
/// Returns the block that misses the condition by most if one solution cannot be verified.
pub fn isolate<T: Real, const N: usize>(
    blocks: [u16; N],
    chord: Chord<'_, T, Const<N>>,
    variation: impl Fn(&[T; N], &mut SMatrix<T, N, N>),
) -> Result<[T; N], u16> {
    let deviations_or_row = isolate_all(chord, |deviations, entries| {
        let [deviations] = &deviations.data.0;
        variation(deviations, entries);
    });
    in_blocks(blocks, deviations_or_row)
}

/// Converts deviations to an array, and a row to its block.
pub(crate) fn in_blocks<T: Real, const N: usize>(
    blocks: [u16; N],
    deviations_or_row: Result<OVector<T, Const<N>>, usize>,
) -> Result<[T; N], u16> {
    match deviations_or_row {
        Ok(deviations) => Ok(deviations.data.0[0]),
        Err(row) => Err(blocks.get(row).copied().unwrap_or(0)),
    }
}

/// Bounds the deviations of n unknowns from the chord through two frames if their equations have one solution near it
/// at every time of the window.
///
/// `variation` bounds the changes of the Jacobian's entries, without the columns that rotate, for deviations of at most
/// its first argument (n). It writes the entries that change over a matrix (n × n) of zeros.
///
/// # Errors
/// Returns the row that misses the condition by most if one solution cannot be verified.
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

/// Newton operator with the inverse C of the Jacobian of the second frame.
struct Operator<'a, T: Real, D: Dim>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// |C|.
    inverse: &'a OMatrix<T, D, D>,
    /// |C J′| of the columns that rotate.
    turned: &'a OMatrix<T, D, D>,
    turns: OVector<bool, D>,
    changes: OVector<T, D>,
}

impl<'a, T: Real, D: Dim> Operator<'a, T, D>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// Returns the operator and its remainder on the chord: arms on it are A cos δ + J sin δ, the second derivative of
    /// A is J′, and both frames satisfy their equations up to rounding.
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

    /// |I − C J| R near the chord.
    fn spread(&self, variation: &OMatrix<T, D, D>, deviations: &OVector<T, D>) -> OVector<T, D> {
        // Every column either rotates or varies.
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

/// Effects of a deviation of a rotating column for this change of its angle: |sin δ| is at most δ, and 1 − cos δ at
/// most ½ δ².
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

/// Adds to each unknown's remainder the effect of second derivatives and the terms left beside them: ½ δ⁴ of the cosine
/// (`rest`) and δ³ of the sine.
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

/// Bound on the rounding of each equation's residual, by the largest term of an unknown. Collinear links multiply their
/// angles by almost nothing along the chord, so the term counts also where the link rotates and where `variation` moves
/// it.
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

/// Replaces a vector by its product with a matrix.
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

    /// Two links of lengths a and b on the ground: one pin fixed, the other on a crank of radius r that rotates by θ.
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

        /// Jacobian of r e(θ) + a e(φ) − b e(ψ) − d, and its derivative by the angle of each column.
        fn columns(&self, angles: Vector2<f64>) -> [Matrix2<f64>; 2] {
            let [first, second] = [0, 1].map(|place| angles[place].sin_cos());
            let column = |length: f64, (s, c): (f64, f64)| {
                [Vector2::new(-s, c), Vector2::new(-c, -s)].map(|it| it * length)
            };
            let (first, second) = (column(self.a, first), column(-self.b, second));
            [0, 1].map(|place| Matrix2::from_columns(&[first[place], second[place]]))
        }

        /// Bounds on the deviations of both angles from the chord, for this rotation of the crank per step.
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

    /// Angles of closed forms stay within the deviations, and the deviations are not much wider than needed.
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
