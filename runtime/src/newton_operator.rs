//! The line of a [`Chord`] → what the operator of Newton leaves of it, and what it does to sags.
//!
//! The operator is x ↦ x − C F(x), with C the inverse of the Jacobian of the second frame. The module does not decide anything: what
//! sags are tried, and when they hold, is with [`isolate_all`](crate::isolate_all).

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OMatrix, OVector};

use crate::factored_inverse::invert_by_factors;
use crate::inverse::invert;
use crate::isolation::Chord;
use crate::math::Real;
use crate::span::LEFT_BY_ROUNDING;
use crate::vector::{add, zero_vector};

/// The number of unknowns from which on an inverse is found by factors: chains of so many links have few entries.
const FACTORED: usize = 16;

/// The operator of Newton with the inverse C of the Jacobian of the second frame.
pub(crate) struct NewtonOperator<'a, T: Real, D: Dim>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// |C|.
    inverse: &'a OMatrix<T, D, D>,
    /// |C J′| of the columns that turn.
    turned: &'a OMatrix<T, D, D>,
    turns: OVector<bool, D>,
    ways: OVector<T, D>,
}

impl<'a, T: Real, D: Dim> NewtonOperator<'a, T, D>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// The operator, and what it leaves of the line: arms on it are A cos δ + J sin δ, the second derivative of A is J′, and both
    /// frames satisfy their equations but for rounding.
    pub(crate) fn new(
        chord: Chord<'a, T, D>,
        variation: &OMatrix<T, D, D>,
        sizes: &OVector<T, D>,
    ) -> Result<(Self, OVector<T, D>), usize> {
        let mut off = roundings(&chord, variation, sizes);
        let Chord {
            bend,
            bounds,
            curvatures,
            ways,
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
        let squares = ways.map(|way| way * way);
        let mut least = times(turned, &squares);
        add(&mut least, &times(inverse, &curvatures));
        for matrix in [&mut *inverse, &mut *turned] {
            for entry in matrix.as_mut_slice() {
                *entry = entry.abs();
            }
        }
        // What is left beside second derivatives: ½ δ⁴ of the cosine's, and δ³ of the sine's.
        let fourth = squares.map(|square| T::HALF * square * square);
        let rest = times(turned, &fourth);
        let ways_and_squares = ways.as_slice().iter().zip(squares.as_slice());
        let entries = least.as_mut_slice().iter_mut().zip(rest.as_slice());
        let entries = entries.zip(ways_and_squares).zip(turns.as_slice());
        for (((entry, rest), (way, square)), turns) in entries {
            let third = match turns {
                true => *way * *square,
                false => T::ZERO,
            };
            *entry = bend * (entry.abs() + *rest + third);
        }
        add(&mut off, &bounds);
        add(&mut least, &times(inverse, &off));
        let operator = Self {
            inverse,
            turned,
            turns,
            ways,
        };
        Ok((operator, least))
    }

    /// |I − C J| R near the line: |sin δ| is at most δ, and 1 − cos δ at most ½ δ².
    pub(crate) fn spread(
        &self,
        variation: &OMatrix<T, D, D>,
        sags: &OVector<T, D>,
    ) -> OVector<T, D> {
        // Every column either turns or varies.
        let (mut turned, mut varied) = (sags.clone(), sags.clone());
        let mut beside = sags.clone();
        let angles = self.ways.as_slice().iter().zip(self.turns.as_slice());
        let vectors = turned.as_mut_slice().iter_mut();
        let vectors = vectors
            .zip(varied.as_mut_slice())
            .zip(beside.as_mut_slice());
        for ((way, turns), ((turned, varied), beside)) in angles.zip(vectors) {
            let sag = *turned;
            let delta = *way + sag;
            (*turned, *varied, *beside) = match turns {
                true => (delta * sag, T::ZERO, T::HALF * delta * delta * sag),
                false => (T::ZERO, sag, T::ZERO),
            };
        }
        let mut spread = times(self.inverse, &times(variation, &varied));
        add(&mut spread, &beside);
        add(&mut spread, &times(self.turned, &turned));
        spread
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
        let entries = column.iter().zip(turned).zip(change);
        for (largest, ((entry, turned), change)) in roundings.as_mut_slice().iter_mut().zip(entries)
        {
            let part = (entry.abs() + turned.abs() + change.abs()) * *size;
            *largest = if part > *largest { part } else { *largest };
        }
    }
    for rounding in roundings.as_mut_slice() {
        *rounding *= T::from_f64(LEFT_BY_ROUNDING) * T::EPSILON;
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
