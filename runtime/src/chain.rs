//! Applies the inverse of a chain's Jacobian, in operations proportional to the number of cells.
//!
//! A cell has two unknowns. Two equations link it to the next cell, and the last two equations of all may read every
//! cell. If one equation is off, every cell before its link follows from the first cell as in an exact chain. Every
//! cell behind the link follows from the last cell. The inverse therefore has rank two on either side of the links, and
//! is never written out (a semiseparable matrix; Vandebril, Van Barel and Mastronardi, *Matrix Computations and
//! Semiseparable Matrices*, 2008).

use core::ops::Range;

use nalgebra::allocator::Allocator;
use nalgebra::{Const, DefaultAllocator, Dim, OMatrix, OVector};

use crate::math::Real;
use crate::vector::zero_vector;

/// Largest derivative of an unknown by those of the first or the last cell. Beyond it, rounding grows along the chain.
const LARGEST_TRANSFER: f64 = 64.0;

/// Two numbers for each unknown or equation of a chain.
pub(crate) type Pairs<T, D> = OVector<[T; 2], D>;

/// Matrix of two rows.
type Square<T> = [[T; 2]; 2];

/// Inverse C of a Jacobian (n × n, n even). C_ir is the product of `from_first[i]` and `first[r]` if cell i is before
/// the link of equation r, and that of `from_last[i]` and `last[r]` if cell i is behind it.
pub(crate) struct ChainInverse<T: Real, D: Dim>
where
    DefaultAllocator: Allocator<D>,
{
    /// Derivatives of each unknown by those of the first cell if all links hold.
    from_first: Pairs<T, D>,
    /// Derivatives of each unknown by those of the last cell.
    from_last: Pairs<T, D>,
    /// Changes of the first cell's unknowns for an equation that is off by 1: two rows of C.
    first: Pairs<T, D>,
    /// Changes of the last cell's unknowns.
    last: Pairs<T, D>,
}

/// Product of the inverse with another matrix that has entries only where the Jacobian has.
pub(crate) struct ChainProduct<T: Real, D: Dim>
where
    DefaultAllocator: Allocator<D>,
{
    /// Effect of each column on the first cell.
    first: Pairs<T, D>,
    /// Effect of each column on the last cell.
    last: Pairs<T, D>,
    /// Effect of each column on its own cell.
    own: Pairs<T, D>,
}

impl<T: Real, D: Dim> ChainInverse<T, D>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    /// Returns the inverse; `None` if a link does not determine one of its cells from the other, or is nearly singular.
    pub fn new(jacobian: &OMatrix<T, D, D>) -> Option<Self> {
        let [from_first, first] = swept(jacobian, false)?;
        let [from_last, last] = swept(jacobian, true)?;
        Some(Self {
            from_first,
            from_last,
            first,
            last,
        })
    }

    /// Product with a vector.
    pub fn times(&self, vector: &OVector<T, D>) -> OVector<T, D> {
        self.sides([&self.first, &self.last], true, vector, |value| value)
    }

    /// Upper bound of the product of |C| with a vector that is not negative.
    pub fn magnitude_times(&self, vector: &OVector<T, D>) -> OVector<T, D> {
        self.sides([&self.first, &self.last], true, vector, T::abs)
    }

    /// Effects of a vector's entries on all cells, from their effects on the first and the last cell: entries behind a
    /// cell act on the cells before them, and the others the other way round. Entries of a link are behind its cell;
    /// those of a cell act on neither side.
    fn sides(
        &self,
        [first, last]: [&Pairs<T, D>; 2],
        are_links: bool,
        vector: &OVector<T, D>,
        taken: impl Fn(T) -> T,
    ) -> OVector<T, D> {
        let mut sums = zero_vector(vector.shape_generic().0);
        let cells = vector.len() / 2;
        let mut behind = [T::ZERO; 2];
        for cell in (0..cells).rev() {
            let with_own = gathered(behind, first, cell, vector, &taken);
            if are_links {
                behind = with_own;
            }
            for unknown in rows_of(cell) {
                let from = at(&self.from_first, unknown).map(&taken);
                set(&mut sums, unknown, dot(from, behind));
            }
            behind = with_own;
        }
        let mut before = [T::ZERO; 2];
        for cell in 0..cells {
            for unknown in rows_of(cell) {
                let from = at(&self.from_last, unknown).map(&taken);
                let ahead = value_at(&sums, unknown);
                set(&mut sums, unknown, ahead + dot(from, before));
            }
            before = gathered(before, last, cell, vector, &taken);
        }
        sums
    }

    /// Product with a matrix that has entries only where the Jacobian has.
    pub fn product(&self, matrix: &OMatrix<T, D, D>) -> ChainProduct<T, D> {
        let order = matrix.shape_generic().0.value();
        let zero = || OVector::from_element_generic(matrix.shape_generic().0, Const, [T::ZERO; 2]);
        let [mut first, mut last, mut own] = [zero(), zero(), zero()];
        for column in 0..order {
            let cell = column / 2;
            let sum = |responses: &Pairs<T, D>, rows: Range<usize>| {
                rows.fold([T::ZERO; 2], |sum, row| {
                    let entry = entry(matrix, row, column);
                    let response = at(responses, row);
                    [0, 1].map(|side| sum[side] + entry * response[side])
                })
            };
            let closing = order.saturating_sub(2)..order;
            let behind = match cell + 1 < order / 2 {
                true => rows_of(cell),
                false => 0..0,
            };
            let before = match cell {
                0 => 0..0,
                _ => rows_of(cell - 1),
            };
            let ahead = |responses| {
                added(
                    sum(responses, behind.clone()),
                    sum(responses, closing.clone()),
                )
            };
            let [first_ahead, last_ahead] = [&self.first, &self.last].map(ahead);
            let [first_before, last_before] =
                [&self.first, &self.last].map(|responses| sum(responses, before.clone()));
            let both = [2 * cell, 2 * cell + 1].map(|unknown| {
                dot(at(&self.from_first, unknown), first_ahead)
                    + dot(at(&self.from_last, unknown), last_before)
            });
            put(&mut first, column, added(first_ahead, first_before));
            put(&mut last, column, added(last_ahead, last_before));
            put(&mut own, column, both);
        }
        ChainProduct { first, last, own }
    }

    /// Upper bound of the product of the magnitudes of C M with a vector that is not negative.
    pub fn spread(&self, product: &ChainProduct<T, D>, vector: &OVector<T, D>) -> OVector<T, D> {
        let ends = [&product.first, &product.last];
        let mut spread = self.sides(ends, false, vector, T::abs);
        for cell in 0..vector.len() / 2 {
            let within = gathered([T::ZERO; 2], &product.own, cell, vector, T::abs);
            for (unknown, within) in rows_of(cell).zip(within) {
                let beside = value_at(&spread, unknown);
                set(&mut spread, unknown, beside + within);
            }
        }
        spread
    }
}

/// Adds the effects of both entries of a cell or a link.
fn gathered<T: Real, D: Dim>(
    to: [T; 2],
    responses: &Pairs<T, D>,
    cell: usize,
    vector: &OVector<T, D>,
    taken: impl Fn(T) -> T,
) -> [T; 2]
where
    DefaultAllocator: Allocator<D>,
{
    rows_of(cell).fold(to, |to, place| {
        let response = at(responses, place);
        let value = value_at(vector, place);
        [0, 1].map(|side| to[side] + taken(response[side]) * value)
    })
}

/// Derivatives of all unknowns by those of the first cell, and changes of these for an equation that is off by 1; in
/// reverse, those of the last cell.
fn swept<T: Real, D: Dim>(
    jacobian: &OMatrix<T, D, D>,
    is_reversed: bool,
) -> Option<[Pairs<T, D>; 2]>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let dimension = jacobian.shape_generic().0;
    let cells = dimension.value() / 2;
    let (last_cell, last_link) = (cells.checked_sub(1)?, cells.checked_sub(2)?);
    let cell = |place: usize| match is_reversed {
        true => last_cell - place,
        false => place,
    };
    let link = |place: usize| match is_reversed {
        true => last_link - place,
        false => place,
    };
    let zero = || OVector::from_element_generic(dimension, Const, [T::ZERO; 2]);
    let [mut transfers, mut responses] = [zero(), zero()];
    let mut transfer = [[T::ONE, T::ZERO], [T::ZERO, T::ONE]];
    for place in 0..cells {
        if place > 0 {
            let near = square(jacobian, link(place - 1), cell(place - 1));
            let far = inverted(square(jacobian, link(place - 1), cell(place)))?;
            transfer = times(far, times(near, transfer)).map(|row| row.map(|value| -value));
        }
        let is_small = |value: &T| value.abs() <= T::from_f64(LARGEST_TRANSFER);
        // Written so that NaN is refused.
        if !transfer.as_flattened().iter().all(is_small) {
            return None;
        }
        for (unknown, row) in rows_of(cell(place)).zip(transfer) {
            put(&mut transfers, unknown, row);
        }
    }
    // Change of the last equations for a moved cell if all cells behind it follow.
    let mut seen = square(jacobian, last_cell, cell(last_cell));
    for place in (0..=last_link).rev() {
        let far = inverted(square(jacobian, link(place), cell(place + 1)))?;
        let off = times(seen, far);
        for (side, row) in rows_of(link(place)).enumerate() {
            put(&mut responses, row, off.map(|off| off[side]));
        }
        let followed = times(off, square(jacobian, link(place), cell(place)));
        let direct = square(jacobian, last_cell, cell(place));
        seen = [0, 1].map(|row| [0, 1].map(|column| direct[row][column] - followed[row][column]));
    }
    let answer = inverted(seen)?;
    for row in 0..2 * last_cell {
        let off = at(&responses, row);
        put(&mut responses, row, answer.map(|row| -dot(row, off)));
    }
    for (side, row) in rows_of(last_cell).enumerate() {
        put(&mut responses, row, answer.map(|row| row[side]));
    }
    Some([transfers, responses])
}

/// Unknowns of a cell, which are also the equations of the link behind it.
fn rows_of(cell: usize) -> Range<usize> {
    2 * cell..2 * cell + 2
}

/// Derivatives of the equations of a link by the unknowns of a cell.
fn square<T: Real, D: Dim>(matrix: &OMatrix<T, D, D>, link: usize, cell: usize) -> Square<T>
where
    DefaultAllocator: Allocator<D, D>,
{
    [0, 1].map(|row| [0, 1].map(|column| entry(matrix, 2 * link + row, 2 * cell + column)))
}

fn inverted<T: Real>([[a, b], [c, d]]: Square<T>) -> Option<Square<T>> {
    let determinant = a * d - b * c;
    let is_regular = determinant.abs() > T::ZERO && determinant.is_finite();
    is_regular.then(|| {
        [
            [d / determinant, -b / determinant],
            [-c / determinant, a / determinant],
        ]
    })
}

fn times<T: Real>(left: Square<T>, right: Square<T>) -> Square<T> {
    left.map(|row| [0, 1].map(|column| dot(row, right.map(|row| row[column]))))
}

fn dot<T: Real>(left: [T; 2], right: [T; 2]) -> T {
    left[0] * right[0] + left[1] * right[1]
}

fn added<T: Real>(left: [T; 2], right: [T; 2]) -> [T; 2] {
    [left[0] + right[0], left[1] + right[1]]
}

// Not every compiler proves that these indices exist; indexing would leave a panic.

/// Entry of a matrix of a chain.
pub(crate) fn entry<T: Real, D: Dim>(matrix: &OMatrix<T, D, D>, row: usize, column: usize) -> T
where
    DefaultAllocator: Allocator<D, D>,
{
    let order = matrix.shape_generic().0.value();
    let entry = matrix.as_slice().get(column * order + row);
    entry.copied().unwrap_or(T::ZERO)
}

fn at<T: Real, D: Dim>(pairs: &Pairs<T, D>, place: usize) -> [T; 2]
where
    DefaultAllocator: Allocator<D>,
{
    let pair = pairs.as_slice().get(place);
    pair.copied().unwrap_or([T::ZERO; 2])
}

fn put<T: Real, D: Dim>(pairs: &mut Pairs<T, D>, place: usize, pair: [T; 2])
where
    DefaultAllocator: Allocator<D>,
{
    if let Some(own) = pairs.as_mut_slice().get_mut(place) {
        *own = pair;
    }
}

fn value_at<T: Real, D: Dim>(vector: &OVector<T, D>, place: usize) -> T
where
    DefaultAllocator: Allocator<D>,
{
    let value = vector.as_slice().get(place);
    value.copied().unwrap_or(T::ZERO)
}

fn set<T: Real, D: Dim>(vector: &mut OVector<T, D>, place: usize, value: T)
where
    DefaultAllocator: Allocator<D>,
{
    if let Some(own) = vector.as_mut_slice().get_mut(place) {
        *own = value;
    }
}
