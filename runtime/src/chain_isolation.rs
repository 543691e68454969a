//! Verifies that the equations of a chain of cells have one solution near the chord through two frames, at every time
//! of a window.
//!
//! This is [`crate::isolation`] for equations of which all but the last two link a cell of two angles to the next one.
//! The inverse is never written out, so the work is proportional to the number of cells. Bounds are at most a little
//! wider; if they do not suffice between two frames, the whole inverse decides.

use nalgebra::allocator::Allocator;
use nalgebra::{Const, DefaultAllocator, Dim, OVector};

use crate::chain::{ChainInverse, ChainProduct, entry};
use crate::deviations::settled;
use crate::isolation::{Chord, add_remainder, fourth, in_blocks, isolate_all, turned_by};
use crate::math::Real;
use crate::time_window::{LEFT_BY_ROUNDING, TimeWindow};
use crate::vector::{add, zero_vector};

/// Calls [`isolate_whole_chain`] for a number of unknowns that generated code knows. `blocks` (N) gives the block of
/// each equation.
///
/// # Errors
/// Returns the block that misses the condition by most if one solution cannot be verified.
pub fn isolate_chain<T: Real, const N: usize>(
    blocks: [u16; N],
    window: &TimeWindow<T>,
    chord: Chord<'_, T, Const<N>>,
) -> Result<[T; N], u16> {
    in_blocks(blocks, isolate_whole_chain(window, chord))
}

/// Computes the deviations of [`isolate_all`] for equations whose columns all rotate, and that link cells of two
/// unknowns.
///
/// Unknowns 2 k and 2 k + 1 are cell k, equations 2 k and 2 k + 1 link it to cell k + 1, and the last two may read every cell.
///
/// # Errors
/// Returns the row that misses the condition by most if one solution cannot be verified.
pub fn isolate_whole_chain<T: Real, D: Dim>(
    window: &TimeWindow<T>,
    chord: Chord<'_, T, D>,
) -> Result<OVector<T, D>, usize>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let deviations_or_row = match ChainInverse::new(chord.jacobian) {
        Some(inverse) => isolated(&inverse, &chord),
        None => Err(0),
    };
    // Beyond the frames there are nearer windows to try.
    match deviations_or_row {
        Err(_) if window.steps <= T::ONE => isolate_all(chord, |_, _| {}),
        _ => deviations_or_row,
    }
}

fn isolated<T: Real, D: Dim>(
    inverse: &ChainInverse<T, D>,
    chord: &Chord<'_, T, D>,
) -> Result<OVector<T, D>, usize>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let product = inverse.product(chord.turning);
    let least = left_of_line(inverse, &product, chord);
    settled(&least, |deviations| {
        let (mut turned, mut beside) = (deviations.clone(), deviations.clone());
        let vectors = turned.as_mut_slice().iter_mut().zip(beside.as_mut_slice());
        for ((turned, beside), change) in vectors.zip(chord.changes.as_slice()) {
            [*turned, *beside] = turned_by(*change, *turned);
        }
        let mut spread = inverse.spread(&product, &turned);
        add(&mut spread, &beside);
        spread
    })
}

/// Remainder of the Newton operator on the chord, as for [`isolate_all`].
fn left_of_line<T: Real, D: Dim>(
    inverse: &ChainInverse<T, D>,
    product: &ChainProduct<T, D>,
    chord: &Chord<'_, T, D>,
) -> OVector<T, D>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let dimension = chord.changes.shape_generic().0;
    let squares = chord.changes.map(|change| change * change);
    // Remainder of rotation in each equation, and bound on the rounding of its residual.
    let (mut second, mut off) = (chord.curvatures.clone(), zero_vector(dimension));
    let rows = second.as_mut_slice().iter_mut().zip(off.as_mut_slice());
    for (row, (second, off)) in rows.enumerate() {
        let columns = match row < dimension.value().saturating_sub(2) {
            true => row / 2 * 2..row / 2 * 2 + 4,
            false => 0..dimension.value(),
        };
        let sizes = chord.sizes.as_slice().iter().zip(squares.as_slice());
        let sizes = sizes.enumerate().skip(columns.start).take(columns.len());
        for (column, (size, square)) in sizes {
            let turned = entry(chord.turning, row, column);
            let rounding = T::from_f64(LEFT_BY_ROUNDING) * T::EPSILON * size.abs();
            let part = rounding * (entry(chord.jacobian, row, column).abs() + turned.abs());
            *off = if part > *off { part } else { *off };
            *second += turned * *square;
        }
    }
    add(&mut off, &chord.bounds);
    let rest = inverse.spread(product, &fourth(&squares));
    let mut least = inverse.times(&second);
    add_remainder(
        &mut least,
        chord.remainder,
        &rest,
        &chord.changes,
        &chord.turns,
    );
    add(&mut least, &inverse.magnitude_times(&off));
    least
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::isolate_whole_chain;
    use crate::chain::ChainInverse;
    use crate::isolation::{Chord, isolate_all};
    use crate::time_window::TimeWindow;

    /// Jacobian of a chain of so many cells, and the derivatives of its columns. `irregular` is the difference of
    /// lengths and angles from cell to cell.
    fn cells(count: usize, irregular: f64, seed: f64) -> [DMatrix<f64>; 2] {
        let order = 2 * count;
        let part = |place: usize, k: f64| irregular * f64::sin(k * (place as f64 + seed));
        let angle = |it: usize| part(it, 1.3) + if it.is_multiple_of(2) { 0.5 } else { -0.5 };
        let mut matrices = [DMatrix::zeros(order, order), DMatrix::zeros(order, order)];
        let mut arm = |row: usize, column: usize, length: f64| {
            let (s, c) = angle(column).sin_cos();
            let [jacobian, turning] = &mut matrices;
            for (row, [first, second]) in [(row, [-s, -c]), (row + 1, [c, -s])] {
                jacobian[(row, column)] = length * first;
                turning[(row, column)] = length * second;
            }
        };
        for cell in 0..count - 1 {
            let row = 2 * cell;
            for (side, sign) in [1.0, -1.0].into_iter().enumerate() {
                arm(row, row + side, sign * (0.5 + part(row + side, 2.1)));
                arm(row, row + 2 + side, -sign * (0.5 + part(row + side, 3.3)));
            }
        }
        for column in 0..order {
            let length = match column.is_multiple_of(2) {
                true => 0.5,
                false => 0.4 + part(column, 0.7),
            };
            arm(order - 2, column, length);
        }
        matrices
    }

    /// Vector whose entries differ.
    fn vector(order: usize, seed: f64) -> DVector<f64> {
        DVector::from_fn(order, |row, _| 1.0 + f64::sin(1.7 * row as f64 + seed))
    }

    #[test]
    fn products_are_those_of_the_inverse() {
        let mut compared = 0;
        for (count, seed) in [(2, 0.0), (3, 1.0), (8, 2.0), (8, 5.0), (30, 3.0), (60, 4.0)] {
            let [jacobian, turning] = cells(count, 0.05, seed);
            let Some(chain) = ChainInverse::new(&jacobian) else {
                continue;
            };
            compared += 1;
            let order = 2 * count;
            let inverse = jacobian.clone().try_inverse().unwrap();
            let rounding = 1e-14 * inverse.amax() * jacobian.amax() * order as f64;
            let off = vector(order, seed);
            let exact = &inverse * &off;
            let largest = inverse.abs() * &off;
            assert!((chain.times(&off) - &exact).amax() <= rounding * largest.amax());
            // A sum of magnitudes in two parts is at least that of the sums, and here at most a few times as large.
            for (exact, found) in [
                (&largest, chain.magnitude_times(&off)),
                (
                    &((&inverse * &turning).abs() * &off),
                    chain.spread(&chain.product(&turning), &off),
                ),
            ] {
                for (exact, found) in exact.iter().zip(&found) {
                    assert!(*found >= exact * (1.0 - rounding), "{found}, {exact}");
                    assert!(*found <= 4.0 * exact + rounding, "{found}, {exact}");
                }
            }
        }
        assert!(compared >= 5, "{compared} chains");
    }

    #[test]
    fn columns_of_the_inverse_are_exact() {
        let [jacobian, _] = cells(9, 0.1, 2.0);
        let chain = ChainInverse::new(&jacobian).unwrap();
        let inverse = jacobian.try_inverse().unwrap();
        for column in 0..18 {
            let mut unit = DVector::zeros(18);
            unit[column] = 1.0;
            let off = (chain.times(&unit) - inverse.column(column)).amax();
            assert!(off <= 1e-12 * inverse.amax(), "{column}: {off}");
        }
    }

    /// The chain and the whole inverse agree between two frames, with similar deviations. Beyond the frames, the whole
    /// inverse verifies whatever the chain verifies.
    #[test]
    fn chain_verifies_what_the_whole_inverse_verifies() {
        let mut verified = [0; 2];
        let mut widest = 1.0_f64;
        for case in 0..400 {
            let seed = f64::from(case);
            let (count, order) = (10, 20);
            let [jacobian, turning] = cells(count, 0.04, seed);
            let step = 10.0_f64.powf(-2.0 + 1.5 * f64::sin(0.7 * seed));
            let window = match case % 2 {
                0 => TimeWindow::between(1.0),
                _ => TimeWindow::around(1.0, 2.0),
            };
            let (mut jacobians, mut turnings) =
                ([jacobian.clone(), jacobian], [turning.clone(), turning]);
            let [first, second] = &mut jacobians;
            let [first_turning, second_turning] = &mut turnings;
            let chord = |jacobian, turning| Chord {
                remainder: window.remainder,
                bounds: vector(order, seed) * step.powi(3),
                curvatures: DVector::zeros(order),
                changes: vector(order, seed + 1.0) * step,
                sizes: DVector::from_element(order, 1.0),
                jacobian,
                turns: DVector::from_element(order, true),
                turning,
            };
            let chain = isolate_whole_chain(&window, chord(first, first_turning));
            let whole = isolate_all(chord(second, second_turning), |_, _| {});
            if let Ok(chain) = &chain {
                verified[case as usize % 2] += 1;
                let whole = whole.as_ref().unwrap();
                for (chain, whole) in chain.iter().zip(whole) {
                    // Either may have needed one more round, with wider deviations.
                    let ratio = (chain / whole).max(whole / chain);
                    widest = widest.max(ratio);
                }
            }
            assert!(case % 2 == 1 || chain.is_ok() == whole.is_ok(), "{case}");
        }
        assert!(
            verified.iter().all(|verified| *verified > 20),
            "{verified:?} verified"
        );
        assert!(widest < 2.0, "deviations {widest} times as wide");
    }
}
