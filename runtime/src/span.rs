//! Two frames and the bounds of what moves between them → whether the second one lies on the path of the first.
//!
//! Over a [`Span`] of time that holds both frames every value is bounded by its distance from a straight line through them; the
//! generator knows the bounds of equations and Jacobians that follow. [`isolate`] then shows that the equations have one solution near
//! the line at every time of the span: what is found anywhere in it is what the first frame leads to. The module does not know
//! equations.

use nalgebra::allocator::Allocator;
use nalgebra::{DefaultAllocator, Dim, OMatrix, OVector, SMatrix, SVector};

use crate::inverse::inverse_sizes;
use crate::math::Real;
use crate::signal::Signal;
use crate::vector::{add, zero_matrix, zero_vector};

/// A span of time about two frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span<T = f64> {
    /// The time from the first frame to the second one, in s.
    pub step: T,
    /// How far the time goes from the second frame, in s.
    pub time: T,
    /// The same in steps: 1 where the span ends with the frames.
    pub stretch: T,
    /// The remainder of linear interpolation over the span, for a second derivative of 1 and a way of 1.
    pub bend: T,
    /// 1 where the span goes beyond the frames, and as far before them, or else 0.
    pub beyond: T,
    /// How far rounding leaves what frames hold from what it stands for over the span, as a part of its size.
    pub rounding: T,
}

impl<T: Real> Span<T> {
    /// From one frame to the next one, which is the time `h` (s) away: ½ x (1 − x) is at most ⅛ there.
    pub fn between(h: T) -> Self {
        Self {
            step: h,
            time: h.abs(),
            stretch: T::ONE,
            bend: T::from_f64(0.125),
            beyond: T::ZERO,
            rounding: rounding(T::ONE),
        }
    }

    /// `stretch` (at least 1) steps of `h` (s) before the second frame and after it: ½ x (x + 1) is largest at their end.
    pub fn around(h: T, stretch: T) -> Self {
        Self {
            step: h,
            time: h.abs() * stretch,
            stretch,
            bend: T::HALF + T::HALF / stretch,
            beyond: T::ONE,
            rounding: rounding(stretch),
        }
    }

    /// How far a signal goes from its second value, and from the straight line, on the way that [`Signal::towards`] describes; beyond
    /// the frames as far as [`Span::holds_signal`] lets it.
    pub fn signal(&self, before: &Signal<T>, now: &Signal<T>) -> [T; 2] {
        let moved = (now.value - before.value).abs();
        let sag = bend_of_signal(self.step, before, now) + self.beyond * self.tube(moved);
        [self.stretch * moved + sag, sag]
    }

    /// Whether a signal that goes from `last` to `next` in the time `h` (s) stays as near to the straight line from `before` to `now`
    /// as [`Span::signal`] supposes; the line ends `since` (s) before `next`.
    pub fn holds_signal(
        &self,
        [before, now]: [&Signal<T>; 2],
        [last, next]: [&Signal<T>; 2],
        h: T,
        since: T,
    ) -> bool {
        let moved = now.value - before.value;
        let line = |since: T| now.value + moved * (since / self.step);
        let off = |signal: &Signal<T>, since: T| (signal.value - line(since)).abs();
        let tube = T::HALF * self.tube(moved.abs());
        off(last, since - h) <= tube
            && off(next, since) <= tube
            && bend_of_signal(h, last, next) <= tube
    }

    /// How far a signal that moves so far in one step may be from the straight line beyond the frames.
    fn tube(&self, moved: T) -> T {
        T::from_f64(0.25) * self.stretch * moved
    }
}

/// How far rounding leaves what frames hold, and what differences of two of them lead to that are multiplied by `stretch`.
fn rounding<T: Real>(stretch: T) -> T {
    T::EPSILON * (T::from_f64(LEFT_BY_ROUNDING) + T::from_f64(OF_DIFFERENCES) * stretch)
}

/// How far a signal is from a straight line between two values that are `h` (s) apart.
///
/// The functions that rates and accelerations at the ends are multiplied by in the polynomial of the fifth degree are at most
/// 0.2 and 0.018 in size.
fn bend_of_signal<T: Real>(h: T, before: &Signal<T>, now: &Signal<T>) -> T {
    let moved = now.value - before.value;
    let rate = |it: &Signal<T>| (it.rate * h - moved).abs();
    let acceleration = |it: &Signal<T>| (it.acceleration * h * h).abs();
    T::from_f64(0.2) * (rate(before) + rate(now))
        + T::from_f64(0.018) * (acceleration(before) + acceleration(now))
}

/// A straight line through the values of two frames, and how far a value may be from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tube<T = f64> {
    /// The value in the second frame.
    pub value: T,
    /// How far it has moved in one step.
    pub moved: T,
    /// How far it may be from the line.
    pub sag: T,
}

impl<T: Real> Tube<T> {
    /// The tube of what does not move.
    pub const STILL: Self = Self {
        value: T::ZERO,
        moved: T::ZERO,
        sag: T::ZERO,
    };

    /// The tube about a value.
    pub fn new(now: T, before: T, sag: T) -> Self {
        Self {
            value: now,
            moved: now - before,
            sag,
        }
    }

    /// Whether a value is in the tube so many steps after the second frame, but for rounding.
    pub fn holds(&self, value: T, steps: T) -> bool {
        let rounding = T::from_f64(ROUNDING) * T::EPSILON * (T::ONE + value.abs());
        (value - self.value - self.moved * steps).abs() <= self.sag + rounding
    }
}

/// The multiple of ε by which a value that Newton-Raphson finds may be off.
const ROUNDING: f64 = 65536.0;

/// The multiple of ε by which a solved equation may be off zero: a few roundings of angles of some turns.
const LEFT_BY_ROUNDING: f64 = 64.0;

/// The multiple of ε by which the difference of two values may be off, as a part of their size.
const OF_DIFFERENCES: f64 = 32.0;

/// The multiple of the least sags that is tried first.
const FIRST: f64 = 2.0;

/// By how much sags are widened that the operator does not map into themselves (ε-inflation; Rump, Acta Numerica 2010, section 10.5),
/// and how often.
const INFLATION: f64 = 1.25;
const WIDENED: u8 = 8;

/// The round from which on sags must come nearer to being mapped into themselves.
const SETTLED: u8 = 2;

/// [`isolate_all`] for a number of unknowns that generated code knows. `blocks` (N) says to which block an equation belongs.
///
/// # Errors
/// The block that is farthest from it, where it cannot be shown.
pub fn isolate<T: Real, const N: usize>(
    blocks: [u16; N],
    bounds: [T; N],
    sizes: [T; N],
    jacobian: &SMatrix<T, N, N>,
    variation: impl Fn(&[T; N], &mut SMatrix<T, N, N>),
) -> Result<[T; N], u16> {
    let (bounds, sizes) = (SVector::from(bounds), SVector::from(sizes));
    let found = isolate_all(&bounds, &sizes, jacobian, |sags, entries| {
        let [sags] = &sags.data.0;
        variation(sags, entries);
    });
    match found {
        Ok(sags) => Ok(sags.data.0[0]),
        Err(row) => Err(blocks.get(row).copied().unwrap_or(0)),
    }
}

/// How far n unknowns may be from a straight line through two frames, where their equations have one solution about the line at
/// every time of the span.
///
/// `bounds` (n) says how far each equation may be from zero on the line, `sizes` (n) how large the unknowns are, which rounding is a
/// part of, `jacobian` (n × n) is that of the second frame, and `variation` how far its entries may change where the unknowns are no farther from the line than its first argument (n): it writes
/// those that do over a matrix (n × n) of zeros.
/// With C the inverse of the Jacobian, the operator of Newton with C maps the sags R into themselves where
/// |C| bounds + |C| variation(R) R ≤ R (Krawczyk).
///
/// # Errors
/// The row that is farthest from it, where it cannot be shown.
pub fn isolate_all<T: Real, D: Dim>(
    bounds: &OVector<T, D>,
    sizes: &OVector<T, D>,
    jacobian: &OMatrix<T, D, D>,
    mut variation: impl FnMut(&OVector<T, D>, &mut OMatrix<T, D, D>),
) -> Result<OVector<T, D>, usize>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let inverse = inverse_sizes(jacobian)?;
    let dimension = bounds.shape_generic().0;
    let mut entries = zero_matrix(dimension);
    // Both frames satisfy their equations but for rounding, so that is how far they may be from zero on the line at least.
    let sizes = sizes.map(|size| size.abs());
    variation(&sizes, &mut entries);
    let mut off = roundings(jacobian, &entries, &sizes);
    add(&mut off, bounds);
    let least = times(&inverse, &off);
    // Where a map least + k R + a R² of one sag takes any R into itself, the largest that it does so with is 2 least or more.
    let mut sags = scaled(&least, FIRST);
    let (mut farthest, mut before) = (0, T::ZERO);
    for round in 0..WIDENED {
        variation(&sags, &mut entries);
        let spread = times(&entries, &sags);
        let mut needed = times(&inverse, &spread);
        add(&mut needed, &least);
        let mut largest = T::ONE;
        let mut is_inside = true;
        let both = needed.as_slice().iter().zip(sags.as_slice());
        for (row, (needed, sag)) in both.enumerate() {
            // Written so that NaN is refused, and bounds that have become infinite.
            is_inside &= needed <= sag && sag.is_finite();
            let is_nearer = *needed <= largest * *sag;
            if !is_nearer {
                (farthest, largest) = (row, *needed / *sag);
            }
        }
        if is_inside {
            // What the operator maps them to holds the solution as well.
            return Ok(needed);
        }
        // The first two rounds show what each unknown does to the others; sags that need more and more after that have no end.
        let is_nearing = largest < before;
        if round >= SETTLED && !is_nearing {
            break;
        }
        before = largest;
        sags = scaled(&needed, INFLATION);
    }
    Err(farthest)
}

/// How far rounding may leave each equation from zero: by the largest part that an unknown has in it, where it is or, as links in
/// line multiply their angles by almost nothing along the line, where `variation` takes it.
fn roundings<T: Real, D: Dim>(
    jacobian: &OMatrix<T, D, D>,
    variation: &OMatrix<T, D, D>,
    sizes: &OVector<T, D>,
) -> OVector<T, D>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let dimension = jacobian.shape_generic().0;
    let mut roundings = zero_vector(dimension);
    let columns = jacobian.as_slice().chunks_exact(dimension.value());
    let changes = variation.as_slice().chunks_exact(dimension.value());
    for ((column, change), size) in columns.zip(changes).zip(sizes.as_slice()) {
        let rounding = T::from_f64(LEFT_BY_ROUNDING) * T::EPSILON * *size;
        let entries = column.iter().zip(change);
        for (largest, (entry, change)) in roundings.as_mut_slice().iter_mut().zip(entries) {
            let part = rounding * (entry.abs() + change.abs());
            *largest = if part > *largest { part } else { *largest };
        }
    }
    roundings
}

fn scaled<T: Real, D: Dim>(vector: &OVector<T, D>, factor: f64) -> OVector<T, D>
where
    DefaultAllocator: Allocator<D>,
{
    let mut scaled = vector.clone();
    for entry in scaled.as_mut_slice() {
        *entry *= T::from_f64(factor);
    }
    scaled
}

fn times<T: Real, D: Dim>(matrix: &OMatrix<T, D, D>, vector: &OVector<T, D>) -> OVector<T, D>
where
    DefaultAllocator: Allocator<D> + Allocator<D, D>,
{
    let dimension = vector.shape_generic().0;
    let mut product = zero_vector(dimension);
    let columns = matrix.as_slice().chunks_exact(dimension.value());
    for (column, factor) in columns.zip(vector.as_slice()) {
        for (sum, entry) in product.as_mut_slice().iter_mut().zip(column) {
            *sum += *entry * *factor;
        }
    }
    product
}

/// Blames a block where a value is negative, or NaN.
///
/// # Errors
/// The block.
#[inline]
pub fn required<T: Real>(value: T, block: u16) -> Result<(), u16> {
    match value >= T::ZERO {
        true => Ok(()),
        false => Err(block),
    }
}
